#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "animation/character.hpp"
#include "animation/humanoid/map_humanoid.hpp"
#include "animation/segments/segment.hpp"

namespace lutka::animation {

/// What hangs on a humanoid beside its parts.
enum class AppendageKind { tail, ears, hair, cape, skirt, wings, weapon, other };
inline constexpr std::array<AppendageKind, 8> kAppendageKinds{
    AppendageKind::tail,  AppendageKind::ears,  AppendageKind::hair,   AppendageKind::cape,
    AppendageKind::skirt, AppendageKind::wings, AppendageKind::weapon, AppendageKind::other};

/// "tail", "ears" …
[[nodiscard]] std::string_view appendageName(AppendageKind kind);
[[nodiscard]] std::optional<AppendageKind> appendageNamed(std::string_view name);

/// A joint with all below it that plays no role and moves enough skin for a body.
struct Appendage {
    AppendageKind kind = AppendageKind::other;
    int joint = kNoJoint;    ///< The topmost.
    int joints = 0;          ///< With skin, at and below it.
    Role role = Role::hips;  ///< Of the part that it hangs on.
};

/// The appendages of a humanoid, in the order of the skeleton: by their names, else by where they hang and how they
/// point (docs/creatures.md). Fingers, toes, faces, twist joints and controls are none.
[[nodiscard]] std::vector<Appendage> findAppendages(const Character& character, const HumanoidMap& map);

/// Segments for the appendages of these kinds, at most `mostSegments`; tops have no parent, they hang on the part with
/// the role. Counterparts are paired, the left one first.
[[nodiscard]] std::vector<Segment> appendageSegments(const Character& character, const HumanoidMap& map,
                                                     std::span<const AppendageKind> kinds, int mostSegments);

}  // namespace lutka::animation
