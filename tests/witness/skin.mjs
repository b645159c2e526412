// The baked fall of a model's skin, read and skinned by Blender and by three.js at five frames, against our own posed mesh
// (--mesh-out), with all keys and with those that are kept by default; and what Khronos' gltf-validator says of the files, of
// one doll and of a crowd.
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import validator from 'gltf-validator';
import { Checks, length, profileOf, run, subtract } from './lib.mjs';
import { threeVertices } from './three_skin.mjs';

const [model, folder] = process.argv.slice(2);
const stem = path.parse(model).name;
const checks = new Checks(`skin ${stem}`);
const frames = [0, 20, 40, 60, 90];
const tolerance = 1e-4; // of the height
// What is left out may put a joint off by 0.1 mm and 0.05 degrees: so much at half a metre from it.
const reducedM = 1e-4 + 0.5 * ((0.05 * Math.PI) / 180);
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
const reduced = path.join(folder, `${stem}.reduced.glb`);
const crowd = path.join(folder, `${stem}.crowd.glb`);
const drop = (seconds, ...rest) => run('simulate', model, '--scene', 'drop', '--seconds', String(seconds), ...rest);
const ours = frames.map((frame) => {
  const mesh = path.join(folder, `${stem}.${frame}.obj`);
  drop(frame / 60, '--mesh-out', mesh);
  return objectsOf(mesh);
});
drop(frames.at(-1) / 60, '--out', baked, '--no-reduce');
drop(frames.at(-1) / 60, '--out', reduced);
drop(0.5, '--count', '3', '--together', '--out', crowd);

/** Holds another program's meshes against ours. It lists them in an order of its own: each of ours takes the one of its size
 * that begins nearest to it. */
function compare(name, theirs, most) {
  const free = new Set(theirs[0].keys());
  let worst = 0;
  for (const [i, first] of ours[0].entries()) {
    const alike = [...free].filter((j) => theirs[0][j].length === first.length);
    checks.that(alike.length > 0, `${name}: mesh ${i} of ${first.length} vertices is there`);
    if (alike.length === 0) continue;
    const [partner] = alike.map((j) => [farthest(first, theirs[0][j]), j]).sort((a, b) => a[0] - b[0])[0].slice(1);
    free.delete(partner);
    for (const [f, frame] of frames.entries()) {
      const off = farthest(ours[f][i], theirs[f][partner]) / heightM;
      worst = Math.max(worst, off);
      checks.that(off <= most, `${name}: mesh ${i} at frame ${frame}: ${off.toExponential(1)} of the height away`);
    }
  }
  checks.fact(`${name} ${worst.toExponential(1)} of the height at most`);
}

const moments = frames.map((frame) => frame / 60);
compare('three.js', await threeVertices(fs.readFileSync(baked), moments), tolerance);
compare('three.js, fewer keys', await threeVertices(fs.readFileSync(reduced), moments), reducedM / heightM + tolerance);
if (process.env.BLENDER !== 'no') {
  const out = path.join(folder, `${stem}.skin.json`);
  const script = path.join(import.meta.dirname, 'blender_skin.py');
  execFileSync('blender', ['-b', '--factory-startup', '--python-exit-code', '1', '--python', script, '--', baked, out, ...frames.map(String)], { stdio: ['ignore', 'ignore', 'inherit'], timeout: 600000 });
  compare('Blender', JSON.parse(fs.readFileSync(out, 'utf8')), tolerance);
}
const moved = ours[0].reduce((most, mesh, i) => Math.max(most, farthest(mesh, ours.at(-1)[i])), 0);
checks.that(moved > 0.1 * heightM, `the doll moves: by ${moved} m`);

for (const file of [baked, reduced, crowd]) {
  const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), { maxIssues: 20 });
  const told = report.issues.messages.filter((issue) => issue.severity <= 1).map((issue) => `${issue.code} at ${issue.pointer}`);
  checks.that(told.length === 0, `${path.basename(file)}: the validator tells ${told.join('; ')}`);
}
checks.fact(`${(fs.statSync(reduced).size / fs.statSync(baked).size).toFixed(2)} of the size with fewer keys`);
checks.end();
