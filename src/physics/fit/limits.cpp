#include "physics/fit/limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "core/swing_twist.hpp"
#include "physics/fit/range_of_motion.hpp"
#include "physics/fit/segment_range.hpp"

namespace lutka::physics {
namespace {

constexpr float kSpare = 2.0F;  // degrees
constexpr float kWidest = 175.0F;

// The frames of a hinge share their z in the bind pose, whatever lies out of its plane; they agree when the child is
// turned from its bind angle to the neutral one.
JointFrames hingeFrames(const BodyPlan& plan, const vec3& axis, int child, float neutralFlexion) {
    const PlannedBody& body = plan.bodies[child];
    const vec3 x = body.direction();
    const vec3 upper = plan.bodies[body.parent].direction();
    const vec3 inPlane = upper - glm::dot(upper, axis) * axis;
    const float flexion = std::atan2(glm::dot(glm::cross(inPlane, x), axis), glm::dot(inPlane, x));
    const quat frame = rotationFromXY(x, glm::cross(axis, x));
    return {glm::angleAxis(neutralFlexion - flexion, axis) * frame, frame, body.start};
}

std::string widenHinge(HingeLimits& limits, float angle, std::string_view child) {
    const float lower = std::max(std::min(limits.lower, angle - radians(kSpare)), -kPi);
    const float upper = std::min(std::max(limits.upper, angle + radians(kSpare)), kPi);
    if (lower == limits.lower && upper == limits.upper) return {};
    const float by = degrees(std::max(limits.lower - lower, upper - limits.upper));
    limits = {lower, upper};
    return fmt::format("{}: hinge widened by {:.1f} degrees to hold the bind pose", child, by);
}

constexpr float kFarthest = radians(200.0F);  // from the bind pose to the far side of a range

// A twist is as wide to both sides as well. Where knees bend forwards, or feet lie far before their shins, the bind
// pose is nearly half a turn of twist from a man's: then the twist is counted from the bind pose. Returns the angle
// between the two.
float turnTowards(ConstraintProfile& constraint, float twist) {
    if (2.0F * std::abs(twist) + radians(kSpare) < kFarthest) return 0.0F;
    const quat turn = glm::angleAxis(twist, vec3(1, 0, 0));
    constraint.parentFromFrame.rotation = glm::normalize(constraint.parentFromFrame.rotation * turn);
    return twist;
}

// A cone is as wide to both sides of its middle: widened for a pose far from it, it would reach round the back. So the
// middle moves half the way that is missing, and the cone is widened by the other half: what it held it holds, and it
// reaches the pose. It moves farther where the far side would still be out of any joint's reach. Returns how far, in
// radians; 0 where the pose is near enough.
float moveTowards(ConstraintProfile& constraint, const SwingTwist& pose) {
    const float angle = glm::length(pose.swing);
    const float filled = std::hypot(pose.swing.y / constraint.cone.swingY, pose.swing.z / constraint.cone.swingZ);
    const float missing = filled > 1.0F ? angle + radians(kSpare) - angle / filled : 0.0F;
    if (missing <= 0.0F || 2.0F * angle + radians(kSpare) < kFarthest) return 0.0F;
    const float farSide = 2.0F * (angle + radians(kSpare)) - kFarthest;
    const float way = std::clamp(0.5F * farSide, 0.5F * missing, missing);
    const quat turn = rotationOf({pose.swing * (way / angle), 0.0F});
    constraint.parentFromFrame.rotation = glm::normalize(constraint.parentFromFrame.rotation * turn);
    return way;
}

std::string widenCone(ConeTwistLimits& limits, const SwingTwist& pose, bool isFar, std::string_view child) {
    std::string note;
    const float angle = glm::length(pose.swing);
    const float filled = std::hypot(pose.swing.y / limits.swingY, pose.swing.z / limits.swingZ);
    const float factor = angle > 1e-4F ? filled * (angle + radians(kSpare)) / angle : 0.0F;
    if (factor > 1.0F) {
        note = fmt::format("{}: cone of {:.0f} by {:.0f} degrees widened {:.2f} times to hold the bind pose", child,
                           degrees(limits.swingY), degrees(limits.swingZ), factor);
        const ConeTwistLimits before = limits;
        const auto widenTo = [&](float swingY, float swingZ) {
            limits.swingY = std::max(before.swingY, swingY);
            limits.swingZ = std::max(before.swingZ, swingZ);
        };
        const auto isTooFar = [&] {
            return std::max(limits.swingY + std::abs(pose.swing.y), limits.swingZ + std::abs(pose.swing.z)) > kFarthest;
        };
        widenTo(factor * before.swingY, factor * before.swingZ);
        const float widest = std::max(limits.swingY, limits.swingZ);
        // A narrow cone need not widen its wide side as much: what fills half of each axis fills the ellipse.
        const float spare = (angle + radians(kSpare)) / angle;
        const vec3 half = std::sqrt(2.0F) * spare * glm::abs(pose.swing);
        const bool narrower = std::max({half.y, half.z, before.swingY, before.swingZ}) < widest;
        if ((isFar || widest > radians(kWidest) || isTooFar()) && narrower) widenTo(half.y, half.z);
        // A circle reaches no farther than the pose itself.
        if (isTooFar()) widenTo(spare * angle, spare * angle);
        limits.swingY = std::min(limits.swingY, radians(kWidest));
        limits.swingZ = std::min(limits.swingZ, radians(kWidest));
    }
    const float twist = std::min(std::abs(pose.twist) + radians(kSpare), radians(kWidest));
    if (twist > limits.twist) {
        if (!note.empty()) note += "; ";
        note += fmt::format("{}: twist of {:.0f} degrees widened to {:.0f} to hold the bind pose", child,
                            degrees(limits.twist), degrees(twist));
        limits.twist = twist;
    }
    return note;
}

}  // namespace

JointFrames jointFrames(const BodyPlan& plan, const Anatomy& anatomy, int child) {
    const PlannedBody& body = plan.bodies[child];
    if (!body.role) {
        const quat frame = segmentFrame(plan, child);
        return {frame, frame, body.start};
    }
    const RangeOfMotion range = rangeOfMotion(plan, *body.role);
    const vec3& axis = anatomy.flexionAxis[child];
    if (range.kind == ConstraintProfile::Kind::hinge && glm::length(axis) > 0.5F) {
        return hingeFrames(plan, axis, child, range.neutralFlexion);
    }
    const quat frame = standingFrame(*body.role);
    return {anatomy.standardFromAnatomy[body.parent] * range.neutral * frame,
            anatomy.standardFromAnatomy[child] * frame, body.start};
}

void setFrames(ConstraintProfile& constraint, const JointFrames& frames, const RigidTransform& standardFromParent,
               const RigidTransform& standardFromChild) {
    constraint.parentFromFrame = inverse(standardFromParent) * RigidTransform{frames.parent, frames.anchor};
    constraint.childFromFrame = inverse(standardFromChild) * RigidTransform{frames.child, frames.anchor};
    constraint.parentFromFrame.rotation = glm::normalize(constraint.parentFromFrame.rotation);
    constraint.childFromFrame.rotation = glm::normalize(constraint.childFromFrame.rotation);
}

void setRange(ConstraintProfile& constraint, const BodyPlan& plan, int child) {
    const PlannedBody& body = plan.bodies[child];
    if (!body.role) return setSegmentRange(constraint, body);
    const RangeOfMotion range = rangeOfMotion(plan, *body.role);
    constraint.kind = range.kind;
    constraint.hinge = range.hinge;
    constraint.cone = range.cone;
}

std::vector<ConstraintProfile> makeConstraints(const BodyPlan& plan, const Anatomy& anatomy,
                                               const std::vector<PlacedShape>& shapes,
                                               std::vector<std::string>& notes) {
    std::vector<ConstraintProfile> constraints;
    for (int child = 1; child < static_cast<int>(plan.bodies.size()); ++child) {
        const PlannedBody& body = plan.bodies[child];
        ConstraintProfile& constraint = constraints.emplace_back();
        constraint.parent = body.parent;
        constraint.child = child;
        setRange(constraint, plan, child);
        const RigidTransform& parentBody = shapes[body.parent].standardFromBody;
        const RigidTransform& childBody = shapes[child].standardFromBody;
        setFrames(constraint, jointFrames(plan, anatomy, child), parentBody, childBody);
        std::string note = widenToHold(constraint, parentBody, childBody, body.name);
        if (!note.empty()) notes.push_back(std::move(note));
    }
    return constraints;
}

std::string widenToHold(ConstraintProfile& constraint, const RigidTransform& worldFromParent,
                        const RigidTransform& worldFromChild, std::string_view child) {
    const quat childFrame = worldFromChild.rotation * constraint.childFromFrame.rotation;
    const auto relativePose = [&] {
        return glm::conjugate(worldFromParent.rotation * constraint.parentFromFrame.rotation) * childFrame;
    };
    const quat relative = relativePose();
    if (constraint.kind == ConstraintProfile::Kind::hinge) {
        const float angle = 2.0F * std::atan2(relative.z, relative.w);
        return widenHinge(constraint.hinge, std::remainder(angle, 2.0F * kPi), child);
    }
    SwingTwist pose = swingTwist(relative);
    const float turned = turnTowards(constraint, pose.twist);
    if (turned != 0.0F) pose = swingTwist(relativePose());
    const float moved = moveTowards(constraint, pose);
    if (moved > 0.0F) pose.swing *= 1.0F - moved / glm::length(pose.swing);
    std::string note = widenCone(constraint.cone, pose, moved > 0.0F, child);
    if (moved > 0.0F) note += fmt::format("; its middle moved by {:.0f} degrees towards it", degrees(moved));
    if (turned != 0.0F) {
        note += fmt::format("{}twist is counted from the bind pose, {:.0f} degrees from a man's",
                            note.empty() ? fmt::format("{}: ", child) : "; ", degrees(std::abs(turned)));
    }
    return note;
}

void setJointFriction(RagdollProfile& profile) {
    constexpr float kShare = 1.0F / 40.0F;
    constexpr float kGravity = 9.81F;
    const std::size_t count = profile.bodies.size();
    // Mass of each body with all below it, and its moment arm about the body's own joint, stretched out straight.
    std::vector<float> mass(count, 0.0F);
    std::vector<float> moment(count, 0.0F);
    for (std::size_t child = count; child-- > 1;) {
        ConstraintProfile& constraint = profile.constraints[child - 1];
        const float arm = glm::length(constraint.childFromFrame.translation);
        mass[child] += profile.bodies[child].massKg;
        moment[child] += profile.bodies[child].massKg * arm;
        constraint.frictionNm = kShare * kGravity * moment[child];
        if (constraint.parent == 0) continue;
        const ConstraintProfile& above = profile.constraints[constraint.parent - 1];
        const float reach = glm::distance(constraint.parentFromFrame.translation, above.childFromFrame.translation);
        mass[constraint.parent] += mass[child];
        moment[constraint.parent] += moment[child] + mass[child] * reach;
    }
}

}  // namespace lutka::physics
