#include "physics/bullet/ragdoll_joint.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "core/assert.hpp"
#include "core/swing_twist.hpp"
#include "physics/bullet/convert.hpp"

namespace lutka::physics {
namespace {

// Where each kind of row keeps its impulse between steps. Opposite limits have slots of their own, for their impulses
// have nothing in common.
enum Slot {
    pointX,
    pointY,
    pointZ,
    alignX,
    alignY,
    frictionX,
    frictionY,
    frictionZ,
    hingeLower,
    hingeUpper,
    swingLimit,
    longLower,
    longUpper,
    twistLower,
    twistUpper,
    slotCount
};
constexpr int kLinearRows = 3;

void setVector(btScalar* row, const vec3& v) {
    row[0] = v.x;
    row[1] = v.y;
    row[2] = v.z;
}

// The gradient, in the parent's frame, of the swing's part along `n`, a unit vector across x: see prepareCone().
// `swing` is the angle about `u`.
vec3 swingGradient(const vec3& n, const vec3& u, float swing) {
    const vec3 v(0, -u.z, u.y);
    const float turn = swing > 1e-3F ? swing / std::tan(swing) : 1.0F;
    const float alongV = glm::dot(n, v);
    return {alongV * swing, glm::dot(n, u) * u.y + alongV * turn * v.y, glm::dot(n, u) * u.z + alongV * turn * v.z};
}

}  // namespace

static_assert(slotCount == RagdollJoint::kSlots);

RagdollJoint::RagdollJoint(const ConstraintProfile& profile, btRigidBody& parent, btRigidBody& child,
                           const JointTuning& tuning)
    : btTypedConstraint(D6_CONSTRAINT_TYPE, parent, child), profile_(profile), tuning_(tuning) {
    setUserConstraintType(kUserType);
}

void RagdollJoint::addRow(const AngularRow& row) {
    LUTKA_ASSERT(rowCount_ + kLinearRows < kMaxRows);
    slots_[kLinearRows + rowCount_] = row.slot;
    rows_[rowCount_++] = row;
}

void RagdollJoint::prepare() {
    const mat3 worldFromParent = fromBullet(m_rbA.getWorldTransform().getBasis());
    const mat3 worldFromChild = fromBullet(m_rbB.getWorldTransform().getBasis());
    parentArm_ = worldFromParent * profile_.parentFromFrame.translation;
    childArm_ = worldFromChild * profile_.childFromFrame.translation;
    gap_ = fromBullet(m_rbB.getWorldTransform().getOrigin() - m_rbA.getWorldTransform().getOrigin()) + childArm_ -
           parentArm_;
    slots_[0] = pointX;
    slots_[1] = pointY;
    slots_[2] = pointZ;
    rowCount_ = 0;
    const mat3 parentAxes = worldFromParent * glm::mat3_cast(profile_.parentFromFrame.rotation);
    const mat3 childAxes = worldFromChild * glm::mat3_cast(profile_.childFromFrame.rotation);
    if (profile_.kind == ConstraintProfile::Kind::hinge)
        prepareHinge(parentAxes, childAxes);
    else
        prepareCone(parentAxes, glm::normalize(glm::quat_cast(glm::transpose(parentAxes) * childAxes)));
}

void RagdollJoint::prepareHinge(const mat3& parentAxes, const mat3& childAxes) {
    const vec3 wrong = glm::cross(parentAxes[2], childAxes[2]);
    addRow({alignX, parentAxes[0], glm::dot(wrong, parentAxes[0]), AngularRow::Kind::align});
    addRow({alignY, parentAxes[1], glm::dot(wrong, parentAxes[1]), AngularRow::Kind::align});
    const vec3& axis = parentAxes[2];
    if (profile_.frictionNm > 0.0F) addRow({frictionZ, axis, 0, AngularRow::Kind::friction});
    const float angle = std::atan2(glm::dot(childAxes[0], parentAxes[1]), glm::dot(childAxes[0], parentAxes[0]));
    const float aboveLower = angle - profile_.hinge.lower;
    const float belowUpper = profile_.hinge.upper - angle;
    if (std::min(aboveLower, belowUpper) > tuning_.limitMargin) return;
    if (aboveLower < belowUpper)
        addRow({hingeLower, axis, aboveLower, AngularRow::Kind::limit});
    else
        addRow({hingeUpper, -axis, belowUpper, AngularRow::Kind::limit});
}

// With the swing s = a u (u across x), v = x × u and the relative angular velocity w in the parent's frame:
//   da/dt = w·u,   a du/dt = a (w·x + cot(a) w·v) v,   dtwist/dt = w·x - tan(a/2) w·v.
void RagdollJoint::prepareCone(const mat3& parentAxes, const quat& parentFromChild) {
    if (profile_.frictionNm > 0.0F) {
        addRow({frictionX, parentAxes[0], 0, AngularRow::Kind::friction});
        addRow({frictionY, parentAxes[1], 0, AngularRow::Kind::friction});
        addRow({frictionZ, parentAxes[2], 0, AngularRow::Kind::friction});
    }
    constexpr float kLargestSwing = 3.0F;  // the formulas have their pole at pi
    const SwingTwist now = swingTwist(parentFromChild);
    const float swing = glm::length(now.swing);
    const vec3 u = swing > 1e-4F ? now.swing / swing : vec3(0, 1, 0);
    const float bounded = std::min(swing, kLargestSwing);
    addSwingRows(parentAxes, now.swing, u, bounded);
    const float aboveLower = profile_.cone.twist + now.twist;
    const float belowUpper = profile_.cone.twist - now.twist;
    if (std::min(aboveLower, belowUpper) > tuning_.limitMargin) return;
    const vec3 axis = parentAxes * (vec3(1, 0, 0) - std::tan(0.5F * bounded) * vec3(0, -u.z, u.y));
    if (aboveLower < belowUpper)
        addRow({twistLower, axis, aboveLower, AngularRow::Kind::limit});
    else
        addRow({twistUpper, -axis, belowUpper, AngularRow::Kind::limit});
}

// The ellipse itself, and the end of its longer axis. Past that tip the ellipse's normal turns quickly towards the
// short axis; a little to and fro there satisfies its row, while the swing runs on along the long axis.
void RagdollJoint::addSwingRows(const mat3& parentAxes, const vec3& swing, const vec3& u, float bounded) {
    const ConeTwistLimits& cone = profile_.cone;
    const vec3 scaled(0, swing.y / cone.swingY, swing.z / cone.swingZ);
    const float outness = glm::length(scaled);  // 1 on the ellipse
    if (!(outness > 1e-3F)) return;             // nor where it is not a number
    const float angle = glm::length(swing);
    const float remaining = angle / outness - angle;
    if (remaining < tuning_.limitMargin) {
        const vec3 normal = glm::normalize(vec3(0, scaled.y / cone.swingY, scaled.z / cone.swingZ));
        // Along the ray from the centre the distance is longer than along the normal by the cosine between them.
        addRow({swingLimit, parentAxes * -swingGradient(normal, u, bounded),
                remaining * std::max(glm::dot(normal, u), 0.1F), AngularRow::Kind::limit});
    }
    constexpr float kRound = 1.2F;  // an ellipse whose axes differ by less is held by one row
    if (std::max(cone.swingY, cone.swingZ) < kRound * std::min(cone.swingY, cone.swingZ)) return;
    const bool isY = cone.swingY > cone.swingZ;
    const float along = isY ? swing.y : swing.z;
    const float left = (isY ? cone.swingY : cone.swingZ) - std::abs(along);
    if (!(left <= tuning_.limitMargin)) return;
    const float end = along < 0.0F ? -1.0F : 1.0F;
    const vec3 axis(0, isY ? end : 0.0F, isY ? 0.0F : end);
    addRow({end < 0.0F ? longLower : longUpper, parentAxes * -swingGradient(axis, u, bounded), left,
            AngularRow::Kind::limit});
}

void RagdollJoint::getInfo1(btConstraintInfo1* info) {
    prepare();
    info->m_numConstraintRows = kLinearRows + rowCount_;
    info->nub = 0;
}

vec3 RagdollJoint::mendVelocity(float rate) const {
    const float mend = tuning_.erp * rate;
    const float speed = mend * glm::length(gap_);
    return gap_ * (speed > tuning_.maxMendSpeed ? mend * tuning_.maxMendSpeed / speed : mend);
}

RagdollJoint::AngularTarget RagdollJoint::targetOf(const AngularRow& row, float rate) const {
    switch (row.kind) {
        case AngularRow::Kind::align:
            return {std::clamp(-tuning_.erp * rate * row.error, -tuning_.maxMendTurn, tuning_.maxMendTurn),
                    -SIMD_INFINITY, SIMD_INFINITY};
        case AngularRow::Kind::friction:
            return {0.0F, -profile_.frictionNm / rate, profile_.frictionNm / rate};
        case AngularRow::Kind::limit:
            break;
    }
    // Before the limit the row only bounds the speed towards it.
    const float mended = std::min(-tuning_.limitErp * rate * row.error, tuning_.maxLimitTurn);
    return {row.error > 0.0F ? -row.error * rate : mended, 0.0F, SIMD_INFINITY};
}

void RagdollJoint::getInfo2(btConstraintInfo2* info) {
    const vec3 target = mendVelocity(info->fps);
    for (int i = 0; i < kLinearRows; ++i) {
        vec3 direction(0);
        direction[i] = 1.0F;
        setVector(info->m_J1linearAxis + i * info->rowskip, direction);
        setVector(info->m_J1angularAxis + i * info->rowskip, glm::cross(parentArm_, direction));
        setVector(info->m_J2linearAxis + i * info->rowskip, -direction);
        setVector(info->m_J2angularAxis + i * info->rowskip, -glm::cross(childArm_, direction));
        info->m_constraintError[i * info->rowskip] = target[i];
    }
    for (int i = 0; i < rowCount_; ++i) {
        const AngularTarget wanted = targetOf(rows_[i], info->fps);
        const int at = (kLinearRows + i) * info->rowskip;
        setVector(info->m_J1angularAxis + at, -rows_[i].axis);
        setVector(info->m_J2angularAxis + at, rows_[i].axis);
        info->m_constraintError[at] = wanted.speed;
        info->m_lowerLimit[at] = wanted.low;
        info->m_upperLimit[at] = wanted.high;
    }
}

// Bullet's per-constraint parameters are not used: the world's JointTuning holds for all joints.
void RagdollJoint::setParam(int /*num*/, btScalar /*value*/, int /*axis*/) {}
btScalar RagdollJoint::getParam(int /*num*/, int /*axis*/) const {
    return 0.0F;
}

RowDuty RagdollJoint::dutyOf(int row) const {
    if (row < kLinearRows) return RowDuty::mends;
    const AngularRow& angular = rows_[row - kLinearRows];
    if (angular.kind == AngularRow::Kind::friction) return RowDuty::yields;
    const bool onlyBounds = angular.kind == AngularRow::Kind::limit && angular.error > 0.0F;
    return onlyBounds ? RowDuty::keeps : RowDuty::mends;
}

void RagdollJoint::finishStoring() {
    impulses_ = newImpulses_;
    newImpulses_.fill(0.0F);
}

void RagdollJoint::forgetImpulses() {
    impulses_.fill(0.0F);
    newImpulses_.fill(0.0F);
}

}  // namespace lutka::physics
