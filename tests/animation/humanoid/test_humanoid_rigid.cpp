// Figures that are put together of rigid parts alone.

#include <cstdint>
#include <string>
#include <vector>

#include "animation/humanoid/map_humanoid.hpp"
#include "support/catch.hpp"
#include "support/rigs.hpp"

namespace lutka::test {
namespace {

using animation::HumanoidMap;
using animation::Role;

struct BoxPart {
    std::string name;
    vec3 middle;
    vec3 half;
};

// Boxes below one node at the origin; their own nodes lie at their middles, or at the origin like that.
animation::Character ofBoxes(const std::vector<BoxPart>& parts, bool atOrigin) {
    std::vector<JointSpec> joints{{"RootNode", -1, vec3(0)}};
    for (const BoxPart& part : parts)
        joints.push_back({part.name, 0, atOrigin ? vec3(0) : part.middle});
    animation::Character character;
    character.skeleton = makeSkeleton(joints);
    character.skeleton.skinWeight.assign(joints.size(), 0.0F);
    for (std::size_t index = 0; index < parts.size(); ++index) {
        animation::SkinnedMesh mesh;
        mesh.rigid = true;
        for (int corner = 0; corner < 8; ++corner) {
            const vec3 way(corner % 2 * 2 - 1, corner / 2 % 2 * 2 - 1, corner / 4 * 2 - 1);
            mesh.positions.push_back(parts[index].middle + way * parts[index].half);
        }
        mesh.joints.assign(8, {static_cast<std::uint16_t>(index + 1), 0, 0, 0});
        mesh.weights.assign(8, {1, 0, 0, 0});
        mesh.indices = {0, 1, 2, 1, 2, 3, 4, 5, 6, 5, 6, 7, 0, 1, 4, 2, 3, 6};
        character.skeleton.skinWeight[index + 1] = 8.0F;
        character.meshes.push_back(std::move(mesh));
    }
    return character;
}

std::string jointNameOf(const animation::Character& character, const HumanoidMap& map, Role role) {
    const int joint = map.jointOf(role);
    return joint == animation::kNoJoint ? "none" : character.skeleton.names[static_cast<std::size_t>(joint)];
}

// Arms that hang down to the knees, short legs, a large head.
std::vector<BoxPart> chibi(const std::string& left, const std::string& right) {
    return {{"Body", {0, 0.55F, 0}, {0.15F, 0.25F, 0.1F}},
            {"Head", {0, 1.0F, 0}, {0.25F, 0.2F, 0.2F}},
            {"Arm" + left, {0.3F, 0.5F, 0}, {0.05F, 0.25F, 0.05F}},
            {"Arm" + right, {-0.3F, 0.5F, 0}, {0.05F, 0.25F, 0.05F}},
            {"Leg" + left, {0.1F, 0.15F, 0}, {0.06F, 0.15F, 0.06F}},
            {"Leg" + right, {-0.1F, 0.15F, 0}, {0.06F, 0.15F, 0.06F}}};
}

}  // namespace

TEST_CASE("parts whose transforms a program has made nothing lie where their meshes do", "[blocks]") {
    for (const bool atOrigin : {false, true}) {
        const animation::Character figure = ofBoxes(chibi("", ".001"), atOrigin);
        const HumanoidMap map = animation::mapHumanoid(figure);
        INFO((map.warnings.empty() ? std::string() : map.warnings.front()));
        REQUIRE(map.humanoid);
        CHECK(jointNameOf(figure, map, Role::head) == "Head");
        CHECK(jointNameOf(figure, map, Role::leftUpperArm).substr(0, 3) == "Arm");
        CHECK(jointNameOf(figure, map, Role::rightUpperLeg).substr(0, 3) == "Leg");
    }
}

TEST_CASE("the block of the trunk is the hips, not the file's node at the origin", "[blocks]") {
    for (const bool atOrigin : {false, true}) {
        const animation::Character figure = ofBoxes(chibi("_L", "_R"), atOrigin);
        const HumanoidMap map = animation::mapHumanoid(figure);
        REQUIRE(map.humanoid);
        CHECK(jointNameOf(figure, map, Role::hips) == "Body");
        CHECK(jointNameOf(figure, map, Role::leftUpperLeg) == "Leg_L");
    }
}

TEST_CASE("blocks named arms, legs and head are a figure in odd proportions, and without names none", "[blocks]") {
    std::vector<BoxPart> parts = chibi("_Left", "_Right");
    parts[2].middle = {0.6F, 0.8F, 0};  // arms far out, as a T pose of a small model has them
    parts[3].middle = {-0.6F, 0.8F, 0};
    parts.push_back({"Hand_Left", {0.75F, 0.62F, 0.2F}, vec3(0.05F)});
    parts.push_back({"Hand_Right", {-0.75F, 0.62F, 0.2F}, vec3(0.05F)});
    parts.push_back({"Boot", {0.1F, 0.05F, 0.03F}, vec3(0.05F)});
    const animation::Character figure = ofBoxes(parts, false);
    const HumanoidMap map = animation::mapHumanoid(figure);
    INFO((map.warnings.empty() ? std::string() : map.warnings.front()));
    REQUIRE(map.humanoid);
    CHECK(jointNameOf(figure, map, Role::hips) == "Body");
    CHECK(jointNameOf(figure, map, Role::leftUpperArm) == "Arm_Left");
    CHECK_FALSE(animation::mapHumanoid(figure, {.useNames = false}).humanoid);
    parts.push_back({"Tail", {0, 0.4F, -0.4F}, {0.03F, 0.03F, 0.3F}});
    parts.erase(parts.begin() + 1);  // without a head
    CHECK_FALSE(animation::mapHumanoid(ofBoxes(parts, false)).humanoid);
}

TEST_CASE("front and hind legs of other languages are an animal's", "[blocks]") {
    const std::vector<BoxPart> parts{{"torso", {0, 1.2F, 0}, {0.3F, 0.3F, 0.8F}},
                                     {"HEAD", {0, 2.2F, 1.1F}, {0.2F, 0.2F, 0.3F}},
                                     {"Cube.005", {0.13F, 2.8F, 1.1F}, vec3(0.06F)},
                                     {"Cube.006", {-0.13F, 2.8F, 1.1F}, vec3(0.06F)},
                                     {"PIERNA DELANTERA IZQUIERDA", {0.39F, 0.5F, 0.8F}, {0.1F, 0.5F, 0.1F}},
                                     {"PIERNA DELANTERA DERECHA", {-0.39F, 0.5F, 0.8F}, {0.1F, 0.5F, 0.1F}},
                                     {"PIERNA TRASERA IZQUIERDA", {0.39F, 0.5F, -0.8F}, {0.1F, 0.5F, 0.1F}},
                                     {"PIERNA TRASERA DERECHA", {-0.39F, 0.5F, -0.8F}, {0.1F, 0.5F, 0.1F}}};
    CHECK_FALSE(animation::mapHumanoid(ofBoxes(parts, false)).humanoid);
}

}  // namespace lutka::test
