#pragma once

#include "animation/import/assimp/collada_tags.hpp"
#include "animation/import/source_scene.hpp"

namespace lutka::animation::rig_import {

/// Blender writes as a skin's bind shape matrix how the mesh stands in its parent, where Collada asks how it stands in
/// the scene. So the skin of a mesh that hangs on an armature which is moved, turned or scaled lies away from its
/// joints. Adds what the parent says to the skins of a document that Blender wrote, but where they would lie farther
/// from their joints with it.
void completeBindShapes(const ColladaDocument& document, SourceScene& scene);

}  // namespace lutka::animation::rig_import
