// A drag on skin that has no shape of a body.

#include <glm/geometric.hpp>

#include "editor/sessions.hpp"
#include "editor/view/skin_picking.hpp"

using namespace lutka;
using namespace lutka::editor;

namespace {

// A figure with a sword in its right hand, which has a joint and no body.
std::unique_ptr<Editor> editorWithSword() {
    auto asset = scene::makeRagdoll(test::makeBipedWithAppendages());
    REQUIRE(asset.ok());
    auto made = Editor::create(std::make_unique<EditorDocument>(std::move(asset).value()), {});
    REQUIRE(made.ok());
    made.value()->workspace().window = {1280, 720};
    made.value()->player().setPlaying(false);
    return std::move(made).value();
}

// A place in the sword's blade, whatever the doll does.
vec3 bladeOf(Editor& editor) {
    scene::Simulation& simulation = editor.player().simulation();
    const animation::Skeleton& skeleton = simulation.asset().character.skeleton;
    const int sword = animation::findJoint(skeleton, "sword");
    REQUIRE(sword >= 0);
    std::vector<RigidTransform> pose(skeleton.parents.size());
    simulation.pose(0, 1.0F, pose);
    const vec3 inJoint = inverse(skeleton.bindModelFromJoint[sword]) * vec3(-0.80F, 1.42F, 0.80F);
    return simulation.worldFromModel(0) * (pose[sword] * inJoint);
}

int handOf(const Editor& editor) {
    return physics::bodyOf(editor.document().profile(), animation::Role::rightHand);
}

}  // namespace

TEST_CASE("skin without a body is picked as the body that carries it, from both sides") {
    const auto editor = editorWithSword();
    const vec3 blade = bladeOf(*editor);
    scene::Simulation& simulation = editor->player().simulation();
    for (const float side : {-1.0F, 1.0F}) {
        const render::Ray ray{blade + vec3(0, 3.0F * side, 0), {0, -side, 0}};
        if (side > 0) CHECK_FALSE(pick(ray, simulation, {}).has_value());
        const auto hit = pickSkin(ray, simulation, 1.0F, 100.0F);
        REQUIRE(hit.has_value());
        CHECK(hit->doll == 0);
        CHECK(hit->body == handOf(*editor));
        CHECK(hit->distance == Approx(3.0F).margin(0.05));
        CHECK(glm::distance(hit->position, blade) < 0.05F);
        CHECK(hit->normal.y * side > 0.1F);
        CHECK_FALSE(pickSkin(ray, simulation, 1.0F, 2.5F).has_value());
        CHECK_FALSE(pickSkin({ray.origin, -ray.direction}, simulation, 1.0F, 100.0F).has_value());
        CHECK_FALSE(pickSkin({ray.origin - vec3(1, 0, 0), ray.direction}, simulation, 1.0F, 100.0F).has_value());
    }
    // Where a body's skin is, it is that body's.
    const vec3 hips = test::placeOf(*editor, animation::Role::hips);
    const auto trunk = pickSkin({hips + vec3(0, 0, 3), {0, 0, -1}}, simulation, 1.0F, 100.0F);
    REQUIRE(trunk.has_value());
    CHECK(editor->document().profile().bodies[static_cast<std::size_t>(trunk->body)].role == animation::Role::hips);
}

TEST_CASE("a drag on skin without a body pulls what carries it, unless something stands before it") {
    const auto editor = editorWithSword();
    test::pass(*editor, 2);
    const auto seen = render::project(editor->workspace().camera, bladeOf(*editor), editor->workspace().window);
    REQUIRE(seen.has_value());
    const vec2 at(*seen);
    const vec3 before = bladeOf(*editor);
    test::send(*editor, mouseMoved(at));
    test::send(*editor, mouseButton(MouseButton::left, true));
    CHECK(editor->state() == State::selected);
    CHECK(editor->workspace().selection.active() == Item{Item::Kind::body, 0, handOf(*editor)});
    for (int step = 1; step <= 10; ++step)
        test::send(*editor, mouseMoved(at + vec2(0, -6.0F * static_cast<float>(step))));
    CHECK(editor->state() == State::grab);
    test::pass(*editor, 30);
    test::send(*editor, mouseButton(MouseButton::left, false));
    CHECK(bladeOf(*editor).y > before.y + 0.02F);

    const auto walled = editorWithSword();
    const vec3 eye = render::eyeOf(walled->workspace().camera);
    REQUIRE(walled->editScene("Wall", "", [&](scene::EntityScene& scene) {
        const vec3 between = 0.5F * (eye + bladeOf(*walled));
        const scene::EntityId id = scene::addEntity(scene, scene::EntityKind::box, {{1, 0, 0, 0}, between}).id;
        scene.find<scene::Collider>(id)->halfExtents = vec3(0.2F);
    }));
    test::click(*walled, at);
    REQUIRE(walled->workspace().selection.active().has_value());
    CHECK(walled->workspace().selection.active()->kind == Item::Kind::object);
}

TEST_CASE("skin that is not drawn is not picked") {
    const auto editor = editorWithSword();
    test::pass(*editor, 2);
    const auto seen = render::project(editor->workspace().camera, bladeOf(*editor), editor->workspace().window);
    REQUIRE(seen.has_value());
    test::send(*editor, mouseMoved(vec2(*seen)));
    const auto isPicked = [&] {
        const auto pick = editor->workspace().pickUnderMouse();
        return pick && pick->body;
    };
    CHECK(isPicked());
    editor->view.skinOpacity = 0.0F;
    test::pass(*editor, 1);
    CHECK_FALSE(isPicked());
    editor->view.skinOpacity = 0.5F;
    test::pass(*editor, 1);
    CHECK(isPicked());
    REQUIRE(editor->editScene("Hide", "", [](scene::EntityScene& scene) {
        for (const scene::Ragdoll& doll : scene.all<scene::Ragdoll>())
            scene.find<scene::MeshRenderer>(doll.entity)->visible = false;
    }));
    test::pass(*editor, 1);
    CHECK_FALSE(isPicked());
    scene::Simulation& simulation = editor->player().simulation();
    const vec3 blade = bladeOf(*editor);
    CHECK_FALSE(pickSkin({blade + vec3(0, 3, 0), {0, -1, 0}}, simulation, 1.0F, 100.0F).has_value());
}

TEST_CASE("the hit tool shows the shape under the mouse, and its click takes skin too") {
    const auto editor = editorWithSword();
    test::pass(*editor, 2);
    const auto seen = render::project(editor->workspace().camera, bladeOf(*editor), editor->workspace().window);
    REQUIRE(seen.has_value());
    editor->workspace().tool = Tool::hit;
    test::send(*editor, mouseMoved(vec2(*seen)));
    // Nothing is posed and skinned for a frame in which nobody clicks.
    CHECK_FALSE(editor->workspace().shapeUnderMouse().has_value());
    CHECK_THAT(editor->workspace().hint, Catch::StartsWith("Point at a body"));
    const float distance = editor->workspace().camera.distance;
    test::send(*editor, wheelTurned(1));
    CHECK(editor->workspace().camera.distance < distance);
    test::send(*editor, wheelTurned(-1));
    test::send(*editor, mouseButton(MouseButton::left, true));
    test::send(*editor, mouseButton(MouseButton::left, false));
    const auto& bodies = editor->document().profile().bodies;
    CHECK(editor->document().undoLabel() == "Hit " + bodies[static_cast<std::size_t>(handOf(*editor))].name);
    test::send(*editor, mouseMoved(test::seenAt(*editor, animation::Role::chest)));
    CHECK_THAT(editor->workspace().hint, Catch::StartsWith("A click hits"));
}
