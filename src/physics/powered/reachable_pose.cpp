#include "physics/powered/reachable_pose.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "physics/collision/contacts.hpp"
#include "physics/profile/within_limits.hpp"

namespace lutka::physics {
namespace {

constexpr int kMostPushes = 12;
constexpr float kDeepEnoughM = 5e-4F;
constexpr float kMostPush = 0.15F;     // radians at a time
constexpr float kLeastLeverM = 0.02F;  // a contact nearer to the shoulder's axis can't be turned away from

constexpr std::array<std::array<Role, 3>, 2> kArms{{{Role::leftUpperArm, Role::leftLowerArm, Role::leftHand},
                                                    {Role::rightUpperArm, Role::rightLowerArm, Role::rightHand}}};
constexpr std::array<std::array<Role, 3>, 2> kLegs{{{Role::leftUpperLeg, Role::leftLowerLeg, Role::leftFoot},
                                                    {Role::rightUpperLeg, Role::rightLowerLeg, Role::rightFoot}}};

// A hinge between two bones, in the upper one's frame: where its end is for each of its angles.
struct Bend {
    quat parentFrame, childFrame;
    vec3 upper;  // from the upper bone's joint to the hinge, in the parent's frame of the hinge
    vec3 lower;  // from the hinge to the end, in the child's

    [[nodiscard]] quat turn(float angle) const {
        return parentFrame * glm::angleAxis(angle, vec3(0, 0, 1)) * glm::conjugate(childFrame);
    }
    [[nodiscard]] vec3 end(float angle) const {
        return parentFrame * (upper + glm::angleAxis(angle, vec3(0, 0, 1)) * lower);
    }
    // The hinge's angle, within its limits, at which the end is so far away. Of two such angles it is the one towards
    // the side on which the hinge has more room; where there is none, the straightest or the most bent one.
    [[nodiscard]] float angleFor(float distance, const HingeLimits& limits) const {
        const float along = upper.x * lower.x + upper.y * lower.y;
        const float across = upper.y * lower.x - upper.x * lower.y;
        const float straight = std::atan2(across, along);
        const float reach = 2.0F * std::hypot(along, across);
        const float rest = distance * distance - glm::dot(upper, upper) - glm::dot(lower, lower);
        const float cosine = (rest - 2.0F * upper.z * lower.z) / std::max(reach, 1e-9F);
        const float bent = std::acos(std::clamp(cosine, -1.0F, 1.0F));
        const float middle = std::remainder(0.5F * (limits.lower + limits.upper) - straight, 2.0F * kPi);
        const float angle = std::remainder(straight + std::copysign(bent, middle), 2.0F * kPi);
        return std::clamp(angle, limits.lower, limits.upper);
    }
};

}  // namespace

ReachablePose::ReachablePose(const RagdollProfile& profile, std::vector<bool> keeps)
    : profile_(profile),
      keeps_(std::move(keeps)),
      limbOf_(profile.bodies.size(), -1),
      before_(profile.bodies.size(), quat(1, 0, 0, 0)) {
    for (const auto& arm : kArms)
        addLimb(arm, false);
    for (const auto& leg : kLegs)
        addLimb(leg, true);
    planMeetings();
}

bool ReachablePose::hangsOn(int body, int above) const {
    while (body > above)
        body = jointOf(body).parent;  // each hangs on a body before it
    return body == above;
}

bool ReachablePose::collide(int a, int b) const {
    const auto linked = [&](int child, int parent) { return child > 0 && jointOf(child).parent == parent; };
    if (a == b || linked(a, b) || linked(b, a)) return false;
    const std::pair<int, int> pair = std::minmax(a, b);
    return std::find(profile_.filteredPairs.begin(), profile_.filteredPairs.end(), pair) ==
           profile_.filteredPairs.end();
}

bool ReachablePose::isTrunk(int body) const {
    const auto& role = profile_.bodies[body].role;
    return role.has_value() && animation::isTrunk(*role);
}

void ReachablePose::addLimb(const std::array<Role, 3>& roles, bool isLeg) {
    Limb limb;
    limb.upper = bodyOf(profile_, roles[0]);
    limb.lower = bodyOf(profile_, roles[1]);
    limb.end = bodyOf(profile_, roles[2]);
    limb.isLeg = isLeg;
    limb.isChain = limb.upper > 0 && limb.lower > 0 && limb.end > 0 && jointOf(limb.lower).parent == limb.upper &&
                   jointOf(limb.end).parent == limb.lower && jointOf(limb.lower).kind == ConstraintProfile::Kind::hinge;
    if (limb.upper <= 0) return;
    for (const int body : {limb.upper, limb.lower, limb.end})
        if (body > 0 && isKept(body)) return;
    for (int body = limb.upper; body < static_cast<int>(profile_.bodies.size()); ++body)
        if (hangsOn(body, limb.upper)) limb.bodies.push_back(body);
    for (const int body : {limb.upper, limb.lower, limb.end})
        if (body > 0) limbOf_[body] = static_cast<int>(limbs_.size());
    limbs_.push_back(std::move(limb));
}

// Arms make way for everything, legs for each other; a leg that is folded into the trunk opens its knee.
void ReachablePose::planMeetings() {
    for (Limb& limb : limbs_) {
        for (const int own : {limb.upper, limb.lower, limb.end}) {
            if (own <= 0) continue;
            for (int other = 0; other < static_cast<int>(profile_.bodies.size()); ++other) {
                if (hangsOn(other, limb.upper) || !collide(own, other)) continue;
                const bool onLeg = limbOf_[other] >= 0 && limbs_[limbOf_[other]].isLeg;
                const bool onArm = limbOf_[other] >= 0 && !onLeg;
                if (limb.isLeg ? onLeg : !onArm) limb.meets.emplace_back(own, other);
                if (limb.isLeg && limb.isChain && own != limb.upper && isTrunk(other))
                    limb.folds.emplace_back(own, other);
            }
        }
    }
}

void ReachablePose::closeJoints(std::span<RigidTransform> bodies) const {
    for (std::size_t body = 1; body < bodies.size(); ++body) {
        const ConstraintProfile& joint = profile_.constraints[body - 1];
        bodies[body].translation = bodies[joint.parent] * joint.parentFromFrame.translation -
                                   bodies[body].rotation * joint.childFromFrame.translation;
    }
}

// From the turns that its bones are to have in the world; the end is where they put it, and `shift` from there.
void ReachablePose::bend(const Limb& limb, const quat& upper, const quat& lower, const quat& end, const vec3& shift,
                         std::span<RigidTransform> bodies) const {
    const ConstraintProfile& top = jointOf(limb.upper);
    const ConstraintProfile& hinge = jointOf(limb.lower);
    const quat& parent = bodies[top.parent].rotation;
    const vec3 toHinge = hinge.parentFromFrame.translation - top.childFromFrame.translation;
    const vec3 toEnd = jointOf(limb.end).parentFromFrame.translation - hinge.childFromFrame.translation;
    const vec3 goal = upper * toHinge + lower * toEnd + shift;
    const Bend bend{hinge.parentFromFrame.rotation, hinge.childFromFrame.rotation,
                    glm::conjugate(hinge.parentFromFrame.rotation) * toHinge,
                    glm::conjugate(hinge.childFromFrame.rotation) * toEnd};
    const float angle = bend.angleFor(glm::length(goal), hinge.hinge);
    const quat aimed = rotationBetween(upper * bend.end(angle), goal) * upper;
    bodies[limb.upper].rotation = glm::normalize(parent * withinLimits(top, glm::conjugate(parent) * aimed));
    const quat shin = glm::normalize(bodies[limb.upper].rotation * bend.turn(angle));
    bodies[limb.lower].rotation = shin;
    bodies[limb.end].rotation = glm::normalize(shin * withinLimits(jointOf(limb.end), glm::conjugate(shin) * end));
}

bool ReachablePose::moveEnd(int body, const vec3& shift, std::span<RigidTransform> bodies) const {
    const int index = limbOf_[body];
    if (index < 0 || !limbs_[index].isChain || limbs_[index].end != body) return false;
    const Limb& limb = limbs_[index];
    const quat upper = bodies[limb.upper].rotation;
    const quat lower = bodies[limb.lower].rotation;
    const quat end = bodies[limb.end].rotation;
    bend(limb, upper, lower, end, shift, bodies);
    for (const int other : limb.bodies) {
        // Toes, fingers and what else hangs on it.
        if (limbOf_[other] == index) continue;
        const quat& before = hangsOn(other, limb.end) ? end : hangsOn(other, limb.lower) ? lower : upper;
        const int on = hangsOn(other, limb.end) ? limb.end : hangsOn(other, limb.lower) ? limb.lower : limb.upper;
        bodies[other].rotation = glm::normalize(bodies[on].rotation * glm::conjugate(before) * bodies[other].rotation);
    }
    closeJoints(bodies);
    return true;
}

// About its upper joint; a foot keeps its own turn.
void ReachablePose::turnLimb(const Limb& limb, const quat& turn, std::span<RigidTransform> bodies) const {
    const ConstraintProfile& top = jointOf(limb.upper);
    const quat& parent = bodies[top.parent].rotation;
    const quat wanted = glm::conjugate(parent) * (turn * bodies[limb.upper].rotation);
    const quat turned = glm::normalize(parent * withinLimits(top, wanted));
    const quat done = turned * glm::conjugate(bodies[limb.upper].rotation);
    const quat foot = limb.isChain ? bodies[limb.end].rotation : quat(1, 0, 0, 0);
    for (const int body : limb.bodies)
        bodies[body].rotation = glm::normalize(done * bodies[body].rotation);
    if (limb.isLeg && limb.isChain) {
        const quat& shin = bodies[limb.lower].rotation;
        bodies[limb.end].rotation = glm::normalize(shin * withinLimits(jointOf(limb.end), glm::conjugate(shin) * foot));
    }
}

// The turn about `pivot` that takes a limb's bodies out of what they are deepest in, at once; along `axis` alone where
// one is given (unit). Its angle is 0 where they are in nothing.
ReachablePose::Turn ReachablePose::turnOut(std::span<const std::pair<int, int>> meetings, const vec3& pivot,
                                           const std::optional<vec3>& axis,
                                           std::span<const RigidTransform> bodies) const {
    Turn turn;
    for (const auto& meeting : meetings) {
        const int own = meeting.first;
        const int other = meeting.second;
        const BodyShape& shape = profile_.bodies[own].shape;
        visitShapes(shape, [&](const PrimitiveShape& mine, const RigidTransform& ownFromShape) {
            visitShapes(profile_.bodies[other].shape, [&](const PrimitiveShape& its, const RigidTransform& otherFrom) {
                const ContactList list = findContacts(geometryOf(mine, bodies[own] * ownFromShape),
                                                      geometryOf(its, bodies[other] * otherFrom), 0.0F);
                for (int i = 0; i < list.count; ++i) {
                    const SurfaceContact& contact = list.contacts[i];
                    vec3 way = glm::cross(contact.position - pivot, contact.normal);
                    if (axis) way = *axis * glm::dot(*axis, way);
                    const float lever = glm::length(way);
                    if (-contact.distance < kDeepEnoughM || lever < kLeastLeverM) continue;
                    if (-contact.distance / lever <= turn.angle) continue;
                    turn = {way / lever, -contact.distance / lever};
                }
            });
        });
    }
    turn.angle = std::min(turn.angle, kMostPush);
    return turn;
}

// Turns the limb out of what it is deepest in; whether it is in anything.
bool ReachablePose::pushOut(const Limb& limb, std::span<RigidTransform> bodies) const {
    const vec3 pivot = bodies[limb.upper] * jointOf(limb.upper).childFromFrame.translation;
    const Turn turn = turnOut(limb.meets, pivot, std::nullopt, bodies);
    if (turn.angle <= 0.0F) return false;
    const float share = limb.isLeg ? 0.5F : 1.0F;  // the other leg does the same
    turnLimb(limb, glm::angleAxis(share * turn.angle, turn.axis), bodies);
    closeJoints(bodies);
    return true;
}

// Opens the knee of a leg whose shin or foot is in the trunk; whether it is. A fat shin that is in it beside the knee
// is turned out by the hip.
bool ReachablePose::unfold(const Limb& limb, std::span<RigidTransform> bodies) const {
    const ConstraintProfile& knee = jointOf(limb.lower);
    const quat& thigh = bodies[limb.upper].rotation;
    const vec3 axis = thigh * (knee.parentFromFrame.rotation * vec3(0, 0, 1));
    const vec3 pivot = bodies[limb.lower] * knee.childFromFrame.translation;
    const Turn turn = turnOut(limb.folds, pivot, axis, bodies);
    const vec3 hip = bodies[limb.upper] * jointOf(limb.upper).childFromFrame.translation;
    if (turn.angle <= 0.0F) {
        const Turn aside = turnOut(limb.folds, hip, std::nullopt, bodies);
        if (aside.angle <= 0.0F) return false;
        turnLimb(limb, glm::angleAxis(aside.angle, aside.axis), bodies);
        closeJoints(bodies);
        return true;
    }
    // The knee opens in the direction that leads the foot away from the hip, even where the shortest way out of the
    // trunk is the other one.
    const vec3 shank = bodies[limb.end].translation - pivot;
    const float opens = glm::dot(glm::cross(axis, shank), pivot - hip) < 0.0F ? -1.0F : 1.0F;
    const quat wanted = glm::angleAxis(opens * turn.angle, axis) * bodies[limb.lower].rotation;
    const quat shin = glm::normalize(thigh * withinLimits(knee, glm::conjugate(thigh) * wanted));
    const quat done = shin * glm::conjugate(bodies[limb.lower].rotation);
    for (const int body : limb.bodies)
        if (hangsOn(body, limb.lower)) bodies[body].rotation = glm::normalize(done * bodies[body].rotation);
    closeJoints(bodies);
    return true;
}

void ReachablePose::apply(std::span<RigidTransform> bodies) {
    for (std::size_t body = 0; body < bodies.size(); ++body)
        before_[body] = bodies[body].rotation;
    for (int body = 1; body < static_cast<int>(bodies.size()); ++body) {
        if (isKept(body)) continue;
        const int limb = limbOf_[body];
        if (limb >= 0 && limbs_[limb].isChain) {
            if (limbs_[limb].upper != body) continue;
            const int parent = jointOf(body).parent;
            const quat carried = bodies[parent].rotation * glm::conjugate(before_[parent]);
            bend(limbs_[limb], carried * before_[body], carried * before_[limbs_[limb].lower],
                 carried * before_[limbs_[limb].end], vec3(0), bodies);
            continue;
        }
        const ConstraintProfile& joint = jointOf(body);
        const quat relative = glm::conjugate(before_[joint.parent]) * before_[body];
        bodies[body].rotation = glm::normalize(bodies[joint.parent].rotation * withinLimits(joint, relative));
    }
    closeJoints(bodies);
    for (int push = 0; push < kMostPushes; ++push) {
        bool isIn = false;
        for (const Limb& limb : limbs_) {
            isIn = pushOut(limb, bodies) || isIn;
            if (!limb.folds.empty()) isIn = unfold(limb, bodies) || isIn;
        }
        if (!isIn) break;
    }
}

}  // namespace lutka::physics
