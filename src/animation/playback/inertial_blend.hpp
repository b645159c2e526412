#pragma once

#include <span>
#include <vector>

#include "core/rigid_transform.hpp"

namespace lutka::animation {

/// How long a figure takes to come from one motion into another.
struct InertialSettings {
    float turnRate = radians(260.0F);  ///< rad/s that the blend adds to a frame's turning at most, > 0.
    float speed = 2.0F;                ///< m/s that it adds to a frame's motion at most, > 0.
    float leastSeconds = 0.25F;        ///< > 0
    float mostSeconds = 1.2F;          ///< >= leastSeconds; wins over the rates.
};

/// Carries a figure from the motion that it is in into another one: what the two differ by at the beginning dies away
/// along a quintic, so that neither place nor velocity nor acceleration jumps (inertialisation: Bollo,
/// "Inertialization: High-Performance Animation Transitions in Gears of War", GDC 2018). The other motion is played
/// alone meanwhile. May be begun anew at any moment from what it shows.
///
/// Frames are relative to their parents, joints' or bodies' alike; each rotation's difference is a vector that fades,
/// as is each translation's. Allocates nothing once begun.
class InertialBlend {
  public:
    /// `from` is shown now and `fromBefore` was `dt` > 0 seconds ago; likewise of the motion that is gone over to. All
    /// of one size.
    void begin(std::span<const RigidTransform> fromBefore, std::span<const RigidTransform> from,
               std::span<const RigidTransform> toBefore, std::span<const RigidTransform> to, float dt,
               const InertialSettings& settings = {});
    /// Goes on by `dt` >= 0 seconds.
    void advance(float dt) { passed_ += dt; }
    /// What is to be shown now of the motion's frames, in place.
    void apply(std::span<RigidTransform> frames) const;

    [[nodiscard]] bool isOver() const { return passed_ >= seconds_; }
    [[nodiscard]] float seconds() const { return seconds_; }
    /// How much of the way is done, [0, 1].
    [[nodiscard]] float share() const { return seconds_ > 0.0F && passed_ < seconds_ ? passed_ / seconds_ : 1.0F; }

  private:
    struct Offset {
        vec3 turn{0, 0, 0};  // rotation vector on top of the motion's rotation, in the parent's axes
        vec3 turnRate{0, 0, 0};
        vec3 shift{0, 0, 0};
        vec3 shiftRate{0, 0, 0};
    };
    std::vector<Offset> offsets_;
    float seconds_ = 0.0F;
    float passed_ = 0.0F;
};

}  // namespace lutka::animation
