#include "render/line_batch.hpp"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>

#include "core/assert.hpp"
#include "render/swing.hpp"

namespace lutka::render {
namespace {

constexpr int kCircleSegments = 24;

// `count` segments of an arc: center + radius (cos a · u + sin a · v) for a from `from` to `to`.
void addArcSegments(LineBatch& lines, const vec3& center, const vec3& u, const vec3& v, float from, float to, int count,
                    Color color) {
    vec3 last = center + std::cos(from) * u + std::sin(from) * v;
    for (int i = 1; i <= count; ++i) {
        const float angle = from + (to - from) * static_cast<float>(i) / static_cast<float>(count);
        const vec3 next = center + std::cos(angle) * u + std::sin(angle) * v;
        lines.add(last, next, color);
        last = next;
    }
}

int segmentsOf(float angle) {
    return std::clamp(static_cast<int>(std::ceil(std::abs(angle) / (2.0F * kPi) * kCircleSegments)), 1, 96);
}

}  // namespace

void addCapsule(LineBatch& lines, const RigidTransform& worldFromCapsule, float radius, float halfLength, Color color) {
    LUTKA_ASSERT(radius > 0.0F && halfLength >= 0.0F);
    const vec3 x = worldFromCapsule.rotation * vec3(radius, 0, 0);
    const vec3 y = worldFromCapsule.rotation * vec3(0, radius, 0);
    const vec3 z = worldFromCapsule.rotation * vec3(0, 0, radius);
    const vec3 top = worldFromCapsule * vec3(0, halfLength, 0);
    const vec3 bottom = worldFromCapsule * vec3(0, -halfLength, 0);
    for (const vec3& end : {top, bottom})
        addArcSegments(lines, end, x, z, 0.0F, 2.0F * kPi, kCircleSegments, color);
    for (const vec3& side : {x, -x, z, -z})
        lines.add(top + side, bottom + side, color);
    for (const vec3& side : {x, z}) {
        addArcSegments(lines, top, side, y, 0.0F, kPi, kCircleSegments / 2, color);
        addArcSegments(lines, bottom, side, y, kPi, 2.0F * kPi, kCircleSegments / 2, color);
    }
}

void addSphere(LineBatch& lines, const vec3& center, float radius, Color color) {
    for (const vec3& normal : {vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1)})
        addCircle(lines, center, normal, radius, color);
}

void addBox(LineBatch& lines, const RigidTransform& worldFromBox, const vec3& halfExtents, Color color) {
    std::array<vec3, 8> corners;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const vec3 sign((i & 1U) != 0 ? 1 : -1, (i & 2U) != 0 ? 1 : -1, (i & 4U) != 0 ? 1 : -1);
        corners[i] = worldFromBox * (sign * halfExtents);
    }
    for (std::size_t i = 0; i < corners.size(); ++i) {
        for (const std::size_t bit : {1U, 2U, 4U}) {
            if ((i & bit) == 0) lines.add(corners[i], corners[i | bit], color);
        }
    }
}

void addAabb(LineBatch& lines, const vec3& lower, const vec3& upper, Color color) {
    addBox(lines, {quat(1, 0, 0, 0), 0.5F * (lower + upper)}, 0.5F * (upper - lower), color);
}

void addAxes(LineBatch& lines, const RigidTransform& worldFromFrame, float length) {
    const vec3 origin = worldFromFrame.translation;
    lines.add(origin, worldFromFrame * vec3(length, 0, 0), colors::red);
    lines.add(origin, worldFromFrame * vec3(0, length, 0), colors::green);
    lines.add(origin, worldFromFrame * vec3(0, 0, length), colors::blue);
}

void addCircle(LineBatch& lines, const vec3& center, const vec3& normal, float radius, Color color) {
    const vec3 u = anyPerpendicular(normal);
    addArcSegments(lines, center, radius * u, radius * glm::cross(normal, u), 0.0F, 2.0F * kPi, kCircleSegments, color);
}

void addArc(LineBatch& lines, const RigidTransform& worldFromFrame, float lower, float upper, float radius,
            Color color) {
    const vec3 center = worldFromFrame.translation;
    const vec3 x = worldFromFrame.rotation * vec3(radius, 0, 0);
    const vec3 y = worldFromFrame.rotation * vec3(0, radius, 0);
    addArcSegments(lines, center, x, y, lower, upper, segmentsOf(upper - lower), color);
    for (const float angle : {lower, upper})
        lines.add(center, center + std::cos(angle) * x + std::sin(angle) * y, color);
}

void addArc(LineBatch& lines, const vec3& center, const vec3& axis, const vec3& start, float lower, float upper,
            float radius, Color color) {
    addArcSegments(lines, center, radius * start, radius * glm::cross(axis, start), lower, upper,
                   segmentsOf(upper - lower), color);
}

void addSwingCone(LineBatch& lines, const RigidTransform& worldFromFrame, float swingY, float swingZ, float length,
                  Color color) {
    constexpr int kSpokeEvery = 4;
    vec3 last = worldFromFrame * (length * swungX(swingY, swingZ, 0.0F));
    for (int i = 1; i <= kSwingRimSegments; ++i) {
        const float angle = 2.0F * kPi * static_cast<float>(i) / kSwingRimSegments;
        const vec3 next = worldFromFrame * (length * swungX(swingY, swingZ, angle));
        lines.add(last, next, color);
        if (i % kSpokeEvery == 0) lines.add(worldFromFrame.translation, next, color);
        last = next;
    }
}

void addArrow(LineBatch& lines, const vec3& from, const vec3& to, Color color) {
    const float length = glm::length(to - from);
    if (!(length > 0.0F)) return;
    lines.add(from, to, color);
    const vec3 along = (to - from) / length;
    const vec3 u = anyPerpendicular(along);
    const vec3 v = glm::cross(along, u);
    const vec3 neck = to - 0.2F * length * along;
    for (const vec3& side : {u, -u, v, -v})
        lines.add(to, neck + 0.07F * length * side, color);
}

void addCross(LineBatch& lines, const vec3& center, float size, Color color) {
    for (const vec3& axis : {vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1)})
        lines.add(center - 0.5F * size * axis, center + 0.5F * size * axis, color);
}

void addGrid(LineBatch& lines, const RigidTransform& worldFromGrid, int cells, float spacing, Color color) {
    const float half = 0.5F * static_cast<float>(cells) * spacing;
    for (int i = 0; i <= cells; ++i) {
        const float at = static_cast<float>(i) * spacing - half;
        lines.add(worldFromGrid * vec3(at, 0, -half), worldFromGrid * vec3(at, 0, half), color);
        lines.add(worldFromGrid * vec3(-half, 0, at), worldFromGrid * vec3(half, 0, at), color);
    }
}

void addSkeleton(LineBatch& lines, std::span<const vec3> positions, std::span<const int> parents, Color color) {
    LUTKA_ASSERT(positions.size() == parents.size());
    for (std::size_t joint = 0; joint < positions.size(); ++joint) {
        if (parents[joint] < 0) continue;
        const vec3& from = positions[parents[joint]];
        const vec3& to = positions[joint];
        const float length = glm::length(to - from);
        if (!(length > 1e-4F)) continue;
        const vec3 along = (to - from) / length;
        const vec3 u = anyPerpendicular(along);
        const vec3 v = glm::cross(along, u);
        const vec3 waist = from + 0.15F * length * along;
        const std::array<vec3, 4> ring = {u, v, -u, -v};
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const vec3 corner = waist + 0.06F * length * ring[i];
            lines.add(from, corner, color);
            lines.add(corner, to, color);
            lines.add(corner, waist + 0.06F * length * ring[(i + 1) % ring.size()], color);
        }
    }
}

}  // namespace lutka::render
