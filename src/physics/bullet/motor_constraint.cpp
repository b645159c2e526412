#include "physics/bullet/motor_constraint.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "physics/bullet/convert.hpp"
#include "physics/world/joint_error.hpp"

namespace lutka::physics {

MotorConstraint::MotorConstraint(const ConstraintProfile& profile, btRigidBody& parent, btRigidBody& child)
    : ForceConstraint(D6_CONSTRAINT_TYPE, parent, child), profile_(profile) {}

void MotorConstraint::prepare(float seconds) {
    const MotorError found = motorError(profile_, motor_, fromBullet(m_rbA.getWorldTransform()).rotation,
                                        fromBullet(m_rbB.getWorldTransform()).rotation);
    axes_ = found.axes;
    rows_ = found.count;
    const float firmness = motor_.damping + seconds * motor_.stiffness;
    if (firmness <= 0.0F) {
        rows_ = 0;
        return;
    }
    softness_ = 1.0F / (seconds * firmness);
    const vec3 rate = rows_ == 1 ? vec3(motor_.rate.z, 0, 0) : motor_.rate;
    wanted_ = rate - motor_.stiffness / firmness * (found.error + rate * remaining_);
}

void MotorConstraint::getInfo1(btConstraintInfo1* info) {
    const bool works = motor_.damping + motor_.stiffness > 0.0F && motor_.maxTorqueNm > 0.0F;
    const bool hinge = profile_.kind == ConstraintProfile::Kind::hinge;
    info->m_numConstraintRows = works ? (hinge ? 1 : 3) : 0;
    info->nub = 0;
}

void MotorConstraint::getInfo2(btConstraintInfo2* info) {
    prepare(1.0F / info->fps);
    for (int i = 0; i < rows_; ++i) {
        const int at = i * info->rowskip;
        for (int k = 0; k < 3; ++k) {
            info->m_J1angularAxis[at + k] = -axes_[i][k];
            info->m_J2angularAxis[at + k] = axes_[i][k];
        }
        info->m_constraintError[at] = wanted_[i];
        info->m_lowerLimit[at] = -motor_.maxTorqueNm / info->fps;
        info->m_upperLimit[at] = motor_.maxTorqueNm / info->fps;
    }
}

void MotorConstraint::applyAsTorque(float seconds) {
    prepare(seconds);
    impulses_.fill(0.0F);
    if (rows_ == 0) return;
    const mat3 inertia = fromBullet(m_rbA.getInvInertiaTensorWorld()) + fromBullet(m_rbB.getInvInertiaTensorWorld());
    const float bound = motor_.maxTorqueNm * seconds;
    vec3 torque(0);
    for (int i = 0; i < rows_; ++i) {
        const float missing = wanted_[i] - glm::dot(relativeTurn(), axes_[i]);
        const float mass = glm::dot(axes_[i], inertia * axes_[i]) + softness_;
        impulses_[i] = std::clamp(missing / mass, -bound, bound);
        torque += axes_[i] * (impulses_[i] / seconds);
    }
    m_rbA.applyTorque(toBullet(-torque));
    m_rbB.applyTorque(toBullet(torque));
}

vec3 MotorConstraint::relativeTurn() const {
    return fromBullet(m_rbB.getAngularVelocity() - m_rbA.getAngularVelocity());
}

vec3 MotorConstraint::impulse() const {
    vec3 sum(0);
    for (int i = 0; i < rows_; ++i)
        sum += axes_[i] * impulses_[i];
    return sum;
}

}  // namespace lutka::physics
