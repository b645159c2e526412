// Figures of rigid parts, and trees of joints that no usual figure has.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "animation/humanoid/map_humanoid.hpp"
#include "rig_variations.hpp"
#include "support/catch.hpp"
#include "support/rigs.hpp"
#include "synthetic_rigs.hpp"

namespace lutka::test {
namespace {

using animation::HumanoidMap;
using animation::Role;

int jointPlaying(const SyntheticRig& rig, Role role) {
    return animation::findJoint(rig.character.skeleton, rig.truth.roles[indexOf(role)]->front());
}

// A rigid sword in the hand: a hilt of few vertices, and on it a blade of many, whose joint lies away from the hand.
void giveSword(animation::Character& figure, int hand) {
    const vec3 grip = figure.skeleton.bindModelFromJoint[hand].translation;
    int parent = hand;
    for (const bool blade : {false, true}) {
        const vec3 place = grip + (blade ? vec3(0.65F, 0.05F, 0.75F) : vec3(0, -0.05F, 0.12F));
        const auto node = static_cast<std::uint16_t>(figure.skeleton.jointCount());
        animation::SkinnedMesh part;
        part.rigid = true;
        for (int i = 0; i < (blade ? 5000 : 24); ++i)
            part.positions.push_back(place + 0.1F * vec3(i % 2, i / 2 % 2, i / 4 % 2));
        part.joints.assign(part.positions.size(), {node, 0, 0, 0});
        part.weights.assign(part.positions.size(), {1, 0, 0, 0});
        part.indices = {0, 1, 2};
        figure.skeleton.names.push_back("part_" + std::to_string(node));
        figure.skeleton.parents.push_back(parent);
        figure.skeleton.bindModelFromJoint.push_back({quat(1, 0, 0, 0), place});
        figure.skeleton.nodeParentFromJoint.emplace_back();
        figure.skeleton.skinWeight.push_back(static_cast<float>(part.positions.size()));
        figure.meshes.push_back(std::move(part));
        parent = node;
    }
}

}  // namespace

TEST_CASE("a dense sword in a hand is no half of a figure of few corners, and goes on with no arm", "[blocks]") {
    // A figure of blocks without names, each arm of one joint.
    const auto figureWithSword = [](int hand) {
        std::vector<JointSpec> joints{
            {"b0", animation::kNoJoint, vec3(0, 0.8F, 0)}, {"b1", 0, vec3(0, 1.0F, 0)}, {"b2", 1, vec3(0, 1.4F, 0)}};
        std::vector<TubeSpec> tubes{
            {0, vec3(0, 1.0F, 0), 0.15F}, {1, vec3(0, 1.4F, 0), 0.2F}, {2, vec3(0, 1.75F, 0), 0.2F}};
        for (const float side : {1.0F, -1.0F}) {
            const auto add = [&](int parent, const vec3& place, const vec3& end, float radius) {
                joints.push_back({"b" + std::to_string(joints.size()), parent, vec3(side, 1, 1) * place});
                tubes.push_back({static_cast<int>(joints.size()) - 1, vec3(side, 1, 1) * end, radius});
                return static_cast<int>(joints.size()) - 1;
            };
            const int clavicle = add(1, vec3(0, 1.4F, 0), vec3(0.2F, 1.2F, 0), 0.1F);
            add(clavicle, vec3(0.2F, 1.2F, 0), vec3(0.75F, 1.2F, 0), 0.08F);
            add(add(0, vec3(0.12F, 0.8F, 0), vec3(0.12F, 0.4F, 0), 0.08F), vec3(0.12F, 0.4F, 0), vec3(0.12F, 0, 0),
                0.08F);
        }
        animation::Character figure = makeFigure("blocks", joints, tubes);
        if (hand >= 0) giveSword(figure, hand);
        return figure;
    };
    const HumanoidMap plain = animation::mapHumanoid(figureWithSword(-1));
    REQUIRE(plain.humanoid);
    for (const Role arm : {Role::leftUpperArm, Role::rightUpperArm}) {
        INFO(animation::roleName(arm));
        const HumanoidMap map = animation::mapHumanoid(figureWithSword(plain.jointOf(arm)));
        REQUIRE(map.humanoid);
        CHECK(map.jointOf(Role::leftLowerArm) == animation::kNoJoint);
        CHECK(map.jointOf(Role::rightLowerArm) == animation::kNoJoint);
        for (int index = 0; index < animation::kRoleCount; ++index) {
            const auto role = static_cast<Role>(index);
            INFO(animation::roleName(role));
            if (plain.jointOf(role) != animation::kNoJoint) CHECK(map.jointOf(role) == plain.jointOf(role));
        }
    }
}

TEST_CASE("rigid parts whose nodes lie on the other side do not draw their limbs there", "[poses]") {
    // As a modelling program leaves them that mirrored the parts of one half.
    const SyntheticRig named = makeSyntheticRig("vroid", {.armsDown = 1.1F});
    SyntheticRig rig = named;
    rig.character = withoutNames(rig.character);
    animation::Skeleton& skeleton = rig.character.skeleton;
    std::fill(skeleton.skinWeight.begin(), skeleton.skinWeight.end(), 0.0F);
    rig.character.meshes.clear();
    const std::array<Role, 12> limbs{Role::leftUpperArm,  Role::leftLowerArm,  Role::leftHand,      Role::rightUpperArm,
                                     Role::rightLowerArm, Role::rightHand,     Role::leftUpperLeg,  Role::leftLowerLeg,
                                     Role::leftFoot,      Role::rightUpperLeg, Role::rightLowerLeg, Role::rightFoot};
    for (const Role role : limbs) {
        const int joint = jointPlaying(named, role);
        const vec3 place = skeleton.bindModelFromJoint[joint].translation;
        animation::SkinnedMesh part;
        part.rigid = true;
        for (const vec3& corner : {vec3(1, 0, 0), vec3(-1, 0, 0), vec3(0, 1, 1), vec3(0, -1, -1)})
            part.positions.push_back(place + vec3(0, -0.05F, 0) + 0.03F * corner);
        const auto node = static_cast<std::uint16_t>(skeleton.jointCount());
        part.joints.assign(part.positions.size(), std::array<std::uint16_t, 4>{node, 0, 0, 0});
        part.weights.assign(part.positions.size(), std::array<float, 4>{1, 0, 0, 0});
        part.indices = {0, 1, 2, 0, 1, 3};
        skeleton.names.push_back("part_" + std::to_string(node));
        skeleton.parents.push_back(joint);
        skeleton.bindModelFromJoint.push_back({quat(1, 0, 0, 0), vec3(std::abs(place.x) + 0.3F, place.y, place.z)});
        skeleton.nodeParentFromJoint.emplace_back();
        skeleton.skinWeight.push_back(4.0F);
        rig.character.meshes.push_back(std::move(part));
    }
    const HumanoidMap map = animation::mapHumanoid(rig.character);
    REQUIRE(map.humanoid);
    for (const Role role : limbs)
        CHECK(map.jointOf(role) == jointPlaying(named, role));
    CHECK(map.jointOf(Role::head) == jointPlaying(named, Role::head));
}

TEST_CASE("a part of several meshes is where its node is, wherever the smallest of them lies", "[blocks]") {
    animation::Character figure;
    figure.skeleton = makeSkeleton({{"figure", -1, {0, 0, 0}},
                                    {"body", 0, {0, 0.4F, 0}},
                                    {"head", 0, {0, 0.78F, 0}},
                                    {"armLeft", 0, {-0.17F, 0.7F, 0}},
                                    {"armRight", 0, {0.17F, 0.7F, 0}},
                                    {"legLeft", 0, {-0.15F, 0.4F, 0}},
                                    {"legRight", 0, {0.15F, 0.4F, 0}}});
    const auto add = [&](int node, const vec3& low, const vec3& high) {
        animation::SkinnedMesh mesh;
        mesh.rigid = true;
        for (int corner = 0; corner < 8; ++corner)
            mesh.positions.emplace_back((corner & 1) != 0 ? high.x : low.x, (corner & 2) != 0 ? high.y : low.y,
                                        (corner & 4) != 0 ? high.z : low.z);
        mesh.joints.assign(8, std::array<std::uint16_t, 4>{static_cast<std::uint16_t>(node), 0, 0, 0});
        mesh.weights.assign(8, std::array<float, 4>{1, 0, 0, 0});
        mesh.indices = {0, 1, 3, 4, 5, 7};
        figure.skeleton.skinWeight[static_cast<std::size_t>(node)] += 8.0F;
        figure.meshes.push_back(std::move(mesh));
    };
    add(1, {-0.15F, 0.38F, -0.1F}, {0.15F, 0.75F, 0.1F});
    add(2, {-0.2F, 0.78F, -0.2F}, {0.2F, 1.15F, 0.2F});
    for (const float side : {-1.0F, 1.0F}) {
        const auto addBox = [&](int node, float x, float low, float high) {
            add(node, vec3(side * x - 0.05F, low, -0.06F), vec3(side * x + 0.05F, high, 0.06F));
        };
        addBox(side < 0.0F ? 3 : 4, 0.24F, 0.4F, 0.72F);
        addBox(side < 0.0F ? 3 : 4, 0.24F, 0.36F, 0.4F);  // a hand
        addBox(side < 0.0F ? 5 : 6, 0.12F, 0.04F, 0.4F);
        addBox(side < 0.0F ? 5 : 6, 0.12F, 0.0F, 0.04F);  // a shoe, far from the hip
    }
    const HumanoidMap map = animation::mapHumanoid(figure);
    INFO((map.warnings.empty() ? std::string() : map.warnings.front()));
    REQUIRE(map.humanoid);
    CHECK(map.jointOf(Role::head) == 2);
    CHECK(map.jointOf(Role::hips) == 1);
    for (const Role role : {Role::leftUpperArm, Role::leftUpperLeg, Role::rightUpperArm, Role::rightUpperLeg})
        CHECK(map.jointOf(role) >= 3);
}

TEST_CASE("a head that carries the arms is the head, as a plush figure's", "[poses]") {
    std::vector<JointSpec> joints{{"Rig", -1, {0, 0, 0}}, {"DEF-hips", 0, {0, 0.8F, 0}}, {"DEF-head", 1, {0, 0.8F, 0}}};
    std::vector<TubeSpec> tubes{{1, {0, 0.6F, 0}, 0.3F}, {2, {0, 1.4F, 0}, 0.45F}};
    const auto add = [&](const std::string& name, int parent, const vec3& place, const vec3& end, float radius) {
        joints.push_back({name, parent, place});
        tubes.push_back({static_cast<int>(joints.size()) - 1, end, radius});
        return static_cast<int>(joints.size()) - 1;
    };
    for (const float side : {1.0F, -1.0F}) {
        const std::string end = side > 0.0F ? ".L" : ".R";
        const auto at = [&](float x, float y, float z = 0.0F) { return vec3(side * x, y, z); };
        const int arm = add("DEF-upper_arm" + end, 2, at(0.52F, 0.82F), at(0.64F, 0.73F), 0.05F);
        const int forearm = add("DEF-forearm" + end, arm, at(0.65F, 0.73F), at(0.75F, 0.65F), 0.05F);
        add("DEF-hand" + end, forearm, at(0.76F, 0.65F), at(0.9F, 0.55F), 0.1F);
        const int thigh = add("DEF-thigh" + end, 1, at(0.19F, 0.54F), at(0.19F, 0.39F), 0.08F);
        const int shin = add("DEF-shin" + end, thigh, at(0.19F, 0.38F), at(0.19F, 0.19F), 0.08F);
        add("DEF-foot" + end, shin, at(0.19F, 0.18F, -0.01F), at(0.19F, 0.02F, 0.15F), 0.1F);
    }
    const animation::Character plush = makeFigure("plush", joints, tubes);
    const HumanoidMap map = animation::mapHumanoid(plush);
    REQUIRE(map.humanoid);
    CHECK(map.missing.empty());
    CHECK(plush.skeleton.names[map.jointOf(Role::hips)] == "DEF-hips");
    CHECK(plush.skeleton.names[map.jointOf(Role::head)] == "DEF-head");
    CHECK(plush.skeleton.names[map.jointOf(Role::leftLowerArm)] == "DEF-forearm.L");
    CHECK(plush.skeleton.names[map.jointOf(Role::rightHand)] == "DEF-hand.R");
}

TEST_CASE("tentacles of hundreds of joints are looked through in no time", "[poses]") {
    std::vector<JointSpec> joints{{"root", -1, {0, 0, 0}}};
    for (int arm = 0; arm < 8; ++arm) {
        const float angle = static_cast<float>(arm) * kPi / 4.0F;
        int parent = 0;
        for (int link = 1; link <= 100; ++link) {
            const float out = 0.02F * static_cast<float>(link);
            joints.push_back({"link_" + std::to_string(joints.size()), parent,
                              vec3(out * std::cos(angle), out, out * std::sin(angle))});
            parent = static_cast<int>(joints.size()) - 1;
        }
    }
    animation::Character tentacles;
    tentacles.skeleton = makeSkeleton(joints);
    CHECK_FALSE(animation::mapHumanoid(tentacles).humanoid);
}

TEST_CASE("a forearm that hangs on the other arm is still that forearm, and nothing is lost beside it", "[poses]") {
    const animation::Character sound = makeBiped();
    const HumanoidMap whole = animation::mapHumanoid(sound);
    REQUIRE(whole.missing.empty());
    const std::pair<Role, Role> strays[] = {{Role::rightLowerArm, Role::leftLowerArm},
                                            {Role::rightHand, Role::leftHand},
                                            {Role::rightLowerLeg, Role::leftUpperLeg},
                                            {Role::rightUpperLeg, Role::leftUpperLeg}};
    for (const auto& [role, on] : strays) {
        INFO(animation::roleName(role) << " on " << animation::roleName(on));
        animation::Character character = sound;
        character.skeleton.parents[whole.jointOf(role)] = whole.jointOf(on);
        const HumanoidMap map = animation::mapHumanoid(character);
        REQUIRE(map.humanoid);
        CHECK(map.missing.empty());
        for (int index = 0; index < animation::kRoleCount; ++index) {
            if (isRequired(animation::roleAt(index)))
                CHECK(map.jointOf(animation::roleAt(index)) == whole.jointOf(animation::roleAt(index)));
        }
        CHECK(map.confidence < whole.confidence);
        REQUIRE(map[role]);
        CHECK(map[role]->confidence < whole[role]->confidence);
    }
}

TEST_CASE("forearms and shins of two segments begin at the elbow and the knee, whatever the second is called",
          "[poses]") {
    for (const char* second : {"_seg", "_b", "2", "_extra_01"}) {
        for (const float bend : {0.0F, 0.05F, 0.1F}) {
            INFO(second << " bent by " << bend);
            std::vector<JointSpec> joints{{"pelvis", animation::kNoJoint, vec3(0, 0.9F, 0)},
                                          {"spine", 0, vec3(0, 1.1F, 0)},
                                          {"chest", 1, vec3(0, 1.25F, 0)},
                                          {"head", 2, vec3(0, 1.5F, 0)}};
            std::vector<TubeSpec> tubes{{0, vec3(0, 1.1F, 0), 0.15F},
                                        {1, vec3(0, 1.25F, 0), 0.15F},
                                        {2, vec3(0, 1.45F, 0), 0.16F},
                                        {3, vec3(0, 1.75F, 0), 0.1F}};
            for (const float side : {1.0F, -1.0F}) {
                const std::string end = side > 0.0F ? "_l" : "_r";
                const auto add = [&](const std::string& name, int parent, const vec3& place, const vec3& to) {
                    joints.push_back({name, parent, vec3(side, 1, 1) * place});
                    tubes.push_back({static_cast<int>(joints.size()) - 1, vec3(side, 1, 1) * to, 0.05F});
                    return static_cast<int>(joints.size()) - 1;
                };
                const vec3 wrist(0.77F, 1.4F - bend, 0);
                const vec3 ankle(0.1F, 0.08F, -bend);
                const int arm = add("upperarm" + end, 2, vec3(0.2F, 1.4F, 0), vec3(0.48F, 1.4F, 0));
                const int forearm = add("lowerarm" + end, arm, vec3(0.48F, 1.4F, 0), vec3(0.62F, 1.4F, 0));
                const int far = add("lowerarm" + end + second, forearm, vec3(0.62F, 1.4F, 0), wrist);
                add("hand" + end, far, wrist, wrist + vec3(0.15F, -bend, 0));
                const int thigh = add("thigh" + end, 0, vec3(0.1F, 0.88F, 0), vec3(0.1F, 0.48F, 0));
                const int shin = add("calf" + end, thigh, vec3(0.1F, 0.48F, 0), vec3(0.1F, 0.28F, 0));
                const int low = add("calf" + end + second, shin, vec3(0.1F, 0.28F, 0), ankle);
                add("foot" + end, low, ankle, ankle + vec3(0, -0.06F, 0.16F));
            }
            const animation::Character figure = makeFigure("segments", joints, tubes);
            const HumanoidMap map = animation::mapHumanoid(figure);
            REQUIRE(map.humanoid);
            CHECK(map.missing.empty());
            const auto nameOfRole = [&](Role role) { return figure.skeleton.names[map.jointOf(role)]; };
            CHECK(nameOfRole(Role::leftLowerArm) == "lowerarm_l");
            CHECK(nameOfRole(Role::rightHand) == "hand_r");
            CHECK(nameOfRole(Role::rightLowerLeg) == "calf_r");
            CHECK(nameOfRole(Role::leftFoot) == "foot_l");
        }
    }
}

TEST_CASE("a head that starts where the clavicles do is no end marker of theirs", "[blocks]") {
    // A squat creature of few joints: clavicles and head all start in one point at the top of the spine.
    std::vector<JointSpec> joints{{"Armature", -1, {0, 0, 0}},
                                  {"Bone", 0, {0, 0.44F, 0}},
                                  {"Bone.002", 1, {0, 0.86F, 0}},
                                  {"Bone.003", 0, {0, 0.44F, 0}}};
    for (const float side : {1.0F, -1.0F}) {
        const auto add = [&](int parent, const vec3& place) {
            joints.push_back({"Bone." + std::to_string(joints.size()), parent, vec3(side, 1, 1) * place});
            return static_cast<int>(joints.size()) - 1;
        };
        const int arm = add(add(1, {0, 0.86F, 0}), {0.28F, 0.83F, 0});
        const int hand = add(add(arm, {0.34F, 0.57F, 0}), {0.44F, 0.32F, 0});
        add(hand, {0.27F, 0.29F, 0});
        add(add(add(0, {0, 0.44F, 0}), {0.15F, 0.38F, 0}), {0.15F, 0.22F, 0});
    }
    std::vector<TubeSpec> skin{{1, {0, 0.86F, 0}, 0.2F}, {2, {0, 1.1F, 0.05F}, 0.16F}, {3, {0, 0.4F, -0.4F}, 0.05F}};
    for (std::size_t joint = 4; joint < joints.size(); ++joint) {
        vec3 end = joints[joint].position * vec3(1, 0.1F, 1);
        for (const JointSpec& child : joints) {
            if (child.parent == static_cast<int>(joint)) end = child.position;
        }
        skin.push_back({static_cast<int>(joint), end, 0.06F});
    }
    const animation::Character figure = makeFigure("squat", joints, skin);
    const HumanoidMap map = animation::mapHumanoid(figure);
    REQUIRE(map.humanoid);
    CHECK(map.jointOf(Role::head) == 2);
    CHECK(map[Role::leftUpperArm]);
    CHECK(map[Role::leftLowerLeg]);
}

TEST_CASE("joints of a face that hang on the root tell which joint is the head", "[blocks]") {
    SyntheticRig rig = makeSyntheticRig("rigify deforming joints");
    animation::Skeleton& skeleton = rig.character.skeleton;
    const auto weigh = [&](const char* joint, float vertices) {
        skeleton.skinWeight[animation::findJoint(skeleton, joint)] = vertices;
    };
    // Most of the head's skin is the face's, so that the joint below moves more than the head itself does.
    weigh("DEF-spine.005", 660);
    weigh("DEF-spine.006", 150);
    const int head = animation::findJoint(skeleton, "DEF-spine.006");
    for (int number = 0; number < skeleton.jointCount(); ++number) {
        std::string& name = skeleton.names[number];
        if (name.starts_with("DEF-spine")) name = "joint" + std::to_string(number);
    }
    CHECK(animation::mapHumanoid(rig.character).jointOf(Role::head) == head);
}

TEST_CASE("arms and thighs of two joints side by side begin at the pivot", "[blocks]") {
    SyntheticRig rig = makeSyntheticRig("daz genesis 8");
    animation::Skeleton& skeleton = rig.character.skeleton;
    const std::vector<std::string> known = skeleton.names;
    for (const std::string side : {"l", "r"}) {
        const auto joint = [&](const char* part) { return animation::findJoint(skeleton, side + part); };
        const std::pair<int, const char*> fresh[] = {{joint("Collar"), "shoulder."},
                                                     {joint("ShldrBend"), "arm_twist."},
                                                     {joint("ShldrTwist"), "arm_stretch."},
                                                     {joint("ForearmBend"), "forearm_stretch."},
                                                     {joint("ForearmTwist"), "forearm_twist."},
                                                     {joint("Hand"), "hand."},
                                                     {joint("ThighBend"), "thigh_twist."},
                                                     {joint("ThighTwist"), "thigh_stretch."},
                                                     {joint("Shin"), "leg_stretch."},
                                                     {joint("Foot"), "foot."}};
        for (const auto& [half, pivot] : {std::pair("ShldrTwist", "ShldrBend"), std::pair("ThighTwist", "ThighBend")})
            skeleton.parents[joint(half)] = skeleton.parents[joint(pivot)];
        for (const auto& [index, name] : fresh)
            skeleton.names[index] = name + side;
    }
    const Score score = scoreMap(rig.truth, animation::mapHumanoid(rig.character), known);
    INFO(score.faults);
    CHECK(score.right == score.of);
}

TEST_CASE("where fingers hang on the forearm and start apart, none of them is the hand", "[blocks]") {
    for (const bool apart : {true, false}) {
        INFO((apart ? "apart" : "all at the wrist"));
        SyntheticRig rig = makeSyntheticRig("xsens");
        animation::Skeleton& skeleton = rig.character.skeleton;
        const int thumb = jointPlaying(rig, Role::leftHand);
        for (const Role role : {Role::leftHand, Role::rightHand}) {
            const int hand = jointPlaying(rig, role);
            const std::string side = role == Role::leftHand ? ".L" : ".R";
            skeleton.names[hand] = "Thumb_1" + side;
            for (int finger = 1; finger < 3; ++finger) {
                RigidTransform place = skeleton.bindModelFromJoint[hand];
                if (apart) place.translation.z += 0.08F * static_cast<float>(finger);
                skeleton.names.push_back("Finger_" + std::to_string(finger) + "_1" + side);
                skeleton.parents.push_back(skeleton.parents[hand]);
                skeleton.bindModelFromJoint.push_back(place);
                skeleton.nodeParentFromJoint.emplace_back();
                skeleton.skinWeight.push_back(5);
            }
        }
        const HumanoidMap map = animation::mapHumanoid(rig.character);
        REQUIRE(map.humanoid);
        CHECK(map[Role::leftLowerArm]);
        // The one that moves the palm stands for the hand.
        CHECK(map.jointOf(Role::leftHand) == (apart ? animation::kNoJoint : thumb));
    }
}

}  // namespace lutka::test
