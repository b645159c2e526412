#include "editor/files/file_watch.hpp"

#include <chrono>
#include <fstream>

#include "editor/files/folder_files.hpp"
#include "editor/files/model_pictures.hpp"
#include "editor/sessions.hpp"
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
    const int revision = editor.characterRevision();
    const render::Camera seen = editor.workspace().camera;
    fs::last_write_time(model, fs::last_write_time(model) + std::chrono::seconds(10));
    for (int i = 0; i < 4; ++i)
        editor.update(FileWatch::kEverySeconds);
    CHECK(editor.characterRevision() == revision + 1);
    CHECK(editor.document().profile().bodies[head].shape.radius == Approx(shape.radius));
    CHECK(editor.document().unsaved());
    CHECK(editor.workspace().camera.distance == Approx(seen.distance));
    // A file that can't be read leaves everything as it is.
    write(model, "half a file", 20);
    for (int i = 0; i < 4; ++i)
        editor.update(FileWatch::kEverySeconds);
    CHECK(editor.characterRevision() == revision + 1);
    CHECK(editor.workspace().toasts.back().kind == Toast::Kind::error);
}

TEST_CASE("the small picture of a model is the middle of the free view") {
    render::Image view({200, 100}, {10, 20, 30, 255});
    for (int y = 0; y < 100; ++y) {
        for (int x = 100; x < 200; ++x)
            view.set(x, y, {200, 100, 50, 255});
    }
    const render::Image picture = smallPicture(view, {0.5F, 0.0F, 0.0F, 0.0F}, {16, 10});
    CHECK(picture.width == 16);
    CHECK(picture.at(8, 5).r == 200);
    CHECK(picture.at(0, 0).g == 100);
    const fs::path folder("pictures");
    CHECK(modelPictureFile(folder, "/a/hero.glb") != modelPictureFile(folder, "/b/hero.glb"));
    CHECK(modelPictureFile(folder, "/a/hero.glb") == modelPictureFile(folder, "/a/x/../hero.glb"));
}
