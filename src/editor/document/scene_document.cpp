#include "editor/document/scene_document.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "animation/clip_reference.hpp"
#include "scene/description/scene_file.hpp"

namespace lutka::editor {
namespace {

namespace fs = std::filesystem;

bool samePath(const fs::path& a, const fs::path& b) {
    std::error_code failed;
    return fs::weakly_canonical(a, failed) == fs::weakly_canonical(b, failed);
}

bool hasClip(const scene::RagdollAsset& asset, const std::string& name) {
    return animation::clipMeant(asset.character.clips, name) >= 0;
}

}  // namespace

void takeAs(const scene::Ragdoll& character, scene::LoadOptions& load) {
    if (character.figure) load.import.figure = character.figure;
    if (character.rig) load.fit.rig = *character.rig;
}

void SceneDocument::setOrigin(const animation::ImportOptions& import, const physics::FitOptions& fit,
                              const fs::path& profile) {
    load_.import = import;
    load_.fit = fit;
    openedWith_ = profile;
}

void SceneDocument::setProfileFile(const fs::path& file, bool exists) {
    profileFile_ = file;
    profileExists_ = exists;
    compare();
}

const fs::path& SceneDocument::modelOf(const scene::Ragdoll& ragdoll) const {
    return ragdoll.model.empty() ? edited_.character.file : ragdoll.model;
}

bool SceneDocument::isEdited(const scene::Ragdoll& ragdoll) const {
    if (!ragdoll.model.empty() && !samePath(ragdoll.model, edited_.character.file)) return false;
    if (ragdoll.figure && *ragdoll.figure != edited_.character.figure + 1) return false;
    const auto rig = physics::hasRoles(edited_.profile) ? physics::RigKind::humanoid : physics::RigKind::any;
    if (ragdoll.rig && *ragdoll.rig != rig) return false;
    if (ragdoll.profile.empty()) return ragdoll.model.empty() || openedWith_.empty();
    return samePath(ragdoll.profile, profileFile_) || samePath(ragdoll.profile, openedWith_);
}

SceneDocument::OtherKey SceneDocument::keyOf(const scene::Ragdoll& ragdoll) const {
    return {modelOf(ragdoll), ragdoll.figure.value_or(0), ragdoll.profile, ragdoll.rig.value_or(load_.fit.rig)};
}

Result<void> SceneDocument::loadOthers(const scene::EntityScene& scene) {
    for (const scene::Ragdoll& ragdoll : scene.all<scene::Ragdoll>()) {
        if (isEdited(ragdoll)) continue;
        const fs::path& model = modelOf(ragdoll);
        const OtherKey key = keyOf(ragdoll);
        if (others_.contains(key)) continue;
        scene::LoadOptions load = load_;
        load.import.figure.reset();
        takeAs(ragdoll, load);
        if (!ragdoll.profile.empty()) load.profile = ragdoll.profile;
        auto asset = scene::loadRagdoll(model, load);
        if (!asset) return asset.error();
        others_.emplace(key, std::move(asset).value());
    }
    return {};
}

const scene::RagdollAsset& SceneDocument::assetOf(const scene::Ragdoll& ragdoll) const {
    if (isEdited(ragdoll)) return edited_;
    const auto other = others_.find(keyOf(ragdoll));
    return other != others_.end() ? *other->second : edited_;
}

std::vector<const scene::RagdollAsset*> SceneDocument::assets() const {
    std::vector<const scene::RagdollAsset*> all{&edited_};
    for (const scene::Ragdoll& ragdoll : scene().all<scene::Ragdoll>()) {
        const scene::RagdollAsset* asset = &assetOf(ragdoll);
        if (std::find(all.begin(), all.end(), asset) == all.end()) all.push_back(asset);
    }
    return all;
}

std::vector<int> SceneDocument::assetOfRagdoll() const {
    const std::vector<const scene::RagdollAsset*> all = assets();
    std::vector<int> indices;
    for (const scene::Ragdoll& ragdoll : scene().all<scene::Ragdoll>()) {
        const auto at = std::find(all.begin(), all.end(), &assetOf(ragdoll));
        indices.push_back(static_cast<int>(at - all.begin()));
    }
    return indices;
}

// What the simulation would refuse is refused here, before anything is changed.
Result<void> SceneDocument::check(SceneSettings& scene) {
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
    if (scene.clip && !hasClip(edited_, scene.clip->clip)) scene.clip.reset();
    return {};
}

Result<void> SceneDocument::start(SceneSettings settings) {
    if (settings.entities.entities.empty()) {
        const auto figure = scene::figureBounds(edited_.profile, edited_.rig);
        if (auto made = makeNamedScene(settings, figure); !made) return made;
    }
    if (auto checked = check(settings); !checked) return checked;
    settings_ = std::move(settings);
    settings_.begun = settings_.entities;
    unsaved_ = false;
    return {};
}

Result<SceneSettings> SceneDocument::prepare(SceneSettings settings) {
    const bool anew =
        settings.scenario != settings_.scenario || settings.count != settings_.count || settings.seed != settings_.seed;
    if (anew) {
        const auto figure = scene::figureBounds(edited_.profile, edited_.rig);
        if (auto made = makeNamedScene(settings, figure); !made) return made.error();
    }
    return prepareMade(std::move(settings));
}

Result<SceneSettings> SceneDocument::prepareMade(SceneSettings settings) {
    if (auto checked = check(settings); !checked) return checked.error();
    return settings;
}

// A named scene that was not saved yet counts as changed when its entities are: who tries another gravity has made
// nothing that could be lost.
void SceneDocument::adopt(SceneSettings settings) {
    settings_ = std::move(settings);
    compare();
}

// A scene whose file names no profile, or an older one, has to be saved again when the ragdoll was.
void SceneDocument::compare() {
    const scene::EntityScene& now = settings_.entities;
    const scene::EntityScene& begun = settings_.begun;
    const bool namesProfile = !profileExists_ || !savedProfile_ || samePath(*savedProfile_, profileFile_);
    unsaved_ = hasFile() ? now != saved_ || !namesProfile
                         : now.entities != begun.entities || now.components != begun.components;
}

void SceneDocument::setFile(const fs::path& file) {
    file_ = file;
    saved_ = settings_.entities;
    savedProfile_.reset();
    unsaved_ = false;
}

void SceneDocument::takeFileOf(const SceneDocument& old) {
    file_ = old.file_;
    saved_ = old.saved_;
    savedProfile_ = old.savedProfile_;
    settings_.begun = old.settings_.begun;
    compare();
}

fs::path SceneDocument::file() const {
    if (!file_.empty()) return file_;
    return edited_.character.file.parent_path() / (scene().name + ".scene.json");
}

Result<void> SceneDocument::write(const fs::path& file) const {
    scene::EntityScene written = scene();
    for (scene::Ragdoll& ragdoll : written.all<scene::Ragdoll>()) {
        if (!isEdited(ragdoll)) {
            // The file is read where nobody says how to take them.
            if (!ragdoll.rig && ragdoll.profile.empty() && load_.fit.rig == physics::RigKind::any)
                ragdoll.rig = physics::RigKind::any;
            continue;
        }
        if (ragdoll.model.empty()) ragdoll.model = edited_.character.file;
        if (edited_.character.figures.size() > 1) ragdoll.figure = edited_.character.figure + 1;
        if (!physics::hasRoles(edited_.profile)) ragdoll.rig = physics::RigKind::any;
        if (ragdoll.profile.empty() && profileExists_) ragdoll.profile = profileFile_;
    }
    return scene::saveScene(file, written);
}

Result<void> SceneDocument::save(const fs::path& file) {
    if (auto saved = write(file); !saved) return saved;
    setFile(file);
    savedProfile_ = profileExists_ ? profileFile_ : fs::path();
    return {};
}

}  // namespace lutka::editor
