#include "animation/import/figure_file.hpp"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <vector>

#include "support/rigs.hpp"

namespace lutka::test {
namespace {

mat4 matrixOf(const RigidTransform& frame) {
    return glm::translate(mat4(1.0F), frame.translation) * glm::mat4_cast(frame.rotation);
}

nlohmann::json primitiveOf(GltfFile& file, const animation::SkinnedMesh& mesh) {
    std::vector<float> positions;
    std::vector<std::uint16_t> joints;
    std::vector<float> weights;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const vec3& p = mesh.positions[v];
        positions.insert(positions.end(), {p.x, p.y, p.z});
        joints.insert(joints.end(), mesh.joints[v].begin(), mesh.joints[v].end());
        weights.insert(weights.end(), mesh.weights[v].begin(), mesh.weights[v].end());
    }
    const std::vector<std::uint16_t> indices(mesh.indices.begin(), mesh.indices.end());
    nlohmann::json attributes;
    attributes["POSITION"] = file.addFloats(positions, "VEC3");
    attributes["JOINTS_0"] = file.addComponents<std::uint16_t>(joints, 5123, "VEC4", mesh.positions.size(), false);
    attributes["WEIGHTS_0"] = file.addFloats(weights, "VEC4");
    return {{"attributes", attributes}, {"indices", file.addIndices(indices)}};
}

}  // namespace

void addFigure(GltfFile& file, const animation::Character& character, const std::string& name, const vec3& place) {
    const int root = file.addNode(name, -1, glm::translate(mat4(1.0F), place));
    const animation::Skeleton& skeleton = character.skeleton;
    std::vector<int> nodes;
    std::vector<mat4> jointFromMesh;
    for (int joint = 0; joint < skeleton.jointCount(); ++joint) {
        const mat4 modelFromJoint = matrixOf(skeleton.bindModelFromJoint[joint]);
        const int parent = skeleton.parents[joint];
        const mat4 parentFromModel =
            parent == animation::kNoJoint ? mat4(1.0F) : glm::inverse(matrixOf(skeleton.bindModelFromJoint[parent]));
        nodes.push_back(file.addNode(skeleton.names[joint], parent == animation::kNoJoint ? root : nodes[parent],
                                     parentFromModel * modelFromJoint));
        jointFromMesh.push_back(glm::inverse(modelFromJoint));
    }
    const int skin = addSkin(file, nodes, jointFromMesh);
    for (const animation::SkinnedMesh& mesh : character.meshes) {
        const int node = file.addNode(name + " skin", root);
        file.json["nodes"][node]["mesh"] = file.json["meshes"].size();
        file.json["nodes"][node]["skin"] = skin;
        file.json["meshes"].push_back({{"name", name}, {"primitives", {primitiveOf(file, mesh)}}});
    }
}

GltfFile makePair() {
    const animation::Character anna = makeBiped();
    animation::Character bert = makeBiped();
    for (auto* frames : {&bert.skeleton.bindModelFromJoint, &bert.skeleton.nodeParentFromJoint}) {
        for (RigidTransform& frame : *frames)
            frame.translation *= 0.8F;
    }
    for (vec3& position : bert.meshes[0].positions)
        position *= 0.8F;
    bert.meshes.push_back(bert.meshes[0]);
    GltfFile file;
    addFigure(file, anna, "Anna");
    addFigure(file, bert, "Bert", vec3(2, 0, 0));
    return file;
}

}  // namespace lutka::test
