#pragma once

#include <glm/mat4x4.hpp>
#include <optional>
#include <span>

#include "core/rigid_transform.hpp"

namespace lutka::animation::rig_import {

/// The import's own arithmetic is in double precision: files chain scales of 0.01 and 100 over many nodes.
using glm::dmat3;
using glm::dmat4;
using glm::dvec3;
using glm::dvec4;

/// No number of it is infinite or not a number.
[[nodiscard]] bool allFinite(const dmat4& matrix);

/// The mean factor by which lengths grow: the cube root of the determinant's magnitude.
[[nodiscard]] double meanScale(const dmat4& matrix);

/// Whether all is finite and the linear part can be inverted without losing all digits.
[[nodiscard]] bool isInvertible(const dmat4& matrix);

/// The proper rotation nearest to the linear part (polar decomposition by Newton's iteration, Higham 1986). Where that
/// is a mirror, the point reflection is taken out. Columns of length zero are replaced by perpendiculars.
[[nodiscard]] dmat3 nearestRotation(const dmat4& matrix);

/// nearestRotation and the translation.
[[nodiscard]] RigidTransform rigidPart(const dmat4& matrix);

/// Angle of the rotation between two rotations, [0, pi].
[[nodiscard]] double angleBetween(const dmat3& a, const dmat3& b);

/// The affine map of least squares that takes the points `from` to the points `to`, of equal number; nothing where they
/// lie in a plane or are fewer than eight, and none that mirrors.
[[nodiscard]] std::optional<dmat4> affineBetween(std::span<const dvec3> from, std::span<const dvec3> to);

}  // namespace lutka::animation::rig_import
