#include "physics/fit/range_of_motion.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "core/swing_twist.hpp"
#include "physics/fit/anatomy.hpp"

namespace lutka::physics {
namespace {

using animation::Side;

// Degrees from anatomical standing. Flexion is about frame z (standingFlexionAxis); side about frame y (z × x): hip and
// foot outward, hand towards the thumb, trunk and head to the left, clavicle backward; rotation about frame x, along
// the segment, by the right-hand rule. For the left side; the right is the mirror image.
struct Span {
    float low, high;
    [[nodiscard]] float middle() const { return radians(0.5F * (low + high)); }
    [[nodiscard]] float half() const { return radians(0.5F * (high - low)); }
    [[nodiscard]] Span divided(float by) const { return {low / by, high / by}; }
};
struct Ranges {
    Span flexion, side, rotation;
};

constexpr Span kElbow{-5, 150};  // AAOS 0..150; five degrees beyond straight are common and hold straight bind poses
constexpr Span kKnee{-5, 135};   // AAOS 0..135; DSHS extension 0..10
constexpr Ranges kHip{{-30, 120}, {-30, 45}, {-45, 45}};
// Rotation: inversion 35, eversion 15. Side: toes stand outward by the twist of the shin bone, and a bent knee lets the
// shin turn, which a hinge does not; the ankle takes both over.
constexpr Ranges kAnkle{{-50, 20}, {-20, 30}, {-35, 15}};
constexpr Ranges kToes{{-30, 60}, {-10, 10}, {-10, 10}};
constexpr Ranges kWrist{{-70, 80}, {-30, 20}, {-80, 80}};  // rotation: the forearm's pronation and supination
constexpr Ranges kTrunk{{-25, 80}, {-35, 35}, {-45, 45}};
constexpr Ranges kNeckAndHead{{-45, 45}, {-45, 45}, {-60, 60}};
constexpr Ranges kClavicle{{-10, 40}, {-20, 25}, {-20, 20}};
// Below this a limit is known to jitter; a real range below it is rounded up.
constexpr float kSmallestHalfSpan = 10.0F;

RangeOfMotion hingeRange(const Span& span) {
    RangeOfMotion range;
    range.kind = ConstraintProfile::Kind::hinge;
    range.neutralFlexion = span.middle();
    range.hinge = {-span.half(), span.half()};
    return range;
}

RangeOfMotion coneRange(Role role, const Ranges& ranges) {
    const float least = radians(kSmallestHalfSpan);
    RangeOfMotion range;
    range.cone.swingZ = std::max(least, ranges.flexion.half());
    range.cone.swingY = std::max(least, ranges.side.half());
    range.cone.twist = std::max(least, ranges.rotation.half());
    const quat frame = standingFrame(role);
    const SwingTwist middle{{0, ranges.side.middle(), ranges.flexion.middle()}, ranges.rotation.middle()};
    range.neutral = frame * rotationOf(middle) * glm::conjugate(frame);
    return range;
}

// Raised sideways, brought forward, then turned outward about its length: the middle of what an arm does.
RangeOfMotion shoulderRange(float raisedDeg, float swingDeg) {
    constexpr float kForward = 45.0F;
    constexpr float kOutwardTurn = 20.0F;
    constexpr float kTurnHalfSpan = 75.0F;
    const quat raised =
        glm::angleAxis(radians(-kForward), vec3(0, 1, 0)) * glm::angleAxis(radians(raisedDeg), vec3(0, 0, 1));
    const vec3 along = raised * standingDirection(Role::leftUpperArm);
    RangeOfMotion range;
    range.neutral = glm::angleAxis(radians(-kOutwardTurn), along) * raised;
    range.cone = {radians(swingDeg), radians(swingDeg), radians(kTurnHalfSpan)};
    return range;
}

float trunkJointCount(const BodyPlan& plan) {
    int count = 0;
    for (const Role role : {Role::spine, Role::chest, Role::upperChest})
        count += plan.bodyOf(role) >= 0 ? 1 : 0;
    return static_cast<float>(std::max(count, 1));
}

Ranges divided(const Ranges& ranges, float by) {
    return {ranges.flexion.divided(by), ranges.side.divided(by), ranges.rotation.divided(by)};
}

RangeOfMotion leftRange(const BodyPlan& plan, Role role) {
    switch (role) {
        case Role::leftShoulder:
            return coneRange(role, kClavicle);
        case Role::leftUpperArm:
            return plan.bodyOf(Role::leftShoulder) >= 0 ? shoulderRange(50.0F, 70.0F) : shoulderRange(75.0F, 85.0F);
        case Role::leftLowerArm:
            return hingeRange(kElbow);
        case Role::leftHand:
            return coneRange(role, kWrist);
        case Role::leftUpperLeg:
            return coneRange(role, kHip);
        case Role::leftLowerLeg:
            return hingeRange(kKnee);
        case Role::leftFoot:
            return coneRange(role, kAnkle);
        case Role::leftToes:
            return coneRange(role, kToes);
        case Role::neck:
        case Role::head:
            return coneRange(role, plan.bodyOf(Role::neck) >= 0 ? divided(kNeckAndHead, 2.0F) : kNeckAndHead);
        default:
            return coneRange(role, divided(kTrunk, trunkJointCount(plan)));
    }
}

}  // namespace

quat standingFrame(Role role) {
    const vec3 x = sideOf(role) == Side::right ? standingDirection(role) * vec3(-1, 1, 1) : standingDirection(role);
    // An axis of rotation mirrors as a pseudovector.
    const vec3 z =
        sideOf(role) == Side::right ? standingFlexionAxis(role) * vec3(1, -1, -1) : standingFlexionAxis(role);
    return rotationFromXY(x, glm::cross(z, x));
}

RangeOfMotion rangeOfMotion(const BodyPlan& plan, Role role) {
    if (sideOf(role) != Side::right) return leftRange(plan, role);
    RangeOfMotion range = leftRange(plan, mirrored(role));
    range.neutral = mirrorRotation(range.neutral);
    return range;
}

}  // namespace lutka::physics
