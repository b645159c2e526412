#pragma once

#include <array>
#include <string_view>

namespace lutka::physics {

/// Joints whose strength is set together. A joint belongs to the group of the body that it moves, its child; bodies
/// without a role to the trunk.
enum class MuscleGroup { trunk, head, arm, leg };
inline constexpr int kMuscleGroupCount = 4;
inline constexpr std::array<std::string_view, kMuscleGroupCount> kMuscleGroupNames{"trunk", "head", "arm", "leg"};

/// What the joints of a group, or the joint above one body, have of the whole doll's muscles. Factors of group and body
/// multiply.
struct MuscleFactors {
    static constexpr float kMost = 1e6F;
    float strength = 1.0F;  ///< On stiffness and torque bound, [0, kMost].
    float damping = 1.0F;   ///< On the damping ratio, [0, kMost].
    float torque = 1.0F;    ///< On the torque bound alone, [0, kMost].

    friend bool operator==(const MuscleFactors&, const MuscleFactors&) = default;
};

/// How strongly the joints of a doll follow a pose. Nothing here has the dimension of a stiffness: a joint's spring is
/// that of the stated frequency with the masses that it moves, so the same numbers suit a mouse and a giant.
struct MuscleProfile {
    static constexpr float kMostHz = 1000.0F;
    float frequencyHz = 10.0F;    ///< Of a joint's spring with all that it moves, Hz, [0, kMostHz]; 0: limp.
    float dampingRatio = 1.0F;    ///< 1 is critical: the quickest approach that does not overshoot; [0, kMost].
    float strength = 1.0F;        ///< Factor on every stiffness and torque bound, [0, kMost].
    float torque = 1.0F;          ///< Factor on every torque bound, [0, kMost].
    bool bounded = true;          ///< Torques have the bounds of muscles (kTorquePerKg); false: none.
    bool carriesGravity = false;  ///< Joints carry what hangs on them; false: they sag.
    std::array<MuscleFactors, kMuscleGroupCount> groups{};  ///< By MuscleGroup.

    friend bool operator==(const MuscleProfile&, const MuscleProfile&) = default;
};

/// limp: no muscles at all. weak: 1.5 Hz, a doll that sags and gives way. powered: 10 Hz. stiff: 30 Hz, unbounded.
enum class MusclePreset { limp, weak, powered, stiff };
inline constexpr std::array<std::string_view, 4> kMusclePresetNames{"limp", "weak", "powered", "stiff"};
[[nodiscard]] MuscleProfile muscleProfileOf(MusclePreset preset);

}  // namespace lutka::physics
