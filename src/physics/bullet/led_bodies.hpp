#pragma once

#include <btBulletDynamicsCommon.h>

#include <optional>
#include <span>
#include <vector>

#include "physics/world/world.hpp"

namespace lutka::physics {

/// The bodies of one doll that are led to a BodyTarget. Before a substep each gets a velocity towards its target. A
/// kinematic one gets the whole velocity, and is so heavy that nothing changes it; others get what a spring gives their
/// own mass.
class LedBodies {
  public:
    /// `inertia` as the body was made with; all must outlive this. `gravity` is the world's.
    LedBodies(std::vector<btRigidBody*> bodies, const RagdollProfile& profile, std::vector<vec3> inertia,
              const vec3& gravity);

    /// Returns whether the body became kinematic or no longer is.
    bool set(int body, const std::optional<BodyTarget>& target);
    [[nodiscard]] bool isKinematic(int body) const { return targets_[body] && targets_[body]->weight >= 1.0F; }
    [[nodiscard]] bool any() const { return count_ > 0; }
    /// Of those that calm and sleep nothing by their mass.
    [[nodiscard]] static bool isHeavy(const btRigidBody& body) {
        return (body.getFlags() & BT_DISABLE_WORLD_GRAVITY) != 0;
    }

    /// For the coming substep of `seconds`; the step ends `remaining` after its start.
    void lead(float seconds, float remaining);
    /// What leading did in the substep that has been taken, J.
    [[nodiscard]] double work() const;

  private:
    void weigh(int body, bool heavy);

    std::vector<btRigidBody*> bodies_;
    const RagdollProfile& profile_;
    std::vector<vec3> inertia_;
    vec3 gravity_;
    float heavyKg_ = 0.0F;
    float reach_ = 0.0F;  // about, of the longest body
    float linearDamping_ = 0.0F;
    float angularDamping_ = 0.0F;
    std::vector<std::optional<BodyTarget>> targets_;  // one a body
    std::vector<btVector3> led_, turned_;             // velocities that the last lead() gave
    double given_ = 0.0;                              // J, by its springs
    int count_ = 0;
};

}  // namespace lutka::physics
