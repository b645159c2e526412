#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "core/quantile.hpp"
#include "core/rigid_transform.hpp"
#include "physics/fit/skin_point.hpp"

namespace lutka::physics {

/// A few hundred of a body's skin points in the axes of a search, and how near a shape's surface lies to them. Where no
/// point has an area all count alike.
class SkinSample {
  public:
    /// At most `most` of the points, evenly from their order; at least one.
    SkinSample(const std::vector<SkinPoint>& points, const RigidTransform& axesFromStandard, std::size_t most) {
        const std::size_t stride = (points.size() + most - 1) / most;
        points_.reserve(points.size() / stride + 1);
        const bool weighted = std::any_of(points.begin(), points.end(), [](const auto& p) { return p.area > 0.0F; });
        for (std::size_t i = 0; i < points.size(); i += stride) {
            points_.push_back({axesFromStandard * points[i].position, weighted ? points[i].area : 1.0F});
            area_ += points_.back().area;
        }
    }

    [[nodiscard]] const std::vector<SkinPoint>& points() const { return points_; }

    /// Area-weighted mean distance of the points from a shape's surface, metres, each cut off at `cutoff`. A point's is
    /// what distanceFrom(shape, point) beside the shape's type gives, negative inside. Skin inside the shape, where the
    /// shape stands out of it, counts `protrusion` times.
    template <class Shape>
    [[nodiscard]] float cost(float cutoff, const Shape& shape, float protrusion = 1.0F) const {
        float sum = 0.0F;
        for (const SkinPoint& point : points_) {
            const float apart = distanceFrom(shape, point.position);
            const float distance = apart < 0.0F ? -protrusion * apart : apart;
            sum += point.area * std::min(distance, cutoff);
        }
        return area_ > 0.0F ? sum / area_ : 0.0F;
    }

    /// The share of the skin within `reach` metres of the surface, [0, 1].
    template <class Shape>
    [[nodiscard]] float shareWithin(float reach, const Shape& shape) const {
        float near = 0.0F;
        for (const SkinPoint& point : points_)
            near += std::abs(distanceFrom(shape, point.position)) <= reach ? point.area : 0.0F;
        return area_ > 0.0F ? near / area_ : 0.0F;
    }

    /// The corners between two quantiles of the points' three coordinates.
    [[nodiscard]] std::pair<vec3, vec3> quantiles(float low, float high) const {
        std::pair<vec3, vec3> corners;
        for (int axis = 0; axis < 3; ++axis) {
            const auto ends = quantilesOf(points_, std::array<float, 2>{low, high},
                                          [axis](const SkinPoint& p) { return p.position[axis]; });
            corners.first[axis] = ends[0];
            corners.second[axis] = ends[1];
        }
        return corners;
    }

  private:
    std::vector<SkinPoint> points_;
    float area_ = 0.0F;
};

}  // namespace lutka::physics
