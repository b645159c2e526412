/// Simulate selected only: what is not selected stays where it is, through edits, poses and resets.

#include <glm/geometric.hpp>

#include "editor/sessions.hpp"

using namespace lutka;
using namespace lutka::editor;
using animation::Role;
using test::placeOf;
using test::send;

namespace {

constexpr Modifiers kCtrl{false, true, false};

void selectArm(Editor& editor) {
    const auto body = [&](Role role) {
        return Item{Item::Kind::body, 0, physics::bodyOf(editor.document().profile(), role)};
    };
    editor.select(body(Role::leftUpperArm));
    editor.select(body(Role::leftLowerArm), true);
    editor.select(body(Role::leftHand), true);
}

EditorOptions with(physics::SolverKind solver) {
    EditorOptions options;
    options.applyToWorld = [solver](physics::WorldSettings& world) { world.solver = solver; };
    return options;
}

}  // namespace

TEST_CASE("only the selected arm falls, all else stays where it is, until all bodies move again") {
    for (const auto solver : {physics::SolverKind::crowd, physics::SolverKind::bullet}) {
        INFO(physics::solverName(solver));
        const auto editor = test::makeEditor(with(solver));
        selectArm(*editor);
        send(*editor, keyPressed(Key::space, kCtrl));
        REQUIRE(editor->player().held().any());
        CHECK(editor->player().held().holds(editor->player().simulation(), 0, 0));
        const vec3 hips = placeOf(*editor, Role::hips);
        const vec3 otherHand = placeOf(*editor, Role::rightHand);
        const vec3 hand = placeOf(*editor, Role::leftHand);
        test::pass(*editor, 180);
        CHECK(glm::distance(placeOf(*editor, Role::hips), hips) < 0.002F);
        CHECK(glm::distance(placeOf(*editor, Role::rightHand), otherHand) < 0.005F);
        CHECK(placeOf(*editor, Role::leftHand).y < hand.y - 0.2F);
        CHECK(editor->player().simulation().world().refusals() == 0);
        send(*editor, keyPressed(Key::space, kCtrl));
        CHECK_FALSE(editor->player().held().any());
        test::pass(*editor, 120);
        CHECK(placeOf(*editor, Role::hips).y < hips.y - 0.2F);
    }
}

TEST_CASE("what is held stays held through an edit, and where a reset has put it") {
    const auto editor = test::makeEditor();
    test::pass(*editor, 40);
    selectArm(*editor);
    editor->perform(Action::selectedOnly);
    const vec3 hips = placeOf(*editor, Role::hips);
    // Many edits, as a slider makes them: nothing creeps.
    const int body = physics::bodyOf(editor->document().profile(), Role::leftHand);
    for (int i = 0; i < 30; ++i) {
        REQUIRE(editor->edit([&](EditorDocument& document) {
            return document.setMass(body, 0.5F + 0.01F * static_cast<float>(i), "mass");
        }));
        test::pass(*editor, 2);
    }
    CHECK(glm::distance(placeOf(*editor, Role::hips), hips) < 0.002F);
    editor->perform(Action::reset);
    const vec3 start = placeOf(*editor, Role::hips);
    REQUIRE(start.y > hips.y + 0.05F);
    test::pass(*editor, 60);
    CHECK(glm::distance(placeOf(*editor, Role::hips), start) < 0.002F);
    // Undo of the reset brings the fallen doll back, held there.
    editor->perform(Action::undo);
    test::pass(*editor, 60);
    CHECK(glm::distance(placeOf(*editor, Role::hips), hips) < 0.004F);
}

TEST_CASE("who goes back to where Play was pressed is held there") {
    const auto editor = test::makeEditor();
    editor->player().setPlaying(false);
    editor->player().setPlaying(true);
    const vec3 start = placeOf(*editor, Role::hips);
    test::pass(*editor, 60);
    selectArm(*editor);
    editor->perform(Action::selectedOnly);
    REQUIRE(glm::distance(placeOf(*editor, Role::hips), start) > 0.1F);
    editor->perform(Action::returnToPlay);
    editor->player().setPlaying(true);
    test::pass(*editor, 60);
    CHECK(glm::distance(placeOf(*editor, Role::hips), start) < 0.002F);
}

TEST_CASE("with nothing selected nothing is held, and the reason is told") {
    const auto editor = test::makeEditor();
    editor->perform(Action::selectedOnly);
    CHECK_FALSE(editor->player().held().any());
    REQUIRE_FALSE(editor->workspace().toasts.empty());
    CHECK_THAT(editor->workspace().toasts.back().text, Catch::Contains("Select the bodies"));
}
