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

}  // namespace

TEST_CASE("wings that hang on shoulders are no arms", "[refusal]") {
    const animation::HumanoidMap map = animation::mapHumanoid(sparrow());
    CHECK_FALSE(map.humanoid);
}

}  // namespace lutka::test
