#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>

#include "core/random.hpp"
#include "editor/sessions.hpp"
#include "support/command.hpp"

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

scene::EntityId addBox(Editor& editor, const vec3& at) {
    scene::EntityId id = scene::kNoEntity;
    REQUIRE(editor.editScene("Add", "", [&](scene::EntityScene& scene) {
        id = scene::addEntity(scene, scene::EntityKind::box, {{1, 0, 0, 0}, at}).id;
    }));
    return id;
}

EditorOptions paused() {
    EditorOptions options;
    options.playing = false;
    return options;
}

vec2 emptyPlace() {
    return {20, 60};
}

InputEvent leftDown() {
    return mouseButton(MouseButton::left, true);
}
InputEvent leftUp() {
    return mouseButton(MouseButton::left, false);
}

}  // namespace

TEST_CASE("a click selects the body under the mouse and a click beside lets go") {
    const auto editor = makeEditor(paused());
    click(*editor, seenAt(*editor, Role::leftHand));
    REQUIRE(editor->state() == State::selected);
    const auto active = editor->workspace().selection.active();
    REQUIRE(active.has_value());
    CHECK(editor->document().profile().bodies[active->index].role == Role::leftHand);
    click(*editor, seenAt(*editor, Role::head), {true, false, false});
    CHECK(editor->workspace().selection.items().size() == 2);
    click(*editor, emptyPlace());
    CHECK(editor->state() == State::idle);
    CHECK(editor->workspace().selection.empty());
}

TEST_CASE("what a panel takes never reaches the view") {
    const auto editor = makeEditor(paused());
    const UiCapture all{true, true};
    const render::Camera before = editor->workspace().camera;
    send(*editor, mouseMoved(seenAt(*editor, Role::hips)), all);
    send(*editor, leftDown(), all);
    send(*editor, mouseMoved({700, 300}), all);
    send(*editor, leftUp(), all);
    send(*editor, wheelTurned(3), all);
    send(*editor, mouseButton(MouseButton::right, true), all);
    send(*editor, mouseMoved({500, 200}), all);
    send(*editor, keyPressed(Key::space), all);
    send(*editor, textTyped('?'), all);
    CHECK(editor->state() == State::idle);
    CHECK(editor->workspace().selection.empty());
    CHECK(editor->workspace().camera.distance == before.distance);
    CHECK(editor->workspace().camera.yaw == before.yaw);
    CHECK_FALSE(editor->player().playing());
    CHECK_FALSE(editor->view.help);
}

TEST_CASE("a drag that began in the view ends over a panel all the same") {
    const auto editor = makeEditor();
    send(*editor, mouseMoved(seenAt(*editor, Role::hips)));
    send(*editor, leftDown());
    send(*editor, mouseMoved({640, 100}));
    REQUIRE(editor->state() == State::grab);
    send(*editor, mouseMoved({100, 100}), {true, false});
    CHECK(editor->workspace().pulls.mouse.has_value());
    send(*editor, leftUp(), {true, false});
    CHECK(editor->state() == State::selected);
    CHECK_FALSE(editor->workspace().pulls.mouse.has_value());
}

TEST_CASE("a hand that is dragged follows the mouse and falls when it is let go") {
    const auto editor = makeEditor();
    pass(*editor, 30);
    editor->handle(mouseMoved(seenAt(*editor, Role::rightHand)), {});
    send(*editor, leftDown());
    const vec2 target = editor->workspace().mouse + vec2(0, -220);
    for (int i = 1; i <= 20; ++i)
        send(*editor, mouseMoved(editor->workspace().mouse + (target - editor->workspace().mouse) / 4.0F));
    REQUIRE(editor->state() == State::grab);
    pass(*editor, 90);
    CHECK(glm::distance(seenAt(*editor, Role::rightHand), target) < 60.0F);
    const float held = placeOf(*editor, Role::rightHand).y;
    send(*editor, leftUp());
    CHECK(editor->state() == State::selected);
    pass(*editor, 60);
    CHECK(placeOf(*editor, Role::rightHand).y < held - 0.2F);
}

TEST_CASE("no way out of a grab leaves a drag in the world") {
    const std::pair<const char*, InputEvent> ways[] = {
        {"escape", keyPressed(Key::escape)},
        {"right click", mouseButton(MouseButton::right, true)},
        {"release", leftUp()},
        {"focus lost", focusChanged(false)},
        {"reset", keyPressed(Key::enter)},
    };
    for (const auto& [name, event] : ways) {
        INFO(name);
        const auto editor = makeEditor();
        pass(*editor, 5);
        send(*editor, mouseMoved(seenAt(*editor, Role::hips)));
        send(*editor, leftDown());
        send(*editor, mouseMoved(editor->workspace().mouse + vec2(0, -200)));
        REQUIRE(editor->state() == State::grab);
        pass(*editor, 60);
        const float high = placeOf(*editor, Role::hips).y;
        REQUIRE(high > 0.6F);
        send(*editor, event);
        CHECK(editor->state() == State::selected);
        CHECK_FALSE(editor->workspace().pulls.mouse.has_value());
        pass(*editor, 150);
        CHECK(placeOf(*editor, Role::hips).y < 0.5F);  // it fell, so nothing holds it
    }
}

TEST_CASE("a pinned body stays and falls when the pin is taken away") {
    const auto editor = makeEditor();
    click(*editor, seenAt(*editor, Role::head));
    send(*editor, keyPressed(Key::p));
    REQUIRE(editor->workspace().pulls.pins.size() == 1);
    const float pinned = placeOf(*editor, Role::head).y;
    pass(*editor, 120);
    CHECK(std::abs(placeOf(*editor, Role::head).y - pinned) < 0.25F);
    send(*editor, keyPressed(Key::p));
    CHECK(editor->workspace().pulls.pins.empty());
    pass(*editor, 150);
    CHECK(placeOf(*editor, Role::head).y < 0.8F);
}

TEST_CASE("pins survive an edit that makes the simulation anew") {
    const auto editor = makeEditor();
    click(*editor, seenAt(*editor, Role::head));
    send(*editor, keyPressed(Key::p));
    const float pinned = placeOf(*editor, Role::head).y;
    pass(*editor, 30);
    const int knee = physics::bodyOf(editor->document().profile(), Role::leftLowerLeg) - 1;
    REQUIRE(editor->edit([&](EditorDocument& document) { return document.setHinge(knee, {-0.2F, 0.3F}); }));
    pass(*editor, 120);
    CHECK(std::abs(placeOf(*editor, Role::head).y - pinned) < 0.25F);
}

TEST_CASE("an edit goes on at the present pose and speed with the new limit enforced") {
    const auto editor = makeEditor();
    pass(*editor, 25);
    const auto before = editor->player().bodiesOf(0);
    const int knee = physics::bodyOf(editor->document().profile(), Role::leftLowerLeg);
    const auto hinge = editor->document().profile().constraints[knee - 1].hinge;
    REQUIRE(editor->edit([&](EditorDocument& document) { return document.setHinge(knee - 1, {hinge.lower, 0.1F}); }));
    const auto after = editor->player().bodiesOf(0);
    REQUIRE(after.size() == before.size());
    for (std::size_t i = 0; i < after.size(); ++i) {
        CHECK(after[i].worldFromBody.translation == before[i].worldFromBody.translation);
        const quat apart = after[i].worldFromBody.rotation - before[i].worldFromBody.rotation;
        CHECK(glm::length(apart) < 1e-6F);  // the world normalises what it is given
        CHECK(after[i].linearVelocity == before[i].linearVelocity);
    }
    CHECK(editor->player().simulation().asset().profile.constraints[knee - 1].hinge.upper == 0.1F);
}

TEST_CASE("a new mapping goes on at the present pose without a jump") {
    const auto editor = makeEditor();
    pass(*editor, 30);
    const vec3 hips = placeOf(*editor, Role::hips);
    const vec3 hand = placeOf(*editor, Role::leftHand);
    REQUIRE(editor->edit([](EditorDocument& document) { return document.unmapRole(Role::neck); }));
    CHECK(glm::distance(placeOf(*editor, Role::hips), hips) < 0.02F);
    CHECK(glm::distance(placeOf(*editor, Role::leftHand), hand) < 0.05F);
}

TEST_CASE("space pauses, the arrow steps once and Ctrl+R gives the same start again") {
    const auto editor = makeEditor();
    const std::uint64_t start = editor->player().simulation().stateHash();
    pass(*editor, 20);
    const std::uint64_t later = editor->player().simulation().stateHash();
    CHECK(editor->player().simulation().steps() == 20);
    send(*editor, keyPressed(Key::space));
    pass(*editor, 10);
    CHECK(editor->player().simulation().stateHash() == later);
    send(*editor, keyPressed(Key::right));
    CHECK(editor->player().simulation().steps() == 21);
    send(*editor, keyPressed(Key::r, {false, true, false}));
    CHECK(editor->player().simulation().stateHash() == start);
    send(*editor, keyPressed(Key::space));
    pass(*editor, 19);
    CHECK(editor->player().simulation().stateHash() == later);
}

TEST_CASE("a frame of any length makes whole steps and a very long one is clamped") {
    const auto editor = makeEditor();
    editor->update(0.004);
    CHECK(editor->player().simulation().steps() == 0);
    CHECK(editor->player().alpha() == Approx(0.24F));
    editor->update(0.013);
    CHECK(editor->player().simulation().steps() == 1);
    editor->update(30.0);
    CHECK(editor->player().simulation().steps() == 7);
}

TEST_CASE("middle drag orbits, with shift pans, wheel zooms, and each ends with its button") {
    const auto editor = makeEditor(paused());
    const render::Camera before = editor->workspace().camera;
    send(*editor, mouseMoved(emptyPlace()));
    send(*editor, mouseButton(MouseButton::middle, true));
    CHECK(editor->state() == State::cameraRotate);
    send(*editor, mouseMoved(emptyPlace() + vec2(100, 0)));
    CHECK(editor->workspace().camera.yaw != before.yaw);
    send(*editor, leftUp());
    CHECK(editor->state() == State::cameraRotate);
    send(*editor, mouseButton(MouseButton::middle, false));
    CHECK(editor->state() == State::idle);
    const render::Camera orbited = editor->workspace().camera;
    send(*editor, mouseButton(MouseButton::right, true, {true, false, false}));
    CHECK(editor->state() == State::cameraMove);
    send(*editor, mouseMoved(emptyPlace()));
    CHECK(editor->workspace().camera.target != orbited.target);
    send(*editor, mouseButton(MouseButton::right, false));
    send(*editor, wheelTurned(1));
    CHECK(editor->workspace().camera.distance < orbited.distance);
}

TEST_CASE("G X 1.5 Enter moves a box by 1.5 metres and one undo brings it back") {
    const auto editor = makeEditor(paused());
    const scene::EntityId box = addBox(*editor, {1, 0.25F, 0});
    editor->select(Item{Item::Kind::object, 0, static_cast<int>(box)});
    for (const Key key : {Key::g, Key::x, Key::digit1, Key::period, Key::digit5, Key::enter})
        send(*editor, keyPressed(key));
    CHECK(editor->state() == State::selected);
    const auto place = [&] { return scene::worldFromEntity(editor->document().scene(), box).translation; };
    CHECK(glm::distance(place(), vec3(2.5F, 0.25F, 0)) < 1e-4F);
    send(*editor, keyPressed(Key::z, {false, true, false}));
    CHECK(glm::distance(place(), vec3(1, 0.25F, 0)) < 1e-6F);
    for (const Key key : {Key::g, Key::y, Key::digit2, Key::escape})
        send(*editor, keyPressed(key));
    CHECK(glm::distance(place(), vec3(1, 0.25F, 0)) < 1e-6F);
    for (const Key key : {Key::s, Key::digit2, Key::enter})
        send(*editor, keyPressed(key));
    CHECK(editor->document().scene().find<scene::Collider>(box)->halfExtents.x == Approx(0.5F));
    for (const Key key : {Key::r, Key::y, Key::digit9, Key::digit0, Key::enter})
        send(*editor, keyPressed(key));
    const quat turned = scene::worldFromEntity(editor->document().scene(), box).rotation;
    CHECK(glm::distance(turned * vec3(1, 0, 0), vec3(0, 0, -1)) < 1e-4F);
}

TEST_CASE("S on a body resizes its shape as one undoable edit and Esc takes it back") {
    const auto editor = makeEditor(paused());
    click(*editor, seenAt(*editor, Role::hips));
    const int hips = physics::bodyOf(editor->document().profile(), Role::hips);
    const float radius = editor->document().profile().bodies[hips].shape.radius;
    for (const Key key : {Key::s, Key::digit2, Key::escape})
        send(*editor, keyPressed(key));
    CHECK(editor->document().profile().bodies[hips].shape.radius == radius);
    CHECK_FALSE(editor->document().canUndo());
    for (const Key key : {Key::s, Key::digit1, Key::period, Key::digit2, Key::enter})
        send(*editor, keyPressed(key));
    CHECK(editor->document().profile().bodies[hips].shape.radius == Approx(radius * 1.2F));
    editor->perform(Action::undo);
    CHECK(editor->document().profile().bodies[hips].shape.radius == radius);
}

TEST_CASE("R turns a whole doll about its hips and Esc turns it back") {
    const auto editor = makeEditor(paused());
    click(*editor, seenAt(*editor, Role::hips));
    const vec3 hips = placeOf(*editor, Role::hips);
    const vec3 head = placeOf(*editor, Role::head);
    for (const Key key : {Key::r, Key::z, Key::digit9, Key::digit0})
        send(*editor, keyPressed(key));
    CHECK(glm::distance(placeOf(*editor, Role::hips), hips) < 1e-4F);
    CHECK(std::abs(placeOf(*editor, Role::head).y - hips.y) < 0.1F);
    send(*editor, keyPressed(Key::escape));
    CHECK(glm::distance(placeOf(*editor, Role::head), head) < 1e-5F);
}

TEST_CASE("Shift+A places a box where the mouse points and Delete asks before it takes it away") {
    const auto editor = makeEditor(paused());
    const std::size_t before = editor->document().scene().entities.size();
    const auto added = [&] { return editor->document().scene().entities.size() - before; };
    send(*editor, mouseMoved({300, 650}));
    send(*editor, keyPressed(Key::a, {true, false, false}));
    REQUIRE(editor->state() == State::add);
    send(*editor, leftDown());
    send(*editor, leftUp());
    REQUIRE(editor->state() == State::selected);
    REQUIRE(added() == 1);
    CHECK(editor->document()
              .scene()
              .find<scene::Transform>(editor->document().scene().entities.back().id)
              ->parentFromEntity.translation.y == Approx(0.25F).margin(1e-3));
    send(*editor, keyPressed(Key::del));
    CHECK(editor->state() == State::remove);
    send(*editor, keyPressed(Key::escape));
    CHECK(added() == 1);
    send(*editor, keyPressed(Key::x));
    send(*editor, keyPressed(Key::enter));
    CHECK(added() == 0);
    CHECK(editor->state() == State::idle);
    editor->perform(Action::undo);
    CHECK(added() == 1);
}

TEST_CASE("a ball that is thrown meets the doll and is gone after a reset") {
    const auto editor = makeEditor();
    send(*editor, mouseMoved(seenAt(*editor, Role::hips)));
    send(*editor, keyPressed(Key::b));
    CHECK(editor->player().simulation().world().props().size() == 1);
    const vec3 start = editor->player().simulation().worldFromProp(0).translation;
    pass(*editor, 10);
    CHECK(glm::distance(editor->player().simulation().worldFromProp(0).translation, start) > 0.8F);
    send(*editor, keyPressed(Key::b));
    CHECK(editor->player().simulation().world().props().size() == 2);
    editor->perform(Action::reset);
    CHECK(editor->player().simulation().world().props().size() == 0);
}

TEST_CASE("a file that is no model is told and the old scene goes on") {
    const auto editor = makeEditor();
    const test::ScratchFolder folder;
    const std::filesystem::path file = folder / "broken.glb";
    std::ofstream(file) << "no model";
    pass(*editor, 10);
    send(*editor, filesDropped({file.string()}));
    CHECK(editor->document().character().name == "biped");
    CHECK(editor->player().simulation().steps() == 11);
    REQUIRE_FALSE(editor->workspace().toasts.empty());
    CHECK(editor->workspace().toasts.back().kind == Toast::Kind::error);
    CHECK(editor->characterRevision() == 0);
}

TEST_CASE("a model that is dropped replaces the scene and nothing of the old one stays selected") {
    const auto editor = makeEditor();
    click(*editor, seenAt(*editor, Role::hips));
    send(*editor, keyPressed(Key::p));
    send(*editor, filesDropped({LUTKA_ASSETS_DIR "/models/mannequin.glb"}));
    CHECK(editor->document().character().name == "mannequin");
    CHECK(editor->characterRevision() == 1);
    CHECK(editor->workspace().selection.empty());
    CHECK(editor->workspace().pulls.pins.empty());
    CHECK(editor->state() == State::idle);
    pass(*editor, 5);
    CHECK(editor->player().simulation().steps() > 0);
}

TEST_CASE("unsaved changes are asked about before they are lost") {
    const auto editor = makeEditor();
    const int hand = physics::bodyOf(editor->document().profile(), Role::leftHand);
    REQUIRE(editor->edit([&](EditorDocument& document) { return document.setMass(hand, 2.0F); }));
    send(*editor, windowClosed());
    REQUIRE(editor->files().asking());
    CHECK_FALSE(editor->quitting());
    editor->files().answer(FileFlow::Answer::cancel);
    CHECK_FALSE(editor->files().asking());
    CHECK_FALSE(editor->quitting());
    send(*editor, windowClosed());
    editor->files().answer(FileFlow::Answer::discard);
    CHECK(editor->quitting());
}

TEST_CASE("an editor without changes quits at once") {
    const auto editor = makeEditor();
    send(*editor, windowClosed());
    CHECK(editor->quitting());
}

TEST_CASE("the baked fall is written as a glb") {
    const auto editor = makeEditor();
    const test::ScratchFolder folder;
    const std::filesystem::path file = folder / "baked.glb";
    REQUIRE(editor->files().exportBaked(file, 0.5F).ok());
    CHECK(std::filesystem::file_size(file) > 1000);
}

TEST_CASE("any sequence of events keeps the editor whole and the same one gives the same state") {
    const auto play = [](std::uint64_t seed) {
        EditorOptions options;
        options.scene.count = 2;
        const auto editor = makeEditor(options);
        const test::ScratchFolder folder;  // for when it happens to press Ctrl+S
        REQUIRE(editor->document().save(folder / "saved.ragdoll.json").ok());
        Random random(seed);
        const auto pick = [&](int count) {
            return static_cast<int>(random.next() % static_cast<std::uint64_t>(count));
        };
        for (int i = 0; i < 400; ++i) {
            const Modifiers modifiers{pick(5) == 0, pick(12) == 0, false};
            switch (pick(5)) {
                case 0:
                    send(*editor, keyPressed(static_cast<Key>(pick(static_cast<int>(Key::backspace))), modifiers));
                    break;
                case 1:
                    send(*editor, mouseButton(static_cast<MouseButton>(pick(3)), pick(2) == 0, modifiers));
                    break;
                case 2:
                    send(*editor, wheelTurned(random.uniform(-2, 2)));
                    break;
                default:
                    send(*editor, mouseMoved({random.uniform(400, 880), random.uniform(60, 660)}));
                    break;
            }
            if (editor->files().asking()) editor->files().answer(FileFlow::Answer::cancel);
            const bool pulling = editor->workspace().pulls.mouse.has_value();
            REQUIRE((!pulling || editor->state() == State::grab));
            REQUIRE((editor->state() != State::idle || editor->workspace().selection.empty()));
            REQUIRE((editor->state() != State::selected || !editor->workspace().selection.empty()));
        }
        return editor->player().simulation().stateHash();
    };
    for (const std::uint64_t seed : {1ULL, 2ULL, 3ULL})
        CHECK(play(seed) == play(seed));
}
