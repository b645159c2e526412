#pragma once

#include <LinearMath/btTransform.h>

#include "core/rigid_transform.hpp"

/// Between our maths types and Bullet's. Both are right-handed with the same units; only the types differ.
namespace lutka::physics {

[[nodiscard]] inline btVector3 toBullet(const vec3& v) {
    return {v.x, v.y, v.z};
}
[[nodiscard]] inline btQuaternion toBullet(const quat& q) {
    return {q.x, q.y, q.z, q.w};
}
[[nodiscard]] inline btTransform toBullet(const RigidTransform& t) {
    return btTransform(toBullet(t.rotation), toBullet(t.translation));
}
[[nodiscard]] inline vec3 fromBullet(const btVector3& v) {
    return {v.x(), v.y(), v.z()};
}
[[nodiscard]] inline quat fromBullet(const btQuaternion& q) {
    return {q.w(), q.x(), q.y(), q.z()};
}
[[nodiscard]] inline RigidTransform fromBullet(const btTransform& t) {
    return {fromBullet(t.getRotation()), fromBullet(t.getOrigin())};
}
[[nodiscard]] inline mat3 fromBullet(const btMatrix3x3& m) {
    return glm::transpose(mat3(fromBullet(m[0]), fromBullet(m[1]), fromBullet(m[2])));
}

}  // namespace lutka::physics
