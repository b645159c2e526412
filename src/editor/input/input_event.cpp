#include "editor/input/input_event.hpp"

#include <algorithm>
#include <array>

namespace lutka::editor {
namespace {

constexpr std::array<std::string_view, kKeyCount> kKeyNames = {
    "Unknown",
    "A",
    "B",
    "C",
    "D",
    "E",
    "F",
    "G",
    "H",
    "I",
    "J",
    "K",
    "L",
    "M",
    "N",
    "O",
    "P",
    "Q",
    "R",
    "S",
    "T",
    "U",
    "V",
    "W",
    "X",
    "Y",
    "Z",
    "0",
    "1",
    "2",
    "3",
    "4",
    "5",
    "6",
    "7",
    "8",
    "9",
    "Space",
    "Enter",
    "Escape",
    "Tab",
    "Backspace",
    "Insert",
    "Delete",
    "Left",
    "Right",
    "Up",
    "Down",
    "Home",
    "End",
    "PageUp",
    "PageDown",
    "Minus",
    "Equal",
    "Period",
    "Comma",
    "Slash",
    "LeftShift",
    "RightShift",
    "LeftControl",
    "RightControl",
    "LeftAlt",
    "RightAlt",
    "F1",
    "F2",
    "F3",
    "F4",
    "F5",
    "F6",
    "F7",
    "F8",
    "F9",
    "F10",
    "F11",
    "F12",
};
static_assert(!kKeyNames.back().empty());

InputEvent ofKind(InputEvent::Kind kind) {
    InputEvent event;
    event.kind = kind;
    return event;
}

}  // namespace

std::string_view keyName(Key key) {
    return kKeyNames[static_cast<std::size_t>(key)];
}

std::optional<Key> keyFromName(std::string_view name) {
    const auto* const found = std::find(kKeyNames.begin(), kKeyNames.end(), name);
    if (found == kKeyNames.end()) return std::nullopt;
    return static_cast<Key>(found - kKeyNames.begin());
}

InputEvent mouseMoved(const vec2& position) {
    InputEvent event = ofKind(InputEvent::Kind::mouseMove);
    event.position = position;
    return event;
}

InputEvent mouseButton(MouseButton button, bool pressed, Modifiers modifiers) {
    InputEvent event = ofKind(InputEvent::Kind::mouseButton);
    event.button = button;
    event.pressed = pressed;
    event.modifiers = modifiers;
    return event;
}

InputEvent wheelTurned(float notches) {
    InputEvent event = ofKind(InputEvent::Kind::wheel);
    event.wheel = notches;
    return event;
}

InputEvent keyPressed(Key key, Modifiers modifiers) {
    InputEvent event = ofKind(InputEvent::Kind::key);
    event.key = key;
    event.pressed = true;
    event.modifiers = modifiers;
    return event;
}

InputEvent keyReleased(Key key, Modifiers modifiers) {
    InputEvent event = keyPressed(key, modifiers);
    event.pressed = false;
    return event;
}

InputEvent textTyped(std::uint32_t codepoint) {
    InputEvent event = ofKind(InputEvent::Kind::text);
    event.codepoint = codepoint;
    return event;
}

InputEvent filesDropped(std::vector<std::string> files) {
    InputEvent event = ofKind(InputEvent::Kind::drop);
    event.files = std::move(files);
    return event;
}

InputEvent windowResized(render::Extent size) {
    InputEvent event = ofKind(InputEvent::Kind::resize);
    event.size = size;
    return event;
}

InputEvent focusChanged(bool gained) {
    InputEvent event = ofKind(InputEvent::Kind::focus);
    event.pressed = gained;
    return event;
}

InputEvent windowClosed() {
    return ofKind(InputEvent::Kind::close);
}

std::vector<std::span<const InputEvent>> inputSteps(std::span<const InputEvent> events) {
    std::vector<std::span<const InputEvent>> steps;
    std::size_t first = 0;
    bool acted = false;  // whether the present step has its press, release or key
    bool moved = false;  // whether it has a movement of the mouse
    for (std::size_t i = 0; i < events.size(); ++i) {
        const InputEvent::Kind kind = events[i].kind;
        const bool text = kind == InputEvent::Kind::text;
        const bool button = kind == InputEvent::Kind::mouseButton;
        const bool key = kind == InputEvent::Kind::key && events[i].pressed;
        if ((acted && !text) || (moved && button && events[i].pressed)) {
            steps.push_back(events.subspan(first, i - first));
            first = i;
            acted = moved = false;
        }
        moved = moved || kind == InputEvent::Kind::mouseMove;
        acted = acted || button || key || text;
    }
    steps.push_back(events.subspan(first));
    return steps;
}

}  // namespace lutka::editor
