#include <fmt/format.h>

#include <algorithm>

#include "editor/document/editor_document.hpp"
#include "editor/document/mirror_body.hpp"
#include "physics/rig/rig.hpp"

// The ragdoll's bodies, their constraints and which of them collide.

namespace lutka::editor {
namespace {

using animation::Side;
using physics::BodyProfile;
using physics::ConstraintProfile;
using physics::RagdollProfile;

}  // namespace

Result<void> EditorDocument::editPart(int body, const std::string& what, const std::string& group,
                                      const std::function<void(PartEdits&)>& change) {
    LUTKA_ASSERT(body >= 0 && body < static_cast<int>(profile().bodies.size()));
    const std::string& name = profile().bodies[body].name;
    return apply(fmt::format("{} of {}", what, profile().bodies[body].name), group,
                 [&](DocumentState& next) -> Result<void> {
                     change(next.edits[name]);
                     if (symmetric_) mirrorOnto(next, std::span(&body, 1));
                     return {};
                 });
}

std::vector<RigidTransform> EditorDocument::bindModelFromBody(const RagdollProfile& profile) const {
    const auto rig = physics::bindRig(profile, character().skeleton);
    LUTKA_ASSERT(rig.ok());  // apply() lets no other profile in
    return rig ? rig.value().bindModelFromBody : std::vector<RigidTransform>(profile.bodies.size());
}

physics::BindFrames EditorDocument::bindOf(int constraint) const {
    const auto bind = bindModelFromBody(profile());
    const ConstraintProfile& one = profile().constraints[constraint];
    return {bind[one.parent], bind[one.child]};
}

std::string EditorDocument::partNames(std::span<const int> bodies) const {
    if (bodies.size() == 1) return profile().bodies[bodies.front()].name;
    return fmt::format("{} bodies", bodies.size());
}

Result<void> EditorDocument::changeParts(std::span<const int> bodies, const std::string& what, const std::string& group,
                                         const std::function<Result<void>(Part&)>& change) {
    if (bodies.empty()) return Error{ErrorCode::usage, "no body is selected", "", "select one"};
    return apply(fmt::format("{} of {}", what, partNames(bodies)), group, [&](DocumentState& next) -> Result<void> {
        RagdollProfile work = next.profile;
        const auto bind = bindModelFromBody(work);
        for (const int body : bodies) {
            BodyProfile changed = work.bodies[body];
            ConstraintProfile* constraint = body > 0 ? &work.constraints[body - 1] : nullptr;
            const int parent = constraint != nullptr ? constraint->parent : 0;
            Part part{changed, constraint, {bind[parent], bind[body]}};
            if (auto done = change(part); !done) return done;
            const RigidTransform place = changed.jointFromBody;
            changed.jointFromBody = work.bodies[body].jointFromBody;
            work.bodies[body] = changed;
            physics::moveBody(work, body, place);
        }
        for (const int body : bodies) {
            next.edits[work.bodies[body].name] = partEditsBetween(next.base, body, work, body);
        }
        if (symmetric_) mirrorOnto(next, bodies);
        return {};
    });
}

EditorDocument::PartValues EditorDocument::copyPart(int body) const {
    const BodyProfile& from = profile().bodies[body];
    PartValues values{physics::sideOf(profile(), body), from.shape, from.massKg, from.muscle, std::nullopt};
    if (body > 0) {
        const ConstraintProfile& joint = profile().constraints[body - 1];
        const physics::BindFrames bind = bindOf(body - 1);
        values.joint = {joint.kind, physics::jointRange(joint, bind), joint.frictionNm,
                        physics::springFromBind(joint, bind)};
    }
    return values;
}

Result<void> EditorDocument::pasteParts(std::span<const int> bodies, const PartValues& values) {
    return changeParts(bodies, "Paste", "", [&](Part& part) -> Result<void> {
        const Side side = physics::sideOf(profile(), physics::bodyNamed(profile(), part.body.name));
        const bool across = side != values.side && side != Side::center && values.side != Side::center;
        part.body.shape = across ? physics::mirrored(values.shape) : values.shape;
        part.body.massKg = values.massKg;
        part.body.muscle = values.muscle;
        if (part.constraint == nullptr || !values.joint) return {};
        physics::changeKind(*part.constraint, values.joint->kind, part.bind);
        physics::setJointRange(*part.constraint, across ? mirrored(values.joint->range) : values.joint->range,
                               part.bind);
        part.constraint->frictionNm = values.joint->frictionNm;
        const physics::JointSpring& spring = values.joint->spring;
        physics::setSpringFromBind(*part.constraint, across ? mirrored(spring) : spring, part.bind);
        return {};
    });
}

Result<void> EditorDocument::mirrorParts(std::span<const int> bodies) {
    for (const int body : bodies) {
        const int other = physics::counterpartOf(profile(), body);
        if (other >= 0 && other != body) continue;
        return Error{ErrorCode::usage, fmt::format("{} has no other side", profile().bodies[body].name), "", ""};
    }
    return apply("Mirror " + partNames(bodies), "", [&](DocumentState& next) -> Result<void> {
        mirrorOnto(next, bodies);
        return {};
    });
}

void EditorDocument::mirrorOnto(DocumentState& state, std::span<const int> bodies) const {
    const RagdollProfile work = applyEdits(state.base, state.edits, state.pairs);
    mirrorEdits(state, work, bindModelFromBody(work), bodies);
}

Result<void> EditorDocument::changeBodies(const std::string& label,
                                          const std::function<Result<RagdollProfile>(const RagdollProfile&)>& change) {
    return apply(label, "", [&](DocumentState& next) -> Result<void> {
        auto changed = change(next.profile);
        if (!changed) return changed.error();
        takeAsBase(next, std::move(changed).value());
        return {};
    });
}

Result<void> EditorDocument::resetParts(std::span<const int> bodies) {
    return apply("Reset " + partNames(bodies), "", [&](DocumentState& next) -> Result<void> {
        for (const int body : bodies)
            next.edits.erase(next.profile.bodies[body].name);
        if (symmetric_) mirrorOnto(next, bodies);
        return {};
    });
}

bool EditorDocument::linked(int bodyA, int bodyB) const {
    const auto& constraints = profile().constraints;
    return std::any_of(constraints.begin(), constraints.end(), [&](const ConstraintProfile& c) {
        return (c.parent == bodyA && c.child == bodyB) || (c.parent == bodyB && c.child == bodyA);
    });
}

bool EditorDocument::collides(int bodyA, int bodyB) const {
    if (bodyA == bodyB || linked(bodyA, bodyB)) return false;
    const std::pair pair(std::min(bodyA, bodyB), std::max(bodyA, bodyB));
    const auto& filtered = profile().filteredPairs;
    return std::find(filtered.begin(), filtered.end(), pair) == filtered.end();
}

Result<void> EditorDocument::setCollision(int bodyA, int bodyB, bool collide) {
    const std::string& a = profile().bodies[bodyA].name;
    const std::string& b = profile().bodies[bodyB].name;
    if (bodyA == bodyB || linked(bodyA, bodyB)) {
        return Error{ErrorCode::usage, fmt::format("{} and {} are linked and never collide", a, b), "", ""};
    }
    const std::string label = fmt::format("{} and {} {}", a, b, collide ? "collide" : "pass through");
    return apply(label, "", [&](DocumentState& next) -> Result<void> {
        setPair(next.pairs, {a, b, collide});
        return {};
    });
}

Result<void> EditorDocument::setShape(int body, const physics::BodyShape& shape, const std::string& group) {
    return editPart(body, "Shape", group, [&](PartEdits& edits) { edits.shape = shape; });
}

Result<void> EditorDocument::setMass(int body, float massKg, const std::string& group) {
    return editPart(body, "Mass", group, [&](PartEdits& edits) { edits.massKg = massKg; });
}

Result<void> EditorDocument::setHinge(int constraint, const physics::HingeLimits& limits, const std::string& group) {
    return editPart(profile().constraints[constraint].child, "Limits", group,
                    [&](PartEdits& edits) { edits.hinge = limits; });
}

Result<void> EditorDocument::setCone(int constraint, const physics::ConeTwistLimits& limits, const std::string& group) {
    return editPart(profile().constraints[constraint].child, "Limits", group,
                    [&](PartEdits& edits) { edits.cone = limits; });
}

Result<void> EditorDocument::setFriction(int constraint, float frictionNm, const std::string& group) {
    return editPart(profile().constraints[constraint].child, "Friction", group,
                    [&](PartEdits& edits) { edits.frictionNm = frictionNm; });
}

}  // namespace lutka::editor
