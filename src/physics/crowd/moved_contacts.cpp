#include "physics/crowd/moved_contacts.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "physics/crowd/narrowphase.hpp"

namespace lutka::physics::crowd {
namespace {

// How far two bodies have moved against each other at most in so many seconds, as they move now.
float moved(const CrowdState& state, const PairTouch& touch, float seconds) {
    const Doll& dollA = state.dolls[touch.dollA];
    const Doll& dollB = state.dolls[touch.dollB];
    const BodyState a = readBody(state.batchOf(dollA).bodies[touch.bodyA], dollA.lane);
    const BodyState b = readBody(state.batchOf(dollB).bodies[touch.bodyB], dollB.lane);
    return seconds * (glm::length(a.linearVelocity - b.linearVelocity) +
                      glm::length(a.angularVelocity) * state.groupOf(dollA).topology.bodies[touch.bodyA].reach +
                      glm::length(b.angularVelocity) * state.groupOf(dollB).topology.bodies[touch.bodyB].reach);
}

// Puts the contact's point where the shapes are nearest now; where they have no such point within `range` metres,
// nowhere.
void refresh(const CrowdState& state, const PairTouch& touch, PairContactLanes& pair, int lane, float range) {
    const Doll& dollA = state.dolls[touch.dollA];
    const Doll& dollB = state.dolls[touch.dollB];
    Touches<BodyTouch> found = touchBodies(placedShape(state, dollA, touch.bodyA, touch.shapeA),
                                           placedShape(state, dollB, touch.bodyB, touch.shapeB), range);
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
    writeVector(pair.localA, lane, state.groupOf(dollA).topology.inBody(touch.bodyA, touch.shapeA, at.localA));
    writeVector(pair.localB, lane, state.groupOf(dollB).topology.inBody(touch.bodyB, touch.shapeB, at.localB));
    writeVector(pair.normal, lane, at.normal);
    pair.radius.lane[lane] = at.radius;
    pair.onAxisY = 0;
}

}  // namespace

void refreshMoved(CrowdState& state, const Job& job, float seconds) {
    constexpr float kMovedM = 0.003F;
    constexpr float kRangeM = 0.3F;  // farther than a contact is foreseen of what does not move
    const auto hasOnlyCores = [](const Topology* topology) { return topology->hasOnlyCores(); };
    if (std::all_of(job.topologies.begin(), job.topologies.end(), hasOnlyCores)) return;
    for (std::size_t block = job.firstBlock; block < job.firstBlock + job.blockCount; ++block) {
        PairContactLanes& pair = state.pairs[block];
        for (int lane = 0; lane < kLanes; ++lane) {
            const bool follows = (pair.follows >> static_cast<unsigned>(lane) & 1U) != 0;
            const int index = state.touchOfLane[block][lane];
            if (follows || index < 0) continue;
            const PairTouch& touch = state.touches[index];
            const float motion = moved(state, touch, seconds);
            if (motion > kMovedM) refresh(state, touch, pair, lane, kRangeM + motion);
        }
    }
}

}  // namespace lutka::physics::crowd
