#pragma once

#include <functional>
#include <optional>
#include <span>

#include "animation/ik/two_bone.hpp"

namespace lutka::animation {

/// The ground below or above a point, world space: Y up.
struct GroundHit {
    float height = 0.0F;   ///< Metres.
    vec3 normal{0, 1, 0};  ///< Unit, normal.y > 0.
};
/// Nothing where there is no ground.
using GroundQuery = std::function<std::optional<GroundHit>(const vec3& worldPoint)>;

/// One leg that stands: its bones (the end is the foot), and the foot's shape.
struct GroundLeg {
    TwoBone bones;
    int toes = kNoJoint;       ///< Its ball; the ground is asked for there too.
    float ankleHeight = 0.0F;  ///< Of the foot's joint over its sole when it stands flat, metres.
};

struct GroundSettings {
    int hips = kNoJoint;              ///< What is lowered; above all legs.
    float floor = 0.0F;               ///< World height of the level floor that the pose was made for.
    float mostDrop = 0.5F;            ///< The hips are lowered by this much at most, metres.
    float mostRise = 0.5F;            ///< A foot is lifted by this much over the floor at most.
    float mostTilt = radians(40.0F);  ///< Of a sole from level.
    float weight = 1.0F;              ///< [0, 1]
};

struct GroundedFeet {
    float drop = 0.0F;    ///< How far the hips were lowered, metres, >= 0.
    float errorM = 0.0F;  ///< The worse foot's distance from where it should be.
};

/// Fits a pose made for a level floor to uneven ground, in place and parent-relative: the hips come down with the
/// lowest ground below a foot, each foot keeps its height over the ground as it had it over the floor, its sole turns
/// with the ground's slope, and the knees give way in their own plane. Legs without ground below them stay as they are.
/// Pure but for the query, which is asked twice a leg; allocates nothing. A caller who wants steps taken smoothly
/// filters `drop` and the query's answers over time.
GroundedFeet placeFeet(const Skeleton& skeleton, std::span<const GroundLeg> legs, const GroundSettings& settings,
                       const RigidTransform& worldFromModel, const GroundQuery& ground,
                       std::span<RigidTransform> parentFromJoint);

}  // namespace lutka::animation
