#pragma once

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

namespace lutka {

/// The value below which `share` (in [0, 1]) of the points' area lies: robust against dense or stray vertices.
/// `value` maps a point to a number; points need a member `area`. At least one point; equal areas where all are 0.
template <class Point, class Value>
[[nodiscard]] float quantileOf(const std::vector<Point>& points, float share, Value value) {
    std::vector<std::pair<float, float>> sorted;
    sorted.reserve(points.size());
    float total = 0.0F;
    for (const Point& point : points) {
        sorted.emplace_back(value(point), point.area);
        total += point.area;
    }
    const bool weighted = total > 0.0F;
    if (!weighted) total = static_cast<float>(points.size());
    std::sort(sorted.begin(), sorted.end());
    float below = 0.0F;
    for (const auto& [at, area] : sorted) {
        below += weighted ? area : 1.0F;
        if (below >= share * total) return at;
    }
    return sorted.back().first;
}

}  // namespace lutka
