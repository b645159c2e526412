#include "editor/document/part_edits.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

#include "physics/collision/shape.hpp"

namespace lutka::editor {
namespace {

using physics::BodyProfile;
using physics::ConstraintProfile;
using physics::RagdollProfile;

bool same(const physics::PrimitiveShape& a, const physics::PrimitiveShape& b) {
    if (a.kind != b.kind) return false;
    switch (a.kind) {
        case physics::PrimitiveShape::Kind::box:
            return a.halfExtents == b.halfExtents;
        case physics::PrimitiveShape::Kind::sphere:
            return a.radius == b.radius;
        case physics::PrimitiveShape::Kind::hull:
            return physics::sameHull(a.hull, b.hull);
        case physics::PrimitiveShape::Kind::capsule:
            break;
    }
    return a.radius == b.radius && a.halfLength == b.halfLength;
}

bool same(const RigidTransform& a, const RigidTransform& b) {
    constexpr float metres = 1e-6F;
    constexpr float halfAngle = 1e-5F;
    const quat apart = glm::conjugate(a.rotation) * b.rotation;
    return glm::distance(a.translation, b.translation) < metres &&
           glm::length(vec3(apart.x, apart.y, apart.z)) < halfAngle;
}

bool same(const physics::AddedShape& a, const physics::AddedShape& b) {
    return same(static_cast<const physics::PrimitiveShape&>(a), static_cast<const physics::PrimitiveShape&>(b)) &&
           same(a.bodyFromShape, b.bodyFromShape);
}

bool same(const physics::BodyShape& a, const physics::BodyShape& b) {
    return same(static_cast<const physics::PrimitiveShape&>(a), static_cast<const physics::PrimitiveShape&>(b)) &&
           std::equal(a.more.begin(), a.more.end(), b.more.begin(), b.more.end(),
                      [](const auto& x, const auto& y) { return same(x, y); });
}

bool same(const physics::HingeLimits& a, const physics::HingeLimits& b) {
    return a.lower == b.lower && a.upper == b.upper;
}

bool same(const physics::ConeTwistLimits& a, const physics::ConeTwistLimits& b) {
    return a.swingY == b.swingY && a.swingZ == b.swingZ && a.twist == b.twist;
}

// Where a spring that does nothing would rest is of no account.
bool same(const physics::JointSpring& a, const physics::JointSpring& b) {
    if (!a.works() && !b.works()) return true;
    return a.stiffness == b.stiffness && a.damping == b.damping &&
           same(RigidTransform{a.rest, vec3(0)}, RigidTransform{b.rest, vec3(0)});
}

template <class T>
void takeUnset(std::optional<T>& edit, const std::optional<T>& other) {
    if (!edit) edit = other;
}

void applyTo(RagdollProfile& profile, int index, const PartEdits& edits) {
    BodyProfile& body = profile.bodies[index];
    if (edits.jointFromBody) physics::moveBody(profile, index, *edits.jointFromBody);
    if (edits.shape) body.shape = *edits.shape;
    if (edits.massKg) body.massKg = *edits.massKg;
    if (edits.muscle) body.muscle = *edits.muscle;
    if (edits.shape || edits.massKg) body.inertia = physics::shapeInertia(body.shape, body.massKg);
}

void applyTo(ConstraintProfile& constraint, const PartEdits& edits) {
    if (edits.kind) constraint.kind = *edits.kind;
    if (edits.hinge) constraint.hinge = *edits.hinge;
    if (edits.cone) constraint.cone = *edits.cone;
    if (edits.frames) physics::applyFrameEdit(constraint, *edits.frames);
    if (edits.frictionNm) constraint.frictionNm = *edits.frictionNm;
    if (edits.spring) constraint.spring = *edits.spring;
}

void compareConstraints(PartEdits& edits, const ConstraintProfile& plain, const ConstraintProfile& given) {
    if (given.kind != plain.kind) edits.kind = given.kind;
    if (!same(given.hinge, plain.hinge)) edits.hinge = given.hinge;
    if (!same(given.cone, plain.cone)) edits.cone = given.cone;
    if (given.frictionNm != plain.frictionNm) edits.frictionNm = given.frictionNm;
}

bool filtered(const RagdollProfile& profile, int a, int b) {
    const std::pair pair(std::min(a, b), std::max(a, b));
    return std::find(profile.filteredPairs.begin(), profile.filteredPairs.end(), pair) != profile.filteredPairs.end();
}

bool linked(const RagdollProfile& profile, int a, int b) {
    return std::any_of(profile.constraints.begin(), profile.constraints.end(), [&](const ConstraintProfile& c) {
        return (c.parent == a && c.child == b) || (c.parent == b && c.child == a);
    });
}

void applyPair(RagdollProfile& profile, const PairEdit& edit) {
    const int a = physics::bodyNamed(profile, edit.first);
    const int b = physics::bodyNamed(profile, edit.second);
    if (a < 0 || b < 0 || a == b || linked(profile, a, b)) return;
    const std::pair pair(std::min(a, b), std::max(a, b));
    auto& pairs = profile.filteredPairs;
    std::erase(pairs, pair);
    if (!edit.collide) pairs.insert(std::upper_bound(pairs.begin(), pairs.end(), pair), pair);
}

}  // namespace

PartEdits partEditsBetween(const RagdollProfile& plain, int plainBody, const RagdollProfile& given, int body) {
    PartEdits edits;
    const BodyProfile& from = plain.bodies[plainBody];
    const BodyProfile& to = given.bodies[body];
    if (!same(from.shape, to.shape)) edits.shape = to.shape;
    if (from.massKg != to.massKg) edits.massKg = to.massKg;
    if (!(from.muscle == to.muscle)) edits.muscle = to.muscle;
    // Places and frames compare only on the same joint.
    const bool comparable = from.jointPath == to.jointPath;
    if (comparable && !same(from.jointFromBody, to.jointFromBody)) edits.jointFromBody = to.jointFromBody;
    if (body == 0 || plainBody == 0) return edits;  // the root has no constraint of its own
    const ConstraintProfile& joint = given.constraints[body - 1];
    compareConstraints(edits, plain.constraints[plainBody - 1], joint);
    const int plainParent = plain.constraints[plainBody - 1].parent;
    const BodyProfile& parentFrom = plain.bodies[plainParent];
    const BodyProfile& parentTo = given.bodies[joint.parent];
    ConstraintProfile moved = plain.constraints[plainBody - 1];
    if (!comparable || parentFrom.jointPath != parentTo.jointPath) {
        if (!same(moved.spring, joint.spring)) edits.spring = joint.spring;
        return edits;
    }
    moved.childFromFrame = inverse(to.jointFromBody) * from.jointFromBody * moved.childFromFrame;
    moved.parentFromFrame = inverse(parentTo.jointFromBody) * parentFrom.jointFromBody * moved.parentFromFrame;
    const physics::FrameEdit frames = physics::frameEditBetween(moved, joint);
    if (!physics::isNone(frames)) edits.frames = frames;
    physics::applyFrameEdit(moved, frames);
    if (!same(moved.spring, joint.spring)) edits.spring = joint.spring;
    return edits;
}

AllPartEdits editsBetween(const RagdollProfile& fitted, const RagdollProfile& given) {
    AllPartEdits edits;
    for (int i = 0; i < static_cast<int>(given.bodies.size()); ++i) {
        const int plain = physics::bodyNamed(fitted, given.bodies[i].name);
        if (plain >= 0) edits[given.bodies[i].name] = partEditsBetween(fitted, plain, given, i);
    }
    return edits;
}

std::vector<PairEdit> pairEditsBetween(const RagdollProfile& fitted, const RagdollProfile& given) {
    std::vector<PairEdit> edits;
    const int count = static_cast<int>(given.bodies.size());
    for (int a = 0; a < count; ++a) {
        for (int b = a + 1; b < count; ++b) {
            const int plainA = physics::bodyNamed(fitted, given.bodies[a].name);
            const int plainB = physics::bodyNamed(fitted, given.bodies[b].name);
            if (plainA < 0 || plainB < 0 || linked(given, a, b) || linked(fitted, plainA, plainB)) continue;
            const bool off = filtered(given, a, b);
            if (off == filtered(fitted, plainA, plainB)) continue;
            setPair(edits, {given.bodies[a].name, given.bodies[b].name, !off});
        }
    }
    return edits;
}

void fillUnset(AllPartEdits& edits, const AllPartEdits& others) {
    for (const auto& [name, other] : others) {
        PartEdits& part = edits[name];
        takeUnset(part.shape, other.shape);
        takeUnset(part.jointFromBody, other.jointFromBody);
        takeUnset(part.massKg, other.massKg);
        takeUnset(part.muscle, other.muscle);
        takeUnset(part.kind, other.kind);
        takeUnset(part.hinge, other.hinge);
        takeUnset(part.cone, other.cone);
        takeUnset(part.frames, other.frames);
        takeUnset(part.frictionNm, other.frictionNm);
        takeUnset(part.spring, other.spring);
    }
}

void fillUnset(std::vector<PairEdit>& edits, std::span<const PairEdit> others) {
    std::vector<PairEdit> all(others.begin(), others.end());
    for (const PairEdit& edit : edits)
        setPair(all, edit);
    edits = std::move(all);
}

void setPair(std::vector<PairEdit>& edits, PairEdit edit) {
    if (edit.second < edit.first) std::swap(edit.first, edit.second);
    std::erase_if(edits,
                  [&](const PairEdit& other) { return other.first == edit.first && other.second == edit.second; });
    edits.push_back(edit);
}

RagdollProfile applyEdits(const RagdollProfile& base, const AllPartEdits& edits, std::span<const PairEdit> pairs) {
    RagdollProfile profile = base;
    bool massChanged = false;
    for (int i = 0; i < static_cast<int>(profile.bodies.size()); ++i) {
        const auto found = edits.find(profile.bodies[i].name);
        if (found == edits.end()) continue;
        const PartEdits& part = found->second;
        massChanged = massChanged || part.massKg.has_value();
        applyTo(profile, i, part);
    }
    for (ConstraintProfile& constraint : profile.constraints) {
        const auto found = edits.find(profile.bodies[constraint.child].name);
        if (found != edits.end()) applyTo(constraint, found->second);
    }
    for (const PairEdit& pair : pairs)
        applyPair(profile, pair);
    if (massChanged) {
        profile.totalMassKg = 0;
        for (const BodyProfile& body : profile.bodies)
            profile.totalMassKg += body.massKg;
    }
    return profile;
}

}  // namespace lutka::editor
