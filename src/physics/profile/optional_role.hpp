#pragma once

#include <optional>

#include "animation/humanoid/roles.hpp"

namespace lutka::physics {

/// What animation/humanoid/roles.hpp tells of a role, for bodies that may have none: those are in the middle and belong
/// to no part of a humanoid.
[[nodiscard]] inline animation::Side sideOf(std::optional<animation::Role> role) {
    return role ? animation::sideOf(*role) : animation::Side::center;
}
[[nodiscard]] inline std::optional<animation::Role> mirrored(std::optional<animation::Role> role) {
    return role ? std::optional(animation::mirrored(*role)) : std::nullopt;
}
[[nodiscard]] inline bool isEitherSide(std::optional<animation::Role> role, animation::Role left) {
    return role && animation::isEitherSide(*role, left);
}
[[nodiscard]] inline bool isTrunk(std::optional<animation::Role> role) {
    return role && animation::isTrunk(*role);
}

}  // namespace lutka::physics
