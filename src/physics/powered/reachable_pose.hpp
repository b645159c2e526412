#pragma once

#include <array>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "physics/profile/body_state.hpp"
#include "physics/profile/profile.hpp"

namespace lutka::physics {

/// Changes poses so that a doll can take them: no joint is beyond its limits, no arm or shin in the trunk, no leg in
/// the other one. A motor that is led beyond a limit or into a body only presses against it, and the rest of the doll
/// has to bear that.
///
/// - Arms and legs with a hinge in their middle keep the place of their end as far as they can: the hinge takes the
///   angle at which the end is as far from the shoulder or hip, and the upper part aims it. Hands and feet keep their
///   turn in the world as far as their own limits let them.
/// - All other joints take the nearest turn within their limits, and what hangs on them goes along.
/// - Limbs that overlap another body are turned out of it about the shoulder or hip; a leg that is folded into the
///   trunk opens its knee. Where that would break a limit the limit wins.
class ReachablePose {
  public:
    /// `keeps`: one a body, which of them stay as they are turned, such as kinematic ones; empty: none. The profile
    /// must outlive this.
    explicit ReachablePose(const RagdollProfile& profile, std::vector<bool> keeps = {});

    /// In place, one frame a body, in any space. The root stays where it is, the others close the joints. Allocates
    /// nothing.
    void apply(std::span<RigidTransform> bodies);
    /// Moves the end of an arm or leg (a hand or a foot) by `shift`, metres, as far as the limits allow; it keeps its
    /// turn as far as its own do, and what hangs on the limb goes along. False, and nothing is done, where the body is
    /// no end of a limb with a hinge. Allocates nothing.
    bool moveEnd(int body, const vec3& shift, std::span<RigidTransform> bodies) const;

    /// Places all bodies but the root from their rotations, so that the joints are closed.
    void closeJoints(std::span<RigidTransform> bodies) const;

  private:
    struct Limb {
        int upper = -1, lower = -1, end = -1;  // bodies; -1: figures of few joints lack some
        bool isLeg = false;
        bool isChain = false;                    // it has all three, the lower one on a hinge
        std::vector<int> bodies;                 // upper and all that hangs on it, parents first
        std::vector<std::pair<int, int>> meets;  // one of `bodies`, and what it may run into
        std::vector<std::pair<int, int>> folds;  // of a leg: shin or foot, and a part of the trunk
    };
    struct Turn {
        vec3 axis{0, 0, 1};  // unit
        float angle = 0.0F;  // radians, >= 0
    };
    [[nodiscard]] const ConstraintProfile& jointOf(int body) const { return profile_.constraints[body - 1]; }
    [[nodiscard]] bool isKept(int body) const { return !keeps_.empty() && keeps_[body]; }
    [[nodiscard]] bool hangsOn(int body, int above) const;
    [[nodiscard]] bool collide(int a, int b) const;
    [[nodiscard]] bool isTrunk(int body) const;
    void addLimb(const std::array<Role, 3>& roles, bool isLeg);
    void planMeetings();
    void bend(const Limb& limb, const quat& upper, const quat& lower, const quat& end, const vec3& shift,
              std::span<RigidTransform> bodies) const;
    void turnLimb(const Limb& limb, const quat& turn, std::span<RigidTransform> bodies) const;
    [[nodiscard]] Turn turnOut(std::span<const std::pair<int, int>> meetings, const vec3& pivot,
                               const std::optional<vec3>& axis, std::span<const RigidTransform> bodies) const;
    bool pushOut(const Limb& limb, std::span<RigidTransform> bodies) const;
    bool unfold(const Limb& limb, std::span<RigidTransform> bodies) const;

    const RagdollProfile& profile_;
    std::vector<bool> keeps_;
    std::vector<Limb> limbs_;
    std::vector<int> limbOf_;   // one a body: whose upper, lower or end it is; -1: none
    std::vector<quat> before_;  // scratch
};

}  // namespace lutka::physics
