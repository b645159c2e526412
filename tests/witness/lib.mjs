// What the readers share: running lutka, the profile's own facts, quaternions, and a list of failures.
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';

export const lutka = process.env.LUTKA ?? path.resolve(import.meta.dirname, '../../build/lutka');

// LUTKA_RIG=any: the models are creatures.
const ofAnyRig = new Set(['build', 'export', 'simulate', 'report']);
const rig = (command) => (process.env.LUTKA_RIG && ofAnyRig.has(command) ? ['--rig', process.env.LUTKA_RIG] : []);

/** Runs lutka; what it prints to stdout. */
export function run(command, ...args) {
  return execFileSync(lutka, [command, ...args, ...rig(command)], { encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore'], maxBuffer: 1 << 28 });
}

/** Collects what does not hold; `end()` prints a line and sets the exit code. */
export class Checks {
  constructor(name) {
    this.name = name;
    this.failures = [];
    this.count = 0;
    this.facts = [];
  }
  that(holds, text) {
    this.count++;
    if (!holds) this.failures.push(text);
  }
  /** Every number of two lists, within `tolerance` of 1 or of its size. */
  near(got, wanted, tolerance, text) {
    const a = [got].flat();
    const b = [wanted].flat();
    const off = a.length === b.length ? Math.max(...a.map((x, i) => Math.abs(x - b[i]) / Math.max(1, Math.abs(b[i])))) : NaN;
    this.that(off <= tolerance, `${text}: got ${a}, wanted ${b}`);
  }
  fact(text) {
    this.facts.push(text);
  }
  end() {
    console.log(`${this.failures.length ? 'FAIL' : 'ok  '} ${this.name}: ${this.count} checks${this.facts.map((f) => '; ' + f).join('')}`);
    for (const failure of this.failures.slice(0, 20)) console.log(`     ${failure}`);
    if (this.failures.length) process.exitCode = 1;
  }
}

/** A shape as exporters write it (a capsule without length is a sphere): its kind, and its numbers: radius, half the length
 * between the caps; half extents. */
export function plainShape({ kind, radius, halfLength, halfExtents }) {
  if (kind === 'hull') return { kind, sizes: [] };  // its corners are looked at in the ordinary tests
  if (kind === 'sphere' || halfLength === 0) return { kind: 'sphere', sizes: [radius] };
  return { kind, sizes: kind === 'box' ? halfExtents : [radius, halfLength] };
}

/** Names as the exporters write them (bodyName() in src/export/doll_layout.cpp). */
function exportNames(profile) {
  const words = profile.bodies.map(({ name }) => {
    const word = name.replace(/[^A-Za-z0-9]+/g, '_');
    return /^[A-Za-z]/.test(word) ? word : `body_${word}`;
  });
  const names = words.map((word, i) => (words.some((other, k) => k !== i && other === word) ? `${word}__${i}` : word));
  const of = Object.fromEntries(profile.bodies.map((b, i) => [b.name, names[i]]));
  profile.bodies.forEach((b, i) => { b.name = names[i]; });
  for (const c of profile.constraints) Object.assign(c, { child: of[c.child], parent: of[c.parent] });
  profile.filteredPairs = profile.filteredPairs.map((pair) => pair.map((name) => of[name]));
}

/** The profile of a model as JSON, its bodies named as in exports, written to a file as it is, too. */
export function profileOf(model, file) {
  run('build', model, '-o', file);
  const profile = JSON.parse(fs.readFileSync(file, 'utf8'));
  exportNames(profile);
  profile.byName = Object.fromEntries(profile.bodies.map((b) => [b.name, b]));
  return profile;
}

// Quaternions are [x, y, z, w], as in the profile.
export const conjugate = ([x, y, z, w]) => [-x, -y, -z, w];
export function multiply([ax, ay, az, aw], [bx, by, bz, bw]) {
  return [
    aw * bx + ax * bw + ay * bz - az * by,
    aw * by - ax * bz + ay * bw + az * bx,
    aw * bz + ax * by - ay * bx + az * bw,
    aw * bw - ax * bx - ay * by - az * bz,
  ];
}
export function rotate(q, [x, y, z]) {
  const [rx, ry, rz] = multiply(multiply(q, [x, y, z, 0]), conjugate(q));
  return [rx, ry, rz];
}
export const add = (a, b) => a.map((x, i) => x + b[i]);
export const subtract = (a, b) => a.map((x, i) => x - b[i]);
export const length = (v) => Math.hypot(...v);

/** Rotation vector of the swing (x = 0) and the twist about x of a rotation = swing · twist. */
export function swingTwist(q) {
  const [x, y, z, w] = q[3] < 0 ? q.map((c) => -c) : q;
  const size = Math.hypot(w, x);
  const twist = size > 1e-9 ? [x / size, 0, 0, w / size] : [0, 0, 0, 1];
  const swing = multiply([x, y, z, w], conjugate(twist));
  const sine = Math.hypot(swing[1], swing[2]);
  const scale = sine > 1e-12 ? (2 * Math.atan2(sine, swing[3])) / sine : 2;
  return { swing: [0, swing[1] * scale, swing[2] * scale], twist: 2 * Math.atan2(twist[0], twist[3]) };
}

/** Metres between the anchors, and radians past the limit, of a constraint of the profile; bodies {p, q} in any world. */
export function measure(constraint, parent, child) {
  const at = (body, frame) => add(body.p, rotate(body.q, frame.translation));
  const separation = length(subtract(at(parent, constraint.parentFromFrame), at(child, constraint.childFromFrame)));
  const relative = multiply(
    conjugate(multiply(parent.q, constraint.parentFromFrame.rotation)),
    multiply(child.q, constraint.childFromFrame.rotation),
  );
  if (constraint.kind === 'hinge') {
    let angle = 2 * Math.atan2(relative[2], relative[3]);
    if (angle > Math.PI) angle -= 2 * Math.PI;
    if (angle < -Math.PI) angle += 2 * Math.PI;
    return { separation, violation: Math.max(constraint.hinge.lower - angle, angle - constraint.hinge.upper, 0) };
  }
  const { swing, twist } = swingTwist(relative);
  const filled = Math.hypot(swing[1] / constraint.cone.swingY, swing[2] / constraint.cone.swingZ);
  const past = filled > 1 ? length(swing) * (1 - 1 / filled) : 0;
  return { separation, violation: Math.max(past, Math.abs(twist) - constraint.cone.twist, 0), past };
}

/**
 * Height of the centre of mass after 6 s of our own drop from 1 m, metres over the floor. The figure lies on its back, turned
 * from standing by -90 degrees about its left: how it comes to rest from standing is chance, this is not.
 */
export function ourRestHeight(model, profile, folder) {
  const scene = path.join(folder, 'back.scene.json');
  run('scene', 'drop', '-o', scene);
  const entities = JSON.parse(fs.readFileSync(scene, 'utf8'));
  entities.entities[1].transform.rotation = [-Math.SQRT1_2, 0, 0, Math.SQRT1_2];
  fs.writeFileSync(scene, JSON.stringify(entities));
  const file = path.join(folder, 'back.rec');
  run('simulate', model, '--scene', scene, '--seconds', '6', '--record', file);
  const bytes = fs.readFileSync(file);
  const start = bytes.indexOf(10) + 1;
  const header = JSON.parse(bytes.subarray(0, start).toString());
  const bodies = profile.bodies.length;
  const last = start + (header.steps - 1) * bodies * 28;
  let moment = 0;
  profile.bodies.forEach((body, i) => (moment += body.massKg * bytes.readFloatLE(last + i * 28 + 20)));
  return moment / profile.totalMassKg;
}
