#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "animation/import/node_tree.hpp"
#include "core/result.hpp"

namespace lutka::animation::rig_import {

/// The JSON of a glTF 2.0 file, for what Assimp doesn't pass on.
struct GltfDocument {
    nlohmann::json json;
    bool binary = false;                ///< A .glb container.
    std::vector<std::string> warnings;  ///< Required extensions that only cost looks.
};

/// Nothing when the file isn't glTF (told by its content). Fails when it is glTF but broken, and when it requires an
/// extension (`extensionsRequired`) without which Assimp would read nonsense.
[[nodiscard]] Result<std::optional<GltfDocument>> readGltfDocument(const std::filesystem::path& file);

/// The VRM 0.x or 1.0 humanoid block: role (VRM 1.0 name) → joint. Empty when there is none. Assimp loses glTF's node
/// indices, so the two trees are walked side by side.
[[nodiscard]] std::map<std::string, int> vrmHumanoid(const GltfDocument& document, const NodeTree& tree,
                                                     std::vector<std::string>& warnings);

}  // namespace lutka::animation::rig_import
