// A file's own humanoid map beside the figure that it is of.

#include <map>
#include <string>

#include "animation/humanoid/roles.hpp"
#include "animation/import/checks.hpp"
#include "animation/import/figure_file.hpp"
#include "animation/import/gltf_file.hpp"
#include "animation/import/humanoid_block.hpp"
#include "support/catch.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using namespace lutka::animation;
using namespace lutka::test;

namespace {

using Roles = std::map<std::string, int>;

Roles rolesOf(const Character& biped) {
    Roles roles;
    const HumanoidMap map = mapOfBiped(biped);
    for (int i = 0; i < kRoleCount; ++i) {
        if (map.roles[i]) roles[std::string(roleName(roleAt(i)))] = map.roles[i]->joint;
    }
    return roles;
}

Roles exchanged(Roles roles, const std::map<std::string, std::string>& pairs) {
    for (const auto& [a, b] : pairs)
        std::swap(roles.at(a), roles.at(b));
    return roles;
}

const std::map<std::string, std::string> kArmsAndLegs = {
    {"leftUpperArm", "leftUpperLeg"},   {"leftLowerArm", "leftLowerLeg"},   {"leftHand", "leftFoot"},
    {"rightUpperArm", "rightUpperLeg"}, {"rightLowerArm", "rightLowerLeg"}, {"rightHand", "rightFoot"}};

}  // namespace

TEST_CASE("a humanoid map that the figure speaks against is found out, and why") {
    Character biped = makeBiped();
    Roles roles = rolesOf(biped);
    for (const std::string side : {"left", "right"}) {
        const int foot = roles.at(side + "Foot");
        roles[side + "Toes"] = biped.skeleton.jointCount();
        biped.skeleton.names.push_back(side + "Toes");
        biped.skeleton.parents.push_back(foot);
        biped.skeleton.bindModelFromJoint.push_back(biped.skeleton.bindModelFromJoint[foot]);
        biped.skeleton.bindModelFromJoint.back().translation += vec3(0, -0.05F, 0.12F);
    }
    CHECK_FALSE(rig_import::contradictionIn(roles, biped.skeleton));
    CHECK_FALSE(rig_import::contradictionIn({}, biped.skeleton));
    const auto why = [&](const std::map<std::string, std::string>& pairs) {
        return rig_import::contradictionIn(exchanged(roles, pairs), biped.skeleton).value_or("");
    };
    CHECK(why(kArmsAndLegs).find("leftUpperLeg (") == 0);
    CHECK(why(kArmsAndLegs).find("lies above leftUpperArm") != std::string::npos);
    CHECK(why({{"leftLowerArm", "leftLowerLeg"}, {"leftHand", "leftFoot"}}).find("hangs on leftUpperLeg") !=
          std::string::npos);
    CHECK(why({{"rightUpperArm", "rightHand"}}).find("which it should hang on") != std::string::npos);
    CHECK(why({{"leftHand", "rightHand"}}).find("hangs on rightUpperArm") != std::string::npos);
    // Both sides of all limbs: only the toes tell.
    std::map<std::string, std::string> sides;
    for (const auto& [role, joint] : roles) {
        if (role.starts_with("left")) sides["right" + role.substr(4)] = role;
    }
    CHECK(why(sides).find("left and right are exchanged") == 0);
}

TEST_CASE("a VRM whose humanoid block calls arms legs is mapped by the figure, with a word") {
    const TemporaryFolder folder;
    const Character biped = makeBiped();
    GltfFile file;
    addFigure(file, biped, "figure");
    const auto save = [&](const Roles& roles) {
        nlohmann::json bones;
        for (const auto& [role, joint] : roles) {
            for (std::size_t node = 0; node < file.json["nodes"].size(); ++node) {
                const bool isJoint = file.json["nodes"][node]["name"] == biped.skeleton.names[joint];
                if (isJoint) bones[role] = {{"node", node}};
            }
        }
        file.json["extensions"]["VRMC_vrm"] = {{"specVersion", "1.0"}, {"humanoid", {{"humanBones", bones}}}};
        file.saveBinary(folder / "figure.vrm");
        return imported(folder / "figure.vrm");
    };
    const Character right = save(rolesOf(biped));
    CHECK(right.vrmHumanoid.size() == rolesOf(biped).size());
    CHECK_FALSE(warns(right, "humanoid map"));
    const Character wrong = save(exchanged(rolesOf(biped), kArmsAndLegs));
    CHECK(wrong.vrmHumanoid.empty());
    CHECK(warns(wrong, "humanoid map is not believed"));
    const HumanoidMap map = mapHumanoid(wrong);
    CHECK(wrong.skeleton.names[map.jointOf(Role::leftUpperArm)] ==
          biped.skeleton.names[rolesOf(biped).at("leftUpperArm")]);
}
