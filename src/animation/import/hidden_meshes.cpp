#include "animation/import/hidden_meshes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

namespace lutka::animation::rig_import {

void leaveOutHidden(SourceScene& scene) {
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
    std::erase_if(all, [](const SourceInstance& one) { return one.hidden; });
    scene.warnings.push_back(
        fmt::format("{} mesh(es) are hidden in the file and were left out: {}", names.size(), list));
}

}  // namespace lutka::animation::rig_import
