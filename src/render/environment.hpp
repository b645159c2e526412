#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "core/math.hpp"
#include "core/result.hpp"

namespace lutka::render {

/// A panorama of light: linear radiance in every direction, an equirectangular picture with rows from straight up to
/// straight down. Its middle column shows what lies towards -Z, and to the right of it +X.
struct Environment {
    int width = 0;
    int height = 0;
    std::vector<vec3> radiance;  ///< width * height, linear, each component finite and >= 0.

    [[nodiscard]] const vec3& at(int x, int y) const {
        return radiance[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
    }
};

/// Where a unit direction lies in the panorama, [0, 1]² from its upper left corner, and back.
[[nodiscard]] vec2 panoramaUv(const vec3& direction);
[[nodiscard]] vec3 panoramaDirection(const vec2& uv);

/// Reads a Radiance picture (*.hdr: 32-bit_rle_rgbe, rows from the top), at most 8192 x 4096. Fails with
/// ErrorCode::input: no such file, another format, a damaged or cut-off one, one without any light.
[[nodiscard]] Result<Environment> loadHdr(const std::filesystem::path& file);

/// The mean radiance over all directions.
[[nodiscard]] vec3 meanRadiance(const Environment& environment);

/// What a renderer needs of a panorama: diffuse light as spherical harmonics, reflections blurred by roughness.
struct EnvironmentLight {
    /// One level of the reflections: a panorama of its own size.
    struct Level {
        int width = 0;
        int height = 0;
        std::vector<vec3> radiance;
    };
    /// Coefficients of irradiance / pi over the nine real spherical harmonics up to the second order, in the order 1,
    /// y, z, x, xy, yz, 3z²-1, xz, x²-y² with the basis' constants multiplied in (Ramamoorthi and Hanrahan 2001):
    /// evaluate with the plain polynomials.
    std::array<vec3, 9> diffuse{};
    /// Level i of n is for roughness i / (n - 1), each half as large as the one before.
    std::vector<Level> reflections;
    float gain = 1.0F;  ///< What the panorama was multiplied by.
};

/// Diffuse light at a unit normal: irradiance / pi.
[[nodiscard]] vec3 diffuseLight(const EnvironmentLight& light, const vec3& normal);

/// The panorama is first scaled so that its mean is as bright as the default sky, and single spots are held to 30 times
/// the mean: the sun is a light of its own. Takes some tens of milliseconds.
[[nodiscard]] EnvironmentLight makeEnvironmentLight(const Environment& environment);

}  // namespace lutka::render
