#pragma once

#include <string>
#include <vector>

#include "animation/character.hpp"
#include "physics/profile/profile.hpp"
#include "physics/rig/rig.hpp"

namespace lutka::physics {

/// What the clips do to the limits: widen keeps what the anatomy allows and adds what the clips need; fit takes the
/// clips' own range instead, so that a doll moves only as its character does.
enum class ClipLimits { widen, fit };

/// The limits of one joint before and after, and what the clips do there.
struct ClipLimitChange {
    std::string body;  ///< The child's name.
    ConstraintProfile::Kind kind = ConstraintProfile::Kind::coneTwist;
    HingeLimits hingeBefore, hingeAfter, hingeUsed;   ///< Hinge; radians.
    ConeTwistLimits coneBefore, coneAfter, coneUsed;  ///< Cone-twist; the used swings are the largest about each axis.
};

inline constexpr float kClipMargin = 0.0873F;     ///< 5 degrees beyond the furthest frame.
inline constexpr float kLeastClipSpan = 0.1745F;  ///< 10 degrees: a narrower limit jitters.

/// Changes the profile's limits by all frames of all clips of the character, and by its bind pose. Constraint frames
/// and the neutral pose stay. No clips: nothing changes. One entry a constraint, in their order.
std::vector<ClipLimitChange> applyClipLimits(RagdollProfile& profile, const Rig& rig,
                                             const animation::Character& character, ClipLimits mode);

}  // namespace lutka::physics
