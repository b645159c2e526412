#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "editor/editor_options.hpp"
#include "editor/files/file_flow.hpp"
#include "editor/files/open_commands.hpp"
#include "editor/files/recovery_desk.hpp"
#include "editor/input/actions.hpp"
#include "editor/play/motion_commands.hpp"
#include "editor/play/pin_commands.hpp"
#include "editor/states/body_commands.hpp"
#include "editor/states/workspace.hpp"
#include "editor/view/describe_frame.hpp"
#include "editor/view/view_camera.hpp"

namespace lutka::editor {

/// What the user interface has taken for itself.
struct UiCapture {
    bool mouse = false;     ///< The mouse is over a panel, or drags something of it.
    bool keyboard = false;  ///< A text field or another widget has the keyboard.
};

/// The editor without a window, a GPU or a UI: documents, simulation, camera, selection and the state machine, driven
/// by InputEvents and Actions. The application feeds it; panels read it and call it; tests do both.
class Editor {
  public:
    /// Loads the model and sets the scene up; fails as loadRagdoll() and makeScenario() do. With
    /// EditorOptions::standIn a model that is no humanoid is offered as a ragdoll of any skeleton.
    [[nodiscard]] static Result<std::unique_ptr<Editor>> create(const EditorOptions& options);
    /// For a document that is there already.
    [[nodiscard]] static Result<std::unique_ptr<Editor>> create(std::unique_ptr<EditorDocument> document,
                                                                const EditorOptions& options);
    ~Editor();
    Editor(const Editor&) = delete;
    Editor& operator=(const Editor&) = delete;

    /// Events come in the order in which they happened. What a panel has taken does not get here, but for the end of
    /// what began in the view (releases, and movements of a drag).
    void handle(const InputEvent& event, const UiCapture& capture);
    void perform(Action action);
    /// Once a frame, after its events: `seconds` of wall time.
    void update(double seconds);
    /// describeFrame() of what the editor shows now.
    void describe(std::span<const render::CharacterHandle> characters, render::FrameDescription& frame) {
        describeFrame(workspace_, view, drawer_, characters, frame);
    }

    /// An edit of the document on behalf of a panel: ends what is under way in the view, tells failures, and lets the
    /// simulation follow. Whether it succeeded.
    bool edit(const std::function<Result<void>(EditorDocument&)>& change);
    /// Undoes (below 0) or redoes so many changes at once, what moved in the scene included.
    void travel(int changes);
    /// Selects from a panel; nothing empties the selection.
    void select(std::optional<Item> item, bool add = false);
    /// A body on a joint, selected.
    void addBody(int joint);
    void beginAdd(scene::EntityKind kind);
    /// edit() of the scene's entities. `group`: see UndoStack.
    bool editScene(const std::string& label, const std::string& group,
                   const std::function<void(scene::EntityScene&)>& change);
    /// The scene from its start, as part of a change that undo knows already.
    void restart();
    /// The view shows all of the scene from its side.
    void frameScene() { camera_.frameScene(); }
    /// Adds so many of the edited character in the air over the middle, each turned another way.
    void dropCopies(int count);
    /// Shows another clip of the file (Action::toggleClips).
    void showClip(const std::string& clip) { motion_.showClip(clip); }
    /// What the characters follow with their muscles; unset: they fall.
    void setPuppets(const std::optional<scene::ScenePuppets>& puppets);
    /// What they get when muscles are switched on (MotionCommands::firstMuscles()).
    [[nodiscard]] scene::ScenePuppets firstMuscles() const { return motion_.firstMuscles(); }
    /// The view becomes that of a camera, and back: the camera is placed where the view is.
    void lookThrough(scene::EntityId camera) { camera_.lookThrough(camera); }
    void placeCamera(scene::EntityId camera);
    /// Makes this character, whose model or profile are others, the one that the panels edit. Asks first when there are
    /// unsaved changes of the ragdoll.
    void editCharacter(scene::EntityId character) { opening_.editCharacter(character); }
    /// Asks for the joint of a role, or of a new body, by a click in the view.
    void beginPickJoint(std::optional<animation::Role> role);
    /// Ends that: takes the joint under the mouse, or none.
    void endPickJoint(bool take);
    /// Swings the joint of the active body through its limits while the simulation stands still; anything that the
    /// user does ends it, with the doll where it was.
    void swingLimits();
    void endSwing() { motion_.endSwing(); }
    [[nodiscard]] const LimitSwing* swing() const { return motion_.swing(); }

    /// Opens a model (*.ragdoll.json: a profile for the present one; *.scene.json: a scene); the old scene stays when
    /// that fails. Asks first when there are unsaved changes.
    void open(const std::filesystem::path& file) { opening_.open(file); }
    /// Another figure of the present model's file, counted from 1; asks first when there are unsaved changes.
    void openFigure(int figure) { opening_.openFigure(figure); }
    /// The model before (below 0) or after the present one in its folder, by name; the first follows the last.
    void openBeside(int step) { opening_.openBeside(step); }
    /// Reads the model's file again, as another program has written it; the user's edits stay. Undo begins anew.
    void reload() { opening_.reload(); }
    /// Whether reload() is called by itself when the file changes.
    bool watching = true;
    /// Whether what is opened from now on may take files from outside of its model's folder.
    void allowOutside(bool allowed) { opening_.allowOutside(allowed); }
    [[nodiscard]] bool allowsOutside() const { return opening_.load().import.allowOutside; }
    /// Unsaved work of sessions that ended by force, offered one by one.
    [[nodiscard]] const RecoveryDesk& recovery() const { return recovery_; }
    /// Answers for the one that is offered: restored it is opened with its changes unsaved.
    void answerRecovery(RecoveryDesk::Answer answer);
    /// The session is cut short: what is unsaved is kept now.
    void keepRecovery();
    /// Takes the offered profile (FileFlow::offeredProfile()), or not.
    void answerOffer(bool take) { opening_.answerOffer(take); }
    using AnyRig = OpenCommands::AnyRig;
    void answerAnyRig(AnyRig answer) { opening_.answerAnyRig(answer); }
    /// Saving, exporting, and the questions about files.
    [[nodiscard]] FileFlow& files() { return files_; }
    [[nodiscard]] const FileFlow& files() const { return files_; }

    /// A dialog that the UI should show; the UI clears it.
    enum class Dialog {
        none,
        openModel,
        saveAs,
        exportBaked,
        exportRagdoll,  ///< In another engine's format.
        saveSceneAs,
        saveRecording,
        openRecording,
        chooseModel,    ///< Of a character of the scene …
        chooseProfile,  ///< … and its profile: UiState::browsing has what for.
        chooseSky,
    };
    Dialog dialog = Dialog::none;

    [[nodiscard]] EditorDocument& document() { return *workspace_.document; }
    [[nodiscard]] const EditorDocument& document() const { return *workspace_.document; }
    [[nodiscard]] Player& player() { return *workspace_.player; }
    [[nodiscard]] const Player& player() const { return *workspace_.player; }
    [[nodiscard]] Workspace& workspace() { return workspace_; }
    [[nodiscard]] const Workspace& workspace() const { return workspace_; }
    [[nodiscard]] State state() const { return machine_->state(); }
    /// Wall time of all poses in the last describe(), milliseconds.
    [[nodiscard]] double poseMs() const { return drawer_.poseMs(); }
    [[nodiscard]] bool quitting() const { return quitting_; }
    /// Grows when another character was loaded: the renderer's copy is then out of date.
    [[nodiscard]] int characterRevision() const { return opening_.characterRevision(); }

    ViewSettings view;

  private:
    /// What perform() does. `endsSwing`: unless it only changes how things look.
    struct Command {
        Action action = Action::quit;
        bool endsSwing = true;
        void (*run)(Editor&) = nullptr;
    };
    [[nodiscard]] static std::span<const Command> commands();

    Editor();
    /// The options under which what readers print goes into the log as well, while this editor lives.
    [[nodiscard]] EditorOptions hearReaders(EditorOptions options);
    /// Sets up what is opened; once, before anything else.
    Result<void> begin(std::unique_ptr<EditorDocument> opened, const EditorOptions& options);
    void handleMouseButton(const InputEvent& event, const UiCapture& capture);
    void handleKey(const InputEvent& event, const UiCapture& capture);
    /// Whether a key that goes down was for the help, a swing or an offer, which it ended.
    bool answersBy(const InputEvent& event);
    [[nodiscard]] bool busy() const;
    /// Makes the state follow the selection, and ends what is under way in the view.
    void settle();
    void endTransform();
    /// One of them, after what is under way in the view has ended.
    void onBodies(void (BodyCommands::*command)());
    void nextTool();
    void quit();
    void toggleHandles();

    Workspace workspace_;
    ViewCamera camera_{workspace_};
    PinCommands pins_{workspace_};
    BodyCommands bodies_{workspace_};
    MotionCommands motion_{workspace_};
    FileFlow files_;
    OpenCommands opening_;
    std::unique_ptr<StateMachine> machine_;
    scene::SimulationDrawer drawer_;
    std::array<bool, kMouseButtonCount> held_{};  // pressed in the view and not released yet
    RecoveryDesk recovery_;
    bool quitting_ = false;
};

}  // namespace lutka::editor
