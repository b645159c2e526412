#pragma once

#include <array>
#include <glm/geometric.hpp>
#include <limits>

#include "physics/collision/contacts.hpp"
#include "physics/collision/hull_distance.hpp"
#include "physics/collision/shape_distance.hpp"
#include "physics/profile/convex_hull.hpp"

namespace lutka::physics {

/// The corners of a box or hull, and what lies on which side of it. The geometry must outlive it.
class SolidCorners {
  public:
    explicit SolidCorners(const CollisionGeometry& solid) : solid_(solid) {}

    [[nodiscard]] int count() const {
        return solid_.kind == ShapeKind::hull ? static_cast<int>(solid_.hull->points().size()) : 8;
    }
    /// In its own frame.
    [[nodiscard]] vec3 operator[](int index) const {
        return solid_.kind == ShapeKind::hull ? solid_.hull->points()[index] : boxCorner(solid_.halfExtents, index);
    }
    [[nodiscard]] SurfaceDistance distanceTo(const vec3& point) const {
        return solid_.kind == ShapeKind::hull ? distanceToHull(point, *solid_.hull)
                                              : distanceToBox(point, solid_.halfExtents);
    }

    /// From a point to the nearest point of the surface, if `leads` says yes to the normal there; of a point inside, to
    /// the nearest side of which it does. Far away where there is none.
    template <class Leads>
    [[nodiscard]] SurfaceDistance wayOut(const vec3& point, Leads leads) const {
        SurfaceDistance nearest = distanceTo(point);
        if (leads(nearest.normal)) return nearest;
        SurfaceDistance way{std::numeric_limits<float>::max(), nearest.normal};
        if (nearest.distance >= 0.0F) return way;
        const auto take = [&](const vec3& normal, float distance) {
            const bool isNearer = way.distance > 0.0F || distance > way.distance;
            if (isNearer && leads(normal)) way = {distance, normal};
        };
        if (solid_.kind == ShapeKind::hull) {
            for (const ConvexHull::Face& face : solid_.hull->faces())
                take(face.normal, glm::dot(face.normal, point) - face.offset);
        } else {
            for (int axis = 0; axis < 3; ++axis) {
                for (const float sign : {-1.0F, 1.0F}) {
                    vec3 normal(0);
                    normal[axis] = sign;
                    take(normal, sign * point[axis] - solid_.halfExtents[axis]);
                }
            }
        }
        return way;
    }

  private:
    const CollisionGeometry& solid_;
};

}  // namespace lutka::physics
