#pragma once

#include <span>
#include <string>
#include <vector>

#include "physics/profile/joint_range.hpp"

namespace lutka::editor {

/// Shows what a joint's limits allow: swings the body and all that hangs on it through the range, for the eye only.
/// Starts and ends at the pose that it was given.
class LimitSwing {
  public:
    /// `child` > 0: the body whose joint swings. `worldFromBody`: the doll's bodies as they are.
    LimitSwing(const physics::RagdollProfile& profile, int child, std::vector<RigidTransform> worldFromBody);

    void advance(float seconds);
    [[nodiscard]] bool done() const;
    /// The bodies as they are shown now.
    [[nodiscard]] std::span<const RigidTransform> worldFromBody() const { return shown_; }
    /// The end of the range that it is on its way to: "abduction".
    [[nodiscard]] std::string text() const;

  private:
    /// A place to pass: rotation vector of the swing about the frame's y and z, and the twist, radians.
    struct Stop {
        float side = 0.0F;
        float flexion = 0.0F;
        float twist = 0.0F;
        std::string name;
    };

    physics::ConstraintProfile constraint_;
    std::vector<int> moving_;  // the child and all below it
    std::vector<RigidTransform> start_;
    std::vector<RigidTransform> shown_;
    std::vector<Stop> stops_;
    float seconds_ = 0.0F;
};

}  // namespace lutka::editor
