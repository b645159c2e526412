#pragma once

#include <span>

#include "animation/character.hpp"
#include "core/aabb.hpp"

namespace lutka::animation::rig_import {

/// The box around the vertices of all meshes, in their space and unit; empty where there are none.
[[nodiscard]] inline AabbOf<glm::dvec3> vertexBounds(std::span<const SkinnedMesh> meshes) {
    AabbOf<glm::dvec3> bounds;
    for (const SkinnedMesh& mesh : meshes) {
        for (const vec3& position : mesh.positions)
            bounds.add(glm::dvec3(position));
    }
    return bounds;
}

}  // namespace lutka::animation::rig_import
