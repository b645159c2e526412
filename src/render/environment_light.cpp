#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/assert.hpp"
#include "render/environment.hpp"

namespace lutka::render {
namespace {

using Level = EnvironmentLight::Level;

constexpr float kMeanLuminance = 0.65F;  // about that of the default sky, its intensity left out
constexpr float kBrightest = 30.0F;      // of the mean
constexpr int kSharpestWidth = 256;      // of the sharpest reflection
constexpr int kLevels = 6;               // the last one is 8 x 4
constexpr int kSamples = 64;             // of a blurred texel

float luminance(const vec3& color) {
    return glm::dot(color, vec3(0.2126F, 0.7152F, 0.0722F));
}

// The nine polynomials, without the basis' constants.
std::array<float, 9> polynomials(const vec3& n) {
    return {1.0F, n.y, n.z, n.x, n.x * n.y, n.y * n.z, 3.0F * n.z * n.z - 1.0F, n.x * n.z, n.x * n.x - n.y * n.y};
}

// Squares of the basis' constants times the cosine lobe's factor over pi (1, 2/3, 1/4 by order).
constexpr std::array<float, 9> kWeights = {0.0795775F,
                                           0.2387324F * 2 / 3,
                                           0.2387324F * 2 / 3,
                                           0.2387324F * 2 / 3,
                                           1.0925484F * 1.0925484F / 4,
                                           1.0925484F * 1.0925484F / 4,
                                           0.3153916F * 0.3153916F / 4,
                                           1.0925484F * 1.0925484F / 4,
                                           0.5462742F * 0.5462742F / 4};

// Scaled to its mean, bright spots held down.
Level scaled(const Environment& environment, float gain) {
    Level level{environment.width, environment.height, environment.radiance};
    for (vec3& light : level.radiance) {
        light *= gain;
        const float bright = luminance(light);
        if (bright > kBrightest * kMeanLuminance) light *= kBrightest * kMeanLuminance / bright;
    }
    return level;
}

// The mean over blocks, to a size that divides the picture's only roughly.
Level shrunk(const Level& from, int width, int height) {
    Level to{width, height, {}};
    to.radiance.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (int y = 0; y < height; ++y) {
        const int top = y * from.height / height;
        const int bottom = std::max((y + 1) * from.height / height, top + 1);
        for (int x = 0; x < width; ++x) {
            const int left = x * from.width / width;
            const int right = std::max((x + 1) * from.width / width, left + 1);
            vec3 sum(0);
            for (int row = top; row < bottom; ++row) {
                for (int column = left; column < right; ++column)
                    sum += from.radiance[static_cast<std::size_t>(row) * from.width + column];
            }
            to.radiance.push_back(sum / static_cast<float>((bottom - top) * (right - left)));
        }
    }
    return to;
}

vec3 sampled(const Level& level, const vec3& direction) {
    const vec2 uv = panoramaUv(direction);
    const int x = static_cast<int>(uv.x * static_cast<float>(level.width)) % level.width;
    const int y = std::min(static_cast<int>(uv.y * static_cast<float>(level.height)), level.height - 1);
    return level.radiance[static_cast<std::size_t>(y) * level.width + std::max(x, 0)];
}

// Reversed bits of i as a fraction: with i / n the points spread evenly (Hammersley).
float radicalInverse(unsigned i) {
    float value = 0.0F;
    float place = 0.5F;
    for (; i != 0; i >>= 1U, place *= 0.5F)
        value += static_cast<float>(i & 1U) * place;
    return value;
}

// Light mirrored towards a direction by a surface that faces it, with the GGX distribution (the split sum of Karis
// 2013); samples come from a small copy, so that few are enough.
vec3 blurred(const Level& source, const vec3& normal, float roughness) {
    const vec3 x = anyPerpendicular(normal);
    const vec3 y = glm::cross(normal, x);
    const float alpha = roughness * roughness;
    vec3 sum(0);
    float weights = 0.0F;
    for (unsigned i = 0; i < kSamples; ++i) {
        const float part = (static_cast<float>(i) + 0.5F) / kSamples;
        const float around = 2.0F * kPi * radicalInverse(i);
        const float cosine = std::sqrt((1.0F - part) / (1.0F + (alpha * alpha - 1.0F) * part));
        const float sine = std::sqrt(std::max(1.0F - cosine * cosine, 0.0F));
        const vec3 middle = sine * (std::cos(around) * x + std::sin(around) * y) + cosine * normal;
        const vec3 towards = 2.0F * cosine * middle - normal;
        const float weight = glm::dot(normal, towards);
        if (weight <= 0.0F) continue;
        sum += weight * sampled(source, towards);
        weights += weight;
    }
    return sum / std::max(weights, 1e-6F);
}

std::array<vec3, 9> diffuseOf(const Level& level) {
    std::array<vec3, 9> sum{};
    for (int row = 0; row < level.height; ++row) {
        const float v = (static_cast<float>(row) + 0.5F) / static_cast<float>(level.height);
        const float solidAngle =
            2.0F * kPi * kPi * std::sin(v * kPi) / (static_cast<float>(level.width) * static_cast<float>(level.height));
        for (int column = 0; column < level.width; ++column) {
            const float u = (static_cast<float>(column) + 0.5F) / static_cast<float>(level.width);
            const std::array<float, 9> basis = polynomials(panoramaDirection({u, v}));
            const vec3 light = level.radiance[static_cast<std::size_t>(row) * level.width + column] * solidAngle;
            for (std::size_t i = 0; i < sum.size(); ++i)
                sum[i] += light * (basis[i] * kWeights[i]);
        }
    }
    return sum;
}

}  // namespace

vec3 diffuseLight(const EnvironmentLight& light, const vec3& normal) {
    const std::array<float, 9> basis = polynomials(normal);
    vec3 sum(0);
    for (std::size_t i = 0; i < basis.size(); ++i)
        sum += light.diffuse[i] * basis[i];
    return glm::max(sum, vec3(0));
}

EnvironmentLight makeEnvironmentLight(const Environment& environment) {
    LUTKA_ASSERT(environment.width > 0 && environment.height > 0);
    EnvironmentLight light;
    light.gain = kMeanLuminance / std::max(luminance(meanRadiance(environment)), 1e-12F);
    const Level whole = scaled(environment, light.gain);
    light.reflections.push_back(shrunk(whole, kSharpestWidth, kSharpestWidth / 2));
    light.diffuse = diffuseOf(light.reflections[0]);
    // Each level's lobe is some texels of the source wide.
    for (int i = 1; i < kLevels; ++i) {
        const Level source = shrunk(light.reflections[0], kSharpestWidth >> i, (kSharpestWidth / 2) >> i);
        Level level = source;
        const float roughness = static_cast<float>(i) / (kLevels - 1);
        for (int y = 0; y < level.height; ++y) {
            for (int x = 0; x < level.width; ++x) {
                const vec2 uv((static_cast<float>(x) + 0.5F) / static_cast<float>(level.width),
                              (static_cast<float>(y) + 0.5F) / static_cast<float>(level.height));
                level.radiance[static_cast<std::size_t>(y) * level.width + x] =
                    blurred(source, panoramaDirection(uv), roughness);
            }
        }
        light.reflections.push_back(std::move(level));
    }
    return light;
}

}  // namespace lutka::render
