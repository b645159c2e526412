#pragma once

#include <array>
#include <vector>

#include "animation/retarget/foot_contacts.hpp"
#include "animation/retarget/retargeter.hpp"

namespace lutka::animation {

/// What the target's feet and legs do in every frame before they are kept on the floor; standard space.
struct FootMotion {
    std::array<FootTrack, 2> tracks;        ///< Left, right.
    std::array<std::vector<vec3>, 2> hips;  ///< The upper legs' joints.
    std::array<std::vector<vec3>, 2> up;    ///< Up from the sole, unit.
    std::array<float, 2> legReach{};        ///< From hip joint to ankle when straight, metres.
};

/// How the feet are to be moved so that they stand where the source's do: a point that stands in the source is held to
/// one place and its height on the floor for as long, a heel that comes down before its ball takes over from it without
/// a step, and between contacts the foot comes back to its own way within `blendSeconds`. No part of a sole goes below
/// the floor. The hips move with what the standing feet need in the mean, and down where a leg is too short, smoothly
/// over time. One shift a frame.
[[nodiscard]] std::vector<FootShift> keepFeet(const AnatomicalRig& target, const FootMotion& motion,
                                              const std::array<FootContact, 2>& contacts, float framesPerSecond,
                                              float blendSeconds = 0.2F);

/// How the hips are to be turned on top of what they do, a rotation vector a frame (FootShift::hipsTurn), so that feet
/// that both stand need not be held by the legs: hips that are wide for the length of the legs draw the feet farther
/// apart than the source's as they turn. `excessWidth`, of their width, [0, 1): by how much they are wider than the
/// source's in proportion; with 0 they stay as they turn. In between they go on a straight way, smoothly over time.
[[nodiscard]] std::vector<vec3> hipsTurns(const AnatomicalRig& target, const FootMotion& motion,
                                          const std::array<FootContact, 2>& contacts, float excessWidth,
                                          float framesPerSecond, float blendSeconds = 0.2F);

/// How deep the lowest part of a sole (under heel and ball) is below the floor; negative above it.
[[nodiscard]] float depthOf(const AnatomicalRig::Foot& foot, const vec3& ankle, const vec3& ball, const vec3& up,
                            float floor);

}  // namespace lutka::animation
