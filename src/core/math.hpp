#pragma once

/// The maths types of every public header: glm's, right-handed, Y up, column vectors, metres, radians.
/// Quaternions are unit rotations. Transforms are named aFromB, so that products read left to right.

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <numbers>

namespace lutka {

using glm::mat3;
using glm::mat4;
using glm::quat;
using glm::vec2;
using glm::vec3;
using glm::vec4;

inline constexpr float kPi = std::numbers::pi_v<float>;

[[nodiscard]] constexpr float radians(float angleDeg) {
    return angleDeg * (kPi / 180.0F);
}
[[nodiscard]] constexpr float degrees(float angle) {
    return angle * (180.0F / kPi);
}

[[nodiscard]] inline bool isFinite(const vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
/// Metres: places of a file beyond this are no sound ones. What is worked out from places within stays finite in float.
inline constexpr float kFarthestPlaceM = 1e9F;
[[nodiscard]] inline bool isPlace(const vec3& v) {
    return std::abs(v.x) <= kFarthestPlaceM && std::abs(v.y) <= kFarthestPlaceM && std::abs(v.z) <= kFarthestPlaceM;
}
[[nodiscard]] inline bool isFinite(const quat& q) {
    return std::isfinite(q.x) && std::isfinite(q.y) && std::isfinite(q.z) && std::isfinite(q.w);
}

/// The shortest rotation that takes direction `from` to direction `to` (any lengths above zero; opposite directions
/// turn about some axis across them).
[[nodiscard]] quat rotationBetween(const vec3& from, const vec3& to);

/// Rotation vector (axis times angle, the angle in [0, pi]) of a unit quaternion.
[[nodiscard]] vec3 rotationVector(const quat& rotation);

/// Some unit vector across `direction` (unit length), always the same one for the same input.
[[nodiscard]] vec3 anyPerpendicular(const vec3& direction);

/// The rotation whose columns are x, y and x × y: `x` is kept, `y` is made perpendicular to it.
/// Both need a length above zero and must not be parallel.
[[nodiscard]] quat rotationFromXY(const vec3& x, const vec3& y);

/// Makes a symmetric matrix diagonal by Jacobi's rotations. Returns the axes in its columns: what came in is
/// axes · matrix · transpose(axes) of what comes out.
[[nodiscard]] mat3 diagonalise(mat3& matrix);

}  // namespace lutka
