/// PuppetCast: from lying limp to standing.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "physics/collision/shape.hpp"
#include "physics/profile/within_limits.hpp"
#include "scene/puppet_cast.hpp"

namespace lutka::scene {
namespace {

using physics::BodyState;
using physics::PuppetState;

constexpr float kRestSpeed = 0.12F;           // m/s, root of the mean square by mass: slower is at rest
constexpr float kRestTurn = 3.0F;             // rad/s of any body: a hand that still swings is hardly felt in the mean
constexpr float kRestSeconds = 0.3F;          // for so long, before it gets up
constexpr float kStrengthSeconds = 0.3F;      // in which its strength comes
constexpr float kSlowStart = 0.4F;            // of the clip's speed, while the doll is still on its way into it
constexpr float kMostTurn = radians(330.0F);  // rad/s of a joint on the way
constexpr float kRayM = 10.0F;
constexpr float kLagM = 0.06F;      // a foot that is farther behind its aim slows the clip down,
constexpr float kMostLagM = 0.16F;  // so much that it hardly goes on
constexpr float kMostWaitSeconds = 0.5F;
constexpr float kLeastPace = 0.06F;     // of the clip's speed
constexpr float kFootStillMps = 0.06F;  // a foot of the pose that is slower stands
constexpr float kFootLowM = 0.03F;      // and is lower over the ground
constexpr float kFootFlat = radians(20.0F);
constexpr float kStillMps = 0.1F;     // over the ground: a foot that moves no faster may stay on it,
constexpr float kSwingMps = 0.5F;     // one that moves so fast
constexpr float kSwingM = 0.03F;      // is lifted so high
constexpr float kCaughtM = 0.04F;     // over the ground: a foot that is farther from its aim than this is lifted,
constexpr float kFarCaughtM = 0.14F;  // one that is so far
constexpr float kFreeM = 0.10F;       // by so much,
constexpr float kLiftMps = 0.6F;      // no faster than that

float eased(float t) {
    return t * t * (3.0F - 2.0F * t);
}

// Frames relative to the parent bodies'; the root's stays in the world.
void relativeOf(const physics::Rig& rig, std::span<const RigidTransform> world, std::vector<RigidTransform>& relative) {
    relative.resize(world.size());
    relative[0] = world[0];
    for (std::size_t body = 1; body < world.size(); ++body)
        relative[body] = inverse(world[rig.parentBody[body]]) * world[body];
}

// Where a body was `dt` seconds ago.
RigidTransform before(const BodyState& body, float dt) {
    const vec3 turn = body.angularVelocity * -dt;
    const float angle = glm::length(turn);
    const quat back = angle > 1e-7F ? glm::angleAxis(angle, turn / angle) : quat(1, 0, 0, 0);
    return {glm::normalize(back * body.worldFromBody.rotation),
            body.worldFromBody.translation - body.linearVelocity * dt};
}

// The turn about the vertical that is in a rotation.
quat headingOf(const quat& turn) {
    const float length = std::hypot(turn.w, turn.y);
    return length > 1e-4F ? quat(turn.w / length, 0, turn.y / length, 0) : quat(1, 0, 0, 0);
}

}  // namespace

// Far below there is ground in any case.
float PuppetCast::groundBelow(const vec3& point) const {
    const vec3 lowest = point - vec3(0, kRayM, 0);
    const auto hit = groundOn(point, lowest);
    return hit ? hit->height : lowest.y;
}

void PuppetCast::watchRest(Actor& actor, float dt) {
    if (actor.puppet->state() != PuppetState::limp) {
        actor.rest = 0.0F;
        return;
    }
    actor.rising.reset();
    bodies_.resize(actor.asset->profile.bodies.size());
    world_->getBodies(actor.puppet->doll(), bodies_);
    float energy = 0.0F;
    float mass = 0.0F;
    float turn = 0.0F;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        turn = std::max(turn, glm::length(bodies_[i].angularVelocity));
        const float m = actor.asset->profile.bodies[i].massKg;
        energy += m * glm::dot(bodies_[i].linearVelocity, bodies_[i].linearVelocity);
        mass += m;
    }
    const bool isSlow = energy < mass * kRestSpeed * kRestSpeed && turn < kRestTurn;
    const bool rests = isSlow || world_->isAsleep(actor.puppet->doll());
    actor.rest = rests ? actor.rest + dt : 0.0F;
    if (actor.rest >= kRestSeconds) beginRising(actor, dt);
}

// From where the doll lies, bodies_, into the frame that is most like it.
void PuppetCast::beginRising(Actor& actor, float dt) {
    GetUpClips& clips = *getUps_[actor.assetIndex];
    now_.resize(bodies_.size());
    before_.resize(bodies_.size());
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        now_[i] = bodies_[i].worldFromBody;
        before_[i] = before(bodies_[i], dt);
    }
    actor.ground = groundBelow(now_[actor.root].translation);
    actor.rising = clips.match(now_, actor.ground);
    actor.risen = actor.rising->seconds;
    actor.waited = 0.0F;
    actor.risingSeconds = actor.rest;
    actor.from = before_;
    actor.to = now_;
    actor.raw.resize(now_.size());
    clips.sample(*actor.rising, actor.risen, actor.raw);
    blendInto(actor, actor.raw, actor.raw, dt);
    actor.puppet->getUp(kStrengthSeconds);
    actor.joints.clear();
    for (Actor::Foot& foot : actor.feet) {
        foot.aim.reset();
        foot.lift = 0.0F;
    }
    ++risen_.begun;
    matchedM_ += static_cast<double>(actor.rising->distanceM);
}

// From what is shown into a motion that went from `rawBefore` to `raw` in a step.
void PuppetCast::blendInto(Actor& actor, std::span<const RigidTransform> rawBefore, std::span<const RigidTransform> raw,
                           float dt) {
    std::vector<RigidTransform> shownBefore, shown, aimBefore, aim;
    const physics::Rig& rig = actor.asset->rig;
    relativeOf(rig, actor.from, shownBefore);
    relativeOf(rig, actor.to, shown);
    relativeOf(rig, rawBefore, aimBefore);
    relativeOf(rig, raw, aim);
    actor.blend.begin(shownBefore, shown, aimBefore, aim, dt);
}

// What the doll is to do: the raw motion, blended into, and out of the floor while that is not sure.
void PuppetCast::show(Actor& actor, float dt) {
    std::swap(actor.from, actor.to);
    actor.to = actor.raw;
    actor.blend.advance(dt);
    const bool blends = !actor.blend.isOver();
    if (blends) {
        relativeOf(actor.asset->rig, actor.to, relative_);
        actor.blend.apply(relative_);
        actor.to[0] = relative_[0];
        for (std::size_t body = 1; body < relative_.size(); ++body)
            actor.to[body] = actor.to[actor.asset->rig.parentBody[body]] * relative_[body];
    }
    const bool steps = stepsBack(actor);
    if (!blends && !actor.rising && !actor.isHeldBack && !steps) {
        for (Actor::Foot& foot : actor.feet)
            foot.aim.reset();
        return;
    }
    if (actor.rising) keepLimits(actor);
    actor.floor->closeJoints(actor.to);
    const float level = levelOf(actor);
    if (blends || actor.rising || steps) {
        liftFeet(actor, dt, blends || actor.rising);
        actor.floor->keep([&](const vec3& point) { return isLevel_ ? level : groundBelow(point); }, actor.to,
                          clearance_);
    }
    actor.isHeldBack = holdBack(actor, dt);
}

std::span<const RigidTransform> PuppetCast::pose(int doll, float alpha) {
    const Actor& actor = actors_[doll];
    mixed_.resize(actor.to.size());
    for (std::size_t body = 0; body < mixed_.size(); ++body)
        mixed_[body] = interpolate(actor.from[body], actor.to[body], alpha);
    return mixed_;
}

// Height of the level floor that it is on.
float PuppetCast::levelOf(const Actor& actor) {
    return actor.rising ? actor.ground : actor.worldFromModel.translation.y + actor.soles - actor.lift;
}

// How far a foot is from where it was to be, over the ground. Bodies are in bodies_.
float PuppetCast::lagOf(const Actor& actor, const Actor::Foot& foot) const {
    const vec3 way = actor.from[foot.body].translation - bodies_[foot.body].worldFromBody.translation;
    return std::hypot(way.x, way.z);
}

// Whether a foot was pushed away from where it stands, or is on its way back. A doll that nothing holds up keeps its
// feet on the ground.
bool PuppetCast::stepsBack(const Actor& actor) {
    if (actor.puppet->settings().pinForceN <= 0.0F || !play_.led.empty()) return false;
    bodies_.resize(actor.to.size());
    world_->getBodies(actor.puppet->doll(), bodies_);
    return std::any_of(actor.feet.begin(), actor.feet.end(), [&](const Actor::Foot& foot) {
        return foot.body >= 0 && (foot.lift > 0.0F || lagOf(actor, foot) > kCaughtM);
    });
}

// A foot that is not where it is to be is lifted, the higher the farther it is off: it steps there instead of being
// dragged. On the way up (`swings`) so is one that moves over the ground, which would be caught there; that is told by
// where it would be without being lifted.
void PuppetCast::liftFeet(Actor& actor, float dt, bool swings) {
    clearance_.assign(actor.to.size(), 0.0F);
    bodies_.resize(actor.to.size());
    world_->getBodies(actor.puppet->doll(), bodies_);
    for (Actor::Foot& foot : actor.feet) {
        if (foot.body < 0) continue;
        const vec3 now = actor.to[foot.body].translation;
        const vec3 way = now - foot.aim.value_or(now);
        foot.aim = now;
        const float speed = swings ? std::hypot(way.x, way.z) / dt : 0.0F;
        const float share = std::clamp((speed - kStillMps) / (kSwingMps - kStillMps), 0.0F, 1.0F);
        const float off = std::clamp((lagOf(actor, foot) - kCaughtM) / (kFarCaughtM - kCaughtM), 0.0F, 1.0F);
        const float wanted = std::max(kSwingM * eased(share), kFreeM * eased(off));
        foot.lift += std::clamp(wanted - foot.lift, -kLiftMps * dt, kLiftMps * dt);
        clearance_[foot.body] = foot.lift;
    }
}

// A wrist can't go to where its limits hold it: what its motor still asks of it there it does all at once when the
// floor lets go of the hand.
void PuppetCast::keepLimits(Actor& actor) {
    for (const physics::ConstraintProfile& joint : actor.asset->profile.constraints) {
        const auto& role = actor.asset->profile.bodies[joint.child].role;
        if (role != physics::Role::leftHand && role != physics::Role::rightHand) continue;
        const quat& parent = actor.to[joint.parent].rotation;
        const quat before = actor.to[joint.child].rotation;
        const quat after = glm::normalize(parent * physics::withinLimits(joint, glm::conjugate(parent) * before));
        const quat turn = after * glm::conjugate(before);
        actor.to[joint.child].rotation = after;
        // What the hand holds, and fingers, turn with it.
        const auto& joints = actor.asset->profile.constraints;  // each hangs on a body before it
        for (std::size_t body = joint.child + 1; body < actor.to.size(); ++body) {
            int above = static_cast<int>(body);
            while (above > joint.child)
                above = joints[above - 1].parent;
            if (above == joint.child) actor.to[body].rotation = glm::normalize(turn * actor.to[body].rotation);
        }
    }
}

// No joint of what is shown turns faster than kMostTurn: limbs that the floor bends and hasty clips come after.
bool PuppetCast::holdBack(Actor& actor, float dt) {
    relativeOf(actor.asset->rig, actor.from, before_);
    relativeOf(actor.asset->rig, actor.to, relative_);
    bool held = false;
    for (std::size_t body = 1; body < relative_.size(); ++body) {
        const vec3 turn =
            rotationVector(glm::normalize(relative_[body].rotation * glm::conjugate(before_[body].rotation)));
        const float angle = glm::length(turn);
        if (angle > kMostTurn * dt) {
            held = true;
            relative_[body].rotation =
                glm::normalize(glm::angleAxis(kMostTurn * dt, turn / angle) * before_[body].rotation);
        }
        actor.to[body].rotation =
            glm::normalize(actor.to[actor.asset->rig.parentBody[body]].rotation * relative_[body].rotation);
    }
    if (held) actor.floor->closeJoints(actor.to);
    return held;
}

// The clip begins slowly and waits for feet that are behind: one that is caught on the floor or on the other leg would
// be dragged to where it is to stand.
float PuppetCast::paceOf(Actor& actor) {
    bodies_.resize(actor.asset->profile.bodies.size());
    world_->getBodies(actor.puppet->doll(), bodies_);
    float lag = 0.0F;
    for (const Actor::Foot& foot : actor.feet)
        if (foot.body >= 0)
            lag = std::max(
                lag, glm::distance(bodies_[foot.body].worldFromBody.translation, actor.to[foot.body].translation));
    // Some never come: it waits for less and less.
    const float least = std::max(kLeastPace, actor.waited / kMostWaitSeconds);
    const float keepsUp = std::clamp((kMostLagM - lag) / (kMostLagM - kLagM), std::min(least, 1.0F), 1.0F);
    actor.waited += dt_ * (1.0F - keepsUp);
    return keepsUp * (kSlowStart + (1.0F - kSlowStart) * actor.blend.share());
}

// The pin carries most of the doll on its way up, so that the ground holds a foot with little: a hip that turns a heavy
// trunk would push it away. It is held as by the friction of its share of the weight.
void PuppetCast::holdFeet(Actor& actor) {
    constexpr float kGrip = 0.25F;  // of the doll's weight
    for (const Actor::Foot& foot : actor.feet) {
        if (!foot.stands) continue;
        // As it is turned now, or the pull would snap a light foot over; bodies_ are those of now.
        const RigidTransform& now = bodies_[foot.body].worldFromBody;
        actor.puppet->hold(foot.body, {now.rotation, {foot.at.x, now.translation.y, foot.at.z}},
                           kGrip * actor.asset->profile.totalMassKg * glm::length(play_.gravity));
    }
}

void PuppetCast::rise(Actor& actor, float dt) {
    GetUpClips& clips = *getUps_[actor.assetIndex];
    actor.risingSeconds += dt;
    actor.pace = paceOf(actor);
    actor.risen += dt * actor.pace;
    clips.sample(*actor.rising, actor.risen, actor.raw);
    if (actor.risen >= clips.seconds(actor.rising->clip)) {
        standUp(actor, dt);
        return;
    }
    show(actor, dt);
    holdFeet(actor);
}

// On with the clip, over the place where it stands and as it heads.
void PuppetCast::standUp(Actor& actor, float dt) {
    actor.rising.reset();
    actor.puppet->stand();
    ++risen_.stood;
    risenSeconds_ += static_cast<double>(actor.risingSeconds);
    risen_.mostSeconds = std::max(risen_.mostSeconds, actor.risingSeconds);
    for (Actor::Foot& foot : actor.feet)
        foot.stands = false;
    const RigidTransform stands = actor.to[actor.root];
    actor.player->play(0, 0, {});
    actor.worldFromModel = {actor.asset->map.standardFromModel, {0, actor.ground + actor.lift - actor.soles, 0}};
    actor.base = actor.ground;
    pose(actor, now_);
    const quat heading = headingOf(glm::normalize(stands.rotation * glm::conjugate(now_[actor.root].rotation)));
    actor.worldFromModel.rotation = glm::normalize(heading * actor.worldFromModel.rotation);
    const vec3 shift = stands.translation - heading * now_[actor.root].translation;
    actor.worldFromModel.translation = heading * actor.worldFromModel.translation + vec3(shift.x, 0, shift.z);
    pose(actor, actor.raw);
    blendInto(actor, actor.raw, actor.raw, dt);
    playOn(actor, dt);
}

// Bodies are in frames_ after a step.
void PuppetCast::measureRising(Actor& actor) {
    const physics::RagdollProfile& profile = actor.asset->profile;
    const bool hadJoints = !actor.joints.empty();
    actor.joints.resize(profile.constraints.size());
    for (std::size_t i = 0; i < profile.constraints.size(); ++i) {
        const physics::ConstraintProfile& joint = profile.constraints[i];
        const quat now = glm::conjugate(frames_[joint.parent].rotation) * frames_[joint.child].rotation;
        const quat step = glm::normalize(now * glm::conjugate(actor.joints[i]));
        actor.joints[i] = now;
        const float turned = hadJoints ? degrees(glm::length(rotationVector(step))) : 0.0F;
        if (turned <= risen_.mostStepDeg) continue;
        risen_.mostStepDeg = turned;
        risen_.stepJoint = profile.bodies[joint.child].name;
    }
}

// How far feet slide that stand flat and still in the pose. Bodies are in frames_ after a step.
void PuppetCast::measureFeet(Actor& actor) {
    if (actor.puppet->state() == PuppetState::reacting) {
        // What strikes it may move its feet.
        for (Actor::Foot& foot : actor.feet)
            foot.stands = false;
        return;
    }
    const float level = levelOf(actor);
    for (Actor::Foot& foot : actor.feet) {
        if (foot.body < 0) continue;
        const RigidTransform& aim = actor.to[foot.body];
        animation::GroundHit ground{level, vec3(0, 1, 0)};
        if (!isLevel_) ground = footing(aim.translation).value_or(ground);
        const quat off = aim.rotation * glm::conjugate(actor.asset->rig.bindModelFromBody[foot.body].rotation) *
                         glm::conjugate(actor.asset->map.standardFromModel);
        const vec3 up = off * vec3(0, 1, 0);
        const float still = kFootStillMps * dt_ * (actor.rising ? actor.pace : 1.0F);
        const vec3 onGround(aim.translation.x, ground.height, aim.translation.z);
        const float above = glm::dot(aim.translation - onGround, ground.normal) -
                            physics::supportExtent(actor.asset->profile.bodies[foot.body].shape,
                                                   glm::conjugate(aim.rotation) * -ground.normal);
        const bool stands = glm::distance(aim.translation, actor.from[foot.body].translation) < still &&
                            above < kFootLowM && glm::dot(up, ground.normal) > std::cos(kFootFlat);
        const vec3 at = frames_[foot.body].translation;
        if (stands && !foot.stands) foot.at = at;
        foot.stands = stands;
        if (!stands) continue;
        const float slid = std::hypot(at.x - foot.at.x, at.z - foot.at.z);
        worst_.footSlideM = std::max(worst_.footSlideM, slid);
        if (actor.rising) risen_.mostSlideM = std::max(risen_.mostSlideM, slid);
    }
}

GetUpFigures PuppetCast::getUpFigures() const {
    GetUpFigures figures = risen_;
    if (risen_.stood > 0) figures.meanSeconds = static_cast<float>(risenSeconds_ / risen_.stood);
    if (risen_.begun > 0) figures.meanDistanceM = static_cast<float>(matchedM_ / risen_.begun);
    return figures;
}

}  // namespace lutka::scene
