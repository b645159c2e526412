#include <string>
#include <utility>
#include <vector>

#include "animation/humanoid/map_humanoid.hpp"
#include "support/catch.hpp"
#include "support/rigs.hpp"

// Animals whose skin and names have something of a figure's.
namespace lutka::test {
namespace {

// Of blocks: seen from above, its head lies beyond its arms and its feet beyond its legs.
animation::Character blockFrog() {
    const std::vector<JointSpec> joints{{"Torso", -1, {0, 0.23F, 0.18F}},
                                        {"Leg.R", 0, {-0.28F, 0.23F, 0.18F}},
                                        {"Foot.R", 1, {-0.28F, 0.03F, 0.38F}},
                                        {"Arm.R", 0, {-0.28F, 0.25F, -0.16F}},
                                        {"Leg.L", 0, {0.28F, 0.23F, 0.18F}},
                                        {"Foot.L", 4, {0.28F, 0.03F, 0.38F}},
                                        {"Arm.L", 0, {0.28F, 0.25F, -0.16F}},
                                        {"Head.CTRL", 0, {0, 0.45F, -0.28F}},
                                        {"Head", 7, {0, 0.45F, -0.28F}},
                                        {"Jaw", 8, {0, 0.3F, -0.25F}},
                                        {"Shoulder.R", -1, {-0.28F, 0.25F, -0.16F}},
                                        {"Shoulder.L", -1, {0.28F, 0.25F, -0.16F}}};
    std::vector<TubeSpec> skin{
        {0, {0, 0.25F, -0.2F}, 0.25F}, {8, {0, 0.47F, -0.6F}, 0.2F}, {9, {0, 0.3F, -0.6F}, 0.1F}};
    for (const int first : {1, 4}) {
        const float x = joints[static_cast<std::size_t>(first)].position.x;
        skin.push_back({first, {x, 0.1F, 0.2F}, 0.1F});
        skin.push_back({first + 1, {x, 0.03F, 0.1F}, 0.05F});
        skin.push_back({first + 2, {x, 0, -0.16F}, 0.06F});
    }
    return makeFigure("frog", joints, skin);
}

// All joints of its legs hang on its body side by side at one height.
animation::Character flatSpider() {
    std::vector<JointSpec> joints{{"Backbone", -1, {-0.16F, 0.74F, 0}}};
    std::vector<TubeSpec> skin{{0, {0.5F, 0.78F, 0}, 0.2F}};
    for (const float side : {1.0F, -1.0F}) {
        const std::string name = side > 0.0F ? "Rightleg" : "Leftleg";
        const std::vector<vec3> places{
            {-0.15F, 0.74F, 0.25F}, {0.05F, 0.74F, 0.34F}, {0.32F, 0.74F, 0.35F}, {0.56F, 0.74F, 0.26F}};
        for (std::size_t i = 0; i < places.size(); ++i) {
            const vec3 at = places[i] * vec3(1, 1, side);
            skin.push_back({static_cast<int>(joints.size()), at * vec3(1.2F, 0, 3), 0.03F});
            joints.push_back({name + (i > 0 ? "_" + std::to_string(i) : ""), 0, at});
        }
    }
    skin.push_back({static_cast<int>(joints.size()), {-0.9F, 0.9F, 0}, 0.2F});
    joints.push_back({"Bootybone", 0, {-0.27F, 0.74F, 0}});
    return makeFigure("spider", joints, skin);
}

// Its legs, whose sides are named badly, lie behind it.
animation::Character treeFrog() {
    std::vector<JointSpec> joints{{"Hip_J", -1, {0, 0.14F, -0.42F}},
                                  {"Spine01_J", 0, {0, 0.21F, -0.33F}},
                                  {"Spine02_J", 1, {0, 0.28F, -0.17F}},
                                  {"Head_J", 2, {0, 0.24F, -0.05F}}};
    std::vector<TubeSpec> skin{{0, {0, 0.2F, -0.33F}, 0.1F},
                               {1, {0, 0.27F, -0.17F}, 0.1F},
                               {2, {0, 0.25F, -0.05F}, 0.1F},
                               {3, {0, 0.25F, 0.15F}, 0.1F}};
    const auto chain = [&](int above, const std::vector<std::pair<std::string, vec3>>& parts) {
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const auto joint = static_cast<int>(joints.size());
            const vec3& at = parts[i].second;
            skin.push_back({joint, i + 1 < parts.size() ? parts[i + 1].second : at + vec3(0, 0, 0.05F), 0.03F});
            joints.push_back({parts[i].first, i == 0 ? above : joint - 1, at});
        }
    };
    for (const float side : {1.0F, -1.0F}) {
        const bool left = side > 0.0F;
        const std::string start = left ? "L_" : "R_";
        const vec3 sign(side, 1, 1);
        chain(0, {{left ? "L_Leg_J" : "R_Reg_J", sign * vec3(0.06F, 0.14F, -0.46F)},
                  {start + "Knee_J", sign * vec3(0.3F, 0.07F, -0.57F)},
                  {start + "Ankle_J", sign * vec3(0.25F, 0.01F, -0.81F)},
                  {"L_Foot_J", sign * vec3(0.37F, 0.01F, -0.92F)}});
        chain(2, {{start + "Clavicle_J", sign * vec3(0.05F, 0.17F, -0.15F)},
                  {start + "Shoulder_J", sign * vec3(0.12F, 0.17F, -0.15F)},
                  {start + "Elbow_J", sign * vec3(0.24F, 0.08F, -0.15F)},
                  {start + "Hand", sign * vec3(0.36F, 0.02F, -0.06F)}});
    }
    return makeFigure("tree frog", joints, skin);
}

// A bear of blocks whose legs have a man's names and two joints each.
animation::Character blockBear() {
    std::vector<JointSpec> joints{
        {"Torso", -1, {0, 1.2F, 0.52F}}, {"Neck", 0, {0, 1.2F, -0.61F}}, {"Head", 1, {0, 1.4F, -0.89F}}};
    std::vector<TubeSpec> skin{{0, {0, 1.1F, -0.6F}, 0.4F}, {1, {0, 1.3F, -0.8F}, 0.25F}, {2, {0, 1.4F, -1.3F}, 0.25F}};
    for (const float side : {1.0F, -1.0F}) {
        const std::string end = side > 0.0F ? ".L" : ".R";
        for (const bool arm : {true, false}) {
            const float z = arm ? -0.52F : 0.51F;
            const std::string name = arm ? "Arm" : "Leg";
            joints.push_back({"Upper" + name + end, 0, {side * 0.22F, 0.9F, z}});
            const int upper = static_cast<int>(joints.size()) - 1;
            joints.push_back({"Lower" + name + end, upper, {side * 0.22F, 0.56F, z}});
            skin.push_back({upper + 1, {side * 0.22F, 0, z}, 0.15F});
        }
    }
    return makeFigure("bear", joints, skin);
}

// A dog that sits: no joints for its front legs, and ears that stand aside.
animation::Character sittingDog() {
    std::vector<JointSpec> joints{{"Hip", -1, {0, 0.39F, 0}},
                                  {"Neck", 0, {0, 1.04F, 0}},
                                  {"Head", 1, {0, 1.69F, 0}},
                                  {"Tail", 0, {0, 0.39F, -0.35F}},
                                  {"Tail2", 3, {0, 0.42F, -0.67F}}};
    std::vector<TubeSpec> skin{
        {0, {0, 0.9F, 0}, 0.35F}, {1, {0, 1.6F, 0}, 0.55F}, {2, {0, 1.9F, 0}, 0.3F}, {4, {0, 0.6F, -0.9F}, 0.08F}};
    for (const float side : {1.0F, -1.0F}) {
        const std::string start = side > 0.0F ? "L_" : "R_";
        const auto add = [&](const std::string& name, int parent, const vec3& place, const vec3& end) {
            joints.push_back({start + name, parent, place * vec3(side, 1, 1)});
            skin.push_back({static_cast<int>(joints.size()) - 1, end * vec3(side, 1, 1), 0.1F});
            return static_cast<int>(joints.size()) - 1;
        };
        add("EarTip", add("Ear", 2, {0.45F, 1.96F, 0}, {0.55F, 1.97F, 0}), {0.6F, 1.98F, 0}, {0.75F, 2, 0});
        add("Foot", add("Leg", 0, {0.21F, 0.39F, 0}, {0.21F, 0.1F, 0}), {0.21F, 0.03F, 0}, {0.21F, 0.03F, 0.2F});
    }
    return makeFigure("dog", joints, skin);
}

// A raptor whose joints have a man's names, but for a tail that has none.
animation::Character namedRaptor() {
    std::vector<JointSpec> joints{{"Root", -1, {0, 0.08F, -0.08F}},    {"Spine", 0, {0, 0.27F, -0.04F}},
                                  {"Spine.001", 1, {0, 0.48F, 0.02F}}, {"Bone.003", 2, {0, 0.67F, 0.12F}},
                                  {"Bone.006", 3, {0, 1, 0.54F}},      {"Head", 4, {0, 1.08F, 0.76F}}};
    std::vector<TubeSpec> skin{{1, {0, 0.45F, 0}, 0.25F}, {3, {0, 0.95F, 0.5F}, 0.15F}, {5, {0, 1, 1.2F}, 0.2F}};
    int tail = 0;
    for (int i = 0; i < 8; ++i) {
        const auto along = static_cast<float>(i);
        joints.push_back({"Bone.0" + std::to_string(20 + i), tail, {0, 0.05F - 0.05F * along, -0.3F - 0.16F * along}});
        tail = static_cast<int>(joints.size()) - 1;
        skin.push_back({tail, joints.back().position - vec3(0, 0.05F, 0.16F), 0.08F});
    }
    for (const float side : {1.0F, -1.0F}) {
        const std::string end = side > 0.0F ? ".L" : ".R";
        const auto chain = [&](int parent, const std::vector<std::pair<std::string, vec3>>& parts) {
            for (const auto& [name, place] : parts) {
                joints.push_back({name + end, parent, place * vec3(side, 1, 1)});
                parent = static_cast<int>(joints.size()) - 1;
                skin.push_back({parent, joints.back().position - vec3(0, 0.1F, 0), 0.08F});
            }
        };
        chain(0, {{"Thigh", {0.3F, 0.14F, 0.02F}}, {"Calf", {0.3F, -0.31F, 0.06F}}, {"Foot", {0.3F, -0.69F, 0.03F}}});
        chain(3,
              {{"Bicep", {0.28F, 0.54F, 0.2F}}, {"Forearm", {0.28F, 0.42F, 0.29F}}, {"Hand", {0.27F, 0.31F, 0.49F}}});
    }
    return makeFigure("raptor", joints, skin);
}

}  // namespace

TEST_CASE("ears are no arms", "[lookalikes]") {
    const animation::HumanoidMap map = animation::mapHumanoid(sittingDog());
    REQUIRE_FALSE(map.humanoid);
}

TEST_CASE("a raptor whose limbs have a man's names is none for a tail without a name", "[lookalikes]") {
    const animation::HumanoidMap map = animation::mapHumanoid(namedRaptor());
    REQUIRE_FALSE(map.humanoid);
}

TEST_CASE("a bear of blocks that stands on all fours is no man, whatever its joints are called", "[lookalikes]") {
    const animation::HumanoidMap map = animation::mapHumanoid(blockBear());
    REQUIRE_FALSE(map.humanoid);
}

TEST_CASE("a frog that lies is no figure that lacks a leg", "[lookalikes]") {
    CHECK_FALSE(animation::mapHumanoid(treeFrog()).humanoid);
}

TEST_CASE("a frog of blocks, whose joints have a man's names, is no figure on its back", "[lookalikes]") {
    const animation::HumanoidMap map = animation::mapHumanoid(blockFrog());
    CHECK_FALSE(map.humanoid);
}

TEST_CASE("a pair of legs is no pair of arms", "[lookalikes]") {
    const animation::HumanoidMap map = animation::mapHumanoid(flatSpider());
    CHECK_FALSE(map.humanoid);
}

}  // namespace lutka::test
