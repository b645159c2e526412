#include "support/rigs.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

namespace lutka::test {
namespace {

using animation::Role;

// Named by role, so that the map of the figure is its own truth.
const std::vector<JointSpec>& bipedJoints() {
    static const std::vector<JointSpec> joints = {
        {"hips", -1, {0, 0.95F, 0}},
        {"spine", 0, {0, 1.05F, 0}},
        {"chest", 1, {0, 1.20F, 0}},
        {"neck", 2, {0, 1.48F, 0}},
        {"head", 3, {0, 1.56F, 0}},
        {"leftShoulder", 2, {0.04F, 1.42F, 0}},
        {"leftUpperArm", 5, {0.18F, 1.42F, 0}},
        {"leftLowerArm", 6, {0.46F, 1.42F, 0}},
        {"leftHand", 7, {0.72F, 1.42F, 0}},
        {"rightShoulder", 2, {-0.04F, 1.42F, 0}},
        {"rightUpperArm", 9, {-0.18F, 1.42F, 0}},
        {"rightLowerArm", 10, {-0.46F, 1.42F, 0}},
        {"rightHand", 11, {-0.72F, 1.42F, 0}},
        {"leftUpperLeg", 0, {0.10F, 0.90F, 0}},
        {"leftLowerLeg", 13, {0.10F, 0.50F, 0}},
        {"leftFoot", 14, {0.10F, 0.09F, 0}},
        {"rightUpperLeg", 0, {-0.10F, 0.90F, 0}},
        {"rightLowerLeg", 16, {-0.10F, 0.50F, 0}},
        {"rightFoot", 17, {-0.10F, 0.09F, 0}},
    };
    return joints;
}

struct Part {
    int joint;
    vec3 end;  // the part runs from its joint to here
    float radius;
};

// Half the thickness of each part, roughly a man's.
const std::vector<Part>& bipedParts() {
    static const std::vector<Part> parts = {
        {0, {0, 0.85F, 0}, 0.15F},           {1, {0, 1.20F, 0}, 0.13F},       {2, {0, 1.45F, 0}, 0.15F},
        {3, {0, 1.56F, 0}, 0.06F},           {4, {0, 1.75F, 0}, 0.09F},       {5, {0.18F, 1.42F, 0}, 0.06F},
        {6, {0.46F, 1.42F, 0}, 0.05F},       {7, {0.72F, 1.42F, 0}, 0.04F},   {8, {0.90F, 1.42F, 0}, 0.03F},
        {9, {-0.18F, 1.42F, 0}, 0.06F},      {10, {-0.46F, 1.42F, 0}, 0.05F}, {11, {-0.72F, 1.42F, 0}, 0.04F},
        {12, {-0.90F, 1.42F, 0}, 0.03F},     {13, {0.10F, 0.50F, 0}, 0.08F},  {14, {0.10F, 0.09F, 0}, 0.055F},
        {15, {0.10F, 0.03F, 0.18F}, 0.04F},  {16, {-0.10F, 0.50F, 0}, 0.08F}, {17, {-0.10F, 0.09F, 0}, 0.055F},
        {18, {-0.10F, 0.03F, 0.18F}, 0.04F},
    };
    return parts;
}

constexpr int kRings = 9;
constexpr int kSegments = 12;

// A closed tube around the part, its end rings drawn in to half the radius.
void addTube(animation::SkinnedMesh& mesh, const vec3& start, const Part& part) {
    const vec3 axis = glm::normalize(part.end - start);
    const vec3 u = anyPerpendicular(axis);
    const vec3 v = glm::cross(axis, u);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int ring = 0; ring < kRings; ++ring) {
        const float along = static_cast<float>(ring) / (kRings - 1);
        const float radius = part.radius * (ring == 0 || ring == kRings - 1 ? 0.5F : 1.0F);
        for (int segment = 0; segment < kSegments; ++segment) {
            const float angle = 2.0F * kPi * static_cast<float>(segment) / kSegments;
            const vec3 out = std::cos(angle) * u + std::sin(angle) * v;
            mesh.positions.push_back(start + along * (part.end - start) + radius * out);
            mesh.normals.push_back(out);
            mesh.uvs.emplace_back(static_cast<float>(segment) / kSegments, along);
            mesh.joints.push_back({static_cast<std::uint16_t>(part.joint), 0, 0, 0});
            mesh.weights.push_back({1, 0, 0, 0});
        }
    }
    for (std::uint32_t ring = 0; ring + 1 < kRings; ++ring) {
        for (std::uint32_t segment = 0; segment < kSegments; ++segment) {
            const std::uint32_t next = (segment + 1) % kSegments;
            const std::uint32_t a = first + ring * kSegments + segment;
            const std::uint32_t b = first + ring * kSegments + next;
            mesh.indices.insert(mesh.indices.end(), {a, b, b + kSegments, a, b + kSegments, a + kSegments});
        }
    }
}

}  // namespace

animation::Skeleton makeSkeleton(const std::vector<JointSpec>& joints) {
    animation::Skeleton skeleton;
    for (const JointSpec& joint : joints) {
        const vec3 base = joint.parent < 0 ? vec3(0) : joints[joint.parent].position;
        skeleton.names.push_back(joint.name);
        skeleton.parents.push_back(joint.parent);
        skeleton.bindModelFromJoint.push_back({quat(1, 0, 0, 0), joint.position});
        skeleton.nodeParentFromJoint.push_back({quat(1, 0, 0, 0), joint.position - base});
        skeleton.skinWeight.push_back(0.0F);
    }
    return skeleton;
}

animation::Character makeBiped() {
    animation::Character biped;
    biped.name = "biped";
    biped.skeleton = makeSkeleton(bipedJoints());
    biped.materials.emplace_back();
    animation::SkinnedMesh& mesh = biped.meshes.emplace_back();
    mesh.name = "skin";
    for (const Part& part : bipedParts()) {
        addTube(mesh, bipedJoints()[part.joint].position, part);
        biped.skeleton.skinWeight[part.joint] += kRings * kSegments;
    }
    return biped;
}

animation::HumanoidMap mapOfBiped(const animation::Character& biped) {
    animation::HumanoidMap map;
    map.humanoid = true;
    map.confidence = 1.0F;
    for (int joint = 0; joint < biped.skeleton.jointCount(); ++joint) {
        if (const auto role = animation::roleFromName(biped.skeleton.names[joint])) {
            map.roles[animation::indexOf(*role)] = animation::RoleBinding{joint, 1.0F, "hand-made"};
        }
    }
    return map;
}

}  // namespace lutka::test
