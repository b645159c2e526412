#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "core/rigid_transform.hpp"
#include "physics/fit/skin_sample.hpp"

namespace lutka::physics {

struct Capsule;

/// A capsule in the axes of a search, its axis along the search's y. Metres.
struct CapsuleTrial {
    vec3 center{0, 0, 0};
    float halfLength = 0.0F;
    float radius = 0.0F;
};

/// Signed distance of a point of the search's axes from the surface, metres; negative inside.
[[nodiscard]] inline float distanceFrom(const CapsuleTrial& trial, const vec3& point) {
    const vec3 d = point - trial.center;
    const float beyond = std::max(0.0F, std::abs(d.y) - trial.halfLength);
    return std::sqrt(d.x * d.x + beyond * beyond + d.z * d.z) - trial.radius;
}

/// Finds the capsule whose surface lies nearest to skin points: a coordinate search with shrinking steps over centre,
/// half length and radius, the direction of the axis being given. The points are thinned to a few hundred.
class CapsuleSearch {
  public:
    /// `standardFromSearch`: the axis is its y. Distances count up to `cutoff`, metres.
    CapsuleSearch(const std::vector<SkinPoint>& points, const RigidTransform& standardFromSearch, float smallestRadius,
                  float largestRadius, float cutoff);

    /// From `start`; `settle` clamps every trial to what the segment allows.
    [[nodiscard]] Capsule run(const CapsuleTrial& start, const std::function<void(CapsuleTrial&)>& settle) const;

    /// Area-weighted mean distance of the points from the surface, each cut off; metres.
    [[nodiscard]] float cost(const Capsule& capsule) const;

    /// Median distance from the axis of the points whose y lies between the two values.
    [[nodiscard]] float radiusAboutAxis(float fromY, float toY) const;
    /// The capsule of the points' robust bounding box.
    [[nodiscard]] CapsuleTrial boundingTrial() const;
    /// The corners between two quantiles of the points' three coordinates, in the search's axes.
    [[nodiscard]] std::pair<vec3, vec3> quantiles(float low, float high) const;

    [[nodiscard]] vec3 inSearch(const vec3& standardDirection) const;
    [[nodiscard]] vec3 toSearch(const vec3& standardPoint) const;
    [[nodiscard]] vec3 inStandard(const vec3& searchPoint) const;

  private:
    [[nodiscard]] float cost(const CapsuleTrial& trial) const;

    SkinSample sample_;  // in the search's axes
    RigidTransform standardFromSearch_;
    float smallestRadius_;
    float largestRadius_;
    float cutoff_;
};

}  // namespace lutka::physics
