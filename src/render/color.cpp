#include "render/color.hpp"

#include <algorithm>
#include <cmath>

namespace lutka::render {
namespace {

std::uint8_t toByte(float value) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0F, 1.0F) * 255.0F));
}

float decode(std::uint8_t channel) {
    const float s = static_cast<float>(channel) / 255.0F;
    return s <= 0.04045F ? s / 12.92F : std::pow((s + 0.055F) / 1.055F, 2.4F);
}

float encode(float linear) {
    const float l = std::clamp(linear, 0.0F, 1.0F);
    return l <= 0.0031308F ? l * 12.92F : 1.055F * std::pow(l, 1.0F / 2.4F) - 0.055F;
}

}  // namespace

Color withAlpha(Color color, float alpha) {
    color.a = toByte(alpha);
    return color;
}

vec4 toLinear(Color color) {
    return {decode(color.r), decode(color.g), decode(color.b), static_cast<float>(color.a) / 255.0F};
}

Color fromLinear(const vec4& linear) {
    return {toByte(encode(linear.r)), toByte(encode(linear.g)), toByte(encode(linear.b)), toByte(linear.a)};
}

}  // namespace lutka::render
