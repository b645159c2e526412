// A retargeted clip: the file by Khronos' gltf-validator, and its poses by Blender against ours, through the skin.
import { execFileSync } from 'node:child_process';
import validator from 'gltf-validator';
import fs from 'node:fs';
import path from 'node:path';
import { Checks, run } from './lib.mjs';

const [model, folder] = process.argv.slice(2);
const stem = path.parse(model).name;
const checks = new Checks(`retarget ${stem}`);
const source = path.join(process.env.LUTKA_ASSETS, 'models/mannequin.glb');
const file = path.join(folder, `${stem}.retargeted.glb`);
function retarget(...options) {
  try {
    return JSON.parse(run('retarget', source, '--clip', 'walk', '--to', model, '-o', file, '--json', ...options));
  } catch (failure) {
    if (failure.status !== 3) throw failure;
    checks.fact('refused as no whole figure');  // as it should be: without a file
    checks.that(!fs.existsSync(file), 'a refusal leaves no file');
    checks.end();
    process.exit();
  }
}
fs.rmSync(file, { force: true });
// Feet that stay on the floor cost directions: a lumberjack with large boots on short legs lifts his knees by up to 34 degrees
// for soles that would be 9 cm in the floor. So limbs are judged with loose feet, and soles without.
const loose = retarget('--loose-feet').limbDirectionDeg.mean;
const figures = retarget();
checks.fact(`limbs ${loose.toFixed(2)} degrees, ${figures.limbDirectionDeg.mean.toFixed(2)} with feet on the floor, slide ${figures.footSlideCm.max.toFixed(2)} cm`);
checks.that(loose <= 3, `limbs point off by ${loose} degrees`);
checks.that(figures.floorPenetrationCm.max <= figures.sourceFloorPenetrationCm.max + 0.5, `soles ${figures.floorPenetrationCm.max} cm in the floor`);
const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)));
checks.that(report.issues.numErrors === 0, `gltf-validator: ${JSON.stringify(report.issues.messages.slice(0, 3))}`);

/** What Blender tells, of our own skin. */
function ours(seconds) {
  const mesh = path.join(folder, `${stem}.retargeted.obj`);
  run('simulate', file, '--clip', `walk@${seconds}`, '--seconds', '0', '--mesh-out', mesh);
  const points = fs.readFileSync(mesh, 'utf8').split('\n').filter((line) => line.startsWith('v ')).map((line) => line.split(' ').slice(1, 4).map(Number));
  const mean = [0, 1, 2].map((axis) => points.reduce((sum, p) => sum + p[axis], 0) / points.length);
  const square = points.reduce((sum, p) => sum + p.reduce((s, x, axis) => s + (x - mean[axis]) ** 2, 0), 0) / points.length;
  const heights = points.map((p) => p[1]);
  return { vertices: points.length, height: heights.reduce((a, b) => Math.max(a, b)) - heights.reduce((a, b) => Math.min(a, b)), spread: Math.sqrt(square) };
}

if (JSON.parse(run('inspect', file, '--json')).meshes.length === 0) {
  checks.fact('no skin to compare');
} else {
  const moments = [0, 0.25, 0.5, 0.75];
  const out = path.join(folder, `${stem}.retargeted.json`);
  const script = path.join(folder, 'blender_pose.py');
  execFileSync('blender', ['-b', '--factory-startup', '--python-exit-code', '1', '--python', script, '--', file, moments.join(','), out], { stdio: ['ignore', 'ignore', 'inherit'], timeout: 600000 });
  const theirs = JSON.parse(fs.readFileSync(out, 'utf8'));
  for (const [i, seconds] of moments.entries()) {
    const mine = ours(seconds);
    checks.that(theirs[i].vertices === mine.vertices, `${seconds} s: ${theirs[i].vertices} vertices, ours ${mine.vertices}`);
    checks.near(theirs[i].high - theirs[i].low, mine.height, 2e-3, `${seconds} s: height of the skin`);
    checks.near(theirs[i].spread, mine.spread, 2e-3, `${seconds} s: spread of the skin`);
  }
}
checks.end();
