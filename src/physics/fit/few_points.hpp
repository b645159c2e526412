#pragma once

#include <vector>

#include "physics/fit/fit_shapes.hpp"

namespace lutka::physics {

/// What a capsule around few points must keep to; metres.
struct FewPointsBounds {
    bool symmetric = false;  ///< It stands in the plane x = middleX or lies across it.
    float middleX = 0.0F;
    float smallestRadius = 0.01F;
    float largestRadius = 1.0F;
};

/// A capsule along the widest spread of points that are too few for a search, as those of an ear's tip or of one side
/// of a box are. At least one point.
[[nodiscard]] Capsule capsuleAlong(const std::vector<SkinPoint>& points, const FewPointsBounds& bounds);

}  // namespace lutka::physics
