#pragma once

#include <cstdint>
#include <string>

#include "animation/playback/clip_library.hpp"

namespace lutka::test {

/// A clip of the skeleton whose every joint turns by waves that are drawn by lot and join at the ends, 31 frames at 30
/// a second; the hips' joint goes by `stride` from its first frame to its last.
[[nodiscard]] animation::Clip makeWavingClip(const animation::Skeleton& skeleton, const std::string& name,
                                             std::uint64_t seed, const vec3& stride = {0, 0, 0});

/// A clip of one turn of `joint` by `angle` about z, held for `seconds`.
[[nodiscard]] animation::Clip makeTurnedClip(const animation::Skeleton& skeleton, const std::string& name, int joint,
                                             float angle, float seconds = 1.0F);

/// Largest difference between two poses: metres and parts of quaternions alike.
[[nodiscard]] float differenceOf(std::span<const RigidTransform> a, std::span<const RigidTransform> b);

}  // namespace lutka::test
