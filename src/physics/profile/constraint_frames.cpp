#include "physics/profile/constraint_frames.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "core/swing_twist.hpp"

namespace lutka::physics {
namespace {

constexpr float kNewSpan = radians(10.0F);    // of side and twist when a hinge becomes a cone
constexpr float kLeastSpan = radians(1.0F);   // a limit of 0 is no limit that a solver can hold
constexpr float kMostSpan = radians(175.0F);  // short of half a turn, where swings lose their axis
constexpr float kSameRotation = 1e-4F;        // half the angle, radians

quat aboutZ(float angle) {
    return glm::angleAxis(angle, vec3(0, 0, 1));
}

float hingeAngle(const quat& relative) {
    return std::remainder(2.0F * std::atan2(relative.z, relative.w), 2.0F * kPi);
}

void hingeToCone(ConstraintProfile& constraint) {
    shiftNeutral(constraint, aboutZ(0.5F * (constraint.hinge.lower + constraint.hinge.upper)));
    const float half = 0.5F * (constraint.hinge.upper - constraint.hinge.lower);
    constraint.cone = {kNewSpan, std::clamp(half, kLeastSpan, kMostSpan), kNewSpan};
}

void coneToHinge(ConstraintProfile& constraint, const quat& bindRelative) {
    // The parent's frame goes where the bind pose is reached from it by flexion alone.
    const float flexion = swingTwist(bindRelative).swing.z;
    shiftNeutral(constraint, bindRelative * aboutZ(-flexion));
    constraint.hinge = {-constraint.cone.swingZ, constraint.cone.swingZ};
}

bool isNone(const quat& rotation) {
    return glm::length(vec3(rotation.x, rotation.y, rotation.z)) < kSameRotation;
}

// Frames of the two sides are mirror images but for z, which is an axis of rotation (see standingFrame()).
quat mirroredInFrame(const quat& rotation) {
    return {rotation.w, -rotation.x, -rotation.y, rotation.z};
}

}  // namespace

quat relativeFrame(const ConstraintProfile& constraint, const BindFrames& pose) {
    return glm::conjugate(pose.fromParent.rotation * constraint.parentFromFrame.rotation) *
           (pose.fromChild.rotation * constraint.childFromFrame.rotation);
}

void turnFrames(ConstraintProfile& constraint, const quat& turn) {
    constraint.parentFromFrame.rotation = glm::normalize(constraint.parentFromFrame.rotation * turn);
    constraint.childFromFrame.rotation = glm::normalize(constraint.childFromFrame.rotation * turn);
    constraint.spring.rest = glm::normalize(glm::conjugate(turn) * constraint.spring.rest * turn);
}

void shiftNeutral(ConstraintProfile& constraint, const quat& turn) {
    constraint.parentFromFrame.rotation = glm::normalize(constraint.parentFromFrame.rotation * turn);
    constraint.spring.rest = glm::normalize(glm::conjugate(turn) * constraint.spring.rest);
}

void changeKind(ConstraintProfile& constraint, ConstraintProfile::Kind kind, const BindFrames& bind) {
    if (constraint.kind == kind) return;
    constraint.kind = kind;
    if (kind == ConstraintProfile::Kind::hinge) {
        coneToHinge(constraint, relativeFrame(constraint, bind));
        const float angle = hingeAngle(relativeFrame(constraint, bind));
        constraint.hinge.lower = std::min(constraint.hinge.lower, angle);
        constraint.hinge.upper = std::max(constraint.hinge.upper, angle);
    } else {
        hingeToCone(constraint);
    }
}

void moveBody(RagdollProfile& profile, int body, const RigidTransform& jointFromBody) {
    const RigidTransform newFromOld = inverse(jointFromBody) * profile.bodies[body].jointFromBody;
    const auto retold = [&](const RigidTransform& bodyFromFrame) {
        const RigidTransform frame = newFromOld * bodyFromFrame;
        return RigidTransform{glm::normalize(frame.rotation), frame.translation};
    };
    for (ConstraintProfile& constraint : profile.constraints) {
        if (constraint.child == body) constraint.childFromFrame = retold(constraint.childFromFrame);
        if (constraint.parent == body) constraint.parentFromFrame = retold(constraint.parentFromFrame);
    }
    profile.bodies[body].jointFromBody = jointFromBody;
}

FrameEdit frameEditBetween(const ConstraintProfile& plain, const ConstraintProfile& edited) {
    FrameEdit edit;
    edit.turn = glm::normalize(glm::conjugate(plain.childFromFrame.rotation) * edited.childFromFrame.rotation);
    edit.neutral = glm::normalize(glm::conjugate(plain.parentFromFrame.rotation) * edited.parentFromFrame.rotation *
                                  glm::conjugate(edit.turn));
    return edit;
}

void applyFrameEdit(ConstraintProfile& constraint, const FrameEdit& edit) {
    shiftNeutral(constraint, edit.neutral);
    turnFrames(constraint, edit.turn);
}

bool isNone(const FrameEdit& edit) {
    return isNone(edit.turn) && isNone(edit.neutral);
}

FrameEdit mirrored(const FrameEdit& edit) {
    return {mirroredInFrame(edit.turn), mirroredInFrame(edit.neutral)};
}

JointSpring mirrored(const JointSpring& spring) {
    return {spring.stiffness, spring.damping, mirroredInFrame(spring.rest)};
}

JointSpring springFromBind(const ConstraintProfile& constraint, const BindFrames& bind) {
    JointSpring told = constraint.spring;
    told.rest = glm::normalize(glm::conjugate(relativeFrame(constraint, bind)) * told.rest);
    return told;
}

void setSpringFromBind(ConstraintProfile& constraint, const JointSpring& told, const BindFrames& bind) {
    constraint.spring = told;
    constraint.spring.rest = glm::normalize(relativeFrame(constraint, bind) * told.rest);
}

}  // namespace lutka::physics
