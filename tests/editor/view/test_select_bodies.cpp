#include "editor/view/select_bodies.hpp"

#include "editor/sessions.hpp"

using namespace lutka;
using namespace lutka::editor;
using animation::Role;

namespace {

Item bodyItem(const physics::RagdollProfile& profile, Role role) {
    return {Item::Kind::body, 0, physics::bodyOf(profile, role)};
}

}  // namespace

TEST_CASE("the other side is selected in place of a body, and who has none stays") {
    const auto document = test::makeDocument();
    const auto& profile = document->profile();
    Selection selection;
    selection.set(bodyItem(profile, Role::head));
    selection.toggle(bodyItem(profile, Role::leftHand));
    selectMirror(selection, profile);
    CHECK(selection.items().size() == 2);
    CHECK(selection.contains(bodyItem(profile, Role::head)));
    CHECK(selection.active() == bodyItem(profile, Role::rightHand));
}

TEST_CASE("what hangs on a selected body is selected with it, which stays the active one") {
    const auto document = test::makeDocument();
    const auto& profile = document->profile();
    Selection selection;
    selection.set(bodyItem(profile, Role::leftUpperArm));
    selectChildren(selection, profile);
    CHECK(selection.items().size() == 3);
    CHECK(selection.contains(bodyItem(profile, Role::leftLowerArm)));
    CHECK(selection.contains(bodyItem(profile, Role::leftHand)));
    CHECK(selection.active() == bodyItem(profile, Role::leftUpperArm));
}

TEST_CASE("keys look from the other sides and in parallel") {
    const auto editor = test::makeEditor();
    test::send(*editor, keyPressed(Key::digit3, {false, true, false}));
    CHECK(render::forwardOf(editor->workspace().camera).x == Approx(1.0F).margin(1e-4));
    test::send(*editor, keyPressed(Key::digit1, {false, true, false}));
    CHECK(render::forwardOf(editor->workspace().camera).z == Approx(1.0F).margin(1e-4));
    test::send(*editor, keyPressed(Key::digit7, {false, true, false}));
    CHECK(render::forwardOf(editor->workspace().camera).y > 0.99F);
    test::send(*editor, keyPressed(Key::digit5));
    CHECK(editor->workspace().camera.orthographic);
}
