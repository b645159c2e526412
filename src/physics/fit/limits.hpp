#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "physics/fit/anatomy.hpp"
#include "physics/fit/body_plan.hpp"
#include "physics/profile/profile.hpp"

namespace lutka::physics {

/// A shape in its place in the bind pose, in the standard stance's axes.
struct PlacedShape {
    BodyShape shape;
    RigidTransform standardFromBody;
};

/// Where the constraint between a body and its parent sits in the bind pose, in the standard stance's axes. The two
/// orientations differ by how far the bind pose is from the middle of the range.
struct JointFrames {
    quat parent{1, 0, 0, 0};
    quat child{1, 0, 0, 0};
    vec3 anchor{0, 0, 0};  ///< The child's joint.
};
[[nodiscard]] JointFrames jointFrames(const BodyPlan& plan, const Anatomy& anatomy, int child);

/// Puts the frames into the constraint, relative to its two bodies.
void setFrames(ConstraintProfile& constraint, const JointFrames& frames, const RigidTransform& standardFromParent,
               const RigidTransform& standardFromChild);

/// The kind and limits that fit a planned body that hangs on another: rangeOfMotion() of its role, else
/// segmentRange(). Frames and neutral pose are jointFrames().
void setRange(ConstraintProfile& constraint, const BodyPlan& plan, int child);

/// The constraints of a plan, constraints[i].child == i + 1: anchors at the child's joint, frames that agree in the
/// middle of the anatomical range, limits as of setRange(). A limit that the bind pose breaks is widened to hold it
/// with two degrees to spare, and `notes` gains a sentence with the figures. frictionNm stays 0 (see setJointFriction).
[[nodiscard]] std::vector<ConstraintProfile> makeConstraints(const BodyPlan& plan, const Anatomy& anatomy,
                                                             const std::vector<PlacedShape>& shapes,
                                                             std::vector<std::string>& notes);

/// Widens the limits of a constraint until they hold the pose of the two frames, a cone that is far from it with its
/// middle moved towards it; a sentence with what was done, empty when nothing was.
[[nodiscard]] std::string widenToHold(ConstraintProfile& constraint, const RigidTransform& worldFromParent,
                                      const RigidTransform& worldFromChild, std::string_view child);

/// Dry friction in every joint: a fortieth of the torque that gravity (9.81 m/s²) would exert about the joint if all
/// that hangs below it were held out straight. Enough to calm a settling limb, too little to hold one up; it grows with
/// mass and length as the passive resistance of a real joint does.
void setJointFriction(RagdollProfile& profile);

}  // namespace lutka::physics
