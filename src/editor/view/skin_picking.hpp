#pragma once

#include <optional>

#include "render/camera.hpp"
#include "scene/run/simulation.hpp"

namespace lutka::editor {

/// Where a ray meets a doll's skin, and the body that carries it there.
struct SkinHit {
    int doll = 0;
    int body = 0;  ///< Of the doll's profile.
    vec3 position{0, 0, 0};
    vec3 normal{0, 1, 0};   ///< Of the triangle, against the ray.
    float distance = 0.0F;  ///< Along the ray, in the units of its direction.
};

/// The nearest triangle of all skins that the scene shows, as they are `alpha` of the way to the present step, from
/// either side, nearer than `most`. Fingers, hair and hats have no body of their own: theirs is the one that their
/// joint follows. Poses and skins the dolls that the ray comes near, so it is for clicks and not for every frame.
[[nodiscard]] std::optional<SkinHit> pickSkin(const render::Ray& ray, scene::Simulation& simulation, float alpha,
                                              float most);

}  // namespace lutka::editor
