#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "physics/profile/profile.hpp"

namespace lutka::physics {

/// Joints whose strength is set together. A joint belongs to the group of the body that it moves, its child; bodies
/// without a role to the trunk.
enum class MuscleGroup { trunk, head, arm, leg };
inline constexpr int kMuscleGroupCount = 4;
[[nodiscard]] MuscleGroup muscleGroupOf(const BodyProfile& body);

/// How strongly the joints of a doll follow a pose. Nothing here has the dimension of a stiffness: a joint's spring is
/// that of the stated frequency with the masses that it moves, so the same numbers suit a mouse and a giant.
struct MuscleSettings {
    float frequencyHz = 10.0F;  ///< Of a joint's spring with all that it moves, Hz, >= 0; 0: limp.
    float dampingRatio = 1.0F;  ///< >= 0; 1 is critical: the quickest approach that does not overshoot.
    float strength = 1.0F;      ///< Factor on every stiffness and torque bound, >= 0.
    std::array<float, kMuscleGroupCount> groups{1, 1, 1, 1};  ///< Factors on `strength`, >= 0, by MuscleGroup.
    std::vector<float> bodies;                                ///< Likewise, one a body of the profile; empty: all 1.
    bool bounded = true;           ///< Torques have the bounds of muscles (kTorquePerKg); false: none.
    vec3 carriedGravity{0, 0, 0};  ///< m/s²: joints carry what hangs on them against it; 0: they sag.
};

/// The strength of the joint above a body: `strength` with the group's and the body's factors.
[[nodiscard]] float strengthOf(const MuscleSettings& muscles, const RagdollProfile& profile, int body);

/// Largest torque at strength 1 by MuscleGroup, N m per kg of the whole doll at a height of 1.75 m: about the isometric
/// maxima of trained adults (dynamometry: trunk extension 4, hip and knee extension 3, shoulder flexion 1, neck 0.5).
inline constexpr std::array<float, kMuscleGroupCount> kTorquePerKg{4.0F, 0.5F, 1.0F, 3.0F};

/// limp: no muscles at all. weak: 1.5 Hz, a doll that sags and gives way. powered: 10 Hz. stiff: 30 Hz, unbounded.
enum class MusclePreset { limp, weak, powered, stiff };
inline constexpr std::array<std::string_view, 4> kMusclePresetNames{"limp", "weak", "powered", "stiff"};
[[nodiscard]] MuscleSettings musclesOf(MusclePreset preset);

}  // namespace lutka::physics
