#pragma once

#include <span>
#include <vector>

#include "core/rigid_transform.hpp"
#include "render/color.hpp"

namespace lutka::render {

/// One end of a line segment, as it is uploaded (16 bytes).
struct LineVertex {
    vec3 position{0, 0, 0};  ///< World, metres.
    Color color;
};
static_assert(sizeof(LineVertex) == 16);

/// Line segments of a frame: two vertices each. All debug draw of all characters goes into one batch, which is one
/// upload and one draw call. clear() keeps the memory, so a frame like the last one allocates nothing.
struct LineBatch {
    std::vector<LineVertex> vertices;

    void clear() { vertices.clear(); }
    [[nodiscard]] bool empty() const { return vertices.empty(); }
    [[nodiscard]] std::size_t segmentCount() const { return vertices.size() / 2; }

    void add(const vec3& from, const vec3& to, Color color) { add(from, to, color, color); }
    void add(const vec3& from, const vec3& to, Color fromColor, Color toColor) {
        vertices.push_back({from, fromColor});
        vertices.push_back({to, toColor});
    }
};

/// Capsule around local Y: two end rings, four lines along and the meridians of the caps. `radius` > 0, `halfLength`
/// >= 0 (half the distance of the cap centres). Every vertex lies on the surface.
void addCapsule(LineBatch& lines, const RigidTransform& worldFromCapsule, float radius, float halfLength, Color color);

/// Three great circles.
void addSphere(LineBatch& lines, const vec3& center, float radius, Color color);

/// The twelve edges.
void addBox(LineBatch& lines, const RigidTransform& worldFromBox, const vec3& halfExtents, Color color);

/// The twelve edges of an axis-aligned box between two corners.
void addAabb(LineBatch& lines, const vec3& lower, const vec3& upper, Color color);

/// x, y, z in red, green, blue, each `length` metres.
void addAxes(LineBatch& lines, const RigidTransform& worldFromFrame, float length);

/// A closed circle about `normal` (unit).
void addCircle(LineBatch& lines, const vec3& center, const vec3& normal, float radius, Color color);

/// An arc of a hinge about the frame's z, from `lower` to `upper` radians measured from x towards y, with spokes to
/// its ends.
void addArc(LineBatch& lines, const RigidTransform& worldFromFrame, float lower, float upper, float radius,
            Color color);

/// An arc without spokes about `axis` (unit), starting at `start` (unit, across the axis).
void addArc(LineBatch& lines, const vec3& center, const vec3& axis, const vec3& start, float lower, float upper,
            float radius, Color color);

/// The elliptic swing cone of a cone-twist joint about the frame's x: its rim is where x is taken by the rotation
/// vectors s = (0, swingY cos t, swingZ sin t), as in ConeTwistLimits; with eight spokes from the apex, `length`
/// metres.
void addSwingCone(LineBatch& lines, const RigidTransform& worldFromFrame, float swingY, float swingZ, float length,
                  Color color);

/// A shaft with a four-sided head of a fifth of its length; nothing when from and to coincide.
void addArrow(LineBatch& lines, const vec3& from, const vec3& to, Color color);

/// Three short lines through a point, `size` metres from end to end.
void addCross(LineBatch& lines, const vec3& center, float size, Color color);

/// A square grid in the frame's xz plane: `cells` cells each way of `spacing` metres.
void addGrid(LineBatch& lines, const RigidTransform& worldFromGrid, int cells, float spacing, Color color);

/// A skeleton as octahedral bones from each joint to its child: `positions` in world space, one a joint; `parents` as
/// in Skeleton (-1: root).
void addSkeleton(LineBatch& lines, std::span<const vec3> positions, std::span<const int> parents, Color color);

}  // namespace lutka::render
