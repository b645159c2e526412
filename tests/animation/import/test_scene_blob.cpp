#include <random>

#include "animation/import/build_character.hpp"
#include "animation/import/scene_blob.hpp"
#include "animation/import/source_limits.hpp"
#include "support/catch.hpp"

using namespace lutka;
using namespace lutka::animation;
using namespace lutka::animation::rig_import;

namespace {

// A scene in which no member has the value that it starts with.
SourceScene everything() {
    SourceScene scene;
    scene.format = "glTF 2.0";
    scene.nodes = {{"root", -1, glm::dmat4(2.0), false}, {"arm", 0, glm::dmat4(3.0), true}};
    SourceMesh mesh;
    mesh.name = "skin";
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.normals.assign(3, {0, 0, 1});
    mesh.tangents.assign(3, {1, 0, 0, -1});
    mesh.uvs.assign(3, {0.25F, 0.75F});
    mesh.colors.assign(3, {1, 0, 0, 1});
    mesh.indices = {0, 1, 2};
    mesh.material = 0;
    mesh.influenceStart = {0, 1, 1, 2};
    mesh.influences = {{0, 1.0F}, {0, 0.5F}};
    scene.meshes = {mesh};
    SourceSkin skin;
    skin.joints = {{1, glm::dmat4(4.0)}};
    skin.sceneFromMesh = glm::dmat4(5.0);
    scene.skins = {skin};
    scene.instances = {{0, 1, 0, true}};
    SourceChannel channel;
    channel.node = 1;
    channel.path = SourceChannel::Path::rotation;
    channel.interpolation = SourceChannel::Interpolation::step;
    channel.times = {0.0, 1.0};
    channel.values = {0, 0, 0, 1, 1, 0, 0, 0};
    scene.clips = {{"wave", {channel}}};
    Material material;
    material.name = "cloth";
    material.alphaMode = Material::AlphaMode::mask;
    material.doubleSided = true;
    material.emissiveTexture = 0;
    scene.materials = {material};
    scene.textures = {{"cloth.png", 1, 2, {1, 2, 3, 4, 5, 6, 7, 8}}};
    scene.convention = {0.01, "FBX UnitScaleFactor", UpAxis::positiveZ, "FBX UpAxis"};
    scene.nodesArePosed = false;
    scene.vrmHumanoid = {{"hips", 1}};
    scene.warnings = {"one", "two"};
    return scene;
}

}  // namespace

TEST_CASE("a scene comes back from its blob byte for byte") {
    const std::string bytes = packScene(everything());
    const auto back = unpackScene(bytes, "file.glb");
    REQUIRE(back);
    CHECK(packScene(back.value()) == bytes);
    CHECK(back.value().nodes[1].name == "arm");
    CHECK(back.value().nodes[1].isHelper);
    CHECK(back.value().meshes[0].tangents[2].w == -1.0F);
    CHECK(back.value().skins[0].sceneFromMesh.has_value());
    CHECK(back.value().convention.up == UpAxis::positiveZ);
    CHECK(back.value().clips[0].channels[0].interpolation == SourceChannel::Interpolation::step);
    CHECK(back.value().textures[0].rgba.size() == 8);
    CHECK(back.value().vrmHumanoid.at("hips") == 1);
    CHECK(back.value().warnings.size() == 2);
}

TEST_CASE("an error comes back from its blob") {
    const auto back = unpackScene(packScene(Error{ErrorCode::input, "is empty", "file.glb", "try another"}), "other");
    REQUIRE_FALSE(back);
    CHECK(back.error().text() == "file.glb: is empty (try another)");
}

TEST_CASE("a blob that is cut off anywhere is refused") {
    const std::string bytes = packScene(everything());
    for (std::size_t size = 0; size < bytes.size(); ++size)
        REQUIRE_FALSE(unpackScene(std::string_view(bytes).substr(0, size), "file.glb"));
    CHECK_FALSE(unpackScene(bytes + "x", "file.glb"));
}

TEST_CASE("a blob with any bytes changed gives a sound scene or none") {
    const std::string good = packScene(everything());
    std::mt19937 random(7);
    for (int round = 0; round < 20'000; ++round) {
        std::string bytes = good;
        for (unsigned change = random() % 4 + 1; change > 0; --change)
            bytes[random() % bytes.size()] = static_cast<char>(random() % 3 == 0 ? 0xFF : random());
        const auto back = unpackScene(bytes, "file.glb");
        if (back) CHECK(problemOf(back.value()).empty());
    }
}

TEST_CASE("a scene whose parts do not fit together is refused with what is wrong") {
    const auto problem = [](auto change) {
        SourceScene scene = everything();
        change(scene);
        const auto back = unpackScene(packScene(scene), "file.glb");
        return back ? std::string() : back.error().message;
    };
    CHECK(problem([](SourceScene&) {}).empty());
    CHECK_THAT(problem([](SourceScene& s) { s.nodes[0].parent = 1; }), Catch::Contains("parent"));
    CHECK_THAT(problem([](SourceScene& s) { s.meshes[0].indices[1] = 3; }), Catch::Contains("mesh"));
    CHECK_THAT(problem([](SourceScene& s) { s.meshes[0].influenceStart[1] = 9; }), Catch::Contains("mesh"));
    CHECK_THAT(problem([](SourceScene& s) { s.meshes[0].influences[1].weight = NAN; }), Catch::Contains("mesh"));
    CHECK_THAT(problem([](SourceScene& s) { s.meshes[0].influences[1].slot = 1; }), Catch::Contains("instance"));
    CHECK_THAT(problem([](SourceScene& s) { s.skins[0].joints[0].node = 2; }), Catch::Contains("skin"));
    CHECK_THAT(problem([](SourceScene& s) { s.instances[0].skin = 1; }), Catch::Contains("instance"));
    CHECK_THAT(problem([](SourceScene& s) { s.clips[0].channels[0].times[1] = -1; }), Catch::Contains("clip"));
    CHECK_THAT(problem([](SourceScene& s) { s.clips[0].channels[0].values.pop_back(); }), Catch::Contains("clip"));
    CHECK_THAT(problem([](SourceScene& s) { s.materials[0].normalTexture = 1; }), Catch::Contains("material"));
    CHECK_THAT(problem([](SourceScene& s) { s.textures[0].height = 3; }), Catch::Contains("texture"));
    CHECK_THAT(problem([](SourceScene& s) { s.vrmHumanoid["head"] = 2; }), Catch::Contains("VRM"));
    CHECK_THAT(problem([](SourceScene& s) { s.meshes[0].positions[1].y = INFINITY; }), Catch::Contains("damaged"));
    CHECK_THAT(problem([](SourceScene& s) { s.nodes[1].parentFromNode[3][0] = NAN; }), Catch::Contains("damaged"));
    CHECK_THAT(problem([](SourceScene& s) { s.convention.metresPerUnit = 0.0; }), Catch::Contains("unit"));
}

TEST_CASE("a scene that places more than a character can have is refused by name of what is too much") {
    const auto refusal = [](auto change) {
        SourceScene scene = everything();
        change(scene);
        const auto error = validate(scene, "file.glb");
        return error ? error->message : std::string();
    };
    CHECK(refusal([](SourceScene&) {}).empty());
    // Few of each in the file, very many where it is placed.
    const auto place = [](SourceScene& scene, std::size_t times) {
        const SourceInstance one = scene.instances[0];
        scene.instances.assign(times, one);
    };
    CHECK(refusal([&](SourceScene& s) { place(s, kMaxPlacedMeshes); }).empty());
    CHECK_THAT(refusal([&](SourceScene& s) { place(s, kMaxPlacedMeshes + 1); }),
               Catch::Contains("65535 places of meshes"));
    CHECK_THAT(refusal([&](SourceScene& s) {
                   s.skins[0].joints.resize(1000, s.skins[0].joints[0]);
                   place(s, kMaxPlacedSlots / 1000 + 1);
               }),
               Catch::Contains("4000000 joints of skins"));
    CHECK_THAT(refusal([&](SourceScene& s) {
                   s.meshes[0].indices.assign(3000, 0);
                   place(s, kMaxPlacedIndices / 3000 + 1);
               }),
               Catch::Contains("20000000 triangles"));
    CHECK_THAT(refusal([&](SourceScene& s) {
                   SourceMesh& mesh = s.meshes[0];
                   mesh = {};
                   mesh.positions.resize(1000);
                   s.instances[0].skin = -1;
                   place(s, kMaxVertices / 1000 + 1);
               }),
               Catch::Contains("10000000 vertices"));
}
