#pragma once

#include <optional>
#include <span>
#include <vector>

#include "animation/character.hpp"
#include "physics/fit/body_plan.hpp"
#include "physics/fit/limits.hpp"
#include "physics/profile/profile.hpp"

namespace lutka::physics {

/// How well the shapes of a profile stand for the character's body, in the bind pose.
struct FitMeasures {
    int vertices = 0;  ///< Of the skin; 0: there is none, and the shares mean nothing.
    /// Share of the skin's vertices (as animation::countedVertices() counts them) within 2 % of the height of the
    /// surface of the body that owns them, [0, 1].
    float skinNear = 0.0F;
    /// Share of the volume inside the skin that lies in some body, [0, 1]; unset where the skin encloses none (open or
    /// inside-out meshes), or more than can be measured in some seconds (triangles far larger than the figure).
    /// Estimated on about 50,000 points of a jittered grid with a fixed seed, to about 1 %.
    std::optional<float> volumeCovered;
    float overlapM = 0.0F;  ///< Deepest overlap of two bodies that are neither linked nor filtered, metres.
};
inline constexpr float kNearSkin = 0.02F;  ///< Of the height.

/// Everything but overlapM, which stays 0. `shapes` are the plan's bodies in the bind pose, in the plan's order;
/// `standardFromModel` is that of the map that the plan was made with.
[[nodiscard]] FitMeasures measureSkin(const animation::Character& character, const BodyPlan& plan,
                                      std::span<const PlacedShape> shapes, const quat& standardFromModel);

/// Two bodies that overlap in the bind pose though they are neither linked nor filtered.
struct BodyOverlap {
    int first = 0;
    int second = 0;
    float depthM = 0.0F;
};
/// `shapes` are the profile's bodies in the bind pose (shapesInBindPose).
[[nodiscard]] std::vector<BodyOverlap> findOverlaps(const RagdollProfile& profile, std::span<const PlacedShape> shapes);

}  // namespace lutka::physics
