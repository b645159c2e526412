#pragma once

#include <vector>

#include "scene/asset/ragdoll_asset.hpp"

namespace lutka::scene {

/// By body, where the skin that it carries reaches beyond its shape by more than 3 % of the figure's height: a cape, a
/// wing, a scythe. The outermost points in 26 directions, in the body's frame, metres; each vertex is taken to follow
/// the body that its strongest joint hangs on. Empty for bodies that their shape stands for.
[[nodiscard]] std::vector<std::vector<vec3>> skinReach(const RagdollAsset& asset);

}  // namespace lutka::scene
