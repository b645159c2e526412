#pragma once

#include <array>
#include <vector>

#include "animation/humanoid/framed_rig.hpp"

namespace lutka::animation {

inline constexpr int kNoPair = -1;

enum class LimbKind { leg, arm };

/// One reading of two mirrored chains as legs or arms: which pair of joints is which part.
struct LimbCandidate {
    LimbKind kind = LimbKind::leg;
    /// Indices into FramedRig::pairs. Legs: upper leg, lower leg, foot, toes; arms: upper arm, lower arm, hand,
    /// clavicle. kNoPair where the limb lacks the part.
    std::array<int, 4> pairs{kNoPair, kNoPair, kNoPair, kNoPair};
    float missing = 0.0F;  ///< The part of the score that joints which are not there cost.
    float names = 0.0F;    ///< The part of the score that comes from names.
    float score = 0.0F;    ///< Sum of log-likelihood-like terms; above 0 speaks for the reading.
    float length = 0.0F;   ///< From the root joint over the middle one to the foot or hand (or the end of the skin).
    vec3 root{0};          ///< Position of the first pair, in the stance.
    vec3 tip{0};           ///< Foot or hand, or the end of what there is.

    bool told = false;   ///< Two or three joints, all named as the parts that they are.
    bool named = false;  ///< As `told`, with all three there.
    bool whole = false;  ///< As `told`, with all that there is: its pose and proportions prove little.
    /// Joints that only one side has (the other limb is a stump), by side ([0] at +x) and slot; kNoJoint elsewhere.
    std::array<std::array<int, 4>, 2> lone{
        {{kNoJoint, kNoJoint, kNoJoint, kNoJoint}, {kNoJoint, kNoJoint, kNoJoint, kNoJoint}}};

    int first = kNoPair;  ///< The pair that the limb starts at (without clavicle), whatever part it is.

    [[nodiscard]] bool uses(int pair) const;
    /// Joints a side, without clavicle and toes.
    [[nodiscard]] int jointCount() const;
};

/// The parts that `pairs` stand for, in order.
[[nodiscard]] std::array<Part, 4> partsOf(LimbKind kind);

/// Readings of all pairs as limbs of that kind, best first, a few for each pair they may start at.
[[nodiscard]] std::vector<LimbCandidate> findLimbs(const FramedRig& framed, LimbKind kind);

}  // namespace lutka::animation
