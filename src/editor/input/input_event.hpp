#pragma once

/// What the user does, told without a window system. GLFW's callbacks, input scripts and tests all make these, and
/// they all go the same way from there: Application → Dear ImGui → (unless a panel took them) → Editor.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/math.hpp"
#include "render/extent.hpp"

namespace lutka::editor {

/// Keys that the editor or a text field reacts to, by their place on a US keyboard.
// clang-format off
enum class Key {
    unknown,
    a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z,
    digit0, digit1, digit2, digit3, digit4, digit5, digit6, digit7, digit8, digit9,
    space, enter, escape, tab, backspace, insert, del, left, right, up, down, home, end, pageUp, pageDown,
    minus, equal, period, comma, slash, leftShift, rightShift, leftControl, rightControl, leftAlt, rightAlt,
    f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12,
};
// clang-format on
inline constexpr int kKeyCount = static_cast<int>(Key::f12) + 1;

/// "G", "3", "Space", "Escape", "F3" …: the words of scripts and hot-key sheets. "Unknown" for Key::unknown.
[[nodiscard]] std::string_view keyName(Key key);
[[nodiscard]] std::optional<Key> keyFromName(std::string_view name);

enum class MouseButton { left, right, middle };
inline constexpr int kMouseButtonCount = 3;

struct Modifiers {
    bool shift = false;
    bool control = false;
    bool alt = false;

    friend bool operator==(const Modifiers&, const Modifiers&) = default;
};

/// One event. Which members have a meaning depends on `kind`; the others keep their defaults.
struct InputEvent {
    enum class Kind { mouseMove, mouseButton, wheel, key, text, drop, resize, focus, close };

    Kind kind = Kind::mouseMove;
    vec2 position{0, 0};                     ///< mouseMove: window coordinates, (0, 0) the upper left corner.
    MouseButton button = MouseButton::left;  ///< mouseButton
    Key key = Key::unknown;                  ///< key
    bool pressed = false;                    ///< mouseButton, key: pressed or released. focus: gained or lost.
    bool repeated = false;                   ///< key: the keyboard's own repetition.
    Modifiers modifiers;                     ///< mouseButton, key: what was held at that moment.
    float wheel = 0.0F;                      ///< wheel: notches, above zero away from the user.
    std::uint32_t codepoint = 0;             ///< text: one Unicode character.
    std::vector<std::string> files;          ///< drop: paths.
    render::Extent size{1280, 720};          ///< resize: the window in window coordinates.

    friend bool operator==(const InputEvent&, const InputEvent&) = default;
};

[[nodiscard]] InputEvent mouseMoved(const vec2& position);
[[nodiscard]] InputEvent mouseButton(MouseButton button, bool pressed, Modifiers modifiers = {});
[[nodiscard]] InputEvent wheelTurned(float notches);
[[nodiscard]] InputEvent keyPressed(Key key, Modifiers modifiers = {});
[[nodiscard]] InputEvent keyReleased(Key key, Modifiers modifiers = {});
[[nodiscard]] InputEvent textTyped(std::uint32_t codepoint);
[[nodiscard]] InputEvent filesDropped(std::vector<std::string> files);
[[nodiscard]] InputEvent windowResized(render::Extent size);
[[nodiscard]] InputEvent focusChanged(bool gained);
[[nodiscard]] InputEvent windowClosed();

/// A frame's events in steps of which each is one press, release or key with what belongs to it: movements before, text
/// after. The way to a press is a step of its own: tabs take a press only when the mouse was seen over them before it.
/// In order, all of them; one empty step for no event.
[[nodiscard]] std::vector<std::span<const InputEvent>> inputSteps(std::span<const InputEvent> events);

}  // namespace lutka::editor
