#include <string>
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

}  // namespace

TEST_CASE("a frog of blocks, whose joints have a man's names, is no figure on its back", "[lookalikes]") {
    const animation::HumanoidMap map = animation::mapHumanoid(blockFrog());
    CHECK_FALSE(map.humanoid);
}

TEST_CASE("a pair of legs is no pair of arms", "[lookalikes]") {
    const animation::HumanoidMap map = animation::mapHumanoid(flatSpider());
    CHECK_FALSE(map.humanoid);
}

}  // namespace lutka::test
