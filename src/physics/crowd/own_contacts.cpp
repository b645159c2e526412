#include "physics/crowd/own_contacts.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "physics/crowd/narrowphase.hpp"

namespace lutka::physics::crowd {
namespace {

// How far two bodies of a doll have moved against each other at most in so many seconds, as they move now.
float moved(const CrowdState& state, const Doll& doll, const PairTouch& touch, float seconds) {
    const Batch& batch = state.batchOf(doll);
    const std::vector<BodyConstants>& constants = state.groupOf(doll).topology.bodies;
    const BodyState a = readBody(batch.bodies[touch.bodyA], doll.lane);
    const BodyState b = readBody(batch.bodies[touch.bodyB], doll.lane);
    return seconds * (glm::length(a.linearVelocity - b.linearVelocity) +
                      glm::length(a.angularVelocity) * constants[touch.bodyA].reach +
                      glm::length(b.angularVelocity) * constants[touch.bodyB].reach);
}

// Puts the contact's point where the shapes are nearest now; where they have no such point any more, nowhere.
void refresh(const CrowdState& state, const Doll& doll, const PairTouch& touch, PairContactLanes& pair, int lane) {
    constexpr float kRangeM = 0.3F;  // farther than a contact is foreseen
    const Topology& topology = state.groupOf(doll).topology;
    Touches<BodyTouch> found = touchBodies(placedShape(state, doll, touch.bodyA, touch.shapeA),
                                           placedShape(state, doll, touch.bodyB, touch.shapeB), kRangeM);
    const int index = indexOfKey(touch.carried.key);
    if (index >= found.count) {
        pair.radius.lane[lane] = -1.0F;
        pair.normalImpulse.lane[lane] = 0.0F;
        return;
    }
    // Shapes that were apart had one contact: it is for the deepest point.
    std::sort(std::begin(found.points), std::begin(found.points) + found.count,
              [](const BodyTouch& a, const BodyTouch& b) { return a.separation < b.separation; });
    const BodyTouch& at = found.points[index];
    writeVector(pair.localA, lane, topology.inBody(touch.bodyA, touch.shapeA, at.localA));
    writeVector(pair.localB, lane, topology.inBody(touch.bodyB, touch.shapeB, at.localB));
    writeVector(pair.normal, lane, at.normal);
    pair.radius.lane[lane] = at.radius;
    pair.onAxisY = 0;
}

}  // namespace

void refreshOwn(CrowdState& state, const Job& job, float seconds) {
    constexpr float kMovedM = 0.003F;
    const auto hasOnlyCores = [](const Topology* topology) { return topology->hasOnlyCores(); };
    if (std::all_of(job.topologies.begin(), job.topologies.end(), hasOnlyCores)) return;
    for (std::size_t block = job.firstBlock; block < job.firstBlock + job.blockCount; ++block) {
        PairContactLanes& pair = state.pairs[block];
        for (int lane = 0; lane < kLanes; ++lane) {
            const bool follows = (pair.follows >> static_cast<unsigned>(lane) & 1U) != 0;
            if (follows || pair.kind.lane[lane] != PairKind::own) continue;
            const PairTouch& touch = state.touches[state.touchOfLane[block][lane]];
            const Doll& doll = state.dolls[touch.dollA];
            if (moved(state, doll, touch, seconds) > kMovedM) refresh(state, doll, touch, pair, lane);
        }
    }
}

}  // namespace lutka::physics::crowd
