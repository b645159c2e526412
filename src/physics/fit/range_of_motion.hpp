#pragma once

#include "physics/fit/body_plan.hpp"

namespace lutka::physics {

/// What a joint can do, told from anatomical standing and thus the same for every bind pose.
struct RangeOfMotion {
    ConstraintProfile::Kind kind = ConstraintProfile::Kind::coneTwist;
    /// Orientation of the segment in the middle of its range, relative to its parent segment; the identity is
    /// anatomical standing (see Anatomy). Its frame there: x along the segment, z the flexion axis.
    quat neutral{1, 0, 0, 0};
    HingeLimits hinge;            ///< About the neutral orientation.
    ConeTwistLimits cone;         ///< Likewise.
    float neutralFlexion = 0.0F;  ///< Hinge: flexion at the neutral orientation, radians from the straight limb.
};

/// The range of motion of the joint between a body and its parent, from tables of physiotherapy (AAOS; those of the
/// VA and DSHS where they say more), given in docs/profile.md. Spine values are divided among the trunk's joints, the
/// head's between neck and head where both have bodies, the shoulder's between clavicle and arm likewise.
/// The shoulder's cone is narrower than the 180 degrees of the table: those need the clavicle and a will.
[[nodiscard]] RangeOfMotion rangeOfMotion(const BodyPlan& plan, Role role);

/// The constraint frame of a segment in anatomical standing: x along the segment, z its flexion axis.
[[nodiscard]] quat standingFrame(Role role);

}  // namespace lutka::physics
