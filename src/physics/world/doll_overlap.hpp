#pragma once

#include <span>
#include <vector>

#include "physics/profile/body_state.hpp"
#include "physics/profile/profile.hpp"

namespace lutka::physics {

/// How deep bodies of different dolls are in each other, by the analytic distance of their shapes.
class DollOverlap {
  public:
    static constexpr float kNear = 0.01F;  ///< Metres: pairs farther apart are not counted.

    void clear() { bodies_.clear(); }
    /// A body of a doll, where it is finite; the shape must live until depths() is called.
    void add(int doll, const BodyShape& shape, const RigidTransform& worldFromBody);
    /// All bodies of a doll, likewise.
    void add(int doll, const RagdollProfile& profile, std::span<const BodyState> bodies);
    /// Measures: the depth of each pair that is near, metres; 0 where the two are apart. Valid until the next call.
    std::span<const float> depths();
    /// The largest of the last depths().
    [[nodiscard]] float deepest() const;

  private:
    struct Body {
        const BodyShape* shape;
        RigidTransform worldFromBody;
        vec3 low, high;  // bounds, grown by half of kNear
        int doll;
    };
    void measure(const Body& a, const Body& b);

    std::vector<Body> bodies_;
    std::vector<float> depths_;
};

}  // namespace lutka::physics
