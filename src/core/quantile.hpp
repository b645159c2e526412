#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace lutka {

/// The values below which shares (each in [0, 1]) of the points' area lie: robust against dense or stray vertices.
/// `value` maps a point to a number; points need a member `area`. At least one point; equal areas where all are 0.
template <std::size_t Count, class Point, class Value>
[[nodiscard]] std::array<float, Count> quantilesOf(const std::vector<Point>& points,
                                                   const std::array<float, Count>& shares, Value value) {
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
    std::array<float, Count> result{};
    for (std::size_t i = 0; i < Count; ++i) {
        float below = 0.0F;
        result[i] = sorted.back().first;
        for (const auto& [at, area] : sorted) {
            below += weighted ? area : 1.0F;
            if (below < shares[i] * total) continue;
            result[i] = at;
            break;
        }
    }
    return result;
}

/// The value of one share.
template <class Point, class Value>
[[nodiscard]] float quantileOf(const std::vector<Point>& points, float share, Value value) {
    return quantilesOf(points, std::array<float, 1>{share}, value)[0];
}

}  // namespace lutka
