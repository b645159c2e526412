#pragma once

#include <array>

#include "scene/description/entity_scene.hpp"

namespace lutka::scene::scene_format {

inline constexpr const char* kName = "lutka.scene";
inline constexpr const char* kSchema = "scene.schema.json";
inline constexpr const char* kExtension = ".scene.json";
inline constexpr int kMostFigures = 10000;
inline constexpr int kMostHits = 1000;  // of a character

/// A word of the format and what it stands for.
template <class Enum>
struct Named {
    const char* name;
    Enum value;
};

inline constexpr std::array<Named<Collider::Kind>, 6> kColliderKinds{{
    {"plane", Collider::Kind::plane},
    {"box", Collider::Kind::box},
    {"sphere", Collider::Kind::sphere},
    {"capsule", Collider::Kind::capsule},
    {"ramp", Collider::Kind::ramp},
    {"stairs", Collider::Kind::stairs},
}};
inline constexpr std::array<Named<Light::Kind>, 3> kLightKinds{{
    {"sun", Light::Kind::sun},
    {"point", Light::Kind::point},
    {"spot", Light::Kind::spot},
}};
inline constexpr std::array<Named<StartPose>, 2> kPoses{{{"bind", StartPose::bind}, {"node", StartPose::node}}};
inline constexpr std::array<Named<physics::MusclePreset>, 4> kMuscles{{
    {"limp", physics::MusclePreset::limp},
    {"weak", physics::MusclePreset::weak},
    {"powered", physics::MusclePreset::powered},
    {"stiff", physics::MusclePreset::stiff},
}};
inline constexpr std::array<Named<physics::RigKind>, 2> kRigs{
    {{"humanoid", physics::RigKind::humanoid}, {"any", physics::RigKind::any}}};
// Solvers: physics::kSolvers.

}  // namespace lutka::scene::scene_format
