#pragma once

#include "core/math.hpp"

namespace lutka::physics {

/// A point of the skin with the area it stands for, in the standard stance's axes (+Y up, facing +Z, left at +X;
/// the origin is the model's).
struct SkinPoint {
    vec3 position{0, 0, 0};
    float area = 0.0F;     ///< A third of the area of the triangles around the vertex, m².
    vec3 vertex{0, 0, 0};  ///< That it stands for: where it is itself, or nearby on a coarse mesh.
};

}  // namespace lutka::physics
