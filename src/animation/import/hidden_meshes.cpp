#include "animation/import/hidden_meshes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace lutka::animation::rig_import {

void leaveOutHidden(SourceScene& scene) {
    std::vector<SourceInstance>& all = scene.instances;
    const bool hasSkin = std::any_of(all.begin(), all.end(), [](const SourceInstance& one) { return one.skin >= 0; });
    const auto showsFigure = [&](const SourceInstance& one) { return !one.hidden && (one.skin >= 0 || !hasSkin); };
    if (std::none_of(all.begin(), all.end(), showsFigure)) return;
    std::vector<std::string> names;  // of nodes: a mesh of several materials is several instances
    for (const SourceInstance& one : all) {
        const std::string& name = scene.nodes[one.node].name;
        if (one.hidden && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
    if (names.empty()) return;
    std::erase_if(all, [](const SourceInstance& one) { return one.hidden; });
    constexpr std::size_t kMost = 8;
    const std::size_t count = names.size();
    if (count > kMost) names.resize(kMost);
    scene.warnings.push_back(fmt::format("{} mesh(es) are hidden in the file and were left out: {}{}", count,
                                         fmt::join(names, ", "), count > kMost ? " …" : ""));
}

}  // namespace lutka::animation::rig_import
