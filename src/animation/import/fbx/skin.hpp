#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "animation/import/fbx/node_transform.hpp"
#include "animation/import/fbx/objects.hpp"
#include "animation/import/source_scene.hpp"

namespace lutka::animation::rig_import::fbx {

/// A geometry's skin, with its weights by control point: those of point p are influences[start[p]] up to
/// influences[start[p + 1]].
struct ReadSkin {
    SourceSkin skin;
    std::vector<std::uint32_t> start;
    std::vector<SourceMesh::Influence> influences;
    bool isLinear = true;     ///< False: the file blends by dual quaternions, all or some of the skin.
    bool isAdditive = false;  ///< Some joints add to what the others make of a vertex; here they share it.
};

/// What skins are read with: scene nodes by model, where they stand, and the file's bind pose.
struct SkinContext {
    const Objects& objects;
    const std::map<int, int>& nodeOfModel;  ///< Object index → scene node.
    std::span<const dmat4> sceneFromNode;   ///< The nodes' own pose.
    const std::map<int, dmat4>& bindPose;   ///< Object index → scene-space matrix.
    const dmat4& sceneFromFile;             ///< The clusters' matrices are in the file's space.
};

/// The matrices of the file's bind poses in the file's space, by object; the first that names an object counts.
[[nodiscard]] std::map<int, dmat4> readBindPose(const Objects& objects);

/// The skin of the geometry (or FBX 6 model) `owner` where the model `mesh` hangs it; nothing without one. Joints
/// without weights are kept. All skin deformers of a geometry become one.
///
/// A cluster states where its joint stood (TransformLink) and the mesh seen from there (Transform). Where a writer put
/// something else into Transform, the same for joints that stand apart, the mesh's place comes from the bind pose, else
/// from its node.
[[nodiscard]] std::optional<ReadSkin> readSkin(const SkinContext& context, int owner, int mesh,
                                               std::size_t controlPoints);

/// Gives a mesh the weights of the control points that its vertices come from.
void weightVertices(const ReadSkin& skin, std::span<const std::uint32_t> controlPoints, SourceMesh& mesh);

}  // namespace lutka::animation::rig_import::fbx
