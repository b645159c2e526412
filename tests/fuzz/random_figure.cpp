#include "random_figure.hpp"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <string>
#include <utility>
#include <vector>

#include "support/rigs.hpp"

namespace lutka::fuzz {
namespace {

constexpr int kMostJoints = 80;

constexpr std::array<const char*, 32> kWords = {"",          "hips",      "Spine",    "mixamorig:Spine1",
                                                "chest",     "neck",      "Head",     "LeftShoulder",
                                                "LeftArm",   "l_forearm", "Hand.L",   "RightArm",
                                                "r_elbow",   "hand_r",    "thigh.L",  "LeftUpLeg",
                                                "calf_l",    "foot_L",    "ToeBase",  "RightLeg",
                                                "Bone",      "Bone.001",  "joint12",  "twist",
                                                "ik_foot.R", "tail1",     "Armature", "左腕",
                                                "\xff\xfe",  "a/b#2",     "wing_l",   "Thumb1"};

std::vector<test::JointSpec> bipedSpecs() {
    const animation::Character biped = test::makeBiped();
    std::vector<test::JointSpec> joints;
    for (int joint = 0; joint < biped.skeleton.jointCount(); ++joint) {
        joints.push_back({biped.skeleton.names[joint], biped.skeleton.parents[joint],
                          biped.skeleton.bindModelFromJoint[joint].translation});
    }
    return joints;
}

std::string nameFrom(Bytes& bytes) {
    return kWords[static_cast<std::size_t>(bytes.next()) % kWords.size()];
}

vec3 offsetFrom(Bytes& bytes, float most) {
    const float x = bytes.spread(most);
    const float y = bytes.spread(most);
    return {x, y, bytes.spread(most)};
}

void change(std::vector<test::JointSpec>& joints, Bytes& bytes) {
    const int kind = bytes.next() % 5;
    const auto count = static_cast<int>(joints.size());
    const int joint = count == 0 ? 0 : bytes.next() % count;
    if (kind == 0 || count == 0) {
        if (count >= kMostJoints) return;
        const int parent = count == 0 ? -1 : bytes.next() % (count + 1) - 1;
        const vec3 base = parent < 0 ? vec3(0, 1, 0) : joints[parent].position;
        joints.push_back({nameFrom(bytes), parent, base + offsetFrom(bytes, 0.6F)});
    } else if (kind == 1) {
        joints[joint].position += offsetFrom(bytes, 0.5F);
    } else if (kind == 2) {
        joints[joint].name = nameFrom(bytes);
    } else if (kind == 3) {
        joints[joint].parent = joint == 0 ? -1 : bytes.next() % (joint + 1) - 1;
    } else {
        joints[joint].position = joints[std::max(joints[joint].parent, 0)].position;  // no length
    }
}

// A box around the way from a joint to one of its children, or upwards.
void addBox(animation::Character& figure, int joint, const vec3& end, float radius) {
    constexpr std::array<std::uint32_t, 36> kCorners = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                                        2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
    animation::SkinnedMesh& mesh = figure.meshes[0];
    const vec3 start = figure.skeleton.bindModelFromJoint[joint].translation;
    const vec3 along = end - start;
    const vec3 axis = glm::dot(along, along) > 1e-8F ? glm::normalize(along) : vec3(0, 1, 0);
    const vec3 u = anyPerpendicular(axis);
    const vec3 v = glm::cross(axis, u);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int corner = 0; corner < 8; ++corner) {
        const vec3 side = (corner % 2 == 0 ? -u : u) + (corner / 2 % 2 == 0 ? -v : v);
        mesh.positions.push_back((corner < 4 ? start : end) + radius * side);
        mesh.normals.push_back(glm::normalize(side));
        mesh.joints.push_back({static_cast<std::uint16_t>(joint), 0, 0, 0});
        mesh.weights.push_back({1, 0, 0, 0});
    }
    for (const std::uint32_t corner : kCorners)
        mesh.indices.push_back(first + corner);
    figure.skeleton.skinWeight[joint] += 8;
}

}  // namespace

animation::Character figureFrom(Bytes& bytes) {
    std::vector<test::JointSpec> joints;
    if (bytes.next() % 4 != 0) joints = bipedSpecs();
    for (int changes = bytes.next(); changes > 0 && !bytes.empty(); --changes)
        change(joints, bytes);
    if (joints.empty()) joints.push_back({"root", -1, vec3(0)});
    animation::Character figure;
    figure.name = "figure";
    figure.skeleton = test::makeSkeleton(joints);
    figure.materials.emplace_back();
    figure.meshes.emplace_back();
    for (int joint = 0; joint < figure.skeleton.jointCount(); ++joint) {
        vec3 end = joints[joint].position + vec3(0, 0.1F, 0);
        for (const test::JointSpec& child : joints) {
            if (child.parent == joint) end = child.position;
        }
        const int thick = bytes.next();
        if (thick % 8 != 7) addBox(figure, joint, end, 0.01F + 0.001F * static_cast<float>(thick));
    }
    if (figure.meshes[0].positions.empty()) figure.meshes.clear();
    return figure;
}

}  // namespace lutka::fuzz
