/// Characters with muscles in the editor: switched on and off, through edits and undo, limp and up again.

#include <glm/geometric.hpp>

#include "editor/document/open_document.hpp"
#include "editor/sessions.hpp"

using namespace lutka;
using namespace lutka::editor;
using animation::Role;
using test::placeOf;

namespace {

std::unique_ptr<Editor> mannequinIn(const char* scenario) {
    EditorOptions options;
    options.model = LUTKA_ASSETS_DIR "/models/mannequin.glb";
    options.scene.scenario = scenario;
    auto editor = Editor::create(options);
    if (!editor.ok()) FAIL(editor.error().text());
    return std::move(editor).value();
}

physics::PuppetState stateOf(Editor& editor) {
    return editor.player().simulation().puppets()->puppet(0).state();
}

}  // namespace

TEST_CASE("a walker goes on through edits: neither its place nor its time nor its strength begins anew") {
    const auto editor = mannequinIn("walk");
    test::pass(*editor, 20);
    REQUIRE(editor->player().simulation().puppets() != nullptr);
    REQUIRE(stateOf(*editor) == physics::PuppetState::animated);
    const vec3 before = placeOf(*editor, Role::hips);
    const int hand = physics::bodyOf(editor->document().profile(), Role::leftHand);
    for (int i = 0; i < 10; ++i) {
        REQUIRE(editor->edit([&](EditorDocument& document) {
            return document.setMass(hand, 0.5F + 0.01F * static_cast<float>(i), "mass");
        }));
        test::pass(*editor, 1);
        CHECK(stateOf(*editor) != physics::PuppetState::limp);
    }
    const vec3 after = placeOf(*editor, Role::hips);
    CHECK(glm::distance(before, after) < 0.5F);
    const auto pose = editor->player().simulation().puppets()->pose(0);
    CHECK(glm::distance(pose[0].translation, after) < 0.05F);
    // The view goes along with it.
    CHECK(editor->workspace().followed == 0);
}

TEST_CASE("who goes limp falls, and gets up again when asked, and undo goes both ways") {
    const auto editor = mannequinIn("drop");
    test::pass(*editor, 240);
    const float lying = placeOf(*editor, Role::hips).y;
    editor->perform(Action::getUp);
    REQUIRE(editor->player().simulation().puppets() != nullptr);
    CHECK(stateOf(*editor) == physics::PuppetState::limp);
    CHECK(placeOf(*editor, Role::hips).y == Approx(lying).margin(0.02));
    for (int i = 0; i < 900 && stateOf(*editor) != physics::PuppetState::animated; ++i)
        test::pass(*editor, 1);
    REQUIRE(stateOf(*editor) == physics::PuppetState::animated);
    const float standing = placeOf(*editor, Role::hips).y;
    CHECK(standing > lying + 0.4F);
    // An edit leaves it on its feet.
    const int hand = physics::bodyOf(editor->document().profile(), Role::leftHand);
    REQUIRE(editor->edit([&](EditorDocument& document) { return document.setMass(hand, 0.6F); }));
    test::pass(*editor, 60);
    CHECK(placeOf(*editor, Role::hips).y == Approx(standing).margin(0.1));
    editor->perform(Action::goLimp);
    CHECK(editor->player().simulation().puppets() == nullptr);
    test::pass(*editor, 180);
    CHECK(placeOf(*editor, Role::hips).y < standing - 0.4F);
    editor->perform(Action::undo);
    CHECK(editor->player().simulation().puppets() != nullptr);
    editor->perform(Action::redo);
    CHECK(editor->player().simulation().puppets() == nullptr);
}

TEST_CASE("muscles that are switched on for who lies let it get up there, and do not drag it to its start") {
    const auto editor = mannequinIn("drop");
    CHECK_FALSE(editor->firstMuscles().limp);
    test::pass(*editor, 240);
    editor->setPuppets(editor->firstMuscles());
    REQUIRE(editor->player().simulation().puppets() != nullptr);
    const vec3 lying = placeOf(*editor, Role::hips);
    for (int i = 0; i < 900 && stateOf(*editor) != physics::PuppetState::animated; ++i) {
        const vec3 before = placeOf(*editor, Role::hips);
        test::pass(*editor, 1);
        CHECK(glm::distance(before, placeOf(*editor, Role::hips)) < 0.1F);
    }
    CHECK(stateOf(*editor) == physics::PuppetState::animated);
    const vec3 standing = placeOf(*editor, Role::hips);
    CHECK(standing.y > lying.y + 0.4F);
    CHECK(glm::distance(vec2(lying.x, lying.z), vec2(standing.x, standing.z)) < 1.5F);
}

TEST_CASE("muscles that were switched on for who lies let the next run begin on its feet, and go with undo and redo") {
    const auto editor = mannequinIn("drop");
    const float start = placeOf(*editor, Role::hips).y;
    test::pass(*editor, 240);
    const bool byButton = GENERATE(false, true);
    if (byButton)
        editor->perform(Action::getUp);
    else
        editor->setPuppets(editor->firstMuscles());
    CHECK(stateOf(*editor) == physics::PuppetState::limp);
    CHECK(editor->player().simulation().puppets()->figures().knockOuts == 0);
    CHECK_FALSE(editor->document().scene().simulation.puppets->limp);
    const vec3 lying = placeOf(*editor, Role::hips);
    editor->perform(Action::undo);
    CHECK(editor->player().simulation().puppets() == nullptr);
    test::pass(*editor, 1);
    editor->perform(Action::redo);
    REQUIRE(editor->player().simulation().puppets() != nullptr);
    CHECK(stateOf(*editor) == physics::PuppetState::limp);
    test::pass(*editor, 10);
    CHECK(glm::distance(lying, placeOf(*editor, Role::hips)) < 0.05F);
    editor->perform(Action::reset);
    for (int i = 0; i < 120; ++i) {
        test::pass(*editor, 1);
        CHECK(stateOf(*editor) != physics::PuppetState::limp);
    }
    // On the floor, over which the scene holds it to let it fall.
    CHECK(placeOf(*editor, Role::hips).y == Approx(start - 1.0F).margin(0.15));
}

TEST_CASE("undo of Go limp brings back who walked where it was, and it walks on") {
    const auto editor = mannequinIn("walk");
    test::pass(*editor, 25);
    REQUIRE(stateOf(*editor) == physics::PuppetState::animated);
    const vec3 walking = placeOf(*editor, Role::hips);
    editor->perform(Action::goLimp);
    test::pass(*editor, 90);
    const vec3 lying = placeOf(*editor, Role::hips);
    REQUIRE(lying.y < walking.y - 0.4F);
    editor->perform(Action::undo);
    REQUIRE(editor->player().simulation().puppets() != nullptr);
    CHECK(glm::distance(placeOf(*editor, Role::hips), walking) < 1e-3F);
    test::pass(*editor, 5);
    CHECK(stateOf(*editor) != physics::PuppetState::limp);
    CHECK(glm::distance(placeOf(*editor, Role::hips), walking) < 0.3F);
    editor->perform(Action::redo);
    CHECK(editor->player().simulation().puppets() == nullptr);
}

TEST_CASE("muscles that are switched on before anything has happened let a figure stand on the floor") {
    const auto editor = mannequinIn("drop");
    const float start = placeOf(*editor, Role::hips).y;
    editor->setPuppets(editor->firstMuscles());
    CHECK(placeOf(*editor, Role::hips).y == Approx(start - 1.0F).margin(0.05));
    for (int i = 0; i < 60; ++i) {
        test::pass(*editor, 1);
        CHECK(stateOf(*editor) == physics::PuppetState::animated);
    }
    CHECK(placeOf(*editor, Role::hips).y == Approx(start - 1.0F).margin(0.05));
    editor->perform(Action::undo);
    CHECK(placeOf(*editor, Role::hips).y == Approx(start).margin(1e-3));
}

TEST_CASE("muscles that a figure cannot have are refused with the reason, and it falls") {
    const auto editor = test::makeEditor();
    scene::ScenePuppets puppets;
    puppets.clip = "no clip of this name";
    editor->setPuppets(puppets);
    test::pass(*editor, 2);
    CHECK(editor->player().simulation().puppets() == nullptr);
    REQUIRE_FALSE(editor->workspace().toasts.empty());
    CHECK_THAT(editor->workspace().toasts.back().text, Catch::Contains("The characters fall"));
}
