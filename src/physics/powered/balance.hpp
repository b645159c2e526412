#pragma once

#include <array>
#include <span>
#include <vector>

#include "physics/profile/body_state.hpp"
#include "physics/profile/profile.hpp"

namespace lutka::physics {

/// What a doll's legs do while they carry it, one a constraint: see PoseDrive::drive().
struct Stance {
    std::vector<float> share;  ///< Of the doll that the joint carries; 0: a joint as any other.
    std::vector<vec3> torque;  ///< N m, world, on the child, on top of the motor's.
};

/// Keeps a doll that stands on its feet from falling over: ankles turn it back to where its centre of mass is over its
/// feet. What is brought to rest there is the capture point, the centre of mass with its velocity over
/// the pendulum's frequency (Pratt, Carff, Drakunov and Goswami 2006): where it would come to rest by itself. No torque
/// is greater than the feet can pass on to the ground without tipping. It takes no steps.
class Balance {
  public:
    /// The profile must outlive this.
    explicit Balance(const RagdollProfile& profile);

    /// For the coming step: `grounded` says which of left and right foot are on the ground; `gravity` in m/s², > 0.
    /// Null without a foot on the ground. What is returned holds until the next call. Allocates nothing.
    [[nodiscard]] const Stance* stanceOf(std::span<const BodyState> bodies, const std::array<bool, 2>& grounded,
                                         float gravity);
    /// The bodies of left and right foot; -1: none.
    [[nodiscard]] const std::array<int, 2>& feet() const { return feet_; }

  private:
    const RagdollProfile& profile_;
    std::array<int, 2> feet_{-1, -1};
    std::array<std::vector<int>, 2> legs_;  // constraints from the ankle up to the root
    float massKg_ = 0.0F;
    Stance stance_;
};

}  // namespace lutka::physics
