#pragma once

#include <filesystem>
#include <functional>

#include "core/result.hpp"
#include "editor/document/scene_settings.hpp"
#include "render/extent.hpp"
#include "scene/asset/ragdoll_asset.hpp"
#include "scene/run/frame_loop.hpp"

namespace lutka::editor {

struct EditorOptions {
    std::filesystem::path model;
    /// Shown in the place of a `model` that is no humanoid, while the user is offered a ragdoll of any skeleton for
    /// that; empty: such a model is refused.
    std::filesystem::path standIn;
    /// Of any rig: weighed by its volume unless the caller wants a total.
    scene::LoadOptions load = [] {
        scene::LoadOptions plain;
        plain.fit.weighByVolume = true;
        return plain;
    }();
    scene::Ragdoll asInScene;  ///< How a scene's file wants `model` to be taken; only `figure` and `rig` count.
    SceneSettings scene;
    std::filesystem::path sceneFile;  ///< *.scene.json in place of `scene`; `model` may be empty then.
    std::function<void(physics::WorldSettings&)> applyToWorld;  ///< Set: what was asked for beside the scene.
    render::Extent window{1280, 720};
    bool playing = true;
    bool spareSubsteps = false;      ///< While the machine is late: see Player::setSparing().
    std::filesystem::path recovery;  ///< Where unsaved work is kept safe (RecoveryKeeper); empty: nowhere.
    scene::FrameLoop::Clock clock;   ///< Times the steps; none: as scene::FrameLoop says, for scripts and tests.
};
/// The options with the scene's file read: its first character is the model, unless another was asked for. Fails as
/// scene::loadScene() does.
[[nodiscard]] Result<EditorOptions> withSceneRead(const EditorOptions& options);

}  // namespace lutka::editor
