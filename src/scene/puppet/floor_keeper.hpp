#pragma once

#include <functional>
#include <span>
#include <vector>

#include "physics/powered/reachable_pose.hpp"
#include "scene/asset/ragdoll_asset.hpp"

namespace lutka::scene {

/// Height of the ground below a point, world, Y up.
using GroundHeight = std::function<float(const vec3& worldPoint)>;

/// What a figure's bodies stand on in its bind pose: the height of its soles over the model's origin, or of its lowest
/// body where that ends well above them (skeletons without a skin), metres, in standard space.
[[nodiscard]] float standingFloorOf(const RagdollAsset& asset);

/// Keeps a pose of bodies out of the floor: hands and feet are lifted by two bones each, feet as far as the joints'
/// limits allow, and what is in the ground then lifts the whole figure. Joints stay closed. The asset must outlive
/// this.
class FloorKeeper {
  public:
    explicit FloorKeeper(const RagdollAsset& asset);

    /// In place, one frame a body, world. `clearance`: how high over the ground a hand or foot is lifted at least,
    /// metres, one a body; empty: 0. Continuous in the pose where the ground's height is. Allocates nothing.
    void keep(const GroundHeight& ground, std::span<RigidTransform> worldFromBody,
              std::span<const float> clearance = {}) const;
    /// How high over the ground a walking figure's bodies are to stay, metres, one a body: a leg that has no foot can't
    /// be lifted as it swings and would be caught; all else 0.
    [[nodiscard]] std::span<const float> swings() const { return swings_; }
    /// lowestOf() less that.
    [[nodiscard]] float heightOver(int body, const RigidTransform& worldFromBody) const {
        return lowestOf(body, worldFromBody) - swings_[body];
    }
    /// Places all bodies but the root from their rotations, so that the joints are closed.
    void closeJoints(std::span<RigidTransform> worldFromBody) const;
    /// The height of a body's lowest point.
    [[nodiscard]] float lowestOf(int body, const RigidTransform& worldFromBody) const;

  private:
    struct Limb {
        int upper = -1, lower = -1, end = -1;  // bodies
        bool isLeg = false;
        vec3 bendInUpper{0, 0, 1};  // where elbow or knee sticks out
    };
    void liftEnd(const Limb& limb, float height, std::span<RigidTransform> worldFromBody) const;

    const RagdollAsset* asset_;
    physics::ReachablePose reachable_;
    std::vector<Limb> limbs_;
    std::vector<float> swings_;
};

}  // namespace lutka::scene
