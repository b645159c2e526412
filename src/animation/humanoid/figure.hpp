#pragma once

#include <string>

#include "animation/humanoid/facing.hpp"
#include "animation/humanoid/limb_candidates.hpp"
#include "animation/humanoid/trunk_candidates.hpp"

namespace lutka::animation {

/// How far the next best reading of a place falls behind the best, in log-odds.
struct Margins {
    std::array<float, 4> legs{};
    std::array<float, 4> arms{};
    float hips = 0.0F;
    float chest = 0.0F;
    float head = 0.0F;
};

/// The best reading of a rig as a human figure, or why there is none.
struct Figure {
    std::string refusal;  ///< Empty when the figure stands.
    float prior = 0.0F;   ///< The part of the score that speaks for the up axis, before anything is read.
    bool leans = false;   ///< Read in a stance that is not upright: it leans as a whole.
    bool posed = false;   ///< Read in the stance that its names give, whatever its pose.
    /// By all names, which say the parts, too, the left arm is on the side of the right leg: a walking figure seen from
    /// its side mirrors so.
    bool crossed = false;
    float score = -1e9F;  ///< Sum of all terms: what readings are compared by.
    FramedRig framed;
    LimbCandidate legs;
    LimbCandidate arms;
    TrunkCandidate trunk;
    Facing facing;
    Margins margins;

    /// One joint or two for each limb.
    [[nodiscard]] bool isBlocky() const { return legs.jointCount() + arms.jointCount() <= 4; }

    /// Sum of the terms of shape, structure and skin alone: what readings are accepted by.
    [[nodiscard]] float shapeScore() const {
        // Blocky figures may well have no head and one joint for the trunk; those with whole limbs have both.
        return score - prior - legs.names - arms.names - trunk.names - legs.missing - arms.missing -
               (isBlocky() ? trunk.missing : 0.0F);
    }
};

inline constexpr float kLeastShapeScore = -1.0F;  ///< Of Figure::shapeScore().
inline constexpr float kLeastWholeScore = -7.0F;  ///< As kLeastShapeScore, but with what missing joints cost.

/// Reads the rig in every stance that it may have and keeps the best.
[[nodiscard]] Figure findFigure(const RigFeatures& rig);

}  // namespace lutka::animation
