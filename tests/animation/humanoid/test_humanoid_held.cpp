#include <string>
#include <vector>

#include "animation/humanoid/map_humanoid.hpp"
#include "support/catch.hpp"
#include "support/rigs.hpp"

// What figures hold and wear, and what else hangs where no part of a body does.
namespace lutka::test {
namespace {

using animation::HumanoidMap;
using animation::Role;

// A figure whose joints are added one by one, each with a box: of skin, or rigid on a node of its own.
struct BoxFigure {
    std::vector<JointSpec> joints;
    animation::Character figure;

    int add(const std::string& name, int parent, const vec3& place) {
        joints.push_back({name, parent, place});
        return static_cast<int>(joints.size()) - 1;
    }

    void box(int joint, const vec3& low, const vec3& high, bool rigid) {
        animation::SkinnedMesh mesh;
        mesh.rigid = rigid;
        for (int corner = 0; corner < 8; ++corner)
            mesh.positions.emplace_back((corner & 1) != 0 ? high.x : low.x, (corner & 2) != 0 ? high.y : low.y,
                                        (corner & 4) != 0 ? high.z : low.z);
        mesh.joints.assign(8, {static_cast<std::uint16_t>(joint), 0, 0, 0});
        mesh.weights.assign(8, {1, 0, 0, 0});
        mesh.indices = {0, 1, 2};
        figure.meshes.push_back(std::move(mesh));
    }

    // A joint whose skin is a box around it, down or up to a height.
    int addSkinned(const std::string& name, int parent, const vec3& place, float end, float half) {
        const int joint = add(name, parent, place);
        const vec3 aside(half, 0, half);
        vec3 other = place;
        other.y = end;
        box(joint, glm::min(place, other) - aside, glm::max(place, other) + aside, false);
        return joint;
    }

    // A rigid box below a group.
    int addRigid(const std::string& name, int parent, const vec3& place, const vec3& low, const vec3& high) {
        const int joint = add(name, parent, place);
        box(joint, low, high, true);
        return joint;
    }

    HumanoidMap map() {
        figure.skeleton = makeSkeleton(joints);
        figure.skeleton.skinWeight.assign(joints.size(), 0.0F);
        for (const animation::SkinnedMesh& mesh : figure.meshes)
            figure.skeleton.skinWeight[mesh.joints.front()[0]] += 8.0F;
        HumanoidMap map = animation::mapHumanoid(figure);
        INFO((map.warnings.empty() ? std::string() : map.warnings.front()));
        REQUIRE(map.humanoid);
        return map;
    }

    [[nodiscard]] std::string nameOf(const HumanoidMap& map, Role role) const {
        const int joint = map.jointOf(role);
        return joint == animation::kNoJoint ? "none" : joints[static_cast<std::size_t>(joint)].name;
    }
};

}  // namespace

TEST_CASE("a sword that is weighted to an arm's own joint lengthens no arm, nor does a shield", "[held]") {
    // No word tells the limbs.
    BoxFigure rig;
    const int hips = rig.addSkinned("body_down", -1, {0, 1.3F, 0}, 1.95F, 0.35F);
    const int chest = rig.addSkinned("body_up", hips, {0, 2.0F, 0}, 2.5F, 0.4F);
    rig.addSkinned("head", chest, {0, 2.5F, 0}, 3.2F, 0.35F);
    for (const float side : {1.0F, -1.0F}) {
        const std::string start = side > 0.0F ? "l_" : "r_";
        const int upper = rig.addSkinned(start + "u", chest, {side * 0.7F, 2.43F, 0}, 1.95F, 0.15F);
        const int lower = rig.addSkinned(start + "d", upper, {side * 0.7F, 1.93F, 0}, 1.4F, 0.15F);
        if (side > 0.0F) {
            rig.box(lower, {0.65F, 0.0F, 0.2F}, {0.75F, 1.4F, 0.3F}, false);
        } else {
            rig.addSkinned("shield", lower, {-0.82F, 2.4F, 0.5F}, 0.3F, 0.05F);
        }
        const int thigh = rig.addSkinned(start + "l_u", hips, {side * 0.25F, 1.25F, 0}, 0.7F, 0.2F);
        rig.addSkinned(start + "l_d", thigh, {side * 0.25F, 0.67F, 0}, 0.0F, 0.2F);
    }
    const HumanoidMap map = rig.map();
    CHECK(rig.nameOf(map, Role::leftUpperArm) == "l_u");
    CHECK(rig.nameOf(map, Role::leftLowerArm) == "l_d");
    CHECK(rig.nameOf(map, Role::rightUpperArm) == "r_u");
    CHECK(rig.nameOf(map, Role::rightLowerArm) == "r_d");
    CHECK(rig.nameOf(map, Role::leftUpperLeg) == "l_l_u");
    CHECK(rig.nameOf(map, Role::rightLowerLeg) == "r_l_d");
}

TEST_CASE("the blocks of weapons are no limbs, and legs that turn about one point have their sides", "[held][blocks]") {
    // It faces -Z. Of what it wears each part lies beside the part's own mesh.
    BoxFigure rig;
    const int torso = rig.add("Torso", rig.add("Body", -1, {0, 0, 0}), {0, 1.06F, 0});
    rig.addRigid("Torso", torso, {0, 0, 0}, {-0.25F, 0.75F, -0.12F}, {0.25F, 1.5F, 0.12F});
    const int head = rig.add("Head", torso, {0, 1.8F, -0.05F});
    rig.addRigid("Head", head, {0, 0, 0}, {-0.25F, 1.5F, -0.3F}, {0.25F, 2.0F, 0.2F});
    const int arms = rig.add("Arms", torso, {0, 1.5F, 0});
    const int weapon = rig.add("Weapon", arms, {0, 1.37F, 0.2F});
    for (const char* name : {"Rifle", "Mossberg"}) {
        const int gun = rig.add(name, weapon, {0, 1.3F, 0.25F});
        for (int part = 0; part < 6; ++part) {
            for (const float side : {1.0F, -1.0F}) {
                const vec3 place(side * (0.04F + 0.01F * static_cast<float>(part % 3)),
                                 0.6F + 0.2F * static_cast<float>(part), 0.24F);
                rig.addRigid("cube_Mesh_" + std::to_string(part), gun, place, place - vec3(0.03F), place + vec3(0.03F));
            }
        }
    }
    const int legs = rig.add("Legs", torso, {0, 0.75F, 0});
    for (const float side : {-1.0F, 1.0F}) {
        const std::string start = side < 0.0F ? "Left" : "Right";
        const int arm = rig.add(start + "Arm", arms, {side * 0.31F, 1.44F, 0});
        for (const char* end : {"Arm", "ArmWear"})
            rig.addRigid(start + end, arm, {0, 0, 0}, {side * 0.37F - 0.12F, 0.75F, -0.12F},
                         {side * 0.37F + 0.12F, 1.5F, 0.12F});
        const int leg = rig.add(start + "Leg", legs, {0, 0.75F, 0});
        for (const char* end : {"Leg", "LegWear"})
            rig.addRigid(start + end, leg, {0, 0, 0}, {side * 0.125F - 0.12F, 0, -0.12F},
                         {side * 0.125F + 0.12F, 0.75F, 0.12F});
    }
    const HumanoidMap map = rig.map();
    CHECK(rig.nameOf(map, Role::head) == "Head");
    for (const auto& [role, name] :
         {std::pair{Role::leftUpperArm, "LeftArm"}, std::pair{Role::rightUpperArm, "RightArm"},
          std::pair{Role::leftUpperLeg, "LeftLeg"}, std::pair{Role::rightUpperLeg, "RightLeg"},
          std::pair{Role::leftLowerArm, "none"}, std::pair{Role::leftLowerLeg, "none"}})
        CHECK(rig.nameOf(map, role) == name);
}

TEST_CASE("copies of a skeleton are no chain, and an arm that is held is no leg", "[held][blocks]") {
    // One skeleton for each mesh of the file; its arms are crossed and hang on one joint.
    BoxFigure rig;
    const int root = rig.add("ROOT", -1, {0, 0, 0});
    for (const char* mesh : {"mob_nose", "mob_hat", "mob_bow"}) {
        const bool first = std::string(mesh) == "mob_nose";
        const auto add = [&](const std::string& name, int parent, const vec3& place, float end, float half) {
            return first ? rig.addSkinned(name, parent, place, end, half) : rig.add(name, parent, place);
        };
        const int body = add("body", rig.add(mesh, root, {0, 0, 0}), {0, 0.6F, 0}, 1.2F, 0.22F);
        add("head", body, {0, 1.21F, 0}, 1.75F, 0.22F);
        add("arm", body, {0, 1.1F, 0}, 0.8F, 0.4F);
        for (const float side : {1.0F, -1.0F}) {
            const std::string end = side > 0.0F ? ".right" : ".left";
            add("magic.arm" + end, body, {side * 0.11F, 0.62F, 0}, 0.3F, 0.1F);
            add("leg" + end, body, {side * 0.1F, 0.55F, 0}, 0.0F, 0.1F);
        }
    }
    const HumanoidMap map = rig.map();
    CHECK(rig.nameOf(map, Role::leftUpperLeg) == "leg.left");
    CHECK(rig.nameOf(map, Role::rightUpperLeg) == "leg.right");
    CHECK(rig.nameOf(map, Role::leftLowerLeg) == "none");
    CHECK(rig.nameOf(map, Role::head) == "head");
}

TEST_CASE("what a leg wears is no shin", "[held][blocks]") {
    BoxFigure rig;
    const int body = rig.add("body", -1, {0, 0.85F, 0});
    rig.addRigid("cube", body, {0, 1.1F, 0}, {-0.2F, 0.8F, -0.1F}, {0.2F, 1.35F, 0.1F});
    const int head = rig.add("head", rig.add("neck", body, {0, 1.36F, 0}), {0, 1.46F, 0});
    rig.addRigid("cube", head, {0, 1.6F, 0}, {-0.18F, 1.45F, -0.18F}, {0.18F, 1.8F, 0.18F});
    const int arms = rig.add("arms", body, {0, 1.32F, 0});
    const int legs = rig.add("legs", body, {0, 0.83F, 0});
    for (const float side : {1.0F, -1.0F}) {
        const std::string end = side > 0.0F ? "_left" : "_right";
        const auto boxOf = [&](int joint, float x, float low, float high) {
            rig.addRigid("cube", joint, {side * x, 0.5F * (low + high), 0}, {side * x - 0.08F, low, -0.1F},
                         {side * x + 0.08F, high, 0.1F});
        };
        const int arm = rig.add("arm" + end, arms, {side * 0.28F, 1.32F, 0});
        boxOf(arm, 0.28F, 0.75F, 1.35F);
        const int leg = rig.add("leg" + end, legs, {side * 0.09F, 0.83F, 0});
        boxOf(leg, 0.09F, 0.0F, 0.83F);
        boxOf(rig.add("robe" + end, leg, {side * 0.09F, 0.6F, 0}), 0.09F, 0.3F, 0.6F);
    }
    const HumanoidMap map = rig.map();
    CHECK(rig.nameOf(map, Role::leftUpperLeg) == "leg_left");
    CHECK(rig.nameOf(map, Role::leftLowerLeg) == "none");
    CHECK(rig.nameOf(map, Role::rightLowerLeg) == "none");
    CHECK(rig.nameOf(map, Role::leftUpperArm) == "arm_left");
}

TEST_CASE("legs that a file hangs on an arm by mistake are the figure's", "[held]") {
    const animation::Character sound = makeBiped();
    const HumanoidMap whole = animation::mapHumanoid(sound);
    REQUIRE(whole.missing.empty());
    for (const Role on : {Role::leftUpperArm, Role::rightLowerArm, Role::leftHand}) {
        INFO(animation::roleName(on));
        animation::Character character = sound;
        for (const Role leg : {Role::leftUpperLeg, Role::rightUpperLeg})
            character.skeleton.parents[whole.jointOf(leg)] = whole.jointOf(on);
        const HumanoidMap map = animation::mapHumanoid(character);
        INFO((map.warnings.empty() ? std::string() : map.warnings.front()));
        REQUIRE(map.humanoid);
        for (int index = 0; index < animation::kRoleCount; ++index) {
            if (isRequired(animation::roleAt(index)))
                CHECK(map.jointOf(animation::roleAt(index)) == whole.jointOf(animation::roleAt(index)));
        }
        CHECK(map.confidence < whole.confidence);
        REQUIRE(map[Role::leftUpperLeg]);
        CHECK(map[Role::leftUpperLeg]->confidence < whole[Role::leftUpperLeg]->confidence);
    }
}

TEST_CASE("hands and feet that float beside a body are refused with that reason", "[held][refusal]") {
    // In a pose, as the idle clip has them; it faces +X.
    std::vector<JointSpec> joints{{"Armature", -1, {0, 0.31F, 0}},
                                  {"Body", 0, {0, 0.41F, 0}},
                                  {"Head", 1, {0, 0.86F, 0}},
                                  {"Hand_left", 1, {0.55F, 0.79F, -0.13F}},
                                  {"Hand_right", 1, {0.34F, 0.73F, 0.13F}},
                                  {"Foot_left", 0, {-0.09F, 0.14F, -0.15F}},
                                  {"Foot_right", 0, {-0.09F, 0.14F, 0.15F}}};
    std::vector<TubeSpec> skin{{1, {0, 0.85F, 0}, 0.25F}, {2, {0, 1.6F, 0}, 0.3F}};
    for (const int hand : {3, 4})
        skin.push_back({hand, joints[static_cast<std::size_t>(hand)].position + vec3(0.12F, 0, 0), 0.08F});
    for (const int foot : {5, 6})
        skin.push_back({foot, joints[static_cast<std::size_t>(foot)].position + vec3(0.2F, -0.1F, 0), 0.08F});
    const HumanoidMap map = animation::mapHumanoid(makeFigure("chef", joints, skin));
    REQUIRE_FALSE(map.humanoid);
    CHECK(map.warnings.front().find("hang on no arms and legs") != std::string::npos);
}

}  // namespace lutka::test
