// glTF with KHR_physics_rigid_bodies: every object of the two extensions against the drafts' JSON Schemas (ajv; the folder of
// schemas is given by KHR_PHYSICS), the rest by Khronos' gltf-validator, and the numbers against the profile.
import Ajv from 'ajv/dist/2020.js';
import validator from 'gltf-validator';
import fs from 'node:fs';
import path from 'node:path';
import { Checks, profileOf, run } from './lib.mjs';

const [model, folder] = process.argv.slice(2);
const stem = path.parse(model).name;
const checks = new Checks(`glTF ${stem}`);
const profileFile = path.join(folder, `${stem}.ragdoll.json`);
const profile = profileOf(model, profileFile);

/** The JSON of a .glb. */
function jsonOf(bytes) {
  return JSON.parse(bytes.subarray(20, 20 + bytes.readUInt32LE(12)).toString());
}

function schemas() {
  const ajv = new Ajv({ strict: false, allErrors: true });
  // The core's schemas that the drafts refer to.
  ajv.addSchema({ $id: 'glTFProperty.schema.json', type: 'object' });
  ajv.addSchema({ $id: 'glTFChildOfRootProperty.schema.json', type: 'object', properties: { name: { type: 'string' } } });
  ajv.addSchema({ $id: 'glTFid.schema.json', type: 'integer', minimum: 0 });
  for (const extension of ['KHR_physics_rigid_bodies', 'KHR_implicit_shapes']) {
    const schemaFolder = path.join(process.env.KHR_PHYSICS, extension);
    for (const name of fs.readdirSync(schemaFolder).filter((f) => f.endsWith('.json'))) {
      ajv.addSchema(JSON.parse(fs.readFileSync(path.join(schemaFolder, name), 'utf8')));
    }
  }
  return ajv;
}

function checkSchemas(json) {
  const ajv = schemas();
  const against = (id, value, what) => checks.that(ajv.validate(id, value), `${what}: ${ajv.errorsText()}`);
  const { KHR_physics_rigid_bodies: physics, KHR_implicit_shapes: shapes } = json.extensions;
  against('glTF.KHR_physics_rigid_bodies.schema.json', physics, 'physics');
  // A doll of hulls has none.
  if (shapes) against('glTF.KHR_implicit_shapes.schema.json', shapes, 'shapes');
  json.nodes.forEach((node, i) => {
    const extension = node.extensions?.KHR_physics_rigid_bodies;
    if (extension) against('node.KHR_physics_rigid_bodies.schema.json', extension, `node ${i}`);
  });
  // The schemas do see faults.
  checks.that(!ajv.validate('glTF.KHR_implicit_shapes.schema.json', { shapes: [{ type: 'sphere', sphere: { radius: -1 } }] }), 'a negative radius is refused');
}

function checkNumbers(json) {
  const physics = json.extensions.KHR_physics_rigid_bodies;
  const motions = json.nodes.map((n) => n.extensions?.KHR_physics_rigid_bodies?.motion).filter(Boolean);
  checks.that(motions.length === profile.bodies.length, 'number of motions');
  // glTF keeps the names as they are.
  const bodies = Object.fromEntries(JSON.parse(fs.readFileSync(profileFile, 'utf8')).bodies.map((b) => [b.name, b]));
  for (const motion of motions) {
    const body = bodies[motion.extras.lutkaName];
    checks.near(motion.mass, body.massKg, 1e-6, `mass of ${body.name}`);
    checks.near(motion.inertiaDiagonal, body.inertia, 1e-6, `inertia of ${body.name}`);
    checks.near(motion.centerOfMass, body.jointFromBody.translation, 1e-5, `centre of mass of ${body.name}`);
  }
  checks.that((physics.physicsJoints ?? []).length === profile.constraints.length, 'number of joints');
}

async function checkCore(file) {
  const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)));
  const ours = report.issues.messages.filter((m) => m.severity < 2 && m.code !== 'UNSUPPORTED_EXTENSION');
  checks.that(ours.length === 0, `gltf-validator: ${JSON.stringify(ours.slice(0, 3))}`);
}

/** Every number of two profiles, by name, the joint's path apart: the file has a root of its own. */
function checkRoundTrip(file) {
  const back = profileOf(file, path.join(folder, `${stem}.back.ragdoll.json`));
  checks.that(back.bodies.length === profile.bodies.length, 'bodies come back');
  const numbers = (value) => (typeof value === 'number' ? [value] : value && typeof value === 'object' ? Object.values(value).flatMap(numbers) : []);
  // q and -q are the same rotation.
  const flip = (value) => JSON.parse(JSON.stringify(value, (key, v) => (key === 'rotation' && v.findLast((c) => Math.abs(c) > 1e-3) < 0 ? v.map((c) => -c) : v)));
  const same = (a, b, what) => checks.near(numbers(flip(a)), numbers(flip(b)), 1e-5, what);
  // A capsule of length 0 comes back as the sphere that it is.
  for (const { shape } of profile.bodies) {
    if (shape.kind === 'capsule' && shape.halfLength === 0) delete shape.halfLength;
  }
  for (const body of profile.bodies) same({ ...back.byName[body.name], jointPath: '' }, { ...body, jointPath: '' }, `round trip of ${body.name}`);
  for (const c of profile.constraints) same(back.constraints.find((d) => d.child === c.child), c, `round trip of the joint of ${c.child}`);
  const pairs = (p) => p.filteredPairs.map((pair) => [...pair].sort().join()).sort().join(' ');
  checks.that(pairs(back) === pairs(profile), 'pairs come back');
}

const file = path.join(folder, `${stem}.glb`);
run('export', model, '-o', file);
const json = jsonOf(fs.readFileSync(file));
if (process.env.KHR_PHYSICS) checkSchemas(json);
else checks.fact('schemas not there (KHR_PHYSICS)');
checkNumbers(json);
await checkCore(file);
checkRoundTrip(file);
const text = path.join(folder, `${stem}.gltf`);
run('export', model, '-o', text);
await checkCore(text);
checks.end();
