#include <fmt/format.h>

#include "animation/humanoid/roles.hpp"
#include "animation/import/gltf/gltf_parts.hpp"

namespace lutka::animation::rig_import::gltf {
namespace {

using nlohmann::json;

// VRM 1.0 shifted the thumb's names by one joint towards the hand.
std::string roleOfVrm0(const std::string& bone) {
    for (const char* side : {"left", "right"}) {
        if (bone == std::string(side) + "ThumbProximal") return std::string(side) + "ThumbMetacarpal";
        if (bone == std::string(side) + "ThumbIntermediate") return std::string(side) + "ThumbProximal";
    }
    return bone;
}

const json* bonesOf(const GltfFile& file, const char* extension) {
    const json* block = extensionOf(file.json(), extension);
    const json* humanoid = block == nullptr ? nullptr : member(*block, "humanoid");
    return humanoid == nullptr ? nullptr : member(*humanoid, "humanBones");
}

// As write_glb writes them; of several figures those of the first.
void addWrittenRoles(const GltfFile& file, std::map<std::string, std::size_t>& roles) {
    const json* nodes = member(file.json(), "nodes");
    if (nodes == nullptr || !nodes->is_array()) return;
    for (std::size_t i = 0; i < nodes->size(); ++i) {
        const json* extras = member((*nodes)[i], "extras");
        const std::string role = extras == nullptr ? "" : textOf(*extras, kRoleExtra);
        if (!role.empty()) roles.emplace(role, i);
    }
}

// Role → glTF node index of either version's block; a node that isn't there stays out of range.
std::map<std::string, std::size_t> nodesOfRoles(const GltfFile& file) {
    std::map<std::string, std::size_t> roles;
    const auto put = [&](const std::string& role, const json& bone) {
        const json* node = member(bone, "node");
        if (node != nullptr && node->is_number_unsigned()) roles[role] = node->get<std::size_t>();
    };
    if (const json* bones = bonesOf(file, "VRMC_vrm"); bones != nullptr && bones->is_object()) {
        for (const auto& [role, bone] : bones->items())
            put(role, bone);
    } else if (const json* old = bonesOf(file, "VRM"); old != nullptr && old->is_array()) {
        for (const json& entry : *old) {
            const std::string bone = textOf(entry, "bone");
            if (!bone.empty()) put(roleOfVrm0(bone), entry);
        }
    }
    if (roles.empty()) addWrittenRoles(file, roles);
    return roles;
}

}  // namespace

void addVrmHumanoid(const GltfFile& file, const NodeMap& nodes, SourceScene& out) {
    for (const auto& [role, node] : nodesOfRoles(file)) {
        if (node < nodes.size() && nodes[node] >= 0) {
            out.vrmHumanoid[role] = nodes[node];
        } else {
            out.warnings.push_back(
                fmt::format("the VRM role '{}' names node {}, which is not in the scene", role, node));
        }
    }
}

}  // namespace lutka::animation::rig_import::gltf
