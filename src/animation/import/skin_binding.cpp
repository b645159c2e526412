#include "animation/import/skin_binding.hpp"

#include <fmt/format.h>

#include <cmath>

#include "animation/import/name_list.hpp"

namespace lutka::animation::rig_import {
namespace {

std::vector<double> weightsOfSlots(const SourceMesh& mesh, std::size_t slots) {
    std::vector<double> weights(slots, 0.0);
    for (const SourceMesh::Influence& influence : mesh.influences) {
        if (influence.weight > 0.0F && std::isfinite(influence.weight)) weights[influence.slot] += influence.weight;
    }
    return weights;
}

void bindJoints(const SourceScene& scene, const SourceSkin& skin, const NodeTree& tree, MeshInstance& instance,
                std::vector<std::string>& unusable) {
    const std::vector<double> weights = weightsOfSlots(*instance.mesh, skin.joints.size());
    instance.jointOfSlot.assign(skin.joints.size(), -1);
    for (std::size_t slot = 0; slot < skin.joints.size(); ++slot) {
        const SourceSkin::Joint& source = skin.joints[slot];
        if (!(weights[slot] > 0.0)) continue;
        if (!isInvertible(source.jointFromMesh)) {
            unusable.push_back(fmt::format("{} of {}", scene.nodes[source.node].name, instance.mesh->name));
            continue;
        }
        instance.jointOfSlot[slot] = tree.nodes[source.node].joint;
        instance.joints.push_back({tree.nodes[source.node].joint, source.jointFromMesh, weights[slot]});
    }
}

}  // namespace

std::vector<MeshInstance> bindMeshes(const SourceScene& scene, const NodeTree& tree,
                                     std::vector<std::string>& warnings) {
    std::vector<MeshInstance> instances;
    std::vector<std::string> unusable;
    for (const SourceInstance& source : scene.instances) {
        MeshInstance instance;
        instance.mesh = &scene.meshes[source.mesh];
        instance.node = source.node;
        if (instance.mesh->positions.empty()) continue;
        if (source.skin >= 0) {
            const SourceSkin& skin = scene.skins[source.skin];
            bindJoints(scene, skin, tree, instance, unusable);
            instance.sceneFromMesh = skin.sceneFromMesh;
            instance.verticesAreInJoints = skin.verticesAreInJoints;
        }
        instances.push_back(std::move(instance));
    }
    if (!unusable.empty()) {
        warnings.push_back(fmt::format(
            "joints whose bind matrix is flat move no skin, and their weights were left out: {}", firstOf(unusable)));
    }
    return instances;
}

}  // namespace lutka::animation::rig_import
