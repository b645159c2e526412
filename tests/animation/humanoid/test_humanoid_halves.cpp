// Figures both of whose arms or legs are missing, and what is none.

#include <algorithm>
#include <string>
#include <vector>

#include "animation/humanoid/map_humanoid.hpp"
#include "posed_rigs.hpp"
#include "rig_variations.hpp"
#include "support/catch.hpp"
#include "support/rigs.hpp"
#include "synthetic_rigs.hpp"

namespace lutka::test {
namespace {

using animation::HumanoidMap;
using animation::Role;

bool tells(const HumanoidMap& map, const std::string& word) {
    return std::find(map.warnings.begin(), map.warnings.end(), word) != map.warnings.end();
}

// Legs, a level or an upright body and a head; as the names of a game's birds have it.
animation::Character legsAlone(bool upright) {
    const vec3 neck = upright ? vec3(0, 0.9F, 0.05F) : vec3(0, 0.6F, 0.4F);
    animation::Character bird;
    bird.skeleton = makeSkeleton({{"Hips", -1, {0, 0.5F, 0}},
                                  {"Spine", 0, {0, 0.6F, 0.02F}},
                                  {"Neck", 1, neck},
                                  {"Head", 2, neck + vec3(0, 0.1F, 0.02F)},
                                  {"LeftUpperLeg", 0, {0.1F, 0.48F, 0}},
                                  {"LeftLowerLeg", 4, {0.1F, 0.25F, 0.01F}},
                                  {"LeftFoot", 5, {0.1F, 0.05F, 0}},
                                  {"RightUpperLeg", 0, {-0.1F, 0.48F, 0}},
                                  {"RightLowerLeg", 7, {-0.1F, 0.25F, 0.01F}},
                                  {"RightFoot", 8, {-0.1F, 0.05F, 0}}});
    std::fill(bird.skeleton.skinWeight.begin(), bird.skeleton.skinWeight.end(), 50.0F);
    return bird;
}

}  // namespace

TEST_CASE("a figure without legs, or without arms, is read by its names", "[halves]") {
    for (const char* convention : {"unreal", "vroid", "daz genesis 8", "character creator", "mmd", "xsens", "german"}) {
        for (const bool legs : {true, false}) {
            SyntheticRig rig = makeSyntheticRig(convention, {.armsDown = 0.5F});
            const std::string limb = legs ? "leg" : "arm";
            INFO(convention << " without a " << limb);
            // Without its arms a shoulder may be one.
            const bool shoulders = rig.truth.roles[indexOf(Role::leftShoulder)].has_value();
            const Role top = legs ? Role::leftUpperLeg : shoulders ? Role::leftShoulder : Role::leftUpperArm;
            cutOff(rig, top);
            cutOff(rig, animation::mirrored(top));
            checkWhatIsLeft(rig);
            const HumanoidMap map = animation::mapHumanoid(rig.character);
            CHECK(tells(map, "the figure has no joints of a left " + limb));
            CHECK(tells(map, "the figure has no joints of a right " + limb));
            CHECK(map[Role::hips]);
            CHECK(map[Role::head]);
            CHECK((map.standardFromModel * vec3(0, 1, 0)).y > 0.99F);
            CHECK((map.standardFromModel * vec3(1, 0, 0)).x > 0.99F);
        }
    }
}

TEST_CASE("collars and bosoms are no arms where their names say so", "[halves]") {
    SyntheticRig rig = makeSyntheticRig("daz genesis 8");
    cutOff(rig, Role::leftUpperArm);
    cutOff(rig, Role::rightUpperArm);
    checkWhatIsLeft(rig);
}

TEST_CASE("curves that drive the arms are no second pair of them", "[halves]") {
    // The upper half of a walking machine: "hip" is no thigh, and the curves bear the names of the joints.
    std::vector<JointSpec> joints{{"hip", -1, {0, 0.9F, 0}}, {"torso", 0, {0, 1.1F, 0}}, {"head", 1, {0, 1.5F, 0}}};
    for (const char* side : {"L", "R"}) {
        const float x = *side == 'L' ? 1.0F : -1.0F;
        const auto at = static_cast<int>(joints.size());
        joints.push_back({side + std::string("colar"), 1, {0.15F * x, 1.3F, 0}});
        joints.push_back({side + std::string("shoulder"), at, {0.3F * x, 1.3F, 0}});
        joints.push_back({side + std::string("elbow"), at + 1, {0.3F * x, 1.0F, 0}});
        joints.push_back({side + std::string("hand"), at + 2, {0.3F * x, 0.85F, 0.15F}});
        joints.push_back({side + std::string("shoulder_nurbsCircle"), -1, {0.4F * x, 0, 0}});
        joints.push_back({side + std::string("elbow_nurbsCircle"), -1, {0.5F * x, 0, 0}});
    }
    animation::Character machine;
    machine.skeleton = makeSkeleton(joints);
    for (std::size_t i = 0; i < joints.size(); ++i)
        machine.skeleton.skinWeight[i] = joints[i].name.ends_with("Circle") ? 0.0F : 60.0F;
    const HumanoidMap map = animation::mapHumanoid(machine);
    REQUIRE(map.humanoid);
    CHECK(map.jointOf(Role::hips) == 0);
    CHECK(map.jointOf(Role::leftUpperArm) == 4);
    CHECK(map.jointOf(Role::leftHand) == 6);
    CHECK(map.jointOf(Role::leftUpperLeg) == animation::kNoJoint);
}

TEST_CASE("where a giant's legs hang on its root, the root of the spine is its hips", "[halves]") {
    std::vector<JointSpec> joints{{"root", -1, {0, 0.75F, 0}},
                                  {"spine", 0, {0, 0.95F, 0}},
                                  {"chest", 1, {0, 1.25F, 0}},
                                  {"head", 2, {0, 1.55F, 0}}};
    std::vector<TubeSpec> skin{
        {0, {0, 0, 0}, 0.3F}, {1, {0, 1.25F, 0}, 0.3F}, {2, {0, 1.5F, 0}, 0.3F}, {3, {0, 1.9F, 0}, 0.15F}};
    for (const float side : {1.0F, -1.0F}) {
        const std::string end = side > 0.0F ? ".L" : ".R";
        int above = 2;
        const std::vector<vec3> places{{0.4F, 1.5F, 0}, {0.7F, 1.2F, 0}, {0.6F, 0.9F, 0.2F}, {0.6F, 0.7F, 0.3F}};
        std::size_t place = 0;
        for (const char* name : {"upper_arm", "forearm", "hand"}) {
            joints.push_back({name + end, above, places[place] * vec3(side, 1, 1)});
            above = static_cast<int>(joints.size()) - 1;
            skin.push_back({above, places[++place] * vec3(side, 1, 1), 0.08F});
        }
    }
    const HumanoidMap map = animation::mapHumanoid(makeFigure("giant", joints, skin));
    REQUIRE(map.humanoid);
    CHECK(map.jointOf(Role::hips) == 0);
    CHECK(map.jointOf(Role::head) == 3);
    CHECK(map.jointOf(Role::leftUpperArm) == 4);
    CHECK(map.jointOf(Role::rightHand) == 9);
    CHECK(tells(map, "the figure has no joints of a left leg"));
}

TEST_CASE("half a figure without names is none", "[halves]") {
    SyntheticRig rig = makeSyntheticRig("vroid");
    cutOff(rig, Role::leftUpperLeg);
    cutOff(rig, Role::rightUpperLeg);
    CHECK_FALSE(animation::mapHumanoid(withoutNames(rig.character)).humanoid);
}

TEST_CASE("legs below an upright trunk are a figure, below a level one a bird, and so beside a wing or a tail",
          "[halves]") {
    CHECK(animation::mapHumanoid(legsAlone(true)).humanoid);
    CHECK_FALSE(animation::mapHumanoid(legsAlone(false)).humanoid);
    for (const char* name : {"Wing_L", "Tail"}) {
        animation::Character bird = legsAlone(true);
        bird.skeleton.names.emplace_back(name);
        bird.skeleton.parents.push_back(1);
        bird.skeleton.bindModelFromJoint.push_back({quat(1, 0, 0, 0), vec3(0.1F, 0.7F, 0)});
        bird.skeleton.nodeParentFromJoint.emplace_back();
        bird.skeleton.skinWeight.push_back(50.0F);
        INFO(name);
        CHECK_FALSE(animation::mapHumanoid(bird).humanoid);
    }
}

TEST_CASE("the halves of a figure that was cut in two map as the whole", "[halves]") {
    // Stumps and no feet: neither half moves the skin of all four limbs, nor loses all of any.
    for (const bool upper : {true, false}) {
        INFO((upper ? "upper half" : "lower half"));
        SyntheticRig rig = makeSyntheticRig("german");
        for (const Role role : {Role::leftFoot, Role::rightFoot})
            cutOff(rig, role);
        animation::Character& half = rig.character;
        const std::vector<Role> bare = upper ? std::vector<Role>{Role::leftLowerLeg, Role::rightLowerLeg}
                                             : std::vector<Role>{Role::head, Role::leftLowerArm, Role::leftHand,
                                                                 Role::rightLowerArm, Role::rightHand};
        for (const Role role : bare) {
            for (int joint = 0; joint < half.skeleton.jointCount(); ++joint) {
                if (animation::isAncestorOrSelf(half.skeleton, jointOf(rig, role), joint))
                    half.skeleton.skinWeight[joint] = 0.0F;
            }
        }
        const HumanoidMap map = animation::mapHumanoid(half);
        REQUIRE(map.humanoid);
        for (const Role role : {Role::head, Role::leftUpperArm, Role::leftLowerArm, Role::leftHand, Role::leftUpperLeg,
                                Role::leftLowerLeg, Role::rightLowerArm, Role::rightLowerLeg})
            CHECK(map.jointOf(role) == jointOf(rig, role));
        CHECK(tells(map, "only a part of the figure has skin: the other shapes come from the joints alone"));
    }
}

}  // namespace lutka::test
