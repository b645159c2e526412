#include "physics/fit/anatomy.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "physics/fit/principal_axes.hpp"

namespace lutka::physics {
namespace {

using animation::Side;

constexpr vec3 kUp{0, 1, 0};
constexpr vec3 kAhead{0, 0, 1};

// The rotation that takes one pair of a direction and an axis across it to another.
quat rotationOfPairs(const vec3& direction, const vec3& axis, const vec3& newDirection, const vec3& newAxis) {
    return rotationFromXY(newDirection, newAxis) * glm::conjugate(rotationFromXY(direction, axis));
}

vec3 across(const vec3& axis, const vec3& direction) {
    const vec3 part = axis - glm::dot(axis, direction) * direction;
    return glm::length(part) > 1e-3F ? glm::normalize(part) : anyPerpendicular(direction);
}

struct Limb {
    Role upper, lower, end;
    float forward;  // the way the lower segment bends: +1 forward (arm), -1 backward (leg)
};

// Where the lower segment moves when it flexes: ahead (arm) or behind (leg), and for a limb that itself points ahead
// up (arm) or down (leg).
vec3 bendingDirection(const Limb& limb, const vec3& direction) {
    return limb.forward * (kAhead + 2.0F * std::max(0.0F, direction.z) * kUp);
}

// By default from the way elbows and knees bend; from the limb's own plane where it is bent enough to show one and the
// plane is anatomically plausible; or so far that it can't be bent the other way.
vec3 hingeAxis(const Limb& limb, const vec3& upper, const vec3& lower) {
    constexpr float kClearBend = 8.0F;
    constexpr float kPlausible = 0.5F;  // cosine of the angle to the default axis
    constexpr float kOnlyFlexed = 45.0F;
    const vec3 expected = across(glm::cross(upper, bendingDirection(limb, upper)), lower);
    const vec3 own = glm::cross(upper, lower);
    const float sine = glm::length(own);
    const bool clear = sine > std::sin(radians(kClearBend)) || glm::dot(upper, lower) < 0.0F;
    const bool onlyFlexed = glm::dot(upper, lower) < std::cos(radians(kOnlyFlexed));
    if (clear && sine > 1e-3F && (onlyFlexed || glm::dot(own / sine, expected) > kPlausible)) return own / sine;
    return expected;
}

void setLimb(Anatomy& anatomy, const BodyPlan& plan, const Limb& limb) {
    const int upper = plan.bodyOf(limb.upper);
    const int lower = plan.bodyOf(limb.lower);
    if (upper < 0 && lower < 0) return;
    const vec3 lowerDirection = plan.bodies[lower >= 0 ? lower : upper].direction();
    const vec3 upperDirection = plan.bodies[upper >= 0 ? upper : lower].direction();
    const vec3 axis = hingeAxis(limb, upperDirection, lowerDirection);
    const vec3 standing = standingDirection(limb.upper);
    // The hinge's own axis in standing: -X for elbows, +X for knees.
    const vec3 standingAxis(-limb.forward, 0, 0);
    if (upper >= 0) {
        anatomy.standardFromAnatomy[upper] =
            rotationOfPairs(standing, standingAxis, upperDirection, across(axis, upperDirection));
    }
    if (lower >= 0) {
        anatomy.standardFromAnatomy[lower] = rotationOfPairs(standing, standingAxis, lowerDirection, axis);
        anatomy.flexionAxis[lower] = axis;
    }
}

// The turn about the hand's length that lays the palm on the flat of its skin; at most a right angle.
quat palmTurn(const PlannedBody& hand, const vec3& direction, const vec3& expectedNormal) {
    constexpr float kFlat = 2.0F;  // ratio of the spreads across the hand
    constexpr std::size_t kFewestPoints = 24;
    const quat none(1, 0, 0, 0);
    if (hand.skin.size() < kFewestPoints) return none;
    const PrincipalAxes axes = principalAxes(hand.skin);
    if (axes.spread[1] < kFlat * axes.spread[2]) return none;
    const vec3 flat = axes.axis[2] - glm::dot(axes.axis[2], direction) * direction;
    if (glm::length(flat) < 0.7F) return none;
    const vec3 normal = glm::normalize(glm::dot(flat, expectedNormal) < 0.0F ? -flat : flat);
    return rotationBetween(expectedNormal, normal);
}

void setHand(Anatomy& anatomy, const BodyPlan& plan, const Limb& arm) {
    const int hand = plan.bodyOf(arm.end);
    const int parent = hand >= 0 ? plan.bodies[hand].parent : -1;
    if (hand < 0 || parent < 0) return;
    const vec3 direction = plan.bodies[hand].direction();
    const vec3 parentDirection = anatomy.standardFromAnatomy[parent] * standingDirection(arm.end);
    const quat carried = rotationBetween(parentDirection, direction) * anatomy.standardFromAnatomy[parent];
    anatomy.standardFromAnatomy[hand] = palmTurn(plan.bodies[hand], direction, carried * vec3(1, 0, 0)) * carried;
}

// A foot stands flat in the bind pose unless it plainly points down (a hanging figure).
quat footRotation(const PlannedBody& foot) {
    constexpr float kSteep = 60.0F;
    constexpr float kInstepSlope = 30.0F;  // of the line from ankle to toes in a flat foot
    const vec3 direction = foot.direction();
    const vec3 level(direction.x, 0, direction.z);
    const float slope = std::atan2(-direction.y, glm::length(level));
    const bool pointsDown = slope > radians(kSteep);
    quat rotation(1, 0, 0, 0);
    if (glm::length(level) > 0.2F && direction.z > -0.2F) {
        rotation = glm::angleAxis(std::atan2(level.x, std::max(level.z, 0.0F)), kUp);
    }
    // Without a toe joint and without skin the direction is a guess and level.
    if (pointsDown) rotation = rotation * glm::angleAxis(slope - radians(kInstepSlope), vec3(1, 0, 0));
    return rotation;
}

void setTrunk(Anatomy& anatomy, const BodyPlan& plan) {
    constexpr float kLean = 10.0F;
    const auto middleOf = [&](Role left, Role right, const vec3& otherwise) {
        const int a = plan.bodyOf(left);
        const int b = plan.bodyOf(right);
        return a >= 0 && b >= 0 ? 0.5F * (plan.bodies[a].start + plan.bodies[b].start) : otherwise;
    };
    const int head = plan.bodyOf(Role::head);
    const vec3 hips = plan.bodies[0].start;
    const vec3 top = head >= 0 ? plan.bodies[head].start : hips + kUp;
    const vec3 torso = middleOf(Role::leftUpperArm, Role::rightUpperArm, top) -
                       middleOf(Role::leftUpperLeg, Role::rightUpperLeg, hips);
    if (glm::length(torso) < 1e-3F * plan.heightM) return;
    const vec3 up = glm::normalize(torso);
    if (up.y > std::cos(radians(kLean))) return;
    for (const Role role :
         {Role::spine, Role::chest, Role::upperChest, Role::neck, Role::leftShoulder, Role::rightShoulder}) {
        const int body = plan.bodyOf(role);
        if (body >= 0) anatomy.standardFromAnatomy[body] = rotationBetween(kUp, up);
    }
}

}  // namespace

vec3 standingFlexionAxis(Role role) {
    switch (sideOf(role) == Side::right ? mirrored(role) : role) {
        case Role::leftShoulder:
            return {0, 0, 1};
        case Role::leftHand:
            return {0, 0, -1};
        case Role::leftUpperArm:
        case Role::leftLowerArm:
        case Role::leftUpperLeg:
        case Role::leftFoot:
        case Role::leftToes:
            return {-1, 0, 0};
        default:  // the knee, the trunk and the head
            return {1, 0, 0};
    }
}

Anatomy findAnatomy(const BodyPlan& plan) {
    Anatomy anatomy;
    anatomy.standardFromAnatomy.assign(plan.bodies.size(), quat(1, 0, 0, 0));
    anatomy.flexionAxis.assign(plan.bodies.size(), vec3(0));
    setTrunk(anatomy, plan);
    for (const Limb& arm : {Limb{Role::leftUpperArm, Role::leftLowerArm, Role::leftHand, 1.0F},
                            Limb{Role::rightUpperArm, Role::rightLowerArm, Role::rightHand, 1.0F}}) {
        setLimb(anatomy, plan, arm);
        setHand(anatomy, plan, arm);
    }
    for (const Limb& leg : {Limb{Role::leftUpperLeg, Role::leftLowerLeg, Role::leftFoot, -1.0F},
                            Limb{Role::rightUpperLeg, Role::rightLowerLeg, Role::rightFoot, -1.0F}}) {
        setLimb(anatomy, plan, leg);
    }
    for (const auto& [foot, toes] :
         {std::pair{Role::leftFoot, Role::leftToes}, std::pair{Role::rightFoot, Role::rightToes}}) {
        if (plan.bodyOf(foot) < 0) continue;
        const quat rotation = footRotation(plan.bodies[plan.bodyOf(foot)]);
        anatomy.standardFromAnatomy[plan.bodyOf(foot)] = rotation;
        if (plan.bodyOf(toes) >= 0) anatomy.standardFromAnatomy[plan.bodyOf(toes)] = rotation;
    }
    return anatomy;
}

}  // namespace lutka::physics
