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

/// How the feet are to be moved so that they stand where the source's do; one shift a frame.
/// - While heel or ball stands in the source, it is held to one place at its height on the floor. From heel to ball the
///   hold goes over without a jump.
/// - Between contacts the foot comes back to its own way within `blendSeconds`.
/// - No part of a sole goes below the floor.
/// - The hips move by the mean of what the standing feet need, and down where a leg is too short, smoothly over time.
[[nodiscard]] std::vector<FootShift> keepFeet(const AnatomicalRig& target, const FootMotion& motion,
                                              const std::array<FootContact, 2>& contacts, float framesPerSecond,
                                              float blendSeconds = 0.2F);

/// How the hips are to be turned on top of what they do, a rotation vector a frame (FootShift::hipsTurn). Hips that are
/// wide for the length of the legs draw the feet farther apart than the source's as they turn; where both feet stand,
/// the legs would have to make up for it. `excessWidth`, of their width, [0, 1): by how much they are wider than the
/// source's in proportion; 0: no turn. Between frames in which both feet stand the turn is interpolated; all of it is
/// smoothed over time.
[[nodiscard]] std::vector<vec3> hipsTurns(const AnatomicalRig& target, const FootMotion& motion,
                                          const std::array<FootContact, 2>& contacts, float excessWidth,
                                          float framesPerSecond, float blendSeconds = 0.2F);

/// How deep the lowest part of a sole (under heel and ball) is below the floor; negative above it.
[[nodiscard]] float depthOf(const AnatomicalRig::Foot& foot, const vec3& ankle, const vec3& ball, const vec3& up,
                            float floor);

}  // namespace lutka::animation
