#include "animation/import/hidden_meshes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <unordered_set>
#include <vector>

#include "animation/import/name_list.hpp"

namespace lutka::animation::rig_import {
namespace {

// The slots of a mesh's skin that move vertices of it.
std::vector<std::uint32_t> slotsOf(const SourceMesh& mesh) {
    std::vector<std::uint32_t> slots;
    for (const SourceMesh::Influence& influence : mesh.influences)
        if (influence.weight > 0.0F) slots.push_back(influence.slot);
    std::sort(slots.begin(), slots.end());
    slots.erase(std::unique(slots.begin(), slots.end()), slots.end());
    return slots;
}

// Whether what is shown is a small part of what is hidden: eyelashes of a body. Hidden skins that have no joint in
// common with any that is shown are another figure's.
bool showsSmallPart(const SourceScene& scene) {
    constexpr std::ptrdiff_t kLeastShare = 4;      // of the joints that are moved one in so many
    std::set<std::tuple<bool, int, int>> skinned;  // hidden, skin, mesh: a file may show one thousands of times
    for (const SourceInstance& one : scene.instances)
        if (one.skin >= 0) skinned.insert({one.hidden, one.skin, one.mesh});
    std::vector<bool> bound(scene.nodes.size(), false);  // to a skin that is shown
    for (const auto& [hidden, skin, mesh] : skinned) {
        if (hidden) continue;
        for (const SourceSkin::Joint& joint : scene.skins[skin].joints)
            bound[joint.node] = true;
    }
    const auto isBound = [&](const SourceSkin::Joint& joint) { return bound[joint.node]; };
    std::map<int, std::vector<std::uint32_t>> slots;    // by mesh
    std::vector<bool> seen(scene.nodes.size(), false);  // moved by what is shown
    std::vector<bool> all(scene.nodes.size(), false);   // … or by hidden parts of the same figure
    for (const auto& [hidden, skin, mesh] : skinned) {
        const std::vector<SourceSkin::Joint>& joints = scene.skins[skin].joints;
        if (std::none_of(joints.begin(), joints.end(), isBound)) continue;
        const auto [moving, isNewMesh] = slots.try_emplace(mesh);
        if (isNewMesh) moving->second = slotsOf(scene.meshes[mesh]);
        for (const std::uint32_t slot : moving->second) {
            if (slot >= joints.size()) break;
            all[joints[slot].node] = true;
            if (!hidden) seen[joints[slot].node] = true;
        }
    }
    const auto count = [](const std::vector<bool>& nodes) { return std::count(nodes.begin(), nodes.end(), true); };
    return kLeastShare * count(seen) < count(all);
}

// What a node shrinks to nothing is not seen: weapons and expressions are put away so. Unless a clip has a scale there.
void hideShrunk(SourceScene& scene) {
    constexpr double kNothing = 1e-6;  // of the largest scale that anything is shown in: units are not known yet
    const std::size_t count = scene.nodes.size();
    std::vector<bool> grows(count, false);
    for (const SourceClip& clip : scene.clips)
        for (const SourceChannel& channel : clip.channels)
            if (channel.path == SourceChannel::Path::scale) grows[static_cast<std::size_t>(channel.node)] = true;
    std::vector<glm::dmat3> sceneFromNode;
    for (std::size_t node = 0; node < count; ++node) {
        const SourceNode& one = scene.nodes[node];
        const auto above = static_cast<std::size_t>(one.parent);
        const glm::dmat3 own(one.parentFromNode);
        sceneFromNode.push_back(one.parent < 0 ? own : sceneFromNode[above] * own);
        if (one.parent >= 0 && grows[above]) grows[node] = true;
    }
    const auto scaleOf = [&](int node) {
        const glm::dmat3& place = sceneFromNode[static_cast<std::size_t>(node)];
        return std::max({glm::length(place[0]), glm::length(place[1]), glm::length(place[2])});
    };
    double largest = 0.0;
    for (const SourceInstance& instance : scene.instances)
        if (instance.skin < 0) largest = std::max(largest, scaleOf(instance.node));
    for (const SourceSkin& skin : scene.skins)
        for (const SourceSkin::Joint& joint : skin.joints)
            largest = std::max(largest, scaleOf(joint.node));
    for (SourceInstance& instance : scene.instances) {
        const bool shrunk = scaleOf(instance.node) <= kNothing * largest;
        if (instance.skin < 0 && shrunk && !grows[static_cast<std::size_t>(instance.node)]) instance.hidden = true;
    }
}

}  // namespace

void leaveOutHidden(SourceScene& scene) {
    hideShrunk(scene);
    std::vector<SourceInstance>& all = scene.instances;
    const bool hasSkin = std::any_of(all.begin(), all.end(), [](const SourceInstance& one) { return one.skin >= 0; });
    const auto showsFigure = [&](const SourceInstance& one) { return !one.hidden && (one.skin >= 0 || !hasSkin); };
    if (std::none_of(all.begin(), all.end(), showsFigure)) return;
    constexpr std::size_t kMost = 8;
    std::vector<std::string> first;
    std::unordered_set<std::string_view> names;  // of nodes: a mesh of several materials is several instances
    for (const SourceInstance& one : all) {
        const std::string& name = scene.nodes[one.node].name;
        if (one.hidden && names.insert(name).second && first.size() < kMost) first.push_back(name);
    }
    if (names.empty()) return;
    const std::string list = fmt::format("{}{}", fmt::join(first, ", "), names.size() > kMost ? " …" : "");
    if (hasSkin && showsSmallPart(scene)) {
        scene.warnings.push_back(
            fmt::format("{} hidden in the file but kept, for the others are a small part of the figure: {}",
                        countOf(names.size(), "mesh is", "meshes are"), list));
        return;
    }
    std::erase_if(all, [](const SourceInstance& one) { return one.hidden; });
    scene.warnings.push_back(fmt::format("{} hidden in the file and {} left out: {}",
                                         countOf(names.size(), "mesh is", "meshes are"),
                                         names.size() == 1 ? "was" : "were", list));
}

}  // namespace lutka::animation::rig_import
