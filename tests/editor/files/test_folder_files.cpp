// Which file is opened of those that are dropped.

#include <filesystem>
#include <fstream>

#include "editor/files/file_list.hpp"
#include "editor/files/folder_files.hpp"
#include "support/catch.hpp"
#include "support/command.hpp"

using namespace lutka::editor;
using namespace lutka::test;
namespace fs = std::filesystem;

TEST_CASE("of files that are dropped together the scene is opened, else the model, else the first") {
    using Files = std::vector<std::string>;
    CHECK(fileToOpen(Files{"/a/skin.png", "/a/hero.GLB", "/a/hero.bin"}) == "/a/hero.GLB");
    CHECK(fileToOpen(Files{"/a/hero.glb", "/a/hall.scene.json"}) == "/a/hall.scene.json");
    CHECK(fileToOpen(Files{"/a/hero.ragdoll.json", "/a/hero.fbx"}) == "/a/hero.fbx");
    CHECK(fileToOpen(Files{"/a/hero.ragdoll.json"}) == "/a/hero.ragdoll.json");
    CHECK(fileToOpen(Files{"/a/skin.png", "/a/notes.txt"}) == "/a/skin.png");

    const ScratchFolder folder;
    const fs::path pack = folder.path / "pack";
    fs::create_directories(pack / "textures");
    CHECK(fileToOpen({pack.string()}) == pack);
    for (const char* name : {"readme.txt", "skin.png", "knight.fbx"})
        std::ofstream(pack / name) << "x";
    CHECK(fileToOpen({(pack / "textures").string(), pack.string()}) == pack / "knight.fbx");
}

TEST_CASE("files of one name are told apart by their folders, and others are called by their names alone") {
    const std::vector<fs::path> files = {"/a/knight/m.fbx", "/a/ogre/m.fbx", "/a/hero.glb", "m.fbx"};
    CHECK(nameAmong(files, files[0]) == "knight/m.fbx");
    CHECK(nameAmong(files, files[1]) == "ogre/m.fbx");
    CHECK(nameAmong(files, files[2]) == "hero.glb");
    CHECK(nameAmong(files, files[3]) == "m.fbx");
}
