#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "animation/import/fbx/objects.hpp"

namespace lutka::animation::rig_import::fbx {

/// Moves a geometry's control points by its blend shapes at the weights that the file states, in-between shapes among
/// them. FBX 6 and 7.1 keep the shapes in the geometry (the model's record in FBX 6), later ones as objects.
void addBlendShapes(const Objects& objects, int geometry, std::vector<glm::dvec3>& points);

/// Whether the document moves blend shapes, which readMotions() leaves out.
[[nodiscard]] bool movesBlendShapes(const Document& document, const Objects& objects);

}  // namespace lutka::animation::rig_import::fbx
