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
