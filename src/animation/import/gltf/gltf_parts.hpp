#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "animation/import/gltf/gltf_file.hpp"
#include "animation/import/source_scene.hpp"

/// The parts of a glTF scene, one function each. They throw Damage.
namespace lutka::animation::rig_import::gltf {

/// glTF node index → node of the plain scene; -1 for those that are not in the scene that is shown.
using NodeMap = std::vector<int>;

/// The children of a node, each once. Throws Damage where one is not there.
[[nodiscard]] std::vector<int> childrenOf(const GltfFile& file, int node);

/// The nodes that have no parent, of the scene that is read: the default one, or the first where the file names none;
/// of the whole file where that scene is empty or there is none. Where that scene holds no skinned mesh and another
/// does, that one is read, and a warning tells it if the file named the first. The tops of trees that hold joints of a
/// skin in it come along, though the scene leaves them out. Nodes that a scene lists twice, or beside one above them,
/// are there once, which is told.
[[nodiscard]] std::vector<int> rootsOf(const GltfFile& file, std::vector<std::string>& warnings);

/// Adds the nodes of the scene that is read (of all nodes where the file has no scenes), depth first.
[[nodiscard]] NodeMap addNodes(GltfFile& file, SourceScene& out);

/// Adds the materials, and with `loadTextures` their pictures.
void addMaterials(GltfFile& file, bool loadTextures, SourceScene& out);

/// The UV set that a material's pictures use, and how they are moved over it (KHR_texture_transform).
struct UvUse {
    int set = 0;
    mat3 transform{1.0F};
    bool repeats = true;  ///< Else the first picture is mirrored or held at its edge beyond the unit square.
};
[[nodiscard]] UvUse uvUseOf(GltfFile& file, int material);

/// Adds meshes (one a primitive), skins and where they hang.
void addMeshes(GltfFile& file, const NodeMap& nodes, SourceScene& out);

/// Of each glTF node, whether a channel of KHR_animation_pointer animates this part of it: a JSON pointer from the
/// node, "extensions/KHR_node_visibility/visible".
[[nodiscard]] std::vector<bool> nodesOfPointers(const GltfFile& file, std::string_view part);

/// Adds the animations; those of morph weights are left out and told.
void addClips(GltfFile& file, const NodeMap& nodes, SourceScene& out);

/// Adds the VRM 0.x or 1.0 humanoid block: role (VRM 1.0 name) → node.
void addVrmHumanoid(const GltfFile& file, const NodeMap& nodes, SourceScene& out);

}  // namespace lutka::animation::rig_import::gltf
