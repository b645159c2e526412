#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/math.hpp"

namespace lutka::animation::rig_import::fbx {

/// Triangles of a polygon, which may be concave and not quite flat: places in `corners`, three a triangle, in the
/// polygon's sense of rotation. A quad is cut along the diagonal that keeps both halves upright, the shorter one where
/// both do; others lose their ears one by one (Meisters 1975) in the plane of Newell's normal. What has no proper ears,
/// or more than 512 corners, becomes a fan.
void triangulate(std::span<const vec3> corners, std::vector<std::uint32_t>& triangles);

}  // namespace lutka::animation::rig_import::fbx
