/// Editor's part in scenes: edits of entities, cameras, files of scenes.

#include <fmt/format.h>

#include <algorithm>

#include "core/random.hpp"
#include "editor/editor.hpp"
#include "scene/scene_file.hpp"

namespace lutka::editor {

bool Editor::editScene(const std::string& label, const std::string& group,
                       const std::function<void(scene::EntityScene&)>& change) {
    SceneSettings settings = document().state().scene;
    change(settings.entities);
    return edit([&](EditorDocument& document) { return document.setScene(settings, label, group); });
}

void Editor::dropCopies(int count) {
    constexpr float spacing = 1.1F;
    constexpr float lowest = 2.4F;  // metres over the floor: above who stands there
    constexpr float storey = 2.2F;
    constexpr int side = 4;
    SceneSettings settings = document().state().scene;
    Random random(settings.entities.entities.size());
    for (int i = 0; i < count; ++i) {
        const int place = i % (side * side);
        const int row = place / side;
        const int level = i / (side * side);
        const float middle = (static_cast<float>(std::min(count, side * side)) / static_cast<float>(side) - 1) * 0.5F;
        const vec3 at{(static_cast<float>(place % side) - 1.5F) * spacing * (count > 1 ? 1.0F : 0.0F),
                      lowest + storey * static_cast<float>(level), (static_cast<float>(row) - middle) * spacing};
        const quat turn = glm::angleAxis(random.uniform(-kPi, kPi), vec3(0, 1, 0)) *
                          glm::angleAxis(random.uniform(-0.5F, 0.5F), vec3(1, 0, 0));
        scene::addEntity(settings.entities, scene::EntityKind::character, {turn, at});
    }
    edit([&](EditorDocument& document) {
        return document.setScene(settings, fmt::format("Drop {} copies", count), "");
    });
}

void Editor::lookThrough(scene::EntityId id) {
    const scene::EntityScene& scene = document().scene();
    const auto* camera = scene.find<scene::Camera>(id);
    if (camera == nullptr) return;
    workspace_.camera = scene::viewOf(*camera, scene::worldFromEntity(scene, id));
}

void Editor::placeCamera(scene::EntityId id) {
    const render::Camera& seen = workspace_.camera;
    const mat3 axes(render::rightOf(seen), render::upOf(seen), -render::forwardOf(seen));
    const RigidTransform world{glm::normalize(glm::quat_cast(axes)), render::eyeOf(seen)};
    editScene("Place the camera at the view", "", [&](scene::EntityScene& scene) {
        scene::placeEntity(scene, id, world);
        scene::Camera& camera = *scene.find<scene::Camera>(id);
        camera.fieldOfView = seen.fieldOfView;
        camera.distance = seen.distance;
        camera.orthographic = seen.orthographic;
    });
}

void Editor::editCharacter(scene::EntityId id) {
    const auto* ragdoll = document().scene().find<scene::Ragdoll>(id);
    if (ragdoll == nullptr) return;
    const scene::Ragdoll wanted = *ragdoll;
    const auto change = [this, wanted] {
        SceneSettings settings = document().state().scene;
        // Who had no model had that of the document, which is another one from now on.
        for (scene::Ragdoll& one : settings.entities.all<scene::Ragdoll>()) {
            if (one.model.empty()) one.model = document().character().file;
        }
        settings.scenario.clear();
        settings.made.clear();
        scene::LoadOptions load = load_;
        load.profile.reset();
        if (!wanted.profile.empty()) load.profile = wanted.profile;
        auto opened = EditorDocument::open(wanted.model.empty() ? document().character().file : wanted.model, load);
        if (!opened) return static_cast<void>(workspace_.report(opened.error()));
        if (workspace_.report(opened.value()->startScene(settings))) return;
        if (document().hasSceneFile()) opened.value()->setSceneFile(document().sceneFile());
        const render::Camera seen = workspace_.camera;
        adoptStarted(std::move(opened).value());
        workspace_.camera = seen;
    };
    if (document().unsaved()) {
        afterUnsaved(change);
    } else {
        change();
    }
}

Result<std::unique_ptr<EditorDocument>> Editor::openForScene(const scene::EntityScene& scene) const {
    for (const scene::Entity& entity : scene.entities) {
        const auto* ragdoll = scene.find<scene::Ragdoll>(entity.id);
        if (ragdoll == nullptr) continue;
        if (document().isEdited(*ragdoll)) return std::unique_ptr<EditorDocument>();
        scene::LoadOptions load = load_;
        load.profile.reset();
        if (!ragdoll->profile.empty()) load.profile = ragdoll->profile;
        return EditorDocument::open(ragdoll->model.empty() ? document().character().file : ragdoll->model, load);
    }
    return std::unique_ptr<EditorDocument>();
}

void Editor::openSceneNow(const std::filesystem::path& file) {
    const auto scene = scene::loadScene(file);
    if (!scene) return workspace_.say(Toast::Kind::error, scene.error().text());
    auto other = openForScene(scene.value());
    if (!other) return workspace_.say(Toast::Kind::error, other.error().text());
    if (other.value() == nullptr) {
        // The character that is edited is the scene's first one: its ragdoll stays as it is.
        if (!edit([&](EditorDocument& document) { return document.useScene(file, scene.value()); })) return;
        select(std::nullopt);
        perform(Action::reset);
        workspace_.camera = startCamera(player().simulation(), workspace_.window);
    } else {
        SceneSettings settings = document().state().scene;
        settings.entities = scene.value();
        settings.scenario.clear();
        settings.made.clear();
        settings.clip.reset();
        if (workspace_.report(other.value()->startScene(settings))) return;
        other.value()->setSceneFile(file);
        adoptStarted(std::move(other).value());
    }
    workspace_.say(Toast::Kind::info, "Opened the scene " + file.filename().string());
}

bool Editor::requestSaveScene(const std::filesystem::path& file, std::function<void()> afterwards) {
    const auto write = [this, file] {
        if (workspace_.report(document().saveScene(file))) return false;
        workspace_.say(Toast::Kind::info, "Saved the scene " + file.string());
        if (document().unsaved()) {
            workspace_.say(Toast::Kind::warning, "The ragdoll itself has unsaved changes: Ctrl+S saves its profile");
        }
        return true;
    };
    std::error_code failed;
    const bool ours = document().hasSceneFile() && file == document().sceneFile();
    if (ours || !std::filesystem::exists(file, failed)) return write();
    endTransform();
    replacing_ = Replacing{file, write, std::move(afterwards)};
    return false;
}

void Editor::requestSaveRecording(const std::filesystem::path& file) {
    const auto write = [this, file] {
        if (workspace_.report(player().deck().save(file))) return false;
        workspace_.say(Toast::Kind::info, "Saved the recording " + file.string());
        return true;
    };
    std::error_code failed;
    if (!std::filesystem::exists(file, failed)) {
        write();
        return;
    }
    replacing_ = Replacing{file, write, {}};
}

// Ctrl+S: the profile, and the scene when it has a file. One that has none is saved by its own command: a ragdoll that
// is edited in a named scene should not leave scene files behind.
void Editor::saveAll() {
    const bool scene = document().sceneUnsaved() && document().hasSceneFile();
    if (scene) requestSaveScene(document().sceneFile());
    if (document().unsaved() || !scene) requestSave(document().profileFile());
}

}  // namespace lutka::editor
