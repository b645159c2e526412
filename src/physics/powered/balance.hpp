#pragma once

#include <array>
#include <span>
#include <vector>

#include "physics/profile/body_state.hpp"
#include "physics/profile/profile.hpp"

namespace lutka::physics {

/// What a doll's joints do while its legs carry it, one a constraint: see PoseDrive::drive().
struct Stance {
    std::vector<float> share;   ///< Of the doll that the joint carries; 0: a joint as any other.
    std::vector<vec3> axis;     ///< World, unit; about it the joint does not hold the pose but gives `torque`. 0: none.
    std::vector<float> torque;  ///< N m about `axis`, on the child.
    std::vector<vec3> turn;     ///< World, radians: the child's pose is turned by it in its parent.
};

/// Keeps a doll that stands on its feet from falling over. It brings the capture point to rest over the middle of the
/// feet. That is the centre of mass plus its velocity over the pendulum's frequency (Pratt, Carff, Drakunov and Goswami
/// 2006): where the doll would come to rest by itself.
///
/// Ankle strategy: the ankles move the centre of pressure beyond the capture point, as far as heels and toes reach. Hip
/// strategy (Horak and Nashner 1986): where that is not far enough, trunk and arms turn the way that the doll falls and
/// take angular momentum from the legs; they come back slowly. It takes no steps.
class Balance {
  public:
    /// The profile must outlive this.
    explicit Balance(const RagdollProfile& profile);

    /// For the coming step of `dt` > 0 s: `grounded` says which of left and right foot are on the ground; `gravity` in
    /// m/s², > 0. Null without a foot on the ground. What is returned holds until the next call. Allocates nothing.
    [[nodiscard]] const Stance* stanceOf(std::span<const BodyState> bodies, const std::array<bool, 2>& grounded,
                                         float gravity, float dt);
    /// The bodies of left and right foot; -1: none.
    [[nodiscard]] std::array<int, 2> feet() const { return {feet_[0].body, feet_[1].body}; }

  private:
    struct Foot {
        int body = -1;
        std::vector<int> leg;   // constraints from the ankle up to the root
        vec3 along{0, 1, 0};    // body space: from heel to toe or back
        float half = 0.0F;      // metres: how far it presses along that
        bool stands = false;    // in this step
        vec3 middle{0, 0, 0};   // world, likewise
        vec3 heading{0, 0, 1};  // level, likewise
        float load = 0.0F;      // of the doll's weight, likewise
    };
    void findFeet(std::span<const BodyState> bodies, const std::array<bool, 2>& grounded);
    void shareLoad(const vec3& pressed);
    void press(std::span<const BodyState> bodies, const vec3& pressed, float weight);
    [[nodiscard]] vec3 beyondFeet(const vec3& pressed) const;
    [[nodiscard]] vec3 headingOfFeet() const;
    void drawHome(float ahead, float dt);
    void bow(float ahead, float speed, float dt);
    void lean(const vec3& beyond, float dt);

    const RagdollProfile& profile_;
    std::array<Foot, 2> feet_;
    std::vector<int> trunk_, arms_;  // constraints
    float massKg_ = 0.0F;
    float home_ = 0.0F;  // metres along the feet's heading from their middle: where the centre of mass is to be
    bool isHome_ = false;
    float bow_ = 0.0F;        // radians
    vec3 lean_{0, 0, 0};      // world, radians: how far the trunk is turned out of its pose
    vec3 leanRate_{0, 0, 0};  // a second
    Stance stance_;
};

}  // namespace lutka::physics
