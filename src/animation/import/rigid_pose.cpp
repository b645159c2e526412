#include "animation/import/rigid_pose.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

#include "core/assert.hpp"

namespace lutka::animation::rig_import {

RigidPoser::RigidPoser(const NodeTree& tree, std::span<const dmat4> bindSceneFromJoint, const dmat4& modelFromScene)
    : tree_(tree), modelFromScene_(modelFromScene) {
    for (const dmat4& bind : bindSceneFromJoint) {
        const dmat4 modelFromJoint = modelFromScene * bind;
        jointFromModelBind_.push_back(glm::inverse(modelFromJoint));
        bindModelFromJoint_.push_back(rigidPart(modelFromJoint));
    }
}

double RigidPoser::pose(std::span<const dmat4> sceneFromNode, double uniformScale, std::span<const bool> matters,
                        std::span<RigidTransform> modelFromJoint) const {
    LUTKA_ASSERT(sceneFromNode.size() == tree_.nodes.size());
    double worst = 0.0;
    for (std::size_t joint = 0; joint < jointFromModelBind_.size(); ++joint) {
        const RigidTransform& bind = bindModelFromJoint_[joint];
        const dmat4 moved = modelFromScene_ * sceneFromNode[tree_.nodeOfJoint[joint]] * jointFromModelBind_[joint];
        const dvec3 origin(moved * dvec4(dvec3(bind.translation), 1.0));
        const quat turn(glm::normalize(glm::quat_cast(nearestRotation(moved))));
        modelFromJoint[joint] = {glm::normalize(turn * bind.rotation), vec3(origin / uniformScale)};
        if (!isFinite(modelFromJoint[joint])) modelFromJoint[joint] = bind;
        if (matters[joint]) worst = std::max(worst, std::abs(meanScale(moved) / uniformScale - 1.0));
    }
    return worst;
}

double RigidPoser::commonScale(std::span<const dmat4> sceneFromNode, std::span<const bool> matters) const {
    std::vector<double> scales;
    for (std::size_t joint = 0; joint < jointFromModelBind_.size(); ++joint) {
        if (!matters[joint]) continue;
        scales.push_back(meanScale(modelFromScene_ * sceneFromNode[tree_.nodeOfJoint[joint]]) *
                         meanScale(jointFromModelBind_[joint]));
    }
    if (scales.empty()) return 1.0;
    const auto middle = scales.begin() + static_cast<std::ptrdiff_t>(scales.size() / 2);
    std::nth_element(scales.begin(), middle, scales.end());
    return *middle > 1e-9 && std::isfinite(*middle) ? *middle : 1.0;
}

}  // namespace lutka::animation::rig_import
