#include "physics/powered/pose_drive.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace lutka::physics {
namespace {

constexpr float kUnboundedNm = 1e9F;
constexpr float kAdultM = 1.75F;
constexpr float kCarries = 3.0F;  // times what gravity takes of a limb that is held out level, at least
constexpr float kGravity = 9.81F;
constexpr float kFar = radians(40.0F);
constexpr float kLost = radians(90.0F);
constexpr float kLimbBrake = 3.0F;  // on the damping of joints on a leash,
constexpr float kEndBrake = 16.0F;  // of those above what ends a limb: the floor turns it with the weight of the whole
                                    // doll and lets go of it at once
constexpr float kEndTorque = 4.0F;  // on their bounds: a large head is no longer thrown by a trunk that comes up, nor a
                                    // hand turned by the floor that it comes down on

bool isEnd(const BodyProfile& body) {
    switch (body.role.value_or(Role::hips)) {
        case Role::head:
        case Role::leftHand:
        case Role::rightHand:
        case Role::leftFoot:
        case Role::rightFoot:
            return true;
        default:
            return false;
    }
}

// The child's frame in the parent's.
quat relativeOf(const ConstraintProfile& constraint, std::span<const RigidTransform> bodies) {
    const quat parent = bodies[constraint.parent].rotation * constraint.parentFromFrame.rotation;
    return glm::conjugate(parent) * (bodies[constraint.child].rotation * constraint.childFromFrame.rotation);
}

// The neutral turn, on the side of a quaternion.
quat neutralNear(const quat& turn) {
    return turn.w < 0.0F ? quat(-1, 0, 0, 0) : quat(1, 0, 0, 0);
}

vec3 anchorOf(const ConstraintProfile& constraint, std::span<const BodyState> bodies) {
    return bodies[constraint.parent].worldFromBody * constraint.parentFromFrame.translation;
}

// The mean of the two larger moments of some bodies about a point, kg m²: the trace of the tensor, less what is about
// the axis along a limb, is nearly all of it.
float momentAbout(const RagdollProfile& profile, std::span<const BodyState> bodies, std::span<const int> some,
                  const vec3& point) {
    float trace = 0.0F;
    for (const int body : some) {
        const vec3 arm = bodies[body].worldFromBody.translation - point;
        const vec3& own = profile.bodies[body].inertia;
        trace += own.x + own.y + own.z + 2.0F * profile.bodies[body].massKg * glm::dot(arm, arm);
    }
    return 0.5F * trace;
}

// Constraints come parents before children, so one pass finds all that hangs below one of them.
std::vector<int> bodiesBelow(const RagdollProfile& profile, std::size_t constraint) {
    std::vector<int> below{profile.constraints[constraint].child};
    for (const ConstraintProfile& other : profile.constraints)
        if (std::find(below.begin(), below.end(), other.parent) != below.end()) below.push_back(other.child);
    return below;
}

}  // namespace

PoseDrive::PoseDrive(const RagdollProfile& profile, std::span<const BodyState> bodies)
    : profile_(profile), bodies_(bodies.begin(), bodies.end()) {
    for (const BodyProfile& body : profile.bodies)
        massKg_ += body.massKg;
    for (const BodyState& a : bodies)
        for (const BodyState& b : bodies)
            heightM_ = std::max(heightM_, glm::distance(a.worldFromBody.translation, b.worldFromBody.translation));
    for (std::size_t i = 0; i < profile.constraints.size(); ++i) {
        Joint joint;
        joint.below = bodiesBelow(profile, i);
        std::vector<int> above;
        for (int body = 0; body < static_cast<int>(profile.bodies.size()); ++body)
            if (std::find(joint.below.begin(), joint.below.end(), body) == joint.below.end()) above.push_back(body);
        const vec3 anchor = anchorOf(profile.constraints[i], bodies);
        joint.above = momentAbout(profile, bodies, above, anchor);
        for (const int body : joint.below)
            joint.leverKgM +=
                profile.bodies[body].massKg * glm::distance(bodies[body].worldFromBody.translation, anchor);
        joint.inertia = 1.0F / (1.0F / momentAbout(profile, bodies, joint.below, anchor) + 1.0F / joint.above);
        joints_.push_back(std::move(joint));
    }
}

float PoseDrive::stiffnessOf(int constraint, const MuscleSettings& muscles, float factor) const {
    const float omega = 2.0F * kPi * muscles.frequencyHz;
    return boundedProduct(factor, strengthOf(muscles, profile_, profile_.constraints[constraint].child)) *
           joints_[constraint].inertia * omega * omega;
}

float PoseDrive::torqueBoundOf(int constraint, const MuscleSettings& muscles, float factor) const {
    if (!muscles.bounded) return kUnboundedNm;
    const int child = profile_.constraints[constraint].child;
    const auto group = static_cast<std::size_t>(muscleGroupOf(profile_.bodies[child]));
    const float strength = boundedProduct(factor, strengthOf(muscles, profile_, child));
    const float share =
        boundedProduct(strength, boundedProduct(muscles.torque, factorsOf(muscles, profile_, child).torque));
    const float adult = kTorquePerKg[group] * massKg_ * (heightM_ / kAdultM);
    return share * std::max(adult, kCarries * kGravity * joints_[constraint].leverKgM);
}

vec3 PoseDrive::gravityTorque(int constraint, const vec3& gravity) const {
    const vec3 anchor = anchorOf(profile_.constraints[constraint], bodies_);
    vec3 torque(0);
    for (const int body : joints_[constraint].below)
        torque += glm::cross(bodies_[body].worldFromBody.translation - anchor, profile_.bodies[body].massKg * gravity);
    return torque;
}

quat PoseDrive::parentFrameOf(const ConstraintProfile& constraint) const {
    return bodies_[constraint.parent].worldFromBody.rotation * constraint.parentFromFrame.rotation;
}

// The child's frame in the parent's, where the doll is.
quat PoseDrive::turnNow(const ConstraintProfile& constraint) const {
    return glm::conjugate(parentFrameOf(constraint)) *
           (bodies_[constraint.child].worldFromBody.rotation * constraint.childFromFrame.rotation);
}

// About a world axis the motor gives a torque, whatever the joint's angle and speed are; about the others it holds the
// pose.
void PoseDrive::giveTorque(const ConstraintProfile& constraint, const vec3& worldAxis, float torque,
                           JointMotor& motor) const {
    const quat frameFromWorld = glm::conjugate(parentFrameOf(constraint));
    const vec3 axis = frameFromWorld * worldAxis;
    const quat now = turnNow(constraint);
    vec3 lead = rotationVector(glm::normalize(motor.target * glm::conjugate(now)));
    lead += axis * (torque / motor.stiffness - glm::dot(lead, axis));
    const vec3 speed =
        frameFromWorld * (bodies_[constraint.child].angularVelocity - bodies_[constraint.parent].angularVelocity);
    motor.rate += axis * glm::dot(speed - motor.rate, axis);
    const float angle = glm::length(lead);
    if (angle > 1e-6F) motor.target = glm::normalize(glm::angleAxis(std::min(angle, 0.5F), lead / angle) * now);
}

// As that of a joint with all its strength, also while the doll's still grows.
void PoseDrive::brake(int constraint, const MuscleSettings& muscles, float ratio, JointMotor& motor) const {
    const BodyProfile& body = profile_.bodies[profile_.constraints[constraint].child];
    const bool endsLimb = isEnd(body) || joints_[constraint].below.size() == 1;
    if (!endsLimb) {
        motor.damping *= kLimbBrake;
        return;
    }
    const float critical = 2.0F * std::sqrt(stiffnessOf(constraint, muscles) * joints_[constraint].inertia);
    motor.damping = kEndBrake * ratio * critical;
    motor.maxTorqueNm = kEndTorque * torqueBoundOf(constraint, muscles);
}

// The target no farther than mostLead_ from where the joint is, nor farther and faster than drives it at mostSpeed_:
// with a spring k, a damper d and a rate v of the target the joint comes to v + k / d times the lead.
void PoseDrive::leashTo(const ConstraintProfile& constraint, float inertia, JointMotor& motor) {
    const quat now = turnNow(constraint);
    const float whole = glm::length(rotationVector(glm::normalize(motor.target * glm::conjugate(now))));
    farthest_ = std::max(farthest_, whole);
    // What is very far off is most often held by its own limits, which the shortest way would drive it along: it goes
    // by the middle of its range.
    const float far = goesByMiddle_ ? std::clamp((whole - kFar) / (kLost - kFar), 0.0F, 1.0F) : 0.0F;
    if (far > 0.0F) motor.target = glm::normalize(glm::slerp(motor.target, neutralNear(motor.target), far));
    motor.rate *= 1.0F - far;
    const vec3 lead = rotationVector(glm::normalize(motor.target * glm::conjugate(now)));
    const float angle = glm::length(lead);
    if (angle < 1e-6F) return;
    const float kept = std::min(angle, mostLead_);
    // A spring that is damped less is no faster than its own swing.
    const float damping = std::max(motor.damping, 2.0F * std::sqrt(motor.stiffness * inertia));
    const vec3 drawn = lead * (kept / angle) * (motor.stiffness / std::max(damping, 1e-9F));
    const float share = std::min(1.0F, mostSpeed_ / std::max(glm::length(motor.rate + drawn), 1e-9F));
    motor.rate *= share;
    if (kept * share < angle) motor.target = glm::normalize(glm::angleAxis(kept * share, lead / angle) * now);
}

void PoseDrive::drive(World& world, DollId doll, const MuscleSettings& muscles, std::span<const RigidTransform> from,
                      std::span<const RigidTransform> to, float dt, std::span<const float> factors,
                      const Stance* stance) {
    const bool carries = muscles.carriedGravity != vec3(0);
    const bool leashes = mostLead_ < kPi || mostSpeed_ < kUnbounded;
    farthest_ = 0.0F;
    if (carries || leashes || stance != nullptr) world.getBodies(doll, bodies_);
    for (int i = 0; i < static_cast<int>(profile_.constraints.size()); ++i) {
        const ConstraintProfile& constraint = profile_.constraints[i];
        JointMotor motor;
        const float factor = factors.empty() ? 1.0F : factors[constraint.child];
        motor.stiffness = stiffnessOf(i, muscles, factor);
        if (motor.stiffness <= 0.0F) {
            world.setMotor(doll, i, std::nullopt);
            continue;
        }
        float inertia = joints_[i].inertia;
        const bool carriesDoll = stance != nullptr && stance->share[i] > 0.0F;
        if (carriesDoll) {
            // Softer than a limb in the air: its spring has a whole doll to bring to rest, and feet to keep flat.
            constexpr float kStanceShare = 0.08F;  // of the frequency
            const float carried = stance->share[i] * joints_[i].above * kStanceShare * kStanceShare;
            motor.stiffness *= std::max(carried, inertia) / inertia;
            inertia = std::max(carried, inertia);
        }
        const float ratio =
            boundedProduct(muscles.dampingRatio, factorsOf(muscles, profile_, constraint.child).damping);
        motor.damping = 2.0F * ratio * std::sqrt(motor.stiffness * inertia);
        motor.maxTorqueNm = torqueBoundOf(i, muscles, factor);
        const quat before = relativeOf(constraint, from);
        motor.target = relativeOf(constraint, to);
        motor.rate = rotationVector(glm::normalize(motor.target * glm::conjugate(before))) / dt;
        if (stance != nullptr && stance->turn[i] != vec3(0)) {
            const vec3 turn = glm::conjugate(parentFrameOf(constraint)) * stance->turn[i];
            motor.target = glm::normalize(glm::angleAxis(glm::length(turn), glm::normalize(turn)) * motor.target);
        }
        if (leashes) brake(i, muscles, ratio, motor);
        if (leashes) leashTo(constraint, inertia, motor);
        if (carriesDoll) {
            if (stance->axis[i] != vec3(0)) giveTorque(constraint, stance->axis[i], stance->torque[i], motor);
        } else if (carries) {
            // The spring leads the pose by the angle at which its torque is what gravity takes.
            const vec3 hold = glm::conjugate(parentFrameOf(constraint)) * -gravityTorque(i, muscles.carriedGravity);
            const vec3 lead = hold / motor.stiffness;
            const float angle = glm::length(lead);
            if (angle > 1e-6F) motor.target = glm::angleAxis(std::min(angle, 1.0F), lead / angle) * motor.target;
        }
        if (constraint.kind == ConstraintProfile::Kind::hinge)
            motor.angle = 2.0F * std::atan2(motor.target.z, motor.target.w);
        world.setMotor(doll, i, motor);
    }
}

void PoseDrive::release(World& world, DollId doll) const {
    for (int i = 0; i < static_cast<int>(profile_.constraints.size()); ++i)
        world.setMotor(doll, i, std::nullopt);
}

void jointErrors(const RagdollProfile& profile, std::span<const RigidTransform> pose,
                 std::span<const RigidTransform> bodies, std::span<float> radians) {
    for (std::size_t i = 0; i < profile.constraints.size(); ++i) {
        const ConstraintProfile& constraint = profile.constraints[i];
        const quat off = relativeOf(constraint, bodies) * glm::conjugate(relativeOf(constraint, pose));
        radians[i] = glm::length(rotationVector(glm::normalize(off)));
    }
}

}  // namespace lutka::physics
