#include "scene/draw/draw_debug.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "physics/profile/constraint_state.hpp"
#include "scene/asset/body_bounds.hpp"
#include "scene/draw/draw_hull.hpp"

namespace lutka::scene {
namespace {

using physics::BodyProfile;
using physics::ConstraintProfile;
using physics::ConstraintState;
using physics::PrimitiveShape;
using render::Color;
using render::FrameDescription;

constexpr float kSolidAlpha = 0.55F;
constexpr float kVelocitySeconds = 0.1F;  // an arrow is the way of this time

void drawWire(FrameDescription& frame, const RigidTransform& world, const PrimitiveShape& shape, Color color) {
    switch (shape.kind) {
        case PrimitiveShape::Kind::capsule:
            addCapsule(frame.lines, world, shape.radius, shape.halfLength, color);
            break;
        case PrimitiveShape::Kind::sphere:
            addSphere(frame.lines, world.translation, shape.radius, color);
            break;
        case PrimitiveShape::Kind::box:
            addBox(frame.lines, world, shape.halfExtents, color);
            break;
        case PrimitiveShape::Kind::hull:
            addHull(frame.lines, world, *shape.hull, color);
            break;
    }
}

void drawSolid(FrameDescription& frame, const RigidTransform& world, const PrimitiveShape& shape, Color color) {
    switch (shape.kind) {
        case PrimitiveShape::Kind::capsule:
            addCapsule(frame.solids, world, shape.radius, shape.halfLength, color);
            break;
        case PrimitiveShape::Kind::sphere:
            addSphere(frame.solids, world.translation, shape.radius, color);
            break;
        case PrimitiveShape::Kind::box:
            addBox(frame.solids, world, shape.halfExtents, color);
            break;
        case PrimitiveShape::Kind::hull:
            addHull(frame.solids, world, *shape.hull, color);
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

// Of a limit's outline; the present angle's arrow has it too, but is white while all is well.
struct LimitColors {
    Color outline = debugColors::limit;
    Color present = debugColors::presentAngle;
};

LimitColors limitColors(float margin) {
    if (margin <= kPassedLimit) return {debugColors::pastLimit, debugColors::pastLimit};
    if (margin < kNearLimit) return {debugColors::nearLimit, debugColors::nearLimit};
    return {};
}

// Hinge: the sector that the child's x may sweep about the parent frame's z, and where it is now.
void drawHinge(FrameDescription& frame, const RigidTransform& worldFromFrame, const ConstraintProfile& constraint,
               const ConstraintState& state, float size) {
    const LimitColors colors = limitColors(limitMargin(constraint, state));
    addArc(frame.lines, worldFromFrame, constraint.hinge.lower, constraint.hinge.upper, size, colors.outline);
    addSector(frame.solids, worldFromFrame, constraint.hinge.lower, constraint.hinge.upper, size,
              withAlpha(colors.outline, 0.25F));
    const vec3 now(std::cos(state.hingeAngle), std::sin(state.hingeAngle), 0);
    addArrow(frame.lines, worldFromFrame.translation, worldFromFrame * (now * size * 1.15F), colors.present);
}

// Cone-twist: the cone around the parent frame's x, the child's x in it, and the twist span around the child's x.
void drawCone(FrameDescription& frame, const RigidTransform& worldFromFrame, const RigidTransform& worldFromChildFrame,
              const ConstraintProfile& constraint, const ConstraintState& state, float size) {
    const physics::ConeTwistLimits& cone = constraint.cone;
    const LimitColors swing = limitColors(swingMargin(cone, state));
    const LimitColors twist = limitColors(cone.twist - std::abs(state.twist));
    addSwingCone(frame.lines, worldFromFrame, cone.swingY, cone.swingZ, size, swing.outline);
    addSwingCone(frame.solids, worldFromFrame, cone.swingY, cone.swingZ, size, withAlpha(swing.outline, 0.18F));
    const vec3 axis = worldFromChildFrame.rotation * vec3(1, 0, 0);
    const vec3 tip = worldFromFrame.translation + axis * size;
    addArrow(frame.lines, worldFromFrame.translation, tip, swing.present);
    // The span where the child's y may be: present twist taken back, then the limits either way.
    const vec3 neutral = glm::angleAxis(-state.twist, axis) * (worldFromChildFrame.rotation * vec3(0, 1, 0));
    const float small = size * 0.3F;
    addArc(frame.lines, tip, axis, neutral, -cone.twist, cone.twist, small, twist.outline);
    for (const float end : {-cone.twist, cone.twist})
        frame.lines.add(tip, tip + small * (glm::angleAxis(end, axis) * neutral), twist.outline);
    addArrow(frame.lines, tip, tip + worldFromChildFrame.rotation * vec3(0, small, 0), twist.present);
}

void drawLimits(const DollView& doll, FrameDescription& frame) {
    const physics::RagdollProfile& profile = doll.asset.profile;
    const float size = profile.heightM * 0.07F;
    for (const ConstraintProfile& constraint : profile.constraints) {
        const RigidTransform& parent = doll.worldFromBody[constraint.parent];
        const RigidTransform& child = doll.worldFromBody[constraint.child];
        const ConstraintState state = measureConstraint(constraint, parent, child);
        const RigidTransform worldFromFrame = parent * constraint.parentFromFrame;
        if (constraint.kind == ConstraintProfile::Kind::hinge) {
            drawHinge(frame, worldFromFrame, constraint, state, size);
        } else {
            drawCone(frame, worldFromFrame, child * constraint.childFromFrame, constraint, state, size);
        }
    }
}

// From the root body's joint on: what lies above it (a file's root node on the floor) is no bone.
void drawSkeleton(const DollView& doll, DebugScratch& scratch, FrameDescription& frame) {
    const std::vector<int>& parents = doll.asset.character.skeleton.parents;
    const auto& bodyJoints = doll.asset.rig.jointOfBody;
    scratch.positions.clear();
    scratch.parents.clear();
    scratch.inside.clear();
    for (std::size_t joint = 0; joint < parents.size(); ++joint) {
        const bool below = parents[joint] >= 0 && scratch.inside[parents[joint]];
        const bool owns = std::find(bodyJoints.begin(), bodyJoints.end(), static_cast<int>(joint)) != bodyJoints.end();
        scratch.inside.push_back(below || owns);
        scratch.parents.push_back(below ? parents[joint] : -1);
        scratch.positions.push_back(doll.worldFromModel * doll.modelFromJoint[joint].translation);
    }
    addSkeleton(frame.lines, scratch.positions, scratch.parents, debugColors::bone);
}

void drawJointAxes(const DollView& doll, FrameDescription& frame) {
    const float axis = doll.asset.profile.heightM * 0.03F;
    for (const int joint : doll.asset.rig.jointOfBody) {
        addAxes(frame.lines, doll.worldFromModel * doll.modelFromJoint[joint], axis);
    }
}

void drawBody(const DollView& doll, std::size_t i, const DebugLayers& layers, FrameDescription& frame) {
    const BodyProfile& body = doll.asset.profile.bodies[i];
    const RigidTransform& world = doll.worldFromBody[i];
    const Color color = doll.asleep ? debugColors::asleep : debugColors::awake;
    visitShapes(body.shape, [&](const PrimitiveShape& shape, const RigidTransform& bodyFromShape) {
        if (layers.capsules) drawWire(frame, world * bodyFromShape, shape, color);
        if (layers.solidCapsules) drawSolid(frame, world * bodyFromShape, shape, withAlpha(color, kSolidAlpha));
    });
    if (layers.velocities) {
        const vec3 tip = world.translation + doll.states[i].linearVelocity * kVelocitySeconds;
        addArrow(frame.lines, world.translation, tip, debugColors::velocity);
    }
    if (layers.centresOfMass) {
        addCross(frame.lines, world.translation, 0.04F, debugColors::mass);
        addBox(frame.lines, world, inertiaBox(body.massKg, body.inertia), debugColors::mass);
    }
    if (layers.aabbs) {
        const vec3 half = halfAabbOf(body.shape, world.rotation);
        addAabb(frame.lines, world.translation - half, world.translation + half, debugColors::bounds);
    }
}

}  // namespace

float swingMargin(const physics::ConeTwistLimits& cone, const ConstraintState& state) {
    constexpr float kLeast = 1e-4F;  // radians: a limit of zero is still a direction
    const float y = state.swing.y / std::max(cone.swingY, kLeast);
    const float z = state.swing.z / std::max(cone.swingZ, kLeast);
    const float part = std::sqrt(y * y + z * z);  // of the way to the rim
    const float angle = glm::length(vec2(state.swing.y, state.swing.z));
    if (part < kLeast || angle < kLeast) return std::min(cone.swingY, cone.swingZ);
    return angle / part - angle;
}

float limitMargin(const ConstraintProfile& constraint, const ConstraintState& state) {
    if (constraint.kind == ConstraintProfile::Kind::hinge) {
        return std::min(state.hingeAngle - constraint.hinge.lower, constraint.hinge.upper - state.hingeAngle);
    }
    return std::min(swingMargin(constraint.cone, state), constraint.cone.twist - std::abs(state.twist));
}

void drawDollDebug(const DollView& doll, const DebugLayers& layers, DebugScratch& scratch, FrameDescription& frame) {
    for (std::size_t i = 0; i < doll.worldFromBody.size(); ++i)
        drawBody(doll, i, layers, frame);
    if (layers.skeleton) drawSkeleton(doll, scratch, frame);
    if (layers.joints) drawJointAxes(doll, frame);
    if (layers.limits) drawLimits(doll, frame);
}

}  // namespace lutka::scene
