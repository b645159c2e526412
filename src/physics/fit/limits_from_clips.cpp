#include "physics/fit/limits_from_clips.hpp"

#include <algorithm>
#include <cmath>

#include "animation/pose.hpp"
#include "physics/profile/constraint_state.hpp"

namespace lutka::physics {
namespace {

constexpr float kWidestClipSpan =
    0.98F * kPi;  // limits stay below half a turn, where swing and twist lose their meaning

// The largest angles of one joint over all frames so far, and each swing, since an ellipse is not a box.
struct Used {
    float hingeLower = 0.0F;
    float hingeUpper = 0.0F;
    float twist = 0.0F;
    std::vector<vec2> swings;
};

void take(const RagdollProfile& profile, std::span<const BodyState> bodies, std::vector<Used>& used) {
    for (std::size_t i = 0; i < profile.constraints.size(); ++i) {
        const ConstraintProfile& constraint = profile.constraints[i];
        const ConstraintState state = measureConstraint(constraint, bodies[constraint.parent].worldFromBody,
                                                        bodies[constraint.child].worldFromBody);
        used[i].hingeLower = std::min(used[i].hingeLower, state.hingeAngle);
        used[i].hingeUpper = std::max(used[i].hingeUpper, state.hingeAngle);
        used[i].twist = std::max(used[i].twist, std::abs(state.twist));
        used[i].swings.emplace_back(std::abs(state.swing.y), std::abs(state.swing.z));
    }
}

std::vector<Used> usedByClips(const RagdollProfile& profile, const Rig& rig, const animation::Character& character) {
    const animation::Skeleton& skeleton = character.skeleton;
    std::vector<Used> used(profile.constraints.size());
    std::vector<RigidTransform> pose(skeleton.parents.size());
    std::vector<BodyState> bodies(profile.bodies.size());
    bodiesFromPose(rig, skeleton.bindModelFromJoint, {}, bodies);
    take(profile, bodies, used);
    for (const animation::Clip& clip : character.clips) {
        for (int frame = 0; frame < clip.frameCount; ++frame) {
            const std::size_t first = static_cast<std::size_t>(frame) * pose.size();
            animation::localToModel(skeleton, std::span(clip.parentFromJoint).subspan(first, pose.size()), pose);
            bodiesFromPose(rig, pose, {}, bodies);
            take(profile, bodies, used);
        }
    }
    return used;
}

float withMargin(float angle) {
    return std::clamp(angle + kClipMargin, kLeastClipSpan, kWidestClipSpan);
}

HingeLimits hingeFor(const HingeLimits& before, const Used& used, ClipLimits mode) {
    const HingeLimits fitted{-withMargin(-used.hingeLower), withMargin(used.hingeUpper)};
    if (mode == ClipLimits::fit) return fitted;
    // A limit that holds the clips stays as it is: the margin is for those that must move.
    return {used.hingeLower < before.lower ? fitted.lower : before.lower,
            used.hingeUpper > before.upper ? fitted.upper : before.upper};
}

vec2 largest(const Used& used) {
    vec2 most(0);
    for (const vec2& swing : used.swings)
        most = {std::max(most.x, swing.x), std::max(most.y, swing.y)};
    return most;
}

// How far the furthest swing reaches towards the ellipse's edge; above 1: past it.
float reach(const Used& used, const ConeTwistLimits& cone) {
    float most = 0;
    for (const vec2& swing : used.swings)
        most = std::max(most, std::hypot(swing.x / cone.swingY, swing.y / cone.swingZ));
    return most;
}

ConeTwistLimits coneFor(const ConeTwistLimits& before, const Used& used, ClipLimits mode) {
    ConeTwistLimits cone = before;
    const vec2 most = largest(used);
    if (mode == ClipLimits::fit) cone = {withMargin(most.x), withMargin(most.y), withMargin(used.twist)};
    if (mode == ClipLimits::widen && used.twist > before.twist) cone.twist = withMargin(used.twist);
    // Grown in proportion until the furthest frame is inside, so that the ellipse keeps its shape.
    if (const float outside = reach(used, cone); outside > 1.0F) {
        cone.swingY = std::min(cone.swingY * outside + kClipMargin, kWidestClipSpan);
        cone.swingZ = std::min(cone.swingZ * outside + kClipMargin, kWidestClipSpan);
    }
    return cone;
}

}  // namespace

std::vector<ClipLimitChange> applyClipLimits(RagdollProfile& profile, const Rig& rig,
                                             const animation::Character& character, ClipLimits mode) {
    std::vector<ClipLimitChange> changes;
    if (character.clips.empty()) return changes;
    const std::vector<Used> used = usedByClips(profile, rig, character);
    for (std::size_t i = 0; i < profile.constraints.size(); ++i) {
        ConstraintProfile& constraint = profile.constraints[i];
        ClipLimitChange change;
        change.body = profile.bodies[constraint.child].name;
        change.kind = constraint.kind;
        change.hingeBefore = constraint.hinge;
        change.coneBefore = constraint.cone;
        if (constraint.kind == ConstraintProfile::Kind::hinge) {
            constraint.hinge = hingeFor(constraint.hinge, used[i], mode);
        } else {
            constraint.cone = coneFor(constraint.cone, used[i], mode);
        }
        const vec2 most = largest(used[i]);
        change.hingeAfter = constraint.hinge;
        change.coneAfter = constraint.cone;
        change.hingeUsed = {used[i].hingeLower, used[i].hingeUpper};
        change.coneUsed = {most.x, most.y, used[i].twist};
        changes.push_back(change);
    }
    return changes;
}

}  // namespace lutka::physics
