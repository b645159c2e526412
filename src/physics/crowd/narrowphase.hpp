#pragma once

#include <array>

#include "physics/collision/contacts.hpp"
#include "physics/profile/profile.hpp"
#include "physics/world/world.hpp"

namespace lutka::physics::crowd {

/// One of a body's shapes where it is.
struct PlacedShape {
    const PrimitiveShape* shape = nullptr;
    vec3 position{0, 0, 0};
    mat3 axes{1};  ///< Columns: the shape's axes in the world, those of the body for its main shape.
};

/// Half the size of the world's axis-aligned box around it, metres.
[[nodiscard]] vec3 halfBounds(const PlacedShape& placed);

/// The corners of a box or hull and the ends of a capsule, in the shape's space: what a convex static face can meet.
struct CorePoints {
    std::array<vec3, ConvexHull::kMostPoints> local;
    int count = 0;
    float radius = 0.0F;
};
/// Half the length of the core along the body's y: a sphere is a capsule of no length.
[[nodiscard]] float coreHalf(const PrimitiveShape& shape);
[[nodiscard]] CorePoints corePoints(const PrimitiveShape& shape);

/// Where a shape's core (a point of it, in body space) with `radius` around it meets the half space n · p <= offset.
struct StaticTouch {
    vec3 local{0, 0, 0};
    float radius = 0.0F;
    vec3 normal{0, 1, 0};
    float offset = 0.0F;
    float separation = 0.0F;
    int feature = 0;  ///< Which point of the shape, for matching it with the step before.
};

/// Where the cores of two bodies meet; the surfaces are `separation` apart along `normal` (from B to A).
struct BodyTouch {
    vec3 localA{0, 0, 0};
    vec3 localB{0, 0, 0};
    float radius = 0.0F;  ///< Of both together.
    vec3 normal{0, 1, 0};
    float separation = 0.0F;
};

/// Contacts found; the first `count` are meant.
template <class Touch, int kMost = 4>
struct Touches {
    std::array<Touch, kMost> points;
    int count = 0;
    int capacity = 4;  ///< At most kMost.

    /// Keeps the deepest `capacity`.
    void add(const Touch& touch) {
        if (count < capacity) {
            points[count++] = touch;
            return;
        }
        int shallowest = 0;
        for (int i = 1; i < capacity; ++i)
            if (points[i].separation > points[shallowest].separation) shallowest = i;
        if (touch.separation < points[shallowest].separation) points[shallowest] = touch;
    }
};

/// Static geometry with what the tests need of it worked out.
struct PlacedStatic {
    explicit PlacedStatic(const StaticShape& given);

    StaticShape shape;
    CollisionGeometry geometry;
    mat3 axes{1};
    vec3 low{0, 0, 0};  ///< World bounds; a plane has none.
    vec3 high{0, 0, 0};
};

/// Only meshes have more than four.
using StaticTouches = Touches<StaticTouch, ContactList::kMax>;

/// Points of the body nearer than `range` to the geometry. On a box: those of touchBox(), or the corners of a body that
/// is one, or those of a hull's. Other geometry: see findContacts().
[[nodiscard]] StaticTouches touchStatic(const PlacedShape& body, const PlacedStatic& geometry, float range);

/// Whether one of the touches keeps the same point of the body out of the same half space.
[[nodiscard]] bool saysTheSame(const StaticTouches& touches, const vec3& local, const vec3& normal);

/// Points of two bodies nearer than `range`. Two boxes that overlap: those of touchBoxes(); a hull and
/// a box or hull: those of touchSolids().
[[nodiscard]] Touches<BodyTouch> touchBodies(const PlacedShape& a, const PlacedShape& b, float range);

/// Fraction of the segment from `from` to `to` where it enters the shape and the normal there; fraction > 1: it misses.
/// A start inside the shape is a miss.
struct RayTouch {
    float fraction = 2.0F;
    vec3 normal{0, 1, 0};
};
[[nodiscard]] RayTouch rayAgainst(const PlacedShape& body, const vec3& from, const vec3& to);
[[nodiscard]] RayTouch rayAgainst(const PlacedStatic& geometry, const vec3& from, const vec3& to);

}  // namespace lutka::physics::crowd
