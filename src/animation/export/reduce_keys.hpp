#pragma once

#include <optional>
#include <span>
#include <vector>

#include "animation/character.hpp"
#include "animation/clip.hpp"
#include "animation/skeleton.hpp"
#include "core/math.hpp"

namespace lutka::animation {

/// How far a joint, and the skin that it moves, may be from where the clip has them, in model space: what is off at the
/// hips is off at the hands, too.
struct KeyTolerance {
    float metres = 1e-4F;
    float radians = lutka::radians(0.05F);
};

/// How far the skin of each joint reaches from it in the bind pose, metres; one a joint. A vertex counts for the joints
/// that carry a hundredth of it or more.
[[nodiscard]] std::vector<float> skinReach(const Character& character);

/// What a writer takes to keep every key, or only those that the usual tolerance needs.
[[nodiscard]] inline std::optional<KeyTolerance> keysKept(bool all) {
    return all ? std::nullopt : std::optional(KeyTolerance{});
}

/// The frames of a clip whose keys are kept, ascending, one list a joint; a list begins with the first frame and ends
/// with the last.
struct KeptKeys {
    std::vector<std::vector<int>> rotations;
    std::vector<std::vector<int>> translations;
};

/// Few keys such that at every frame every joint is within the tolerance, blended as glTF's LINEAR has it (translations
/// linearly, rotations along the shorter arc). Channels that hold each frame (Clip::steppedRotations) are kept whole.
/// Both tolerances > 0. `reach` is skinReach(), one a joint: then the skin is within the tolerance, too; empty: there
/// is no skin.
[[nodiscard]] KeptKeys reduceKeys(const Skeleton& skeleton, const Clip& clip, const KeyTolerance& tolerance,
                                  std::span<const float> reach = {});

/// All frames of every channel.
[[nodiscard]] KeptKeys allKeys(const Skeleton& skeleton, const Clip& clip);

}  // namespace lutka::animation
