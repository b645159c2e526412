#pragma once

#include <span>
#include <vector>

#include "animation/skeleton.hpp"

namespace lutka::animation {

/// Model-space frames from parent-relative ones. Both spans hold jointCount() elements and may be the same span.
void localToModel(const Skeleton& skeleton, std::span<const RigidTransform> parentFromJoint,
                  std::span<RigidTransform> modelFromJoint);

/// Parent-relative frames from model-space ones; the spans may not overlap.
void modelToLocal(const Skeleton& skeleton, std::span<const RigidTransform> modelFromJoint,
                  std::span<RigidTransform> parentFromJoint);

/// One joint's model-space frame, by its ancestors alone.
[[nodiscard]] RigidTransform modelFrameOf(const Skeleton& skeleton, std::span<const RigidTransform> parentFromJoint,
                                          int joint);

/// The node pose in model space.
[[nodiscard]] std::vector<RigidTransform> nodePose(const Skeleton& skeleton);

}  // namespace lutka::animation
