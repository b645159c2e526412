#include "physics/crowd/crowd_world.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/assert.hpp"
#include "physics/crowd/bounds.hpp"
#include "physics/crowd/broadphase.hpp"
#include "physics/crowd/detect.hpp"
#include "physics/crowd/drag.hpp"
#include "physics/crowd/jobs.hpp"
#include "physics/crowd/motor.hpp"
#include "physics/crowd/reports.hpp"
#include "physics/crowd/sleep.hpp"
#include "physics/crowd/solve.hpp"
#include "physics/crowd/state.hpp"
#include "physics/crowd/substeps.hpp"
#include "physics/crowd/target.hpp"

namespace lutka::physics {
namespace crowd {
namespace {

using Clock = std::chrono::steady_clock;
using Side = ContactReport::Side;

double milliseconds(Clock::duration time) {
    return std::chrono::duration<double, std::milli>(time).count();
}

// The same call, with its time added to `total`; none for none.
std::function<void()> timed(const std::function<void()>& call, Clock::duration& total) {
    if (!call) return {};
    return [&call, &total] {
        const auto start = Clock::now();
        call();
        total += Clock::now() - start;
    };
}

class CrowdWorld final : public World {
  public:
    CrowdWorld(const WorldSettings& settings, const CrowdTuning& tuning)
        : state_(settings, tuning), ownSubsteps_(tuning.substeps) {}

    [[nodiscard]] int substepsPerStep() const override { return state_.tuning.substeps; }
    [[nodiscard]] int usualSubsteps(float dt) const override { return substepsFor(state_, dt).usual; }
    [[nodiscard]] double dragWork() const override { return state_.dragWork; }
    [[nodiscard]] double dragImpulse() const override { return state_.dragImpulse; }
    [[nodiscard]] double motorWork() const override { return state_.motorWork; }
    void getContacts(std::vector<ContactPoint>& contacts) const override;
    [[nodiscard]] std::span<const ContactReport> contactReports() const override { return state_.reports; }
    [[nodiscard]] StepTimes stepTimes() const override { return times_; }

  private:
    [[nodiscard]] const RagdollProfile& profileAt(int doll) const override { return *dollOf(doll).profile; }
    [[nodiscard]] vec3 inertiaAt(int doll, int body) const override {
        const RagdollProfile& profile = profileAt(doll);
        return conditionedInertia(profile, profile.bodies[body], state_.tuning.leastGyration);
    }
    void getBodiesAt(int doll, std::span<BodyState> bodies) const override;
    [[nodiscard]] bool isAsleepAt(int doll) const override { return dollOf(doll).asleep(); }
    [[nodiscard]] const DynamicProp& propAt(int prop) const override { return state_.propSettings[prop]; }
    [[nodiscard]] BodyState propStateAt(int prop) const override {
        return bodyState(state_, state_.dolls[state_.props[prop]], 0);
    }
    [[nodiscard]] std::optional<RayHit> castRay(const vec3& from, const vec3& to, std::uint32_t layers) const override;

    void addStaticAs(StaticId id, const StaticShape& shape) override;
    void addPropAs(PropId id, const DynamicProp& prop) override;
    void addDollAs(DollId id, const RagdollProfile& profile, std::span<const BodyState> bodies) override;
    void removeStaticAt(int fixed) override;
    void removePropAt(int prop) override;
    void removeDollAt(int doll) override;
    void advance(float dt, const std::function<void()>& afterSubstep) override;
    void useSubsteps(int substeps) override {
        state_.tuning.substeps = substeps;
        areSubstepsSet_ = true;
    }
    void setBodiesAt(int doll, std::span<const BodyState> bodies) override;
    void wakeAt(int doll) override { wakeDoll(state_.ragdolls[doll]); }
    [[nodiscard]] DollState dollStateAt(int doll) const override;
    void setDollStateAt(int doll, const DollState& state) override;
    void applyImpulseAt(int doll, int body, const vec3& impulse, const vec3& worldPoint) override;
    void applyForceAt(int doll, int body, const vec3& force, const vec3& worldPoint) override;
    void setMotorAt(int doll, int constraint, const std::optional<JointMotor>& motor) override {
        wakeAt(doll);
        crowd::setMotor(state_, state_.ragdolls[doll], constraint, motor);
    }
    void setBodyTargetAt(int doll, int body, const std::optional<BodyTarget>& target) override {
        wakeAt(doll);
        crowd::setTarget(state_, state_.ragdolls[doll], body, target);
    }
    void setDollFilterAt(int doll, const CollisionFilter& filter) override;
    [[nodiscard]] CollisionFilter dollFilterAt(int doll) const override { return dollOf(doll).filter; }
    void setPropFilterAt(int prop, const CollisionFilter& filter) override;
    void addDragTo(int doll, const Drag& drag) override;
    void setDragAt(int place, int doll, const Drag& drag) override;
    void removeDragAt(int place) override { state_.drags.erase(state_.drags.begin() + place); }

    [[nodiscard]] const Doll& dollOf(int doll) const { return state_.dolls[state_.ragdolls[doll]]; }
    // By its place in CrowdState::dolls.
    void wakeDoll(int index) {
        if (state_.dolls[index].asleep()) wakeIsland(state_, index);
        state_.dolls[index].restSeconds = 0.0F;
    }
    void wakeAll();
    void rayAgainstDoll(int index, const vec3& from, const vec3& to, std::optional<RayHit>& nearest) const;

    CrowdState state_;
    int ownSubsteps_;  // of figures that are not small
    bool areSubstepsSet_ = false;
    StepTimes times_;
};

void CrowdWorld::wakeAll() {
    for (std::size_t i = 0; i < state_.dolls.size(); ++i)
        if (state_.dolls[i].asleep() && !state_.dolls[i].removed) crowd::wake(state_, static_cast<int>(i));
}

void CrowdWorld::addStaticAs(StaticId id, const StaticShape& shape) {
    state_.statics.emplace_back(shape);
    state_.staticIds.push_back(id);
    wakeAll();
}

void CrowdWorld::removeStaticAt(int index) {
    for (std::size_t i = 0; i < state_.dolls.size(); ++i) {
        const auto& statics = state_.dolls[i].statics;
        const bool held = std::any_of(statics.begin(), statics.end(), [&](const CarriedStatic& touch) {
            return geometryOfKey(touch.contact.key) == index;
        });
        if (held && state_.dolls[i].asleep()) wakeIsland(state_, static_cast<int>(i));
    }
    state_.statics.erase(state_.statics.begin() + index);
    state_.staticIds.erase(state_.staticIds.begin() + index);
    for (Doll& doll : state_.dolls) {
        std::erase_if(doll.statics,
                      [&](const CarriedStatic& touch) { return geometryOfKey(touch.contact.key) == index; });
        for (CarriedStatic& touch : doll.statics)
            if (geometryOfKey(touch.contact.key) > index) touch.contact.key -= staticKey(0, 0, 0, 0);
    }
    state_.reports.clear();
}

void CrowdWorld::removePropAt(int prop) {
    crowd::removeDoll(state_, state_.props[prop]);
    state_.props.erase(state_.props.begin() + prop);
    state_.propSettings.erase(state_.propSettings.begin() + prop);
    state_.reports.clear();
}

void CrowdWorld::removeDollAt(int doll) {
    crowd::removeDoll(state_, state_.ragdolls[doll]);
    state_.ragdolls.erase(state_.ragdolls.begin() + doll);
    state_.reports.clear();
}

void CrowdWorld::addPropAs(PropId id, const DynamicProp& prop) {
    const int index = crowd::addDoll(state_, makeTopology(prop), nullptr, std::span(&prop.state, 1));
    state_.dolls[index].filter = prop.filter;
    state_.dolls[index].side = {Side::Kind::prop, {}, id, {}, 0};
    state_.props.push_back(index);
    state_.propSettings.push_back(prop);
}

void CrowdWorld::addDollAs(DollId id, const RagdollProfile& profile, std::span<const BodyState> bodies) {
    const int index = crowd::addDoll(state_, makeTopology(profile, state_.tuning.leastGyration), &profile, bodies);
    state_.dolls[index].side = {Side::Kind::doll, id, {}, {}, 0};
    state_.ragdolls.push_back(index);
    if (!state_.settings.substeps && !areSubstepsSet_) {
        const float wanted = std::ceil(static_cast<float>(ownSubsteps_) / state_.dolls[index].pace);
        state_.tuning.substeps = std::max(state_.tuning.substeps, static_cast<int>(wanted));
    }
}

void CrowdWorld::advance(float dt, const std::function<void()>& afterSubstep) {
    for (const DragRecord& record : state_.drags)
        wakeDoll(record.doll);
    for (const TargetRecord& record : state_.targets)
        wakeDoll(record.doll);
    gatherActive(state_);
    state_.stepSubsteps = substepsFor(state_, dt);
    placeTargets(state_, dt / static_cast<float>(state_.stepSubsteps.usual));
    state_.reports.clear();
    if (state_.active.empty()) {  // all asleep: nothing can change
        times_ = {};
        for (int i = 0; afterSubstep && i < substepsPerStep(); ++i)
            afterSubstep();
        return;
    }
    const auto start = Clock::now();
    findBounds(state_, dt);
    sweepDolls(state_, dt);
    wakeTouched(state_, dt);
    const auto paired = Clock::now();
    findContacts(state_, dt);
    const auto found = Clock::now();
    makeJobs(state_);
    placeDrags(state_, dt);
    placeMotors(state_, dt);
    beginReports(state_);
    Clock::duration outside{0};
    solveJobs(state_, dt, timed(afterSubstep, outside));
    makeReports(state_);
    keepImpulses(state_);
    state_.forces.clear();
    settle(state_, dt);
    times_ = {milliseconds(paired - start), milliseconds(found - paired), milliseconds(Clock::now() - found - outside),
              static_cast<int>(state_.jobs.size())};
}

void CrowdWorld::getBodiesAt(int doll, std::span<BodyState> bodies) const {
    const Doll& from = dollOf(doll);
    if (from.asleep())
        std::copy(from.frozen.begin(), from.frozen.end(), bodies.begin());
    else
        readLane(state_.batchOf(from), from.lane, bodies);
}

void CrowdWorld::setBodiesAt(int doll, std::span<const BodyState> bodies) {
    wakeAt(doll);
    Doll& to = state_.dolls[state_.ragdolls[doll]];
    Batch& batch = state_.batchOf(to);
    writeLane(batch, to.lane, bodies);
    clearImpulses(batch, to.lane);
    state_.kernels->refresh(batch.view(state_.groupOf(to).topology));
    awaken(batch.rest, to.lane);
    to.statics.clear();
    to.restSeconds = 0.0F;
}

void CrowdWorld::applyImpulseAt(int doll, int body, const vec3& impulse, const vec3& worldPoint) {
    wakeAt(doll);
    Doll& to = state_.dolls[state_.ragdolls[doll]];
    to.restSeconds = 0.0F;
    BodyLanes& lanes = state_.batchOf(to).bodies[body];
    const BodyConstants& constants = state_.groupOf(to).topology.bodies[body];
    const vec3 inverseInertia(constants.inverseInertia[0], constants.inverseInertia[1], constants.inverseInertia[2]);
    const BodyState before = readBody(lanes, to.lane);
    const quat& rotation = before.worldFromBody.rotation;
    const vec3 torque = glm::cross(worldPoint - before.worldFromBody.translation, impulse);
    const vec3 turned = rotation * ((glm::conjugate(rotation) * torque) * inverseInertia);
    writeVector(lanes.velocity, to.lane, before.linearVelocity + impulse * constants.inverseMass);
    writeVector(lanes.angular, to.lane, before.angularVelocity + turned);
}

void CrowdWorld::applyForceAt(int doll, int body, const vec3& force, const vec3& worldPoint) {
    wakeAt(doll);
    const int index = state_.ragdolls[doll];
    const RigidTransform worldFromBody = bodyState(state_, state_.dolls[index], body).worldFromBody;
    state_.forces.push_back({index, body, force, inverse(worldFromBody) * worldPoint});
}

DollState CrowdWorld::dollStateAt(int doll) const {
    const Doll& from = dollOf(doll);
    DollState state;
    state.bodies.resize(from.profile->bodies.size());
    getBodiesAt(doll, state.bodies);
    state.filter = from.filter;
    for (std::size_t i = 0; i < from.profile->constraints.size(); ++i) {
        const MotorRecord* motor = findMotor(state_, state_.ragdolls[doll], static_cast<int>(i));
        state.motors.push_back(motor != nullptr ? std::optional(motor->motor) : std::nullopt);
    }
    state.restSeconds = from.restSeconds;
    state.asleep = from.asleep();
    return state;
}

void CrowdWorld::setDollStateAt(int doll, const DollState& state) {
    setBodiesAt(doll, state.bodies);
    const int index = state_.ragdolls[doll];
    Doll& to = state_.dolls[index];
    to.filter = state.filter;
    for (std::size_t i = 0; i < state.motors.size(); ++i)
        crowd::setMotor(state_, index, static_cast<int>(i), state.motors[i]);
    to.restSeconds = state.restSeconds;
    if (!state.asleep || !state_.settings.sleeping) return;
    putToSleep(state_, index);
    to.island = state_.nextIsland++;
}

void CrowdWorld::rayAgainstDoll(int index, const vec3& from, const vec3& to, std::optional<RayHit>& nearest) const {
    const Doll& doll = state_.dolls[index];
    const bool isDoll = doll.profile != nullptr;
    for (int body = 0; body < state_.groupOf(doll).topology.bodyCount(); ++body) {
        for (int shape = 0; shape < state_.groupOf(doll).topology.shapeCount(body); ++shape) {
            const RayTouch touch = rayAgainst(placedShape(state_, doll, body, shape), from, to);
            if (touch.fraction > 1.0F || (nearest && touch.fraction >= nearest->fraction)) continue;
            nearest = RayHit{doll.side.doll, isDoll ? body : -1, from + touch.fraction * (to - from), touch.normal,
                             touch.fraction};
        }
    }
}

std::optional<RayHit> CrowdWorld::castRay(const vec3& from, const vec3& to, std::uint32_t layers) const {
    std::optional<RayHit> nearest;
    for (const PlacedStatic& geometry : state_.statics) {
        if ((geometry.shape.filter.layers & layers) == 0) continue;
        const RayTouch touch = rayAgainst(geometry, from, to);
        if (touch.fraction > 1.0F || (nearest && touch.fraction >= nearest->fraction)) continue;
        nearest = RayHit{{}, -1, from + touch.fraction * (to - from), touch.normal, touch.fraction};
    }
    for (std::size_t i = 0; i < state_.dolls.size(); ++i)
        if (!state_.dolls[i].removed && (state_.dolls[i].filter.layers & layers) != 0)
            rayAgainstDoll(static_cast<int>(i), from, to, nearest);
    return nearest;
}

void CrowdWorld::setDollFilterAt(int doll, const CollisionFilter& filter) {
    wakeAt(doll);
    state_.dolls[state_.ragdolls[doll]].filter = filter;
}

void CrowdWorld::setPropFilterAt(int prop, const CollisionFilter& filter) {
    state_.propSettings[prop].filter = filter;
    if (state_.dolls[state_.props[prop]].asleep()) wakeIsland(state_, state_.props[prop]);
    state_.dolls[state_.props[prop]].filter = filter;
}

void CrowdWorld::addDragTo(int doll, const Drag& drag) {
    const int index = state_.ragdolls[doll];
    state_.drags.push_back({index, drag, true, 0, vec3(0)});
    wakeDoll(index);
}

void CrowdWorld::setDragAt(int place, int doll, const Drag& drag) {
    DragRecord& record = state_.drags[place];
    record.doll = state_.ragdolls[doll];
    record.drag = drag;
    wakeDoll(record.doll);
}

void CrowdWorld::getContacts(std::vector<ContactPoint>& contacts) const {
    for (const Doll& doll : state_.dolls) {
        for (const CarriedStatic& touch : doll.statics) {
            const RigidTransform worldFromBody = bodyState(state_, doll, touch.body).worldFromBody;
            const vec3 core = worldFromBody * touch.local;
            const float distance = glm::dot(touch.normal, core) - touch.offset - touch.radius;
            contacts.push_back({core - touch.normal * (touch.radius + distance), touch.normal, distance});
        }
    }
    for (const PairTouch& touch : state_.touches) {
        if (touch.carried.normal <= 0.0F) continue;
        const Doll& b = state_.dolls[touch.dollB];
        const vec3 core = bodyState(state_, b, touch.bodyB).worldFromBody * touch.touch.localB;
        const PrimitiveShape& shape = state_.groupOf(b).topology.shapeOf(touch.bodyB, touch.shapeB);
        const float radius = shape.isAngular() ? 0.0F : shape.radius;
        contacts.push_back({core + touch.touch.normal * radius, touch.touch.normal, touch.touch.separation});
    }
}

}  // namespace
}  // namespace crowd

std::unique_ptr<World> createCrowdWorld(const WorldSettings& settings, const crowd::CrowdTuning& tuning) {
    // A share lost in a second is a rate: speed · (1 - share)^t = speed · exp(-rate t).
    const auto rate = [](float share) { return -std::log1p(-share); };
    crowd::CrowdTuning tuned = tuning;
    tuned.substeps = settings.substeps.value_or(tuning.substeps);
    tuned.passes = settings.iterations.value_or(tuning.passes);
    if (settings.linearDamping) tuned.linearDamping = rate(*settings.linearDamping);
    if (settings.angularDamping) tuned.angularDamping = rate(*settings.angularDamping);
    return std::make_unique<crowd::CrowdWorld>(settings, tuned);
}

}  // namespace lutka::physics
