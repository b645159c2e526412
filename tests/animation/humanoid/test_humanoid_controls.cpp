// Rigs that hold their controls beside the joints that move the skin.

#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "animation/humanoid/map_humanoid.hpp"
#include "support/catch.hpp"
#include "support/rigs.hpp"

namespace lutka::test {
namespace {

using animation::HumanoidMap;
using animation::Role;

// A rig by the names of its joints; '@' stands for the side, and makes two joints of one.
class NamedRig {
  public:
    void add(const std::string& name, const std::string& parent, const vec3& place) {
        if (name.find('@') == std::string::npos) return addOne(name, parent, place);
        addOne(onSide(name, "l"), onSide(parent, "l"), place);
        addOne(onSide(name, "r"), onSide(parent, "r"), place * vec3(-1, 1, 1));
    }

    // The same with a tube of skin up to `end`.
    void add(const std::string& name, const std::string& parent, const vec3& place, const vec3& end, float radius) {
        add(name, parent, place);
        if (name.find('@') == std::string::npos) {
            skin_.push_back({indexOf_.at(name), end, radius});
        } else {
            skin_.push_back({indexOf_.at(onSide(name, "l")), end, radius});
            skin_.push_back({indexOf_.at(onSide(name, "r")), end * vec3(-1, 1, 1), radius});
        }
    }

    [[nodiscard]] HumanoidMap map() const { return animation::mapHumanoid(makeFigure("figure", joints_, skin_)); }

    [[nodiscard]] std::string nameOf(const HumanoidMap& map, Role role) const {
        const int joint = map.jointOf(role);
        return joint == animation::kNoJoint ? "none" : joints_[static_cast<std::size_t>(joint)].name;
    }

  private:
    static std::string onSide(std::string name, const char* side) {
        const std::size_t at = name.find('@');
        return at == std::string::npos ? name : name.replace(at, 1, side);
    }

    void addOne(const std::string& name, const std::string& parent, const vec3& place) {
        indexOf_[name] = static_cast<int>(joints_.size());
        joints_.push_back({name, parent.empty() ? -1 : indexOf_.at(parent), place});
    }

    std::vector<JointSpec> joints_;
    std::vector<TubeSpec> skin_;
    std::map<std::string, int> indexOf_;
};

constexpr vec3 kHip{0.1F, 0.92F, 0};
constexpr vec3 kKnee{0.1F, 0.5F, 0.01F};
constexpr vec3 kAnkle{0.1F, 0.08F, -0.02F};
constexpr vec3 kShoulder{0.18F, 1.42F, 0};
constexpr vec3 kElbow{0.46F, 1.42F, -0.01F};
constexpr vec3 kWrist{0.72F, 1.42F, 0};

}  // namespace

TEST_CASE("a foot that hangs on its control as a leaf is the foot, not the control in its place", "[controls]") {
    NamedRig rig;
    rig.add("root", "", {0, 0, 0});
    rig.add("torso", "root", {0, 0.95F, 0}, {0, 1.45F, 0}, 0.14F);
    rig.add("hips", "torso", {0, 0.95F, 0}, {0, 0.85F, 0}, 0.14F);
    rig.add("upperleg.@", "hips", kHip, kKnee, 0.07F);
    rig.add("lowerleg.@", "upperleg.@", kKnee, kAnkle, 0.05F);
    rig.add("neck", "torso", {0, 1.5F, 0}, {0, 1.58F, 0}, 0.05F);
    rig.add("head", "neck", {0, 1.58F, 0}, {0, 1.78F, 0}, 0.09F);
    rig.add("upperarm.@", "torso", kShoulder, kElbow, 0.05F);
    rig.add("lowerarm.@", "upperarm.@", kElbow, kWrist, 0.04F);
    rig.add("hand.@", "lowerarm.@", kWrist, kWrist + vec3(0.15F, 0, 0), 0.04F);
    rig.add("foot_IK.@", "root", kAnkle);
    rig.add("foot.@", "foot_IK.@", kAnkle, {0.1F, 0.03F, 0.15F}, 0.05F);
    rig.add("knee.@", "foot_IK.@", kKnee + vec3(0, 0, 0.4F));
    const HumanoidMap map = rig.map();
    REQUIRE(map.humanoid);
    CHECK(rig.nameOf(map, Role::leftFoot) == "foot.l");
    CHECK(rig.nameOf(map, Role::rightFoot) == "foot.r");
    CHECK(rig.nameOf(map, Role::leftLowerLeg) == "lowerleg.l");
}

TEST_CASE("what a leg's control points at is no knee of a leg without one", "[controls]") {
    NamedRig rig;
    rig.add("root", "", {0, 0, 0});
    rig.add("Control", "root", {0, 0.02F, 0.1F});
    rig.add("@_Knee", "Control", {0.12F, 0.33F, 0.64F});
    rig.add("@_Elbow", "Control", {0.36F, 1.03F, 0.38F});
    rig.add("Hip", "Control", {0, 0.3F, 0.07F}, {0, 0.6F, 0.02F}, 0.25F);
    rig.add("Chest", "Hip", {0, 0.65F, 0.02F}, {0, 1.2F, 0.03F}, 0.25F);
    rig.add("Head", "Chest", {0, 1.44F, 0.07F}, {0, 1.7F, 0.1F}, 0.2F);
    rig.add("@_Upper_Arm", "Hip", {0.38F, 1.09F, 0}, {0.67F, 0.94F, 0}, 0.09F);
    rig.add("@_Lower_Arm", "@_Upper_Arm", {0.67F, 0.94F, 0}, {0.86F, 0.77F, 0}, 0.08F);
    rig.add("@_Hand", "@_Lower_Arm", {0.86F, 0.77F, 0}, {1.0F, 0.63F, 0}, 0.08F);
    rig.add("@_Thigh", "Hip", {0.22F, 0.29F, 0}, {0.22F, 0.06F, 0}, 0.14F);
    rig.add("@_Foot", "@_Thigh", {0.22F, 0.05F, 0}, {0.22F, 0.03F, 0.2F}, 0.1F);
    const HumanoidMap map = rig.map();
    REQUIRE(map.humanoid);
    CHECK(rig.nameOf(map, Role::leftLowerLeg) == "none");
    CHECK(rig.nameOf(map, Role::rightLowerLeg) == "none");
    CHECK(rig.nameOf(map, Role::leftFoot) == "l_Foot");
    CHECK(rig.nameOf(map, Role::rightLowerArm) == "r_Lower_Arm");
    for (const std::string& word : map.warnings)
        CHECK(word.find("only a part of the figure has skin") == std::string::npos);
}

TEST_CASE("what a leg starts at is no foot of it", "[controls]") {
    NamedRig rig;
    rig.add("root", "", {0, 0, 0});
    rig.add("leg_@.003", "root", {0.2F, 0.01F, 0.07F});
    rig.add("hips", "root", {0, 0.41F, 0});
    rig.add("core", "hips", {0, 0.41F, 0}, {0, 0.5F, 0.05F}, 0.15F);
    rig.add("core.001", "core", {0, 0.5F, 0.07F}, {0, 0.64F, 0.1F}, 0.17F);
    rig.add("core.002", "core.001", {0, 0.64F, 0.13F}, {0, 0.8F, 0.15F}, 0.2F);
    rig.add("head", "core.002", {0, 0.86F, 0.18F}, {0, 0.74F, 0.4F}, 0.12F);
    rig.add("arm_@", "core.002", {0, 0.86F, 0.18F}, {0.29F, 0.85F, 0.14F}, 0.1F);
    rig.add("arm_@.001", "arm_@", {0.29F, 0.85F, 0.14F}, {0.51F, 0.64F, 0}, 0.1F);
    rig.add("arm_@.002", "arm_@.001", {0.51F, 0.64F, 0}, {0.6F, 0.35F, 0}, 0.1F);
    rig.add("leg_@", "hips", {0, 0.41F, 0}, {0.15F, 0.4F, 0}, 0.08F);
    rig.add("leg_@.001", "leg_@", {0.15F, 0.4F, 0}, {0.2F, 0.24F, 0.07F}, 0.08F);
    rig.add("leg_@.002", "leg_@.001", {0.2F, 0.24F, 0.07F}, {0.2F, 0.03F, 0.07F}, 0.08F);
    const HumanoidMap map = rig.map();
    REQUIRE(map.humanoid);
    CHECK(rig.nameOf(map, Role::leftUpperLeg) == "leg_l.001");
    CHECK(rig.nameOf(map, Role::leftLowerLeg) == "leg_l.002");
    CHECK(rig.nameOf(map, Role::leftFoot) == "none");
    CHECK(rig.nameOf(map, Role::rightFoot) == "none");
}

TEST_CASE("hips are no pair with the control in their place, whatever hangs on either", "[controls]") {
    NamedRig rig;
    rig.add("RootNode", "", {0, 0, 0});
    rig.add("Rig_Reference", "RootNode", {0, 0, 0});
    rig.add("Rig_Hips", "Rig_Reference", {0, 0.9F, 0.1F}, {0, 0.85F, 0}, 0.14F);
    rig.add("Rig_Spine", "Rig_Hips", {0, 1.0F, 0.04F});
    rig.add("Rig_Spine1", "Rig_Spine", {0, 1.1F, 0.01F}, {0, 1.2F, 0}, 0.12F);
    rig.add("Rig_Spine2", "Rig_Spine1", {0, 1.25F, 0}, {0, 1.45F, 0}, 0.15F);
    rig.add("Rig_Neck", "Rig_Spine2", {0, 1.5F, 0}, {0, 1.58F, 0}, 0.05F);
    rig.add("Rig_Head", "Rig_Neck", {0, 1.58F, 0}, {0, 1.78F, 0}, 0.09F);
    rig.add("Rig_@_Arm", "Rig_Spine2", kShoulder, kElbow, 0.05F);
    rig.add("Rig_@_ForeArm", "Rig_@_Arm", kElbow, kWrist, 0.04F);
    rig.add("Rig_@_Hand", "Rig_@_ForeArm", kWrist, kWrist + vec3(0.15F, 0, 0), 0.04F);
    rig.add("Rig_@_UpLeg", "Rig_Hips", kHip, kKnee, 0.07F);
    rig.add("Rig_@_Leg", "Rig_@_UpLeg", kKnee, kAnkle, 0.05F);
    rig.add("Rig_@_Foot", "Rig_@_Leg", kAnkle, {0.1F, 0.03F, 0.15F}, 0.05F);
    rig.add("Rig_r_Hand_tip", "Rig_r_Hand", {-0.9F, 1.42F, 0});
    // Of the controls' copy only the first two joints were saved in their places.
    rig.add("Rig_Ctrl_Reference", "RootNode", {0, 0, 0});
    rig.add("Rig_Ctrl_Hips", "Rig_Ctrl_Reference", {0, 0.9F, 0.1F});
    const vec3 lost(0.2F, 1.0F, 0.0F);
    const auto copy = [&](const std::string& name, const std::string& parent) {
        rig.add("Rig_Ctrl_" + name, "Rig_Ctrl_" + parent, lost);
    };
    for (const char* side : {"l_", "r_"}) {
        copy(std::string(side) + "UpLeg", "Hips");
        copy(std::string(side) + "Leg", std::string(side) + "UpLeg");
        copy(std::string(side) + "Foot", std::string(side) + "Leg");
    }
    copy("Spine", "Hips");
    copy("Spine1", "Spine");
    copy("Spine2", "Spine1");
    copy("Neck", "Spine2");
    copy("Head", "Neck");
    for (const char* side : {"l_", "r_"}) {
        copy(std::string(side) + "Arm", "Spine2");
        copy(std::string(side) + "ForeArm", std::string(side) + "Arm");
        copy(std::string(side) + "Hand", std::string(side) + "ForeArm");
    }
    const HumanoidMap map = rig.map();
    REQUIRE(map.humanoid);
    CHECK(rig.nameOf(map, Role::hips) == "Rig_Hips");
    CHECK(rig.nameOf(map, Role::chest) == "Rig_Spine2");
    CHECK(rig.nameOf(map, Role::leftUpperLeg) == "Rig_l_UpLeg");
}

TEST_CASE("where a prefix tells which joint drives which, what bears it takes no role", "[controls]") {
    NamedRig rig;
    rig.add("c_traj", "", {0, 0, 0});
    rig.add("c_root_master.x", "c_traj", {0, 0.96F, 0});
    rig.add("c_root.x", "c_root_master.x", {0, 0.96F, 0});
    rig.add("root.x", "c_root.x", {0, 0.96F, 0});
    rig.add("c_root_bend.x", "root.x", {0, 0.96F, 0}, {0, 0.85F, 0}, 0.14F);
    rig.add("c_thigh_b.@", "root.x", kHip + vec3(-0.03F, 0.05F, 0));
    rig.add("thigh.@", "c_thigh_b.@", kHip, kKnee, 0.07F);
    rig.add("leg.@", "thigh.@", kKnee, kAnkle, 0.05F);
    rig.add("foot.@", "leg.@", kAnkle, {0.1F, 0.03F, 0.15F}, 0.05F);
    const std::vector<std::pair<std::string, float>> spine{{"spine_01.x", 1.05F}, {"spine_02.x", 1.28F}};
    std::string above = "c_root_master.x";
    for (const auto& [name, height] : spine) {
        rig.add("c_" + name, above, {0, height, 0});
        rig.add(name, "c_" + name, {0, height, 0}, {0, height + 0.2F, 0}, 0.14F);
        above = name;
    }
    rig.add("c_neck.x", above, {0, 1.5F, 0});
    rig.add("neck.x", "c_neck.x", {0, 1.5F, 0}, {0, 1.58F, 0}, 0.05F);
    rig.add("head.x", "neck.x", {0, 1.58F, 0}, {0, 1.78F, 0}, 0.09F);
    rig.add("c_shoulder.@", above, {0.04F, 1.4F, 0});
    rig.add("shoulder.@", "c_shoulder.@", {0.04F, 1.4F, 0}, kShoulder, 0.05F);
    rig.add("arm.@", "shoulder.@", kShoulder, kElbow, 0.05F);
    rig.add("forearm.@", "arm.@", kElbow, kWrist, 0.04F);
    rig.add("hand.@", "forearm.@", kWrist, kWrist + vec3(0.15F, 0, 0), 0.04F);
    const HumanoidMap map = rig.map();
    REQUIRE(map.humanoid);
    CHECK(rig.nameOf(map, Role::hips) == "root.x");
    CHECK(rig.nameOf(map, Role::leftUpperLeg) == "thigh.l");
    CHECK(rig.nameOf(map, Role::rightUpperLeg) == "thigh.r");
    CHECK(rig.nameOf(map, Role::spine) == "spine_01.x");
    CHECK(rig.nameOf(map, Role::chest) == "spine_02.x");
    CHECK(rig.nameOf(map, Role::neck) == "neck.x");
    CHECK(rig.nameOf(map, Role::leftShoulder) == "shoulder.l");
}

TEST_CASE("beside joints that say that they deform the skin, an animator's head is no head", "[controls]") {
    NamedRig rig;
    rig.add("root", "", {0, 0, 0});
    rig.add("MCH-torso.parent", "root", {0, 0.95F, 0});
    rig.add("DEF-spine", "root", {0, 0.95F, 0}, {0, 1.1F, 0}, 0.14F);
    rig.add("DEF-spine.001", "DEF-spine", {0, 1.1F, 0}, {0, 1.3F, 0}, 0.14F);
    rig.add("DEF-spine.002", "DEF-spine.001", {0, 1.3F, 0}, {0, 1.45F, 0}, 0.14F);
    rig.add("DEF-spine.003", "DEF-spine.002", {0, 1.5F, 0}, {0, 1.58F, 0}, 0.05F);
    rig.add("DEF-spine.004", "DEF-spine.003", {0, 1.58F, 0}, {0, 1.78F, 0}, 0.09F);
    // A pose that was saved has taken the animator's head, which carries the face, a little away.
    rig.add("MCH-ROT-neck", "MCH-torso.parent", {0, 1.5F, 0.02F});
    rig.add("neck", "MCH-ROT-neck", {0, 1.5F, 0.02F});
    rig.add("MCH-ROT-head", "neck", {0, 1.6F, 0.02F});
    rig.add("head", "MCH-ROT-head", {0, 1.6F, 0.02F});
    rig.add("DEF-jaw", "head", {0, 1.6F, 0.05F}, {0, 1.58F, 0.12F}, 0.04F);
    rig.add("DEF-ear.@", "head", {0.08F, 1.68F, 0}, {0.1F, 1.72F, 0}, 0.02F);
    for (int i = 0; i < 10; ++i)
        rig.add("MCH-WGT." + std::to_string(i), "root", {0, 0.1F * static_cast<float>(i), 0.5F});
    rig.add("DEF-upper_arm.@", "DEF-spine.002", kShoulder, kElbow, 0.05F);
    rig.add("DEF-forearm.@", "DEF-upper_arm.@", kElbow, kWrist, 0.04F);
    rig.add("DEF-hand.@", "DEF-forearm.@", kWrist, kWrist + vec3(0.15F, 0, 0), 0.04F);
    rig.add("DEF-thigh.@", "DEF-spine", kHip, kKnee, 0.07F);
    rig.add("DEF-shin.@", "DEF-thigh.@", kKnee, kAnkle, 0.05F);
    rig.add("DEF-foot.@", "DEF-shin.@", kAnkle, {0.1F, 0.03F, 0.15F}, 0.05F);
    const HumanoidMap map = rig.map();
    REQUIRE(map.humanoid);
    CHECK(rig.nameOf(map, Role::head) == "DEF-spine.004");
    CHECK(rig.nameOf(map, Role::hips) == "DEF-spine");
    CHECK(rig.nameOf(map, Role::rightFoot) == "DEF-foot.r");
}

TEST_CASE("a rig whose deforming joints were hung flat beside their controls is read by its names", "[controls]") {
    // As an add-on's rig comes out of glTF; it stands, or dives head first.
    for (const float lean : {0.0F, 1.9F}) {
        INFO(lean);
        const auto at = [&](float x, float y, float z = 0.0F) {
            return vec3(x, y * std::cos(lean) - z * std::sin(lean), y * std::sin(lean) + z * std::cos(lean));
        };
        NamedRig rig;
        rig.add("c_pos", "", at(0, 0));
        rig.add("c_traj", "c_pos", at(0, 0));
        rig.add("forearm.@", "c_traj", at(0.47F, 1.42F));
        rig.add("hand.@", "forearm.@", at(0.72F, 1.42F), at(0.86F, 1.42F), 0.04F);
        rig.add("forearm_stretch.@", "c_traj", at(0.47F, 1.42F), at(0.6F, 1.42F), 0.05F);
        rig.add("forearm_twist.@", "forearm_stretch.@", at(0.6F, 1.42F), at(0.72F, 1.42F), 0.05F);
        rig.add("arm_stretch.@", "c_traj", at(0.33F, 1.42F), at(0.47F, 1.42F), 0.06F);
        rig.add("thigh_stretch.@", "c_traj", at(0.1F, 0.72F), at(0.1F, 0.52F), 0.08F);
        rig.add("leg_stretch.@", "c_traj", at(0.1F, 0.5F), at(0.1F, 0.3F), 0.07F);
        rig.add("leg_twist.@", "leg_stretch.@", at(0.1F, 0.29F), at(0.1F, 0.1F), 0.06F);
        rig.add("head_scale_fix.x", "c_traj", at(0, 1.56F));
        rig.add("c_head.x", "head_scale_fix.x", at(0, 1.56F));
        rig.add("head.x", "c_head.x", at(0, 1.56F), at(0, 1.78F), 0.1F);
        rig.add("c_root_master.x", "c_traj", at(0, 0.95F));
        rig.add("c_root.x", "c_root_master.x", at(0, 1.05F));
        rig.add("root.x", "c_root.x", at(0, 1.05F), at(0, 0.9F), 0.14F);
        rig.add("c_thigh_b.@", "c_root.x", at(0.09F, 0.95F));
        rig.add("thigh_twist.@", "c_thigh_b.@", at(0.1F, 0.93F), at(0.1F, 0.74F), 0.08F);
        rig.add("c_thigh_fk.@", "c_thigh_b.@", at(0.1F, 0.93F));
        rig.add("c_leg_fk.@", "c_thigh_fk.@", at(0.1F, 0.5F));
        rig.add("leg_fk.@", "c_leg_fk.@", at(0.1F, 0.5F));
        rig.add("foot.@", "leg_fk.@", at(0.1F, 0.09F), at(0.1F, 0.03F, 0.12F), 0.04F);
        rig.add("toes_01.@", "foot.@", at(0.1F, 0.03F, 0.13F), at(0.1F, 0.03F, 0.2F), 0.03F);
        rig.add("c_spine_01.x", "c_root_master.x", at(0, 1.1F));
        rig.add("spine_01.x", "c_spine_01.x", at(0, 1.1F), at(0, 1.4F), 0.15F);
        rig.add("c_neck.x", "c_spine_01.x", at(0, 1.47F));
        rig.add("neck.x", "c_neck.x", at(0, 1.47F), at(0, 1.56F), 0.05F);
        rig.add("c_shoulder.@", "c_spine_01.x", at(0.04F, 1.42F));
        rig.add("shoulder.@", "c_shoulder.@", at(0.04F, 1.42F), at(0.18F, 1.42F), 0.06F);
        rig.add("arm_twist.@", "c_shoulder.@", at(0.2F, 1.42F));
        rig.add("c_arm_twist_offset.@", "arm_twist.@", at(0.2F, 1.42F), at(0.32F, 1.42F), 0.06F);
        const HumanoidMap map = rig.map();
        INFO((map.warnings.empty() ? std::string() : map.warnings.front()));
        REQUIRE(map.humanoid);
        for (const auto& [role, name] :
             {std::pair{Role::hips, "root.x"}, std::pair{Role::spine, "spine_01.x"}, std::pair{Role::head, "head.x"},
              std::pair{Role::leftUpperArm, "c_arm_twist_offset.l"}, std::pair{Role::leftLowerArm, "forearm_stretch.l"},
              std::pair{Role::rightHand, "hand.r"}, std::pair{Role::rightUpperLeg, "thigh_twist.r"},
              std::pair{Role::rightLowerLeg, "leg_stretch.r"}, std::pair{Role::leftFoot, "foot.l"},
              std::pair{Role::neck, "none"}})
            CHECK(rig.nameOf(map, role) == name);
    }
}

}  // namespace lutka::test
