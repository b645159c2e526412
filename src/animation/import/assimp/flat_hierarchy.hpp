#pragma once

#include "animation/import/source_scene.hpp"

namespace lutka::animation::rig_import {

/// Gives the joints of a Half-Life 1 model their parents back. No effect on other files.
///
/// Assimp 5.2.5 hangs all joints below the node `<MDL_bones>`, in the file's order (parents first), with transforms
/// that are relative to parents which it drops. A skinned joint's bind matrix times the inverse of its own transform is
/// its parent's bind matrix, and so tells which joint the parent is. Where that doesn't work out for every skinned
/// joint the tree stays flat and `scene.nodesArePosed` becomes false.
void restoreFlatHierarchy(SourceScene& scene);

}  // namespace lutka::animation::rig_import
