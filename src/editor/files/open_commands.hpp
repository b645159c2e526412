#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "editor/files/file_flow.hpp"
#include "editor/files/file_watch.hpp"
#include "editor/play/motion_commands.hpp"
#include "editor/states/workspace.hpp"
#include "editor/view/view_camera.hpp"

namespace lutka::editor {

/// Puts another document in the place of the edited one: a model, a scene, another character of the scene. The present
/// one stays when that fails, and the user is told. What is unsaved is asked about first (FileFlow::afterUnsaved()).
class OpenCommands {
  public:
    /// `settle` ends what is under way in the view and makes the state follow the selection.
    OpenCommands(Workspace& workspace, MotionCommands& motion, ViewCamera& camera, FileFlow& files,
                 std::function<void()> settle)
        : workspace_(workspace), motion_(motion), camera_(camera), files_(files), settle_(std::move(settle)) {}

    /// How models are read and how players measure time; before anything else.
    void begin(const scene::LoadOptions& load, scene::FrameLoop::Clock clock);
    /// A document and the player that was built for it, as they are. The view shows all of the scene.
    void take(std::unique_ptr<EditorDocument> document, std::unique_ptr<Player> player);
    /// Takes what was opened, with the scene from its start; the player goes on as the present one did. `told`: what to
    /// say in place of that it was opened. Whether it was taken.
    bool adopt(Result<std::unique_ptr<EditorDocument>> opened, const std::string& told = "");

    /// A model; a profile for the present one (*.json); a scene (*.scene.json).
    void open(const std::filesystem::path& file);
    /// Another figure of the present model's file, counted from 1.
    void openFigure(int figure);
    /// Tells why a model was refused, and offers it as a ragdoll of any skeleton.
    void offerAnyRig(FileFlow::AnyRigOffer offer);
    /// The model before (below 0) or after the present one in its folder, by name; the first follows the last.
    void openBeside(int step);
    /// Reads the model's file again, as another program has written it; the user's edits stay. Undo begins anew.
    void reload();
    /// `seconds` have passed; whether the model's file was written by somebody else since it was read.
    [[nodiscard]] bool fileChanged(double seconds) { return watch_.changed(seconds); }
    /// Makes this character of the scene the edited one.
    void editCharacter(scene::EntityId character);
    /// Takes the offered profile (FileFlow::offeredProfile()), or not.
    void answerOffer(bool take);
    /// What becomes of the refused model (FileFlow::offeredAnyRig()): a ragdoll of any skeleton, one body to begin with
    /// by hand, or nothing.
    enum class AnyRig { whole, byHand, leave };
    void answerAnyRig(AnyRig answer);

    /// How models are read.
    [[nodiscard]] const scene::LoadOptions& load() const { return load_; }
    /// Whether what is opened from now on may take files from outside of its model's folder.
    void allowOutside(bool allowed) { load_.import.allowOutside = allowed; }
    /// Grows with each adopted document.
    [[nodiscard]] int characterRevision() const { return characterRevision_; }

  private:
    [[nodiscard]] const EditorDocument& document() const { return *workspace_.document; }
    void openScene(const std::filesystem::path& file);
    /// Ends what moves in the view: the user's drag and the swing through limits.
    void endUnderWay();
    /// Whether the change of the present document succeeded.
    bool edit(const std::function<Result<void>(EditorDocument&)>& change);
    void selectNothing();

    Workspace& workspace_;
    MotionCommands& motion_;
    ViewCamera& camera_;
    FileFlow& files_;
    std::function<void()> settle_;
    scene::LoadOptions load_;
    scene::FrameLoop::Clock clock_;
    FileWatch watch_;
    std::filesystem::path unread_;  // the last file that could not be opened, since one was: the next one is beside it
    int characterRevision_ = 0;
};

}  // namespace lutka::editor
