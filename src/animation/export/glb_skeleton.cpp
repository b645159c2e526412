#include <array>

#include "animation/export/glb_parts.hpp"

namespace lutka::animation::glb {
namespace {

// Rounding leaves components like 1.0000001, which glTF forbids.
std::vector<double> doubles(const quat& q) {
    const glm::dquat unit = glm::normalize(glm::dquat(q));
    return {unit.x, unit.y, unit.z, unit.w};
}

std::vector<double> doubles(const vec3& v) {
    return {v.x, v.y, v.z};
}

// glTF demands the last row of an inverse bind matrix to be exactly (0, 0, 0, 1), which a rigid transform gives.
std::array<float, 16> columns(const mat4& m) {
    std::array<float, 16> out{};
    std::size_t at = 0;
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row)
            out[at++] = m[column][row];
    }
    return out;
}

}  // namespace

int addInverseBinds(const Skeleton& skeleton, BufferBuilder& buffer) {
    std::vector<std::array<float, 16>> inverseBinds;
    for (const RigidTransform& bind : skeleton.bindModelFromJoint)
        inverseBinds.push_back(columns(toMatrix(inverse(bind))));
    return buffer.add(std::span<const std::array<float, 16>>(inverseBinds), TINYGLTF_COMPONENT_TYPE_FLOAT,
                      TINYGLTF_TYPE_MAT4, 0);
}

int addSkeleton(const Skeleton& skeleton, std::span<const RigidTransform> parentFromJoint, int wrapper,
                int inverseBinds, tinygltf::Model& model) {
    const int first = static_cast<int>(model.nodes.size());
    tinygltf::Skin skin;
    skin.skeleton = wrapper;
    for (int joint = 0; joint < skeleton.jointCount(); ++joint) {
        tinygltf::Node node;
        node.name = utf8(skeleton.names[joint]);
        node.rotation = doubles(parentFromJoint[joint].rotation);
        node.translation = doubles(parentFromJoint[joint].translation);
        model.nodes.push_back(std::move(node));
        const int parent = skeleton.parents[joint];
        model.nodes[parent == kNoJoint ? wrapper : first + parent].children.push_back(first + joint);
        skin.joints.push_back(first + joint);
    }
    skin.inverseBindMatrices = inverseBinds;
    model.skins.push_back(std::move(skin));
    return static_cast<int>(model.skins.size()) - 1;
}

}  // namespace lutka::animation::glb
