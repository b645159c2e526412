#pragma once

#include <btBulletDynamicsCommon.h>

#include "core/simd/vector4.hpp"

/// What SubstepSolver remembers of a contact from substep to substep, in the fields of Bullet's own contact point.
namespace lutka::physics {

using simd::F4;

/// Impulse against rolling and spinning, world, N m s. Bullet has no such field: it lies in those of moving surfaces
/// and soft friction, which only Bullet's solver reads and new points have at 0.
[[nodiscard]] inline F4 rollingImpulse(const btManifoldPoint& point) {
    return F4{point.m_contactMotion1, point.m_contactMotion2, point.m_frictionCFM, 0.0F};
}
inline void setRollingImpulse(btManifoldPoint& point, const F4& impulse) {
    point.m_contactMotion1 = impulse[0];
    point.m_contactMotion2 = impulse[1];
    point.m_frictionCFM = impulse[2];
}

/// What a point leaves to the one that takes its place.
struct ContactImpulses {
    int feature = 0;  ///< btManifoldPoint::m_index0
    int age = 0;      ///< Substeps.
    float normal = 0;
    float tangents[2] = {0, 0};
    F4 rolling{};
};

[[nodiscard]] inline ContactImpulses impulsesOf(const btManifoldPoint& point) {
    return {point.m_index0,
            point.m_lifeTime,
            point.m_appliedImpulse,
            {point.m_appliedImpulseLateral1, point.m_appliedImpulseLateral2},
            rollingImpulse(point)};
}
inline void setImpulses(btManifoldPoint& point, const ContactImpulses& impulses) {
    point.m_appliedImpulse = impulses.normal;
    point.m_appliedImpulseLateral1 = impulses.tangents[0];
    point.m_appliedImpulseLateral2 = impulses.tangents[1];
    setRollingImpulse(point, impulses.rolling);
    point.m_lifeTime = impulses.age;
}

}  // namespace lutka::physics
