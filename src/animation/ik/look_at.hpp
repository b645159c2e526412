#pragma once

#include <span>

#include "animation/ik/two_bone.hpp"

namespace lutka::animation {

/// One joint of a look: neck, head, also chest.
struct LookJoint {
    int joint = kNoJoint;
    float share = 1.0F;  ///< Of the whole turn, > 0; the joints' shares are measured against their sum.
};

/// Who looks, and how far.
struct LookAt {
    std::span<const LookJoint> joints;  ///< From the top down, each below the one before it; the last is the head.
    vec3 eyeInHead{0, 0, 0};            ///< Where it looks from.
    vec3 forwardInHead{0, 0, 1};        ///< Unit: where the face points.
    vec3 forwardInBase{0, 0, 1};  ///< Unit: straight ahead, in the frame of the first joint's parent (in model space
                                  ///< where it has none). The limits are told from it.
    vec3 upInBase{0, 1, 0};
    float mostYaw = radians(75.0F);    ///< To either side.
    float mostPitch = radians(45.0F);  ///< Up and down.
    float softness = radians(10.0F);   ///< How far before a limit the turn begins to slow down.
    /// Straight behind there is no side to look to: from this angle off straight ahead the look is given up, more and
    /// more, until at half a turn nothing is left of it.
    float letGo = radians(120.0F);
};

/// Turns the joints so that the face points at `target` (model space), `weight` of the way, in place on a
/// parent-relative pose. Returns the angle, radians, by which the look misses. Pure, without allocation, continuous in
/// the target but where it meets the eye.
float solveLookAt(const Skeleton& skeleton, const LookAt& look, const vec3& target,
                  std::span<RigidTransform> parentFromJoint, float weight = 1.0F);

}  // namespace lutka::animation
