#pragma once

#include <array>

#include "core/rigid_transform.hpp"

namespace lutka::physics {

/// A box where it is.
struct BoxPlace {
    vec3 halfExtents{0, 0, 0};
    vec3 position{0, 0, 0};
    mat3 axes{1};  ///< Columns: its axes.
};

/// The axis along which two boxes overlap least, or are apart: one of the faces' axes of each, or across an edge of
/// each.
struct BoxAxis {
    float distance = 0.0F;  ///< Metres; negative: the depth.
    vec3 normal{0, 1, 0};   ///< Unit, from B to A.
    int faceOfA = -1;       ///< The axis of A's face, else -1.
    int faceOfB = -1;       ///< The same of B.
    int edgeOfA = -1;       ///< The axes of the two edges, else -1.
    int edgeOfB = -1;
};

/// By the separating-axis test (Gottschalk, Lin and Manocha 1996). `edgesLast`: edges count only where they are clearly
/// shallower than all faces, which have more than one point to hold a box by.
[[nodiscard]] BoxAxis leastOverlap(const BoxPlace& a, const BoxPlace& b, bool edgesLast = false);

/// Points where two boxes that overlap or nearly do touch.
struct BoxManifold {
    struct Point {
        vec3 onA{0, 0, 0};  ///< On A's surface, in its axes.
        vec3 onB{0, 0, 0};
        float distance = 0.0F;  ///< Metres along the normal; negative: the depth.
        int feature = 0;        ///< In [0, kFeatures).
    };
    static constexpr int kFeatures = 96;

    vec3 normal{0, 1, 0};  ///< Unit, from B to A.
    std::array<Point, 8> points;
    int count = 0;
};

/// One normal for all points: that of the least overlap.
/// - Of a face: the corners of the other box's face, clipped by the sides of this one, that lie below it or less than
///   `reach` metres above it.
/// - Of two edges: where they are nearest, or both ends of what they share where they are nearly parallel. Where one
///   box's face lies across the other's edge, the edge on the other side of that face has its points, too.
///
/// Empty where the boxes are kSamePlace or more apart.
[[nodiscard]] BoxManifold touchBoxes(const BoxPlace& a, const BoxPlace& b, float reach);

}  // namespace lutka::physics
