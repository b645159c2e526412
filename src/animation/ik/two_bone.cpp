#include "animation/ik/two_bone.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "animation/pose.hpp"
#include "core/assert.hpp"

namespace lutka::animation {
namespace {

constexpr float kLeastLength = 1e-6F;  // metres
// Sines of the angle between the bones between which the pose's own plane takes over from the hint.
constexpr float kStraight = 0.02F;
constexpr float kBent = 0.12F;

float smooth(float low, float high, float value) {
    const float t = std::clamp((value - low) / (high - low), 0.0F, 1.0F);
    return t * t * (3.0F - 2.0F * t);
}

vec3 across(const vec3& direction, const vec3& unit) {
    return direction - unit * glm::dot(direction, unit);
}

vec3 unitOr(const vec3& v, const vec3& otherwise) {
    const float length = glm::length(v);
    return length > kLeastLength ? v / length : otherwise;
}

// The distance from start to end at a flexion.
float spanAt(float upper, float lower, float flexion) {
    return std::sqrt(std::max(upper * upper + lower * lower + 2.0F * upper * lower * std::cos(flexion), 0.0F));
}

// The axes of a bone: x along it, z the plane's normal as far as it lies across.
quat boneFrame(const vec3& along, const vec3& normal) {
    const vec3 z = unitOr(across(normal, along), anyPerpendicular(along));
    return glm::normalize(glm::quat_cast(mat3(along, glm::cross(z, along), z)));
}

}  // namespace

BoneTurns turnsToReach(const BonePoints& points, const TwoBone& limb, const vec3& bend, const TwoBoneGoal& goal) {
    const float upper = glm::distance(points.middle, points.start);
    const float lower = glm::distance(points.end, points.middle);
    if (upper < kLeastLength || lower < kLeastLength) return {{1, 0, 0, 0}, {1, 0, 0, 0}, points.end};
    const vec3 upperNow = (points.middle - points.start) / upper;
    const vec3 lowerNow = (points.end - points.middle) / lower;

    // The plane of the bend as it is, told from the hint where the limb is straight.
    const vec3 ownNormal = glm::cross(upperNow, lowerNow);
    const float hinted = 1.0F - smooth(kStraight, kBent, glm::length(ownNormal));
    // The middle joint goes to `bend` when the lower bone turns away from it.
    const vec3 hintNormal = unitOr(glm::cross(bend, upperNow), anyPerpendicular(upperNow));
    const vec3 normalNow = unitOr(ownNormal + hintNormal * (hinted * kBent), hintNormal);

    const vec3 way = goal.target - points.start;
    const vec3 chordNow = unitOr(points.end - points.start, upperNow);
    const vec3 direction = unitOr(way, chordNow);
    const float whole = upper + lower;
    const float reach = softlyClamped(glm::length(way), spanAt(upper, lower, limb.mostFlexion),
                                      spanAt(upper, lower, limb.leastFlexion), goal.softness * whole);
    // Without a pole the plane is turned with the chord, the shortest way.
    const vec3 carried = rotationBetween(chordNow, direction) * glm::cross(chordNow, normalNow);
    const vec3 towards = goal.pole ? *goal.pole : carried;
    const vec3 side =
        unitOr(across(towards, direction), unitOr(across(carried, direction), anyPerpendicular(direction)));
    const vec3 normal = glm::cross(side, direction);

    const float cosine = std::clamp(
        (upper * upper + reach * reach - lower * lower) / (2.0F * upper * std::max(reach, kLeastLength)), -1.0F, 1.0F);
    const vec3 upperThen = direction * cosine + side * std::sqrt(1.0F - cosine * cosine);
    const vec3 end = points.start + direction * reach;
    const vec3 lowerThen = unitOr(end - (points.start + upperThen * upper), upperThen);
    BoneTurns turns;
    turns.upper = glm::normalize(boneFrame(upperThen, normal) * glm::conjugate(boneFrame(upperNow, normalNow)));
    turns.lower = glm::normalize(boneFrame(lowerThen, normal) * glm::conjugate(boneFrame(lowerNow, normalNow)));
    turns.end = end;
    return turns;
}

Reached solveTwoBone(const Skeleton& skeleton, const TwoBone& limb, const TwoBoneGoal& goal,
                     std::span<RigidTransform> parentFromJoint) {
    LUTKA_ASSERT(isAncestorOrSelf(skeleton, limb.upper, limb.middle) && limb.upper != limb.middle);
    LUTKA_ASSERT(isAncestorOrSelf(skeleton, limb.middle, limb.end) && limb.middle != limb.end);
    LUTKA_ASSERT(isFinite(goal.target) && (!goal.pole || isFinite(*goal.pole)));
    const RigidTransform upper = modelFrameOf(skeleton, parentFromJoint, limb.upper);
    const RigidTransform middle = modelFrameOf(skeleton, parentFromJoint, limb.middle);
    const RigidTransform end = modelFrameOf(skeleton, parentFromJoint, limb.end);
    const BoneTurns turns = turnsToReach({upper.translation, middle.translation, end.translation}, limb,
                                         upper.rotation * limb.bendInUpper, goal);

    // Rotations relative to the parents, which the upper turn carries along below the upper joint.
    RigidTransform& upperLocal = parentFromJoint[limb.upper];
    const quat modelFromUpperParent = upper.rotation * glm::conjugate(upperLocal.rotation);
    upperLocal.rotation = glm::normalize(glm::conjugate(modelFromUpperParent) * (turns.upper * upper.rotation));
    RigidTransform& middleLocal = parentFromJoint[limb.middle];
    const quat modelFromMiddleParent = turns.upper * middle.rotation * glm::conjugate(middleLocal.rotation);
    middleLocal.rotation = glm::normalize(glm::conjugate(modelFromMiddleParent) * (turns.lower * middle.rotation));
    if (limb.range) upperLocal.rotation = clampedTo(*limb.range, upperLocal.rotation);
    const RigidTransform reached = modelFrameOf(skeleton, parentFromJoint, limb.end);
    if (goal.endRotation) {
        RigidTransform& endLocal = parentFromJoint[limb.end];
        const quat modelFromEndParent = reached.rotation * glm::conjugate(endLocal.rotation);
        endLocal.rotation = glm::normalize(glm::conjugate(modelFromEndParent) * *goal.endRotation);
    }
    return {glm::distance(reached.translation, goal.target)};
}

}  // namespace lutka::animation
