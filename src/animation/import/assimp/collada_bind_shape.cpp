#include "animation/import/assimp/collada_bind_shape.hpp"

#include <algorithm>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "animation/import/affine.hpp"

namespace lutka::animation::rig_import {
namespace {

bool isByBlender(std::string_view document) {
    constexpr std::string_view kTool = "<authoring_tool>";
    const std::size_t tool = document.find(kTool);
    return tool != std::string_view::npos && document.substr(tool + kTool.size()).starts_with("Blender");
}

// Without the topmost node, which Assimp gives the document's axis and unit.
dmat4 sceneFromParent(const SourceScene& scene, int node) {
    dmat4 place(1.0);
    for (int at = scene.nodes[node].parent; at >= 0 && scene.nodes[at].parent >= 0; at = scene.nodes[at].parent)
        place = scene.nodes[at].parentFromNode * place;
    return place;
}

// How far vertices lie from the joints that move them where the mesh stands at `sceneFromMesh` when bound: a sum, in
// the mesh's own unit.
double distanceToJoints(const SourceMesh& mesh, const SourceSkin& skin, const dmat4& sceneFromMesh) {
    constexpr std::size_t kVertices = 2000;
    double sum = 0.0;
    const std::size_t stride = mesh.positions.size() / kVertices + 1;
    for (std::size_t vertex = 0; vertex < mesh.positions.size(); vertex += stride) {
        const dvec3 place(sceneFromMesh * dvec4(dvec3(mesh.positions[vertex]), 1.0));
        for (std::size_t i = mesh.influenceStart[vertex]; i < mesh.influenceStart[vertex + 1]; ++i) {
            const dmat4 sceneFromJoint = glm::inverse(skin.joints[mesh.influences[i].slot].jointFromMesh);
            sum += static_cast<double>(mesh.influences[i].weight) * glm::distance(place, dvec3(sceneFromJoint[3]));
        }
    }
    return sum / meanScale(sceneFromMesh);
}

}  // namespace

void completeBindShapes(std::string_view document, SourceScene& scene) {
    constexpr double kFarther = 1.25;  // old versions wrote what Collada asks: there it would be far off
    if (!isByBlender(document)) return;
    for (const SourceInstance& instance : scene.instances) {
        if (instance.skin < 0) continue;
        const SourceMesh& mesh = scene.meshes[instance.mesh];
        SourceSkin& skin = scene.skins[instance.skin];
        const dmat4 parent = sceneFromParent(scene, instance.node);
        const dmat4& written = scene.nodes[instance.node].parentFromNode;
        const bool solvable = isInvertible(parent) && isInvertible(written) &&
                              std::all_of(skin.joints.begin(), skin.joints.end(), [](const SourceSkin::Joint& joint) {
                                  return isInvertible(joint.jointFromMesh);
                              });
        if (!solvable || mesh.influenceStart.empty()) continue;
        // The inverse bind matrices hold the written matrix already; the mesh lies in the space before it.
        const dmat4 meant = glm::inverse(written) * parent * written;
        if (distanceToJoints(mesh, skin, meant) > kFarther * distanceToJoints(mesh, skin, dmat4(1.0))) continue;
        for (SourceSkin::Joint& joint : skin.joints)
            joint.jointFromMesh = joint.jointFromMesh * meant;
    }
}

}  // namespace lutka::animation::rig_import
