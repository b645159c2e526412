#include "animation/import/fbx/triangulate.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

namespace lutka::animation::rig_import::fbx {
namespace {

using glm::dvec2;
using glm::dvec3;

// Ears take the square of the corners' number at least.
constexpr std::size_t kMostEars = 512;

// The polygon's area times its normal (Newell).
dvec3 areaNormal(std::span<const vec3> corners) {
    dvec3 sum(0);
    for (std::size_t i = 0; i < corners.size(); ++i)
        sum += glm::cross(dvec3(corners[i]), dvec3(corners[(i + 1) % corners.size()]));
    return sum;
}

double turn(const dvec2& a, const dvec2& b, const dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

std::vector<dvec2> flattened(std::span<const vec3> corners, const dvec3& normal) {
    const dvec3 other = std::abs(normal.x) < 0.6 * glm::length(normal) ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
    const dvec3 x = glm::normalize(glm::cross(other, normal));
    const dvec3 y = glm::normalize(glm::cross(normal, x));
    std::vector<dvec2> out;
    out.reserve(corners.size());
    for (const vec3& corner : corners) {
        const dvec3 from = dvec3(corner) - dvec3(corners[0]);
        out.emplace_back(glm::dot(from, x), glm::dot(from, y));
    }
    return out;
}

void fan(std::uint32_t count, std::vector<std::uint32_t>& triangles) {
    for (std::uint32_t i = 1; i + 1 < count; ++i)
        triangles.insert(triangles.end(), {0, i, i + 1});
}

void cutQuad(std::span<const vec3> c, const dvec3& normal, std::vector<std::uint32_t>& triangles) {
    const auto upright = [&](int a, int b, int d) {
        return glm::dot(glm::cross(dvec3(c[b]) - dvec3(c[a]), dvec3(c[d]) - dvec3(c[a])), normal) > 0.0;
    };
    const bool first = upright(0, 1, 2) && upright(0, 2, 3);
    const bool second = upright(1, 2, 3) && upright(1, 3, 0);
    const bool shorter = glm::distance(c[1], c[3]) < 0.999F * glm::distance(c[0], c[2]);
    if (second && (!first || shorter))
        triangles.insert(triangles.end(), {0, 1, 3, 1, 2, 3});
    else
        triangles.insert(triangles.end(), {0, 1, 2, 0, 2, 3});
}

bool isEar(std::span<const dvec2> flat, std::span<const std::uint32_t> ring, std::size_t at) {
    const std::size_t count = ring.size();
    const std::uint32_t a = ring[(at + count - 1) % count];
    const std::uint32_t b = ring[at];
    const std::uint32_t c = ring[(at + 1) % count];
    if (!(turn(flat[a], flat[b], flat[c]) > 0.0)) return false;
    for (const std::uint32_t other : ring) {
        if (other == a || other == b || other == c) continue;
        const dvec2& p = flat[other];
        // A corner in the same place (a bridge to a hole) is no obstacle.
        if (p == flat[a] || p == flat[b] || p == flat[c]) continue;
        if (turn(flat[a], flat[b], p) >= 0.0 && turn(flat[b], flat[c], p) >= 0.0 && turn(flat[c], flat[a], p) >= 0.0)
            return false;
    }
    return true;
}

void cutEars(std::span<const dvec2> flat, std::vector<std::uint32_t>& triangles) {
    std::vector<std::uint32_t> ring(flat.size());
    std::iota(ring.begin(), ring.end(), 0U);
    std::size_t at = 0;
    std::size_t tried = 0;
    while (ring.size() > 3) {
        const std::size_t count = ring.size();
        at %= count;
        // After a whole round without an ear (a polygon that crosses itself) any corner is cut.
        if (tried < count && !isEar(flat, ring, at)) {
            ++at;
            ++tried;
            continue;
        }
        triangles.insert(triangles.end(), {ring[(at + count - 1) % count], ring[at], ring[(at + 1) % count]});
        ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(at));
        tried = 0;
        ++at;  // not the neighbour at once, or a round polygon becomes a fan of slivers
    }
    triangles.insert(triangles.end(), {ring[0], ring[1], ring[2]});
}

}  // namespace

void triangulate(std::span<const vec3> corners, std::vector<std::uint32_t>& triangles) {
    const auto count = static_cast<std::uint32_t>(corners.size());
    if (count == 3) return fan(count, triangles);
    const dvec3 normal = areaNormal(corners);
    const bool flat = !(glm::length(normal) > 1e-30) || !std::isfinite(glm::length(normal));
    if (count < 3 || count > kMostEars || flat) return fan(count, triangles);
    if (count == 4) return cutQuad(corners, normal, triangles);
    cutEars(flattened(corners, normal), triangles);
}

}  // namespace lutka::animation::rig_import::fbx
