#include "animation/ik/feet_on_ground.hpp"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>

#include "animation/pose.hpp"
#include "core/assert.hpp"

namespace lutka::animation {
namespace {

constexpr std::size_t kMostLegs = 8;
constexpr vec3 kWorldUp{0, 1, 0};
// Little, so that legs that stand nearly straight on the level stay as they are.
constexpr float kSoftness = 0.004F;

// Where a foot goes, world space.
struct Footing {
    bool found = false;
    float lift = 0.0F;  // of its ankle, from the level floor to the ground
    quat tilt{1, 0, 0, 0};
};

quat tiltTo(const vec3& normal, float most, float weight) {
    const vec3 turn = rotationVector(rotationBetween(kWorldUp, normal));
    const float angle = glm::length(turn);
    if (angle < 1e-6F) return {1, 0, 0, 0};
    return glm::angleAxis(std::min(angle, most) * weight, turn / angle);
}

Footing footingOf(const GroundLeg& leg, const GroundSettings& settings, const vec3& ankle, const vec3& ball,
                  const GroundQuery& ground) {
    const auto below = ground(ankle);
    if (!below) return {};
    LUTKA_ASSERT(std::isfinite(below->height) && below->normal.y > 0.0F);
    float height = below->height;
    if (leg.toes != kNoJoint) {
        // What stands out of the slope under the ball, such as the next stair, holds the whole foot up.
        const vec3 step = ball - ankle;
        const float slope = -(below->normal.x * step.x + below->normal.z * step.z) / below->normal.y;
        if (const auto front = ground(ball)) height = std::max(height, front->height - slope);
    }
    Footing footing;
    footing.found = true;
    footing.tilt = tiltTo(below->normal, settings.mostTilt, settings.weight);
    const float up = std::max((footing.tilt * kWorldUp).y, 0.1F);
    // A tilted sole is as far from the ankle as before, but across the slope.
    const float across = leg.ankleHeight * (1.0F / up - 1.0F);
    footing.lift = std::min(height - settings.floor, settings.mostRise) * settings.weight + across;
    return footing;
}

}  // namespace

GroundedFeet placeFeet(const Skeleton& skeleton, std::span<const GroundLeg> legs, const GroundSettings& settings,
                       const RigidTransform& worldFromModel, const GroundQuery& ground,
                       std::span<RigidTransform> parentFromJoint) {
    LUTKA_ASSERT(legs.size() <= kMostLegs);
    LUTKA_ASSERT(settings.hips >= 0 && settings.hips < skeleton.jointCount());
    std::array<Footing, kMostLegs> footings;
    std::array<RigidTransform, kMostLegs> feet;
    float lowest = 0.0F;
    for (std::size_t i = 0; i < legs.size(); ++i) {
        feet[i] = worldFromModel * modelFrameOf(skeleton, parentFromJoint, legs[i].bones.end);
        const vec3 ball = legs[i].toes == kNoJoint
                              ? feet[i].translation
                              : worldFromModel * modelFrameOf(skeleton, parentFromJoint, legs[i].toes).translation;
        footings[i] = footingOf(legs[i], settings, feet[i].translation, ball, ground);
        if (footings[i].found) lowest = std::min(lowest, footings[i].lift);
    }
    GroundedFeet result;
    result.drop = std::min(-lowest, settings.mostDrop);
    const RigidTransform modelFromWorld = inverse(worldFromModel);
    const vec3 down = modelFromWorld.rotation * (kWorldUp * -result.drop);
    const int hipsParent = skeleton.parents[settings.hips];
    const quat parentFromModel = hipsParent == kNoJoint
                                     ? quat(1, 0, 0, 0)
                                     : glm::conjugate(modelFrameOf(skeleton, parentFromJoint, hipsParent).rotation);
    parentFromJoint[settings.hips].translation += parentFromModel * down;
    for (std::size_t i = 0; i < legs.size(); ++i) {
        const vec3 lifted = feet[i].translation + (footings[i].found ? kWorldUp * footings[i].lift : vec3(0));
        TwoBoneGoal goal;
        goal.target = modelFromWorld * lifted;
        goal.softness = kSoftness;
        goal.endRotation = modelFromWorld.rotation * footings[i].tilt * feet[i].rotation;
        result.errorM = std::max(result.errorM, solveTwoBone(skeleton, legs[i].bones, goal, parentFromJoint).errorM);
    }
    return result;
}

}  // namespace lutka::animation
