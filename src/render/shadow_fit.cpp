#include "render/shadow_fit.hpp"

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/geometric.hpp>

namespace lutka::render {
namespace {

constexpr float kStep = 1.25F;          // of the radius
constexpr float kMostDistances = 1.5F;  // radius at most so many times the camera's distance
constexpr float kLeast = 0.05F;         // metres

}  // namespace

ShadowFit fitShadow(const BoundingSphere& casters, const vec3& directionToLight, const Camera& camera, int mapSize) {
    BoundingSphere seen = casters.empty() ? BoundingSphere{camera.target, 1.0F} : casters;
    const float most = kMostDistances * camera.distance;
    if (seen.radius > most) seen = {camera.target, most};
    const float steps = std::ceil(std::log(std::max(seen.radius, kLeast)) / std::log(kStep));
    const float radius = std::pow(kStep, steps);

    const vec3 z = glm::normalize(directionToLight);
    const vec3 x = anyPerpendicular(z);
    const vec3 y = glm::cross(z, x);
    // A rim of texels stays free for the filter.
    const float half = radius * (1.0F + 8.0F / static_cast<float>(mapSize)) + 0.02F;
    const float texel = 2.0F * half / static_cast<float>(mapSize);
    const auto snapped = [&](float value) { return std::floor(value / texel) * texel; };
    const vec3 center(snapped(glm::dot(x, seen.center)), snapped(glm::dot(y, seen.center)), glm::dot(z, seen.center));

    mat4 viewFromWorld(1.0F);
    for (int column = 0; column < 3; ++column)
        viewFromWorld[column] = vec4(x[column], y[column], z[column], 0.0F);
    viewFromWorld[3] = vec4(-center, 1.0F);
    // From the nearest caster to well behind the farthest one: what they fall on.
    const float reach =
        std::max(casters.empty() ? radius : casters.radius + glm::length(casters.center - seen.center), radius);
    return {glm::ortho(-half, half, -half, half, -reach, 4.0F * reach) * viewFromWorld, 5.0F * reach, texel};
}

}  // namespace lutka::render
