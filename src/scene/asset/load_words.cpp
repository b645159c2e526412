#include "scene/asset/load_words.hpp"

namespace lutka::scene {

std::optional<physics::RagdollPreset> presetNamed(std::string_view name) {
    for (const physics::PresetInfo& info : physics::presetInfos())
        if (info.name == name) return info.preset;
    return std::nullopt;
}

Result<void> addExtraBodies(std::string_view word, physics::FitOptions& fit) {
    if (word == "shoulders") {
        fit.shoulderBodies = true;
    } else if (word == "neck") {
        fit.neckBody = true;
    } else if (word == "toes") {
        fit.toeBodies = true;
    } else if (word == "trunk") {
        fit.allTrunkBodies = true;
    } else if (word == "appendages") {
        fit.appendages.assign(animation::kAppendageKinds.begin(), animation::kAppendageKinds.end());
    } else if (const auto kind = animation::appendageNamed(word)) {
        fit.appendages.push_back(*kind);
    } else if (!word.empty()) {
        return Error{ErrorCode::usage, "there are no extra bodies named '" + std::string(word) + "'", "--bodies",
                     "shoulders, neck, toes and trunk can be had, and of what hangs on the figure tail, ears, hair, "
                     "cape, skirt, wings, weapon, other, or all of these as appendages"};
    }
    return {};
}

}  // namespace lutka::scene
