#pragma once

#include <string_view>

#include "physics/profile/constraint_frames.hpp"

namespace lutka::physics {

/// How far a joint goes either way, radians; both told from the bind pose, low <= high.
struct AngleSpan {
    float low = 0.0F;
    float high = 0.0F;
};

/// The limits of a constraint as people tell them: how far the limb goes from the bind pose about the constraint's
/// axes z (flexion), y (side) and x (twist). For a cone these are the ends of the ellipse's axes. A hinge has no side
/// and no twist.
struct JointRange {
    AngleSpan flexion;
    AngleSpan side;
    AngleSpan twist;
};

[[nodiscard]] JointRange jointRange(const ConstraintProfile& constraint, const BindFrames& bind);

/// Sets limits and neutral pose so that jointRange() gives the range; each span of a cone is kept within 2 and 350
/// degrees. A span that does not hold the bind pose is taken as it is: the doctor tells of it.
void setJointRange(ConstraintProfile& constraint, const JointRange& range, const BindFrames& bind);

/// The range of the same joint on the other side: side and twist are told the other way round there.
[[nodiscard]] JointRange mirrored(const JointRange& range);

/// What moving a segment about one of its joint's axes is called, for the segment's own side of the body.
struct MotionWords {
    std::string_view name;  ///< Of both together: "Flexion".
    std::string_view low;   ///< Towards negative angles: "extension".
    std::string_view high;  ///< Towards positive angles: "flexion".
};
struct JointWords {
    MotionWords flexion;
    MotionWords side;
    MotionWords twist;
};
/// The anatomical words for the joint at the start of a role's segment.
[[nodiscard]] JointWords jointWords(Role role);
/// The same for a body that may have no role: plain words then.
[[nodiscard]] JointWords jointWords(std::optional<Role> role);

}  // namespace lutka::physics
