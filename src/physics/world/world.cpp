#include "physics/world/world.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "physics/world/joint_spring.hpp"

namespace lutka::physics {
namespace {

bool isAtLeastZero(float value) {
    return std::isfinite(value) && value >= 0.0F;
}
bool isPositive(float value) {
    return std::isfinite(value) && value > 0.0F;
}

bool hasSize(const PrimitiveShape& shape) {
    switch (shape.kind) {
        case PrimitiveShape::Kind::box:
            return isPositive(shape.halfExtents.x) && isPositive(shape.halfExtents.y) &&
                   isPositive(shape.halfExtents.z);
        case PrimitiveShape::Kind::hull:
            return shape.hull != nullptr;
        case PrimitiveShape::Kind::capsule:
            return isPositive(shape.radius) && isAtLeastZero(shape.halfLength);
        case PrimitiveShape::Kind::sphere:
            break;
    }
    return isPositive(shape.radius);
}

bool hasSize(const StaticShape& shape) {
    switch (shape.kind) {
        case ShapeKind::box:
            return isAtLeastZero(shape.halfExtents.x) && isAtLeastZero(shape.halfExtents.y) &&
                   isAtLeastZero(shape.halfExtents.z);
        case ShapeKind::capsule:
            return isAtLeastZero(shape.radius) && isAtLeastZero(shape.halfLength);
        case ShapeKind::sphere:
            return isAtLeastZero(shape.radius);
        case ShapeKind::plane:
        case ShapeKind::hull:
        case ShapeKind::mesh:
            break;
    }
    return true;
}

}  // namespace

std::string_view faultOf(const StaticShape& shape) {
    if (!isFinite(shape.worldFromShape) || !isAtLeastZero(shape.friction) || !hasSize(shape))
        return "place, size or friction is not finite or below 0";
    if (shape.kind == ShapeKind::hull) return "a convex hull is a shape of bodies";
    if (shape.kind == ShapeKind::mesh && shape.mesh == nullptr) return "the mesh is null";
    return {};
}

std::string_view faultOf(const DynamicProp& prop) {
    if (!isFinite(prop.state) || !isPositive(prop.massKg)) return "the state is not finite or the mass not above 0";
    const auto& more = prop.shape.more;
    const bool isSound = hasSize(prop.shape) && more.size() <= BodyShape::kMostAdded &&
                         std::all_of(more.begin(), more.end(), [](const AddedShape& added) {
                             return hasSize(added) && isFinite(added.bodyFromShape);
                         });
    return isSound ? "" : "the shape has no size";
}

bool World::hasBody(std::string_view call, int doll, int body) const {
    const int count = static_cast<int>(profileOf(dolls()[doll]).bodies.size());
    if (body >= 0 && body < count) return true;
    refuse(call, fmt::format("body {} of a doll with {} bodies", body, count));
    return false;
}

bool World::areSound(std::string_view call, const RagdollProfile& profile, std::span<const BodyState> bodies) const {
    if (bodies.size() != profile.bodies.size()) {
        refuse(call, fmt::format("{} states for {} bodies", bodies.size(), profile.bodies.size()));
        return false;
    }
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (isFinite(bodies[i])) continue;
        refuse(call, fmt::format("the state of body {} ({}) is not finite", i, profile.bodies[i].joint));
        return false;
    }
    return true;
}

bool World::isSound(std::string_view call, const std::optional<JointMotor>& motor) const {
    if (!motor ||
        (isFinite(motor->target) && std::isfinite(motor->angle) && isFinite(motor->rate) &&
         isAtLeastZero(motor->stiffness) && isAtLeastZero(motor->damping) && isAtLeastZero(motor->maxTorqueNm)))
        return true;
    refuse(call, "a number of the motor is not finite or below 0");
    return false;
}

StaticId World::addStatic(const StaticShape& shape) {
    if (const std::string_view fault = faultOf(shape); !fault.empty()) {
        refuse("addStatic", fault);
        return {};
    }
    const StaticId id = staticIds_.add();
    addStaticAs(id, shape);
    return id;
}

PropId World::addProp(const DynamicProp& prop) {
    if (const std::string_view fault = faultOf(prop); !fault.empty()) {
        refuse("addProp", fault);
        return {};
    }
    const PropId id = propIds_.add();
    addPropAs(id, prop);
    return id;
}

DollId World::addDoll(const RagdollProfile& profile, std::span<const BodyState> bodies) {
    if (profile.bodies.empty()) {
        refuse("addDoll", "the profile has no bodies");
        return {};
    }
    if (!areSound("addDoll", profile, bodies)) return {};
    const DollId id = dollIds_.add();
    addDollAs(id, profile, bodies);
    const int place = dollIds_.placeOf(id);
    for (std::size_t i = 0; i < profile.constraints.size(); ++i)
        if (const auto spring = motorOf(profile.constraints[i].spring)) setMotorAt(place, static_cast<int>(i), spring);
    guard_.add(id, profile, bodies);
    return id;
}

void World::removeStatic(StaticId fixed) {
    const int place = checked("removeStatic", fixed);
    if (place < 0) return;
    removeStaticAt(place);
    staticIds_.remove(fixed);
}

void World::removeProp(PropId prop) {
    const int place = checked("removeProp", prop);
    if (place < 0) return;
    removePropAt(place);
    propIds_.remove(prop);
}

void World::removeDoll(DollId doll) {
    const int place = checked("removeDoll", doll);
    if (place < 0) return;
    for (const DragId drag : dragsOf(doll))
        removeDrag(drag);
    removeDollAt(place);
    guard_.remove(place);
    dollIds_.remove(doll);
}

void World::step(float dt, const std::function<void()>& afterSubstep) {
    if (!std::isfinite(dt) || dt <= 0.0F) {
        refuse("step", fmt::format("a step of {} s", dt));
        return;
    }
    const int count = dollIds_.count();
    for (int doll = 0; doll < count; ++doll) {
        if (guard_.knows(doll)) continue;
        const std::span<BodyState> bodies = guard_.scratch(doll);
        getBodiesAt(doll, bodies);
        guard_.begin(doll, bodies);
    }
    advance(dt, afterSubstep);
    seconds_ += static_cast<double>(dt);
    for (int doll = 0; doll < count; ++doll) {
        if (isAsleepAt(doll)) continue;
        const std::span<BodyState> bodies = guard_.scratch(doll);
        getBodiesAt(doll, bodies);
        if (!guard_.judge(doll, bodies, seconds_)) putBack(doll);
    }
}

void World::putBack(int doll) {
    DollState state = dollStateAt(doll);
    const std::span<const BodyState> good = guard_.goodState(doll);
    for (std::size_t i = 0; i < good.size(); ++i)
        state.bodies[i] = {good[i].worldFromBody, vec3(0), vec3(0)};
    state.restSeconds = 0.0F;
    state.asleep = true;
    setDollStateAt(doll, state);
    guard_.touch(doll);
}

void World::setSubsteps(int substeps) {
    if (substeps < 1)
        refuse("setSubsteps", fmt::format("{} substeps", substeps));
    else
        useSubsteps(substeps);
}

void World::setBodies(DollId doll, std::span<const BodyState> bodies) {
    const int place = checked("setBodies", doll);
    if (place >= 0 && areSound("setBodies", profileOf(doll), bodies)) {
        setBodiesAt(place, bodies);
        guard_.touch(place);
    }
}

void World::wake(DollId doll) {
    const int place = checked("wake", doll);
    if (place >= 0) wakeAt(place);
}

DollState World::dollState(DollId doll) const {
    const int place = checked("dollState", doll);
    return place < 0 ? DollState{} : dollStateAt(place);
}

void World::setDollState(DollId doll, const DollState& state) {
    constexpr std::string_view call = "setDollState";
    const int place = checked(call, doll);
    if (place < 0 || !areSound(call, profileOf(doll), state.bodies)) return;
    if (state.motors.size() != profileOf(doll).constraints.size()) {
        refuse(call,
               fmt::format("{} motors for {} constraints", state.motors.size(), profileOf(doll).constraints.size()));
        return;
    }
    for (const auto& motor : state.motors)
        if (!isSound(call, motor)) return;
    if (!isAtLeastZero(state.restSeconds)) {
        refuse(call, "the time at rest is not finite or below 0");
        return;
    }
    if (const auto sprung = withSprings(profileOf(doll), state))
        setDollStateAt(place, *sprung);
    else
        setDollStateAt(place, state);
    guard_.touch(place);
}

void World::applyImpulse(DollId doll, int body, const vec3& impulse, const vec3& worldPoint) {
    constexpr std::string_view call = "applyImpulse";
    const int place = checked(call, doll);
    if (place < 0 || !hasBody(call, place, body)) return;
    if (!isFinite(impulse) || !isFinite(worldPoint)) {
        refuse(call, "impulse or point is not finite");
        return;
    }
    impulseWork_ += workOfImpulse(place, body, impulse, worldPoint);
    applyImpulseAt(place, body, impulse, worldPoint);
    guard_.touch(place);
}

// What a free rigid body gains: the impulse times the mean of the point's velocities before and after it.
double World::workOfImpulse(int doll, int body, const vec3& impulse, const vec3& worldPoint) {
    const DollId id = dolls()[doll];
    const BodyProfile& hit = profileOf(id).bodies[body];
    hit_.resize(profileOf(id).bodies.size());
    getBodies(id, hit_);
    const BodyState& before = hit_[body];
    const quat& rotation = before.worldFromBody.rotation;
    const vec3 arm = worldPoint - before.worldFromBody.translation;
    const vec3 torque = glm::conjugate(rotation) * glm::cross(arm, impulse);
    const vec3 speed = before.linearVelocity + glm::cross(before.angularVelocity, arm);
    const float gained = glm::dot(impulse, impulse) / hit.massKg + glm::dot(torque, torque / inertiaOf(id, body));
    return static_cast<double>(glm::dot(impulse, speed) + 0.5F * gained);
}

void World::applyForce(DollId doll, int body, const vec3& force, const vec3& worldPoint) {
    constexpr std::string_view call = "applyForce";
    const int place = checked(call, doll);
    if (place < 0 || !hasBody(call, place, body)) return;
    if (isFinite(force) && isFinite(worldPoint))
        applyForceAt(place, body, force, worldPoint);
    else
        refuse(call, "force or point is not finite");
}

void World::setMotor(DollId doll, int constraint, const std::optional<JointMotor>& motor) {
    constexpr std::string_view call = "setMotor";
    const int place = checked(call, doll);
    if (place < 0 || !isSound(call, motor)) return;
    const int count = static_cast<int>(profileOf(doll).constraints.size());
    if (constraint >= 0 && constraint < count)
        setMotorAt(place, constraint, motor ? motor : motorOf(profileOf(doll).constraints[constraint].spring));
    else
        refuse(call, fmt::format("constraint {} of a doll with {}", constraint, count));
}

void World::setBodyTarget(DollId doll, int body, const std::optional<BodyTarget>& target) {
    constexpr std::string_view call = "setBodyTarget";
    const int place = checked(call, doll);
    if (place < 0 || !hasBody(call, place, body)) return;
    const bool sound =
        !target || (isFinite(target->worldFromBody) && isFinite(target->linearVelocity) &&
                    isFinite(target->angularVelocity) && target->weight > 0.0F && target->weight <= 1.0F);
    if (sound)
        setBodyTargetAt(place, body, target);
    else
        refuse(call, "the target's frame is not finite or its weight not in (0, 1]");
}

void World::setDollFilter(DollId doll, const CollisionFilter& filter) {
    const int place = checked("setDollFilter", doll);
    if (place >= 0) setDollFilterAt(place, filter);
}

CollisionFilter World::dollFilter(DollId doll) const {
    const int place = checked("dollFilter", doll);
    return place < 0 ? CollisionFilter{} : dollFilterAt(place);
}

void World::setPropFilter(PropId prop, const CollisionFilter& filter) {
    const int place = checked("setPropFilter", prop);
    if (place >= 0) setPropFilterAt(place, filter);
}

// The place of the drag's doll; -1: refused.
int World::checkedDoll(std::string_view call, const Drag& drag) const {
    const int doll = checked(call, drag.doll);
    if (doll < 0 || !hasBody(call, doll, drag.body)) return -1;
    if (isFinite(drag.bodyPoint) && isFinite(drag.worldTarget) && isFinite(drag.worldVelocity) &&
        isAtLeastZero(drag.maxForceN))
        return doll;
    refuse(call, "a point or velocity is not finite or the force not at least 0");
    return -1;
}

int World::checkedDrag(std::string_view call, DragId id) const {
    const int place = dragIds_.placeOf(id);
    if (place < 0) refuse(call, fmt::format("drag {} (generation {}) is not in this world", id.index, id.generation));
    return place;
}

DragId World::addDrag(const Drag& drag) {
    const int doll = checkedDoll("addDrag", drag);
    if (doll < 0) return {};
    drags_.push_back(drag);
    addDragTo(doll, drag);
    return dragIds_.add();
}

void World::setDrag(DragId id, const Drag& drag) {
    const int place = checkedDrag("setDrag", id);
    const int doll = place < 0 ? -1 : checkedDoll("setDrag", drag);
    if (doll < 0) return;
    drags_[place] = drag;
    setDragAt(place, doll, drag);
}

void World::removeDrag(DragId id) {
    const int place = checkedDrag("removeDrag", id);
    if (place < 0) return;
    removeDragAt(place);
    drags_.erase(drags_.begin() + place);
    dragIds_.remove(id);
}

std::vector<DragId> World::dragsOf(DollId doll) const {
    std::vector<DragId> found;
    for (std::size_t i = 0; i < drags_.size(); ++i)
        if (drags_[i].doll == doll) found.push_back(drags()[i]);
    return found;
}

bool World::isDragged(DollId doll) const {
    return std::any_of(drags_.begin(), drags_.end(), [&](const Drag& drag) { return drag.doll == doll; });
}

Drag World::dragOf(DragId id) const {
    const int place = checkedDrag("dragOf", id);
    return place < 0 ? Drag{} : drags_[place];
}

}  // namespace lutka::physics
