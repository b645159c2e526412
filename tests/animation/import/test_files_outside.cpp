// A model's pictures, buffers and material files come from its folder and below only.

#include <sys/inotify.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <memory>

#include "animation/import/assimp/confined_files.hpp"
#include "animation/import/checks.hpp"
#include "animation/import/gltf_file.hpp"
#include "animation/import/model_folder.hpp"
#include "animation/import/texture_loader.hpp"
#include "support/catch.hpp"

using namespace lutka;
using namespace lutka::animation;
using namespace lutka::test;

namespace fs = std::filesystem;

namespace {

using Place = rig_import::ModelFolder::Place;

ImportOptions withOutside() {
    ImportOptions options;
    options.allowOutside = true;
    return options;
}

void savePicture(const fs::path& file) {
    std::ofstream(file, std::ios::binary) << "P6 1 1 255\n" << std::string("\xff\0\0", 3);
}

// secret.ppm, secret.mtl and secret.bin in a folder above the model's, and links to them in the model's.
struct Layout {
    Layout() {
        fs::create_directories(folder / "model/below");
        fs::create_directories(folder / "away");
        savePicture(folder / "secret.ppm");
        savePicture(folder / "away/hidden.ppm");
        savePicture(folder / "model/below/near.ppm");
        fs::create_symlink(folder / "secret.ppm", folder / "model/link.ppm");
        fs::create_directory_symlink(folder / "away", folder / "model/textures");
        fs::create_symlink("below/near.ppm", folder / "model/near_link.ppm");
    }
    [[nodiscard]] std::string absolute() const { return fs::absolute(folder / "secret.ppm").string(); }
    [[nodiscard]] std::vector<std::string> waysOut() const {
        return {"../secret.ppm", "..\\secret.ppm", "%2e%2e/secret.ppm",   "below/../../secret.ppm",
                absolute(),      "link.ppm",       "textures/hidden.ppm", "Textures/HIDDEN.ppm"};
    }
    TemporaryFolder folder;
};

// Counts how often files and folders are opened, by whomever.
class OpenWatch {
  public:
    explicit OpenWatch(const std::vector<fs::path>& places) : handle_(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC)) {
        for (const fs::path& place : places)
            REQUIRE(::inotify_add_watch(handle_, place.c_str(), IN_OPEN) >= 0);
    }
    ~OpenWatch() { ::close(handle_); }
    OpenWatch(const OpenWatch&) = delete;
    OpenWatch& operator=(const OpenWatch&) = delete;

    /// Bytes of events since the last call.
    [[nodiscard]] ssize_t count() const {
        alignas(inotify_event) char events[4096];
        return std::max<ssize_t>(::read(handle_, events, sizeof events), 0);
    }

  private:
    int handle_;
};

GltfFile pictured(const std::string& uri) {
    GltfFile file = makePostRig();
    file.json["images"] = {{{"uri", uri}}};
    file.json["textures"] = {{{"source", 0}}};
    file.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    file.json["meshes"][0]["primitives"][0]["material"] = 0;
    return file;
}

void saveObj(const fs::path& file, const std::string& library) {
    std::ofstream(file) << "mtllib " << library
                        << "\nusemtl skin\nv 0 0 0\nv 1 0 0\nv 0 1.7 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n";
}

}  // namespace

TEST_CASE("a model's folder admits what lies in it and below, wherever links lead") {
    const Layout layout;
    const rig_import::ModelFolder folder(layout.folder / "model/rig.glb", false);
    for (const std::string& way : layout.waysOut()) {
        INFO(way);
        if (way[0] != '%') CHECK(folder.find(way).place == Place::outside);
    }
    for (const char* inside : {"below/near.ppm", "below\\near.ppm", "near_link.ppm", "below/../below/near.ppm",
                               "Below/NEAR.ppm", "./BELOW\\Near.PPM"}) {
        INFO(inside);
        CHECK(folder.find(inside).place == Place::inside);
    }
    for (const char* none : {"nothing.ppm", "Below/nothing.ppm", "BELOW", "below", "C:\\art\\skin.ppm", ""}) {
        INFO(none);
        CHECK(folder.find(none).place == Place::missing);
    }
    REQUIRE(::mkfifo((layout.folder / "model/pipe.ppm").c_str(), 0600) == 0);
    CHECK(folder.find("pipe.ppm").place == Place::missing);
    const rig_import::ModelFolder open(layout.folder / "model/rig.glb", true);
    CHECK(open.find("../secret.ppm").place == Place::inside);
    CHECK(open.find("../model").place == Place::missing);
}

TEST_CASE("names in other case are sought in a folder once, and not among more than ten thousand") {
    const TemporaryFolder files;
    fs::create_directories(files / "many");
    fs::create_directories(files / "few");
    savePicture(files / "few/skin.ppm");
    savePicture(files / "few/HAIR.ppm");
    savePicture(files / "few/hair.ppm");
    const OpenWatch watch({files / "few"});
    const rig_import::ModelFolder few(files / "few/rig.glb", false);
    CHECK(few.find("SKIN.ppm").file.filename() == "skin.ppm");
    CHECK(watch.count() > 0);
    CHECK(few.find("Hair.ppm").file.filename() == "HAIR.ppm");  // the first, be the folder's order what it may
    CHECK(few.find("no.ppm").place == Place::missing);
    CHECK(watch.count() == 0);

    savePicture(files / "many/skin.ppm");
    const auto isFound = [&] {
        return rig_import::ModelFolder(files / "many/rig.glb", false).find("Skin.ppm").place == Place::inside;
    };
    CHECK(isFound());
    for (int i = 0; i < 10'000; ++i)
        std::ofstream(files / ("many/" + std::to_string(i)));
    CHECK_FALSE(isFound());
    CHECK(rig_import::ModelFolder(files / "many/rig.glb", false).find("skin.ppm").place == Place::inside);
}

TEST_CASE("pictures are sought around a model in a listing made once, and not among more than ten thousand") {
    const TemporaryFolder files;
    fs::create_directories(files / "few/textures");
    savePicture(files / "few/textures/skin.ppm");
    const auto loaderFor = [&](const std::string& model) {
        const auto nothing = [](const std::string&, rig_import::PictureDecoder&) { return std::nullopt; };
        return rig_import::TextureLoader(nothing, rig_import::ModelFolder(files / model, false), true);
    };
    const OpenWatch watch({files / "few", files / "few/textures"});
    rig_import::TextureLoader few = loaderFor("few/rig.fbx");
    CHECK(few.load("C:\\art\\SKIN.ppm") == 0);
    CHECK(watch.count() > 0);
    CHECK(few.load("D:\\art\\hair.ppm") == Material::kNoTexture);
    CHECK(few.load("shoes.ppm") == Material::kNoTexture);
    CHECK(watch.count() == 0);

    fs::create_directories(files / "many");
    savePicture(files / "many/skin.ppm");
    for (int i = 0; i < 10'000; ++i)
        std::ofstream(files / ("many/" + std::to_string(i)));
    rig_import::TextureLoader many = loaderFor("many/rig.fbx");
    CHECK(many.load("C:\\art\\Skin.ppm") == Material::kNoTexture);
    CHECK(many.load("C:\\art\\skin.ppm") == 0);
    CHECK(many.load("C:\\art\\skin.tga") == Material::kNoTexture);
}

TEST_CASE("a picture outside of the model's folder is left out with one warning, and taken where that is allowed") {
    const Layout layout;
    for (const std::string& way : layout.waysOut()) {
        INFO(way);
        pictured(way).saveText(layout.folder / "model/rig.gltf");
        const Character character = imported(layout.folder / "model/rig.gltf");
        CHECK(character.textures.empty());
        REQUIRE(character.warnings.size() == 1);
        CHECK_THAT(character.warnings[0], Catch::Contains("outside of the model's folder"));
        CHECK_THAT(character.warnings[0], Catch::Contains("--allow-outside"));
        const Character trusting = imported(layout.folder / "model/rig.gltf", withOutside());
        CHECK(trusting.textures.size() == 1);
        CHECK(trusting.warnings.empty());
    }
    pictured("near_link.ppm").saveText(layout.folder / "model/rig.gltf");
    CHECK(imported(layout.folder / "model/rig.gltf").textures.size() == 1);
}

TEST_CASE("a folder of pictures above the model's is looked into only where that is allowed, and told") {
    const TemporaryFolder folder;
    fs::create_directories(folder / "textures");
    fs::create_directories(folder / "source");
    savePicture(folder / "textures/skin.ppm");
    pictured("skin.ppm").saveText(folder / "source/rig.gltf");
    const Character character = imported(folder / "source/rig.gltf");
    CHECK(character.textures.empty());
    CHECK(warns(character, "../textures"));
    CHECK(imported(folder / "source/rig.gltf", withOutside()).textures.size() == 1);
}

TEST_CASE("a material library outside of the model's folder is not read by Assimp either") {
    const Layout layout;
    std::ofstream(layout.folder / "secret.mtl") << "newmtl skin\nKd 0.25 0.5 0.75\n";
    fs::create_symlink(layout.folder / "secret.mtl", layout.folder / "model/link.mtl");
    const auto green = [](const Character& character) {
        return character.materials.at(static_cast<std::size_t>(character.meshes.at(0).material)).baseColor.g;
    };
    for (const char* way : {"../secret.mtl", "below/../../secret.mtl", "link.mtl"}) {
        INFO(way);
        saveObj(layout.folder / "model/post.obj", way);
        const Character character = imported(layout.folder / "model/post.obj");
        CHECK(green(character) != Approx(0.2140).epsilon(1e-3));
        CHECK(warns(character, "outside"));
        CHECK(green(imported(layout.folder / "model/post.obj", withOutside())) == Approx(0.2140).epsilon(1e-3));
    }
}

TEST_CASE("nothing outside of the model's folder is opened") {
    const Layout layout;
    std::ofstream(layout.folder / "secret.mtl") << "newmtl skin\n";
    const OpenWatch watch({layout.folder / "secret.ppm", layout.folder / "secret.mtl", layout.folder / "away",
                           layout.folder / "away/hidden.ppm"});
    savePicture(layout.folder / "away/hidden.ppm");
    CHECK(watch.count() > 0);  // it sees what is opened
    std::vector<std::string> ways = layout.waysOut();
    ways.emplace_back("../secret.mtl");
    for (const std::string& way : ways) {
        INFO(way);
        pictured(way).saveText(layout.folder / "model/rig.gltf");
        saveObj(layout.folder / "model/post.obj", way);
        static_cast<void>(importCharacter(layout.folder / "model/rig.gltf"));
        static_cast<void>(importCharacter(layout.folder / "model/post.obj"));
        CHECK(watch.count() == 0);
    }
}

TEST_CASE("a model larger than the limit is refused before it is read") {
    const TemporaryFolder folder;
    std::ofstream(folder / "huge.glb") << "glTF";
    fs::resize_file(folder / "huge.glb", (std::uintmax_t{1} << 30U) + 1);  // sparse
    const Result<Character> huge = importCharacter(folder / "huge.glb");
    REQUIRE_FALSE(huge.ok());
    CHECK(huge.error().message == "is larger than 1024 MiB");
}

TEST_CASE("JSON that is nested without end is refused by name of the limit") {
    const TemporaryFolder folder;
    const std::string deep(100000, '[');
    std::ofstream(folder / "deep.gltf") << R"({"asset": {"version": "2.0"}, "extras": )" << deep;
    const Result<Character> nested = importCharacter(folder / "deep.gltf");
    REQUIRE_FALSE(nested.ok());
    CHECK_THAT(nested.error().message, Catch::Contains("nested deeper than 256"));
    GltfFile file = makePostRig();
    file.json["extras"] = {{"text", std::string(1000, '{') + "\\\"" + std::string(1000, '[')}};
    file.saveText(folder / "text.gltf");
    CHECK(importCharacter(folder / "text.gltf").ok());
}

TEST_CASE("a bare name that a reader tries first is not told as a file outside of the model's folder") {
    const TemporaryFolder folder;
    std::ofstream(folder / "fish.mesh") << "x";
    const auto leftOut = std::make_shared<rig_import::LeftOut>();
    const std::filesystem::path model = folder / "fish.mesh";
    const rig_import::ConfinedFiles files(model, rig_import::ModelFolder(model, false), leftOut);
    CHECK_FALSE(files.Exists("fish.skeleton"));
    CHECK_FALSE(files.Exists("Examples/Fish.material"));
    CHECK(leftOut->outside.empty());
    CHECK_FALSE(files.Exists("../fish.skeleton"));
    CHECK_FALSE(files.Exists("/etc/hostname"));
    CHECK(leftOut->outside.size() == 2);
}

TEST_CASE("parts of models, and Ogre meshes of other versions, are refused with what to do") {
    const TemporaryFolder folder;
    const auto refusal = [&](const std::string& name, const std::string& bytes) {
        std::ofstream(folder / name, std::ios::binary) << bytes;
        const Result<Character> read = importCharacter(folder / name);
        REQUIRE_FALSE(read.ok());
        CHECK(read.error().code == ErrorCode::input);
        return read.error().text();
    };
    for (const std::string version : {"1.40", "1.41", "1.100"}) {
        const std::string text = refusal("fish.mesh", std::string("\0\x10", 2) + "[MeshSerializer_v" + version + "]\n");
        CHECK(text.find("is an Ogre mesh of version " + version + "; 1.8 is read") != std::string::npos);
        CHECK(text.find("OgreMeshUpgrader -V 1.8") != std::string::npos);
    }
    // A file of textures alone: one of four pixels, and its palette.
    std::string header(244, '\0');
    const auto put = [&](std::size_t place, std::uint32_t value) { std::memcpy(&header[place], &value, 4); };
    header.replace(0, 4, "IDST");
    put(4, 10);
    header.replace(8, 8, "manT.mdl");
    put(72, 244 + 80 + 4 + 768);
    put(180, 1);
    put(184, 244);
    put(188, 244 + 80);
    std::string texture(80, '\0');
    texture.replace(0, 8, "skin.bmp");
    const std::array<std::uint32_t, 4> sizes = {0, 2, 2, 244 + 80};
    std::memcpy(&texture[64], sizes.data(), 16);
    const std::string text = refusal("manT.mdl", header + texture + std::string(4 + 768, '\0'));
    CHECK(text.find("pictures of a Half-Life model without the model") != std::string::npos);
    CHECK(text.find("no T at its end") != std::string::npos);
}
