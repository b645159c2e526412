// MJCF read by MuJoCo 3 (npm) and, where it is built, by MuJoCo 2.2.2 of Debian (mujoco_2.cpp): what the model holds, and
// where the doll comes to rest.
import loadMujoco from '@mujoco/mujoco';
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { Checks, multiply, ourRestHeight, plainShape, profileOf, rotate, run } from './lib.mjs';

const [model, folder] = process.argv.slice(2);
const geomTypes = { sphere: 2, capsule: 3, box: 6, hull: 7 };  // mjtGeom
const sorted = (values) => [...values].sort((a, b) => a - b);
const stem = path.parse(model).name;
const file = path.join(folder, `${stem}.xml`);
run('export', model, '-o', file);
const profile = profileOf(model, path.join(folder, `${stem}.ragdoll.json`));
const ours = ourRestHeight(model, profile, folder);

// As ourRestHeight() starts: about the figure's left, which is y here.
function layOnBack(qpos) {
  const [w, x, y, z] = qpos.slice(3, 7);
  const turned = multiply([0, -Math.SQRT1_2, 0, Math.SQRT1_2], [x, y, z, w]);
  qpos.set([0, 0, 1, turned[3], turned[0], turned[1], turned[2]]);
}

/** The facts of a loaded model in one shape: bodies and joints by name. */
async function readByMujoco3() {
  const mj = await loadMujoco();
  const m = mj.MjModel.from_xml_string(fs.readFileSync(file, 'utf8'));
  const d = new mj.MjData(m);
  const name = (type, i) => mj.mj_id2name(m, type.value, i);
  const three = (array, i) => [...array.slice(3 * i, 3 * i + 3)];
  const bodies = {};
  for (let i = 1; i < m.nbody; i++) {
    bodies[name(mj.mjtObj.mjOBJ_BODY, i)] = { mass: m.body_mass[i], inertia: three(m.body_inertia, i), ipos: three(m.body_ipos, i), geoms: [] };
  }
  for (let i = 0; i < m.ngeom; i++) {
    const body = bodies[name(mj.mjtObj.mjOBJ_BODY, m.geom_bodyid[i])];
    if (body) body.geoms.push({ type: m.geom_type[i], size: three(m.geom_size, i) });
  }
  const joints = {};
  for (let i = 1; i < m.njnt; i++) {
    joints[name(mj.mjtObj.mjOBJ_JOINT, i)] = { pos: three(m.jnt_pos, i), axis: three(m.jnt_axis, i), range: [...m.jnt_range.slice(2 * i, 2 * i + 2)], friction: m.dof_frictionloss[m.jnt_dofadr[i]] };
  }
  mj.mj_resetDataKeyframe(m, d, 0);
  layOnBack(d.qpos);
  for (let i = 0; i < 6 / m.opt.timestep; i++) mj.mj_step(m, d);
  return { bodies, joints, excludes: m.nexclude, tendons: m.ntendon, rest: d.subtree_com[2], finite: [...d.qpos, ...d.qvel].every(Number.isFinite) };
}

function compare(name, read) {
  const checks = new Checks(`mjcf ${stem} by ${name}`);
  checks.that(Object.keys(read.bodies).length === profile.bodies.length, 'number of bodies');
  for (const body of profile.bodies) {
    const got = read.bodies[body.name];
    checks.near(got.mass, body.massKg, 1e-6, `mass of ${body.name}`);
    // MuJoCo sorts principal axes when it must; ours come in the body's axes.
    checks.near(sorted(got.inertia), sorted(body.inertia), 1e-6, `inertia of ${body.name}`);
    const { kind, sizes } = plainShape(body.shape);
    checks.that(got.geoms[0]?.type === geomTypes[kind], `kind of the shape of ${body.name}: ${got.geoms[0]?.type}`);
    checks.near(sorted(got.geoms[0]?.size.slice(0, sizes.length) ?? []), sorted(sizes), 1e-6, `sizes of ${body.name}`);
    checks.near(got.ipos, [0, 0, 0], 1e-6, `centre of mass of ${body.name}`);
  }
  for (const c of profile.constraints) {
    const axes = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] };
    for (const [axis, direction] of c.kind === 'hinge' ? [['', axes.z]] : Object.entries(axes)) {
      const joint = read.joints[axis ? `${c.child}_${axis}` : c.child];
      checks.near(joint.pos, c.childFromFrame.translation, 1e-6, `anchor of ${c.child}`);
      checks.near(joint.axis, rotate(c.childFromFrame.rotation, direction), 1e-6, `axis ${axis} of ${c.child}`);
      checks.near(joint.friction, c.frictionNm, 1e-6, `friction of ${c.child}`);
      if (!axis) checks.near(joint.range, [c.hinge.lower, c.hinge.upper], 1e-6, `range of ${c.child}`);
      if (axis === 'x') checks.near(joint.range, [-c.cone.twist, c.cone.twist], 1e-6, `twist of ${c.child}`);
      // The ends of the ellipse's axes are inside; past a right angle the octagon needs to be a little wider.
      const swing = { y: c.cone?.swingY, z: c.cone?.swingZ }[axis];
      if (swing) checks.that(joint.range[1] > swing - 1e-6 && (swing > Math.PI / 2 || joint.range[1] < swing * 1.1), `swing ${axis} of ${c.child}`);
    }
  }
  checks.that(read.excludes === profile.constraints.length + profile.filteredPairs.length, 'number of excluded pairs');
  checks.that(read.tendons === 2 * profile.constraints.filter((c) => c.kind === 'coneTwist').length, 'number of tendons');
  checks.that(read.finite, 'all numbers are finite after 6 s');
  checks.that(Math.abs(read.rest - ours) < 0.05, `height of the centre of mass at rest: ${read.rest}, ours ${ours}`);
  checks.fact(`rests at ${read.rest.toFixed(3)} m, ours at ${ours.toFixed(3)} m`);
  checks.end();
}

compare('MuJoCo 3', await readByMujoco3());
if (process.env.MUJOCO_2) {
  compare('MuJoCo 2.2.2', JSON.parse(execFileSync(process.env.MUJOCO_2, [file], { encoding: 'utf8' })));
}
