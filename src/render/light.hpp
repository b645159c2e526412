#pragma once

#include "core/math.hpp"

namespace lutka::render {

/// The directional light, which casts the shadow.
struct SunLight {
    vec3 directionToLight{-0.50F, 0.90F, 0.55F};  ///< World, from the scene towards the light; any length above zero.
    vec3 color{1.0F, 0.965F, 0.91F};              ///< Linear.
    float intensity = 2.2F;  ///< Irradiance on a surface that faces it, in units where white at 1 and exposure 1 is
                             ///< paper white. More: brighter, harder contrast with the shadow.
    bool castsShadow = true;
    float angularRadius = 0.045F;  ///< Of the light as a disc in the sky, radians, [0, 0.2]. More: softer shadows, the
                                   ///< more so the further from what casts them.
};

/// A point or spot light without a shadow.
struct LocalLight {
    vec3 position{0, 2, 0};    ///< World, metres.
    vec3 direction{0, -1, 0};  ///< World, unit, where a spot light points.
    vec3 color{1, 1, 1};       ///< Linear.
    float intensity = 5.0F;    ///< Irradiance at one metre; falls with the square of the distance.
    float range = 10.0F;       ///< Metres; it fades to nothing there.
    float outerAngle = kPi;    ///< Half the spot's cone, radians; pi: a point light.
    float innerAngle = kPi;    ///< Where the spot begins to fade, <= outerAngle.
};

/// The sky that lights from all around and shows in reflections.
struct Sky {
    vec3 zenith{0.50F, 0.60F, 0.78F};   ///< Linear radiance straight up.
    vec3 horizon{0.86F, 0.88F, 0.90F};  ///< At the horizon.
    vec3 ground{0.34F, 0.32F, 0.30F};   ///< Straight down: what the floor throws back.
    float intensity = 0.75F;            ///< Multiplies all three, and an environment's light.
    bool environment = false;  ///< The renderer's environment (Renderer::setEnvironment) lights in their place.
    bool environmentBackground = false;  ///< And is seen behind everything.
};

}  // namespace lutka::render
