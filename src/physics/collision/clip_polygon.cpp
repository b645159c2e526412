#include "physics/collision/clip_polygon.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/assert.hpp"

namespace lutka::physics {

Outline outlineOf(std::span<const vec3> points, const vec3& outward) {
    LUTKA_ASSERT(points.size() <= ConvexHull::kMostPoints);
    constexpr float kOnALine = 1e-9F;  // square metres
    const vec3 u = glm::normalize(glm::cross(std::abs(outward.y) < 0.9F ? vec3(0, 1, 0) : vec3(1, 0, 0), outward));
    const vec3 v = glm::cross(outward, u);
    struct Seen {
        float x, y;
        int point;
    };
    std::array<Seen, ConvexHull::kMostPoints> seen;
    const auto count = static_cast<int>(points.size());
    for (int i = 0; i < count; ++i)
        seen[i] = {glm::dot(u, points[i]), glm::dot(v, points[i]), i};
    std::sort(seen.begin(), seen.begin() + count,
              [](const Seen& p, const Seen& q) { return p.x != q.x ? p.x < q.x : p.y < q.y; });
    std::array<Seen, 2 * ConvexHull::kMostPoints> chain;
    int length = 0;
    const auto append = [&](const Seen& next, int least) {
        while (length > least) {
            const Seen& a = chain[length - 2];
            const Seen& b = chain[length - 1];
            if ((b.x - a.x) * (next.y - a.y) - (b.y - a.y) * (next.x - a.x) > kOnALine) break;
            --length;
        }
        chain[length++] = next;
    };
    for (int i = 0; i < count; ++i)
        append(seen[i], 1);
    const int turn = length;
    for (int i = count - 2; i >= 0; --i)
        append(seen[i], turn);
    Outline outline;
    for (int i = 0; i + 1 < length; ++i)  // the last is the first again
        outline.add(points[static_cast<std::size_t>(chain[i].point)]);
    if (count == 1) outline.add(points[0]);
    return outline;
}

}  // namespace lutka::physics
