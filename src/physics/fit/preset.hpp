#pragma once

#include <span>
#include <string_view>

#include "physics/profile/profile.hpp"

namespace lutka::physics {

/// A character of the whole ragdoll: how far its joints go, how hard they are to move, where its mass lies.
enum class RagdollPreset {
    anatomical,  ///< Ranges of physiotherapy, little friction: an unconscious body.
    loose,       ///< Wider limits, hardly any friction: a rag doll that flops.
    stiff,       ///< Narrower limits, eight times the friction: an athlete who braces.
    toy,         ///< Narrow limits, joints that hold a pose against gravity, mass by volume: an action figure.
};

struct PresetInfo {
    RagdollPreset preset = RagdollPreset::anatomical;
    std::string_view name;  ///< On the command line.
    std::string_view summary;
    float limitScale = 1.0F;     ///< Of every span, about its middle.
    float frictionScale = 1.0F;  ///< Of every joint's friction.
    bool massByVolume = false;   ///< Unless another split than the anatomical one was asked for.
};
/// All presets, in the order of the enumeration.
[[nodiscard]] std::span<const PresetInfo> presetInfos();
[[nodiscard]] const PresetInfo& infoOf(RagdollPreset preset);

/// Scales limits and friction of a fitted profile. No limit goes beyond 175 degrees either way, and one that the bind
/// pose would break is widened to hold it, with a sentence in the notes. `bindFromBody`: the bodies in the bind pose,
/// in any common space. Masses are the fit's affair (massByVolume).
void applyPreset(RagdollProfile& profile, RagdollPreset preset, std::span<const RigidTransform> bindFromBody);

}  // namespace lutka::physics
