#pragma once

#include <cstdint>

#include "animation/character.hpp"

namespace lutka::test {

/// Every joint named joint_N, without the file's own humanoid block.
[[nodiscard]] animation::Character withoutNames(animation::Character character);

/// Turned as a whole: bind poses and meshes.
[[nodiscard]] animation::Character rotated(animation::Character character, const quat& rotation);

/// Scaled as a whole about the origin.
[[nodiscard]] animation::Character scaled(animation::Character character, float factor);

/// The mirror image in the plane x = 0: what was left is right, names are kept.
[[nodiscard]] animation::Character mirrorImage(animation::Character character);

/// Every joint (and the skin that it moves most) shifted by up to `distance` in each axis.
[[nodiscard]] animation::Character jittered(animation::Character character, float distance, std::uint64_t seed);

/// The same figure with its joints in another order, parents still before children; `order[new] = old`.
[[nodiscard]] animation::Character shuffled(const animation::Character& character, std::uint64_t seed,
                                            std::vector<int>& order);

}  // namespace lutka::test
