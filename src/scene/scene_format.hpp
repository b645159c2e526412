#pragma once

#include <array>

namespace lutka::scene::scene_format {

inline constexpr const char* kName = "lutka.scene";
inline constexpr const char* kSchema = "scene.schema.json";
inline constexpr const char* kExtension = ".scene.json";
inline constexpr int kMostEntities = 20000;

// In the order of the enums.
inline constexpr std::array kColliderKinds = {"plane", "box", "sphere", "capsule", "ramp", "stairs"};
inline constexpr std::array kLightKinds = {"sun", "point", "spot"};
inline constexpr std::array kPoses = {"bind", "node"};
inline constexpr std::array kSolvers = {"stock", "bullet", "crowd"};

}  // namespace lutka::scene::scene_format
