#pragma once

#include <assimp/matrix4x4.h>
#include <assimp/vector3.h>

#include "animation/import/affine.hpp"

namespace lutka::animation::rig_import {

[[nodiscard]] inline dmat4 fromAssimp(const aiMatrix4x4& m) {
    return {dvec4(m.a1, m.b1, m.c1, m.d1), dvec4(m.a2, m.b2, m.c2, m.d2), dvec4(m.a3, m.b3, m.c3, m.d3),
            dvec4(m.a4, m.b4, m.c4, m.d4)};
}

[[nodiscard]] inline dvec3 fromAssimp(const aiVector3D& v) {
    return {v.x, v.y, v.z};
}

}  // namespace lutka::animation::rig_import
