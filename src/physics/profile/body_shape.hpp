#pragma once

#include <cstddef>
#include <vector>

#include "core/rigid_transform.hpp"
#include "core/shape_kind.hpp"
#include "physics/profile/convex_hull.hpp"

namespace lutka::physics {

/// One simple collision shape, centred on its own origin.
struct PrimitiveShape {
    /// The ones that a body can have, so that the compiler sees every switch over them whole.
    enum class Kind {
        capsule = static_cast<int>(ShapeKind::capsule),
        box = static_cast<int>(ShapeKind::box),
        sphere = static_cast<int>(ShapeKind::sphere),
        hull = static_cast<int>(ShapeKind::hull),
    };
    Kind kind = Kind::capsule;
    float radius = 0.05F;                ///< Metres, > 0; capsule and sphere.
    float halfLength = 0.1F;             ///< Metres, >= 0; capsule: half the distance of the cap centres, along Y.
    vec3 halfExtents{0.1F, 0.1F, 0.1F};  ///< Metres, > 0; box.
    ConvexHullPtr hull;                  ///< Hull: not null, its centroid at the origin (see isCentred()).

    /// Whether it has flat sides and edges; else it is a segment or point with a radius around it.
    [[nodiscard]] bool isAngular() const { return kind == Kind::box || kind == Kind::hull; }
};
[[nodiscard]] constexpr ShapeKind shapeKindOf(PrimitiveShape::Kind kind) {
    return static_cast<ShapeKind>(kind);
}

/// A further shape of a body, and where it sits in it.
struct AddedShape : PrimitiveShape {
    RigidTransform bodyFromShape;
};

/// What a body collides as: a main shape, centred on the body's origin, and with it what `more` holds. The body is the
/// union of them all. A function that takes a PrimitiveShape sees the main one alone.
struct BodyShape : PrimitiveShape {
    static constexpr std::size_t kMostAdded = 2;

    std::vector<AddedShape> more;  ///< At most kMostAdded; mostly none.
};

/// Whether the hull's centroid is at the origin, to a hundredth of its reach.
[[nodiscard]] bool isCentred(const ConvexHull& hull);

/// A hull, given in any frame, as a shape about its own centroid. The shape's axes are the hull's principal ones, in
/// the order and with the signs that are nearest to the frame's.
struct CentredHull {
    PrimitiveShape shape;  ///< Of kind hull.
    RigidTransform frameFromShape;
};
[[nodiscard]] CentredHull centredHull(const ConvexHull& hull);

/// The same hull with each side scaled by the factors, all above 0. Where it would come out flat nothing changes.
void scaleHull(PrimitiveShape& shape, const vec3& factors);

/// The shape of the counterpart on the other side, in a body's axes that are mirrored across x.
[[nodiscard]] BodyShape mirrored(BodyShape shape);

/// Calls visit(shape, bodyFromShape) for each of a body's shapes, the main one first.
template <class Visit>
void visitShapes(const BodyShape& shape, Visit visit) {
    visit(static_cast<const PrimitiveShape&>(shape), RigidTransform{});
    for (const AddedShape& added : shape.more)
        visit(static_cast<const PrimitiveShape&>(added), added.bodyFromShape);
}

}  // namespace lutka::physics
