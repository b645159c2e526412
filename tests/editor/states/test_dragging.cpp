#include <glm/geometric.hpp>

#include "editor/sessions.hpp"
#include "physics/profile/constraint_state.hpp"

using namespace lutka;
using namespace lutka::editor;
using animation::Role;
using test::click;
using test::makeEditor;
using test::pass;
using test::placeOf;
using test::seenAt;
using test::send;

namespace {

float largestSeparation(Editor& editor) {
    const auto& profile = editor.document().profile();
    const auto bodies = editor.player().simulation().worldFromBody(0);
    float largest = 0;
    for (const physics::ConstraintProfile& constraint : profile.constraints) {
        largest = std::max(
            largest,
            physics::measureConstraint(constraint, bodies[constraint.parent], bodies[constraint.child]).separationM);
    }
    return largest;
}

bool allFinite(Editor& editor) {
    for (const physics::BodyState& body : editor.player().bodiesOf(0)) {
        if (!isFinite(body.worldFromBody) || !isFinite(body.linearVelocity)) return false;
    }
    return true;
}

// Presses on a body and moves just far enough to pull it.
void beginDrag(Editor& editor, Role role) {
    editor.handle(mouseMoved(seenAt(editor, role)), {});
    send(editor, mouseButton(MouseButton::left, true));
    send(editor, mouseMoved(editor.workspace().mouse + vec2(0, -8)));
    REQUIRE(editor.state() == State::grab);
}

}  // namespace

TEST_CASE("a hand dragged around at 50 m/s for 10 s neither tears nor explodes the doll") {
    const auto editor = makeEditor();
    pass(*editor, 30);
    beginDrag(*editor, Role::leftHand);
    const vec3 held = editor->workspace().pulls.mouse->target;
    const auto seen = [&](const vec3& world) {
        return vec2(*render::project(editor->workspace().camera, world, editor->workspace().window));
    };
    constexpr float radius = 1.2F;  // metres: at 50 m/s that is 6.6 turns a second
    constexpr float speed = 50.0F;
    const vec3 right = render::rightOf(editor->workspace().camera);
    const vec3 up = render::upOf(editor->workspace().camera);
    float separation = 0;
    for (int frame = 0; frame < 600; ++frame) {
        const float angle = speed / radius * static_cast<float>(frame) / 60.0F;
        send(*editor, mouseMoved(seen(held + radius * (std::cos(angle) * right + std::sin(angle) * up))));
        separation = std::max(separation, largestSeparation(*editor));
        REQUIRE(allFinite(*editor));
    }
    INFO("largest separation " << separation * 1000.0F << " mm");
    CHECK(separation < 0.05F);
    const float fastest = glm::length(editor->player().bodiesOf(0).front().linearVelocity);
    CHECK(fastest < 60.0F);
}

TEST_CASE("in a paused scene a drag poses the doll against no gravity and leaves it at rest") {
    EditorOptions options;
    options.playing = false;
    const auto editor = makeEditor(options);
    const vec3 foot = placeOf(*editor, Role::rightFoot);
    beginDrag(*editor, Role::leftHand);
    const vec2 target = editor->workspace().mouse + vec2(-40, -60);
    send(*editor, mouseMoved(target));
    pass(*editor, 90);
    const vec3 aim = editor->workspace().pulls.mouse->target;
    const int hand = physics::bodyOf(editor->document().profile(), Role::leftHand);
    const vec3 held = editor->player().bodiesOf(0)[hand].worldFromBody * editor->workspace().pulls.mouse->bodyPoint;
    CHECK(glm::distance(held, aim) < 0.03F);
    CHECK(largestSeparation(*editor) < 0.01F);
    CHECK(std::abs(placeOf(*editor, Role::rightFoot).y - foot.y) < 0.35F);  // it hangs in the air as before
    send(*editor, mouseButton(MouseButton::left, false));
    CHECK_FALSE(editor->player().playing());
    CHECK(editor->player().seconds() == 0.0);
    const vec3 posed = placeOf(*editor, Role::leftHand);
    pass(*editor, 30);
    CHECK(placeOf(*editor, Role::leftHand) == posed);
    for (const physics::BodyState& body : editor->player().bodiesOf(0))
        CHECK(glm::length(body.linearVelocity) == 0.0F);
    send(*editor, keyPressed(Key::space));
    pass(*editor, 60);
    CHECK(placeOf(*editor, Role::leftHand).y < posed.y - 0.5F);  // gravity is back
}

TEST_CASE("Esc puts a posed doll back, and the release of the mouse keeps the pose") {
    EditorOptions options;
    options.playing = false;
    for (const bool cancelled : {true, false}) {
        const auto editor = makeEditor(options);
        const vec3 hand = test::placeOf(*editor, Role::rightHand);
        const vec3 hips = test::placeOf(*editor, Role::hips);
        beginDrag(*editor, Role::rightHand);
        send(*editor, mouseMoved(editor->workspace().mouse + vec2(60, -120)));
        pass(*editor, 60);
        REQUIRE(glm::distance(test::placeOf(*editor, Role::rightHand), hand) > 0.1F);
        if (cancelled) send(*editor, keyPressed(Key::escape));
        send(*editor, mouseButton(MouseButton::left, false));
        pass(*editor, 5);
        const float moved = glm::distance(test::placeOf(*editor, Role::rightHand), hand);
        CHECK((cancelled ? moved < 1e-5F : moved > 0.1F));
        if (cancelled) CHECK(glm::distance(test::placeOf(*editor, Role::hips), hips) < 1e-5F);
    }
}

TEST_CASE("the wheel takes what is held away from the eye and back") {
    EditorOptions options;
    options.playing = false;
    const auto editor = makeEditor(options);
    beginDrag(*editor, Role::rightHand);
    const vec3 eye = render::eyeOf(editor->workspace().camera);
    const float before = glm::distance(eye, editor->workspace().pulls.mouse->target);
    const float zoom = editor->workspace().camera.distance;
    send(*editor, wheelTurned(2));
    CHECK(glm::distance(eye, editor->workspace().pulls.mouse->target) > before + 0.2F);
    send(*editor, wheelTurned(-2));
    CHECK(glm::distance(eye, editor->workspace().pulls.mouse->target) == Approx(before).epsilon(1e-3));
    CHECK(editor->workspace().camera.distance == zoom);
}

TEST_CASE("Y while dragging keeps the pull on the vertical") {
    EditorOptions options;
    options.playing = false;
    const auto editor = makeEditor(options);
    beginDrag(*editor, Role::rightHand);
    const vec3 start = editor->workspace().pulls.mouse->target;
    send(*editor, keyPressed(Key::y));
    send(*editor, mouseMoved(editor->workspace().mouse + vec2(130, -100)));
    const vec3 target = editor->workspace().pulls.mouse->target;
    CHECK(target.y > start.y + 0.1F);
    CHECK(std::abs(target.x - start.x) < 0.05F);
    CHECK(std::abs(target.z - start.z) < 0.05F);
}

TEST_CASE("W flies ahead while the right button is held and not without it") {
    EditorOptions options;
    options.playing = false;
    const auto editor = makeEditor(options);
    const vec3 before = render::eyeOf(editor->workspace().camera);
    send(*editor, keyPressed(Key::w));
    pass(*editor, 10);
    CHECK(render::eyeOf(editor->workspace().camera) == before);
    send(*editor, mouseMoved({20, 60}));
    send(*editor, mouseButton(MouseButton::right, true));
    send(*editor, keyPressed(Key::w));
    pass(*editor, 30);
    const vec3 way = render::eyeOf(editor->workspace().camera) - before;
    CHECK(glm::dot(way, render::forwardOf(editor->workspace().camera)) > 0.4F);
    send(*editor, mouseButton(MouseButton::right, false));
    const vec3 there = render::eyeOf(editor->workspace().camera);
    pass(*editor, 10);
    CHECK(render::eyeOf(editor->workspace().camera) == there);
}

TEST_CASE("the clock goes on through edits and stands at zero after a reset") {
    const auto editor = makeEditor();
    pass(*editor, 30);
    REQUIRE(editor->edit([](EditorDocument& document) { return document.setMass(0, 9.0F); }));
    pass(*editor, 30);
    CHECK(editor->player().seconds() == Approx(1.0));
    editor->perform(Action::reset);
    CHECK(editor->player().seconds() == 0.0);
}
