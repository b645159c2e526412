#include "support/dolls.hpp"

#include <glm/geometric.hpp>

#include "physics/collision/shape_distance.hpp"
#include "support/rigs.hpp"

namespace lutka::test {
namespace {

using animation::Role;
using physics::BodyProfile;
using physics::BodyShape;
using physics::ConeTwistLimits;
using physics::ConstraintProfile;
using physics::HingeLimits;
using physics::RagdollProfile;
using physics::Segment;

// Principal moments of a solid capsule about its centre, axis y.
vec3 capsuleInertia(float massKg, float radius, float halfLength) {
    const float r2 = radius * radius;
    const float length = 2.0F * halfLength;
    const float cylinderVolume = kPi * r2 * length;
    const float capsVolume = 4.0F / 3.0F * kPi * r2 * radius;
    const float cylinder = massKg * cylinderVolume / (cylinderVolume + capsVolume);
    const float caps = massKg - cylinder;
    const float along = 0.5F * cylinder * r2 + 0.4F * caps * r2;
    const float across = cylinder * (0.25F * r2 + length * length / 12.0F) +
                         caps * (0.4F * r2 + 0.25F * length * length + 0.375F * length * radius);
    return {across, along, across};
}

BodyProfile capsuleBody(Role role, const RigidTransform& modelFromJoint, const Segment& core, float radius,
                        float massKg) {
    BodyProfile body;
    setRole(body, role);
    body.joint = std::string(animation::roleName(role));
    body.shape.kind = BodyShape::Kind::capsule;
    body.shape.radius = radius;
    body.shape.halfLength = 0.5F * glm::distance(core.start, core.end);
    const RigidTransform modelFromBody{rotationBetween({0, 1, 0}, core.end - core.start), core.at(0.5F)};
    body.jointFromBody = inverse(modelFromJoint) * modelFromBody;
    body.massKg = massKg;
    body.inertia = capsuleInertia(massKg, radius, body.shape.halfLength);
    return body;
}

// The parts of a left or middle limb: mirrored for the right.
struct Part {
    Role role;
    Role parent;
    Segment core;  // of the capsule, model space
    float radius;
    float massKg;
    vec3 along;    // frame x in the bind pose
    vec3 across;   // frame y's rough direction
    vec3 neutral;  // rotation vector (degrees) from the bind pose to the middle of the range
    vec3 limits;   // degrees: swing y, swing z, twist; a hinge has {half range, 0, 0}
    float frictionNm;
};

const std::vector<Part>& parts() {
    using enum Role;
    static const std::vector<Part> all = {
        {hips, hips, {{-0.07F, 0.95F, 0}, {0.07F, 0.95F, 0}}, 0.12F, 8.4F, {}, {}, {}, {}, 0},
        {spine, hips, {{0, 1.10F, 0}, {0, 1.16F, 0}}, 0.12F, 12.2F, {0, 1, 0}, {0, 0, 1}, {}, {25, 25, 20}, 4},
        {chest,
         spine,
         {{-0.07F, 1.33F, 0}, {0.07F, 1.33F, 0}},
         0.13F,
         12.0F,
         {0, 1, 0},
         {0, 0, 1},
         {},
         {20, 20, 20},
         4},
        {head, chest, {{0, 1.62F, 0}, {0, 1.67F, 0}}, 0.09F, 5.2F, {0, 1, 0}, {0, 0, 1}, {}, {45, 40, 50}, 2},
        {leftUpperArm,
         chest,
         {{0.22F, 1.42F, 0}, {0.42F, 1.42F, 0}},
         0.05F,
         2.03F,
         {1, 0, 0},
         {0, 1, 0},
         {0, -30, -30},
         {80, 75, 60},
         1},
        {leftLowerArm,
         leftUpperArm,
         {{0.49F, 1.42F, 0}, {0.69F, 1.42F, 0}},
         0.04F,
         1.2F,
         {1, 0, 0},
         {0, 0, -1},
         {0, -70, 0},
         {75, 0, 0},
         0.5F},
        {leftHand,
         leftLowerArm,
         {{0.74F, 1.42F, 0}, {0.84F, 1.42F, 0}},
         0.03F,
         0.46F,
         {1, 0, 0},
         {0, 1, 0},
         {},
         {25, 50, 40},
         0.2F},
        {leftUpperLeg,
         hips,
         {{0.10F, 0.84F, 0}, {0.10F, 0.56F, 0}},
         0.075F,
         10.6F,
         {0, -1, 0},
         {1, 0, 0},
         {-40, 0, 0},
         {60, 40, 35},
         3},
        {leftLowerLeg,
         leftUpperLeg,
         {{0.10F, 0.46F, 0}, {0.10F, 0.14F, 0}},
         0.055F,
         3.25F,
         {0, -1, 0},
         {0, 0, 1},
         {70, 0, 0},
         {75, 0, 0},
         1},
        {leftFoot,
         leftLowerLeg,
         {{0.10F, 0.04F, 0}, {0.10F, 0.04F, 0.14F}},
         0.04F,
         1.03F,
         {0, 0, 1},
         {0, 1, 0},
         {10, 0, 0},
         {20, 35, 15},
         0.5F},
    };
    return all;
}

vec3 mirror(const vec3& v) {
    return {-v.x, v.y, v.z};
}

Part mirroredPart(const Part& left) {
    Part right = left;
    right.role = animation::mirrored(left.role);
    right.parent = animation::mirrored(left.parent);
    right.core = {mirror(left.core.start), mirror(left.core.end)};
    right.along = mirror(left.along);
    right.across = mirror(left.across);
    // A rotation vector mirrors like a torque: the other two components change their sign.
    right.neutral = {left.neutral.x, -left.neutral.y, -left.neutral.z};
    return right;
}

bool isHinge(Role role) {
    using enum Role;
    return role == leftLowerArm || role == rightLowerArm || role == leftLowerLeg || role == rightLowerLeg;
}

ConstraintProfile constrain(const RagdollProfile& profile, const std::vector<RigidTransform>& modelFromBody,
                            const Part& part, const vec3& anchor) {
    ConstraintProfile c;
    c.kind = isHinge(part.role) ? ConstraintProfile::Kind::hinge : ConstraintProfile::Kind::coneTwist;
    c.parent = physics::bodyOf(profile, part.parent);
    c.child = static_cast<int>(modelFromBody.size()) - 1;
    const quat childFrame = rotationFromXY(part.along, part.across);
    const float angle = radians(glm::length(part.neutral));
    const quat neutral = angle > 0 ? glm::angleAxis(angle, glm::normalize(part.neutral)) : quat(1, 0, 0, 0);
    c.parentFromFrame = inverse(modelFromBody[c.parent]) * RigidTransform{neutral * childFrame, anchor};
    c.childFromFrame = inverse(modelFromBody[c.child]) * RigidTransform{childFrame, anchor};
    if (isHinge(part.role))
        c.hinge = {-radians(part.limits.x), radians(part.limits.x)};
    else
        c.cone = {radians(part.limits.x), radians(part.limits.y), radians(part.limits.z)};
    c.frictionNm = part.frictionNm;
    return c;
}

// Bodies that touch in the bind pose without being linked never collide.
void filterOverlaps(RagdollProfile& profile, const std::vector<Part>& all) {
    for (int a = 0; a < static_cast<int>(all.size()); ++a) {
        for (int b = a + 1; b < static_cast<int>(all.size()); ++b) {
            const auto [s, t] = physics::closestBetweenSegments(all[a].core, all[b].core);
            const float gap = glm::distance(all[a].core.at(s), all[b].core.at(t)) - all[a].radius - all[b].radius;
            if (gap < 0.01F && all[b].parent != all[a].role) profile.filteredPairs.emplace_back(a, b);
        }
    }
}

RagdollProfile pairOf(ConstraintProfile constraint, float massKg) {
    RagdollProfile pair;
    pair.name = "pair";
    pair.heightM = 0.8F;
    pair.totalMassKg = 2.0F * massKg;
    pair.bodies.push_back(capsuleBody(Role::hips, {}, {{-0.35F, 0, 0}, {-0.05F, 0, 0}}, 0.05F, massKg));
    pair.bodies.push_back(capsuleBody(Role::spine, {}, {{0.05F, 0, 0}, {0.35F, 0, 0}}, 0.05F, massKg));
    for (BodyProfile& body : pair.bodies)
        body.jointPath = body.joint;
    constraint.parent = 0;
    constraint.child = 1;
    constraint.parentFromFrame = inverse(pair.bodies[0].jointFromBody);
    constraint.childFromFrame = inverse(pair.bodies[1].jointFromBody);
    pair.constraints.push_back(constraint);
    return pair;
}

}  // namespace

RagdollProfile makeDoll() {
    const animation::Character biped = makeBiped();
    RagdollProfile profile;
    profile.name = "hand-made doll";
    std::vector<Part> all = parts();
    for (std::size_t i = 4; i < parts().size(); ++i)
        all.push_back(mirroredPart(parts()[i]));
    std::vector<RigidTransform> modelFromBody;
    profile.totalMassKg = 0.0F;
    for (const Part& part : all) {
        const int joint = animation::findJoint(biped.skeleton, animation::roleName(part.role));
        const RigidTransform& modelFromJoint = biped.skeleton.bindModelFromJoint[joint];
        profile.bodies.push_back(capsuleBody(part.role, modelFromJoint, part.core, part.radius, part.massKg));
        profile.bodies.back().jointPath = animation::jointPath(biped.skeleton, joint);
        profile.totalMassKg += part.massKg;
        modelFromBody.push_back(modelFromJoint * profile.bodies.back().jointFromBody);
        if (part.role != part.parent)
            profile.constraints.push_back(constrain(profile, modelFromBody, part, modelFromJoint.translation));
    }
    filterOverlaps(profile, all);
    return profile;
}

RagdollProfile makePair(const ConeTwistLimits& limits, float massKg) {
    ConstraintProfile constraint;
    constraint.kind = ConstraintProfile::Kind::coneTwist;
    constraint.cone = limits;
    return pairOf(constraint, massKg);
}

RagdollProfile makePair(const HingeLimits& limits, float massKg) {
    ConstraintProfile constraint;
    constraint.kind = ConstraintProfile::Kind::hinge;
    constraint.hinge = limits;
    return pairOf(constraint, massKg);
}

std::vector<vec3> pointsOnEllipsoid(const vec3& half, int count, Random& random) {
    std::vector<vec3> points;
    while (static_cast<int>(points.size()) < count) {
        const float x = random.uniform(-1, 1);
        const float y = random.uniform(-1, 1);
        const vec3 p(x, y, random.uniform(-1, 1));
        if (glm::length(p) > 0.1F && glm::length(p) < 1.0F) points.push_back(half * glm::normalize(p));
    }
    return points;
}

}  // namespace lutka::test
