#include "editor/files/file_watch.hpp"

#include <chrono>
#include <fstream>

#include "editor/files/folder_files.hpp"
#include "editor/files/model_pictures.hpp"
#include "editor/sessions.hpp"
#include "scene/draw/scene_extent.hpp"
#include "support/command.hpp"

using namespace lutka;
using namespace lutka::editor;

namespace {

namespace fs = std::filesystem;

void write(const fs::path& file, const std::string& text, int secondsLater) {
    std::ofstream(file, std::ios::trunc) << text;
    fs::last_write_time(file, fs::last_write_time(file) + std::chrono::seconds(secondsLater));
}

}  // namespace

TEST_CASE("a file that was written is told once, when it has been left alone") {
    const test::ScratchFolder folder;
    const fs::path file = folder.path / "hero.glb";
    write(file, "one", 0);
    FileWatch watch;
    watch.watch(file);
    const auto look = [&] { return watch.changed(FileWatch::kEverySeconds); };
    CHECK_FALSE(look());
    write(file, "other", 10);
    CHECK_FALSE(watch.changed(0.1));
    CHECK_FALSE(look());  // it may still be written
    CHECK(look());
    CHECK_FALSE(look());
    fs::remove(file);
    CHECK_FALSE(look());
    CHECK_FALSE(look());
    write(file, "again", 20);
    CHECK_FALSE(look());
    CHECK(look());
}

TEST_CASE("the next and the previous model of a folder go round") {
    const test::ScratchFolder folder;
    for (const char* name : {"b.glb", "A.fbx", "c.gltf", "notes.txt", "b.ragdoll.json"})
        std::ofstream(folder.path / name) << ' ';
    CHECK(fileBeside(folder.path / "A.fbx", 1).filename() == "b.glb");
    CHECK(fileBeside(folder.path / "c.gltf", 1).filename() == "A.fbx");
    CHECK(fileBeside(folder.path / "A.fbx", -1).filename() == "c.gltf");
    fs::remove(folder.path / "A.fbx");
    fs::remove(folder.path / "b.glb");
    CHECK(fileBeside(folder.path / "c.gltf", 1).empty());
}

TEST_CASE("a file that can't be read does not end the way through a folder") {
    const test::ScratchFolder folder;
    for (const char* name : {"a.glb", "c.glb"})
        fs::copy_file(LUTKA_ASSETS_DIR "/models/mannequin.glb", folder.path / name);
    write(folder.path / "b.glb", "half a file", 0);
    EditorOptions options;
    options.model = folder.path / "a.glb";
    auto made = Editor::create(options);
    REQUIRE(made.ok());
    Editor& editor = *made.value();
    const auto name = [&] { return editor.document().character().file.filename(); };
    editor.perform(Action::nextFile);
    CHECK(name() == "a.glb");
    CHECK(editor.workspace().toasts.back().kind == Toast::Kind::error);
    editor.perform(Action::nextFile);
    CHECK(name() == "c.glb");
    editor.perform(Action::previousFile);
    CHECK(name() == "c.glb");
    editor.perform(Action::previousFile);
    CHECK(name() == "a.glb");
    editor.perform(Action::previousFile);
    CHECK(name() == "c.glb");
}

TEST_CASE("a model that another program has written is read again, with the user's edits") {
    const test::ScratchFolder folder;
    const fs::path model = folder.path / "hero.glb";
    fs::copy_file(LUTKA_ASSETS_DIR "/models/mannequin.glb", model);
    EditorOptions options;
    options.model = model;
    options.playing = false;
    auto made = Editor::create(options);
    REQUIRE(made.ok());
    Editor& editor = *made.value();
    const int head = physics::bodyOf(editor.document().profile(), animation::Role::head);
    physics::BodyShape shape = editor.document().profile().bodies[head].shape;
    shape.radius *= 1.25F;
    REQUIRE(editor.edit([&](EditorDocument& document) { return document.setShape(head, shape); }));
    const int hand = physics::bodyOf(editor.document().profile(), animation::Role::leftHand);
    editor.select(Item{Item::Kind::body, 0, hand});
    editor.select(Item{Item::Kind::body, 0, head}, true);
    const int revision = editor.characterRevision();
    const render::Camera seen = editor.workspace().camera;
    fs::last_write_time(model, fs::last_write_time(model) + std::chrono::seconds(10));
    for (int i = 0; i < 4; ++i)
        editor.update(FileWatch::kEverySeconds);
    CHECK(editor.characterRevision() == revision + 1);
    CHECK(editor.document().profile().bodies[head].shape.radius == Approx(shape.radius));
    CHECK(editor.document().unsaved());
    CHECK(editor.workspace().camera.distance == Approx(seen.distance));
    CHECK(editor.workspace().selectedBodies() == std::vector<int>{hand, head});
    CHECK(editor.state() == State::selected);
    // A file that can't be read leaves everything as it is.
    write(model, "half a file", 20);
    for (int i = 0; i < 4; ++i)
        editor.update(FileWatch::kEverySeconds);
    CHECK(editor.characterRevision() == revision + 1);
    CHECK(editor.workspace().toasts.back().kind == Toast::Kind::error);
}

TEST_CASE("the small picture of a model shows all of its figure, and more of the view beside it") {
    render::Image view({200, 100}, {10, 20, 30, 255});
    for (int y = 0; y < 40; ++y) {
        for (int x = 100; x < 120; ++x)
            view.set(x, y, {200, 100, 50, 255});
    }
    const render::Image picture = smallPicture(view, {0.5F, 0.4F, 0.0F, 0.6F}, {16, 10});
    CHECK(picture.width == 16);
    CHECK(picture.at(8, 0).r == 200);
    CHECK(picture.at(8, 9).r == 200);
    CHECK(picture.at(0, 5).r == 10);
    CHECK(picture.at(15, 5).r == 10);
    // A part at the edge, and one that is the whole view.
    CHECK(smallPicture(view, {0.0F, 0.9F, 0.0F, 0.0F}, {16, 10}).at(0, 0).r == 10);
    CHECK(smallPicture(view, {}, {10, 20}).at(5, 5).r == 200);

    const auto editor = test::makeEditor();
    std::vector<vec3> figure;
    scene::addExtentOfDoll(editor->player().simulation(), 0, 1.0F, figure);
    const Workspace& seen = editor->workspace();
    const render::PictureInsets around = insetsAround(figure, seen.camera, seen.window);
    for (const vec3& point : figure) {
        const auto at = render::project(seen.camera, point, seen.window);
        REQUIRE(at.has_value());
        CHECK(at->x > around.left * static_cast<float>(seen.window.width));
        CHECK(at->y > around.top * static_cast<float>(seen.window.height));
        CHECK(at->y < (1.0F - around.bottom) * static_cast<float>(seen.window.height));
    }
    const fs::path folder("pictures");
    CHECK(modelPictureFile(folder, "/a/hero.glb") != modelPictureFile(folder, "/b/hero.glb"));
    CHECK(modelPictureFile(folder, "/a/hero.glb") == modelPictureFile(folder, "/a/x/../hero.glb"));
}
