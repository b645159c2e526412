#include "editor/editor_options.hpp"

#include "core/files.hpp"
#include "scene/description/scene_file.hpp"

namespace lutka::editor {

Result<EditorOptions> withSceneRead(const EditorOptions& options) {
    const auto scene = scene::loadScene(options.sceneFile);
    if (!scene) return scene.error();
    EditorOptions all = options;
    for (const scene::Entity& entity : scene.value().entities) {
        const auto* ragdoll = scene.value().find<scene::Ragdoll>(entity.id);
        if (ragdoll == nullptr || ragdoll->model.empty() || !options.model.empty()) continue;
        all.model = ragdoll->model;
        all.asInScene = *ragdoll;
        if (!ragdoll->profile.empty()) all.load.profile = ragdoll->profile;
        break;
    }
    if (all.model.empty()) {
        auto own = findAsset("models/mannequin.glb");
        if (!own) return own.error();
        all.model = own.value();
    }
    all.scene.entities = scene.value();
    all.scene.scenario.clear();
    return all;
}

}  // namespace lutka::editor
