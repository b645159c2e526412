#include "editor/document_state.hpp"

#include <fmt/format.h>

#include "physics/shape.hpp"

namespace lutka::editor {
namespace {

using animation::HumanoidMap;
using Fixed = std::array<std::optional<int>, animation::kRoleCount>;

constexpr float kLightHalfSize = 0.12F;  // of the marker that is drawn and picked

void applyTo(physics::BodyProfile& body, const PartEdits& edits) {
    if (edits.shape) body.shape = *edits.shape;
    if (edits.massKg) body.massKg = *edits.massKg;
    if (edits.shape || edits.massKg) body.inertia = physics::shapeInertia(body.shape, body.massKg);
}

void applyTo(physics::ConstraintProfile& constraint, const PartEdits& edits) {
    if (edits.hinge) constraint.hinge = *edits.hinge;
    if (edits.cone) constraint.cone = *edits.cone;
    if (edits.frictionNm) constraint.frictionNm = *edits.frictionNm;
}

// Two roles on one joint can only come from the user's own choices.
std::optional<Error> checkTwice(const animation::Character& character, const Fixed& fixed) {
    for (int a = 0; a < animation::kRoleCount; ++a) {
        for (int b = a + 1; b < animation::kRoleCount; ++b) {
            if (!fixed[a] || fixed[a] != fixed[b] || *fixed[a] == animation::kNoJoint) continue;
            return Error{
                ErrorCode::input,
                fmt::format("the joint \"{}\" cannot be both {} and {}", character.skeleton.names[*fixed[a]],
                            animation::roleName(animation::roleAt(a)), animation::roleName(animation::roleAt(b))),
                "", "unmap one of them first"};
        }
    }
    return std::nullopt;
}

bool sameShape(const physics::BodyShape& a, const physics::BodyShape& b) {
    if (a.kind != b.kind) return false;
    switch (a.kind) {
        case physics::BodyShape::Kind::box:
            return a.halfExtents == b.halfExtents;
        case physics::BodyShape::Kind::sphere:
            return a.radius == b.radius;
        case physics::BodyShape::Kind::capsule:
            break;
    }
    return a.radius == b.radius && a.halfLength == b.halfLength;
}

}  // namespace

std::string_view objectKindName(SceneObject::Kind kind) {
    switch (kind) {
        case SceneObject::Kind::box:
            return "Box";
        case SceneObject::Kind::ball:
            return "Ball";
        case SceneObject::Kind::light:
            break;
    }
    return "Light";
}

vec3 halfSizeOf(const SceneObject& object) {
    switch (object.kind) {
        case SceneObject::Kind::box:
            return object.halfExtents;
        case SceneObject::Kind::ball:
            return vec3(object.radius);
        case SceneObject::Kind::light:
            break;
    }
    return vec3(kLightHalfSize);
}

std::array<PartEdits, animation::kRoleCount> editsBetween(const physics::RagdollProfile& fitted,
                                                          const physics::RagdollProfile& given) {
    std::array<PartEdits, animation::kRoleCount> edits{};
    for (std::size_t i = 0; i < given.bodies.size(); ++i) {
        const physics::BodyProfile& body = given.bodies[i];
        const int same = physics::bodyOf(fitted, body.role);
        if (same < 0) continue;
        PartEdits& part = edits[animation::indexOf(body.role)];
        const physics::BodyProfile& plain = fitted.bodies[same];
        if (!sameShape(plain.shape, body.shape)) part.shape = body.shape;
        if (plain.massKg != body.massKg) part.massKg = body.massKg;
        if (i == 0 || same == 0) continue;  // the root has no constraint of its own
        const physics::ConstraintProfile& joint = given.constraints[i - 1];
        const physics::ConstraintProfile& plainJoint = fitted.constraints[same - 1];
        const auto& hinge = joint.hinge;
        const auto& cone = joint.cone;
        if (hinge.lower != plainJoint.hinge.lower || hinge.upper != plainJoint.hinge.upper) part.hinge = hinge;
        if (cone.swingY != plainJoint.cone.swingY || cone.swingZ != plainJoint.cone.swingZ ||
            cone.twist != plainJoint.cone.twist) {
            part.cone = cone;
        }
        if (joint.frictionNm != plainJoint.frictionNm) part.frictionNm = joint.frictionNm;
    }
    return edits;
}

void fillUnset(std::array<PartEdits, animation::kRoleCount>& edits,
               const std::array<PartEdits, animation::kRoleCount>& others) {
    for (int role = 0; role < animation::kRoleCount; ++role) {
        PartEdits& part = edits[role];
        const PartEdits& other = others[role];
        if (!part.shape) part.shape = other.shape;
        if (!part.massKg) part.massKg = other.massKg;
        if (!part.hinge) part.hinge = other.hinge;
        if (!part.cone) part.cone = other.cone;
        if (!part.frictionNm) part.frictionNm = other.frictionNm;
    }
}

physics::RagdollProfile applyEdits(const physics::RagdollProfile& base,
                                   const std::array<PartEdits, animation::kRoleCount>& edits) {
    physics::RagdollProfile profile = base;
    bool massChanged = false;
    for (physics::BodyProfile& body : profile.bodies) {
        const PartEdits& part = edits[animation::indexOf(body.role)];
        massChanged = massChanged || part.massKg.has_value();
        applyTo(body, part);
    }
    for (physics::ConstraintProfile& constraint : profile.constraints) {
        applyTo(constraint, edits[animation::indexOf(profile.bodies[constraint.child].role)]);
    }
    if (massChanged) {
        profile.totalMassKg = 0;
        for (const physics::BodyProfile& body : profile.bodies)
            profile.totalMassKg += body.massKg;
    }
    return profile;
}

Result<HumanoidMap> mapWithFixed(const animation::Character& character, const Fixed& fixed) {
    if (const auto twice = checkTwice(character, fixed)) return *twice;
    animation::MapOptions options;
    for (int role = 0; role < animation::kRoleCount; ++role) {
        if (fixed[role] && *fixed[role] != animation::kNoJoint) options.fixed[role] = fixed[role];
    }
    HumanoidMap map = animation::mapHumanoid(character, options);
    if (!map.humanoid) {
        return Error{ErrorCode::input,
                     "with these bindings the figure is not a humanoid: " +
                         (map.warnings.empty() ? std::string("no reason was given") : map.warnings.front()),
                     "", "assign another joint"};
    }
    for (int role = 0; role < animation::kRoleCount; ++role) {
        if (fixed[role] != animation::kNoJoint) continue;
        if (animation::isRequired(animation::roleAt(role))) {
            return Error{ErrorCode::input,
                         fmt::format("{} is required and cannot be left without a joint",
                                     animation::roleName(animation::roleAt(role))),
                         "", "assign another joint instead"};
        }
        map.roles[role].reset();
    }
    return map;
}

}  // namespace lutka::editor
