#include "animation/import/rigid_pose.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

#include "core/assert.hpp"

namespace lutka::animation::rig_import {
namespace {

// How far the linear part stretches or shears beyond the rotation: 0.2 for a scale of 1.2, along whichever axis.
double stretchBeyond(const dmat3& rotation, const dmat3& linear) {
    const dmat3 stretch = glm::transpose(rotation) * linear - dmat3(1.0);
    return std::max({glm::length(stretch[0]), glm::length(stretch[1]), glm::length(stretch[2])});
}

}  // namespace

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
        const dmat3 rotation = nearestRotation(moved);
        const quat turn(glm::normalize(glm::quat_cast(rotation)));
        modelFromJoint[joint] = {glm::normalize(turn * bind.rotation), vec3(origin / uniformScale)};
        const bool sound = isFinite(modelFromJoint[joint].rotation) && isPlace(modelFromJoint[joint].translation);
        if (!sound) modelFromJoint[joint] = bind;
        if (matters[joint]) worst = std::max(worst, stretchBeyond(rotation, dmat3(moved) / uniformScale));
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
    // No figure shrinks or grows so much all over: another unit, in which it may have scales of its own besides. That
    // of the topmost joint leaves the figure most of its shape.
    constexpr double kUnit = 5.0;
    const auto [least, most] = std::minmax_element(scales.begin(), scales.end());
    const bool isUnit = *least > kUnit || *most < 1.0 / kUnit;
    const double first = scales.front();
    const auto middle = scales.begin() + static_cast<std::ptrdiff_t>(scales.size() / 2);
    std::nth_element(scales.begin(), middle, scales.end());
    const double scale = *middle;
    if (!(scale > 1e-9) || !std::isfinite(scale)) return 1.0;
    // Another unit is that of nearly all joints; what shrinks within a figure is no unit.
    constexpr double kAlike = 0.05;
    constexpr double kNearlyAll = 0.75;
    const auto alike = std::count_if(scales.begin(), scales.end(),
                                     [&](double other) { return std::abs(other / scale - 1.0) <= kAlike; });
    if (static_cast<double>(alike) >= kNearlyAll * static_cast<double>(scales.size())) return scale;
    return isUnit && first > 1e-9 && std::isfinite(first) ? first : 1.0;
}

}  // namespace lutka::animation::rig_import
