#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/rigid_transform.hpp"

namespace lutka::animation {

inline constexpr int kNoJoint = -1;

/// A joint hierarchy as flat arrays of one size, parents before children.
///
/// Every node of a file's scene becomes a joint (deforming or not), so that helpers, mesh nodes and roots keep their
/// place. All frames are rigid and in metres: import bakes units, up axis and every scale (see docs/architecture.md),
/// so that nothing downstream meets a scale.
struct Skeleton {
    std::vector<std::string> names;  ///< The file's own names; neither unique nor always meaningful.
    std::vector<int> parents;        ///< Index of the parent, smaller than the joint's own; kNoJoint for roots.

    /// Where the joint stands when the skin is undeformed (its inverse is the inverse bind matrix), in model space.
    /// Joints that deform nothing are carried along by their nearest deforming ancestor.
    std::vector<RigidTransform> bindModelFromJoint;

    /// The pose that the file's nodes have, relative to the parent. May differ from the bind pose by any angle.
    std::vector<RigidTransform> nodeParentFromJoint;

    /// Sum of the skin weights that each joint carries, in vertices (>= 0). 0: deforms nothing.
    std::vector<float> skinWeight;

    [[nodiscard]] int jointCount() const { return static_cast<int>(parents.size()); }
};

/// Names from the root to the joint, joined by '/'; where siblings share a name, "#2", "#3" … tells them apart.
[[nodiscard]] std::string jointPath(const Skeleton& skeleton, int joint);

/// The joint of that path, or of that name when only one joint has it; kNoJoint otherwise.
[[nodiscard]] int findJoint(const Skeleton& skeleton, std::string_view pathOrName);

/// Children of every joint, in file order.
[[nodiscard]] std::vector<std::vector<int>> childrenOf(const Skeleton& skeleton);

/// Whether `ancestor` is `joint` itself or above it.
[[nodiscard]] bool isAncestorOrSelf(const Skeleton& skeleton, int ancestor, int joint);
/// The same by Skeleton::parents alone.
[[nodiscard]] bool isAncestorOrSelf(std::span<const int> parents, int ancestor, int joint);

/// All that is wrong with the arrays (sizes, order of parents, frames that are not finite, unit and within
/// kFarthestPlaceM); empty when valid.
[[nodiscard]] std::vector<std::string> validate(const Skeleton& skeleton);

}  // namespace lutka::animation
