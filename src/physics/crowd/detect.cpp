#include "physics/crowd/detect.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "physics/crowd/body_touches.hpp"
#include "physics/crowd/bounds.hpp"
#include "physics/crowd/broadphase.hpp"
#include "physics/crowd/near_bodies.hpp"
#include "physics/crowd/static_contacts.hpp"

namespace lutka::physics::crowd {
namespace {

// m/s: what is stopped from that speed within a step lets the other bodies of its doll come nearer by as much.
constexpr float kHardHit = 5.0F;

// Notes which dolls a prop may hit hard in this step.
void findStruck(CrowdState& state) {
    if (state.props.empty()) return;
    for (Doll& doll : state.dolls)
        doll.struckHard = false;
    for (const auto& [a, b] : state.dollPairs) {
        Doll &first = state.dolls[a], &second = state.dolls[b];
        if ((first.profile == nullptr) == (second.profile == nullptr)) continue;
        Doll& doll = first.profile == nullptr ? second : first;
        doll.struckHard = doll.struckHard || glm::distance(first.rootVelocity, second.rootVelocity) > kHardHit;
    }
}

// The lanes whose limp doll is about to hit static geometry or to be hit by a prop hard.
unsigned hardHits(const CrowdState& state, const Batch& batch, float dt) {
    unsigned hits = 0;
    const auto isFast = [&](int lane) {
        return batch.substepsOf[lane] >= state.stepSubsteps.usual && state.dolls[batch.doll[lane]].motors == 0;
    };
    const auto add = [&](int lane, float speed) {
        hits |= (speed > kHardHit ? 1U : 0U) << static_cast<unsigned>(lane);
    };
    for (const NearMotion& at : batch.nearMotions)
        if (isFast(at.lane)) add(at.lane, glm::length(at.velocity));
    for (int lane = 0; lane < batch.used; ++lane) {
        const Doll& doll = state.dolls[batch.doll[lane]];
        // Without props the note is of the last step that had any.
        if (doll.struckHard && !state.props.empty() && doll.motors == 0) hits |= 1U << static_cast<unsigned>(lane);
        if (!isFast(lane)) continue;
        for (const StaticContactLanes& contact : batch.contacts) {
            if (contact.key[lane] == 0) continue;
            const vec3 normal = readVector(contact.normal, lane);
            const BodyState body = readBody(batch.bodies[contact.body], lane);
            const vec3 arm = body.worldFromBody.rotation * readVector(contact.localPoint, lane);
            const float approach = -glm::dot(normal, body.linearVelocity + glm::cross(body.angularVelocity, arm));
            const float separation = glm::dot(normal, body.worldFromBody.translation + arm) -
                                     contact.offset.lane[lane] - contact.radius.lane[lane];
            if (separation < kForesight * approach * dt) add(lane, approach);
        }
    }
    return hits;
}

void findSelfContacts(CrowdState& state, Batch& batch, const BatchView& view, const Topology& topology, float dt,
                      std::vector<PairTouch>& out) {
    renewRoom(out, out.size());
    const TouchRange range = touchRange(state, dt);
    const unsigned hits = hardHits(state, batch, dt);
    TouchRange farther = range;
    farther.margin += kHardHit * dt;
    const std::vector<SelfPair>& pairs = topology.selfPairs;
    std::vector<unsigned char>& masks = batch.selfMasks;
    masks.resize(pairs.size());
    state.kernels->findSelfPairs(view, pairs.data(), static_cast<int>(pairs.size()), masks.data());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const unsigned meeting = masks[i] | hits;
        if (meeting == 0) continue;
        const auto [bodyA, bodyB] = pairs[i];
        CoreTouchLanes found;
        const bool cores = topology.isCore(bodyA) && topology.isCore(bodyB);
        const auto nearLanes = [&](const TouchRange& within, unsigned lanes) {
            if (lanes == 0) return 0U;
            return cores ? lanes & state.kernels->touchOwnCores(view, pairs[i], within, found) : lanes;
        };
        unsigned near = nearLanes(range, meeting & ~hits);
        near |= nearLanes(farther, hits);
        for (int lane = 0; lane < batch.used; ++lane) {
            const unsigned bit = 1U << static_cast<unsigned>(lane);
            if ((near & bit) == 0) continue;
            const BodyRef a{batch.doll[lane], bodyA};
            const BodyRef b{batch.doll[lane], bodyB};
            const Doll& doll = state.dolls[a.doll];
            if (!cores)
                collideShapes(state, a, stepBody(state, doll, bodyA), b, stepBody(state, doll, bodyB),
                              (hits & bit) != 0 ? farther : range, out);
            else
                addTouch(state, a, b, 0, touchOf(found, lane), out);
        }
    }
}

void collideDolls(const CrowdState& state, NearBodies& kept, float dt, std::vector<BodyPair>& near,
                  TouchSearch& search) {
    const int count = findNearBodies(state, kept, dt, near);
    const auto [a, b] = kept.dolls;
    const StepBody* bodiesA = &state.stepBodies[state.dolls[a].firstBody];
    const StepBody* bodiesB = &state.stepBodies[state.dolls[b].firstBody];
    for (int i = 0; i < count; ++i)
        search.add({a, near[i].a}, bodiesA[near[i].a], {b, near[i].b}, bodiesB[near[i].b]);
}

// Whether an awake doll is about to push a sleeping one.
bool pushes(const CrowdState& state, int moverIndex, int sleeperIndex, float dt) {
    constexpr float kPushSpeed = 0.02F;  // m/s: what only leans is left to lie
    constexpr float kOverlap = 0.01F;    // metres
    const Doll& mover = state.dolls[moverIndex];
    const Doll& sleeper = state.dolls[sleeperIndex];
    for (int i = 0; i < state.groupOf(mover).topology.bodyCount(); ++i) {
        const BodyState move = bodyState(state, mover, i);
        const StepBody step = stepBody(state, mover, i);
        const PlacedShape placed = placedShape(state, mover, i);
        for (int j = 0; j < state.groupOf(sleeper).topology.bodyCount(); ++j) {
            const StepBody other = stepBody(state, sleeper, j);
            bool pushed = false;
            const auto judge = [&](const BodyRef&, const BodyRef&, int, const BodyTouch& touch) {
                const vec3 arm = placed.axes * touch.localA;
                const float closing =
                    -glm::dot(touch.normal, move.linearVelocity + glm::cross(move.angularVelocity, arm));
                pushed =
                    pushed || touch.separation < -kOverlap || (closing > kPushSpeed && touch.separation < closing * dt);
            };
            touchAllShapes(state, {moverIndex, i}, {sleeperIndex, j}, distanceIn(touchRange(state, dt), step, other),
                           judge);
            if (pushed) return true;
        }
    }
    return false;
}

}  // namespace

void wakeTouched(CrowdState& state, float dt) {
    for (bool woken = true; woken;) {
        woken = false;
        for (const auto& [first, second] : state.dollPairs) {
            const bool firstSleeps = state.dolls[first].asleep();
            if (firstSleeps == state.dolls[second].asleep()) continue;
            const int sleeper = firstSleeps ? first : second;
            const int mover = firstSleeps ? second : first;
            if (!pushes(state, mover, sleeper, dt)) continue;
            wakeIsland(state, sleeper);
            woken = true;
        }
        if (!woken) return;
        gatherActive(state);
        findBounds(state, dt);
        sweepDolls(state, dt);
    }
}

namespace {

void placeDoll(CrowdState& state, const Doll& doll) {
    const Batch& batch = state.batchOf(doll);
    const int bodies = state.groupOf(doll).topology.bodyCount();
    for (int body = 0; body < doll.boxes * kLanes; ++body) {
        BoxLanes& boxes = state.stepBoxes[doll.firstBox + body / kLanes];
        const bool isBody = body < bodies;
        writeBox(
            boxes, body % kLanes,
            isBody ? Aabb{readVector(batch.bodies[body].low, doll.lane), readVector(batch.bodies[body].high, doll.lane)}
                   : Aabb{});
        if (isBody) state.stepBodies[doll.firstBody + body] = stepBody(state, doll, body);
    }
}

// Looks up the bodies of all dolls that are near others, once.
void placeNearDolls(CrowdState& state) {
    state.isNear.assign(state.dolls.size(), 0);
    for (const auto& [a, b] : state.dollPairs)
        state.isNear[a] = state.isNear[b] = 1;
    state.stepBodies.resize(static_cast<std::size_t>(state.bodyTotal));
    state.stepBoxes.resize(static_cast<std::size_t>(state.boxTotal));
    state.inParallel(state.dolls.size(), 32, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Doll& doll = state.dolls[i];
            if (state.isNear[i] == 0 || doll.asleep()) continue;
            placeDoll(state, doll);
        }
    });
}

// The pairs of dolls that one piece of work looks at.
constexpr std::size_t kPiece = 32;

void collidePiece(CrowdState& state, std::size_t piece, float dt, PieceTouches& out) {
    out.touches.clear();
    TouchSearch search(state, dt, out.touches);
    for (std::size_t i = piece * kPiece; i < std::min((piece + 1) * kPiece, state.dollPairs.size()); ++i) {
        const auto& [a, b] = state.dollPairs[i];
        if (!state.dolls[a].asleep() && !state.dolls[b].asleep())
            collideDolls(state, state.nearBodies[i], dt, out.near, search);
    }
    search.flush();
}

TouchBrief briefOf(const CrowdState& state, const PairTouch& touch) {
    constexpr float kNear = 0.005F;  // metres: what is nearer is likely to press
    constexpr float kDeep = 0.005F;
    return {touch.dollA,
            touch.dollB,
            state.dolls[touch.dollA].firstBody + touch.bodyA,
            state.dolls[touch.dollB].firstBody + touch.bodyB,
            touch.carried.normal > 0.0F || touch.touch.separation < kNear,
            touch.touch.separation < -kDeep};
}

// Puts lists of contacts behind those that there are, in their order. `listOf(i)` is one of `count`.
template <class ListOf>
void append(CrowdState& state, std::size_t count, const ListOf& listOf) {
    std::vector<std::size_t>& place = state.scratch.placeOfList;
    place.resize(count);
    std::size_t total = state.touches.size();
    for (std::size_t i = 0; i < count; ++i) {
        place[i] = total;
        total += listOf(i).size();
    }
    state.touches.resize(total);
    state.briefs.resize(total);
    state.inParallel(count, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            std::size_t to = place[i];
            for (const PairTouch& touch : listOf(i)) {
                state.briefs[to] = briefOf(state, touch);
                state.touches[to++] = touch;
            }
        }
    });
}

// All contacts between bodies, those within dolls first. Those between dolls are found piece by piece and joined in
// that order, so that it does not depend on the threads. A few pieces a thread are at work at a time: room for the
// contacts of all of them would be as much again as the contacts themselves.
void joinContacts(CrowdState& state, float dt) {
    constexpr std::size_t kPiecesAThread = 4;
    state.touches.clear();
    state.briefs.clear();
    append(
        state, state.active.size(), [&](std::size_t i) -> const auto& { return state.selfTouches[i]; });
    const std::size_t pieces = (state.dollPairs.size() + kPiece - 1) / kPiece;
    const auto threads = static_cast<std::size_t>(state.pool.threads());
    const std::size_t most = threads > 1 ? kPiecesAThread * threads : 1;
    state.dollTouches.resize(std::max(state.dollTouches.size(), std::min(pieces, most)));
    for (std::size_t first = 0; first < pieces; first += most) {
        const std::size_t count = std::min(pieces - first, most);
        state.inParallel(count, 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                collidePiece(state, first + i, dt, state.dollTouches[i]);
        });
        append(
            state, count, [&](std::size_t i) -> const auto& { return state.dollTouches[i].touches; });
    }
}

}  // namespace

void findContacts(CrowdState& state, float dt) {
    if (state.selfTouches.size() < state.active.size()) state.selfTouches.resize(state.active.size());
    placeNearDolls(state);
    keepNearBodies(state);
    findStruck(state);
    state.inParallel(state.active.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            Batch& batch = *state.active[i];
            const Topology& topology = state.activeGroup[i]->topology;
            findStatics(state, batch, topology, {dt, dt / static_cast<float>(batch.substeps)});
            findSelfContacts(state, batch, batch.view(topology), topology, dt, state.selfTouches[i]);
        }
    });
    joinContacts(state, dt);
}

}  // namespace lutka::physics::crowd
