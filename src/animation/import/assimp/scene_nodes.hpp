#pragma once

#include <assimp/scene.h>

#include <string>
#include <unordered_map>
#include <vector>

#include "animation/import/source_scene.hpp"
#include "core/result.hpp"

namespace lutka::animation::rig_import {

/// What Assimp puts between a node's name and the kind of helper.
inline constexpr const char* kPivotMark = "_$AssimpFbx$_";

/// How Assimp's nodes, which bones and channels only name, correspond to the plain scene's.
struct SceneNodes {
    std::vector<const aiNode*> sources;     ///< One a node of the plain scene.
    std::vector<glm::dmat4> sceneFromNode;  ///< The nodes' own pose.
    std::unordered_multimap<std::string, int> byName;

    /// Every node of that name, in file order.
    [[nodiscard]] std::vector<int> named(const std::string& name) const;
};

/// Adds the nodes, depth first. Fails when there are more than a character can have, or nested too deep.
[[nodiscard]] Result<SceneNodes> readNodes(const aiScene& scene, const std::string& location, SourceScene& out);

}  // namespace lutka::animation::rig_import
