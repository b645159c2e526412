#pragma once

#include <vector>

#include "physics/crowd/layout.hpp"
#include "physics/profile/profile.hpp"
#include "physics/world/world.hpp"

namespace lutka::physics::crowd {

/// What all dolls of a profile share, in the form that the kernels read. A prop is a doll of one body.
struct Topology {
    std::vector<BodyConstants> bodies;
    std::vector<JointConstants> joints;
    std::vector<BodyShape> shapes;
    std::vector<SelfPair> selfPairs;  ///< Bodies that may collide: neither linked nor filtered.

    [[nodiscard]] int bodyCount() const { return static_cast<int>(bodies.size()); }
};

/// `leastGyration`: see CrowdTuning.
[[nodiscard]] Topology makeTopology(const RagdollProfile& profile, float leastGyration);
[[nodiscard]] Topology makeTopology(const DynamicProp& prop);

/// Whether dolls of both can share a batch.
[[nodiscard]] bool sameTopology(const Topology& a, const Topology& b);

}  // namespace lutka::physics::crowd
