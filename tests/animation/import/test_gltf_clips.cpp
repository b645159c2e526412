// Animations of a glTF that break its rules in ways that exporters do.

#include <array>
#include <glm/gtc/quaternion.hpp>
#include <string>

#include "animation/import/checks.hpp"
#include "animation/import/gltf_file.hpp"
#include "support/catch.hpp"

using namespace lutka;
using namespace lutka::animation;
using namespace lutka::test;

namespace {

// A post whose middle joint turns about Z by two keys.
GltfFile turning(float degrees, const std::string& interpolation = "LINEAR") {
    GltfFile file = makePostRig();
    const float half = 0.5F * degrees * 0.01745329F;
    const std::array<float, 2> times = {0, 1};
    const std::array<float, 8> turns = {0, 0, 0, 1, 0, 0, std::sin(half), std::cos(half)};
    int node = -1;
    for (std::size_t i = 0; i < file.json["nodes"].size(); ++i) {
        if (file.json["nodes"][i]["name"] == "middle") node = static_cast<int>(i);
    }
    file.addTurn("turn", node, times, file.addFloats(turns, "VEC4"), interpolation);
    return file;
}

float turnAtEnd(const Character& character) {
    std::vector<RigidTransform> pose(character.skeleton.parents.size());
    sampleClip(character.clips.at(0), 1.0F, pose);
    const quat& turn = pose[static_cast<std::size_t>(findJoint(character.skeleton, "middle"))].rotation;
    return 2.0F * std::atan2(turn.z, turn.w) * 57.29578F;
}

}  // namespace

TEST_CASE("two channels of one glTF animation on the same part of a node are told, and the last plays") {
    const TemporaryFolder folder;
    GltfFile file = turning(30);
    const GltfFile other = turning(60);
    file.json["animations"][0]["channels"].push_back(file.json["animations"][0]["channels"][0]);
    file.saveText(folder / "same.gltf");
    CHECK(warns(imported(folder / "same.gltf"), "move the same part of a node all but the last"));
    // The second's sampler is another: a turn by 60 degrees.
    const std::array<float, 8> turns = {0, 0, 0, 1, 0, 0, 0.5F, 0.8660254F};
    nlohmann::json& animation = file.json["animations"][0];
    animation["samplers"].push_back(animation["samplers"][0]);
    animation["samplers"][1]["output"] = file.addFloats(turns, "VEC4");
    file.json["animations"][0]["channels"][1]["sampler"] = 1;
    file.saveText(folder / "two.gltf");
    const Character character = imported(folder / "two.gltf");
    checkInvariants(character);
    CHECK(warns(character, "move the same part of a node all but the last"));
    CHECK(turnAtEnd(character) == Approx(60).margin(0.1));
    other.saveText(folder / "one.gltf");
    CHECK(imported(folder / "one.gltf").warnings.empty());
}

TEST_CASE("glTF channels without a sampler, unknown interpolations and values without keys are told") {
    const TemporaryFolder folder;
    GltfFile file = turning(30, "BEZIER");
    file.saveText(folder / "bezier.gltf");
    CHECK(warns(imported(folder / "bezier.gltf"), "interpolations of animations that glTF does not know"));
    file = turning(30);
    file.json["animations"][0]["channels"].push_back(file.json["animations"][0]["channels"][0]);
    file.json["animations"][0]["channels"][0].erase("sampler");
    file.saveText(folder / "samplerless.gltf");
    const Character samplerless = imported(folder / "samplerless.gltf");
    CHECK(warns(samplerless, "channels of animations without a sampler"));
    CHECK(turnAtEnd(samplerless) == Approx(30).margin(0.1));
    file = turning(30);
    const std::array<float, 1> time = {0};
    file.json["animations"][0]["samplers"][0]["input"] = file.addFloats(time, "SCALAR");
    file.saveText(folder / "values.gltf");
    CHECK(warns(imported(folder / "values.gltf"), "values of animations beyond their last key"));
}

TEST_CASE("glTF keys in another order than that of their times are sorted, with a word") {
    const TemporaryFolder folder;
    GltfFile file = turning(30);
    const std::array<float, 3> times = {0, 1, 0.5F};
    const std::array<float, 12> turns = {0, 0, 0, 1, 0, 0, 0.5F, 0.8660254F, 0, 0, 0, 1};
    nlohmann::json& sampler = file.json["animations"][0]["samplers"][0];
    sampler["input"] = file.addFloats(times, "SCALAR");
    sampler["output"] = file.addFloats(turns, "VEC4");
    file.saveText(folder / "unsorted.gltf");
    const Character character = imported(folder / "unsorted.gltf");
    CHECK(turnAtEnd(character) == Approx(60).margin(0.1));
    CHECK(warns(character, "were sorted: animation 'turn'"));
}

TEST_CASE("what a glTF's nodes and meshes lack is told, and what names nothing is refused with its place") {
    const TemporaryFolder folder;
    const auto told = [&](const GltfFile& file) {
        file.saveText(folder / "rig.gltf");
        const Result<Character> read = importCharacter(folder / "rig.gltf");
        if (!read.ok()) return read.error().text();
        std::string all;
        for (const std::string& warning : read.value().warnings)
            all += warning;
        return all;
    };
    const auto holds = [](const std::string& text, const std::string& part) {
        INFO(text);
        CHECK(text.find(part) != std::string::npos);
    };
    const GltfFile whole = makePostRig();
    CHECK(told(whole).empty());
    GltfFile file = whole;
    const auto primitive = [&]() -> nlohmann::json& { return file.json["meshes"][0]["primitives"][0]; };
    const auto fresh = [&] { file = whole; };
    primitive()["attributes"].erase("WEIGHTS_0");
    holds(told(file), "left out: the skin of mesh");
    fresh();
    primitive()["mode"] = 9;
    holds(told(file), "meshes of a mode that glTF does not know");
    fresh();
    primitive()["attributes"].erase("POSITION");
    holds(told(file), "meshes without positions");
    fresh();
    file.json["nodes"][1]["rotation"] = {0, 0, 0, 0};
    file.json["nodes"][1].erase("matrix");
    holds(told(file), "the rotation of nodes that have four zeros there");
    fresh();
    file.json["nodes"][1]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    file.json["nodes"][1]["scale"] = {1, 1, 1};
    holds(told(file), "translation, rotation and scale of nodes that have a matrix, too");
    fresh();
    const std::array<std::uint16_t, 4> corners = {0, 1, 2, 3};
    primitive()["indices"] = file.addIndices(corners);
    holds(told(file), "corners beyond the last triangle");
    fresh();
    file.json["skins"][0]["joints"][1] = 77;
    holds(told(file), "skins[0]: ");
    fresh();
    primitive()["material"] = 8;
    holds(told(file), "meshes[0]: \"material\" names number 8");
    fresh();
    file.json["nodes"][1]["children"] = {55};
    holds(told(file), "nodes[1]: ");
    fresh();
    for (nlohmann::json& node : file.json["nodes"]) {
        if (node.contains("skin")) node["skin"] = 5;
    }
    holds(told(file), "\"skin\" names number 5");
    file = turning(30);
    file.json["animations"][0]["samplers"][0]["output"] = 99;
    holds(told(file), "animations[0]: \"output\" names number 99");
}
