#pragma once

#include "render/camera.hpp"
#include "render/image.hpp"
#include "support/catch.hpp"

namespace lutka::test {

inline int brightness(render::Color color) {
    return color.r + color.g + color.b;
}

/// What a picture shows of a point of the world, which must be in sight.
inline render::Color pixelAt(const render::Image& image, const render::Camera& camera, const vec3& world) {
    const auto seen = render::project(camera, world, image.size());
    REQUIRE(seen.has_value());
    return image.at(static_cast<int>(seen->x), static_cast<int>(seen->y));
}

}  // namespace lutka::test
