#pragma once

#include <vector>

#include "physics/fit/body_plan.hpp"

namespace lutka::physics {

/// The anatomical orientation of each body, one a body of the plan.
///
/// Every segment's orientation is told relative to anatomical standing (upright, arms hanging with thumbs forward, feet
/// ahead): `standardFromAnatomy[i]` takes a direction of the segment as it is in standing to where it is in the bind
/// pose, both in the standard stance's axes. It is the identity for all bodies of a figure whose bind pose is
/// anatomical standing; T-pose, A-pose, bent knees, any local axes of the rig come out as what they are, so that limits
/// built on it do not depend on the bind pose.
///
///            +Y up                 limb:  direction of the segment, and the flexion axis of its elbow or knee
///             |                    trunk: standing, unless the torso leans by more than 10 degrees
///             |___ +X left         head:  standing
///            /                     hand:  the forearm's turn, corrected by the flat of the hand
///          +Z ahead                foot:  heading of the toes; pitch only where it points steeply down
struct Anatomy {
    std::vector<quat> standardFromAnatomy;
    /// Flexion axis of the hinge at the start of a lower arm or lower leg, unit, in the standard stance's axes of the
    /// bind pose; positive rotation flexes. Zero for other bodies.
    std::vector<vec3> flexionAxis;
};

[[nodiscard]] Anatomy findAnatomy(const BodyPlan& plan);

/// The axis, in anatomical standing, about which positive rotation flexes the joint at the start of a segment:
/// trunk and head bend forward, the upper arm and thigh swing forward, the elbow brings the hand forward, the knee the
/// heel backward, the wrist closes towards the palm, foot and toes lift, the clavicle rises. For left and middle roles.
[[nodiscard]] vec3 standingFlexionAxis(Role role);

/// The mirror image in the plane x = 0 of a rotation.
[[nodiscard]] inline quat mirrorRotation(const quat& q) {
    return {q.w, q.x, -q.y, -q.z};
}

}  // namespace lutka::physics
