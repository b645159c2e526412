/// Handles in the view: limits and shapes are dragged there.

#include "editor/view/handles.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "editor/play/limit_swing.hpp"
#include "editor/sessions.hpp"
#include "editor/view/joint_pick.hpp"
#include "physics/profile/constraint_state.hpp"
#include "physics/profile/profile_io.hpp"

using namespace lutka;
using namespace lutka::editor;
using animation::Role;
using test::click;
using test::makeEditor;
using test::pass;
using test::seenAt;
using test::send;
using Kind = Handle::Kind;

namespace {

EditorOptions pausedAtStart() {
    EditorOptions options;
    options.playing = false;
    return options;
}

int bodyOf(const Editor& editor, Role role) {
    return physics::bodyOf(editor.document().profile(), role);
}

void selectBody(Editor& editor, Role role) {
    editor.select(Item{Item::Kind::body, 0, bodyOf(editor, role)});
    editor.perform(Action::focus);
}

vec2 handleAt(const Editor& editor, Kind kind) {
    const auto scene = editor.workspace().handleScene();
    REQUIRE(scene.has_value());
    const auto handles = handlesOf(*scene, editor.workspace().camera);
    const auto found =
        std::find_if(handles.begin(), handles.end(), [&](const Handle& one) { return one.kind == kind; });
    REQUIRE(found != handles.end());
    const auto seen = render::project(editor.workspace().camera, found->position, editor.workspace().window);
    REQUIRE(seen.has_value());
    return vec2(*seen);
}

void press(Editor& editor, const vec2& at) {
    send(editor, mouseMoved(at));
    send(editor, mouseButton(MouseButton::left, true));
}

void release(Editor& editor) {
    send(editor, mouseButton(MouseButton::left, false));
}

physics::JointRange rangeOf(const Editor& editor, Role role) {
    const int constraint = bodyOf(editor, role) - 1;
    return physics::jointRange(editor.document().profile().constraints[constraint],
                               editor.document().bindOf(constraint));
}

// A fingerprint: whole profiles would drown the messages.
std::size_t textOf(const Editor& editor) {
    return std::hash<std::string>()(physics::profileToJson(editor.document().profile()));
}

}  // namespace

TEST_CASE("the end of a hinge's arc is hovered, dragged, and follows the mouse as one entry of undo") {
    const auto editor = makeEditor(pausedAtStart());
    selectBody(*editor, Role::leftLowerLeg);
    send(*editor, keyPressed(Key::digit3));  // from the side, where a knee's arc is a circle
    const std::size_t before = textOf(*editor);
    const physics::JointRange was = rangeOf(*editor, Role::leftLowerLeg);
    const vec2 at = handleAt(*editor, Kind::flexionHigh);
    send(*editor, mouseMoved(at));
    CHECK(editor->workspace().hotHandle == Kind::flexionHigh);
    press(*editor, at);
    REQUIRE(editor->state() == State::handle);
    const vec2 middle = handleAt(*editor, Kind::flexionLow);
    for (int i = 1; i <= 8; ++i)
        send(*editor, mouseMoved(at + (middle - at) * (static_cast<float>(i) / 20.0F)));
    const vec2 mouse = editor->workspace().mouse;
    const physics::JointRange dragged = rangeOf(*editor, Role::leftLowerLeg);
    CHECK(degrees(was.flexion.high - dragged.flexion.high) > 10.0F);
    CHECK(dragged.flexion.low == Approx(was.flexion.low).margin(1e-3));
    // The end of the arc points to where the mouse is.
    const auto scene = editor->workspace().handleScene();
    const physics::ConstraintProfile& knee = *scene->constraint();
    const vec3 hub = scene->worldFromParent * knee.parentFromFrame.translation;
    const vec2 center(*render::project(editor->workspace().camera, hub, editor->workspace().window));
    const vec2 toMouse = glm::normalize(mouse - center);
    const vec2 toHandle = glm::normalize(handleAt(*editor, Kind::flexionHigh) - center);
    CHECK(glm::dot(toMouse, toHandle) > std::cos(radians(3.0F)));
    release(*editor);
    CHECK(editor->state() == State::selected);
    CHECK_FALSE(editor->workspace().press.has_value());
    editor->perform(Action::undo);
    CHECK(textOf(*editor) == before);
    CHECK_FALSE(editor->document().canUndo());
}

TEST_CASE("no way out of a handle's drag but the release keeps the change") {
    for (const InputEvent& event :
         {keyPressed(Key::escape), mouseButton(MouseButton::right, true), focusChanged(false)}) {
        const auto editor = makeEditor(pausedAtStart());
        selectBody(*editor, Role::leftUpperLeg);
        const std::size_t before = textOf(*editor);
        const vec2 at = handleAt(*editor, Kind::flexionHigh);
        press(*editor, at);
        REQUIRE(editor->state() == State::handle);
        send(*editor, mouseMoved(at + vec2(30, 30)));
        CHECK(textOf(*editor) != before);
        send(*editor, event);
        CHECK(editor->state() == State::selected);
        CHECK(textOf(*editor) == before);
        CHECK_FALSE(editor->document().canUndo());
        CHECK_FALSE(editor->document().canRedo());
    }
}

TEST_CASE("half axes of a cone move both ends and with shift only the one that is held") {
    const auto editor = makeEditor(pausedAtStart());
    selectBody(*editor, Role::leftUpperLeg);
    const physics::JointRange was = rangeOf(*editor, Role::leftUpperLeg);
    const auto drag = [&](bool shift) {
        const vec2 at = handleAt(*editor, Kind::flexionHigh);
        const vec2 other = handleAt(*editor, Kind::flexionLow);
        press(*editor, at);
        REQUIRE(editor->state() == State::handle);
        if (shift) send(*editor, keyPressed(Key::leftShift));
        send(*editor, mouseMoved(at + (other - at) * 0.15F));
        const physics::JointRange range = rangeOf(*editor, Role::leftUpperLeg);
        send(*editor, keyPressed(Key::escape));
        return range;
    };
    const physics::JointRange both = drag(false);
    CHECK(std::abs(degrees(both.flexion.high - was.flexion.high)) > 3.0F);
    CHECK(both.flexion.low - was.flexion.low == Approx(was.flexion.high - both.flexion.high).margin(1e-3));
    const physics::JointRange one = drag(true);
    CHECK(std::abs(degrees(one.flexion.high - was.flexion.high)) > 3.0F);
    CHECK(one.flexion.low == Approx(was.flexion.low).margin(1e-3));
    CHECK(one.side.high == Approx(was.side.high).margin(1e-2));
}

TEST_CASE("each handle can be dragged while the doll moves and leaves a valid profile") {
    const auto editor = makeEditor();
    for (const Role role : {Role::leftUpperLeg, Role::leftLowerArm, Role::head, Role::hips, Role::leftFoot}) {
        selectBody(*editor, role);
        const auto scene = editor->workspace().handleScene();
        REQUIRE(scene.has_value());
        for (const Handle& handle : handlesOf(*scene, editor->workspace().camera)) {
            INFO(animation::roleName(role) << " " << handleName(handle.kind, role));
            const std::size_t before = textOf(*editor);
            const vec2 at = handleAt(*editor, handle.kind);
            press(*editor, at);
            if (editor->state() != State::handle) {  // hidden by the panel's edge or the window's
                release(*editor);
                selectBody(*editor, role);
                continue;
            }
            for (int i = 0; i < 6; ++i)
                send(*editor, mouseMoved(editor->workspace().mouse + vec2(9, -7)));
            CHECK(physics::validate(editor->document().profile()).empty());
            release(*editor);
            CHECK(editor->workspace().toasts.empty());
            if (textOf(*editor) == before) {  // a head as short as it can be
                CHECK_FALSE(handle.ofLimit());
                continue;
            }
            editor->perform(Action::undo);
            CHECK(textOf(*editor) == before);
        }
    }
}

TEST_CASE("one end of a capsule follows the mouse and the other stays") {
    const auto editor = makeEditor(pausedAtStart());
    selectBody(*editor, Role::leftUpperLeg);
    const int body = bodyOf(*editor, Role::leftUpperLeg);
    const auto ends = [&] {
        const RigidTransform world = editor->workspace().handleScene()->worldFromBody;
        const physics::BodyShape& shape = editor->document().profile().bodies[body].shape;
        const vec3 half = vec3(0, shape.halfLength + shape.radius, 0);
        return std::pair(world * half, world * -half);
    };
    const auto before = ends();
    const vec2 at = handleAt(*editor, Kind::capsuleBottom);
    const vec2 top = handleAt(*editor, Kind::capsuleTop);
    press(*editor, at);
    REQUIRE(editor->state() == State::handle);
    send(*editor, mouseMoved(at + (top - at) * 0.25F));
    const auto after = ends();
    CHECK(glm::distance(before.first, after.first) < 2e-3F);
    CHECK(glm::distance(before.second, after.second) > 0.04F);
    CHECK(glm::distance(handleAt(*editor, Kind::capsuleBottom), editor->workspace().mouse) < 6.0F);
    release(*editor);
    CHECK(editor->document().state().edits.at("leftUpperLeg").jointFromBody.has_value());
}

TEST_CASE("handles that are switched off take no click") {
    const auto editor = makeEditor(pausedAtStart());
    selectBody(*editor, Role::leftUpperLeg);
    const vec2 at = handleAt(*editor, Kind::flexionHigh);
    send(*editor, keyPressed(Key::h));
    CHECK_FALSE(editor->workspace().showHandles);
    press(*editor, at);
    CHECK(editor->state() != State::handle);
    release(*editor);
}

TEST_CASE("the swing of a joint reaches each limit, passes none, and ends where it began") {
    const auto editor = makeEditor(pausedAtStart());
    for (const Role role : {Role::leftUpperLeg, Role::rightLowerArm}) {
        const int child = bodyOf(*editor, role);
        std::vector<RigidTransform> start;
        for (const physics::BodyState& body : editor->player().bodiesOf(0))
            start.push_back(body.worldFromBody);
        LimitSwing swing(editor->document().profile(), child, start);
        const physics::ConstraintProfile& constraint = editor->document().profile().constraints[child - 1];
        float high = -kPi;
        float low = kPi;
        while (!swing.done()) {
            swing.advance(1.0F / 60.0F);
            const auto bodies = swing.worldFromBody();
            const auto now =
                physics::measureConstraint(constraint, bodies[constraint.parent], bodies[constraint.child]);
            CHECK(now.separationM < 1e-4F);
            CHECK(now.violation < radians(0.2F));
            const bool hinge = constraint.kind == physics::ConstraintProfile::Kind::hinge;
            high =
                std::max(high, hinge ? now.hingeAngle - constraint.hinge.upper : now.swing.z - constraint.cone.swingZ);
            low = std::min(low, hinge ? now.hingeAngle - constraint.hinge.lower : now.swing.z + constraint.cone.swingZ);
        }
        CHECK(std::abs(degrees(high)) < 1.0F);
        CHECK(std::abs(degrees(low)) < 1.0F);
        for (std::size_t i = 0; i < start.size(); ++i)
            CHECK(swing.worldFromBody()[i].translation == start[i].translation);
    }
}

TEST_CASE("swinging the limits leaves the simulation as it was, to the bit") {
    const auto editor = makeEditor();
    pass(*editor, 20);
    selectBody(*editor, Role::leftUpperArm);
    const std::uint64_t before = editor->player().simulation().stateHash();
    const int steps = editor->player().simulation().steps();
    send(*editor, keyPressed(Key::l));
    REQUIRE(editor->swing() != nullptr);
    const int hand = bodyOf(*editor, Role::leftHand);
    const vec3 rest = editor->player().bodiesOf(0)[hand].worldFromBody.translation;
    float furthest = 0.0F;
    for (int i = 0; i < 1000 && editor->swing() != nullptr; ++i) {
        pass(*editor, 1);
        furthest =
            std::max(furthest, glm::distance(editor->player().simulation().worldFromBody(0)[hand].translation, rest));
    }
    CHECK(editor->swing() == nullptr);
    CHECK(furthest > 0.3F);
    CHECK(editor->player().simulation().steps() == steps);
    CHECK(editor->player().simulation().stateHash() == before);
    send(*editor, keyPressed(Key::l));
    send(*editor, keyPressed(Key::escape));
    CHECK(editor->swing() == nullptr);
    CHECK(editor->player().simulation().worldFromBody(0)[hand].translation ==
          editor->player().bodiesOf(0)[hand].worldFromBody.translation);
}

TEST_CASE("a role takes the joint that is clicked in the view") {
    const auto editor = makeEditor(pausedAtStart());
    const auto& skeleton = editor->document().character().skeleton;
    const int chest = animation::findJoint(skeleton, "chest");
    REQUIRE(editor->document().state().map.jointOf(Role::spine) != chest);
    editor->beginPickJoint(Role::spine);
    REQUIRE(editor->state() == State::pickJoint);
    const vec3 place = editor->workspace().worldOfJoints(0)[chest];
    const vec2 seen(*render::project(editor->workspace().camera, place, editor->workspace().window));
    send(*editor, mouseMoved(seen));
    pass(*editor, 1);
    CHECK(editor->workspace().hotJoint == chest);
    send(*editor, mouseButton(MouseButton::left, true));
    send(*editor, mouseButton(MouseButton::left, false));
    CHECK(editor->state() == State::idle);
    CHECK(editor->document().state().map.jointOf(Role::spine) == chest);
    CHECK_FALSE(editor->workspace().pickRole.has_value());
    editor->perform(Action::undo);
    CHECK(editor->document().state().map.jointOf(Role::spine) != chest);
}

TEST_CASE("picking a joint is cancelled by escape and a click beside asks again") {
    const auto editor = makeEditor(pausedAtStart());
    editor->beginPickJoint(Role::head);
    click(*editor, {20, 60});
    CHECK(editor->state() == State::pickJoint);
    send(*editor, keyPressed(Key::escape));
    CHECK(editor->state() == State::idle);
    CHECK_FALSE(editor->document().canUndo());
}

TEST_CASE("copy, paste and mirror by keys work on all selected bodies") {
    const auto editor = makeEditor(pausedAtStart());
    selectBody(*editor, Role::leftHand);
    const int hand = bodyOf(*editor, Role::leftHand);
    REQUIRE(editor->edit([&](EditorDocument& document) { return document.setMass(hand, 1.25F); }));
    send(*editor, keyPressed(Key::c, {false, true, false}));
    editor->select(Item{Item::Kind::body, 0, bodyOf(*editor, Role::rightFoot)});
    editor->select(Item{Item::Kind::body, 0, bodyOf(*editor, Role::leftFoot)}, true);
    send(*editor, keyPressed(Key::v, {false, true, false}));
    CHECK(editor->document().profile().bodies[bodyOf(*editor, Role::leftFoot)].massKg == 1.25F);
    CHECK(editor->document().profile().bodies[bodyOf(*editor, Role::rightFoot)].massKg == 1.25F);
    selectBody(*editor, Role::leftHand);
    send(*editor, keyPressed(Key::m, {false, true, false}));
    CHECK(editor->document().profile().bodies[bodyOf(*editor, Role::rightHand)].massKg == 1.25F);
}
