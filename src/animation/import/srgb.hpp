#pragma once

#include <algorithm>
#include <cmath>

#include "core/math.hpp"

namespace lutka::animation::rig_import {

/// Linear light of an sRGB value (IEC 61966-2-1), which is clamped to [0, 1].
[[nodiscard]] inline float linearFromSrgb(float value) {
    const float c = std::clamp(value, 0.0F, 1.0F);
    return c <= 0.04045F ? c / 12.92F : std::pow((c + 0.055F) / 1.055F, 2.4F);
}

/// Likewise of a colour, alpha as it is.
[[nodiscard]] inline vec4 linearFromSrgb(const vec4& color) {
    return {linearFromSrgb(color.r), linearFromSrgb(color.g), linearFromSrgb(color.b), color.a};
}

}  // namespace lutka::animation::rig_import
