#include "editor/document/mirror_body.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "physics/fit/anatomy.hpp"
#include "physics/profile/constraint_frames.hpp"

namespace lutka::editor {
namespace {

using physics::ConstraintProfile;
using physics::RagdollProfile;

// Frames on the two sides are mirror images but for z, which is an axis of rotation (see physics::standingFrame()).
quat mirrorFrame(const quat& frame) {
    return physics::mirrorRotation(frame) * quat(0, 0, 1, 0);
}

vec3 mirrorPoint(const vec3& point, float middle) {
    return {2.0F * middle - point.x, point.y, point.z};
}

// Puts the body and the constraint's frames of `to` where those of `from` are across the figure, unless the bind pose
// has the two limbs in different places: then they keep their own.
void mirrorPlace(RagdollProfile& profile, std::span<const RigidTransform> bind, int from, int to) {
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

}  // namespace

void mirrorBody(RagdollProfile& profile, std::span<const RigidTransform> bindModelFromBody, int from, int to) {
    profile.bodies[to].shape = physics::mirrored(profile.bodies[from].shape);
    profile.bodies[to].massKg = profile.bodies[from].massKg;
    profile.bodies[to].muscle = profile.bodies[from].muscle;
    const ConstraintProfile& source = profile.constraints[from - 1];
    ConstraintProfile& target = profile.constraints[to - 1];
    target.kind = source.kind;
    target.hinge = source.hinge;
    target.cone = source.cone;
    target.frictionNm = source.frictionNm;
    target.spring = physics::mirrored(source.spring);
    mirrorPlace(profile, bindModelFromBody, from, to);
}

void mirrorEdits(DocumentState& state, RagdollProfile profile, std::span<const RigidTransform> bindModelFromBody,
                 std::span<const int> bodies) {
    for (const int body : bodies) {
        const int other = physics::counterpartOf(profile, body);
        const bool given = std::find(bodies.begin(), bodies.end(), other) != bodies.end();
        if (body == 0 || other <= 0 || other == body || given) continue;
        mirrorBody(profile, bindModelFromBody, body, other);
        state.edits[profile.bodies[other].name] = partEditsBetween(state.base, other, profile, other);
    }
}

}  // namespace lutka::editor
