#pragma once

#include <btBulletDynamicsCommon.h>

#include "physics/bullet/simd4.hpp"

/// What SubstepSolver remembers of a contact from substep to substep, in the fields of Bullet's own contact point.
namespace lutka::physics {

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

/// A point goes on with the impulses of the one that it takes the place of.
inline void carryImpulses(const btManifoldPoint& from, btManifoldPoint& to) {
    to.m_appliedImpulse = from.m_appliedImpulse;
    to.m_appliedImpulseLateral1 = from.m_appliedImpulseLateral1;
    to.m_appliedImpulseLateral2 = from.m_appliedImpulseLateral2;
    setRollingImpulse(to, rollingImpulse(from));
    to.m_lifeTime = from.m_lifeTime + 1;
}

}  // namespace lutka::physics
