#include "physics/crowd/detect.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace lutka::physics::crowd {
namespace {

// Bullet's default for a body; as there, the friction of a contact is the product of both sides'.
constexpr float kBodyFriction = 0.5F;
// Predicted motion counts a little more than whole: limbs speed up within a step.
constexpr float kForesight = 1.2F;

bool meet(const vec3& lowA, const vec3& highA, const vec3& lowB, const vec3& highB) {
    return lowA.x <= highB.x && lowB.x <= highA.x && lowA.y <= highB.y && lowB.y <= highA.y && lowA.z <= highB.z &&
           lowB.z <= highA.z;
}

float speedBound(const BodyState& body, const BodyConstants& constants) {
    return glm::length(body.linearVelocity) + glm::length(body.angularVelocity) * constants.reach;
}

// How near two bodies must be for a contact.
float pairRange(const CrowdState& state, const Doll& a, int bodyA, const Doll& b, int bodyB, float dt) {
    const BodyState moveA = bodyState(state, a, bodyA);
    const BodyState moveB = bodyState(state, b, bodyB);
    const float turning = glm::length(moveA.angularVelocity) * state.groupOf(a).topology.bodies[bodyA].reach +
                          glm::length(moveB.angularVelocity) * state.groupOf(b).topology.bodies[bodyB].reach;
    return state.tuning.pairMargin +
           kForesight * dt * (glm::length(moveA.linearVelocity - moveB.linearVelocity) + turning);
}

std::uint64_t pairKey(const Doll& a, int bodyA, const Doll& b, int bodyB, int index) {
    const auto first = static_cast<std::uint64_t>(a.firstBody) + static_cast<std::uint64_t>(bodyA) + 1;
    const auto second = static_cast<std::uint64_t>(b.firstBody) + static_cast<std::uint64_t>(bodyB) + 1;
    return first << 34U | second << 4U | static_cast<std::uint64_t>(index);
}

void collide(const CrowdState& state, int dollA, int bodyA, int dollB, int bodyB, float dt,
             std::vector<PairTouch>& out) {
    const Doll& a = state.dolls[dollA];
    const Doll& b = state.dolls[dollB];
    const Touches<BodyTouch> found = touchBodies(placedShape(state, a, bodyA), placedShape(state, b, bodyB),
                                                 pairRange(state, a, bodyA, b, bodyB, dt));
    for (int i = 0; i < found.count; ++i) {
        PairTouch touch{dollA, bodyA, dollB, bodyB, found.points[i], {}};
        const std::uint64_t key = pairKey(a, bodyA, b, bodyB, i);
        if (const CarriedContact* carried = state.carried.find(key)) touch.carried = *carried;
        touch.carried.key = key;
        out.push_back(touch);
    }
}

void boundsOfBatch(CrowdState& state, Batch& batch, const Topology& topology, float dt) {
    const BatchView view = batch.view(topology);
    state.kernels->findBounds(view, dt, state.tuning.pairMargin);
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

// A doll's bounds in the world's frame: those seen from the root, and the root's own motion.
struct Bounds {
    vec3 low, high;
};
Bounds worldBounds(const Doll& doll, float dt, float farther = 0.0F) {
    const vec3 moved = farther + (doll.asleep() ? vec3(0) : glm::abs(doll.rootVelocity) * (kForesight * dt));
    return {doll.low - moved, doll.high + moved};
}

bool nearStatic(const PlacedStatic& geometry, const vec3& low, const vec3& high) {
    if (geometry.shape.kind == StaticShape::Kind::box) return meet(low, high, geometry.low, geometry.high);
    const vec3 normal = geometry.axes[1];
    const vec3 lowest(normal.x > 0 ? low.x : high.x, normal.y > 0 ? low.y : high.y, normal.z > 0 ? low.z : high.z);
    return glm::dot(normal, lowest - geometry.shape.worldFromShape.translation) <= 0.0F;
}

// Puts a contact into a lane; the lanes without a doll repeat lane 0.
void setContact(StaticContactLanes& contact, int lane, const StaticTouch& touch, float friction,
                const CarriedStatic& carried) {
    writeVector(contact.localPoint, lane, touch.local);
    contact.radius.lane[lane] = touch.radius;
    writeVector(contact.normal, lane, touch.normal);
    contact.offset.lane[lane] = touch.offset;
    contact.friction.lane[lane] = friction;
    contact.normalImpulse.lane[lane] = carried.contact.normal;
    writeVector(contact.frictionImpulse, lane, carried.contact.friction);
    writeVector(contact.rollImpulse, lane, carried.roll);
    contact.key[lane] = carried.contact.key;
}

CarriedStatic carriedStatic(const Doll& doll, std::uint64_t key) {
    for (const CarriedStatic& carried : doll.statics)
        if (carried.contact.key == key) return carried;
    CarriedStatic fresh;
    fresh.contact.key = key;
    return fresh;
}

// The static contacts of one batch: body by body, each lane's next contact into the next of the body's slots.
class StaticContacts {
  public:
    StaticContacts(CrowdState& state, Batch& batch, const Topology& topology, float dt)
        : state_(state), batch_(batch), topology_(topology), dt_(dt) {}

    void find() {
        batch_.contacts.clear();
        for (int lane = 0; lane < batch_.used; ++lane) {
            const Bounds bounds = worldBounds(state_.dolls[batch_.doll[lane]], dt_, farther_);
            for (int i = 0; i < static_cast<int>(state_.statics.size()); ++i) {
                if (nearStatic(state_.statics[i], bounds.low, bounds.high)) near_[lane].push_back(i);
            }
        }
        for (int body = 0; body < topology_.bodyCount(); ++body) {
            firstSlot_ = batch_.contacts.size();
            batch_.firstContact[body] = static_cast<int>(firstSlot_);
            for (int lane = 0; lane < batch_.used; ++lane)
                findOf(body, lane);
        }
        batch_.firstContact[topology_.bodyCount()] = static_cast<int>(batch_.contacts.size());
    }

  private:
    void findOf(int body, int lane) {
        if (near_[lane].empty()) return;
        const Doll& doll = state_.dolls[batch_.doll[lane]];
        const BodyLanes& lanes = batch_.bodies[body];
        const vec3 moved = glm::abs(doll.rootVelocity) * (kForesight * dt_) + farther_;
        const vec3 low = readVector(lanes.low, lane) - moved;
        const vec3 high = readVector(lanes.high, lane) + moved;
        std::size_t slot = firstSlot_;
        for (const int index : near_[lane]) {
            const PlacedStatic& geometry = state_.statics[index];
            if (!nearStatic(geometry, low, high)) continue;
            const float range = state_.tuning.staticMargin +
                                kForesight * dt_ * speedBound(readBody(lanes, lane), topology_.bodies[body]);
            const Touches<StaticTouch> found = touchStatic(placedShape(state_, doll, body), geometry, range);
            for (int i = 0; i < found.count; ++i)
                put(slot++, body, lane, index, found.points[i]);
        }
    }

    void put(std::size_t slot, int body, int lane, int geometry, const StaticTouch& touch) {
        if (slot == batch_.contacts.size()) {
            batch_.contacts.emplace_back();
            batch_.contacts.back().body = body;
            for (int i = 0; i < kLanes; ++i)
                setContact(batch_.contacts.back(), i, {{}, 0, {0, 1, 0}, -kFarM, 0, 0}, 0.0F, {});
        }
        const std::uint64_t key = (static_cast<std::uint64_t>(geometry + 1) << 20U) |
                                  static_cast<std::uint64_t>(body) << 4U | static_cast<std::uint64_t>(touch.feature);
        const CarriedStatic carried = carriedStatic(state_.dolls[batch_.doll[lane]], key);
        const float friction = state_.statics[geometry].shape.friction * kBodyFriction;
        setContact(batch_.contacts[slot], lane, touch, friction, carried);
        if (lane != 0) return;
        for (int copy = batch_.used; copy < kLanes; ++copy)
            setContact(batch_.contacts[slot], copy, touch, friction, carried);
    }

    static constexpr float kFarM = 1e6F;

    CrowdState& state_;
    Batch& batch_;
    const Topology& topology_;
    float dt_;
    float farther_ = state_.tuning.staticMargin - state_.tuning.pairMargin;  // than the bodies' own bounds reach
    std::size_t firstSlot_ = 0;
    std::vector<int> near_[kLanes];
};

void findSelfContacts(CrowdState& state, const Batch& batch, const BatchView& view, const Topology& topology, float dt,
                      std::vector<PairTouch>& out) {
    out.clear();
    const std::vector<SelfPair>& pairs = topology.selfPairs;
    std::vector<unsigned char> masks(pairs.size());
    state.kernels->findSelfPairs(view, pairs.data(), static_cast<int>(pairs.size()), masks.data());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        for (int lane = 0; masks[i] != 0 && lane < batch.used; ++lane) {
            if ((masks[i] >> static_cast<unsigned>(lane) & 1U) == 0) continue;
            collide(state, batch.doll[lane], pairs[i].a, batch.doll[lane], pairs[i].b, dt, out);
        }
    }
}

// The bodies of `doll` whose boxes meet other's bounds, `apart` being how far the two roots move against each other.
struct BodyBox {
    int body;
    vec3 low, high;
};
void bodiesNear(const CrowdState& state, const Doll& doll, const Doll& other, const vec3& apart,
                std::vector<BodyBox>& out) {
    out.clear();
    for (int body = 0; body < state.groupOf(doll).topology.bodyCount(); ++body) {
        const BodyLanes& lanes = state.batchOf(doll).bodies[body];
        const vec3 low = readVector(lanes.low, doll.lane);
        const vec3 high = readVector(lanes.high, doll.lane);
        if (meet(low, high, other.low - apart, other.high + apart)) out.push_back({body, low, high});
    }
}

void collideDolls(const CrowdState& state, int indexA, int indexB, float dt, std::vector<PairTouch>& out) {
    const Doll& a = state.dolls[indexA];
    const Doll& b = state.dolls[indexB];
    const vec3 apart = glm::abs(a.rootVelocity - b.rootVelocity) * (kForesight * dt);
    thread_local std::vector<BodyBox> nearA;
    thread_local std::vector<BodyBox> nearB;
    bodiesNear(state, a, b, apart, nearA);
    if (nearA.empty()) return;
    bodiesNear(state, b, a, apart, nearB);
    for (const BodyBox& x : nearA) {
        for (const BodyBox& y : nearB) {
            if (meet(x.low - apart, x.high + apart, y.low, y.high))
                collide(state, indexA, x.body, indexB, y.body, dt, out);
        }
    }
}

// Whether an awake doll is about to push a sleeping one.
bool pushes(const CrowdState& state, const Doll& mover, const Doll& sleeper, float dt) {
    constexpr float kPushSpeed = 0.02F;  // m/s: what only leans is left to lie
    constexpr float kOverlap = 0.01F;    // metres
    for (int i = 0; i < state.groupOf(mover).topology.bodyCount(); ++i) {
        const BodyState move = bodyState(state, mover, i);
        const PlacedShape placed = placedShape(state, mover, i);
        for (int j = 0; j < state.groupOf(sleeper).topology.bodyCount(); ++j) {
            const float range = pairRange(state, mover, i, sleeper, j, dt);
            const Touches<BodyTouch> found = touchBodies(placed, placedShape(state, sleeper, j), range);
            for (int k = 0; k < found.count; ++k) {
                const BodyTouch& touch = found.points[k];
                const vec3 arm = placed.axes * touch.localA;
                const float closing =
                    -glm::dot(touch.normal, move.linearVelocity + glm::cross(move.angularVelocity, arm));
                if (touch.separation < -kOverlap) return true;
                if (closing > kPushSpeed && touch.separation < closing * dt) return true;
            }
        }
    }
    return false;
}

}  // namespace

void findBounds(CrowdState& state, float dt) {
    state.pool.parallelFor(state.active.size(), 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            boundsOfBatch(state, *state.active[i], state.activeGroup[i]->topology, dt);
    });
}

void sweepDolls(CrowdState& state, float dt) {
    state.dollPairs.clear();
    std::vector<Bounds> bounds(state.dolls.size());
    for (std::size_t i = 0; i < bounds.size(); ++i)
        bounds[i] = worldBounds(state.dolls[i], dt);
    // Nearly sorted from the step before.
    for (std::size_t i = 1; i < state.sweep.size(); ++i) {
        const int moving = state.sweep[i];
        std::size_t to = i;
        for (; to > 0 && bounds[state.sweep[to - 1]].low.x > bounds[moving].low.x; --to)
            state.sweep[to] = state.sweep[to - 1];
        state.sweep[to] = moving;
    }
    for (std::size_t i = 0; i < state.sweep.size(); ++i) {
        const int a = state.sweep[i];
        for (std::size_t k = i + 1; k < state.sweep.size(); ++k) {
            const int b = state.sweep[k];
            if (bounds[b].low.x > bounds[a].high.x) break;
            if (state.dolls[a].asleep() && state.dolls[b].asleep()) continue;
            if (meet(bounds[a].low, bounds[a].high, bounds[b].low, bounds[b].high))
                state.dollPairs.push_back(std::minmax(a, b));
        }
    }
    std::sort(state.dollPairs.begin(), state.dollPairs.end());
}

void wakeTouched(CrowdState& state, float dt) {
    for (bool woken = true; woken;) {
        woken = false;
        for (const auto& [first, second] : state.dollPairs) {
            const bool firstSleeps = state.dolls[first].asleep();
            if (firstSleeps == state.dolls[second].asleep()) continue;
            const int sleeper = firstSleeps ? first : second;
            const int mover = firstSleeps ? second : first;
            if (!pushes(state, state.dolls[mover], state.dolls[sleeper], dt)) continue;
            wakeIsland(state, sleeper);
            woken = true;
        }
        if (!woken) return;
        gatherActive(state);
        findBounds(state, dt);
        sweepDolls(state, dt);
    }
}

void findContacts(CrowdState& state, float dt) {
    if (state.selfTouches.size() < state.active.size()) state.selfTouches.resize(state.active.size());
    state.pool.parallelFor(state.active.size(), 2, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            Batch& batch = *state.active[i];
            const Topology& topology = state.activeGroup[i]->topology;
            StaticContacts(state, batch, topology, dt).find();
            findSelfContacts(state, batch, batch.view(topology), topology, dt, state.selfTouches[i]);
        }
    });
    state.touches.clear();
    for (std::size_t i = 0; i < state.active.size(); ++i)
        state.touches.insert(state.touches.end(), state.selfTouches[i].begin(), state.selfTouches[i].end());
    for (const auto& [a, b] : state.dollPairs) {
        if (!state.dolls[a].asleep() && !state.dolls[b].asleep()) collideDolls(state, a, b, dt, state.touches);
    }
}

}  // namespace lutka::physics::crowd
