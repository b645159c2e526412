#pragma once

#include <array>
#include <cstddef>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "animation/import/fbx/objects.hpp"

namespace lutka::animation::rig_import::fbx {

using glm::dmat3;
using glm::dmat4;
using glm::dvec3;

/// How a node takes over its parent's scale. R and r are the parent's and the node's rotation, S and s their scales.
enum class Inherit {
    rotationThenScale = 0,  ///< R r S s
    plain = 1,              ///< R S r s: the product of matrices
    withoutScale = 2,       ///< R r s: the parent's own scale is not inherited (Maya's segment scale compensate).
};

/// What a node's transform is made of, in degrees and the file's unit.
enum class Part : std::size_t {
    translation,
    rotation,
    scaling,
    rotationOffset,
    rotationPivot,
    preRotation,
    postRotation,
    scalingOffset,
    scalingPivot,
    count
};
inline constexpr std::size_t kPartCount = static_cast<std::size_t>(Part::count);

/// The property's name in the file ("Lcl Translation" …).
[[nodiscard]] std::string_view nameOf(Part part);

struct NodeTransform {
    std::array<dvec3, kPartCount> parts{};
    int rotationOrder = 0;      ///< 0 XYZ, 1 XZY, 2 YZX, 3 YXZ, 4 ZXY, 5 ZYX: the first axis turns first.
    bool rotationSpace = true;  ///< Whether pre-rotation, post-rotation and the order count.
    Inherit inherit = Inherit::plain;

    [[nodiscard]] const dvec3& operator[](Part part) const { return parts[static_cast<std::size_t>(part)]; }
    [[nodiscard]] dvec3& operator[](Part part) { return parts[static_cast<std::size_t>(part)]; }
};

[[nodiscard]] NodeTransform transformOf(const Properties& properties);

/// The rotation by three angles in degrees about the axes in that order (NodeTransform::rotationOrder).
[[nodiscard]] dmat3 rotationFromEuler(const dvec3& degrees, int order);

/// The angles that give the rotation back, in degrees.
[[nodiscard]] dvec3 eulerFromRotation(const dmat3& rotation, int order);

/// Pre-rotation, rotation and inverse post-rotation.
[[nodiscard]] dmat3 localRotation(const NodeTransform& transform);

/// T Roff Rp Rpre R Rpost⁻¹ Rp⁻¹ Soff Sp S Sp⁻¹ (FBX SDK, "Computing transformation matrices").
[[nodiscard]] dmat4 localMatrix(const NodeTransform& transform);

/// The place in the node's frame that its rotation leaves where it is.
[[nodiscard]] dvec3 pivotInNode(const NodeTransform& transform);

/// The scale with 1 in place of zeros, which can't be taken out again.
[[nodiscard]] dvec3 usableScale(dvec3 scale);

/// The geometric transform: where a node's meshes, but not its children, stand in the node.
[[nodiscard]] dmat4 geometricMatrix(const Properties& properties);

/// The parent-relative frames of nodes, parents before children (`parents`: -1 for a root), with each node's way of
/// inheriting scale worked in. All spans have one element a node.
void evaluateNodes(std::span<const NodeTransform> transforms, std::span<const int> parents,
                   std::span<dmat4> parentFromNode);

}  // namespace lutka::animation::rig_import::fbx
