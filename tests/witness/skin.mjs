// The baked fall of a model's skin, read and skinned by Blender at five frames, against our own posed mesh (--mesh-out).
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { Checks, length, profileOf, run, subtract } from './lib.mjs';

const [model, folder] = process.argv.slice(2);
const stem = path.parse(model).name;
const checks = new Checks(`skin ${stem}`);
const frames = [0, 20, 40, 60, 90];
const tolerance = 1e-4; // of the height
const skinOf = () => JSON.parse(run('inspect', model, '--json')).meshes;

/** Ends the run where there is nothing to compare. */
function leave(why) {
  checks.fact(why);
  checks.end();
  process.exit();
}

let heightM;
try {
  ({ heightM } = profileOf(model, path.join(folder, `${stem}.ragdoll.json`)));
} catch (failure) {
  if (failure.status !== 3) throw failure;
  leave('is refused');
}
if (skinOf().length === 0) leave('has no skin');

/** Vertices of our mesh, object by object. */
function objectsOf(file) {
  const objects = [];
  for (const line of fs.readFileSync(file, 'utf8').split('\n')) {
    if (line.startsWith('o ')) objects.push([]);
    if (line.startsWith('v ')) objects.at(-1).push(line.split(' ').slice(1).map(Number));
  }
  return objects;
}

const farthest = (a, b) => a.reduce((worst, point, i) => Math.max(worst, length(subtract(point, b[i]))), 0);

const baked = path.join(folder, `${stem}.baked.glb`);
const ours = frames.map((frame) => {
  const mesh = path.join(folder, `${stem}.${frame}.obj`);
  const last = frame === frames.at(-1) ? ['--out', baked] : [];
  run('simulate', model, '--scene', 'drop', '--seconds', String(frame / 60), '--mesh-out', mesh, ...last);
  return objectsOf(mesh);
});
const out = path.join(folder, `${stem}.skin.json`);
const script = path.join(import.meta.dirname, 'blender_skin.py');
execFileSync('blender', ['-b', '--factory-startup', '--python-exit-code', '1', '--python', script, '--', baked, out, ...frames.map(String)], { stdio: ['ignore', 'ignore', 'inherit'], timeout: 600000 });
const theirs = JSON.parse(fs.readFileSync(out, 'utf8'));

// Blender lists its meshes in an order of its own: each of ours takes the one of its size that begins nearest to it.
const free = new Set(theirs[0].keys());
let worst = 0;
for (const [i, first] of ours[0].entries()) {
  const alike = [...free].filter((j) => theirs[0][j].length === first.length);
  checks.that(alike.length > 0, `mesh ${i} of ${first.length} vertices is there`);
  if (alike.length === 0) continue;
  const [partner] = alike.map((j) => [farthest(first, theirs[0][j]), j]).sort((a, b) => a[0] - b[0])[0].slice(1);
  free.delete(partner);
  for (const [f, frame] of frames.entries()) {
    const off = farthest(ours[f][i], theirs[f][partner]) / heightM;
    worst = Math.max(worst, off);
    checks.that(off <= tolerance, `mesh ${i} at frame ${frame}: ${off.toExponential(1)} of the height away`);
  }
}
const moved = ours[0].reduce((most, mesh, i) => Math.max(most, farthest(mesh, ours.at(-1)[i])), 0);
checks.that(moved > 0.1 * heightM, `the doll moves: by ${moved} m`);
checks.fact(`${worst.toExponential(1)} of the height at most`);
checks.end();
