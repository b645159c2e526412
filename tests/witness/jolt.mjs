// Our profile as Jolt's RagdollSettings (npm jolt-physics): the same as the C++ of docs/export.md. Dropped for 6 s, with
// separation and limits measured by our formulas.
import initJolt from 'jolt-physics';
import path from 'node:path';
import { Checks, conjugate, length, measure, multiply, ourRestHeight, profileOf, rotate, subtract, add } from './lib.mjs';

const [model, folder] = process.argv.slice(2);
const stem = path.parse(model).name;
const profile = profileOf(model, path.join(folder, `${stem}.ragdoll.json`));
const Jolt = await initJolt();

// What is made with `new` is owned here and freed with the process: a test need not do more.
const vec3 = (v) => new Jolt.Vec3(...v);
const rvec3 = (v) => new Jolt.RVec3(...v);
const quat = (q) => new Jolt.Quat(...q);

const kLayer = 0; // of all that moves
const kFloorLayer = 1;

function makeWorld() {
  const settings = new Jolt.JoltSettings();
  const pairs = new Jolt.ObjectLayerPairFilterTable(2);
  pairs.EnableCollision(kLayer, kLayer);
  pairs.EnableCollision(kLayer, kFloorLayer);
  const broad = new Jolt.BroadPhaseLayerInterfaceTable(2, 2);
  broad.MapObjectToBroadPhaseLayer(kLayer, new Jolt.BroadPhaseLayer(0));
  broad.MapObjectToBroadPhaseLayer(kFloorLayer, new Jolt.BroadPhaseLayer(1));
  settings.mObjectLayerPairFilter = pairs;
  settings.mBroadPhaseLayerInterface = broad;
  settings.mObjectVsBroadPhaseLayerFilter = new Jolt.ObjectVsBroadPhaseLayerFilterTable(broad, 2, pairs, 2);
  const world = new Jolt.JoltInterface(settings);
  const floor = new Jolt.BodyCreationSettings(new Jolt.BoxShape(vec3([50, 1, 50]), 0.05), rvec3([0, -1, 0]), quat([0, 0, 0, 1]), Jolt.EMotionType_Static, kFloorLayer);
  // Jolt takes the root of both sides' product, we the product (src/physics/collision/friction.hpp): hence the squares.
  floor.mFriction = 0.8 ** 2;
  const bodies = world.GetPhysicsSystem().GetBodyInterface();
  bodies.AddBody(bodies.CreateBody(floor).GetID(), Jolt.EActivation_DontActivate);
  return world;
}

/** Bodies in the neutral pose, from the frames alone; the first one at the origin. */
function neutralPose() {
  const pose = { [profile.bodies[0].name]: { p: [0, 0, 0], q: [0, 0, 0, 1] } };
  for (const c of profile.constraints) {
    const parent = pose[c.parent];
    const q = multiply(multiply(parent.q, c.parentFromFrame.rotation), conjugate(c.childFromFrame.rotation));
    const anchor = add(parent.p, rotate(parent.q, c.parentFromFrame.translation));
    pose[c.child] = { q, p: add(anchor, rotate(q, c.childFromFrame.translation.map((x) => -x))) };
  }
  return pose;
}

function simpleShape({ kind, radius, halfLength, halfExtents, points }) {
  if (kind === 'hull') {
    const hull = new Jolt.ConvexHullShapeSettings();
    for (const point of points) hull.mPoints.push_back(vec3(point));
    return hull;
  }
  if (kind === 'capsule') return new Jolt.CapsuleShapeSettings(halfLength, radius);
  if (kind === 'sphere') return new Jolt.SphereShapeSettings(radius);
  return new Jolt.BoxShapeSettings(vec3(halfExtents), 0.01);
}

/** A compound's centre of mass is its parts'; the body's, which the constraints are told from, is at its origin. */
function shapeOf(shape) {
  if (!shape.more) return simpleShape(shape).Create().Get();
  const all = new Jolt.StaticCompoundShapeSettings();
  all.AddShape(vec3([0, 0, 0]), quat([0, 0, 0, 1]), simpleShape(shape), 0);
  for (const added of shape.more)
    all.AddShape(vec3(added.bodyFromShape.translation), quat(added.bodyFromShape.rotation), simpleShape(added), 0);
  const off = all.Create().Get().GetCenterOfMass();
  return new Jolt.OffsetCenterOfMassShapeSettings(vec3([-off.GetX(), -off.GetY(), -off.GetZ()]), all).Create().Get();
}

function constraintOf(c) {
  const axis = (frame, v) => vec3(rotate(frame.rotation, v));
  const x = [1, 0, 0];
  const z = [0, 0, 1];
  if (c.kind === 'hinge') {
    const hinge = new Jolt.HingeConstraintSettings();
    hinge.mSpace = Jolt.EConstraintSpace_LocalToBodyCOM;
    hinge.mPoint1 = rvec3(c.parentFromFrame.translation);
    hinge.mHingeAxis1 = axis(c.parentFromFrame, z);
    hinge.mNormalAxis1 = axis(c.parentFromFrame, x);
    hinge.mPoint2 = rvec3(c.childFromFrame.translation);
    hinge.mHingeAxis2 = axis(c.childFromFrame, z);
    hinge.mNormalAxis2 = axis(c.childFromFrame, x);
    hinge.mLimitsMin = c.hinge.lower;
    hinge.mLimitsMax = c.hinge.upper;
    hinge.mMaxFrictionTorque = c.frictionNm;
    return hinge;
  }
  const cone = new Jolt.SwingTwistConstraintSettings();
  cone.mSpace = Jolt.EConstraintSpace_LocalToBodyCOM;
  cone.mPosition1 = rvec3(c.parentFromFrame.translation);
  cone.mTwistAxis1 = axis(c.parentFromFrame, x);
  cone.mPlaneAxis1 = axis(c.parentFromFrame, z);
  cone.mPosition2 = rvec3(c.childFromFrame.translation);
  cone.mTwistAxis2 = axis(c.childFromFrame, x);
  cone.mPlaneAxis2 = axis(c.childFromFrame, z);
  cone.mSwingType = Jolt.ESwingType_Cone;
  cone.mPlaneHalfConeAngle = c.cone.swingY;
  cone.mNormalHalfConeAngle = c.cone.swingZ;
  cone.mTwistMinAngle = -c.cone.twist;
  cone.mTwistMaxAngle = c.cone.twist;
  cone.mMaxFrictionTorque = c.frictionNm;
  return cone;
}

/** The ragdoll with its first body at `worldFromHips`. */
function makeRagdoll(system, worldFromHips) {
  const settings = new Jolt.RagdollSettings();
  const skeleton = new Jolt.Skeleton();
  const index = Object.fromEntries(profile.bodies.map((b, i) => [b.name, i]));
  const filter = new Jolt.GroupFilterTable(profile.bodies.length);
  profile.bodies.forEach((b, i) => skeleton.AddJoint(new Jolt.JPHString(b.name, b.name.length), i ? index[profile.constraints[i - 1].parent] : -1));
  for (const c of profile.constraints) filter.DisableCollision(index[c.parent], index[c.child]);
  for (const [a, b] of profile.filteredPairs) filter.DisableCollision(index[a], index[b]);
  settings.mSkeleton = skeleton;
  settings.mParts.resize(profile.bodies.length);
  profile.bodies.forEach((b, i) => {
    const part = settings.mParts.at(i);
    part.SetShape(shapeOf(b.shape));
    part.mPosition = rvec3(add(worldFromHips.p, rotate(worldFromHips.q, pose[b.name].p)));
    part.mRotation = quat(multiply(worldFromHips.q, pose[b.name].q));
    part.mMotionType = Jolt.EMotionType_Dynamic;
    part.mObjectLayer = kLayer;
    part.mFriction = 0.5 ** 2;
    part.mOverrideMassProperties = Jolt.EOverrideMassProperties_MassAndInertiaProvided;
    part.mMassPropertiesOverride.mMass = b.massKg;
    part.mMassPropertiesOverride.mInertia = Jolt.Mat44.prototype.sScaleVec3(vec3(b.inertia));
    part.mCollisionGroup = new Jolt.CollisionGroup(filter, 0, i);
    if (i) part.mToParent = constraintOf(profile.constraints[i - 1]);
  });
  settings.CalculateBodyIndexToConstraintIndex();
  settings.CalculateConstraintIndexToBodyIdxPair();
  const ragdoll = settings.CreateRagdoll(0, 0, system);
  ragdoll.AddToPhysicsSystem(Jolt.EActivation_Activate);
  return ragdoll;
}

const pose = neutralPose();
const isHuman = ['hips', 'leftUpperLeg', 'rightUpperLeg'].every((name) => pose[name]);

/** Turns the figure of neutralPose() onto its back: head towards -z, face up, left at +x, as our drop begins. */
function lyingOnBack() {
  const unit = (v) => v.map((x) => x / length(v));
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const top = ['head', 'upperChest', 'chest', 'spine'].find((name) => pose[name]);
  const up = unit(subtract(pose[top].p, pose.hips.p));
  const front = unit(cross(subtract(pose.leftUpperLeg.p, pose.rightUpperLeg.p), up));
  const left = cross(up, front);
  // Rows: where left, front and up go: +x, +y, -z.
  const [r0, r1, r2] = [left, front, up.map((x) => -x)];
  const w = Math.sqrt(Math.max(0, 1 + r0[0] + r1[1] + r2[2])) / 2;
  const x = Math.sign(r2[1] - r1[2]) * Math.sqrt(Math.max(0, 1 + r0[0] - r1[1] - r2[2])) / 2;
  const y = Math.sign(r0[2] - r2[0]) * Math.sqrt(Math.max(0, 1 - r0[0] + r1[1] - r2[2])) / 2;
  const z = Math.sign(r1[0] - r0[1]) * Math.sqrt(Math.max(0, 1 - r0[0] - r1[1] + r2[2])) / 2;
  return [x, y, z, w];
}

const world = makeWorld();
const system = world.GetPhysicsSystem();
const physics = system.GetPhysicsSettings();
physics.mNumVelocitySteps = 20;
physics.mNumPositionSteps = 10;
system.SetPhysicsSettings(physics);
const ragdoll = makeRagdoll(system, { p: [0, 1.2, 0], q: isHuman ? lyingOnBack() : [0, 0, 0, 1] });
const checks = new Checks(`Jolt ${stem}`);
checks.that(ragdoll.GetBodyCount() === profile.bodies.length, 'number of bodies');
checks.that(ragdoll.GetConstraintCount() === profile.constraints.length, 'number of constraints');

const bodyInterface = system.GetBodyInterface();
function state(i) {
  const id = ragdoll.GetBodyID(i);
  const p = bodyInterface.GetPosition(id);
  const at = [p.GetX(), p.GetY(), p.GetZ()];
  const r = bodyInterface.GetRotation(id);
  return { p: at, q: [r.GetX(), r.GetY(), r.GetZ(), r.GetW()] };
}
const states = () => Object.fromEntries(profile.bodies.map((b, i) => [b.name, state(i)]));

let separation = 0;
let violation = 0;
const substeps = 4;
for (let step = 0; step < 360; step++) {
  world.Step(1 / 60, substeps);
  const now = states();
  for (const c of profile.constraints) {
    const m = measure(c, now[c.parent], now[c.child]);
    separation = Math.max(separation, m.separation);
    violation = Math.max(violation, m.violation);
  }
}
const end = states();
checks.that(Object.values(end).every((b) => [...b.p, ...b.q].every(Number.isFinite)), 'all numbers are finite');
const rest = profile.bodies.reduce((sum, b) => sum + b.massKg * end[b.name].p[1], 0) / profile.totalMassKg;
// Long chains of thin links part under any solver that goes from joint to joint.
checks.that(separation < (isHuman ? 0.02 : 0.15), `joints stay together: ${separation} m`);
checks.that(violation < (isHuman ? 0.26 : 0.35), `limits hold: ${(violation * 180) / Math.PI} degrees past`);
// The neutral pose of a creature stands no way that our drop knows.
const ours = isHuman ? ourRestHeight(model, profile, folder) : NaN;
if (isHuman) checks.that(Math.abs(rest - ours) < 0.05, `height of the centre of mass at rest: ${rest}, ours ${ours}`);
checks.fact(`separation ${(1000 * separation).toFixed(1)} mm, ${((violation * 180) / Math.PI).toFixed(1)} degrees past limits at most`);
checks.fact(`rests at ${rest.toFixed(3)} m${isHuman ? `, ours at ${ours.toFixed(3)} m` : ''}`);
checks.end();
