#pragma once

#include <span>
#include <vector>

#include "animation/skeleton.hpp"

namespace lutka::animation {

/// Which part of a clip is travel of the whole figure.
struct RootMotionSettings {
    int joint = kNoJoint;    ///< Whose way it is: the hips, or a root joint of its own. kNoJoint: clips don't travel.
    bool horizontal = true;  ///< Its way over the ground.
    bool vertical = false;   ///< How it rises over its height in the clip's first frame.
    bool turn = false;       ///< Its heading: the turn about `up` from its bind pose.
    vec3 up{0, 1, 0};        ///< Unit, model space.
};

/// The ground frame of a pose, model space: the place of the settings' joint over the ground and its heading, as far as
/// the settings ask for them. `parentFromJoint` holds jointCount() frames, `firstHeight` is the joint's height in the
/// first frame. Identity without a joint.
[[nodiscard]] RigidTransform groundFrame(const Skeleton& skeleton, const RootMotionSettings& settings,
                                         std::span<const RigidTransform> parentFromJoint, float firstHeight);

/// The transform applied `times` over, times >= 0.
[[nodiscard]] RigidTransform powerOf(RigidTransform transform, long long times);

}  // namespace lutka::animation
