#pragma once

#include <span>
#include <vector>

#include "animation/skeleton.hpp"
#include "core/random.hpp"

namespace lutka::test {

/// A chain of joints whose frames lie in any way to their bones, 0.1 to 0.5 m each, below a root of its own, and a bent
/// pose of it.
struct RandomChain {
    animation::Skeleton skeleton;
    std::vector<RigidTransform> pose;  ///< Parent-relative.
    std::vector<int> joints;           ///< From the top down, without the root.

    [[nodiscard]] vec3 at(int index) const;  ///< A chain's joint in model space.
    [[nodiscard]] float length() const;      ///< From the first of `joints` to the last.
};

[[nodiscard]] RandomChain makeRandomChain(Random& random, int joints, float mostBend = 0.6F);
[[nodiscard]] vec3 randomDirection(Random& random);
[[nodiscard]] quat randomTurn(Random& random, float most);

/// The largest difference of a bone's length between two poses, metres.
[[nodiscard]] float stretchBetween(const animation::Skeleton& skeleton, std::span<const RigidTransform> a,
                                   std::span<const RigidTransform> b);
/// The largest turn of a joint in its parent from one pose to the other, radians.
[[nodiscard]] float turnBetween(std::span<const RigidTransform> a, std::span<const RigidTransform> b);

}  // namespace lutka::test
