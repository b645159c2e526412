#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "animation/humanoid/roles.hpp"

namespace lutka::animation {

/// What a single word of a joint's name speaks of. What role that makes is decided by the whole name and the chain.
enum class Concept {
    // qualifiers
    upper,
    lower,
    leftSide,
    rightSide,
    noise,  ///< says nothing: "joint", "bone", "base", names of rigs
    // trunk
    root,
    hips,
    hip,  ///< one central hip is the hips, a left or right one a thigh
    spine,
    abdomen,
    torso,
    body,
    chest,
    neck,
    head,
    // arm
    clavicle,
    shoulder,  ///< clavicle or upper arm
    arm,       ///< clavicle, upper arm, with a qualifier also forearm
    upperArm,
    forearm,
    elbow,
    wrist,
    hand,
    // leg
    leg,  ///< thigh or shin
    thigh,
    shin,
    knee,
    ankle,
    foot,
    heel,
    toes,
    // what takes no role
    twist,
    control,
    end,
    finger,
    face,
    hair,
    cloth,
    prop,
    creature,
};

/// The meaning of one lower-case word, when it is in the tables (English, and the body words of German, Spanish,
/// French, Italian and Portuguese).
[[nodiscard]] std::optional<Concept> conceptOf(std::string_view word);

/// Chinese and Japanese body words with the English words they are replaced by, longest first.
[[nodiscard]] std::span<const std::pair<std::u32string_view, std::string_view>> cjkWords();

}  // namespace lutka::animation
