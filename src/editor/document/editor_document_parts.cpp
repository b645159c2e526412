/// EditorDocument's edits of bodies and constraints.

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "editor/document/editor_document.hpp"
#include "physics/fit/anatomy.hpp"
#include "physics/rig/rig.hpp"

namespace lutka::editor {
namespace {

using animation::Role;
using animation::Side;
using physics::BodyProfile;
using physics::ConstraintProfile;
using physics::RagdollProfile;

// Frames on the two sides are mirror images but for z, which is an axis of rotation (see physics::standingFrame()).
quat mirrorFrame(const quat& frame) {
    return physics::mirrorRotation(frame) * quat(0, 0, 1, 0);
}

vec3 mirrorPoint(const vec3& point, float middle) {
    return {2.0F * middle - point.x, point.y, point.z};
}

}  // namespace

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
    if (bodies.size() == 1) return std::string(animation::roleName(profile().bodies[bodies.front()].role));
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
            next.edits[animation::indexOf(work.bodies[body].role)] = partEditsBetween(next.base, body, work, body);
        }
        return {};
    });
}

EditorDocument::PartValues EditorDocument::copyPart(int body) const {
    const BodyProfile& from = profile().bodies[body];
    PartValues values{animation::sideOf(from.role), from.shape, from.massKg, std::nullopt};
    if (body > 0) {
        const ConstraintProfile& joint = profile().constraints[body - 1];
        values.joint = {joint.kind, physics::jointRange(joint, bindOf(body - 1)), joint.frictionNm};
    }
    return values;
}

Result<void> EditorDocument::pasteParts(std::span<const int> bodies, const PartValues& values) {
    return changeParts(bodies, "Paste", "", [&](Part& part) -> Result<void> {
        part.body.shape = values.shape;
        part.body.massKg = values.massKg;
        if (part.constraint == nullptr || !values.joint) return {};
        const Side side = animation::sideOf(part.body.role);
        const bool across = side != values.side && side != Side::center && values.side != Side::center;
        physics::changeKind(*part.constraint, values.joint->kind, part.bind);
        physics::setJointRange(*part.constraint, across ? mirrored(values.joint->range) : values.joint->range,
                               part.bind);
        part.constraint->frictionNm = values.joint->frictionNm;
        return {};
    });
}

// Puts the shape and the constraint's frames of `to` where those of `from` are across the figure, unless the bind pose
// has the two limbs in different places: then they keep their own.
void EditorDocument::mirrorPlace(RagdollProfile& profile, std::span<const RigidTransform> bind, int from,
                                 int to) const {
    constexpr float symmetric = 0.03F;  // of the height
    const quat& standard = profile.standardFromModel;
    const float middle = (standard * bind[0].translation).x;
    const ConstraintProfile source = profile.constraints[from - 1];
    ConstraintProfile& target = profile.constraints[to - 1];
    const auto anchorOf = [&](const ConstraintProfile& constraint) {
        return standard * (bind[constraint.child] * constraint.childFromFrame.translation);
    };
    if (glm::distance(mirrorPoint(anchorOf(source), middle), anchorOf(target)) > symmetric * profile.heightM) return;
    const auto frameAcross = [&](const quat& modelFromFrame, const quat& modelFromBody) {
        const quat across = glm::conjugate(standard) * mirrorFrame(standard * modelFromFrame);
        return glm::normalize(glm::conjugate(modelFromBody) * across);
    };
    target.parentFromFrame.rotation =
        frameAcross(bind[source.parent].rotation * source.parentFromFrame.rotation, bind[target.parent].rotation);
    target.childFromFrame.rotation =
        frameAcross(bind[source.child].rotation * source.childFromFrame.rotation, bind[target.child].rotation);
    const vec3 centre = glm::conjugate(standard) * mirrorPoint(standard * bind[from].translation, middle);
    const quat turned = glm::conjugate(standard) * physics::mirrorRotation(standard * bind[from].rotation);
    const RigidTransform modelFromJoint = bind[to] * inverse(profile.bodies[to].jointFromBody);
    const RigidTransform place = inverse(modelFromJoint) * RigidTransform{turned, centre};
    physics::moveBody(profile, to, {glm::normalize(place.rotation), place.translation});
}

Result<void> EditorDocument::mirrorParts(std::span<const int> bodies) {
    for (const int body : bodies) {
        const int other = physics::bodyOf(profile(), animation::mirrored(profile().bodies[body].role));
        if (other >= 0 && other != body) continue;
        return Error{ErrorCode::usage,
                     fmt::format("{} has no other side", animation::roleName(profile().bodies[body].role)), "", ""};
    }
    return apply("Mirror " + partNames(bodies), "", [&](DocumentState& next) -> Result<void> {
        RagdollProfile work = next.profile;
        const auto bind = bindModelFromBody(work);
        for (const int body : bodies) {
            const int other = physics::bodyOf(work, animation::mirrored(work.bodies[body].role));
            work.bodies[other].shape = work.bodies[body].shape;
            work.bodies[other].massKg = work.bodies[body].massKg;
            const ConstraintProfile& from = work.constraints[body - 1];
            ConstraintProfile& to = work.constraints[other - 1];
            to.kind = from.kind;
            to.hinge = from.hinge;
            to.cone = from.cone;
            to.frictionNm = from.frictionNm;
            mirrorPlace(work, bind, body, other);
            next.edits[animation::indexOf(work.bodies[other].role)] = partEditsBetween(next.base, other, work, other);
        }
        return {};
    });
}

Result<void> EditorDocument::resetParts(std::span<const int> bodies) {
    return apply("Reset " + partNames(bodies), "", [&](DocumentState& next) -> Result<void> {
        for (const int body : bodies)
            next.edits[animation::indexOf(next.profile.bodies[body].role)] = {};
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
    const Role a = profile().bodies[bodyA].role;
    const Role b = profile().bodies[bodyB].role;
    if (bodyA == bodyB || linked(bodyA, bodyB)) {
        return Error{
            ErrorCode::usage,
            fmt::format("{} and {} are linked and never collide", animation::roleName(a), animation::roleName(b)), "",
            ""};
    }
    const std::string label = fmt::format("{} and {} {}", animation::roleName(a), animation::roleName(b),
                                          collide ? "collide" : "pass through");
    return apply(label, "", [&](DocumentState& next) -> Result<void> {
        setPair(next.pairs, {a, b, collide});
        return {};
    });
}

}  // namespace lutka::editor
