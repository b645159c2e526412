#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "animation/retarget/anatomical_rig.hpp"

namespace lutka::animation {

/// The way of one foot through a clip, a point a frame, standard space.
struct FootTrack {
    std::vector<vec3> ankle;
    std::vector<vec3> ball;
};

/// When a foot's parts stand on the floor, a flag a frame.
struct FootContact {
    std::vector<bool> heel;
    std::vector<bool> ball;
};

struct ContactSettings {
    float mostSpeed = 0.3F;      ///< Leg lengths a second that a standing point may move by.
    float mostHeight = 0.05F;    ///< Leg lengths over its height in the bind pose.
    float leastSeconds = 0.06F;  ///< Shorter contacts are none, and shorter gaps are closed.
};

/// The height of the floor that the figure walks on: below the lowest twentieth of what its feet are at. 0 without
/// frames.
[[nodiscard]] float floorOfMotion(const AnatomicalRig& rig, std::span<const FootTrack, 2> tracks);

/// The floor below the balls that stand: the median of what they stand at. Nothing where none does.
[[nodiscard]] std::optional<float> standingHeight(const AnatomicalRig& rig, std::span<const FootTrack, 2> tracks,
                                                  std::span<const FootContact, 2> contacts);

/// Where the foot stands: slow and low.
[[nodiscard]] FootContact contactsOf(const AnatomicalRig::Foot& foot, const FootTrack& track, float floor,
                                     float legLength, float framesPerSecond, const ContactSettings& settings = {});

/// Frames [first, last] that are flagged, one after the other.
struct FrameRun {
    int first = 0;
    int last = 0;
};
[[nodiscard]] std::vector<FrameRun> runsOf(const std::vector<bool>& flags);

}  // namespace lutka::animation
