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

// Half the thickness of each part, roughly a man's.
const std::vector<TubeSpec>& bipedParts() {
    static const std::vector<TubeSpec> parts = {
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

void addTube(animation::SkinnedMesh& mesh, const vec3& start, const TubeSpec& part) {
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

animation::Character makeFigure(const std::string& name, const std::vector<JointSpec>& joints,
                                const std::vector<TubeSpec>& tubes) {
    animation::Character figure;
    figure.name = name;
    figure.skeleton = makeSkeleton(joints);
    figure.materials.emplace_back();
    animation::SkinnedMesh& mesh = figure.meshes.emplace_back();
    mesh.name = "skin";
    for (const TubeSpec& tube : tubes) {
        addTube(mesh, joints[tube.joint].position, tube);
        figure.skeleton.skinWeight[tube.joint] += kRings * kSegments;
    }
    return figure;
}

animation::Character makeBiped() {
    return makeFigure("biped", bipedJoints(), bipedParts());
}

animation::Character makeQuadruped() {
    std::vector<JointSpec> joints = {
        {"root", -1, {0, 0, 0}},           {"pelvis", 0, {0, 0.50F, -0.30F}},   {"back", 1, {0, 0.55F, -0.08F}},
        {"ribs", 2, {0, 0.55F, 0.14F}},    {"neck1", 3, {0, 0.60F, 0.30F}},     {"skull", 4, {0, 0.72F, 0.40F}},
        {"jaw", 5, {0, 0.69F, 0.47F}},     {"eye_l", 5, {0.03F, 0.76F, 0.50F}}, {"eye_r", 5, {-0.03F, 0.76F, 0.50F}},
        {"tail1", 1, {0, 0.50F, -0.36F}},  {"tail2", 9, {0, 0.47F, -0.46F}},    {"tail3", 10, {0, 0.44F, -0.56F}},
        {"tail4", 11, {0, 0.41F, -0.66F}},
    };
    std::vector<TubeSpec> tubes = {
        {1, {0, 0.55F, -0.08F}, 0.10F},    {2, {0, 0.55F, 0.14F}, 0.11F},      {3, {0, 0.60F, 0.30F}, 0.11F},
        {4, {0, 0.72F, 0.40F}, 0.06F},     {5, {0, 0.73F, 0.58F}, 0.06F},      {6, {0, 0.66F, 0.58F}, 0.02F},
        {7, {0.03F, 0.76F, 0.51F}, 0.01F}, {8, {-0.03F, 0.76F, 0.51F}, 0.01F}, {9, {0, 0.47F, -0.46F}, 0.03F},
        {10, {0, 0.44F, -0.56F}, 0.025F},  {11, {0, 0.41F, -0.66F}, 0.02F},    {12, {0, 0.38F, -0.76F}, 0.015F},
    };
    for (const float side : {-1.0F, 1.0F}) {  // the right one first: order must not matter
        for (const bool fore : {true, false}) {
            const float z = fore ? 0.16F : -0.30F;
            const std::string end = std::string(fore ? "_fore" : "_hind") + (side > 0 ? "_l" : "_r");
            const int first = static_cast<int>(joints.size());
            joints.push_back({"thigh" + end, fore ? 3 : 1, {side * 0.09F, 0.48F, z}});
            joints.push_back({"shin" + end, first, {side * 0.09F, 0.26F, z}});
            joints.push_back({"paw" + end, first + 1, {side * 0.09F, 0.06F, z}});
            joints.push_back({"twist" + end, first, {side * 0.09F, 0.37F, z}});
            tubes.push_back({first, {side * 0.09F, 0.26F, z}, 0.045F});
            tubes.push_back({first + 1, {side * 0.09F, 0.06F, z}, 0.03F});
            tubes.push_back({first + 2, {side * 0.09F, 0.03F, z + 0.09F}, 0.025F});
            tubes.push_back({first + 3, {side * 0.09F, 0.30F, z}, 0.045F});
        }
    }
    return makeFigure("quadruped", joints, tubes);
}

animation::Character makeBipedWithAppendages() {
    std::vector<JointSpec> joints = bipedJoints();
    std::vector<TubeSpec> tubes = bipedParts();
    const auto add = [&](const std::string& name, int parent, const vec3& at, const vec3& end, float radius) {
        joints.push_back({name, parent, at});
        const int joint = static_cast<int>(joints.size()) - 1;
        tubes.push_back({joint, end, radius});
        return joint;
    };
    const int tail = add("tail_01", 0, {0, 0.93F, -0.14F}, {0, 0.85F, -0.34F}, 0.04F);
    const int middle = add("tail_02", tail, {0, 0.85F, -0.34F}, {0, 0.78F, -0.54F}, 0.03F);
    add("tail_03", middle, {0, 0.78F, -0.54F}, {0, 0.72F, -0.74F}, 0.02F);
    for (const float side : {1.0F, -1.0F}) {
        add(side > 0 ? "ear_L" : "ear_R", 4, {side * 0.06F, 1.72F, 0}, {side * 0.10F, 1.86F, 0}, 0.02F);
        const int hand = side > 0 ? 8 : 12;
        add(side > 0 ? "finger_L" : "finger_R", hand, {side * 0.84F, 1.42F, 0}, {side * 0.92F, 1.42F, 0}, 0.01F);
    }
    const int hair = add("ponytail1", 4, {0, 1.70F, -0.10F}, {0, 1.56F, -0.18F}, 0.03F);
    add("ponytail2", hair, {0, 1.56F, -0.18F}, {0, 1.40F, -0.20F}, 0.025F);
    add("sword", 12, {-0.80F, 1.42F, 0.02F}, {-0.80F, 1.42F, 0.90F}, 0.02F);
    return makeFigure("biped with appendages", joints, tubes);
}

void addRoot(animation::Character& figure, animation::HumanoidMap& map) {
    animation::Skeleton& skeleton = figure.skeleton;
    skeleton.names.insert(skeleton.names.begin(), "Scene");
    skeleton.bindModelFromJoint.insert(skeleton.bindModelFromJoint.begin(), RigidTransform{});
    skeleton.nodeParentFromJoint.insert(skeleton.nodeParentFromJoint.begin(), RigidTransform{});
    skeleton.skinWeight.insert(skeleton.skinWeight.begin(), 0.0F);
    for (int& parent : skeleton.parents)
        ++parent;
    skeleton.parents.insert(skeleton.parents.begin(), animation::kNoJoint);
    for (animation::SkinnedMesh& mesh : figure.meshes) {
        for (auto& joints : mesh.joints) {
            for (std::uint16_t& joint : joints)
                ++joint;
        }
    }
    for (auto& role : map.roles) {
        if (role) ++role->joint;
    }
}

void addParts(animation::Character& character, int count, const std::string& name, int group) {
    animation::Skeleton& skeleton = character.skeleton;
    const auto add = [&](const std::string& joint, int parent, const vec3& place, float weight) {
        skeleton.names.push_back(joint);
        skeleton.parents.push_back(parent);
        RigidTransform frame;
        frame.translation = place;
        skeleton.bindModelFromJoint.push_back(frame);
        skeleton.nodeParentFromJoint.emplace_back();
        skeleton.skinWeight.push_back(weight);
        return skeleton.jointCount() - 1;
    };
    const int room = add("room", -1, {0, 0, 0}, 0.0F);
    int holder = room;
    for (int part = 0; part < count; ++part) {
        const vec3 place(static_cast<float>(part % 40) * 0.3F - 6.0F, 0.1F * static_cast<float>(part / 1600),
                         static_cast<float>(part / 40 % 40) * 0.3F + 1.0F);
        if (group > 0 && part % group == 0) holder = add("group", room, {0, 0, 0}, 0.0F);
        const int node = add(name + std::to_string(part), holder, place, 3.0F);
        animation::SkinnedMesh mesh;
        mesh.rigid = true;
        mesh.positions = {place, place + vec3(0.1F, 0, 0), place + vec3(0, 0.1F, 0)};
        mesh.joints.assign(3, {static_cast<std::uint16_t>(node), 0, 0, 0});
        mesh.weights.assign(3, {1, 0, 0, 0});
        mesh.indices = {0, 1, 2};
        character.meshes.push_back(mesh);
    }
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
