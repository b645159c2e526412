#include "physics/bullet/drag_constraint.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "physics/bullet/convert.hpp"

namespace lutka::physics {

DragConstraint::DragConstraint(btRigidBody& body, const Drag& drag)
    : ForceConstraint(POINT2POINT_CONSTRAINT_TYPE, body), drag_(drag) {
    setJointFeedback(&feedback_);
}

vec3 DragConstraint::arm() const {
    return fromBullet(m_rbA.getWorldTransform().getBasis()) * drag_.bodyPoint;
}

vec3 DragConstraint::pointVelocity() const {
    return fromBullet(m_rbA.getLinearVelocity()) + glm::cross(fromBullet(m_rbA.getAngularVelocity()), arm());
}

vec3 DragConstraint::force() const {
    return fromBullet(feedback_.m_appliedForceBodyA);
}

void DragConstraint::getInfo1(btConstraintInfo1* info) {
    info->m_numConstraintRows = 3;
    info->nub = 0;
}

void DragConstraint::getInfo2(btConstraintInfo2* info) {
    const vec3 r = arm();
    const vec3 gap =
        drag_.worldTarget - drag_.worldVelocity * remaining_ - fromBullet(m_rbA.getWorldTransform().getOrigin()) - r;
    const float distance = glm::length(gap);
    const vec3 target =
        drag_.worldVelocity + gap * std::min(1.0F / kSeconds, distance > 0.0F ? kMaxSpeed / distance : 0.0F);
    // The bound holds for the whole force, so each axis gets its share.
    const float perAxis = drag_.maxForceN / (std::sqrt(3.0F) * info->fps);
    for (int i = 0; i < 3; ++i) {
        vec3 direction(0);
        direction[i] = 1.0F;
        const vec3 angular = glm::cross(r, direction);
        const int at = i * info->rowskip;
        for (int k = 0; k < 3; ++k) {
            info->m_J1linearAxis[at + k] = direction[k];
            info->m_J1angularAxis[at + k] = angular[k];
        }
        info->m_constraintError[at] = target[i];
        info->m_lowerLimit[at] = -perAxis;
        info->m_upperLimit[at] = perAxis;
    }
}

}  // namespace lutka::physics
