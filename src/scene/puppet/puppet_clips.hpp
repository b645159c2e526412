#pragma once

#include <memory>
#include <span>
#include <string>

#include "animation/playback/clip_player.hpp"
#include "core/result.hpp"
#include "scene/asset/ragdoll_asset.hpp"
#include "scene/puppet/floor_keeper.hpp"
#include "scene/puppet/get_up_clips.hpp"
#include "scene/puppet/puppet_play.hpp"

namespace lutka::scene {

/// What the dolls of one character play, and what keeps it off the floor. Parts stay where they are when this is moved.
struct PuppetClips {
    std::unique_ptr<animation::ClipLibrary> library;  ///< Of the one clip; null where a start pose is held.
    float startSeconds = 0.0F;                        ///< Where that begins.
    std::unique_ptr<GetUpClips> getUp;                ///< With PuppetPlay::getUp.
    std::unique_ptr<FloorKeeper> floor;
    float reachDeg = 0.0F;   ///< Most that a joint of the clip was turned by, so that the doll can follow it.
    std::string reachJoint;  ///< The body below it.
};

/// The mannequin, whose clips are borrowed, where the play borrows and a character lacks one; else null. Fails where it
/// can't be read.
[[nodiscard]] Result<std::unique_ptr<RagdollAsset>> donorFor(std::span<const RagdollAsset* const> assets,
                                                             const PuppetPlay& play);

/// Fails with ErrorCode::usage when neither the character nor the donor (may be null) has the clip. The asset must
/// outlive what is found.
[[nodiscard]] Result<PuppetClips> findPuppetClips(const RagdollAsset& asset, const RagdollAsset* donor,
                                                  const PuppetPlay& play);

}  // namespace lutka::scene
