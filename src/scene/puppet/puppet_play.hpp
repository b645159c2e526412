#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "physics/powered/puppet.hpp"
#include "scene/asset/ragdoll_asset.hpp"
#include "scene/description/scenario.hpp"

namespace lutka::scene {

/// How the dolls of a scene follow a clip with their muscles.
struct PuppetPlay {
    ClipStart start;  ///< The clip, looped from there; without a name the start pose is held, or, with getUp, `idle`.
    physics::PuppetSettings puppet;
    std::vector<PuppetHit> hits;
    bool getUp = false;  ///< Limp dolls that have come to rest get up and go on with the clip.
    bool limp = false;   ///< They begin limp.
    float pace = 0.0F;   ///< m/s ahead, for clips that walk in place.
    /// The muscles are each profile's own where it has some; `puppet.muscles.strength` is a factor on them.
    bool ownMuscles = false;
    bool carriesGravity = false;  ///< Joints carry what hangs on them, whatever the profile says.
    /// N, of the hips' pin; unset: the profile's, else `puppet.pinForceN`.
    std::optional<float> pinForceN;
    std::vector<LedPart> led;    ///< Bodies that follow the clip themselves; the others by their muscles.
    vec3 gravity{0, -9.81F, 0};  ///< Of the world: what muscles that carry it work against.
    bool meetsGround = true;     ///< On ground that is not level the clip's feet are fitted to it (TerrainWalk).
    bool borrows = false;        ///< Clips that a character lacks are the mannequin's, retargeted; with getUp always.
    /// Whether the clip was asked for of this character: then one of its own that is only called alike goes before the
    /// mannequin's. A scene names a clip for whatever character comes.
    bool clipOfUser = false;
};

/// Fails with ErrorCode::usage where a hit or a led part names a body that no doll has.
[[nodiscard]] Result<void> checkBodies(std::span<const RagdollAsset* const> assets, const PuppetPlay& play);

/// The body that a blow to a part meets; rigs divide the trunk into one to three, so that a part of it that has no body
/// of its own is in the next one below. -1: none.
[[nodiscard]] int bodyMet(const physics::RagdollProfile& profile, std::string_view name);
/// Marks the kinematic bodies, which follow the clip whatever it asks for.
[[nodiscard]] std::vector<bool> keptBodies(const physics::RagdollProfile& profile, std::span<const LedPart> led);
/// What a doll's puppet is made with: what the play asks for, and the profile where it asks for nothing. `root` is the
/// body that its pin holds.
[[nodiscard]] physics::PuppetSettings settingsOf(const PuppetPlay& play, const physics::RagdollProfile& profile,
                                                 int root);

}  // namespace lutka::scene
