#pragma once

#include <array>
#include <optional>
#include <span>

#include "animation/ik/feet_on_ground.hpp"
#include "scene/asset/ragdoll_asset.hpp"

namespace lutka::scene {

/// Lets a figure that plays a clip made for a level floor walk over ramps and steps.
/// - The figure's floor goes up and down with the ground below its feet.
/// - Each foot keeps its height over the ground, and its sole turns with the slope.
/// - The hips come down where a leg is too short.
/// - Heights of the ground are smoothed over time and taken a little ahead, so that a foot is over a step before it
///   gets there.
///
/// The asset must outlive this.
class TerrainWalk {
  public:
    /// Nothing where the character has no two legs with feet.
    [[nodiscard]] static std::optional<TerrainWalk> of(const RagdollAsset& asset);

    /// Fits a pose in place, one parent-relative frame a joint. `worldFromModel` is that on the level floor at the
    /// height `floor`. After `dt` > 0 s since the last call; 0: at once, as at a start. Returns `worldFromModel` at the
    /// height that the figure goes at. Allocates nothing.
    RigidTransform fit(const animation::GroundQuery& ground, float dt, float floor,
                       const RigidTransform& worldFromModel, std::span<RigidTransform> parentFromJoint);

    /// Whether a foot (left, right) stood in the last pose before it was fitted: low, and hardly moving.
    [[nodiscard]] bool stands(int leg) const { return legs_[leg].stands; }
    /// Whether the query had no answer below both feet in the last pose, but had one since the last start: the figure
    /// walked over an edge.
    [[nodiscard]] bool isOverNothing() const { return hadGround_ && !legs_[0].hasGround && !legs_[1].hasGround; }

  private:
    struct Leg {
        animation::GroundLeg bones;
        bool stands = false;
        bool isKnown = false;
        bool hasGround = false;  // below ankle or ball
        vec3 ankle{0, 0, 0};     // in the pose as it came, world
        vec3 ball{0, 0, 0};
        vec3 ahead{0, 0, 0};   // how far the ball goes in the time that is looked ahead, level
        float height = 0.0F;   // of the ground, smoothed
        vec3 normal{0, 1, 0};  // likewise
    };
    explicit TerrainWalk(const RagdollAsset& asset) : asset_(&asset) {}
    void look(Leg& leg, const animation::GroundQuery& ground, float dt, float floor);

    const RagdollAsset* asset_;
    int hips_ = animation::kNoJoint;
    std::array<Leg, 2> legs_;
    float height_ = 0.0F;  // of the figure's floor
    bool isKnown_ = false;
    bool hadGround_ = false;
};

}  // namespace lutka::scene
