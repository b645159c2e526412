#include "scene/puppet/shown_motion.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "physics/profile/within_limits.hpp"

namespace lutka::scene {
namespace {

using physics::BodyState;

constexpr float kMostTurn = radians(330.0F);  // rad/s of a joint of what is shown
constexpr float kStillMps = 0.1F;             // over the ground: a foot that moves no faster may stay on it,
constexpr float kSwingMps = 0.5F;             // one that moves so fast
constexpr float kSwingM = 0.03F;              // is lifted so high
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

}  // namespace

ShownMotion::ShownMotion(const RagdollAsset& asset, const FloorKeeper& floor) : asset_(&asset), floor_(&floor) {
    feet_[0].body = physics::bodyOf(asset.profile, physics::Role::leftFoot);
    feet_[1].body = physics::bodyOf(asset.profile, physics::Role::rightFoot);
}

void ShownMotion::setPose(std::span<const RigidTransform> pose) {
    to_.assign(pose.begin(), pose.end());
    from_ = raw_ = to_;
}

void ShownMotion::follow(std::span<const BodyState> bodies, float dt) {
    from_.clear();
    to_.clear();
    for (const BodyState& body : bodies) {
        from_.push_back(before(body, dt));
        to_.push_back(body.worldFromBody);
    }
    for (Foot& foot : feet_) {
        foot.aim.reset();
        foot.lift = 0.0F;
    }
}

void ShownMotion::blendIntoRaw(float dt) {
    std::vector<RigidTransform> shownBefore, shown, aim;
    const physics::Rig& rig = asset_->rig;
    relativeOf(rig, from_, shownBefore);
    relativeOf(rig, to_, shown);
    relativeOf(rig, raw_, aim);
    blend_.begin(shownBefore, shown, aim, aim, dt);
}

void ShownMotion::advance(const Step& step) {
    std::swap(from_, to_);
    to_ = raw_;
    blend_.advance(step.dt);
    const bool blends = !blend_.isOver();
    if (blends) blend();
    const bool steps = step.mayStep && stepsBack(step.bodies);
    if (!blends && !step.rises && !isHeldBack_ && !steps) {
        for (Foot& foot : feet_)
            foot.aim.reset();
        return;
    }
    if (step.rises) keepLimits();
    floor_->closeJoints(to_);
    if (blends || step.rises || steps) {
        liftFeet(step, blends || step.rises);
        floor_->keep(step.ground, to_, clearance_);
    }
    isHeldBack_ = holdBack(step.dt);
}

void ShownMotion::blend() {
    relativeOf(asset_->rig, to_, relative_);
    blend_.apply(relative_);
    to_[0] = relative_[0];
    for (std::size_t body = 1; body < relative_.size(); ++body)
        to_[body] = to_[asset_->rig.parentBody[body]] * relative_[body];
}

float ShownMotion::mostFootLag(std::span<const BodyState> bodies) const {
    float lag = 0.0F;
    for (const Foot& foot : feet_)
        if (foot.body >= 0)
            lag = std::max(lag, glm::distance(bodies[foot.body].worldFromBody.translation, to_[foot.body].translation));
    return lag;
}

// How far a foot is from where it was to be, over the ground.
float ShownMotion::lagOf(const Foot& foot, std::span<const BodyState> bodies) const {
    const vec3 way = from_[foot.body].translation - bodies[foot.body].worldFromBody.translation;
    return std::hypot(way.x, way.z);
}

// Whether a foot was pushed away from where it stands, or is on its way back.
bool ShownMotion::stepsBack(std::span<const BodyState> bodies) const {
    return std::any_of(feet_.begin(), feet_.end(), [&](const Foot& foot) {
        return foot.body >= 0 && (foot.lift > 0.0F || lagOf(foot, bodies) > kCaughtM);
    });
}

// A foot that is not where it is to be is lifted, the higher the farther it is off: it steps there instead of being
// dragged. On the way up (`swings`) so is one that moves over the ground, which would be caught there; that is told by
// where it would be without being lifted.
void ShownMotion::liftFeet(const Step& step, bool swings) {
    clearance_.assign(to_.size(), 0.0F);
    for (Foot& foot : feet_) {
        if (foot.body < 0) continue;
        const vec3 now = to_[foot.body].translation;
        const vec3 way = now - foot.aim.value_or(now);
        foot.aim = now;
        const float speed = swings ? std::hypot(way.x, way.z) / step.dt : 0.0F;
        const float share = std::clamp((speed - kStillMps) / (kSwingMps - kStillMps), 0.0F, 1.0F);
        const float off = std::clamp((lagOf(foot, step.bodies) - kCaughtM) / (kFarCaughtM - kCaughtM), 0.0F, 1.0F);
        const float wanted = std::max(kSwingM * eased(share), kFreeM * eased(off));
        foot.lift += std::clamp(wanted - foot.lift, -kLiftMps * step.dt, kLiftMps * step.dt);
        clearance_[foot.body] = foot.lift;
    }
}

// A wrist can't go to where its limits hold it: what its motor still asks of it there it does all at once when the
// floor lets go of the hand.
void ShownMotion::keepLimits() {
    for (const physics::ConstraintProfile& joint : asset_->profile.constraints) {
        const auto& role = asset_->profile.bodies[joint.child].role;
        if (role != physics::Role::leftHand && role != physics::Role::rightHand) continue;
        const quat& parent = to_[joint.parent].rotation;
        const quat before = to_[joint.child].rotation;
        const quat after = glm::normalize(parent * physics::withinLimits(joint, glm::conjugate(parent) * before));
        const quat turn = after * glm::conjugate(before);
        to_[joint.child].rotation = after;
        // What the hand holds, and fingers, turn with it.
        const auto& joints = asset_->profile.constraints;  // each hangs on a body before it
        for (std::size_t body = joint.child + 1; body < to_.size(); ++body) {
            int above = static_cast<int>(body);
            while (above > joint.child)
                above = joints[above - 1].parent;
            if (above == joint.child) to_[body].rotation = glm::normalize(turn * to_[body].rotation);
        }
    }
}

// No joint of what is shown turns faster than kMostTurn: limbs that the floor bends and hasty clips come after.
bool ShownMotion::holdBack(float dt) {
    relativeOf(asset_->rig, from_, before_);
    relativeOf(asset_->rig, to_, relative_);
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
        to_[body].rotation = glm::normalize(to_[asset_->rig.parentBody[body]].rotation * relative_[body].rotation);
    }
    if (held) floor_->closeJoints(to_);
    return held;
}

}  // namespace lutka::scene
