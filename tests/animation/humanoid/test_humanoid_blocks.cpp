#include <glm/gtc/quaternion.hpp>
#include <string>
#include <vector>

#include "animation/humanoid/map_humanoid.hpp"
#include "rig_variations.hpp"
#include "support/catch.hpp"
#include "support/rigs.hpp"

// Figures of blocks, with one joint for each limb, in poses.
namespace lutka::test {
namespace {

using animation::HumanoidMap;
using animation::Role;

const quat kUpright(1, 0, 0, 0);

quat aboutX(float angle) {
    return glm::angleAxis(radians(angle), vec3(1, 0, 0));
}

// Its legs and arms point that way on the left, its head to the crown; the whole is turned as told. It faces +Z.
struct BlockPose {
    vec3 leg{0, -1, 0};
    vec3 arm{0, -1, 0};
    quat whole = kUpright;
    vec3 crown{0, 1.95F, 0};
};

animation::Character blocks(const BlockPose& pose) {
    std::vector<JointSpec> joints{{"character", -1, {0, 0, 0}},        {"Body", 0, {0, 0.75F, 0}},
                                  {"Head", 1, {0, 1.5F, 0}},           {"Arm_Left", 1, {0.33F, 1.4F, 0}},
                                  {"Arm_Right", 1, {-0.33F, 1.4F, 0}}, {"Leg_Left", 1, {0.12F, 0.75F, 0}},
                                  {"Leg_Right", 1, {-0.12F, 0.75F, 0}}};
    std::vector<TubeSpec> skin{{1, {0, 1.5F, 0}, 0.2F}, {2, pose.crown, 0.22F}};
    for (const int joint : {3, 4, 5, 6}) {
        vec3 way = 0.73F * glm::normalize(joint < 5 ? pose.arm : pose.leg);
        if (joint == 4 || joint == 6) way.x = -way.x;
        skin.push_back({joint, joints[static_cast<std::size_t>(joint)].position + way, 0.1F});
    }
    return rotated(makeFigure("blocks", joints, skin), pose.whole);
}

void checkMap(const BlockPose& pose) {
    const HumanoidMap map = animation::mapHumanoid(blocks(pose));
    INFO((map.warnings.empty() ? std::string() : map.warnings.front()));
    REQUIRE(map.humanoid);
    CHECK(map.jointOf(Role::hips) == 1);
    CHECK(map.jointOf(Role::head) == 2);
    CHECK(map.jointOf(Role::leftUpperArm) == 3);
    CHECK(map.jointOf(Role::rightUpperArm) == 4);
    CHECK(map.jointOf(Role::leftUpperLeg) == 5);
    CHECK(map.jointOf(Role::rightUpperLeg) == 6);
}

}  // namespace

TEST_CASE("blocks with names of arms and legs map in any pose", "[blocks]") {
    checkMap({});
    SECTION("sitting on the floor") {
        checkMap({.leg = {0, 0, 1}});
    }
    SECTION("kneeling") {
        checkMap({.leg = {0, -0.1F, -1}});
    }
    SECTION("bowing") {
        checkMap({.leg = {0, -0.5F, -0.87F}, .arm = {0, -0.5F, -0.87F}, .whole = aboutX(60)});
    }
    SECTION("leaning") {
        checkMap({.whole = aboutX(45)});
    }
    SECTION("leaning to the side") {
        checkMap({.whole = glm::angleAxis(radians(40.0F), vec3(0, 0, 1))});
    }
    SECTION("lying with the knees up") {
        checkMap({.leg = {0, -0.4F, 0.9F}, .whole = aboutX(-90)});
    }
}

TEST_CASE("legs of one joint in the splits do not tell the front", "[blocks]") {
    checkMap({.leg = {1, -0.5F, -0.2F}, .crown = {0, 1.95F, -0.15F}});
}

TEST_CASE("blocks whose soles lie a little behind keep the sides of their names", "[blocks]") {
    checkMap({.leg = {0, -1, -0.1F}});
}

TEST_CASE("blocks that stand on all fours are an animal with the names of a man", "[blocks][refusal]") {
    // The same figure, level, on straight arms and legs.
    const animation::Character animal = blocks({.leg = {0, 0, 1}, .arm = {0, 0, 1}, .whole = aboutX(90)});
    CHECK_FALSE(animation::mapHumanoid(animal).humanoid);
    CHECK_FALSE(animation::mapHumanoid(withoutNames(animal)).humanoid);
}

TEST_CASE("blocks with names whose arms reach the ground beside short legs are a figure", "[blocks]") {
    // Its mesh has the name of an arm, too.
    const std::vector<JointSpec> joints{
        {"arm.left", -1, {0, 0, 0}},       {"body.top", 0, {0, 0.543F, 0}},       {"head", 1, {0, 0.972F, 0}},
        {"nose", 2, {0, 1.277F, -0.329F}}, {"arm.right", 1, {0.551F, 0.866F, 0}}, {"arm.left", 1, {-0.549F, 0.866F, 0}},
        {"body.low", 1, {0, 0.542F, 0}},   {"leg.right", 6, {0.216F, 0.312F, 0}}, {"leg.left", 6, {-0.216F, 0.31F, 0}}};
    std::vector<TubeSpec> skin{
        {1, {0, 0.95F, 0}, 0.4F}, {2, {0, 1.7F, 0}, 0.35F}, {3, {0, 1.277F, -0.45F}, 0.08F}, {6, {0, 0.35F, 0}, 0.35F}};
    for (const int joint : {4, 5, 7, 8}) {
        const vec3 place = joints[static_cast<std::size_t>(joint)].position;
        skin.push_back({joint, {place.x, 0, 0}, 0.12F});
    }
    const HumanoidMap map = animation::mapHumanoid(makeFigure("agent", joints, skin));
    INFO((map.warnings.empty() ? std::string() : map.warnings.front()));
    REQUIRE(map.humanoid);
    CHECK(map.jointOf(Role::leftUpperArm) == 5);
    CHECK(map.jointOf(Role::leftUpperLeg) == 8);
    CHECK(map.jointOf(Role::head) == 2);
}

TEST_CASE("joints without skin of a sword in one hand cost the other arm nothing", "[blocks]") {
    // It faces +X; its names are Turkish.
    const std::vector<JointSpec> joints{{"Armature", -1, {0, 0, 0}},
                                        {"Bel", 0, {0, 0, 0}},
                                        {"Gogus", 1, {0, 0.44F, 0}},
                                        {"Bone_002", 2, {0, 0.875F, 0}},
                                        {"SagKol", 3, {0, 0.656F, -0.219F}},
                                        {"Bone_003", 2, {0, 0.875F, 0}},
                                        {"SolKol", 5, {0, 0.656F, 0.219F}},
                                        {"Cube_001", 6, {0.67F, -0.125F, -0.437F}},
                                        {"Icosphere", 7, {0.215F, 0.19F, -0.407F}},
                                        {"Kafa", 2, {0, 0.875F, 0}},
                                        {"Bone_007", 0, {0, 0, 0}},
                                        {"Bone_008", 10, {0, 0, -0.109F}},
                                        {"Bone_009", 11, {0, -0.219F, -0.109F}},
                                        {"Bone_010", 0, {0, 0, 0}},
                                        {"Bone_011", 13, {0, 0, 0.109F}},
                                        {"Bone_012", 14, {0, -0.219F, 0.109F}}};
    const std::vector<TubeSpec> skin{
        {1, {0, 0.4F, 0}, 0.2F},          {2, {0, 0.85F, 0}, 0.2F},        {4, {0, 0.656F, -0.85F}, 0.1F},
        {6, {0, 0.656F, 0.85F}, 0.1F},    {9, {0, 1.3F, 0}, 0.2F},         {11, {0, -0.21F, -0.109F}, 0.1F},
        {12, {0, -0.43F, -0.109F}, 0.1F}, {14, {0, -0.21F, 0.109F}, 0.1F}, {15, {0, -0.43F, 0.109F}, 0.1F}};
    const HumanoidMap map = animation::mapHumanoid(makeFigure("swordsman", joints, skin));
    INFO((map.warnings.empty() ? std::string() : map.warnings.front()));
    REQUIRE(map.humanoid);
    CHECK(map.jointOf(Role::leftUpperArm) == 6);
    CHECK(map.jointOf(Role::rightUpperArm) == 4);
}

}  // namespace lutka::test
