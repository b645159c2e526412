#pragma once

#include <array>
#include <optional>
#include <vector>

#include "physics/profile/muscle_profile.hpp"
#include "physics/profile/profile.hpp"

namespace lutka::physics {

[[nodiscard]] MuscleGroup muscleGroupOf(const BodyProfile& body);

/// The muscles of a doll, as they are used.
struct MuscleSettings : MuscleProfile {
    std::vector<MuscleFactors> bodies;  ///< Of the joint above each body, one a body of the profile; empty: all 1.
    vec3 carriedGravity{0, 0, 0};       ///< m/s²: joints carry what hangs on them against it; 0: they sag.
};

/// What several factors come to: their product, bounded as each of them is.
[[nodiscard]] float boundedProduct(float a, float b);
/// What the joint above a body has of the doll's muscles: the product of its group's factors and its own.
[[nodiscard]] MuscleFactors factorsOf(const MuscleSettings& muscles, const RagdollProfile& profile, int body);
/// The strength of the joint above a body: `strength` with the group's and the body's factors.
[[nodiscard]] float strengthOf(const MuscleSettings& muscles, const RagdollProfile& profile, int body);

/// Largest torque at strength 1 by MuscleGroup, N m per kg of the whole doll at a height of 1.75 m: about the isometric
/// maxima of trained adults (dynamometry: trunk extension 4, hip and knee extension 3, shoulder flexion 1, neck 0.5).
inline constexpr std::array<float, kMuscleGroupCount> kTorquePerKg{4.0F, 0.5F, 1.0F, 3.0F};

[[nodiscard]] MuscleSettings musclesOf(MusclePreset preset);
/// The profile's own muscles, in a world with that gravity (m/s²); unset where it has none.
[[nodiscard]] std::optional<MuscleSettings> musclesOf(const RagdollProfile& profile, const vec3& gravity);

}  // namespace lutka::physics
