#pragma once

#include <array>

#include "core/rigid_transform.hpp"
#include "physics/profile/convex_hull.hpp"

namespace lutka::physics {

/// A box or a convex hull where it is.
struct SolidPlace {
    const ConvexHull* hull = nullptr;  ///< Null: a box of these half extents.
    vec3 halfExtents{0, 0, 0};
    vec3 position{0, 0, 0};
    mat3 axes{1};  ///< Columns: its axes.
};

/// Points where two solids, of which one at least is a hull, overlap or nearly do. (Two boxes: touchBoxes().)
struct SolidManifold {
    static constexpr int kMost = 8;
    static constexpr int kFeatures = 256;
    struct Point {
        vec3 onA{0, 0, 0};  ///< On A's surface, in its axes.
        vec3 onB{0, 0, 0};
        float distance = 0.0F;  ///< Metres along the normal; negative: the depth.
        int feature = 0;        ///< In [0, kFeatures).
    };

    vec3 normal{0, 1, 0};  ///< Unit, from B to A.
    std::array<Point, kMost> points;
    int count = 0;
};

/// One normal for all points: that of the least overlap by the separating-axis test, its pairs of edges culled by their
/// Gauss maps (Gregorius, The Separating Axis Test between Convex Polyhedra, 2013); where the solids are apart and
/// nearest between edges, along that distance. On a flat side they are the other's corners over it and where its
/// outline crosses the side's, nearer than `range` metres; of two edges where they are nearest. At most `most` points,
/// in [1, kMost]: the deepest, and the rest far from one another.
[[nodiscard]] SolidManifold touchSolids(const SolidPlace& a, const SolidPlace& b, float range, int most);

/// Signed distance along the axis of least overlap, metres: the depth, or a lower bound of the gap.
[[nodiscard]] float distanceBetweenSolids(const SolidPlace& a, const SolidPlace& b);

}  // namespace lutka::physics
