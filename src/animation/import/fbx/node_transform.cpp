#include "animation/import/fbx/node_transform.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include "animation/import/affine.hpp"

namespace lutka::animation::rig_import::fbx {
namespace {

// The axes in the order in which they turn.
constexpr std::array<std::array<int, 3>, 6> kOrders = {
    {{0, 1, 2}, {0, 2, 1}, {1, 2, 0}, {1, 0, 2}, {2, 0, 1}, {2, 1, 0}}};

const std::array<int, 3>& axesOf(int order) {
    return kOrders[order >= 0 && order < 6 ? static_cast<std::size_t>(order) : 0];
}

dmat3 turnAbout(int axis, double radians) {
    const double c = std::cos(radians);
    const double s = std::sin(radians);
    const int next = (axis + 1) % 3;
    const int last = (axis + 2) % 3;
    dmat3 out(1.0);
    out[next][next] = c;
    out[next][last] = s;
    out[last][next] = -s;
    out[last][last] = c;
    return out;
}

dmat3 diagonal(const dvec3& scale) {
    return {dvec3(scale.x, 0, 0), dvec3(0, scale.y, 0), dvec3(0, 0, scale.z)};
}

// A node in the scene: its frame, and apart from it what later nodes take over.
struct Placed {
    dmat4 sceneFromNode{1.0};
    dmat3 rotation{1.0};  // of all nodes down to this one, without their scales
    dvec3 scaling{1.0};   // its own
};

Placed place(const Placed& parent, const NodeTransform& transform, const dmat4& local) {
    Placed out;
    const dmat3 own = localRotation(transform);
    out.rotation = parent.rotation * own;
    out.scaling = transform[Part::scaling];
    out.sceneFromNode = parent.sceneFromNode * local;
    if (transform.inherit == Inherit::plain) return out;
    dmat3 inherited = glm::transpose(parent.rotation) * dmat3(parent.sceneFromNode);
    if (transform.inherit == Inherit::withoutScale) inherited = inherited * diagonal(1.0 / usableScale(parent.scaling));
    const dmat3 linear = out.rotation * inherited * diagonal(out.scaling);
    for (int column = 0; column < 3; ++column)
        out.sceneFromNode[column] = glm::dvec4(linear[column], 0.0);
    return out;
}

}  // namespace

std::string_view nameOf(Part part) {
    constexpr std::array<std::string_view, kPartCount> kNames = {"Lcl Translation", "Lcl Rotation",  "Lcl Scaling",
                                                                 "RotationOffset",  "RotationPivot", "PreRotation",
                                                                 "PostRotation",    "ScalingOffset", "ScalingPivot"};
    return kNames[static_cast<std::size_t>(part)];
}

NodeTransform transformOf(const Properties& properties) {
    NodeTransform out;
    for (std::size_t i = 0; i < kPartCount; ++i) {
        const Part part = static_cast<Part>(i);
        out[part] = properties.vector(nameOf(part), dvec3(part == Part::scaling ? 1.0 : 0.0));
    }
    out.rotationOrder = static_cast<int>(std::clamp<std::int64_t>(properties.integer("RotationOrder", 0), 0, 6));
    out.rotationSpace =
        properties.integer("RotationActive", 1) != 0 && properties.integer("RotationSpaceForLimitOnly", 0) == 0;
    const std::int64_t inherit = properties.integer("InheritType", 1);
    out.inherit = inherit >= 0 && inherit <= 2 ? static_cast<Inherit>(inherit) : Inherit::plain;
    return out;
}

dmat3 rotationFromEuler(const dvec3& degrees, int order) {
    dmat3 out(1.0);
    for (const int axis : axesOf(order))
        out = turnAbout(axis, glm::radians(degrees[axis])) * out;
    return out;
}

dvec3 eulerFromRotation(const dmat3& rotation, int order) {
    const auto [first, second, third] = axesOf(order);
    // R = T(third) T(second) T(first); a cyclic order has the sign of XYZ.
    const double sign = (first + 1) % 3 == second ? 1.0 : -1.0;
    dvec3 out(0);
    const double sine = std::clamp(-sign * rotation[first][third], -1.0, 1.0);
    out[second] = std::asin(sine);
    if (std::abs(sine) < 1.0 - 1e-12) {
        out[first] = std::atan2(sign * rotation[second][third], rotation[third][third]);
        out[third] = std::atan2(sign * rotation[first][second], rotation[first][first]);
    } else {
        // Both outer axes turn about the same line: the first takes it all.
        out[first] = std::atan2(-sign * rotation[third][second], rotation[second][second]);
    }
    return glm::degrees(out);
}

dmat3 localRotation(const NodeTransform& transform) {
    if (!transform.rotationSpace) return rotationFromEuler(transform[Part::rotation], 0);
    return rotationFromEuler(transform[Part::preRotation], 0) *
           rotationFromEuler(transform[Part::rotation], transform.rotationOrder) *
           glm::transpose(rotationFromEuler(transform[Part::postRotation], 0));
}

dmat4 localMatrix(const NodeTransform& transform) {
    const dmat4 one(1.0);
    const dmat4 rotated = glm::translate(one, transform[Part::translation] + transform[Part::rotationOffset] +
                                                  transform[Part::rotationPivot]) *
                          dmat4(localRotation(transform));
    const dvec3 between =
        transform[Part::scalingOffset] + transform[Part::scalingPivot] - transform[Part::rotationPivot];
    return glm::scale(glm::translate(rotated, between), transform[Part::scaling]) *
           glm::translate(one, -transform[Part::scalingPivot]);
}

dvec3 pivotInNode(const NodeTransform& transform) {
    const dvec3 scaled =
        transform[Part::rotationPivot] - transform[Part::scalingOffset] - transform[Part::scalingPivot];
    return transform[Part::scalingPivot] + scaled / usableScale(transform[Part::scaling]);
}

dvec3 usableScale(dvec3 scale) {
    for (int i = 0; i < 3; ++i) {
        if (!(std::abs(scale[i]) > 1e-12)) scale[i] = 1.0;
    }
    return scale;
}

dmat4 geometricMatrix(const Properties& properties) {
    const dmat4 turn(rotationFromEuler(properties.vector("GeometricRotation", dvec3(0)), 0));
    const dmat4 moved = glm::translate(dmat4(1.0), properties.vector("GeometricTranslation", dvec3(0)));
    return glm::scale(moved * turn, properties.vector("GeometricScaling", dvec3(1)));
}

void evaluateNodes(std::span<const NodeTransform> transforms, std::span<const int> parents,
                   std::span<dmat4> parentFromNode) {
    std::vector<Placed> placed;
    placed.reserve(transforms.size());
    for (std::size_t i = 0; i < transforms.size(); ++i) {
        const Placed& parent = parents[i] < 0 ? Placed{} : placed[static_cast<std::size_t>(parents[i])];
        const dmat4 local = localMatrix(transforms[i]);
        placed.push_back(place(parent, transforms[i], local));
        parentFromNode[i] = local;
        if (transforms[i].inherit != Inherit::plain && isInvertible(parent.sceneFromNode))
            parentFromNode[i] = glm::inverse(parent.sceneFromNode) * placed.back().sceneFromNode;
    }
}

}  // namespace lutka::animation::rig_import::fbx
