#pragma once

#include <span>
#include <vector>

#include "animation/import/skin_binding.hpp"

namespace lutka::animation::rig_import {

/// Where every joint stands, in scene space and with its scale, when the skin is undeformed; invertible for each joint.
///
/// A vertex is skinned as sum(weight * sceneFromJoint * jointFromMesh * v). Undeformed, all sceneFromJoint *
/// jointFromMesh of a mesh equal one matrix, sceneFromMesh. Where the file does not state it only the joints' matrices
/// do, and they fix it up to a common factor. It is then chosen so that the bind pose lies where the nodes are: the
/// scene's own frame where the vertices are in scene space; else the mesh node's direction and place where the joints
/// agree with them, else the most central of the joints' products; the size is always the joints'. Meshes that share
/// joints share the choice. Joints without a skin keep the place relative to their nearest skinned ancestor (else
/// descendant) that they have in the nodes' pose. Where `tree.nodesArePosed` is false the joints' nodes have no say.
[[nodiscard]] std::vector<dmat4> solveBindPose(const NodeTree& tree, std::span<const MeshInstance> meshes);

}  // namespace lutka::animation::rig_import
