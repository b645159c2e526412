#pragma once

#include <optional>
#include <span>

#include "editor/document/document_state.hpp"
#include "editor/view/selection.hpp"
#include "render/camera.hpp"
#include "scene/run/simulation.hpp"

namespace lutka::editor {

/// A box that a ray may meet: of a shape, or of a marker.
struct PickTarget {
    int entity = 0;  ///< What Item::index becomes.
    RigidTransform worldFromBox;
    vec3 halfExtents{0, 0, 0};
    bool marker = false;  ///< Drawn over everything, and so picked before it.
};

/// What a ray through the picture meets first.
struct Pick {
    Item item;
    vec3 position{0, 0, 0};  ///< World, on the surface.
    vec3 normal{0, 1, 0};
    /// The body that the ray met, which a drag pulls; `item` may be the whole character that it belongs to.
    std::optional<Item> body;
};

/// Distance along the ray to where it enters the box around the frame's origin; 0 when it starts inside, nothing when
/// it misses. The slab test in the box's own frame (Kay and Kajiya 1986). `ray.direction` may have any length > 0; the
/// distance is in its units.
[[nodiscard]] std::optional<float> rayBox(const render::Ray& ray, const RigidTransform& worldFromBox,
                                          const vec3& halfExtents);

/// The nearest thing under the ray: bodies by the world's ray test, objects by the slab test. Markers (lights,
/// cameras) are in the layer before everything solid, since they are drawn over it: layers go before distance. What has
/// no target hides what is behind it, unless the ray goes `throughGeometry` (see-through walls).
[[nodiscard]] std::optional<Pick> pick(const render::Ray& ray, const scene::Simulation& simulation,
                                       std::span<const PickTarget> targets, bool throughGeometry = false);

/// What else pick() finds on its way.
struct PickedRay {
    std::optional<Pick> pick;
    float distance =
        0.0F;             ///< To what hides the rest of the ray, picked or not, in units of its direction; 100 at most.
    bool marker = false;  ///< The pick is drawn over everything.
};
[[nodiscard]] PickedRay pickAlong(const render::Ray& ray, const scene::Simulation& simulation,
                                  std::span<const PickTarget> targets, bool throughGeometry = false);

/// Where the ray meets the horizontal plane at `height`, or the nearest solid surface before it; nothing when the ray
/// points away from both, or the place is beyond 100 m.
[[nodiscard]] std::optional<vec3> surfaceUnder(const render::Ray& ray, const physics::WorldView& world, float height);

}  // namespace lutka::editor
