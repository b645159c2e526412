#include <string>
#include <vector>

#include "animation/humanoid/map_humanoid.hpp"
#include "support/catch.hpp"
#include "support/rigs.hpp"

// Birds that stand like a man: their names alone tell.
namespace lutka::test {
namespace {

// A bird that stands like a man, its wings side by side on shoulders.
animation::Character sparrow() {
    std::vector<JointSpec> joints{{"root", -1, {0, 0.09F, 0.02F}}};
    std::vector<TubeSpec> skin;
    const auto add = [&](const std::string& name, int parent, const vec3& place, const vec3& end, float radius) {
        joints.push_back({name, parent, place});
        const int joint = static_cast<int>(joints.size()) - 1;
        skin.push_back({joint, end, radius});
        return joint;
    };
    const int stomach = add("stomach", 0, {0, 0.11F, 0.11F}, {0, 0.22F, 0.18F}, 0.12F);
    const int chest = add("chest", stomach, {0, 0.25F, 0.2F}, {0, 0.36F, 0.2F}, 0.12F);
    add("head", chest, {0, 0.42F, 0.19F}, {0, 0.6F, 0.19F}, 0.15F);
    add("tail", 0, {0, 0.09F, 0.02F}, {0, 0.05F, -0.2F}, 0.06F);
    for (const float x : {1.0F, -1.0F}) {
        const std::string side = x > 0.0F ? ".l" : ".r";
        const auto addAt = [&](const char* name, int parent, const vec3& place, const vec3& end, float radius) {
            return add(name + side, parent, place * vec3(x, 1, 1), end * vec3(x, 1, 1), radius);
        };
        const int shoulder = addAt("shoulder", 0, {0.07F, 0.32F, 0.08F}, {0.12F, 0.32F, 0.08F}, 0.05F);
        addAt("upperwing", shoulder, {0.13F, 0.32F, 0.08F}, {0.4F, 0.31F, 0.08F}, 0.05F);
        addAt("wing", shoulder, {0.43F, 0.31F, 0.08F}, {0.7F, 0.28F, 0.06F}, 0.04F);
        const int hip = addAt("hip", 0, {0, 0.1F, 0.09F}, {0.04F, 0.08F, 0.08F}, 0.05F);
        const int thigh = addAt("thigh", hip, {0.053F, 0.07F, 0.075F}, {0.053F, -0.05F, 0.04F}, 0.03F);
        const int shin = addAt("leg", thigh, {0.053F, -0.06F, 0.036F}, {0.053F, -0.18F, 0.03F}, 0.02F);
        addAt("frontoes", shin, {0.053F, -0.19F, 0.03F}, {0.053F, -0.2F, 0.12F}, 0.02F);
    }
    return makeFigure("sparrow", joints, skin);
}

// A hen whose wings are called arms, with a tail behind.
animation::Character hen() {
    std::vector<JointSpec> joints{{"RigPelvis", -1, {0, 0.128F, -0.023F}}};
    std::vector<TubeSpec> skin{{0, {0, 0.2F, 0.03F}, 0.1F}};
    const auto add = [&](const std::string& name, int parent, const vec3& place, const vec3& end, float radius) {
        joints.push_back({name, parent, place});
        const int joint = static_cast<int>(joints.size()) - 1;
        skin.push_back({joint, end, radius});
        return joint;
    };
    const int chest = add("RigRibcage", 0, {0, 0.255F, 0.074F}, {0, 0.3F, 0.09F}, 0.1F);
    add("RigHead", add("RigNeck", chest, {0, 0.3F, 0.08F}, {0, 0.33F, 0.09F}, 0.1F), {0, 0.356F, 0.098F},
        {0, 0.45F, 0.12F}, 0.1F);
    add("RigTail2", add("RigTail1", 0, {0, 0.177F, -0.09F}, {0, 0.2F, -0.13F}, 0.04F), {0, 0.213F, -0.146F},
        {0, 0.24F, -0.2F}, 0.04F);
    for (const float x : {1.0F, -1.0F}) {
        const std::string start = x > 0.0F ? "RigL" : "RigR";
        const auto addAt = [&](const char* name, int parent, const vec3& place, const vec3& end, float radius) {
            return add(start + name, parent, place * vec3(x, 1, 1), end * vec3(x, 1, 1), radius);
        };
        const int wing = addAt("Arm1", chest, {0.119F, 0.249F, 0.063F}, {0.125F, 0.2F, 0.01F}, 0.03F);
        addAt("Arm2", wing, {0.127F, 0.196F, -0.002F}, {0.13F, 0.15F, -0.06F}, 0.03F);
        const int thigh = addAt("Leg1", 0, {0.053F, 0.075F, -0.019F}, {0.054F, 0.05F, -0.02F}, 0.015F);
        const int shin = addAt("Leg2", thigh, {0.054F, 0.045F, -0.022F}, {0.054F, 0.025F, -0.02F}, 0.012F);
        const int foot = addAt("LegAnkle", shin, {0.054F, 0.021F, -0.02F}, {0.054F, 0.01F, -0.018F}, 0.012F);
        addAt("LegFoot1", foot, {0.054F, 0, -0.016F}, {0.054F, 0, 0.05F}, 0.012F);
    }
    return makeFigure("hen", joints, skin);
}

}  // namespace

TEST_CASE("a body that leans over its legs, with a tail and stumps for arms, is a bird", "[refusal]") {
    const animation::HumanoidMap map = animation::mapHumanoid(hen());
    REQUIRE_FALSE(map.humanoid);
    CHECK(map.warnings.front().find("tail") != std::string::npos);
}

TEST_CASE("wings that hang on shoulders are no arms", "[refusal]") {
    const animation::HumanoidMap map = animation::mapHumanoid(sparrow());
    CHECK_FALSE(map.humanoid);
}

}  // namespace lutka::test
