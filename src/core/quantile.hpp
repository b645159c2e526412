#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace lutka {

/// Walks entries in the order of `before` until `isReached(entry)`, and returns that entry, or the last one. Only as
/// much of them as it comes past is brought into order; `likely` says how many those will be.
template <class Entry, class Before, class IsReached>
[[nodiscard]] Entry walkInOrder(std::vector<Entry>& entries, std::size_t likely, Before before, IsReached isReached) {
    const std::size_t count = entries.size();
    std::size_t ordered = 0;
    for (std::size_t i = 0; i + 1 < count; ++i) {
        if (i == ordered) {
            const auto at = [&](std::size_t place) { return entries.begin() + static_cast<std::ptrdiff_t>(place); };
            ordered += likely;
            likely *= 4;
            // Beyond such a share a heap is slower than sorting all.
            if (ordered > count / 8) ordered = count;
            if (ordered == count)
                std::sort(at(i), entries.end(), before);
            else
                std::partial_sort(at(i), at(ordered), entries.end(), before);
        }
        if (isReached(entries[i])) return entries[i];
    }
    return entries.back();
}

/// The values below which shares (each in [0, 1]) of the points' area lie: robust against dense or stray vertices.
/// `value` maps a point to a number; points need a member `area`. At least one point; equal areas where all are 0.
template <std::size_t Count, class Point, class Value>
[[nodiscard]] std::array<float, Count> quantilesOf(const std::vector<Point>& points,
                                                   const std::array<float, Count>& shares, Value value) {
    using Entry = std::pair<float, float>;  // value, area
    std::vector<Entry> entries;
    entries.reserve(points.size());
    float total = 0.0F;
    for (const Point& point : points) {
        entries.emplace_back(value(point), point.area);
        total += point.area;
    }
    if (!(total > 0.0F)) {
        for (Entry& entry : entries)
            entry.second = 1.0F;
        total = static_cast<float>(points.size());
    }
    // Counted from the nearer end: most quantiles that are asked for lie next to it, and searches ask for hundreds.
    std::array<float, Count> result{};
    for (std::size_t i = 0; i < Count; ++i) {
        const bool low = shares[i] <= 0.5F;
        const float share = low ? shares[i] : 1.0F - shares[i];
        const auto likely = 4 + static_cast<std::size_t>(1.5F * share * static_cast<float>(points.size()));
        float passed = 0.0F;
        if (low) {
            result[i] = walkInOrder(entries, likely, std::less<Entry>(), [&](const Entry& entry) {
                            passed += entry.second;
                            return passed >= shares[i] * total;
                        }).first;
        } else {
            result[i] = walkInOrder(entries, likely, std::greater<Entry>(), [&](const Entry& entry) {
                            passed += entry.second;
                            return passed > total - shares[i] * total;
                        }).first;
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
