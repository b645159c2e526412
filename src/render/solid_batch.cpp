#include "render/solid_batch.hpp"

#include <array>
#include <glm/geometric.hpp>

#include "core/assert.hpp"
#include "render/box_sides.hpp"
#include "render/swing.hpp"

namespace lutka::render {
namespace {

constexpr int kSegments = 24;  // around; with the rings the same grid as the lines of line_batch.cpp
constexpr int kCapRings = 6;   // from the equator to each pole

struct Corner {
    vec3 position;
    vec3 normal;
};

void addTriangle(SolidBatch& solids, const Corner& a, const Corner& b, const Corner& c, Color color) {
    for (const Corner* corner : {&a, &b, &c})
        solids.vertices.push_back({corner->position, corner->normal, color});
}

// Both windings, so that it is seen from both sides under back-face culling.
void addTwoSided(SolidBatch& solids, const vec3& a, const vec3& b, const vec3& c, Color color) {
    const vec3 across = glm::cross(b - a, c - a);
    const float area = glm::length(across);
    if (!(area > 0.0F)) return;
    const vec3 n = across / area;
    addTriangle(solids, {a, n}, {b, n}, {c, n}, color);
    addTriangle(solids, {a, -n}, {c, -n}, {b, -n}, color);
}

// A point of the capsule's surface: ring 0 is the south pole, the last ring the north pole; the middle two are the
// equators of the caps, between which the mantle runs.
Corner capsuleCorner(const RigidTransform& worldFromCapsule, float radius, float halfLength, int ring, int segment) {
    const bool upper = ring > kCapRings;
    const int fromEquator = upper ? ring - kCapRings - 1 : ring - kCapRings;
    const float latitude = 0.5F * kPi * static_cast<float>(fromEquator) / kCapRings;
    const float longitude = 2.0F * kPi * static_cast<float>(segment % kSegments) / kSegments;
    const vec3 out(std::cos(latitude) * std::cos(longitude), std::sin(latitude),
                   -std::cos(latitude) * std::sin(longitude));
    const vec3 local = radius * out + vec3(0, upper ? halfLength : -halfLength, 0);
    return {worldFromCapsule * local, worldFromCapsule.rotation * out};
}

}  // namespace

void addCapsule(SolidBatch& solids, const RigidTransform& worldFromCapsule, float radius, float halfLength,
                Color color) {
    LUTKA_ASSERT(radius > 0.0F && halfLength >= 0.0F);
    constexpr int kLastRing = 2 * kCapRings + 1;
    for (int ring = 0; ring < kLastRing; ++ring) {
        for (int segment = 0; segment < kSegments; ++segment) {
            const Corner a = capsuleCorner(worldFromCapsule, radius, halfLength, ring, segment);
            const Corner b = capsuleCorner(worldFromCapsule, radius, halfLength, ring, segment + 1);
            const Corner c = capsuleCorner(worldFromCapsule, radius, halfLength, ring + 1, segment + 1);
            const Corner d = capsuleCorner(worldFromCapsule, radius, halfLength, ring + 1, segment);
            if (ring > 0) addTriangle(solids, a, b, c, color);
            if (ring + 1 < kLastRing) addTriangle(solids, a, c, d, color);
        }
    }
}

void addSphere(SolidBatch& solids, const vec3& center, float radius, Color color) {
    addCapsule(solids, {quat(1, 0, 0, 0), center}, radius, 0.0F, color);
}

void addBox(SolidBatch& solids, const RigidTransform& worldFromBox, const vec3& halfExtents, Color color) {
    for (const BoxSide& side : boxSides()) {
        const vec3 normal = worldFromBox.rotation * side.normal;
        const auto corner = [&](std::size_t index) {
            return Corner{worldFromBox * (side.corners[index] * halfExtents), normal};
        };
        addTriangle(solids, corner(0), corner(1), corner(2), color);
        addTriangle(solids, corner(0), corner(2), corner(3), color);
    }
}

void addSwingCone(SolidBatch& solids, const RigidTransform& worldFromFrame, float swingY, float swingZ, float length,
                  Color color) {
    vec3 last = worldFromFrame * (length * swungX(swingY, swingZ, 0.0F));
    for (int i = 1; i <= kSwingRimSegments; ++i) {
        const float angle = 2.0F * kPi * static_cast<float>(i) / kSwingRimSegments;
        const vec3 next = worldFromFrame * (length * swungX(swingY, swingZ, angle));
        addTwoSided(solids, worldFromFrame.translation, last, next, color);
        last = next;
    }
}

void addSector(SolidBatch& solids, const RigidTransform& worldFromFrame, float lower, float upper, float radius,
               Color color) {
    constexpr int kPieces = 24;
    const auto rim = [&](int i) {
        const float angle = lower + (upper - lower) * static_cast<float>(i) / kPieces;
        return worldFromFrame * vec3(radius * std::cos(angle), radius * std::sin(angle), 0);
    };
    for (int i = 0; i < kPieces; ++i)
        addTwoSided(solids, worldFromFrame.translation, rim(i), rim(i + 1), color);
}

}  // namespace lutka::render
