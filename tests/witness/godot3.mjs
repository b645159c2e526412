// The scene read, stepped and read back by Godot 3 (Debian's godot3-server), with separation and limits by our formulas.
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { Checks, measure, ourRestHeight, plainShape, profileOf, run } from './lib.mjs';

const [model, folder] = process.argv.slice(2);
const stem = path.parse(model).name;
const project = path.join(folder, 'godot3');
const checks = new Checks(`Godot 3 ${stem}`);
const profile = profileOf(model, path.join(folder, `${stem}.ragdoll.json`));
run('export', model, '-o', path.join(project, 'doll.tscn'), '--format', 'godot3');
execFileSync('godot3-server', ['--path', project, '--fixed-fps', '240', '-s', 'drop.gd'], { stdio: 'inherit', timeout: 300000 });
const lines = fs.readFileSync(path.join(project, 'drop.jsonl'), 'utf8').trim().split('\n').map((line) => JSON.parse(line));
const facts = lines[0];
const steps = lines.slice(1);

checks.that(Object.keys(facts).length === profile.bodies.length, 'number of bodies');
const partners = (role) => profile.constraints.filter((c) => c.parent === role || c.child === role).length + profile.filteredPairs.filter((p) => p.includes(role)).length;
for (const body of profile.bodies) {
  const fact = facts[body.name];
  checks.near(fact.mass, body.massKg, 1e-5, `mass of ${body.name}`);
  checks.that(fact.bone >= 0, `bone of ${body.name}`);
  const { kind, sizes } = plainShape(body.shape);
  checks.that(fact.shape === { capsule: 'CapsuleShape', sphere: 'SphereShape', box: 'BoxShape', hull: 'ConvexPolygonShape' }[kind], `kind of the shape of ${body.name}: ${fact.shape}`);
  checks.near(fact.sizes, sizes, 1e-5, `sizes of ${body.name}`);
}
for (const c of profile.constraints) {
  const fact = facts[c.child];
  checks.that(fact.joint === (c.kind === 'hinge' ? 3 : 5), `kind of the joint of ${c.child}`);
  const spans = c.kind === 'hinge' ? { '': c.hinge.upper - c.hinge.lower } : { 'x/': 2 * c.cone.twist, 'y/': 2 * c.cone.swingY, 'z/': 2 * c.cone.swingZ };
  for (const [axis, span] of Object.entries(spans)) {
    const got = fact[`${axis}angular_limit_upper`] - fact[`${axis}angular_limit_lower`];
    checks.near((got * Math.PI) / 180, span, 1e-4, `span ${axis} of ${c.child}`);
  }
}
const height = (places) => profile.bodies.reduce((sum, b) => sum + b.massKg * places[b.name].p[1], 0) / profile.totalMassKg;
let start = 0;
const violations = [];
let separation = 0;
for (const [i, places] of steps.entries()) {
  for (const c of profile.constraints) {
    const m = measure(c, places[c.parent], places[c.child]);
    if (i < 1) start = Math.max(start, m.violation);
    separation = Math.max(separation, m.separation);
    violations.push(m.violation);
    if (process.env.VERBOSE && i % 120 === 0 && m.violation > 0.2) console.log(i, c.child, c.kind, m);
  }
}
violations.sort((a, b) => a - b);
const deg = (x) => ((x * 180) / Math.PI).toFixed(1);
const last = steps.at(-1);
checks.that(Object.values(last).every((b) => [...b.p, ...b.q].every(Number.isFinite)), 'all numbers are finite');
checks.that(start < 0.01, `the start is inside the limits: ${deg(start)} degrees past`);
checks.fact(`separation ${(1000 * separation).toFixed(1)} mm at most, past limits ${deg(violations[Math.floor(0.99 * violations.length)])} degrees p99, ${deg(violations.at(-1))} at most`);
const ours = ourRestHeight(model, profile, folder);
checks.fact(`rests at ${height(last).toFixed(3)} m, ours at ${ours.toFixed(3)} m`);
checks.that(Math.abs(height(last) - ours) < 0.05, `height of the centre of mass at rest: ${height(last)}, ours ${ours}`);
checks.end();
