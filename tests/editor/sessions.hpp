#pragma once

#include <memory>

#include "editor/editor.hpp"
#include "support/catch.hpp"
#include "support/rigs.hpp"

namespace lutka::test {

/// The hand-made figure as an editable document.
inline std::unique_ptr<editor::EditorDocument> makeDocument() {
    auto asset = scene::makeRagdoll(makeBiped());
    REQUIRE(asset.ok());
    return std::make_unique<editor::EditorDocument>(std::move(asset).value());
}

/// An editor with that figure in the scene `drop`, without a window.
inline std::unique_ptr<editor::Editor> makeEditor(const editor::EditorOptions& options = {}) {
    auto made = editor::Editor::create(makeDocument(), options);
    if (!made.ok()) FAIL(made.error().text());
    return std::move(made).value();
}

inline constexpr double kFrame = 1.0 / 60.0;

/// Sends an event to the view and lets a frame pass.
inline void send(editor::Editor& editor, const editor::InputEvent& event, const editor::UiCapture& capture = {}) {
    editor.handle(event, capture);
    editor.update(kFrame);
}

inline void pass(editor::Editor& editor, int frames) {
    for (int frame = 0; frame < frames; ++frame)
        editor.update(kFrame);
}

/// Where a body is seen now, in window coordinates.
inline vec2 seenAt(editor::Editor& editor, animation::Role role) {
    const int body = physics::bodyOf(editor.document().profile(), role);
    const vec3 world = editor.workspace().positionOf({editor::Item::Kind::body, 0, body});
    const auto seen = render::project(editor.workspace().camera, world, editor.workspace().window);
    REQUIRE(seen.has_value());
    return vec2(*seen);
}

/// The world position of a body.
inline vec3 placeOf(editor::Editor& editor, animation::Role role) {
    const int body = physics::bodyOf(editor.document().profile(), role);
    return editor.workspace().positionOf({editor::Item::Kind::body, 0, body});
}

inline void click(editor::Editor& editor, const vec2& at, editor::Modifiers modifiers = {}) {
    send(editor, editor::mouseMoved(at));
    send(editor, editor::mouseButton(editor::MouseButton::left, true, modifiers));
    send(editor, editor::mouseButton(editor::MouseButton::left, false, modifiers));
}

}  // namespace lutka::test
