#include "physics/crowd/moved_contacts.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
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

// The points of the pairs of shapes that were asked for last, the deepest first: a pair has a contact for each of its
// points, in blocks one after the other. Bodies stand still meanwhile.
class NearestPoints {
  public:
    explicit NearestPoints(const CrowdState& state) : state_(state) {}

    // Within `range` metres, which is the same for all contacts of a pair.
    const Touches<BodyTouch>& of(const PairTouch& touch, float range) {
        constexpr unsigned kSpread = 31;
        unsigned place = 0;
        for (const int part : {touch.dollA, touch.dollB, int{touch.bodyA}, int{touch.bodyB}})
            place = place * kSpread + static_cast<unsigned>(part);
        Entry& entry = entries_[place % entries_.size()];
        if (!isSame(entry, touch)) find(touch, range, entry);
        return entry.found;
    }

  private:
    struct Entry {
        int dollA = -1, dollB = -1;
        std::uint16_t bodyA = 0, bodyB = 0;
        std::uint8_t shapeA = 0, shapeB = 0;
        Touches<BodyTouch> found;
    };
    static bool isSame(const Entry& entry, const PairTouch& touch) {
        return entry.dollA == touch.dollA && entry.dollB == touch.dollB && entry.bodyA == touch.bodyA &&
               entry.bodyB == touch.bodyB && entry.shapeA == touch.shapeA && entry.shapeB == touch.shapeB;
    }
    void find(const PairTouch& touch, float range, Entry& entry) const {
        const Doll& dollA = state_.dolls[touch.dollA];
        const Doll& dollB = state_.dolls[touch.dollB];
        entry = {touch.dollA,
                 touch.dollB,
                 touch.bodyA,
                 touch.bodyB,
                 touch.shapeA,
                 touch.shapeB,
                 touchBodies(placedShape(state_, dollA, touch.bodyA, touch.shapeA),
                             placedShape(state_, dollB, touch.bodyB, touch.shapeB), range)};
        std::sort(std::begin(entry.found.points), std::begin(entry.found.points) + entry.found.count,
                  [](const BodyTouch& a, const BodyTouch& b) { return a.separation < b.separation; });
    }

    const CrowdState& state_;
    std::array<Entry, 64> entries_;
};

// Puts the contact's point where the shapes are nearest now; where they have no such point, nowhere. Shapes that were
// apart had one contact: it is for the deepest point.
void refresh(const CrowdState& state, const PairTouch& touch, const Touches<BodyTouch>& found, PairContactLanes& pair,
             int lane) {
    const int index = indexOfKey(touch.carried.key);
    if (index >= found.count) {
        pair.radius.lane[lane] = -1.0F;
        pair.normalImpulse.lane[lane] = 0.0F;
        return;
    }
    const Doll& dollA = state.dolls[touch.dollA];
    const Doll& dollB = state.dolls[touch.dollB];
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
    NearestPoints nearest(state);
    for (std::size_t block = job.firstBlock; block < job.firstBlock + job.blockCount; ++block) {
        PairContactLanes& pair = state.pairs[block];
        for (int lane = 0; lane < kLanes; ++lane) {
            const bool follows = (pair.follows >> static_cast<unsigned>(lane) & 1U) != 0;
            const int index = state.touchOfLane[block][lane];
            if (follows || index < 0) continue;
            const PairTouch& touch = state.touches[index];
            const float motion = moved(state, touch, seconds);
            if (motion > kMovedM) refresh(state, touch, nearest.of(touch, kRangeM + motion), pair, lane);
        }
    }
}

}  // namespace lutka::physics::crowd
