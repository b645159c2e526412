#include "scene/draw_debug.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "physics/quality.hpp"
#include "scene/body_bounds.hpp"

namespace lutka::scene {
namespace {

using physics::BodyProfile;
using physics::BodyShape;
using physics::ConstraintProfile;
using physics::ConstraintState;
using render::Color;
using render::FrameDescription;

constexpr Color kAwake{104, 205, 92, 255};
constexpr Color kAsleep{128, 142, 178, 255};
constexpr Color kLimit{72, 200, 222, 255};
constexpr float kSolidAlpha = 0.55F;
constexpr float kVelocitySeconds = 0.1F;  // an arrow is the way of this time
const float kNearLimit = radians(5.0F);

void drawWire(FrameDescription& frame, const RigidTransform& world, const BodyShape& shape, Color color) {
    switch (shape.kind) {
        case BodyShape::Kind::capsule:
            addCapsule(frame.lines, world, shape.radius, shape.halfLength, color);
            break;
        case BodyShape::Kind::sphere:
            addSphere(frame.lines, world.translation, shape.radius, color);
            break;
        case BodyShape::Kind::box:
            addBox(frame.lines, world, shape.halfExtents, color);
            break;
    }
}

void drawSolid(FrameDescription& frame, const RigidTransform& world, const BodyShape& shape, Color color) {
    switch (shape.kind) {
        case BodyShape::Kind::capsule:
            addCapsule(frame.solids, world, shape.radius, shape.halfLength, color);
            break;
        case BodyShape::Kind::sphere:
            addSphere(frame.solids, world.translation, shape.radius, color);
            break;
        case BodyShape::Kind::box:
            addBox(frame.solids, world, shape.halfExtents, color);
            break;
    }
}

// The half extents of the solid box that has this mass and these principal moments.
vec3 inertiaBox(float massKg, const vec3& inertia) {
    const float k = 1.5F / massKg;  // I.x = m/3 (b² + c²), and so round
    const vec3 squares = k * vec3(inertia.y + inertia.z - inertia.x, inertia.z + inertia.x - inertia.y,
                                  inertia.x + inertia.y - inertia.z);
    return glm::sqrt(glm::max(squares, vec3(1e-8F)));
}

Color limitColor(float violation, float margin) {
    if (violation > 1e-4F) return render::colors::red;
    return margin < kNearLimit ? render::colors::yellow : kLimit;
}

// How far inside the limits the present angle is, radians.
float marginOf(const ConstraintProfile& constraint, const ConstraintState& state) {
    if (constraint.kind == ConstraintProfile::Kind::hinge) {
        return std::min(state.hingeAngle - constraint.hinge.lower, constraint.hinge.upper - state.hingeAngle);
    }
    const float y = state.swing.y / constraint.cone.swingY;
    const float z = state.swing.z / constraint.cone.swingZ;
    const float inside = 1.0F - std::sqrt(y * y + z * z);
    const float swingMargin = inside * std::min(constraint.cone.swingY, constraint.cone.swingZ);
    return std::min(swingMargin, constraint.cone.twist - std::abs(state.twist));
}

// Hinge: the sector that the child's x may sweep about the parent frame's z, and where it is now.
void drawHinge(FrameDescription& frame, const RigidTransform& worldFromFrame, const ConstraintProfile& constraint,
               const ConstraintState& state, float size, Color color) {
    addArc(frame.lines, worldFromFrame, constraint.hinge.lower, constraint.hinge.upper, size, color);
    addSector(frame.solids, worldFromFrame, constraint.hinge.lower, constraint.hinge.upper, size,
              withAlpha(color, 0.25F));
    const vec3 now(std::cos(state.hingeAngle), std::sin(state.hingeAngle), 0);
    addArrow(frame.lines, worldFromFrame.translation, worldFromFrame * (now * size * 1.15F), render::colors::white);
}

// Cone-twist: the cone around the parent frame's x, the child's x in it, and the twist span around the child's x.
void drawCone(FrameDescription& frame, const RigidTransform& worldFromFrame, const RigidTransform& worldFromChildFrame,
              const ConstraintProfile& constraint, const ConstraintState& state, float size, Color color) {
    const physics::ConeTwistLimits& cone = constraint.cone;
    addSwingCone(frame.lines, worldFromFrame, cone.swingY, cone.swingZ, size, color);
    addSwingCone(frame.solids, worldFromFrame, cone.swingY, cone.swingZ, size, withAlpha(color, 0.18F));
    const vec3 axis = worldFromChildFrame.rotation * vec3(1, 0, 0);
    const vec3 tip = worldFromFrame.translation + axis * size;
    addArrow(frame.lines, worldFromFrame.translation, tip, render::colors::white);
    // The span where the child's y may be: present twist taken back, then the limits either way.
    const vec3 neutral = glm::angleAxis(-state.twist, axis) * (worldFromChildFrame.rotation * vec3(0, 1, 0));
    addArc(frame.lines, tip, axis, neutral, -cone.twist, cone.twist, size * 0.25F, color);
    addArrow(frame.lines, tip, tip + worldFromChildFrame.rotation * vec3(0, size * 0.25F, 0), render::colors::white);
}

void drawLimits(const DollView& doll, FrameDescription& frame) {
    const physics::RagdollProfile& profile = doll.asset.profile;
    const float size = profile.heightM * 0.07F;
    for (const ConstraintProfile& constraint : profile.constraints) {
        const RigidTransform& parent = doll.worldFromBody[constraint.parent];
        const RigidTransform& child = doll.worldFromBody[constraint.child];
        const ConstraintState state = measureConstraint(constraint, parent, child);
        const Color color = limitColor(state.violation, marginOf(constraint, state));
        const RigidTransform worldFromFrame = parent * constraint.parentFromFrame;
        if (constraint.kind == ConstraintProfile::Kind::hinge) {
            drawHinge(frame, worldFromFrame, constraint, state, size, color);
        } else {
            drawCone(frame, worldFromFrame, child * constraint.childFromFrame, constraint, state, size, color);
        }
    }
}

void drawJoints(const DollView& doll, FrameDescription& frame) {
    const animation::Skeleton& skeleton = doll.asset.character.skeleton;
    std::vector<vec3> positions;
    positions.reserve(doll.modelFromJoint.size());
    for (const RigidTransform& joint : doll.modelFromJoint)
        positions.push_back(doll.worldFromModel * joint.translation);
    addSkeleton(frame.lines, positions, skeleton.parents, render::colors::grey);
    const float axis = doll.asset.profile.heightM * 0.03F;
    for (const int joint : doll.asset.rig.jointOfBody) {
        addAxes(frame.lines, doll.worldFromModel * doll.modelFromJoint[joint], axis);
    }
}

void drawBody(const DollView& doll, std::size_t i, const DebugLayers& layers, FrameDescription& frame) {
    const BodyProfile& body = doll.asset.profile.bodies[i];
    const RigidTransform& world = doll.worldFromBody[i];
    const Color color = doll.asleep ? kAsleep : kAwake;
    if (layers.capsules) drawWire(frame, world, body.shape, color);
    if (layers.solidCapsules) drawSolid(frame, world, body.shape, withAlpha(color, kSolidAlpha));
    if (layers.velocities) {
        const vec3 tip = world.translation + doll.states[i].linearVelocity * kVelocitySeconds;
        addArrow(frame.lines, world.translation, tip, render::colors::magenta);
    }
    if (layers.centresOfMass) {
        addCross(frame.lines, world.translation, 0.04F, render::colors::orange);
        addBox(frame.lines, world, inertiaBox(body.massKg, body.inertia), render::colors::orange);
    }
    if (layers.aabbs) {
        const vec3 half = halfAabbOf(body.shape, world.rotation);
        addAabb(frame.lines, world.translation - half, world.translation + half, render::colors::grey);
    }
}

}  // namespace

void drawDollDebug(const DollView& doll, const DebugLayers& layers, FrameDescription& frame) {
    for (std::size_t i = 0; i < doll.worldFromBody.size(); ++i)
        drawBody(doll, i, layers, frame);
    if (layers.joints) drawJoints(doll, frame);
    if (layers.limits) drawLimits(doll, frame);
}

}  // namespace lutka::scene
