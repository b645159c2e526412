// Frames of clips: which rate has all keys. Scale in clips, which rigid joints can't have: it is told wherever it
// shows, however it comes about.

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "animation/import/checks.hpp"
#include "animation/import/gltf_file.hpp"
#include "animation/pose.hpp"
#include "support/catch.hpp"

using namespace lutka;
using namespace lutka::animation;
using namespace lutka::test;

namespace {

constexpr int kLow = 1;  // nodes of the post's rig
constexpr int kMiddle = 2;
constexpr int kHigh = 3;

// A clip "swell" that scales a joint, which loses its matrix for it.
GltfFile rigScaledBy(const std::vector<float>& keys, const std::string& interpolation, int node = kHigh) {
    GltfFile file = makePostRig();
    file.json["nodes"][node].erase("matrix");
    file.json["nodes"][node]["translation"] = {0, node == kLow ? 0.0 : 0.6, 0};
    const std::vector<float> times = {0.0F, 1.0F};
    file.json["animations"] = {{{"name", "swell"},
                                {"samplers",
                                 {{{"input", file.addFloats(times, "SCALAR")},
                                   {"output", file.addFloats(keys, "VEC3")},
                                   {"interpolation", interpolation}}}},
                                {"channels", {{{"sampler", 0}, {"target", {{"node", node}, {"path", "scale"}}}}}}}};
    return file;
}

Character sampledRig(const GltfFile& file) {
    const TemporaryFolder folder;
    file.saveText(folder / "rig.gltf");
    Character character = imported(folder / "rig.gltf");
    checkInvariants(character);
    REQUIRE(character.clips.size() == 1);
    return character;
}

}  // namespace

TEST_CASE("a clip whose keys are far apart, at no common distance, ends on its last key") {
    struct Keys {
        std::vector<float> times;
        float rate;
        int frames;
    };
    const float half = std::sqrt(0.5F);
    for (const auto& [times, rate, frames] :
         {Keys{{0, 31 / 24.0F, 90 / 24.0F}, 48.0F, 181}, Keys{{0, 0.4F, 1.1F}, 30.0F, 34},
          Keys{{0, 0.613F, 1.717F}, 53 / 1.717F, 54}}) {
        GltfFile file = makePostRig();
        file.json["nodes"][kMiddle].erase("matrix");
        file.json["nodes"][kMiddle]["translation"] = {0, 0.3, 0};
        const std::vector<float> turns = {0, 0, 0, 1, 0, 0, half, half, half, 0, 0, half};
        file.addTurn("turn", kMiddle, times, file.addFloats(turns, "VEC4"), "LINEAR");
        const Character character = sampledRig(file);
        const Clip& clip = character.clips[0];
        INFO("keys to " << times.back());
        CHECK(clip.framesPerSecond == Approx(rate));
        CHECK(clip.frameCount == frames);
        CHECK(static_cast<float>(clip.frameCount - 1) / clip.framesPerSecond == Approx(times.back()));
        const auto joints = static_cast<std::size_t>(character.skeleton.jointCount());
        const std::size_t last = joints * static_cast<std::size_t>(clip.frameCount - 1);
        const int turned = findJoint(character.skeleton, file.json["nodes"][kMiddle]["name"].get<std::string>());
        REQUIRE(turned != kNoJoint);
        const quat end = clip.parentFromJoint[last + static_cast<std::size_t>(turned)].rotation;
        CHECK(std::abs(glm::dot(end, quat(half, half, 0, 0))) == Approx(1.0F).margin(1e-6));
    }
}

TEST_CASE("scale in a clip is dropped with its figure") {
    const Character character = sampledRig(rigScaledBy({1, 1, 1, 1.5F, 1.5F, 1.5F}, "LINEAR"));
    CHECK(warns(character, "'swell' scales joints by up to 50 %"));
}

TEST_CASE("a clip that keys the scale that its joints have is told nothing of") {
    CHECK(sampledRig(rigScaledBy({1, 1, 1, 1, 1, 1.00001F}, "LINEAR")).warnings.empty());
}

TEST_CASE("a scale that keys hold and tangents do not is dropped with its figure") {
    const std::vector<float> swelling = {0, 0, 0, 1, 1, 1, 4, 4, 4, -4, -4, -4, 1, 1, 1, 0, 0, 0};
    CHECK(warns(sampledRig(rigScaledBy(swelling, "CUBICSPLINE")), "'swell' scales joints by up to 100 %"));
}

TEST_CASE("a clip of another size than its figure is brought to it, a part that shrinks in one is not") {
    const std::vector<float> half(6, 0.5F);
    const auto topOf = [](const Character& character) {
        const Clip& clip = character.clips[0];
        const auto joints = static_cast<std::size_t>(character.skeleton.jointCount());
        std::vector<RigidTransform> modelFromJoint(joints);
        localToModel(character.skeleton, std::span(clip.parentFromJoint).first(joints), modelFromJoint);
        return modelFromJoint[static_cast<std::size_t>(findJoint(character.skeleton, "high"))].translation.y;
    };
    const auto bindOf = [](const Character& character, const char* name) {
        const int joint = findJoint(character.skeleton, name);
        return character.skeleton.bindModelFromJoint[static_cast<std::size_t>(joint)].translation.y;
    };
    const Character whole = sampledRig(rigScaledBy(half, "LINEAR", kLow));
    const float bindTop = bindOf(whole, "high");
    CHECK(warns(whole, "'swell' is 0.5 times the size of the bind pose"));
    CHECK(topOf(whole) == Approx(bindTop));
    const Character part = sampledRig(rigScaledBy(half, "LINEAR", kMiddle));
    const float middle = bindOf(part, "middle");
    CHECK(warns(part, "'swell' scales joints by up to 50 %"));
    CHECK_FALSE(warns(part, "times the size of the bind pose"));
    CHECK(topOf(part) == Approx(middle + 0.5F * (bindTop - middle)));
}

TEST_CASE("a joint that turns below an uneven scale shears, which is dropped with its figure") {
    GltfFile file = makePostRig(glm::scale(mat4(1.0F), vec3(1, 2, 1)));
    const float half = std::sqrt(0.5F);
    const std::vector<float> times = {0.0F, 1.0F};
    const std::vector<float> turn = {0, 0, 0, 1, half, 0, 0, half};
    file.json["nodes"][kMiddle].erase("matrix");
    file.json["nodes"][kMiddle]["translation"] = {0, 0.3, 0};
    file.addTurn("turn", kMiddle, times, file.addFloats(turn, "VEC4"), "LINEAR");
    CHECK(warns(sampledRig(file), "'turn' scales joints by up to 100 %"));
}
