#pragma once

#include "physics/profile/profile.hpp"

namespace lutka::physics {

/// Where the two bodies of a constraint are in the bind pose; any common space.
struct BindFrames {
    RigidTransform fromParent;
    RigidTransform fromChild;
};

/// Orientation of the child's constraint frame in the parent's: R_parentFrame⁻¹ · R_childFrame in that pose.
[[nodiscard]] quat relativeFrame(const ConstraintProfile& constraint, const BindFrames& pose);

/// Turns the axes of both frames by the same rotation, told in the frame's own axes: the neutral pose and that in which
/// the spring rests stay, but flexion, side and twist are about other axes of the limb.
void turnFrames(ConstraintProfile& constraint, const quat& turn);

/// Moves the neutral pose, the middle of the range: the child's frame agrees with the parent's where the parent's
/// turned by `turn` (in its own axes) was. The axes on the child stay, and the pose in which the spring rests.
void shiftNeutral(ConstraintProfile& constraint, const quat& turn);

/// Makes a cone-twist of a hinge, or a hinge of a cone-twist. The range of flexion, told from the bind pose, stays.
/// A new cone gets ten degrees of side and twist either way about the bind pose; a new hinge bends about the flexion
/// axis that the cone has on the child, and holds the bind pose's side and twist. Nothing when the kind is the same.
void changeKind(ConstraintProfile& constraint, ConstraintProfile::Kind kind, const BindFrames& bind);

/// Gives the shape (and with it the body) of `body` another place in its joint. Its constraints stay where they are in
/// the bind pose: their frames are told anew from the moved body.
void moveBody(RagdollProfile& profile, int body, const RigidTransform& jointFromBody);

/// How a constraint's frames differ from others: P' = P · neutral · turn, C' = C · turn, with P and C the rotations of
/// parentFromFrame and childFromFrame.
struct FrameEdit {
    quat turn{1, 0, 0, 0};
    quat neutral{1, 0, 0, 0};
};
/// What makes `edited` of `plain`; both must be told from the same bodies.
[[nodiscard]] FrameEdit frameEditBetween(const ConstraintProfile& plain, const ConstraintProfile& edited);
void applyFrameEdit(ConstraintProfile& constraint, const FrameEdit& edit);
/// Whether it changes no axis by more than about a hundredth of a degree.
[[nodiscard]] bool isNone(const FrameEdit& edit);
/// The same for the limb on the other side.
[[nodiscard]] FrameEdit mirrored(const FrameEdit& edit);
[[nodiscard]] JointSpring mirrored(const JointSpring& spring);
/// The constraint's spring with its rest as a turn from the bind pose, which means the same in other joints, and back.
[[nodiscard]] JointSpring springFromBind(const ConstraintProfile& constraint, const BindFrames& bind);
void setSpringFromBind(ConstraintProfile& constraint, const JointSpring& told, const BindFrames& bind);

}  // namespace lutka::physics
