#pragma once

#include <span>
#include <vector>

#include "animation/import/node_tree.hpp"

namespace lutka::animation::rig_import {

/// From this far from 1 on the scale of a whole pose (RigidPoser::commonScale) is that of another unit.
inline constexpr double kAnotherUnit = 0.05;

/// Turns scenes' poses, with whatever scale and shear they hold, into rigid joint frames in model space.
///
/// A pose moves what is bound to a joint by D = sceneFromJoint * inverse(bind), seen in model space. The joint's rigid
/// frame takes D's rotation, and its origin goes where D takes it; D's scale is dropped and reported.
class RigidPoser {
  public:
    RigidPoser(const NodeTree& tree, std::span<const dmat4> bindSceneFromJoint, const dmat4& modelFromScene);

    [[nodiscard]] const std::vector<RigidTransform>& bindModelFromJoint() const { return bindModelFromJoint_; }

    /// Model-space frames (one a joint) of a pose given by all nodes' scene-space frames. Lengths are divided by
    /// `uniformScale` first. Returns the largest stretch or shear that was dropped, as a share of the length, among the
    /// joints with `matters` set.
    double pose(std::span<const dmat4> sceneFromNode, double uniformScale, std::span<const bool> matters,
                std::span<RigidTransform> modelFromJoint) const;

    /// The median of the joints' scales in that pose against the bind pose, over the joints with `matters` set. Where a
    /// quarter of them differ from it, the first joint's if all are above 5 or below 1/5, else 1; 1 without any.
    [[nodiscard]] double commonScale(std::span<const dmat4> sceneFromNode, std::span<const bool> matters) const;

  private:
    const NodeTree& tree_;
    dmat4 modelFromScene_;
    std::vector<dmat4> jointFromModelBind_;  // inverse bind, from model space
    std::vector<RigidTransform> bindModelFromJoint_;
};

}  // namespace lutka::animation::rig_import
