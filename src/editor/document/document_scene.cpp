/// EditorDocument's scene: entities, the other characters in it, and its file.

#include <fmt/format.h>

#include <algorithm>

#include "editor/document/editor_document.hpp"
#include "scene/scene_file.hpp"

namespace lutka::editor {
namespace {

namespace fs = std::filesystem;

bool samePath(const fs::path& a, const fs::path& b) {
    std::error_code failed;
    return fs::weakly_canonical(a, failed) == fs::weakly_canonical(b, failed);
}

bool hasClip(const scene::RagdollAsset& asset, const std::string& name) {
    const auto& clips = asset.character.clips;
    return std::any_of(clips.begin(), clips.end(), [&](const animation::Clip& clip) { return clip.name == name; });
}

}  // namespace

bool EditorDocument::isEdited(const scene::Ragdoll& ragdoll) const {
    if (!ragdoll.model.empty() && !samePath(ragdoll.model, character().file)) return false;
    if (ragdoll.profile.empty()) return ragdoll.model.empty() || openedWith_.empty();
    return samePath(ragdoll.profile, profileFile()) || samePath(ragdoll.profile, openedWith_);
}

Result<void> EditorDocument::loadOthers(const scene::EntityScene& scene) {
    for (const scene::Ragdoll& ragdoll : scene.all<scene::Ragdoll>()) {
        if (isEdited(ragdoll)) continue;
        const fs::path model = ragdoll.model.empty() ? character().file : ragdoll.model;
        const OtherKey key{model, ragdoll.profile};
        if (others_.contains(key)) continue;
        scene::LoadOptions load = load_;
        if (!ragdoll.profile.empty()) load.profile = ragdoll.profile;
        auto asset = scene::loadRagdoll(model, load);
        if (!asset) return asset.error();
        others_.emplace(key, std::move(asset).value());
    }
    return {};
}

const scene::RagdollAsset& EditorDocument::assetOf(const scene::Ragdoll& ragdoll) const {
    if (isEdited(ragdoll)) return *asset_;
    const auto other = others_.find({ragdoll.model.empty() ? character().file : ragdoll.model, ragdoll.profile});
    return other != others_.end() ? *other->second : *asset_;
}

std::vector<const scene::RagdollAsset*> EditorDocument::assets() const {
    std::vector<const scene::RagdollAsset*> all{asset_.get()};
    for (const scene::Ragdoll& ragdoll : scene().all<scene::Ragdoll>()) {
        const scene::RagdollAsset* asset = &assetOf(ragdoll);
        if (std::find(all.begin(), all.end(), asset) == all.end()) all.push_back(asset);
    }
    return all;
}

std::vector<int> EditorDocument::assetOfRagdoll() const {
    const std::vector<const scene::RagdollAsset*> all = assets();
    std::vector<int> indices;
    for (const scene::Ragdoll& ragdoll : scene().all<scene::Ragdoll>()) {
        const auto at = std::find(all.begin(), all.end(), &assetOf(ragdoll));
        indices.push_back(static_cast<int>(at - all.begin()));
    }
    return indices;
}

// What the simulation would refuse is refused here, before anything is changed.
Result<void> EditorDocument::checkScene(SceneSettings& scene) {
    if (const auto problems = scene::validate(scene.entities); !problems.empty()) {
        std::string all;
        for (const std::string& problem : problems)
            all += (all.empty() ? "" : "; ") + problem;
        return Error{ErrorCode::usage, all, "", "choose a value inside the range"};
    }
    if (auto loaded = loadOthers(scene.entities); !loaded) return loaded;
    for (const scene::Ragdoll& ragdoll : scene.entities.all<scene::Ragdoll>()) {
        if (!ragdoll.clip || hasClip(assetOf(ragdoll), ragdoll.clip->clip)) continue;
        return Error{ErrorCode::usage, fmt::format("there is no clip named '{}'", ragdoll.clip->clip),
                     assetOf(ragdoll).character.file.string(), "choose one of the model's clips"};
    }
    // The scene outlives its characters: one that has no such clip falls from the pose instead.
    if (scene.clip && !hasClip(*asset_, scene.clip->clip)) scene.clip.reset();
    return {};
}

Result<void> EditorDocument::startScene(SceneSettings scene) {
    if (scene.entities.entities.empty()) {
        const auto figure = scene::figureBounds(asset_->profile, asset_->rig);
        if (auto made = makeNamedScene(scene, figure); !made) return made;
    }
    if (auto checked = checkScene(scene); !checked) return checked;
    state_.scene = std::move(scene);
    state_.scene.begun = state_.scene.entities;
    sceneUnsaved_ = false;
    ++revision_;
    return {};
}

Result<void> EditorDocument::setScene(const SceneSettings& scene, const std::string& label, const std::string& group) {
    SceneSettings next = scene;
    const SceneSettings& now = state_.scene;
    if (next.scenario != now.scenario || next.count != now.count || next.seed != now.seed) {
        const auto figure = scene::figureBounds(asset_->profile, asset_->rig);
        if (auto made = makeNamedScene(next, figure); !made) return made;
    }
    if (auto checked = checkScene(next); !checked) return checked;
    return apply(label, group, [&](DocumentState& state) -> Result<void> {
        state.scene = std::move(next);
        return {};
    });
}

// A named scene that was not saved yet counts as changed when its entities are: who tries another gravity has made
// nothing that could be lost.
void EditorDocument::followScene() {
    const scene::EntityScene& now = scene();
    if (hasSceneFile()) {
        sceneUnsaved_ = now != savedScene_;
    } else {
        const scene::EntityScene& begun = state_.scene.begun;
        sceneUnsaved_ = now.entities != begun.entities || now.components != begun.components;
    }
}

Result<void> EditorDocument::useScene(const fs::path& file, const scene::EntityScene& scene) {
    SceneSettings next = state_.scene;
    next.entities = scene;
    next.scenario.clear();
    next.made.clear();
    if (auto done = setScene(next, "Open scene " + file.filename().string()); !done) return done;
    setSceneFile(file);
    return {};
}

void EditorDocument::setSceneFile(const fs::path& file) {
    sceneFile_ = file;
    savedScene_ = state_.scene.entities;
    sceneUnsaved_ = false;
}

fs::path EditorDocument::sceneFile() const {
    if (!sceneFile_.empty()) return sceneFile_;
    return character().file.parent_path() / (scene().name + ".scene.json");
}

Result<void> EditorDocument::saveScene(const fs::path& file) {
    scene::EntityScene written = scene();
    const auto profile = saved_.find(state_.openedProfile);
    const bool hasProfile = profile != saved_.end() && !profile->second.file.empty();
    for (scene::Ragdoll& ragdoll : written.all<scene::Ragdoll>()) {
        if (!isEdited(ragdoll)) continue;
        if (ragdoll.model.empty()) ragdoll.model = character().file;
        if (ragdoll.profile.empty() && hasProfile) ragdoll.profile = profileFile();
    }
    if (auto saved = scene::saveScene(file, written); !saved) return saved;
    setSceneFile(file);
    return {};
}

}  // namespace lutka::editor
