#pragma once

#include <span>
#include <vector>

#include "animation/character.hpp"
#include "animation/skinning.hpp"
#include "render/frame.hpp"

namespace lutka::render {

struct BoundingSphere {
    vec3 center{0, 0, 0};
    float radius = -1.0F;  ///< Metres; negative: holds nothing.

    [[nodiscard]] bool empty() const { return radius < 0.0F; }
};

/// The smallest sphere that holds both (within rounding).
[[nodiscard]] BoundingSphere enclosing(const BoundingSphere& a, const BoundingSphere& b);

/// For every joint a sphere in the bind pose around the vertices that it moves; empty for joints that move none.
[[nodiscard]] std::vector<BoundingSphere> jointBounds(const animation::Character& character);

/// A sphere in world space around a posed character. A skinned vertex lies between the positions that its joints give
/// it, so the joints' moved spheres hold it; nothing is skinned for this. `joints` from jointBounds(), one a matrix.
[[nodiscard]] BoundingSphere posedBounds(std::span<const BoundingSphere> joints,
                                         std::span<const animation::SkinMatrix> palette,
                                         const RigidTransform& worldFromModel);

/// A sphere in world space around a prop.
[[nodiscard]] BoundingSphere boundsOf(const PropItem& prop);

/// Whether a sphere may be seen: false when it lies wholly outside one of the planes of the clip volume.
[[nodiscard]] bool mayBeSeen(const BoundingSphere& sphere, const mat4& clipFromWorld);

}  // namespace lutka::render
