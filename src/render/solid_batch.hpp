#pragma once

#include <vector>

#include "core/rigid_transform.hpp"
#include "render/color.hpp"

namespace lutka::render {

/// A vertex of debug geometry, as it is uploaded (28 bytes).
struct SolidVertex {
    vec3 position{0, 0, 0};  ///< World, metres.
    vec3 normal{0, 1, 0};    ///< World, unit.
    Color color;             ///< Its alpha is the opacity.
};
static_assert(sizeof(SolidVertex) == 28);

/// Translucent triangles for debug draw (capsules, limit sectors), three vertices each, counter-clockwise outside.
/// Only the surface nearest to the eye is blended, so that overlapping shapes stay readable; what the scene hides shows
/// through faintly. One upload and a fixed number of draw calls a frame.
struct SolidBatch {
    std::vector<SolidVertex> vertices;

    void clear() { vertices.clear(); }
    [[nodiscard]] bool empty() const { return vertices.empty(); }
    [[nodiscard]] std::size_t triangleCount() const { return vertices.size() / 3; }
};

/// Capsule around local Y; measures as in line_batch.hpp. Every vertex lies on the surface.
void addCapsule(SolidBatch& solids, const RigidTransform& worldFromCapsule, float radius, float halfLength,
                Color color);
void addSphere(SolidBatch& solids, const vec3& center, float radius, Color color);
void addBox(SolidBatch& solids, const RigidTransform& worldFromBox, const vec3& halfExtents, Color color);

/// The mantle of the swing cone of line_batch.hpp, seen from both sides.
void addSwingCone(SolidBatch& solids, const RigidTransform& worldFromFrame, float swingY, float swingZ, float length,
                  Color color);

/// The filled sector of the hinge arc of line_batch.hpp, seen from both sides.
void addSector(SolidBatch& solids, const RigidTransform& worldFromFrame, float lower, float upper, float radius,
               Color color);

}  // namespace lutka::render
