#pragma once

#include <string>
#include <vector>

#include "animation/clip.hpp"
#include "scene/asset/ragdoll_asset.hpp"
#include "scene/puppet/floor_keeper.hpp"

namespace lutka::scene {

/// A clip that a doll can follow, and how far that is from what it was.
struct ReachableClip {
    animation::Clip clip;
    float mostDeg = 0.0F;  ///< That a joint between two bodies was turned by in any frame.
    std::string joint;     ///< The body below it.
};

/// The clip with the doll's joints within their limits and its limbs out of its trunk and of each other, frame by frame
/// (physics::ReachablePose). What has no body keeps its turns under its parent; joints keep the lengths of the bind
/// pose. `keeps`: one a body, which of them stay as they are turned; empty: none. With a `floor` nothing is in the
/// level ground that the character stands on: feet and hands that would be are lifted out of it, what else is lifts the
/// whole figure.
[[nodiscard]] ReachableClip reachableClip(const RagdollAsset& asset, const animation::Clip& clip,
                                          std::vector<bool> keeps = {}, const FloorKeeper* floor = nullptr);

}  // namespace lutka::scene
