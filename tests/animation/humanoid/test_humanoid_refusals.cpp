#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <vector>

#include "animation/humanoid/map_humanoid.hpp"
#include "rig_variations.hpp"
#include "support/catch.hpp"
#include "support/rigs.hpp"

// Rigs that are no humanoids, some with the joint names of one: none may be accepted, with or without their names.
namespace lutka::test {
namespace {

class RigBuilder {
  public:
    int add(const std::string& name, int parent, const vec3& position) {
        joints_.push_back({name, parent, position});
        return static_cast<int>(joints_.size()) - 1;
    }

    // A chain from `start` by steps; the index of its first joint.
    int chain(const std::string& stem, int parent, vec3 start, const std::vector<vec3>& steps) {
        const int first = add(stem + "1", parent, start);
        int last = first;
        for (std::size_t i = 0; i < steps.size(); ++i) {
            start += steps[i];
            last = add(stem + std::to_string(i + 2), last, start);
        }
        return first;
    }

    // The same chain on both sides.
    void chains(const std::string& stem, int parent, const vec3& start, const std::vector<vec3>& steps) {
        for (const float side : {1.0F, -1.0F}) {
            std::vector<vec3> mirrored = steps;
            for (vec3& step : mirrored)
                step.x *= side;
            chain((side > 0 ? "Left" : "Right") + stem, parent, vec3(side * start.x, start.y, start.z), mirrored);
        }
    }

    [[nodiscard]] animation::Character character() const {
        animation::Character made;
        made.skeleton = makeSkeleton(joints_);
        std::fill(made.skeleton.skinWeight.begin(), made.skeleton.skinWeight.end(), 50.0F);
        return made;
    }

  private:
    std::vector<JointSpec> joints_;
};

animation::Character quadruped(const char* foreleg, const char* hindleg) {
    RigBuilder rig;
    const int hips = rig.add("Hips", -1, {0, 0.9F, -0.5F});
    const int spine = rig.add("Spine", hips, {0, 0.95F, -0.2F});
    const int chest = rig.add("Chest", spine, {0, 0.95F, 0.3F});
    const int neck = rig.add("Neck", chest, {0, 1.1F, 0.5F});
    rig.add("Head", neck, {0, 1.35F, 0.7F});
    rig.chain("Tail", hips, {0, 0.9F, -0.6F}, {{0, -0.1F, -0.2F}, {0, -0.15F, -0.15F}});
    rig.chains(foreleg, chest, {0.13F, 0.85F, 0.35F}, {{0, -0.35F, -0.02F}, {0, -0.35F, 0.02F}, {0, -0.1F, 0.06F}});
    rig.chains(hindleg, hips, {0.13F, 0.85F, -0.5F}, {{0, -0.35F, 0.05F}, {0, -0.3F, -0.1F}, {0, -0.15F, 0.08F}});
    return rig.character();
}

animation::Character raptor() {
    RigBuilder rig;
    const int hips = rig.add("pelvis", -1, {0, 1.0F, 0});
    const int spine = rig.add("spine_01", hips, {0, 1.05F, 0.25F});
    const int chest = rig.add("spine_02", spine, {0, 1.12F, 0.5F});
    const int neck = rig.add("neck_01", chest, {0, 1.3F, 0.7F});
    rig.add("head", neck, {0, 1.5F, 0.85F});
    rig.chain("tail", hips, {0, 1.0F, -0.2F}, {{0, 0, -0.3F}, {0, 0, -0.3F}, {0, 0, -0.3F}, {0, 0, -0.3F}});
    rig.chains("arm", chest, {0.1F, 1.02F, 0.52F}, {{0.02F, -0.15F, -0.02F}, {0, -0.08F, 0.12F}, {0, -0.03F, 0.06F}});
    rig.chains("leg", hips, {0.14F, 0.95F, 0.02F}, {{0, -0.35F, 0.12F}, {0, -0.35F, -0.25F}, {0, -0.2F, 0.12F}});
    return rig.character();
}

animation::Character spider() {
    RigBuilder rig;
    const int body = rig.add("body", -1, {0, 0.3F, 0});
    rig.add("head", body, {0, 0.32F, 0.25F});
    rig.add("abdomen", body, {0, 0.34F, -0.3F});
    for (int i = 0; i < 4; ++i) {
        const float z = 0.15F - 0.1F * static_cast<float>(i);
        rig.chains("leg" + std::to_string(i) + "_", body, {0.1F, 0.3F, z},
                   {{0.2F, 0.2F, z}, {0.25F, -0.2F, z}, {0.15F, -0.3F, z}});
    }
    return rig.character();
}

animation::Character bird() {
    RigBuilder rig;
    const int body = rig.add("Body", -1, {0, 0.3F, 0});
    const int chest = rig.add("Chest", body, {0, 0.34F, 0.12F});
    const int neck = rig.add("Neck", chest, {0, 0.42F, 0.2F});
    rig.add("Head", neck, {0, 0.5F, 0.25F});
    rig.chain("Tail", body, {0, 0.3F, -0.1F}, {{0, 0, -0.1F}});
    rig.chains("Wing", chest, {0.07F, 0.36F, 0.08F}, {{0.2F, 0, 0}, {0.2F, 0, -0.02F}, {0.15F, 0, -0.03F}});
    rig.chains("Leg", body, {0.05F, 0.26F, 0}, {{0, -0.1F, 0.04F}, {0, -0.12F, -0.03F}, {0, -0.02F, 0.05F}});
    return rig.character();
}

// The walls of a room on joints of their own, a door in one of them and a way in before it.
animation::Character room() {
    RigBuilder rig;
    const int root = rig.add("roomRoot_bone", rig.add("room", -1, {0, 0.01F, 0}), {0, 0, 0});
    rig.add("XMinus_bone", root, {-3.4F, 0, 0});
    rig.add("XPlus_bone", root, {3.4F, 0, 0});
    rig.add("YMinus_bone", root, {0, 0, 0});
    rig.add("YPlus_bone", root, {0, 2.7F, 0});
    const int wall = rig.add("ZMinus_bone", root, {0, 0, -3.4F});
    rig.add("doorAnim_bone", wall, {-0.68F, 0, -3.4F});
    rig.add("ZPlus_bone", root, {0, 0, 3.4F});
    const int ornament = rig.add("dec_bone", root, {0, 0, 0});
    rig.add("entrance_bone", ornament, {0, 1.01F, -4.23F});
    rig.add("fur_bone", root, {0, 0, 0});
    animation::Character made = rig.character();
    made.skeleton.skinWeight = {0, 241, 64, 56, 64, 49, 84, 97, 112, 0, 48, 2481};
    return made;
}

// A game's, with a man's names: arms, legs and a trunk that stands; head and tail are on joints without a name.
animation::Character toyTyrannosaur() {
    RigBuilder rig;
    const int root = rig.add("Root", -1, {0, 0.6F, 0});
    const int spine = rig.add("Spine", root, {0, 0.8F, 0.04F});
    const int chest = rig.add("Spine.001", spine, {0, 1.0F, 0.1F});
    rig.chain("Bone", chest, {0, 1.2F, 0.2F}, {{0, 0.16F, 0.13F}, {0, 0.1F, 0.15F}, {0, 0.07F, 0.14F}});
    const int head = rig.add("Bone.007", root, {0, 1.6F, 0.84F});
    rig.add("Eye.L", head, {0.16F, 1.67F, 1.12F});
    rig.add("Eye.R", head, {-0.16F, 1.67F, 1.12F});
    rig.chain("Bone.01", root, {0, 0.6F, 0},
              {{0, -0.04F, -0.34F}, {0, -0.1F, -0.3F}, {0, -0.15F, -0.3F}, {0, 0, -0.3F}});
    for (const char* side : {".L", ".R"}) {
        const float x = side[1] == 'L' ? 1.0F : -1.0F;
        const auto add = [&](const char* name, int parent, const vec3& place) {
            return rig.add(name + std::string(side), parent, {x * place.x, place.y, place.z});
        };
        add("Forearm", add("Bicep", add("Shoulder", chest, {0, 1.2F, 0.2F}), {0.28F, 1.06F, 0.28F}),
            {0.28F, 0.94F, 0.37F});
        add("Hand", root, {0.27F, 0.83F, 0.57F});
        add("Calf", add("Thigh", add("Hip", root, {0, 0.6F, 0}), {0.3F, 0.66F, 0.1F}), {0.3F, 0.21F, 0.14F});
        add("Foot", root, {0.3F, -0.17F, 0.11F});
    }
    animation::Character made = rig.character();
    made.skeleton.skinWeight[head] = 900.0F;
    return made;
}

// It flies level, with the names of a man's limbs: turned to stand it would have a tail below its feet.
animation::Character flyingDragon() {
    RigBuilder rig;
    const int chest = rig.add("SpineCOG", -1, {0, 0.5F, -0.2F});
    const int hips = rig.add("SpineC", rig.add("SpineB", chest, {0, 0.5F, -0.4F}), {0, 0.5F, -0.7F});
    rig.add("HeadEnd", rig.add("Head", rig.add("NeckA", chest, {0, 0.5F, -0.18F}), {0, 0.5F, -0.07F}),
            {0, 0.5F, 0.24F});
    rig.chain("Tail", hips, {0, 0.5F, -0.9F}, {{0, 0, -0.15F}, {0, 0, -0.16F}, {0, 0, -0.13F}, {0, 0, -0.12F}});
    for (const char* side : {"l", "r"}) {
        const float x = *side == 'l' ? 1.0F : -1.0F;
        const auto add = [&](const char* name, int parent, const vec3& place) {
            return rig.add(std::string(side) + name, parent, {x * place.x, place.y, place.z});
        };
        add("_hand", add("_lowerArm", add("_upperArm", chest, {0.19F, 0.46F, -0.25F}), {0.25F, 0.43F, -0.33F}),
            {0.29F, 0.42F, -0.44F});
        add("_toes",
            add("_ankle", add("_lowerLeg", add("_upperLeg", hips, {0.2F, 0.43F, -0.68F}), {0.24F, 0.34F, -0.76F}),
                {0.18F, 0.38F, -0.89F}),
            {0.19F, 0.35F, -0.94F});
    }
    return rig.character();
}

animation::Character handAlone() {
    RigBuilder rig;
    const int wrist = rig.add("wrist", -1, {0, 0, 0});
    const char* fingers[] = {"thumb", "index", "middle", "ring", "pinky"};
    for (int i = 0; i < 5; ++i) {
        const float x = 0.02F * static_cast<float>(i - 2);
        rig.chain(fingers[i], wrist, {x, 0.05F, 0}, {{x * 0.5F, 0.05F, 0}, {0, 0.03F, 0}, {0, 0.02F, 0}});
    }
    return rig.character();
}

animation::Character armAlone() {
    RigBuilder rig;
    const int root = rig.add("clavicle_l", -1, {0, 0, 0});
    const int upper = rig.add("upperarm_l", root, {0.15F, 0, 0});
    const int lower = rig.add("lowerarm_l", upper, {0.43F, 0, 0});
    const int hand = rig.add("hand_l", lower, {0.7F, 0, 0});
    for (int i = 0; i < 4; ++i) {
        rig.chain("finger" + std::to_string(i), hand, {0.79F, 0, 0.02F * static_cast<float>(i) - 0.03F},
                  {{0.03F, 0, 0}, {0.02F, 0, 0}});
    }
    return rig.character();
}

animation::Character car() {
    RigBuilder rig;
    const int body = rig.add("body", -1, {0, 0.6F, 0});
    rig.add("steering", body, {0, 0.9F, 0.3F});
    rig.chains("FrontWheel", body, {0.8F, 0.3F, 1.3F}, {{0.1F, 0, 0}});
    rig.chains("RearWheel", body, {0.8F, 0.3F, -1.3F}, {{0.1F, 0, 0}});
    rig.chains("Door", body, {0.85F, 0.7F, 0.4F}, {{0, 0, -0.9F}});
    return rig.character();
}

animation::Character fish() {
    RigBuilder rig;
    const int first =
        rig.chain("spine", -1, {0, 0, 0.6F}, {{0, 0, -0.3F}, {0, 0, -0.3F}, {0, 0, -0.3F}, {0, 0, -0.2F}});
    rig.chains("fin", first, {0.1F, -0.05F, 0.45F}, {{0.15F, -0.05F, -0.1F}});
    rig.chains("rearfin", first + 2, {0.08F, -0.05F, 0.0F}, {{0.1F, -0.05F, -0.1F}});
    return rig.character();
}

animation::Character tree() {
    RigBuilder rig;
    const int trunk = rig.chain("trunk", -1, {0, 0, 0}, {{0, 1, 0}, {0, 1, 0}, {0, 1, 0}});
    for (int i = 0; i < 3; ++i) {
        rig.chains("branch" + std::to_string(i) + "_", trunk + i + 1, {0.1F, 1.0F + static_cast<float>(i), 0},
                   {{0.5F, 0.3F, 0.1F}, {0.4F, 0.3F, 0.0F}});
    }
    return rig.character();
}

// All joints bear a human's names, and no tail tells.
animation::Character namedQuadruped() {
    RigBuilder rig;
    const int hips = rig.add("Hips", -1, {0, 0.9F, -0.5F});
    const int spine = rig.add("Spine", hips, {0, 0.95F, -0.2F});
    const int chest = rig.add("Chest", spine, {0, 0.95F, 0.3F});
    const int neck = rig.add("Neck", chest, {0, 1.1F, 0.5F});
    rig.add("Head", neck, {0, 1.35F, 0.7F});
    for (const float side : {1.0F, -1.0F}) {
        const std::string name = side > 0.0F ? "Left" : "Right";
        const int arm = rig.add(name + "UpperArm", chest, {0.13F * side, 0.85F, 0.35F});
        const int forearm = rig.add(name + "LowerArm", arm, {0.13F * side, 0.5F, 0.33F});
        rig.add(name + "Hand", forearm, {0.13F * side, 0.1F, 0.35F});
        const int thigh = rig.add(name + "UpperLeg", hips, {0.13F * side, 0.85F, -0.5F});
        const int shin = rig.add(name + "LowerLeg", thigh, {0.13F * side, 0.5F, -0.42F});
        rig.add(name + "Foot", shin, {0.13F * side, 0.1F, -0.52F});
    }
    return rig.character();
}

// Wings that hang on joints called shoulders, above legs that are named as such.
animation::Character bat() {
    RigBuilder rig;
    const int root = rig.add("BodyRoot", -1, {0, 0.53F, 0});
    const int body = rig.add("Body", root, {0, 0.67F, 0});
    const int neck = rig.add("Neck", body, {0, 1.07F, 0.14F});
    rig.add("Head", neck, {0, 1.16F, 0.15F});
    for (const float side : {1.0F, -1.0F}) {
        const std::string name = side > 0.0F ? ".L" : ".R";
        int wing = rig.add("Shoulder" + name, body, {0.11F * side, 0.75F, -0.05F});
        const std::vector<vec3> places{
            {0.16F, 0.89F, -0.06F}, {0.23F, 1.0F, -0.24F}, {0.33F, 1.17F, -0.42F}, {0.39F, 1.18F, -0.7F}};
        for (std::size_t i = 0; i < places.size(); ++i)
            wing = rig.add("Wing" + std::to_string(i + 1) + name, wing, places[i] * vec3(side, 1, 1));
        const int thigh = rig.add("UpperLeg" + name, body, {0.22F * side, 0.52F, -0.05F});
        const int shin = rig.add("LowerLeg" + name, thigh, {0.24F * side, 0.41F, -0.06F});
        rig.add("Feet" + name, shin, {0.22F * side, 0.34F, -0.17F});
    }
    return rig.character();
}

// Every joint but the root carries a rigid triangle: up from those in the middle, down from the others.
animation::Character ofRigidParts(animation::Character made) {
    for (int joint = 1; joint < made.skeleton.jointCount(); ++joint) {
        animation::SkinnedMesh part;
        part.rigid = true;
        const vec3 at = made.skeleton.bindModelFromJoint[joint].translation;
        part.positions = {at, at + vec3(0.05F, 0, 0), at + vec3(0, at.x == 0.0F ? 0.2F : -0.3F, 0)};
        part.joints.assign(3, {static_cast<std::uint16_t>(joint), 0, 0, 0});
        part.weights.assign(3, {1.0F, 0.0F, 0.0F, 0.0F});
        part.indices = {0, 1, 2};
        made.meshes.push_back(part);
    }
    return made;
}

// Things that lie where a figure's joints would be.
animation::Character thingsInAPattern() {
    RigBuilder rig;
    const int root = rig.add("Scene", -1, vec3(0));
    int count = 0;
    const auto add = [&](const vec3& place) { rig.add("Prism_" + std::to_string(++count), root, place); };
    for (const float height : {0.95F, 1.2F, 1.45F, 1.6F})
        add({0, height, 0});
    for (const float side : {1.0F, -1.0F}) {
        for (const vec3& place : {vec3(0.18F, 1.42F, 0), vec3(0.45F, 1.42F, 0), vec3(0.7F, 1.42F, 0),
                                  vec3(0.1F, 0.9F, 0), vec3(0.1F, 0.48F, 0), vec3(0.1F, 0.08F, 0)})
            add(place * vec3(side, 1, 1));
    }
    return ofRigidParts(rig.character());
}

// A reptile on its belly, whose legs are one joint beside the trunk each, a little askew, as a child would rig it.
animation::Character lizard() {
    const std::vector<JointSpec> joints{
        {"Armature", -1, {0.05F, 0.226F, 0.244F}}, {"Bone", 0, {0.048F, 0.078F, 0.33F}},
        {"Bone_009", 1, {0.048F, 0.085F, 0.12F}},  {"Bone_010", 2, {0.046F, 0.086F, 0.05F}},
        {"Bone_011", 3, {0.047F, 0.1F, -0.04F}},   {"Bone_016", 3, {0.047F, 0.1F, -0.04F}},
        {"Bone_017", 5, {0.043F, 0.04F, -0.085F}}, {"Bone_012", 3, {0.046F, 0.086F, 0.047F}},
        {"Bone_013", 7, {0.26F, 0.062F, 0.045F}},  {"Bone_014", 3, {0.046F, 0.086F, 0.047F}},
        {"Bone_015", 9, {-0.17F, 0.065F, 0.047F}}, {"Bone_001", 0, {0.048F, 0.078F, 0.334F}},
        {"Bone_002", 11, {0.047F, 0.077F, 0.42F}}, {"Bone_003", 12, {0.262F, 0.062F, 0.43F}},
        {"Bone_004", 11, {0.047F, 0.077F, 0.42F}}, {"Bone_005", 14, {-0.168F, 0.073F, 0.43F}},
        {"Bone_006", 11, {0.047F, 0.077F, 0.42F}}, {"Bone_007", 16, {0.043F, 0.077F, 0.5F}},
        {"Bone_008", 17, {0.042F, 0.075F, 0.67F}}};
    std::vector<TubeSpec> skin;
    for (const int joint : {1, 3, 4, 5, 7, 9, 11, 12, 14, 16, 17}) {
        vec3 end = joints[static_cast<std::size_t>(joint)].position + vec3(0, 0, 0.08F);
        for (const JointSpec& child : joints) {
            if (child.parent == joint) end = child.position;
        }
        skin.push_back({joint, end, 0.04F});
    }
    for (const int foot : {8, 10, 13, 15})
        skin.push_back({foot, joints[static_cast<std::size_t>(foot)].position * vec3(1.1F, 0, 1), 0.03F});
    skin.push_back({6, {0.04F, 0.04F, -0.3F}, 0.04F});
    skin.push_back({18, {0.04F, 0.07F, 0.9F}, 0.02F});
    return makeFigure("lizard", joints, skin);
}

// Ten legs to the sides of one body.
animation::Character crab() {
    RigBuilder rig;
    const int root = rig.add("Armature", -1, {0, 0, 0});
    const int body = rig.add("Bone", root, {0.016F, 0.17F, -0.017F});
    int count = 0;
    for (const float side : {1.0F, -1.0F}) {
        for (int leg = 0; leg < 5; ++leg) {
            const float z = -0.09F + 0.045F * static_cast<float>(leg) + 0.004F * side;
            int joint = rig.add("Bone_" + std::to_string(++count), body, {0.016F, 0.13F, -0.017F});
            for (const float x : {0.1F, 0.235F, 0.37F})
                joint = rig.add("Bone_" + std::to_string(++count), joint,
                                {0.016F + side * (x + 0.003F * static_cast<float>(leg)), 0.121F, z + 0.02F * x});
        }
    }
    return rig.character();
}

// A beetle: one joint a leg, all side by side, with feelers above the body.
animation::Character beetle(const char* feeler) {
    RigBuilder rig;
    const int body = rig.add("COG_jnt", rig.add("root_jnt", -1, vec3(0)), {0, 0.3F, 0});
    for (const char* side : {"L_", "R_"}) {
        const float x = *side == 'L' ? 1.0F : -1.0F;
        const auto add = [&](const std::string& name, const vec3& place) {
            rig.add(side + name + "_jnt", body, {x * place.x, place.y, place.z});
        };
        add("leg_3", {1.0F, 0.2F, -0.74F});
        add("leg_1", {0.77F, 0.2F, 1.19F});
        add("leg_2", {0.86F, 0.2F, 0.2F});
        add("eye", {0.66F, 0.23F, 1.72F});
        add(feeler, {0.27F, 0.58F, 1.68F});
    }
    return rig.character();
}

const std::vector<std::pair<const char*, std::function<animation::Character()>>>& strangers() {
    static const std::vector<std::pair<const char*, std::function<animation::Character()>>> all = {
        {"quadruped with human names", [] { return quadruped("Arm", "Leg"); }},
        {"quadruped with an animal's names", [] { return quadruped("FrontLeg", "BackLeg"); }},
        {"quadruped with all names of a human", namedQuadruped},
        {"bat", bat},
        {"things in a pattern", thingsInAPattern},
        {"raptor", raptor},
        {"spider", spider},
        {"bird", bird},
        {"room", room},
        {"flying dragon", flyingDragon},
        {"hand", handAlone},
        {"arm", armAlone},
        {"car", car},
        {"fish", fish},
        {"tree", tree},
        {"lizard", lizard},
        {"crab", crab},
        {"beetle", [] { return beetle("antenna"); }},
        {"beetle with arms", [] { return beetle("arm"); }},
    };
    return all;
}

constexpr float kAskew = 0.01F;  // metres

}  // namespace

TEST_CASE("animals, limbs and things are refused with a reason", "[refusal]") {
    for (const auto& [name, make] : strangers()) {
        const animation::Character character = make();
        const animation::Character zUp = rotated(character, glm::angleAxis(radians(90.0F), vec3(1, 0, 0)));
        for (const auto& variant : {character, withoutNames(character), zUp, withoutNames(zUp)}) {
            const animation::HumanoidMap map = animation::mapHumanoid(variant);
            INFO(name << ", first joint " << variant.skeleton.names.front());
            CHECK_FALSE(map.humanoid);
            REQUIRE_FALSE(map.warnings.empty());
            CHECK(map.warnings.front().find("not a humanoid: ") == 0);
        }
    }
}

TEST_CASE("creatures whose joints lie a little askew are refused, too", "[refusal]") {
    for (const auto& [name, make] : strangers()) {
        const animation::Character made = make();
        for (std::uint64_t seed = 1; seed <= 100; ++seed) {
            INFO(name << ", seed " << seed);
            CHECK_FALSE(animation::mapHumanoid(jittered(withoutNames(made), kAskew, seed)).humanoid);
        }
    }
}

// Without the joint and all below it.
animation::Character without(const animation::Character& whole, int top) {
    animation::Character left = whole;
    left.meshes.clear();
    animation::Skeleton& skeleton = left.skeleton = {};
    std::vector<int> fresh;
    for (int joint = 0; joint < whole.skeleton.jointCount(); ++joint) {
        const int parent = whole.skeleton.parents[joint];
        const bool gone = joint == top || (parent != animation::kNoJoint && fresh[parent] == animation::kNoJoint);
        fresh.push_back(gone ? animation::kNoJoint : skeleton.jointCount());
        if (gone) continue;
        skeleton.names.push_back(whole.skeleton.names[joint]);
        skeleton.parents.push_back(parent == animation::kNoJoint ? animation::kNoJoint : fresh[parent]);
        skeleton.bindModelFromJoint.push_back(whole.skeleton.bindModelFromJoint[joint]);
        skeleton.nodeParentFromJoint.push_back(whole.skeleton.nodeParentFromJoint[joint]);
        skeleton.skinWeight.push_back(whole.skeleton.skinWeight[joint]);
    }
    return left;
}

TEST_CASE("a head that lies before the shoulders makes an animal of a figure with a man's names", "[refusal]") {
    const animation::HumanoidMap map = animation::mapHumanoid(toyTyrannosaur());
    CHECK_FALSE(map.humanoid);
    CHECK(map.warnings.front().find("its head lies before its shoulders") != std::string::npos);
}

TEST_CASE("an animal that lacks a limb is no figure that lacks one", "[refusal]") {
    for (const auto& [name, make] : strangers()) {
        const animation::Character whole = make();
        for (int joint = 1; joint < whole.skeleton.jointCount(); ++joint) {
            const animation::Character lame = without(whole, joint);
            INFO(name << " without \"" << whole.skeleton.names[joint] << '"');
            for (const animation::Character& variant : {lame, withoutNames(lame)}) {
                const animation::HumanoidMap map = animation::mapHumanoid(variant);
                const bool imagined =
                    std::any_of(map.warnings.begin(), map.warnings.end(),
                                [](const std::string& word) { return word.find("the figure has no joints of") == 0; });
                CHECK_FALSE((map.humanoid && imagined));
            }
        }
    }
}

TEST_CASE("blocks side by side are a figure by the names of arms and legs", "[blocks]") {
    RigBuilder rig;
    const int root = rig.add("character", -1, vec3(0));
    rig.add("body 1", root, {0, 0.4F, 0});
    rig.add("Group 143", root, {0, 0.78F, 0});
    rig.add("armLeft 1", root, {0.17F, 0.7F, 0});
    rig.add("armRight 1", root, {-0.17F, 0.7F, 0});
    rig.add("legLeft 1", root, {0.15F, 0.4F, 0});
    rig.add("legRight 1", root, {-0.15F, 0.4F, 0});
    const animation::Character character = ofRigidParts(rig.character());
    const animation::HumanoidMap map = animation::mapHumanoid(character);
    INFO((map.warnings.empty() ? std::string() : map.warnings.front()));
    REQUIRE(map.humanoid);
    CHECK(map.jointOf(animation::Role::leftUpperArm) == 3);
    CHECK(map.jointOf(animation::Role::rightUpperLeg) == 6);
    CHECK_FALSE(animation::mapHumanoid(withoutNames(character)).humanoid);
}

TEST_CASE("no joints, few joints and a chain are refused", "[refusal]") {
    CHECK_FALSE(animation::mapHumanoid({}).humanoid);
    RigBuilder rig;
    rig.chain("joint", -1, {0, 0, 0}, {{0, 1, 0}, {0, 1, 0}, {0, 1, 0}, {0, 1, 0}, {0, 1, 0}, {0, 1, 0}});
    CHECK_FALSE(animation::mapHumanoid(rig.character()).humanoid);
}

TEST_CASE("joints that all lie in one point are refused", "[refusal]") {
    animation::Character biped = makeBiped();
    for (RigidTransform& frame : biped.skeleton.bindModelFromJoint)
        frame.translation = vec3(0);
    biped.meshes.clear();
    CHECK_FALSE(animation::mapHumanoid(biped).humanoid);
}

}  // namespace lutka::test
