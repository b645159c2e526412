// The script run by Blender, headless: masses, the start, and a fall of 6 s, measured by our formulas.
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { Checks, measure, ourRestHeight, plainShape, profileOf, run } from './lib.mjs';

const [model, folder] = process.argv.slice(2);
const stem = path.parse(model).name;
const checks = new Checks(`Blender ${stem}`);
const profile = profileOf(model, path.join(folder, `${stem}.ragdoll.json`));
const script = path.join(folder, `${stem}.py`);
run('export', model, '-o', script);
const out = path.join(folder, `${stem}.blender.json`);
const drop = path.join(import.meta.dirname, 'blender_drop.py');
execFileSync('blender', ['-b', '--factory-startup', '--python-exit-code', '1', '--python', drop, '--', script, out], { stdio: ['ignore', 'ignore', 'inherit'], timeout: 600000 });
const { masses, shapes, steps } = JSON.parse(fs.readFileSync(out, 'utf8'));
for (const body of profile.bodies) {
  checks.near(masses[body.name], body.massKg, 1e-5, `mass of ${body.name}`);
  const { kind, sizes } = plainShape(body.shape);
  const [radius, halfLength = 0] = sizes;
  const half = kind === 'box' ? sizes : [radius, radius, radius + halfLength];  // a capsule's axis is z there
  checks.that(shapes[body.name].kind === kind.toUpperCase(), `kind of the shape of ${body.name}: ${shapes[body.name].kind}`);
  checks.near(shapes[body.name].size, half.map((x) => 2 * x), 1e-3, `sizes of ${body.name}`);
}
let start = 0;
let separation = 0;
const violations = [];
for (const [i, places] of steps.entries()) {
  for (const c of profile.constraints) {
    const m = measure(c, places[c.parent], places[c.child]);
    if (i === 0) start = Math.max(start, m.violation, m.separation);
    separation = Math.max(separation, m.separation);
    violations.push(m.violation);
    if (process.env.VERBOSE && i % 30 === 0 && m.violation > 0.2) console.log(i, c.child, c.kind, m);
  }
}
violations.sort((a, b) => a - b);
const deg = (x) => ((x * 180) / Math.PI).toFixed(1);
const last = steps.at(-1);
const rest = profile.bodies.reduce((sum, b) => sum + b.massKg * last[b.name].p[2], 0) / profile.totalMassKg;
const ours = ourRestHeight(model, profile, folder);
checks.that(Object.values(last).every((b) => [...b.p, ...b.q].every(Number.isFinite)), 'all numbers are finite');
checks.that(start < 1e-3, `the start is ours: off by ${start}`);
checks.fact(`separation ${(1000 * separation).toFixed(1)} mm at most, past limits ${deg(violations[Math.floor(0.99 * violations.length)])} degrees p99, ${deg(violations.at(-1))} at most`);
checks.fact(`rests at ${rest.toFixed(3)} m, ours at ${ours.toFixed(3)} m`);
// Ours begins upright: a creature may come to rest on another side.
const most = process.env.LUTKA_RIG === 'any' ? 0.15 * profile.heightM : 0.05;
checks.that(Math.abs(rest - ours) < most, `height of the centre of mass at rest: ${rest}, ours ${ours}`);
checks.end();
