// USD text read by three.js' reader of it: prims, masses, moments, shapes, where bodies stand, and joints whose two sides meet. It knows
// nothing of UsdPhysics, so that it tells whether the file says what it should, not what an engine would do with it.
import fs from 'node:fs';
import path from 'node:path';
import { USDAParser } from 'three/examples/jsm/loaders/usd/USDAParser.js';
import { add, Checks, conjugate, multiply, plainShape, profileOf, rotate, run } from './lib.mjs';

const [model, folder] = process.argv.slice(2);
const stem = path.parse(model).name;
const checks = new Checks(`USD ${stem} by three.js`);
const file = path.join(folder, `${stem}.usda`);
run('export', model, '-o', file);
const profile = profileOf(model, path.join(folder, `${stem}.ragdoll.json`));
const prims = new USDAParser().parseData(fs.readFileSync(file, 'utf8')).specsByPath;

const fieldsOf = (prim) => prims[prim]?.fields ?? {};
const value = (prim, name) => fieldsOf(`${prim}.${name}`).default;
const target = (prim, name) => fieldsOf(`${prim}.${name}`).targetPaths?.[0];
const schemas = (prim) => JSON.parse(value(prim, 'apiSchemas') ?? '[]');
const pathOf = (name) => `/Ragdoll/${name}`;
const types = { capsule: 'Capsule', sphere: 'Sphere', box: 'Cube' };
const degrees = (radians) => (radians * 180) / Math.PI;

checks.that(fieldsOf('/').defaultPrim === 'Ragdoll' && fieldsOf('/').upAxis === 'Y' && fieldsOf('/').metersPerUnit === 1, 'stage');
const children = fieldsOf('/Ragdoll').primChildren ?? [];
checks.that(children.length === profile.bodies.length + profile.constraints.length + 1, `${children.length} prims`);
const material = target('/Ragdoll', 'material:binding:physics');
checks.that(schemas(material).includes('PhysicsMaterialAPI'), 'the material of all shapes');
checks.near(value(material, 'physics:dynamicFriction'), 0.5, 1e-6, 'friction of contacts');

for (const body of profile.bodies) {
  const prim = pathOf(body.name);
  checks.that(schemas(prim).includes('PhysicsRigidBodyAPI') && schemas(prim).includes('PhysicsMassAPI'), `schemas of ${body.name}`);
  checks.near(value(prim, 'physics:mass'), body.massKg, 1e-6, `mass of ${body.name}`);
  checks.near(value(prim, 'physics:diagonalInertia'), body.inertia, 1e-6, `inertia of ${body.name}`);
  const { kind, sizes } = plainShape(body.shape);
  const shape = `${prim}/shape`;
  checks.that(schemas(shape).includes('PhysicsCollisionAPI'), `the shape of ${body.name} collides`);
  if (!(kind in types)) continue;
  const type = fieldsOf(shape).typeName;
  checks.that(type === types[kind], `kind of the shape of ${body.name}: ${type}`);
  if (type === 'Capsule') checks.near([value(shape, 'radius'), value(shape, 'height')], [sizes[0], 2 * sizes[1]], 1e-6, `sizes of ${body.name}`);
  if (type === 'Sphere') checks.near(value(shape, 'radius'), sizes[0], 1e-6, `radius of ${body.name}`);
  if (type === 'Cube') checks.near(value(shape, 'xformOp:scale').map((x) => (x * value(shape, 'size')) / 2), sizes, 1e-6, `sizes of ${body.name}`);
}

// Where a joint's frame on that side is in the world.
function sideOf(prim, side) {
  const body = target(prim, `physics:body${side}`);
  const turn = value(body, 'xformOp:orient');
  return {
    place: add(value(body, 'xformOp:translate'), rotate(turn, value(prim, `physics:localPos${side}`))),
    turn: multiply(turn, value(prim, `physics:localRot${side}`)),
  };
}
let apart = 0;
for (const c of profile.constraints) {
  const prim = pathOf(`${c.child}_joint`);
  checks.that(target(prim, 'physics:body0') === pathOf(c.parent) && target(prim, 'physics:body1') === pathOf(c.child), `bodies of ${prim}`);
  const [parent, child] = [sideOf(prim, 0), sideOf(prim, 1)];
  apart = Math.max(apart, Math.hypot(...parent.place.map((x, i) => x - child.place[i])));
  const hinge = fieldsOf(prim).typeName === 'PhysicsRevoluteJoint';
  checks.that(hinge === (c.kind === 'hinge'), `kind of ${prim}`);
  if (hinge) {
    // It starts within its range, about z, and about nothing else.
    const [x, y, z, w] = multiply(conjugate(parent.turn), child.turn);
    const angle = degrees(2 * Math.atan2(z * Math.sign(w || 1), Math.abs(w)));
    checks.near([x, y], [0, 0], 1e-4, `axis of ${prim}`);
    const range = [value(prim, 'physics:lowerLimit'), value(prim, 'physics:upperLimit')];
    checks.that(value(prim, 'physics:axis') === 'Z' && angle >= range[0] - 0.1 && angle <= range[1] + 0.1, `${prim} starts at ${angle} of ${range}`);
  } else {
    for (const axis of ['transX', 'transY', 'transZ']) checks.that(value(prim, `limit:${axis}:physics:low`) > value(prim, `limit:${axis}:physics:high`), `${prim} is locked along ${axis}`);
    checks.that(schemas(prim).length === 6, `${prim} has ${schemas(prim)}`);
  }
}
checks.near(apart, 0, 1e-4, 'joints are apart');
checks.fact(`joints ${(1000 * apart).toFixed(3)} mm apart`);
checks.end();
