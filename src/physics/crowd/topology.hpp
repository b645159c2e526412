#pragma once

#include <vector>

#include "physics/crowd/body_lanes.hpp"
#include "physics/crowd/joint_lanes.hpp"
#include "physics/crowd/search_lanes.hpp"
#include "physics/profile/profile.hpp"
#include "physics/world/world.hpp"

namespace lutka::physics::crowd {

/// What all dolls of a profile share, in the form that the kernels read. A prop is a doll of one body.
struct Topology {
    std::vector<BodyConstants> bodies;
    std::vector<JointConstants> joints;
    std::vector<BodyShape> shapes;    ///< One a body; the constants and the kernels know its main shape alone.
    bool anyAdded = false;            ///< Whether any body has more than one shape.
    std::vector<PlanePoint> points;   ///< Of all shapes, body by body.
    std::vector<SelfPair> selfPairs;  ///< Bodies that may collide: neither linked nor filtered.

    [[nodiscard]] int bodyCount() const { return static_cast<int>(bodies.size()); }
    /// The number of shapes of a body, at least 1; the main one is shape 0.
    [[nodiscard]] int shapeCount(int body) const { return 1 + static_cast<int>(shapes[body].more.size()); }
    [[nodiscard]] const PrimitiveShape& shapeOf(int body, int shape) const {
        return shape == 0 ? static_cast<const PrimitiveShape&>(shapes[body]) : shapes[body].more[shape - 1];
    }
    /// From the space of a body's shape to the body's.
    [[nodiscard]] vec3 inBody(int body, int shape, const vec3& local) const {
        return shape == 0 ? local : shapes[body].more[shape - 1].bodyFromShape * local;
    }
    /// Whether the kernels see the whole of the body: a capsule or a sphere and nothing else.
    [[nodiscard]] bool isCore(int body) const { return !shapes[body].isAngular() && shapes[body].more.empty(); }
    /// Whether they see all of all bodies.
    [[nodiscard]] bool hasOnlyCores() const {
        for (int body = 0; body < bodyCount(); ++body)
            if (!isCore(body)) return false;
        return true;
    }
};

/// `leastGyration`: see CrowdTuning.
[[nodiscard]] Topology makeTopology(const RagdollProfile& profile, float leastGyration);
[[nodiscard]] Topology makeTopology(const DynamicProp& prop);

/// Whether dolls of both can share a batch.
[[nodiscard]] bool sameTopology(const Topology& a, const Topology& b);

}  // namespace lutka::physics::crowd
