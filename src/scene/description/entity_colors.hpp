#pragma once

#include "render/color.hpp"

namespace lutka::scene {

/// What scenes are painted in unless they say otherwise.
inline constexpr render::Color kStandingColor{172, 177, 184, 255};
inline constexpr render::Color kFloorColor{158, 160, 164, 255};
inline constexpr render::Color kMovingColor{206, 120, 70, 255};

}  // namespace lutka::scene
