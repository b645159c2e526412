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
    float score = -1e9F;  ///< Sum of all terms; kLeastFigureScore and more is a humanoid.
    FramedRig framed;
    LimbCandidate legs;
    LimbCandidate arms;
    TrunkCandidate trunk;
    Facing facing;
    Margins margins;
};

inline constexpr float kLeastFigureScore = -8.0F;

/// Reads the rig in every stance that it may have and keeps the best.
[[nodiscard]] Figure findFigure(const RigFeatures& rig);

}  // namespace lutka::animation
