#include "editor/view/gizmo.hpp"

#include <glm/geometric.hpp>

#include "editor/sessions.hpp"

using namespace lutka;
using namespace lutka::editor;
using animation::Role;
using test::makeEditor;
using test::send;

namespace {

EditorOptions pausedForGizmos() {
    EditorOptions options;
    options.playing = false;
    return options;
}

scene::EntityId addTurnedBox(Editor& editor, const vec3& at) {
    scene::EntityId id = scene::kNoEntity;
    REQUIRE(editor.editScene("Add", "", [&](scene::EntityScene& scene) {
        id = scene::addEntity(scene, scene::EntityKind::box, {glm::angleAxis(radians(90.0F), vec3(0, 1, 0)), at}).id;
    }));
    editor.select(Item{Item::Kind::object, 0, static_cast<int>(id)});
    editor.perform(Action::focus);
    return id;
}

vec2 seen(Editor& editor, const vec3& world) {
    const auto at = render::project(editor.workspace().camera, world, editor.workspace().window);
    REQUIRE(at.has_value());
    return vec2(*at);
}

// A point of the arm, where nothing else is.
vec2 armAt(Editor& editor, int axis) {
    const auto gizmo = editor.workspace().gizmo();
    REQUIRE(gizmo.has_value());
    return seen(editor, gizmo->worldFromGizmo * (axisVector(axis) * (gizmo->size * 0.85F)));
}

void dragFrom(Editor& editor, const vec2& from, const vec2& by) {
    send(editor, mouseMoved(from));
    send(editor, mouseButton(MouseButton::left, true));
    for (int i = 1; i <= 4; ++i)
        send(editor, mouseMoved(from + by * (static_cast<float>(i) / 4.0F)));
    send(editor, mouseButton(MouseButton::left, false));
}

}  // namespace

TEST_CASE("an arrow moves an object along its axis alone, as one entry of undo") {
    const auto editor = makeEditor(pausedForGizmos());
    const scene::EntityId box = addTurnedBox(*editor, {1, 0.25F, 0});
    const auto place = [&] { return scene::worldFromEntity(editor->document().scene(), box).translation; };
    const vec2 arm = armAt(*editor, 1);
    send(*editor, mouseMoved(arm));
    REQUIRE(editor->workspace().hotGizmo.has_value());
    CHECK(editor->workspace().hotGizmo->axis == 1);
    const std::string label = editor->document().undoLabel();
    dragFrom(*editor, arm, {30, -60});
    CHECK(editor->state() == State::selected);
    CHECK(place().y > 0.3F);
    CHECK(place().x == Approx(1.0F));
    CHECK(place().z == Approx(0.0F).margin(1e-5));
    editor->perform(Action::undo);
    CHECK(place().y == Approx(0.25F));
    CHECK(editor->document().undoLabel() == label);
}

TEST_CASE("a click on an arrow that moves nothing is no entry of undo") {
    const auto editor = makeEditor(pausedForGizmos());
    addTurnedBox(*editor, {1, 0.25F, 0});
    const std::size_t before = editor->document().undoLabels().size();
    test::click(*editor, armAt(*editor, 0));
    CHECK(editor->document().undoLabels().size() == before);
}

TEST_CASE("X twice moves along the object's own axis, and a third time frees") {
    const auto editor = makeEditor(pausedForGizmos());
    const scene::EntityId box = addTurnedBox(*editor, {1, 0.25F, 0});
    for (const Key key : {Key::g, Key::x, Key::x, Key::digit1, Key::enter})
        send(*editor, keyPressed(key));
    const vec3 moved = scene::worldFromEntity(editor->document().scene(), box).translation;
    CHECK(glm::distance(moved, vec3(1, 0.25F, -1)) < 1e-4F);
    AxisLock lock = pressAxis(pressAxis({}, 0, false), 0, false);
    CHECK(lockText(lock) == "along its own X");
    CHECK(pressAxis(lock, 0, false) == AxisLock{});
}

TEST_CASE("own axes turn the arrows with the object") {
    const auto editor = makeEditor(pausedForGizmos());
    addTurnedBox(*editor, {1, 0.25F, 0});
    send(*editor, keyPressed(Key::t, {true, false, false}));
    const auto gizmo = editor->workspace().gizmo();
    REQUIRE(gizmo.has_value());
    CHECK(glm::distance(gizmo->worldFromGizmo.rotation * vec3(1, 0, 0), vec3(0, 0, -1)) < 1e-4F);
}

TEST_CASE("the gizmo of a body edits its shape in its joint: place, turn and size, and no doll moves") {
    const auto editor = makeEditor(pausedForGizmos());
    const int body = physics::bodyOf(editor->document().profile(), Role::leftUpperLeg);
    editor->select(Item{Item::Kind::body, 0, body});
    CHECK_FALSE(editor->workspace().gizmo().has_value());  // the tool Select pulls bodies
    editor->workspace().showHandles = false;
    const auto now = [&]() -> const physics::BodyProfile& { return editor->document().profile().bodies[body]; };
    const physics::BodyProfile was = now();
    const vec3 knee = test::placeOf(*editor, Role::leftLowerLeg);
    send(*editor, keyPressed(Key::t));
    CHECK(editor->workspace().tool == Tool::move);
    dragFrom(*editor, armAt(*editor, 1), {0, -40});
    CHECK(glm::distance(now().jointFromBody.translation, was.jointFromBody.translation) > 0.01F);
    editor->perform(Action::undo);
    send(*editor, keyPressed(Key::t));
    const auto ring = editor->workspace().gizmo();
    REQUIRE(ring.has_value());
    const vec3 towards = render::eyeOf(editor->workspace().camera) - ring->worldFromGizmo.translation;
    const vec3 level = glm::normalize(vec3(towards.x, 0, towards.z));
    dragFrom(*editor, seen(*editor, ring->worldFromGizmo.translation + level * ring->size), {60, 0});
    CHECK(std::abs(glm::dot(now().jointFromBody.rotation, was.jointFromBody.rotation)) < 0.9999F);
    editor->perform(Action::undo);
    send(*editor, keyPressed(Key::t));
    dragFrom(*editor, armAt(*editor, 1), {0, 80});
    CHECK(now().shape.halfLength != Approx(was.shape.halfLength));
    CHECK(now().shape.radius == Approx(was.shape.radius));
    CHECK(glm::distance(test::placeOf(*editor, Role::leftLowerLeg), knee) < 1e-4F);
}

TEST_CASE("a box drawn with Ctrl selects the bodies in it, with Shift adds, and Esc leaves the selection") {
    const auto editor = makeEditor(pausedForGizmos());
    const auto draw = [&](const vec2& from, const vec2& to, Modifiers modifiers) {
        send(*editor, mouseMoved(from));
        send(*editor, mouseButton(MouseButton::left, true, modifiers));
        REQUIRE(editor->state() == State::box);
        send(*editor, mouseMoved(to));
        CHECK(editor->workspace().box.has_value());
        send(*editor, mouseButton(MouseButton::left, false, modifiers));
        CHECK_FALSE(editor->workspace().box.has_value());
    };
    const auto around = [&](Role role, Modifiers modifiers) {
        const vec2 at = test::seenAt(*editor, role);
        draw(at - vec2(6, 6), at + vec2(6, 6), modifiers);
    };
    const auto selected = [&](Role role) {
        return editor->workspace().selection.contains(
            {Item::Kind::body, 0, physics::bodyOf(editor->document().profile(), role)});
    };
    draw({1, 1}, {1279, 719}, {false, true, false});
    CHECK(editor->workspace().selection.items().size() >= editor->document().profile().bodies.size());
    around(Role::head, {false, true, false});
    CHECK(editor->workspace().selection.items().size() == 1);
    CHECK(selected(Role::head));
    around(Role::leftFoot, {true, true, false});
    CHECK(editor->workspace().selection.items().size() == 2);
    CHECK(selected(Role::leftFoot));
    send(*editor, mouseMoved({1, 1}));
    send(*editor, mouseButton(MouseButton::left, true, {false, true, false}));
    send(*editor, mouseMoved({900, 700}));
    send(*editor, keyPressed(Key::escape));
    CHECK(editor->state() == State::selected);
    CHECK(editor->workspace().selection.items().size() == 2);
}

TEST_CASE("what is under the mouse stays there while the wheel zooms, in perspective and in parallel") {
    const auto editor = makeEditor(pausedForGizmos());
    for (const bool parallel : {false, true}) {
        INFO(parallel);
        editor->workspace().camera.orthographic = parallel;
        const vec2 mouse{900, 240};
        send(*editor, mouseMoved(mouse));
        const render::Camera& camera = editor->workspace().camera;
        const render::Ray ray = editor->workspace().mouseRay();
        const float along = glm::dot(camera.target - ray.origin, render::forwardOf(camera)) /
                            glm::dot(ray.direction, render::forwardOf(camera));
        const vec3 held = ray.origin + ray.direction * along;
        send(*editor, wheelTurned(3));
        CHECK(glm::distance(seen(*editor, held), mouse) < 0.5F);
    }
}
