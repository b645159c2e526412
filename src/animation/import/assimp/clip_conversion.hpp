#pragma once

#include "animation/import/assimp/scene_nodes.hpp"

namespace lutka::animation::rig_import {

/// Adds all animations. Channels name their nodes: nodes that share a name take the channels of that name in turn,
/// joints of a skin first.
void addClips(const aiScene& scene, const SceneNodes& nodes, SourceScene& out);

}  // namespace lutka::animation::rig_import
