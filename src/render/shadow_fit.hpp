#pragma once

#include "render/bounds.hpp"
#include "render/camera.hpp"

namespace lutka::render {

/// The shadow's view of the scene.
struct ShadowFit {
    mat4 lightFromWorld{1};        ///< To the shadow map's clip space, [-1, 1]³.
    float depthMetres = 1.0F;      ///< From its near to its far plane.
    float metresPerTexel = 0.01F;  ///< On a plane that faces the light.
};

/// Fits a square parallel projection along the light around the casters, or, where they reach further than the camera
/// cares, around what it looks at. The edge length moves in fixed steps and the centre by whole texels, so that the
/// edges of shadows neither swim nor flicker when casters move. `mapSize`: texels a side.
[[nodiscard]] ShadowFit fitShadow(const BoundingSphere& casters, const vec3& directionToLight, const Camera& camera,
                                  int mapSize);

}  // namespace lutka::render
