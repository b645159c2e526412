#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "editor/document/editor_document.hpp"
#include "editor/input/input_event.hpp"
#include "editor/play/player.hpp"
#include "editor/play/pulls.hpp"
#include "editor/states/state_machine.hpp"
#include "editor/view/gizmo.hpp"
#include "editor/view/handles.hpp"
#include "editor/view/picking.hpp"
#include "editor/view/selection.hpp"
#include "render/frame.hpp"

namespace lutka::editor {

/// A sentence for the user that goes away by itself.
struct Toast {
    enum class Kind { info, warning, error };
    Kind kind = Kind::info;
    std::string text;
    float secondsLeft = 4.0F;
};

/// A line of the log.
struct LogLine {
    Toast::Kind kind = Toast::Kind::info;
    std::string text;
};

/// What the states work on. Owned by the Editor; handlers borrow it.
struct Workspace {
    std::unique_ptr<EditorDocument> document;
    std::unique_ptr<Player> player;
    render::Camera camera;
    render::Extent window;          ///< In window coordinates, like the mouse.
    render::PictureInsets covered;  ///< What bars and panels lie over.
    Selection selection;
    Pulls pulls;

    vec2 mouse{0, 0};
    /// Where the left button went down in the view, and on what; set while it is held.
    struct Press {
        vec2 position{0, 0};
        std::optional<Pick> pick;
        bool wasSelected = false;  ///< `pick` was, before it was pressed.
        vec3 bodyPoint{0, 0, 0};   ///< pick->position in the frame of pick->body, which goes on falling.
    };
    std::optional<Press> press;
    MouseButton cameraButton = MouseButton::middle;  ///< What drags the camera.

    Tool tool = Tool::select;
    float hitNs = 30.0F;                ///< What Tool::hit hits with, N s …
    std::optional<Pick> hit;            ///< … and what a click has hit, until the editor lets it act.
    bool localAxes = false;             ///< Of the gizmo: the item's own instead of the world's.
    std::optional<AxisLock> hotGizmo;   ///< The part of the gizmo under the mouse.
    std::optional<AxisLock> gizmoLock;  ///< What a transform that begins now is locked to by the gizmo.
    /// What State::box selects, window coordinates.
    struct Box {
        vec2 low{0, 0};
        vec2 high{0, 0};
    };
    std::optional<Box> box;

    float uiScale = 1.0F;         ///< What a finger's breadth is: reach of handles and joints under the mouse.
    std::optional<int> followed;  ///< The doll that the camera goes along with.
    bool showHandles = true;      ///< Of the active body's limits and shape.
    bool skinShown = true;        ///< The view draws skin: what is not seen is not picked.
    std::optional<Handle::Kind> hotHandle;    ///< Hovered or held.
    std::optional<animation::Role> pickRole;  ///< What State::pickJoint asks the joint of; none: a new body's …
    int hotJoint = animation::kNoJoint;       ///< … and the joint under the mouse then.
    std::optional<EditorDocument::PartValues> clipboard;

    scene::EntityKind addKind = scene::EntityKind::box;
    std::optional<RigidTransform> ghost;  ///< Where State::add would place it.
    float frameSeconds = 0.0F;            ///< Wall time of the present frame.
    std::string hint;                     ///< What the present state is doing, for the status bar.
    render::LineBatch overlay;            ///< Lines of the present state, made anew each frame.
    std::vector<Toast> toasts;
    std::vector<LogLine> log;

    [[nodiscard]] render::Ray mouseRay() const { return render::worldRay(camera, mouse, window); }
    /// What a click there is for: an object, a body, or skin of one beside its shapes.
    [[nodiscard]] std::optional<Pick> pickUnderMouse() const;
    /// The same without skin, for every frame: that is posed anew for each look at it.
    [[nodiscard]] std::optional<Pick> shapeUnderMouse() const;
    /// The active body as its handles see it, at the pose that is shown; nothing when no body is active.
    [[nodiscard]] std::optional<HandleScene> handleScene() const;
    [[nodiscard]] std::optional<Handle> handleUnderMouse() const;
    /// Of the active item, as the tool has it.
    [[nodiscard]] std::optional<Gizmo> gizmo() const;
    [[nodiscard]] std::optional<AxisLock> gizmoUnderMouse() const;
    /// Zooms to what is under the mouse: that stays where it is seen.
    void zoom(float notches);
    /// Where a doll's joints are shown, world; jointCount() long.
    [[nodiscard]] std::vector<vec3> worldOfJoints(int doll) const;
    /// The bodies of the profile that are selected in any doll, each once, the active one last.
    [[nodiscard]] std::vector<int> selectedBodies() const;
    /// The document's edit on behalf of a state, told when it fails; the simulation follows. Whether it succeeded.
    bool edit(const std::function<Result<void>(EditorDocument&)>& change);
    /// Where an item's origin is now, world; a body's is its centre of mass.
    [[nodiscard]] vec3 positionOf(const Item& item) const;
    /// An item's own frame, world.
    [[nodiscard]] RigidTransform frameOf(const Item& item) const;
    [[nodiscard]] std::string nameOf(const Item& item) const;
    /// Makes the simulation follow the document, when that has changed.
    void follow();
    /// Begins or ends posing in a paused scene; pulls stay.
    void pose(bool on);
    /// What runs now with its pins, for undo; null while a crowd is too large to be kept with every change.
    [[nodiscard]] std::shared_ptr<const PlayState> playState() const;
    /// Goes back to such a state: its pins, and, with `motion`, where everything was.
    void restore(const PlayState& state, bool motion);
    /// Tells the user about a failure; nothing for success. Whether it was one.
    bool report(const Result<void>& result);
    void say(Toast::Kind kind, std::string text);
    /// Into the log alone.
    void note(Toast::Kind kind, std::string text);

    /// Which end of a state this is.
    [[nodiscard]] Trigger ended() const {
        return selection.empty() ? Trigger::endedWithNothing : Trigger::endedWithSelection;
    }

    /// What the selection's indices mean from now on, after another document was opened.
    void rememberBodies();

  private:
    [[nodiscard]] std::optional<Pick> underMouse(bool skin) const;
    /// Selected bodies keep their names when others come or go.
    void followBodies();

    std::vector<std::string> bodyNames_;  // that the selection's indices mean
};

/// One handler for each state, all working on `workspace`, which must outlive them.
[[nodiscard]] StateMachine::Handlers makeHandlers(Workspace& workspace);

}  // namespace lutka::editor
