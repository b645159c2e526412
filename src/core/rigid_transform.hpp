#pragma once

#include "core/math.hpp"

namespace lutka {

/// A rotation followed by a translation: p ↦ rotation · p + translation. Named aFromB like every transform.
struct RigidTransform {
    quat rotation{1, 0, 0, 0};  ///< Unit length.
    vec3 translation{0, 0, 0};  ///< Metres.

    [[nodiscard]] vec3 operator*(const vec3& point) const { return rotation * point + translation; }
    [[nodiscard]] RigidTransform operator*(const RigidTransform& inner) const {
        return {rotation * inner.rotation, rotation * inner.translation + translation};
    }
};

[[nodiscard]] inline RigidTransform inverse(const RigidTransform& t) {
    const quat back = glm::conjugate(t.rotation);
    return {back, -(back * t.translation)};
}

[[nodiscard]] inline mat4 toMatrix(const RigidTransform& t) {
    mat4 m = glm::mat4_cast(t.rotation);
    m[3] = vec4(t.translation, 1.0F);
    return m;
}

/// Between two transforms: translation linearly, rotation along the shorter arc (normalised linear); alpha in [0, 1].
[[nodiscard]] inline RigidTransform interpolate(const RigidTransform& a, const RigidTransform& b, float alpha) {
    const quat end = glm::dot(a.rotation, b.rotation) < 0.0F ? -b.rotation : b.rotation;
    const quat mixed = a.rotation * (1.0F - alpha) + end * alpha;
    return {glm::normalize(mixed), a.translation + (b.translation - a.translation) * alpha};
}

[[nodiscard]] inline bool isFinite(const RigidTransform& t) {
    return isFinite(t.rotation) && isFinite(t.translation);
}

}  // namespace lutka
