#include "physics/crowd/bounds.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "physics/crowd/near_bodies.hpp"
#include "physics/crowd/substeps.hpp"

namespace lutka::physics::crowd {
namespace {

// The kernels bound main shapes; what the others reach beyond, with the same motion.
void boundAdded(const CrowdState& state, Batch& batch, const Topology& topology, float dt) {
    for (int body = 0; body < topology.bodyCount(); ++body) {
        if (topology.shapeCount(body) == 1) continue;
        BodyLanes& lanes = batch.bodies[body];
        for (int lane = 0; lane < batch.used; ++lane) {
            const Doll& doll = state.dolls[batch.doll[lane]];
            const float turn = glm::length(readVector(lanes.angular, lane));
            const vec3 moved =
                glm::abs(readVector(lanes.velocity, lane) - readVector(batch.bodies[0].velocity, lane)) * dt +
                (turn * topology.bodies[body].reach * dt + state.tuning.pairMargin);
            vec3 low = readVector(lanes.low, lane);
            vec3 high = readVector(lanes.high, lane);
            for (int shape = 1; shape < topology.shapeCount(body); ++shape) {
                const PlacedShape placed = placedShape(state, doll, body, shape);
                const vec3 half = halfBounds(placed) + moved;
                low = glm::min(low, placed.position - half);
                high = glm::max(high, placed.position + half);
            }
            writeVector(lanes.low, lane, low);
            writeVector(lanes.high, lane, high);
        }
    }
}

}  // namespace

void findBounds(CrowdState& state, Batch& batch, const Topology& topology, float dt) {
    const BatchView view = batch.view(topology);
    state.kernels->findBounds(view, dt, state.tuning.pairMargin);
    if (topology.anyAdded) boundAdded(state, batch, topology, dt);
    Wide3 low;
    Wide3 high;
    state.kernels->joinBounds(view, low, high);
    for (int lane = 0; lane < batch.used; ++lane) {
        Doll& doll = state.dolls[batch.doll[lane]];
        doll.low = readVector(low, lane);
        doll.high = readVector(high, lane);
        doll.rootVelocity = readVector(batch.bodies[0].velocity, lane);
    }
}

void findBounds(CrowdState& state, float dt) {
    state.inParallel(state.active.size(), 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            Batch& batch = *state.active[i];
            const Topology& topology = state.activeGroup[i]->topology;
            findBounds(state, batch, topology, dt);
            takeWays(state, batch, topology, dt);
            findPace(state, batch, topology, dt);
        }
    });
}

Aabb worldBounds(const Doll& doll, float dt, float farther) {
    const vec3 moved = farther + (doll.asleep() ? vec3(0) : glm::abs(doll.rootVelocity) * (kForesight * dt));
    return {doll.low - moved, doll.high + moved};
}

bool meet(const vec3& lowA, const vec3& highA, const vec3& lowB, const vec3& highB) {
    return lowA.x <= highB.x && lowB.x <= highA.x && lowA.y <= highB.y && lowB.y <= highA.y && lowA.z <= highB.z &&
           lowB.z <= highA.z;
}

}  // namespace lutka::physics::crowd
