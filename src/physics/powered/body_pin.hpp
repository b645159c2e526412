#pragma once

#include <array>

#include "physics/world/world.hpp"

namespace lutka::physics {

/// Holds a body of a doll to a frame in motion, position and orientation, by three pulls at points around its centre.
/// What it adds from outside is counted in World::dragWork(). The world must outlive it.
class BodyPin {
  public:
    static constexpr float kReachM = 0.15F;  ///< About half a pelvis.

    /// It pulls from the first follow() on. Refused calls leave it without effect.
    BodyPin(World& world, DollId doll, int body);
    ~BodyPin();
    BodyPin(const BodyPin&) = delete;
    BodyPin& operator=(const BodyPin&) = delete;

    /// For the coming step of `dt` > 0 s, in which the frame moves from `from` to `to` (world), with at most
    /// `maxForceN`. It pulls at `reachM` > 0 metres around the centre: the more, the greater the torques that it holds
    /// the orientation with.
    void follow(const RigidTransform& from, const RigidTransform& to, float dt, float maxForceN,
                float reachM = kReachM);

  private:
    World& world_;
    Drag drag_;
    std::array<DragId, 3> ids_;
};

}  // namespace lutka::physics
