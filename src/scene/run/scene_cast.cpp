#include "scene/run/scene_cast.hpp"

#include <fmt/format.h>

#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

namespace lutka::scene {
namespace {

// What makes two dolls share an asset.
using Key = std::tuple<std::filesystem::path, int, std::filesystem::path, physics::RigKind>;

// A pin on a role that the figure lacks is let go; any other name that no body has is a mistake.
std::optional<Error> unknownPin(const Ragdoll& ragdoll, const RagdollAsset& asset, const std::string& scene) {
    for (const std::string& name : ragdoll.pins) {
        if (physics::bodyNamed(asset.profile, name) >= 0 || animation::roleFromName(name)) continue;
        return Error{ErrorCode::usage, fmt::format("a pin holds \"{}\", and no body has that name", name), scene,
                     "`lutka build MODEL` lists the bodies"};
    }
    return std::nullopt;
}

}  // namespace

std::vector<const RagdollAsset*> SceneCast::pointers() const {
    std::vector<const RagdollAsset*> all;
    for (const auto& asset : assets)
        all.push_back(asset.get());
    return all;
}

std::vector<Figure> SceneCast::figures() const {
    std::vector<Figure> all;
    for (const auto& asset : assets)
        all.push_back(figureOf(*asset));
    return all;
}

Result<SceneCast> loadCast(const EntityScene& scene, const std::filesystem::path& model, const LoadOptions& options) {
    const std::vector<Ragdoll>& ragdolls = scene.all<Ragdoll>();
    SceneCast cast;
    cast.assetOfRagdoll.resize(ragdolls.size(), -1);
    std::map<Key, int> known;
    bool modelUsed = false;
    for (const Entity& entity : scene.entities) {
        const Ragdoll* ragdoll = scene.find<Ragdoll>(entity.id);
        if (ragdoll == nullptr) continue;
        const bool named = !ragdoll->model.empty();
        if (!named && model.empty()) {
            return Error{ErrorCode::usage, fmt::format("\"{}\" has no model of its own", entity.name), scene.name,
                         "give MODEL, or \"model\" in the scene file"};
        }
        modelUsed = modelUsed || !named;
        LoadOptions load = options;
        if (named) load.profile.reset();
        if (named || ragdoll->figure) load.import.figure = ragdoll->figure;
        if (!ragdoll->profile.empty()) load.profile = ragdoll->profile;
        if (ragdoll->rig) load.fit.rig = *ragdoll->rig;
        const Key key{named ? ragdoll->model : model, load.import.figure.value_or(0), load.profile.value_or(""),
                      load.fit.rig};
        auto at = known.find(key);
        if (at == known.end()) {
            auto asset = loadRagdoll(std::get<0>(key), load);
            if (!asset) return asset.error();
            at = known.emplace(key, static_cast<int>(cast.assets.size())).first;
            cast.assets.push_back(std::move(asset).value());
        }
        const RagdollAsset& asset = *cast.assets[static_cast<std::size_t>(at->second)];
        if (std::optional<Error> error = unknownPin(*ragdoll, asset, scene.name)) return *std::move(error);
        cast.assetOfRagdoll[static_cast<std::size_t>(ragdoll - ragdolls.data())] = at->second;
    }
    if (cast.assets.empty()) {
        return Error{ErrorCode::usage, "there is no character in the scene", scene.name,
                     "add an entity with a ragdoll"};
    }
    if (!model.empty() && !modelUsed) {
        return Error{ErrorCode::usage, "every character of the scene has a model of its own", scene.name,
                     "leave MODEL out, or \"model\" in the scene file"};
    }
    return cast;
}

}  // namespace lutka::scene
