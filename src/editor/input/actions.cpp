#include "editor/input/actions.hpp"

#include <array>

namespace lutka::editor {
namespace {

constexpr Modifiers kPlain{};
constexpr Modifiers kShift{true, false, false};
constexpr Modifiers kControl{false, true, false};
constexpr Modifiers kControlShift{true, true, false};
constexpr Modifiers kControlAlt{false, true, true};

constexpr std::array kBindings = {
    Binding{Key::o, kControl, Action::openModel},
    Binding{Key::o, kControlShift, Action::openRecent},
    Binding{Key::pageDown, kPlain, Action::nextFile},
    Binding{Key::pageUp, kPlain, Action::previousFile},
    Binding{Key::f5, kPlain, Action::reload},
    Binding{Key::s, kControl, Action::saveProfile},
    Binding{Key::s, kControlShift, Action::saveProfileAs},
    Binding{Key::s, kControlAlt, Action::saveScene},
    Binding{Key::e, kControl, Action::exportBaked},
    Binding{Key::e, kControlShift, Action::exportRagdoll},
    Binding{Key::q, kControl, Action::quit},
    Binding{Key::z, kControl, Action::undo},
    Binding{Key::z, kControlShift, Action::redo},
    Binding{Key::y, kControl, Action::redo},
    Binding{Key::c, kControl, Action::copyPart},
    Binding{Key::v, kControl, Action::pastePart},
    Binding{Key::m, kControl, Action::mirrorParts},
    Binding{Key::b, kControl, Action::addBody},
    Binding{Key::j, kControl, Action::mergeBodies},
    Binding{Key::k, kControl, Action::splitBodies},
    Binding{Key::m, kShift, Action::toggleSymmetric},
    Binding{Key::t, kPlain, Action::nextTool},
    Binding{Key::t, kShift, Action::toggleLocalAxes},
    Binding{Key::l, kPlain, Action::swingLimits},
    Binding{Key::p, kPlain, Action::pin},
    Binding{Key::p, kShift, Action::unpinAll},
    Binding{Key::space, kPlain, Action::togglePlay},
    Binding{Key::space, kControl, Action::selectedOnly},
    Binding{Key::right, kPlain, Action::stepOnce},
    Binding{Key::r, kControl, Action::reset},
    Binding{Key::b, kPlain, Action::throwBall},
    Binding{Key::f, kPlain, Action::focus},
    Binding{Key::f, kShift, Action::followDoll},
    Binding{Key::digit1, kPlain, Action::viewFront},
    Binding{Key::digit3, kPlain, Action::viewRight},
    Binding{Key::digit7, kPlain, Action::viewTop},
    Binding{Key::digit1, kControl, Action::viewBack},
    Binding{Key::digit3, kControl, Action::viewLeft},
    Binding{Key::digit7, kControl, Action::viewBottom},
    Binding{Key::digit5, kPlain, Action::toggleParallel},
    Binding{Key::m, kControlShift, Action::selectMirror},
    Binding{Key::c, kControlShift, Action::selectChildren},
    Binding{Key::f4, kPlain, Action::toggleClips},
    Binding{Key::f3, kPlain, Action::toggleDebug},
    Binding{Key::h, kPlain, Action::toggleHandles},
    Binding{Key::tab, kPlain, Action::togglePanels},
    Binding{Key::f1, kPlain, Action::toggleHelp},
};

constexpr std::array kMouseHelp = {
    HelpLine{"Left click", "select; with Shift add or take away"},
    HelpLine{"Left drag on a body", "pull it; in a paused scene: pose it"},
    HelpLine{"Left drag on a handle", "change a limit or the shape; Shift: one end or both"},
    HelpLine{"Left drag beside", "orbit"},
    HelpLine{"Right or middle drag", "orbit; with Shift pan"},
    HelpLine{"W A S D Q E", "while orbiting: fly, with Shift faster"},
    HelpLine{"Wheel", "zoom; while pulling: depth"},
    HelpLine{"G  R  S", "grab, rotate, scale the selection"},
    HelpLine{"Ctrl+drag", "select by a box; with Shift add"},
    HelpLine{"X  Y  Z", "during these: along that axis, again: its own; Shift: across"},
    HelpLine{"0-9 . -", "during these: type the value"},
    HelpLine{"P", "while pulling: pin the body there"},
    HelpLine{"Enter, click / Esc, right", "done / cancel"},
    HelpLine{"Shift+A", "add an entity: box, sphere, light …"},
    HelpLine{"X, Delete", "delete the selected bodies or entities"},
    HelpLine{"Drop a file", "open a model, a profile or a scene"},
    HelpLine{"?", "this sheet"},
};

}  // namespace

std::span<const Binding> keyBindings() {
    return kBindings;
}

std::optional<Action> actionFor(const InputEvent& event) {
    if (event.kind != InputEvent::Kind::key || !event.pressed) return std::nullopt;
    for (const Binding& binding : kBindings) {
        if (binding.key == event.key && binding.modifiers == event.modifiers) return binding.action;
    }
    return std::nullopt;
}

std::string_view actionName(Action action) {
    switch (action) {
        case Action::openModel:
            return "Open model";
        case Action::openRecent:
            return "Recent models";
        case Action::nextFile:
            return "Next model of the folder";
        case Action::previousFile:
            return "Previous model of the folder";
        case Action::reload:
            return "Read the model again, with your changes";
        case Action::saveProfile:
            return "Save profile";
        case Action::saveProfileAs:
            return "Save profile as";
        case Action::saveScene:
            return "Save scene";
        case Action::saveSceneAs:
            return "Save scene as";
        case Action::exportBaked:
            return "Export baked glb";
        case Action::exportRagdoll:
            return "Export for an engine";
        case Action::quit:
            return "Quit";
        case Action::undo:
            return "Undo";
        case Action::redo:
            return "Redo";
        case Action::selectNone:
            return "Select none";
        case Action::copyPart:
            return "Copy the body's values";
        case Action::pastePart:
            return "Paste values to the selected bodies";
        case Action::mirrorParts:
            return "Mirror the selected bodies";
        case Action::addBody:
            return "Add a body on a joint";
        case Action::removeBodies:
            return "Remove the selected bodies";
        case Action::mergeBodies:
            return "Merge the selected bodies into those above";
        case Action::splitBodies:
            return "Split the selected bodies";
        case Action::toggleSymmetric:
            return "Change both sides at once";
        case Action::nextTool:
            return "Next tool: select, move, turn, size, hit";
        case Action::toggleLocalAxes:
            return "The tool's axes: the world's or its own";
        case Action::swingLimits:
            return "Swing the joint through its limits";
        case Action::pin:
            return "Pin or unpin the selected body";
        case Action::unpinAll:
            return "Unpin all";
        case Action::togglePlay:
            return "Play or pause";
        case Action::stepOnce:
            return "Single step";
        case Action::reset:
            return "Reset";
        case Action::returnToPlay:
            return "Back to where Play was pressed";
        case Action::selectedOnly:
            return "Only the selected bodies move";
        case Action::fallFromClip:
            return "Fall from here in the clip";
        case Action::goLimp:
            return "Go limp: muscles off";
        case Action::getUp:
            return "Get up: muscles on";
        case Action::throwBall:
            return "Throw a ball where the mouse points";
        case Action::focus:
            return "Focus on the selection";
        case Action::followDoll:
            return "Follow the selected doll with the camera";
        case Action::viewFront:
            return "View from the front";
        case Action::viewRight:
            return "View from the right";
        case Action::viewTop:
            return "View from above";
        case Action::viewBack:
            return "View from behind";
        case Action::viewLeft:
            return "View from the left";
        case Action::viewBottom:
            return "View from below";
        case Action::toggleParallel:
            return "Parallel projection";
        case Action::selectMirror:
            return "Select the other side instead";
        case Action::selectChildren:
            return "Select all that hangs on it as well";
        case Action::toggleClips:
            return "The file's clips, with a timeline";
        case Action::toggleDebug:
            return "Debug draw";
        case Action::toggleHandles:
            return "Handles of limits and shape";
        case Action::togglePanels:
            return "Show or hide the panels";
        case Action::toggleHelp:
            return "Keys";
    }
    return "";
}

std::string shortcutText(const Binding& binding) {
    std::string text;
    if (binding.modifiers.control) text += "Ctrl+";
    if (binding.modifiers.alt) text += "Alt+";
    if (binding.modifiers.shift) text += "Shift+";
    return text.append(keyName(binding.key));
}

std::string shortcutText(Action action) {
    for (const Binding& binding : kBindings) {
        if (binding.action == action) return shortcutText(binding);
    }
    return "";
}

std::span<const HelpLine> mouseHelp() {
    return kMouseHelp;
}

}  // namespace lutka::editor
