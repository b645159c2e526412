#pragma once

#include <optional>
#include <string>
#include <vector>

#include "animation/humanoid/roles.hpp"
#include "animation/skeleton.hpp"

namespace lutka::animation {

/// The one plane in which a joint bends in all clips of a file.
struct SegmentHinge {
    vec3 axis{0, 0, 1};  ///< Unit, model space in the bind pose; positive rotation by the right-hand rule.
    float low = 0.0F;    ///< Radians from the bind pose, <= 0: the furthest that the clips go.
    float high = 0.0F;   ///< Likewise, >= 0.
};

/// A part of a rig that one rigid body can stand for, whatever the creature: from one joint to the next, with all that
/// hangs between (twist joints, faces, joints too short for a body of their own).
struct Segment {
    enum class Kind {
        trunk,     ///< The root, and what carries limbs along the middle.
        chain,     ///< A link of a tail, neck, tentacle, hair; a jaw.
        limbRoot,  ///< Where a limb leaves what carries it.
        limb,      ///< Further down a limb.
        held,      ///< A weapon in a hand, which hardly moves there.
    };

    std::string name;      ///< The joint's, with a number where that is taken.
    int joint = kNoJoint;  ///< Where it starts and what it hangs on.
    int parent = -1;       ///< Index of the segment above, smaller than its own; -1 for the first.
    int end = kNoJoint;    ///< The joint that its length runs to; kNoJoint: its skin tells.
    Kind kind = Kind::chain;
    /// Index of the segment that is its mirror image; its own for those in the mirror plane; -1: there is none.
    int mirror = -1;
    Side side = Side::center;
    std::optional<SegmentHinge> hinge;
};

}  // namespace lutka::animation
