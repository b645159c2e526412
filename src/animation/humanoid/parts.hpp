#pragma once

#include <array>

#include "animation/humanoid/roles.hpp"

namespace lutka::animation {

/// A role without its side and, for the trunk, without its number: what a name or a place in a chain can speak of.
enum class Part { hips, trunk, chest, neck, head, clavicle, upperArm, lowerArm, hand, upperLeg, lowerLeg, foot, toes };
inline constexpr int kPartCount = 13;

[[nodiscard]] constexpr int indexOf(Part part) {
    return static_cast<int>(part);
}

/// The part that a role is, without its side and number.
[[nodiscard]] Part partOf(Role role);

/// A number a part.
struct PartScores {
    std::array<float, kPartCount> values{};

    [[nodiscard]] float operator[](Part part) const { return values[indexOf(part)]; }
    [[nodiscard]] float& operator[](Part part) { return values[indexOf(part)]; }
};

}  // namespace lutka::animation
