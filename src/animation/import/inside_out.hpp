#pragma once

#include <string>
#include <vector>

#include "animation/character.hpp"

namespace lutka::animation::rig_import {

/// Turns a figure that is inside out: whose triangles and normals point inwards, so that the volume inside its meshes,
/// signed by the divergence theorem (sum of a · (b × c) / 6), is negative. All meshes are looked at together, as a
/// mouth or an eye socket rightly faces inwards. Open meshes of little volume are left alone, and sheets that face each
/// other. Adds a warning when it turns any.
void turnOutwards(std::vector<SkinnedMesh>& meshes, std::vector<std::string>& warnings);

}  // namespace lutka::animation::rig_import
