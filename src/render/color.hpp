#pragma once

#include <cstdint>

#include "core/math.hpp"

namespace lutka::render {

/// A colour as people pick it: sRGB, 8 bits a channel, alpha not premultiplied.
struct Color {
    std::uint8_t r = 255;
    std::uint8_t g = 255;
    std::uint8_t b = 255;
    std::uint8_t a = 255;

    friend bool operator==(const Color&, const Color&) = default;
};

/// The same colour with another alpha, in [0, 1].
[[nodiscard]] Color withAlpha(Color color, float alpha);

/// Linear light (rgb) and straight alpha of an sRGB colour, each in [0, 1] (IEC 61966-2-1).
[[nodiscard]] vec4 toLinear(Color color);

/// The nearest sRGB colour of linear light; components are clamped to [0, 1].
[[nodiscard]] Color fromLinear(const vec4& linear);

/// What debug draw uses: x, y, z axes are red, green, blue, as everywhere in the field.
namespace colors {
inline constexpr Color white{255, 255, 255, 255};
inline constexpr Color red{235, 72, 66, 255};
inline constexpr Color green{96, 196, 84, 255};
inline constexpr Color blue{66, 132, 245, 255};
inline constexpr Color yellow{250, 204, 62, 255};
inline constexpr Color orange{247, 147, 40, 255};
inline constexpr Color cyan{64, 204, 222, 255};
inline constexpr Color magenta{214, 92, 214, 255};
inline constexpr Color grey{150, 154, 160, 255};
}  // namespace colors

}  // namespace lutka::render
