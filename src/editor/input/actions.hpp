#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "editor/input/input_event.hpp"

namespace lutka::editor {

/// What menus, buttons and keys ask for. Editor::perform() does it.
enum class Action {
    openModel,
    openRecent,
    nextFile,
    previousFile,
    reload,
    saveProfile,
    saveProfileAs,
    saveScene,
    saveSceneAs,
    exportBaked,
    exportRagdoll,
    quit,
    undo,
    redo,
    selectNone,
    copyPart,
    pastePart,
    mirrorParts,
    addBody,
    removeBodies,
    mergeBodies,
    splitBodies,
    toggleSymmetric,
    nextTool,
    toggleLocalAxes,
    swingLimits,
    pin,
    unpinAll,
    togglePlay,
    stepOnce,
    reset,
    throwBall,
    returnToPlay,
    selectedOnly,
    fallFromClip,
    goLimp,
    getUp,
    focus,
    followDoll,
    viewFront,
    viewRight,
    viewTop,
    viewBack,
    viewLeft,
    viewBottom,
    toggleParallel,
    selectMirror,
    selectChildren,
    toggleClips,
    toggleDebug,
    toggleHandles,
    togglePanels,
    toggleHelp,
};

/// A key that performs an action.
struct Binding {
    Key key = Key::unknown;
    Modifiers modifiers;
    Action action = Action::togglePlay;
};

/// All bindings; several keys may do the same.
[[nodiscard]] std::span<const Binding> keyBindings();
/// The action of a pressed key, if any. All modifiers must be as the binding has them.
[[nodiscard]] std::optional<Action> actionFor(const InputEvent& event);

[[nodiscard]] std::string_view actionName(Action action);
/// "Ctrl+Shift+Z": the first binding of the action; empty when it has none.
[[nodiscard]] std::string shortcutText(Action action);
[[nodiscard]] std::string shortcutText(const Binding& binding);

/// A line of the help sheet for what the state machine's keys and the mouse do.
struct HelpLine {
    std::string_view keys;
    std::string_view what;
};
[[nodiscard]] std::span<const HelpLine> mouseHelp();

}  // namespace lutka::editor
