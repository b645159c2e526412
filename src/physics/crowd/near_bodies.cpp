#include "physics/crowd/near_bodies.hpp"

#include <algorithm>
#include <glm/common.hpp>

#include "physics/crowd/bounds.hpp"

namespace lutka::physics::crowd {
namespace {

// Metres that the bodies of two dolls may come nearer to each other until they are looked through again.
constexpr float kSpare = 0.04F;

// The bodies of two dolls whose bounds, grown by `farther`, meet.
int findBodyPairs(const CrowdState& state, const Doll& a, const Doll& b, float dt, float farther,
                  std::vector<BodyPair>& near) {
    // How far the two roots move against each other.
    const vec3 moved = glm::abs(a.rootVelocity - b.rootVelocity) * (kForesight * dt) + farther;
    const float apart[3] = {moved.x, moved.y, moved.z};
    const auto boxesOf = [&](const Doll& doll) {
        return DollBoxes{&state.stepBoxes[doll.firstBox],
                         doll.boxes,
                         {doll.low.x, doll.low.y, doll.low.z},
                         {doll.high.x, doll.high.y, doll.high.z}};
    };
    return state.kernels->findBodyPairs(boxesOf(a), boxesOf(b), apart, near.data());
}

// Leaves out of the first `count` pairs those whose surfaces cannot touch until both dolls have come nearer by kSpare:
// the bounds of a limb that lies askew are mostly air. Returns how many are left.
int leaveNear(const CrowdState& state, const Doll& a, const Doll& b, int count, std::vector<BodyPair>& near) {
    constexpr float kRounding = 1e-3F;
    const TouchRange range{state.tuning.pairMargin + kSpare + kRounding, 0.0F, 1.0F};
    const StepBody* bodiesA = &state.stepBodies[a.firstBody];
    const StepBody* bodiesB = &state.stepBodies[b.firstBody];
    int left = 0;
    for (int first = 0; first < count; first += kLanes) {
        const StepBody* ofA[kLanes];
        const StepBody* ofB[kLanes];
        const int here = std::min(count - first, kLanes);
        for (int lane = 0; lane < kLanes; ++lane) {
            const BodyPair& pair = near[first + (lane < here ? lane : 0)];
            ofA[lane] = bodiesA + pair.a;
            ofB[lane] = bodiesB + pair.b;
        }
        CoreTouchLanes found;
        const unsigned inRange = state.kernels->touchCores(ofA, ofB, range, found);
        for (int lane = 0; lane < here; ++lane) {
            const bool isBox = ofA[lane]->halfLength == kBoxCore || ofB[lane]->halfLength == kBoxCore;
            if (isBox || (inRange >> static_cast<unsigned>(lane) & 1U) != 0) near[left++] = near[first + lane];
        }
    }
    return left;
}

}  // namespace

void takeWays(CrowdState& state, Batch& batch, const Topology& topology, float dt) {
    Wide way;
    Wide speed;
    state.kernels->takeWay(batch.view(topology), way, speed);
    for (int lane = 0; lane < batch.used; ++lane) {
        Doll& doll = state.dolls[batch.doll[lane]];
        doll.way += static_cast<double>(way.lane[lane]);
        // The bounds of a body reach as far as it moves against the root, at twice the speed at most; and those of the
        // doll as far as the root moves.
        doll.reachesFarther = 3.0F * kForesight * dt * speed.lane[lane];
    }
}

void keepNearBodies(CrowdState& state) {
    std::vector<NearBodies>& known = state.nearBodies;
    std::vector<std::size_t>& place = state.scratch.placeOfNear;
    place.clear();
    // What is kept moves to the front, in its order, which is that of the pairs too. Then each goes to its place from
    // the last on, so that none is in the way of another.
    std::size_t at = 0;
    for (std::size_t i = 0; i < known.size() && at < state.dollPairs.size(); ++i) {
        if (!known[i].holds) continue;
        while (at < state.dollPairs.size() && state.dollPairs[at] < known[i].dolls)
            ++at;
        if (at == state.dollPairs.size() || state.dollPairs[at] != known[i].dolls) continue;
        if (i != place.size()) std::swap(known[place.size()], known[i]);
        place.push_back(at);
    }
    known.resize(place.size());  // gives back the lists of those that have moved apart
    makeRoom(known, state.dollPairs.size());
    known.resize(state.dollPairs.size());
    for (std::size_t i = place.size(); i-- > 0;)
        if (place[i] != i) std::swap(known[place[i]], known[i]);
    for (std::size_t i = 0; i < known.size(); ++i)
        known[i].dolls = state.dollPairs[i];
}

int findNearBodies(const CrowdState& state, NearBodies& kept, float dt, std::vector<BodyPair>& near) {
    const Doll& a = state.dolls[kept.dolls.first];
    const Doll& b = state.dolls[kept.dolls.second];
    const float farther = a.reachesFarther + b.reachesFarther;
    const double way = a.way + b.way;
    near.resize(static_cast<std::size_t>(a.boxes) * static_cast<std::size_t>(b.boxes) * kLanes * kLanes);
    if (kept.holds && way - kept.way + static_cast<double>(farther) <= static_cast<double>(kSpare)) {
        int count = 0;
        for (const auto& [bodyA, bodyB] : kept.pairs)
            near[count++] = {bodyA, bodyB};
        return count;
    }
    // What moves fast would have to be looked through again in the next step anyhow.
    kept.holds = farther < 0.25F * kSpare;
    const int bounded = findBodyPairs(state, a, b, dt, kept.holds ? kSpare : 0.0F, near);
    if (!kept.holds) return bounded;
    const int count = leaveNear(state, a, b, bounded, near);
    kept.way = way;
    kept.pairs.clear();
    for (int i = 0; i < count; ++i)
        kept.pairs.push_back({static_cast<std::uint8_t>(near[i].a), static_cast<std::uint8_t>(near[i].b)});
    return count;
}

}  // namespace lutka::physics::crowd
