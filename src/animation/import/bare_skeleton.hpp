#pragma once

#include <span>

#include "animation/import/affine.hpp"
#include "animation/import/source_scene.hpp"

namespace lutka::animation::rig_import {

/// How much plainer a later frame must be to be taken instead: many captures begin with a pose for the purpose.
inline constexpr double kClearlyPlainer = 1.02;

/// Whether the bones point into different directions, as those of a figure do in any pose. Parents before children, -1
/// for roots; `scene` holds each node's frame. What only leads to the figure does not count.
[[nodiscard]] bool spreadsOut(std::span<const int> parents, std::span<const dmat4> scene);

/// How plainly a pose shows a figure: how high the hips stand over the lowest node along axis `up`, in lengths of the
/// longest way down from them, and how straight the limbs are. About 2 for one that stands with straight limbs.
[[nodiscard]] double plainness(std::span<const int> parents, std::span<const dmat4> scene, int up);

/// How straight a long way through the first fork is at most: about 0.97 from the head to an ankle of one who stands,
/// less where the trunk is bent over the legs. In [0, 1].
[[nodiscard]] double stretch(std::span<const int> parents, std::span<const dmat4> scene);

/// In a file with clips and no mesh, or with a few rigid ones (a face, a weapon), the nodes' own pose binds nothing.
/// Some exporters write none: all nodes stand in one place, or along one axis. Such nodes take the pose of the frame
/// with the most plainness(), the earliest where several have it; a warning tells which.
void poseBareSkeleton(SourceScene& scene);

}  // namespace lutka::animation::rig_import
