/// Undo of what moves: poses, pins, placements, resets, balls, copies, scenes, and the pose under another mapping.

#include <glm/geometric.hpp>

#include "editor/sessions.hpp"

using namespace lutka;
using namespace lutka::editor;
using animation::Role;
using test::placeOf;
using test::seenAt;
using test::send;

namespace {

EditorOptions pausedScene() {
    EditorOptions options;
    options.playing = false;
    return options;
}

std::vector<RigidTransform> placesOf(Editor& editor) {
    const auto bodies = editor.player().simulation().worldFromBody(0);
    return {bodies.begin(), bodies.end()};
}

float apart(const std::vector<RigidTransform>& a, const std::vector<RigidTransform>& b) {
    if (a.size() != b.size()) return 1e9F;
    float most = 0.0F;
    for (std::size_t i = 0; i < a.size(); ++i)
        most = std::max(most, glm::distance(a[i].translation, b[i].translation));
    return most;
}

void poseHand(Editor& editor, const InputEvent& end) {
    send(editor, mouseMoved(seenAt(editor, Role::leftHand)));
    send(editor, mouseButton(MouseButton::left, true));
    for (int step = 0; step < 12; ++step)
        send(editor, mouseMoved(editor.workspace().mouse + vec2(4, -10)));
    test::pass(editor, 20);
    send(editor, end);
}

constexpr Modifiers kCommand{false, true, false};

}  // namespace

TEST_CASE("a pose by hand is an entry of undo, and Esc leaves neither a pose nor an entry") {
    const auto editor = test::makeEditor(pausedScene());
    send(*editor, keyPressed(Key::h));  // no handles, which a press would take
    const auto start = placesOf(*editor);
    poseHand(*editor, keyPressed(Key::escape));
    CHECK(apart(placesOf(*editor), start) < 1e-5F);
    CHECK_FALSE(editor->document().canUndo());
    send(*editor, mouseButton(MouseButton::left, false));
    poseHand(*editor, mouseButton(MouseButton::left, false));
    const auto posed = placesOf(*editor);
    REQUIRE(apart(posed, start) > 0.1F);
    CHECK(editor->document().undoLabel() == "Pose leftHand");
    send(*editor, keyPressed(Key::z, kCommand));
    CHECK(apart(placesOf(*editor), start) < 1e-5F);
    send(*editor, keyPressed(Key::z, {true, true, false}));
    CHECK(apart(placesOf(*editor), posed) < 1e-5F);
}

TEST_CASE("turning a doll, a reset and the way back to Play are undone") {
    const auto editor = test::makeEditor(pausedScene());
    const auto start = placesOf(*editor);
    test::click(*editor, seenAt(*editor, Role::hips));
    for (const Key key : {Key::r, Key::z, Key::digit9, Key::digit0, Key::enter})
        send(*editor, keyPressed(key));
    const auto turned = placesOf(*editor);
    REQUIRE(apart(turned, start) > 0.3F);
    editor->perform(Action::reset);
    CHECK(apart(placesOf(*editor), start) < 1e-5F);
    editor->perform(Action::undo);
    CHECK(apart(placesOf(*editor), turned) < 1e-5F);
    editor->perform(Action::undo);
    CHECK(apart(placesOf(*editor), start) < 1e-5F);
    editor->perform(Action::togglePlay);
    test::pass(*editor, 40);
    const auto fallen = placesOf(*editor);
    editor->perform(Action::returnToPlay);
    CHECK(apart(placesOf(*editor), start) < 1e-5F);
    editor->perform(Action::undo);
    CHECK(apart(placesOf(*editor), fallen) < 1e-5F);
}

TEST_CASE("pins come and go with undo, while the fall goes on") {
    const auto editor = test::makeEditor();
    test::click(*editor, seenAt(*editor, Role::head));
    send(*editor, keyPressed(Key::p));
    REQUIRE(editor->workspace().pulls.pins.size() == 1);
    test::pass(*editor, 20);
    const auto hanging = placesOf(*editor);
    editor->perform(Action::undo);
    CHECK(editor->workspace().pulls.pins.empty());
    CHECK(apart(placesOf(*editor), hanging) < 1e-5F);
    editor->perform(Action::redo);
    CHECK(editor->workspace().pulls.pins.size() == 1);
    editor->perform(Action::unpinAll);
    CHECK(editor->workspace().pulls.pins.empty());
    editor->perform(Action::undo);
    CHECK(editor->workspace().pulls.pins.size() == 1);
}

TEST_CASE("undo takes a ball out of the air and everything back to before it was thrown") {
    const auto editor = test::makeEditor();
    test::pass(*editor, 10);
    const auto before = placesOf(*editor);
    const double seconds = editor->player().seconds();
    send(*editor, mouseMoved(seenAt(*editor, Role::hips)));
    editor->perform(Action::throwBall);
    test::pass(*editor, 60);
    editor->perform(Action::undo);
    CHECK(editor->player().simulation().world().props().size() == 0);
    CHECK(apart(placesOf(*editor), before) < 0.05F);
    CHECK(editor->player().seconds() == Approx(seconds).margin(0.05));
    editor->perform(Action::redo);
    CHECK(editor->player().simulation().world().props().size() == 1);
}

TEST_CASE("undo of dropped copies and of another scene brings back what was there, where it was") {
    const auto editor = test::makeEditor();
    test::pass(*editor, 30);
    editor->perform(Action::togglePlay);
    const auto before = placesOf(*editor);
    editor->dropCopies(3);
    editor->perform(Action::togglePlay);
    test::pass(*editor, 30);
    editor->perform(Action::togglePlay);
    REQUIRE(apart(placesOf(*editor), before) > 0.01F);
    editor->perform(Action::undo);
    CHECK(editor->player().simulation().dollCount() == 1);
    CHECK(apart(placesOf(*editor), before) < 1e-5F);
    SceneSettings stairs = editor->document().sceneDocument().settings();
    stairs.scenario = "stairs";
    REQUIRE(editor->edit(
        [&](EditorDocument& document) { return document.setScene(stairs, "Choose the scene", "", true); }));
    editor->restart();
    editor->perform(Action::undo);
    CHECK(editor->document().scene().name == "drop");
    CHECK(apart(placesOf(*editor), before) < 1e-5F);
}

TEST_CASE("undo of a character that was dragged away, and of one dragged back, brings back how far it had fallen") {
    const auto editor = test::makeEditor();
    test::pass(*editor, 30);
    editor->perform(Action::togglePlay);
    const auto before = placesOf(*editor);
    const scene::EntityId doll = editor->player().entityOfDoll(0);
    const RigidTransform start = scene::worldFromEntity(editor->document().scene(), doll);
    const auto drag = [&](const vec3& by) {
        REQUIRE(editor->editScene("Move", "move", [&](scene::EntityScene& scene) {
            scene::placeEntity(scene, doll, {start.rotation, start.translation + by});
        }));
    };
    drag(vec3(2, 0, 0));
    editor->document().endGroup();
    REQUIRE(apart(placesOf(*editor), before) > 0.1F);
    editor->perform(Action::undo);
    CHECK(apart(placesOf(*editor), before) < 1e-5F);
    drag(vec3(0));
    drag(vec3(2, 0, 0));
    drag(vec3(0));
    editor->document().endGroup();
    REQUIRE(apart(placesOf(*editor), before) > 0.1F);
    REQUIRE(editor->document().canUndo());
    editor->perform(Action::undo);
    CHECK(apart(placesOf(*editor), before) < 1e-5F);
    CHECK_FALSE(editor->document().canUndo());
}

TEST_CASE("a wrong mapping and then the right one bring the pose back, and so does undo") {
    const auto editor = test::makeEditor();
    test::pass(*editor, 40);
    editor->perform(Action::togglePlay);
    const auto before = placesOf(*editor);
    const auto& map = editor->document().state().map;
    const Role role = map[Role::upperChest] ? Role::upperChest : Role::chest;
    const int joint = map.jointOf(role);
    REQUIRE(joint >= 0);
    const std::size_t bodies = editor->document().profile().bodies.size();
    REQUIRE(editor->edit([&](EditorDocument& document) { return document.unmapRole(role); }));
    CHECK(editor->document().profile().bodies.size() < bodies);
    REQUIRE(editor->edit([&](EditorDocument& document) { return document.assignRole(role, joint); }));
    CHECK(apart(placesOf(*editor), before) < 1e-5F);
    REQUIRE(editor->edit([&](EditorDocument& document) { return document.unmapRole(role); }));
    editor->perform(Action::undo);
    CHECK(apart(placesOf(*editor), before) < 1e-5F);
}

TEST_CASE("undo of a value leaves alone what has fallen on since") {
    const auto editor = test::makeEditor();
    test::pass(*editor, 10);
    const int hand = physics::bodyOf(editor->document().profile(), Role::leftHand);
    REQUIRE(editor->edit([&](EditorDocument& document) { return document.setMass(hand, 2.0F); }));
    test::pass(*editor, 30);
    const auto now = placesOf(*editor);
    editor->perform(Action::undo);
    CHECK(apart(placesOf(*editor), now) < 1e-5F);
}
