#pragma once

#include <array>
#include <vector>

#include "animation/skeleton.hpp"

namespace lutka::animation {

enum class Finger { thumb, index, middle, ring, little };
inline constexpr int kFingerCount = 5;

/// The joints of each finger from the palm to the tip, at most three: bones of the palm and tips without a bone of
/// their own are left out. Empty where the names tell of no such finger.
using FingerChains = std::array<std::vector<int>, kFingerCount>;

/// The fingers below a hand, by name.
[[nodiscard]] FingerChains fingersOf(const Skeleton& skeleton, int hand);

}  // namespace lutka::animation
