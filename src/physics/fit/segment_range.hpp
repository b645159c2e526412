#pragma once

#include "physics/fit/body_plan.hpp"
#include "physics/profile/profile.hpp"

namespace lutka::physics {

/// The frame of the constraint at the start of a segment's body, in the standard stance's axes of the bind pose: x
/// along the segment, z the axis that its clips bend it about, else the one across it that lies nearest to level and
/// sideways. Frames of two sides mirror each other as those of roles do (standingFrame()). The neutral pose is the bind
/// pose.
[[nodiscard]] quat segmentFrame(const BodyPlan& plan, int child);

/// Kind and limits by what the segment is (figures in docs/creatures.md): a hinge with the clips' range and 15 degrees
/// beyond it, at least 20 either way, where they bend in one plane; else a wide cone.
void setSegmentRange(ConstraintProfile& constraint, const PlannedBody& body);

}  // namespace lutka::physics
