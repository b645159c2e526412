#include "physics/profile/constraint_state.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/swing_twist.hpp"

namespace lutka::physics {

ConstraintState measureConstraint(const ConstraintProfile& constraint, const RigidTransform& worldFromParent,
                                  const RigidTransform& worldFromChild) {
    const RigidTransform parentFrame = worldFromParent * constraint.parentFromFrame;
    const RigidTransform childFrame = worldFromChild * constraint.childFromFrame;
    const quat q = glm::conjugate(parentFrame.rotation) * childFrame.rotation;
    ConstraintState state;
    state.separationM = glm::distance(parentFrame.translation, childFrame.translation);
    if (constraint.kind == ConstraintProfile::Kind::hinge) {
        state.hingeAngle = std::remainder(2.0F * std::atan2(q.z, q.w), 2.0F * kPi);
        state.violation =
            std::max({0.0F, constraint.hinge.lower - state.hingeAngle, state.hingeAngle - constraint.hinge.upper});
        return state;
    }
    const SwingTwist parts = swingTwist(q);
    state.swing = parts.swing;
    state.twist = parts.twist;
    const float outness = std::hypot(parts.swing.y / constraint.cone.swingY, parts.swing.z / constraint.cone.swingZ);
    // The ray from the centre leaves the ellipse at |swing| / outness.
    const float swingExcess = outness > 1.0F ? glm::length(parts.swing) * (1.0F - 1.0F / outness) : 0.0F;
    state.violation = std::max(swingExcess, std::abs(parts.twist) - constraint.cone.twist);
    state.violation = std::max(state.violation, 0.0F);
    return state;
}

}  // namespace lutka::physics
