/// The file's clips on a doll: shown, scrubbed, looped, and handed over to physics.

#include <cmath>
#include <glm/geometric.hpp>

#include "animation/pose.hpp"
#include "editor/sessions.hpp"

using namespace lutka;
using namespace lutka::editor;
using animation::Role;
using test::placeOf;
using test::send;

namespace {

// The hand-made figure with a clip of one second in which its hips rise by a metre.
std::unique_ptr<Editor> editorWithClip(const EditorOptions& options = {}) {
    animation::Character character = test::makeBiped();
    const animation::Skeleton& skeleton = character.skeleton;
    animation::Clip clip;
    clip.name = "rise";
    clip.framesPerSecond = 10.0F;
    clip.frameCount = 11;
    std::vector<RigidTransform> local(skeleton.parents.size());
    animation::modelToLocal(skeleton, skeleton.bindModelFromJoint, local);
    const auto map = test::mapOfBiped(character);
    for (int frame = 0; frame < clip.frameCount; ++frame) {
        for (std::size_t joint = 0; joint < local.size(); ++joint) {
            RigidTransform now = local[joint];
            if (static_cast<int>(joint) == map.jointOf(Role::hips))
                now.translation.y += 0.1F * static_cast<float>(frame);
            clip.parentFromJoint.push_back(now);
        }
    }
    character.clips.push_back(clip);
    auto asset = scene::makeRagdoll(std::move(character));
    REQUIRE(asset.ok());
    auto editor = Editor::create(std::make_unique<EditorDocument>(std::move(asset).value()), options);
    REQUIRE(editor.ok());
    return std::move(editor).value();
}

EditorOptions stillScene() {
    EditorOptions options;
    options.playing = false;
    return options;
}

}  // namespace

TEST_CASE("a clip is shown where the scene holds its figure, not on the floor below") {
    EditorOptions options = stillScene();
    options.scene.scenario = "hang";
    const auto editor = editorWithClip(options);
    const float before = placeOf(*editor, Role::hips).y;
    send(*editor, keyPressed(Key::f4));
    REQUIRE(editor->player().clip() != nullptr);
    CHECK(placeOf(*editor, Role::hips).y == Approx(before).margin(0.1));
}

TEST_CASE("a clip plays, is scrubbed and stepped, and leaves the doll where it was") {
    const auto editor = editorWithClip(stillScene());
    const vec3 before = placeOf(*editor, Role::head);
    send(*editor, keyPressed(Key::f4));
    REQUIRE(editor->view.clips);
    REQUIRE(editor->player().clip() != nullptr);
    CHECK(editor->player().clip()->clip() == "rise");
    CHECK(editor->player().clip()->length() == Approx(1.0F));
    const float start = placeOf(*editor, Role::hips).y;
    // The scene is paused: the clip stands still until it is played.
    test::pass(*editor, 30);
    CHECK(editor->player().clip()->seconds() == 0.0F);
    send(*editor, keyPressed(Key::space));
    test::pass(*editor, 29);
    CHECK(editor->player().clip()->seconds() == Approx(0.5F).margin(0.02));
    CHECK(placeOf(*editor, Role::hips).y == Approx(start + 0.5F).margin(0.03));
    editor->player().seekClip(0.9F);
    CHECK(placeOf(*editor, Role::hips).y == Approx(start + 0.9F).margin(0.01));
    send(*editor, keyPressed(Key::right));
    CHECK_FALSE(editor->player().playing());
    CHECK(editor->player().clip()->seconds() == Approx(0.9F + 1.0F / 60.0F));
    // Simulated time stands still meanwhile.
    CHECK(editor->player().seconds() == 0.0);
    send(*editor, keyPressed(Key::f4));
    CHECK(editor->player().clip() == nullptr);
    CHECK(glm::distance(placeOf(*editor, Role::head), before) < 1e-5F);
    CHECK_FALSE(editor->document().canUndo());
}

TEST_CASE("a clip loops, or stops at its end and plays again from its start") {
    const auto editor = editorWithClip();
    editor->perform(Action::toggleClips);
    test::pass(*editor, 90);
    CHECK(editor->player().playing());
    CHECK(editor->player().clip()->seconds() == Approx(0.5F).margin(0.04));
    editor->player().setClipLoop(false);
    test::pass(*editor, 60);
    CHECK(editor->player().clip()->seconds() == editor->player().clip()->length());
    CHECK_FALSE(editor->player().playing());
    send(*editor, keyPressed(Key::space));
    CHECK(editor->player().playing());
    CHECK(editor->player().clip()->seconds() < 0.1F);
}

TEST_CASE("physics goes on from a clip's pose and speed, and undo brings the doll back") {
    const auto editor = editorWithClip(stillScene());
    const vec3 before = placeOf(*editor, Role::hips);
    editor->perform(Action::toggleClips);
    editor->player().seekClip(0.5F);
    const vec3 shown = placeOf(*editor, Role::hips);
    editor->perform(Action::fallFromClip);
    CHECK(editor->player().clip() == nullptr);
    CHECK(glm::distance(placeOf(*editor, Role::hips), shown) < 1e-4F);
    CHECK(editor->player().bodiesOf(0).front().linearVelocity.y == Approx(1.0F).margin(0.05));
    editor->player().setPlaying(true);
    test::pass(*editor, 3);
    CHECK(placeOf(*editor, Role::hips).y > shown.y);  // it was on its way up
    editor->perform(Action::undo);
    CHECK(glm::distance(placeOf(*editor, Role::hips), before) < 1e-4F);
}

TEST_CASE("undo of what happens while a clip is shown brings the doll back to where it was before the clip") {
    const auto editor = editorWithClip(stillScene());
    const vec3 before = placeOf(*editor, Role::hips);
    editor->perform(Action::toggleClips);
    editor->player().seekClip(0.5F);
    REQUIRE(glm::distance(placeOf(*editor, Role::hips), before) > 0.2F);
    editor->perform(Action::throwBall);
    REQUIRE(editor->document().canUndo());
    editor->perform(Action::undo);
    CHECK(glm::distance(placeOf(*editor, Role::hips), before) < 1e-4F);
    // A recording begins where the doll was, too.
    editor->perform(Action::toggleClips);
    editor->perform(Action::toggleClips);
    editor->player().seekClip(0.5F);
    editor->player().startRecording();
    CHECK(editor->player().clip() == nullptr);
    CHECK(glm::distance(placeOf(*editor, Role::hips), before) < 1e-4F);
}

TEST_CASE("a clip stays with its character when others go, and ends with it") {
    const auto editor = editorWithClip(stillScene());
    editor->dropCopies(2);
    REQUIRE(editor->player().simulation().dollCount() == 3);
    const auto entities = editor->player().simulation().scenario().dollEntities;
    const auto take = [&](scene::EntityId entity) {
        REQUIRE(editor->editScene("Delete", "", [&](scene::EntityScene& scene) { removeEntity(scene, entity); }));
        test::pass(*editor, 2);
    };
    editor->select(Item{Item::Kind::body, 2, 0});
    editor->perform(Action::toggleClips);
    REQUIRE(editor->player().clip() != nullptr);
    REQUIRE(editor->player().clip()->doll() == 2);
    take(entities[1]);
    REQUIRE(editor->player().clip() != nullptr);
    CHECK(editor->player().clip()->doll() == 1);
    take(entities[2]);
    CHECK(editor->player().clip() == nullptr);
}

TEST_CASE("a drag takes the doll out of its clip, an edit leaves it there, a reset ends it") {
    const auto editor = editorWithClip();
    editor->perform(Action::toggleClips);
    test::pass(*editor, 6);
    const int hand = physics::bodyOf(editor->document().profile(), Role::leftHand);
    REQUIRE(editor->edit([&](EditorDocument& document) { return document.setMass(hand, 1.0F); }));
    test::pass(*editor, 2);
    CHECK(editor->player().clip() != nullptr);
    send(*editor, mouseMoved(test::seenAt(*editor, Role::rightHand)));
    send(*editor, mouseButton(MouseButton::left, true));
    for (int step = 0; step < 6; ++step)
        send(*editor, mouseMoved(editor->workspace().mouse + vec2(0, -8)));
    REQUIRE(editor->state() == State::grab);
    CHECK(editor->player().clip() == nullptr);
    send(*editor, mouseButton(MouseButton::left, false));
    editor->perform(Action::toggleClips);
    editor->perform(Action::toggleClips);
    REQUIRE(editor->player().clip() != nullptr);
    editor->perform(Action::reset);
    CHECK(editor->player().clip() == nullptr);
}

TEST_CASE("the hit tool hits the body under the mouse, harder by the wheel, and undo takes the hit back") {
    const auto editor = test::makeEditor();
    test::pass(*editor, 3);
    editor->workspace().tool = Tool::hit;
    send(*editor, mouseMoved(test::seenAt(*editor, Role::head)));
    const float before = editor->workspace().hitNs;
    const float distance = editor->workspace().camera.distance;
    send(*editor, wheelTurned(2));
    CHECK(editor->workspace().hitNs > before * 1.2F);
    CHECK(editor->workspace().camera.distance == distance);
    const auto momentum = [&] {
        vec3 sum(0);
        const auto bodies = editor->player().bodiesOf(0);
        for (std::size_t i = 0; i < bodies.size(); ++i)
            sum += editor->document().profile().bodies[i].massKg * bodies[i].linearVelocity;
        return sum;
    };
    editor->handle(mouseMoved(test::seenAt(*editor, Role::head)), {});
    const vec3 direction = editor->workspace().mouseRay().direction;
    editor->player().setPlaying(false);
    const vec3 was = momentum();
    send(*editor, mouseButton(MouseButton::left, true));
    send(*editor, mouseButton(MouseButton::left, false));
    const vec3 gained = momentum() - was;
    CHECK(glm::dot(gained, direction) == Approx(editor->workspace().hitNs).epsilon(0.02));
    CHECK(editor->document().undoLabel() == "Hit head");
    CHECK(editor->state() == State::idle);  // a hit selects nothing
    editor->perform(Action::undo);
    CHECK(glm::length(momentum() - was) < 0.01F);
    // Beside the doll the wheel zooms and a click lets go, as with the other tools.
    send(*editor, mouseMoved({20, 60}));
    send(*editor, wheelTurned(1));
    CHECK(editor->workspace().camera.distance != distance);
}

TEST_CASE("a hit on what is gone by the same frame, or on a take that is shown, does nothing") {
    const auto editor = test::makeEditor();
    test::pass(*editor, 3);
    const int last = static_cast<int>(editor->document().profile().bodies.size()) - 1;
    Pick pick;
    pick.body = Item{Item::Kind::body, 1, 0};
    editor->workspace().hit = pick;
    test::pass(*editor, 1);
    pick.body = Item{Item::Kind::body, 0, last + 1};
    editor->workspace().hit = pick;
    test::pass(*editor, 1);
    CHECK_FALSE(editor->document().canUndo());
    editor->player().startRecording();
    test::pass(*editor, 10);
    editor->player().stopRecording();
    REQUIRE(editor->player().replay().ok());
    pick.body = Item{Item::Kind::body, 0, 0};
    editor->workspace().hit = pick;
    test::pass(*editor, 1);
    CHECK_FALSE(editor->document().canUndo());
    CHECK(editor->player().deck().replaying());
}

TEST_CASE("T goes through all tools and comes back to the first") {
    const auto editor = test::makeEditor();
    for (int i = 0; i < kToolCount; ++i) {
        CHECK(static_cast<int>(editor->workspace().tool) == i);
        send(*editor, keyPressed(Key::t));
    }
    CHECK(editor->workspace().tool == Tool::select);
}
