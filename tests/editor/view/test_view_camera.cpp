#include "editor/view/view_camera.hpp"

#include <glm/geometric.hpp>

#include "editor/sessions.hpp"

using namespace lutka;
using namespace lutka::editor;
using animation::Role;

namespace {

EditorOptions sceneOf(std::string_view name, render::Extent window) {
    EditorOptions options;
    options.playing = false;
    options.scene.scenario = name;
    options.window = window;
    return options;
}

// As panels and bars of the window would.
render::PictureInsets panelsOf(render::Extent window) {
    const auto width = static_cast<float>(window.width);
    const auto height = static_cast<float>(window.height);
    return {std::min(310.0F, width * 0.29F) / width, std::min(344.0F, width * 0.33F) / width, 70.0F / height,
            28.0F / height};
}

bool seesAll(const Editor& editor) {
    const Workspace& workspace = editor.workspace();
    const auto width = static_cast<float>(workspace.window.width);
    const auto height = static_cast<float>(workspace.window.height);
    scene::Simulation& simulation = workspace.player->simulation();
    for (int doll = 0; doll < simulation.dollCount(); ++doll) {
        for (const RigidTransform& body : simulation.worldFromBody(doll)) {
            const auto seen = render::project(workspace.camera, body.translation, workspace.window);
            if (!seen) return false;
            if (seen->x < workspace.covered.left * width || seen->x > (1.0F - workspace.covered.right) * width ||
                seen->y < workspace.covered.top * height || seen->y > (1.0F - workspace.covered.bottom) * height) {
                return false;
            }
        }
    }
    return true;
}

}  // namespace

TEST_CASE("every named scene is framed whole between the panels of a window of any size") {
    for (const render::Extent window : {render::Extent{1280, 720}, {1920, 1080}, {800, 900}, {640, 480}}) {
        for (const scene::ScenarioInfo& info : scene::scenarioRegistry()) {
            INFO(info.name << " at " << window.width << " x " << window.height);
            const auto editor = test::makeEditor(sceneOf(info.name, window));
            editor->workspace().covered = panelsOf(window);
            test::pass(*editor, 1);
            CHECK(seesAll(*editor));
        }
    }
}

TEST_CASE("a doll that has fallen lies in the picture in which it began") {
    for (const render::Extent window : {render::Extent{1280, 720}, {800, 900}}) {
        const auto editor = test::makeEditor(sceneOf("drop", window));
        editor->workspace().covered = panelsOf(window);
        editor->player().setPlaying(true);
        for (int second = 0; second < 5; ++second) {
            INFO(second << " s at " << window.width << " x " << window.height);
            test::pass(*editor, 60);
            CHECK(seesAll(*editor));
        }
    }
}

TEST_CASE("a framed view goes along with the window until the user moves it") {
    const auto editor = test::makeEditor(sceneOf("stairs", {1280, 720}));
    editor->workspace().covered = panelsOf({1280, 720});
    test::pass(*editor, 1);
    const render::Camera wide = editor->workspace().camera;
    test::send(*editor, windowResized({700, 720}));
    editor->workspace().covered = panelsOf({700, 720});
    test::pass(*editor, 1);
    CHECK(editor->workspace().camera.distance > wide.distance * 1.1F);
    CHECK(seesAll(*editor));
    test::send(*editor, wheelTurned(2));
    const render::Camera own = editor->workspace().camera;
    test::send(*editor, windowResized({1280, 720}));
    editor->workspace().covered = {};
    test::pass(*editor, 2);
    CHECK(editor->workspace().camera.distance == own.distance);
    CHECK(editor->workspace().camera.target == own.target);
}

TEST_CASE("F frames what is selected, and all of the scene when nothing is") {
    const auto editor = test::makeEditor(sceneOf("throw", {1280, 720}));
    const float all = editor->workspace().camera.distance;
    test::click(*editor, test::seenAt(*editor, Role::head));
    test::send(*editor, keyPressed(Key::f));
    CHECK(editor->workspace().camera.distance < all * 0.6F);
    test::send(*editor, keyPressed(Key::escape));
    test::send(*editor, keyPressed(Key::f));
    CHECK(editor->workspace().camera.distance == Approx(all).margin(0.01));
    CHECK(seesAll(*editor));
}

TEST_CASE(
    "a doll that has left the picture comes into it when it is followed, and one that is seen stays where it is") {
    const auto editor = test::makeEditor(sceneOf("drop", {1280, 720}));
    editor->workspace().covered = panelsOf({1280, 720});
    test::pass(*editor, 1);
    const vec3 target = editor->workspace().camera.target;
    test::send(*editor, keyPressed(Key::f, {true, false, false}));
    CHECK(editor->workspace().camera.target == target);
    test::send(*editor, keyPressed(Key::f, {true, false, false}));
    test::click(*editor, test::seenAt(*editor, Role::head));
    test::send(*editor, keyPressed(Key::f));
    test::send(*editor, keyPressed(Key::escape));
    editor->player().setPlaying(true);
    test::pass(*editor, 120);
    test::send(*editor, keyPressed(Key::f, {true, false, false}));
    test::pass(*editor, 10);
    const vec2 hips = test::seenAt(*editor, Role::hips);
    CHECK((hips.x > 310.0F && hips.x < 936.0F && hips.y > 70.0F && hips.y < 692.0F));
}
