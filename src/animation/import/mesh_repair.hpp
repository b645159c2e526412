#pragma once

#include <string>
#include <vector>

#include "animation/character.hpp"

namespace lutka::animation::rig_import {

/// What had to be done to the geometry, over all meshes.
struct MeshRepairs {
    int turnedMeshes = 0;  ///< Meshes whose triangles ran against their normals.

    /// A sentence for each kind of repair that occurred.
    [[nodiscard]] std::vector<std::string> sentences() const;
};

/// Merges vertices that are equal in every attribute (the first one
/// stays, the order of triangles too), turns triangles that run against the normals, and makes missing normals and
/// tangents.
void repairMesh(SkinnedMesh& mesh, MeshRepairs& repairs);

}  // namespace lutka::animation::rig_import
