#pragma once

#include <string>
#include <vector>

#include "physics/anatomy.hpp"
#include "physics/body_plan.hpp"
#include "physics/profile.hpp"

namespace lutka::physics {

/// A shape in its place in the bind pose, in the standard stance's axes.
struct PlacedShape {
    BodyShape shape;
    RigidTransform standardFromBody;
};

/// The constraints of a plan, constraints[i].child == i + 1: anchors at the child's joint, frames that agree in the
/// middle of the anatomical range, limits from rangeOfMotion(). A limit that the bind pose breaks is widened to hold it
/// with two degrees to spare, and `notes` gains a sentence with the figures. frictionNm stays 0 (see setJointFriction).
[[nodiscard]] std::vector<ConstraintProfile> makeConstraints(const BodyPlan& plan, const Anatomy& anatomy,
                                                             const std::vector<PlacedShape>& shapes,
                                                             std::vector<std::string>& notes);

/// Widens the limits of a constraint until they hold the pose of the two frames; a sentence with what was done, empty
/// when nothing was.
[[nodiscard]] std::string widenToHold(ConstraintProfile& constraint, const RigidTransform& worldFromParent,
                                      const RigidTransform& worldFromChild, Role child);

/// Dry friction in every joint: a fortieth of the torque that gravity (9.81 m/s²) would exert about the joint if all
/// that hangs below it were held out straight. Enough to calm a settling limb, too little to hold one up; it grows with
/// mass and length as the passive resistance of a real joint does.
void setJointFriction(RagdollProfile& profile);

}  // namespace lutka::physics
