#include "editor/document/open_document.hpp"

#include "physics/profile/profile_io.hpp"

namespace lutka::editor {
namespace {

using Opened = Result<std::unique_ptr<EditorDocument>>;

Opened openAsset(const scene::Ragdoll& character, scene::LoadOptions load, const EditorDocument& present) {
    const physics::FitOptions others = load.fit;
    load.profile.reset();
    load.import.figure.reset();
    takeAs(character, load);
    if (!character.profile.empty()) load.profile = character.profile;
    return EditorDocument::open(character.model.empty() ? present.character().file : character.model, load, others);
}

Opened started(Opened opened, const SceneSettings& scene) {
    if (!opened) return opened;
    if (auto started = opened.value()->startScene(scene); !started) return started.error();
    return opened;
}

}  // namespace

Opened openModel(const std::filesystem::path& file, const scene::LoadOptions& load, const EditorDocument& present,
                 const scene::Ragdoll& as) {
    SceneSettings settings = present.sceneDocument().settings();
    for (scene::Ragdoll& ragdoll : settings.entities.all<scene::Ragdoll>()) {
        if (!present.sceneDocument().isEdited(ragdoll)) continue;
        ragdoll.model.clear();
        ragdoll.figure.reset();
        ragdoll.rig.reset();
        ragdoll.profile.clear();
        ragdoll.clip.reset();  // of the old one
    }
    scene::LoadOptions plain = load;
    plain.profile.reset();
    plain.import.figure.reset();
    takeAs(as, plain);
    return started(EditorDocument::open(file, plain, load.fit), settings);
}

Opened reopenModel(const scene::LoadOptions& load, const EditorDocument& present) {
    scene::LoadOptions plain = load;
    plain.profile.reset();
    plain.fit = present.state().fit;
    plain.import.figure.reset();
    if (present.character().figures.size() > 1) plain.import.figure = present.character().figure + 1;
    auto opened =
        started(EditorDocument::open(present.character().file, plain, load.fit), present.sceneDocument().settings());
    if (!opened) return opened;
    if (auto taken = opened.value()->takeEditsOf(present); !taken) return taken.error();
    opened.value()->sceneDocument().takeFileOf(present.sceneDocument());
    return opened;
}

Opened openCharacter(const scene::Ragdoll& character, const scene::LoadOptions& load, const EditorDocument& present) {
    SceneSettings settings = present.sceneDocument().settings();
    // Who had no model had that of the document, which is another one from now on.
    for (scene::Ragdoll& one : settings.entities.all<scene::Ragdoll>()) {
        if (one.model.empty()) one.model = present.character().file;
    }
    settings.scenario.clear();
    settings.made.clear();
    auto opened = started(openAsset(character, load, present), settings);
    if (opened && present.sceneDocument().hasFile())
        opened.value()->sceneDocument().setFile(present.sceneDocument().file());
    return opened;
}

Opened openScene(const std::filesystem::path& file, const scene::EntityScene& scene, const scene::LoadOptions& load,
                 const EditorDocument& present) {
    for (const scene::Entity& entity : scene.entities) {
        const auto* ragdoll = scene.find<scene::Ragdoll>(entity.id);
        if (ragdoll == nullptr) continue;
        if (present.sceneDocument().isEdited(*ragdoll)) break;
        SceneSettings settings = present.sceneDocument().settings();
        settings.entities = scene;
        settings.scenario.clear();
        settings.made.clear();
        settings.clip.reset();
        auto opened = started(openAsset(*ragdoll, load, present), settings);
        if (opened) opened.value()->sceneDocument().setFile(file);
        return opened;
    }
    return std::unique_ptr<EditorDocument>();
}

Result<physics::BoundProfile> profileFor(const std::filesystem::path& file, const animation::Character& character,
                                         const animation::HumanoidMap& map) {
    auto profile = physics::loadProfile(file);
    if (!profile) return profile.error();
    auto bound = physics::bindOrRebind(std::move(profile).value(), character, map);
    if (bound) return bound;
    Error error = bound.error();
    error.location = file.string();
    return error;
}

std::string profileNews(const EditorDocument& document, const std::filesystem::path& file) {
    const std::string name = file.filename().string();
    return document.profileFile() == file ? "Opened the profile " + name
                                          : name + " was made for another rig and is bound by role";
}

}  // namespace lutka::editor
