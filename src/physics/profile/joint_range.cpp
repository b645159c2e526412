#include "physics/profile/joint_range.hpp"

#include <algorithm>
#include <glm/gtc/quaternion.hpp>
#include <utility>

#include "core/swing_twist.hpp"

namespace lutka::physics {
namespace {

constexpr float kLeastHalf = radians(1.0F);
constexpr float kMostHalf = radians(175.0F);
constexpr float kSameAngle = 1e-5F;

float middle(const AngleSpan& span) {
    return 0.5F * (span.low + span.high);
}

float half(const AngleSpan& span) {
    return std::clamp(0.5F * (span.high - span.low), kLeastHalf, kMostHalf);
}

AngleSpan around(float halfSpan, float present) {
    return {-halfSpan - present, halfSpan - present};
}

float hingeAngleInBind(const ConstraintProfile& constraint, const BindFrames& bind) {
    const quat relative = relativeFrame(constraint, bind);
    return std::remainder(2.0F * std::atan2(relative.z, relative.w), 2.0F * kPi);
}

void setHingeRange(ConstraintProfile& constraint, const AngleSpan& flexion, const BindFrames& bind) {
    const float present = hingeAngleInBind(constraint, bind);
    HingeLimits limits{present + flexion.low, std::max(present + flexion.high, present + flexion.low)};
    // A hinge's limits lie about its neutral pose: a range that leaves it takes the neutral pose along.
    if (limits.lower > 0.0F || limits.upper < 0.0F || limits.lower < -kPi || limits.upper > kPi) {
        const float shift = 0.5F * (limits.lower + limits.upper);
        shiftNeutral(constraint, glm::angleAxis(shift, vec3(0, 0, 1)));
        limits = {std::max(limits.lower - shift, -kPi), std::min(limits.upper - shift, kPi)};
    }
    constraint.hinge = limits;
}

void setConeRange(ConstraintProfile& constraint, const JointRange& range, const BindFrames& bind) {
    constraint.cone = {half(range.side), half(range.flexion), half(range.twist)};
    const quat relative = relativeFrame(constraint, bind);
    const SwingTwist now = swingTwist(relative);
    const SwingTwist wanted{{0.0F, -middle(range.side), -middle(range.flexion)}, -middle(range.twist)};
    const bool same = std::abs(now.swing.y - wanted.swing.y) < kSameAngle &&
                      std::abs(now.swing.z - wanted.swing.z) < kSameAngle &&
                      std::abs(now.twist - wanted.twist) < kSameAngle;
    if (!same) shiftNeutral(constraint, relative * glm::conjugate(rotationOf(wanted)));
}

// For the left side; the right one has low and high of side and twist the other way round.
JointWords leftWords(Role role) {
    constexpr MotionWords bend{"Flexion", "extension", "flexion"};
    constexpr MotionWords abduction{"Abduction", "adduction", "abduction"};
    constexpr MotionWords rotation{"Rotation", "outward turn", "inward turn"};
    switch (role) {
        case Role::leftShoulder:
            return {{"Elevation", "depression", "elevation"},
                    {"Retraction", "protraction", "retraction"},
                    {"Roll", "roll backward", "roll forward"}};
        case Role::leftHand:
            return {
                bend, {"Deviation", "ulnar deviation", "radial deviation"}, {"Pronation", "supination", "pronation"}};
        case Role::leftFoot:
            return {
                {"Dorsiflexion", "plantar flexion", "dorsiflexion"}, abduction, {"Eversion", "inversion", "eversion"}};
        case Role::leftToes:
            return {{"Extension", "flexion", "extension"}, abduction, {"Roll", "inward roll", "outward roll"}};
        case Role::leftUpperArm:
        case Role::leftLowerArm:
        case Role::leftUpperLeg:
        case Role::leftLowerLeg:
            return {bend, abduction, rotation};
        default:
            return {bend, {"Side bend", "right bend", "left bend"}, {"Turn", "right turn", "left turn"}};
    }
}

}  // namespace

JointRange jointRange(const ConstraintProfile& constraint, const BindFrames& bind) {
    if (constraint.kind == ConstraintProfile::Kind::hinge) {
        const float present = hingeAngleInBind(constraint, bind);
        return {{constraint.hinge.lower - present, constraint.hinge.upper - present}, {}, {}};
    }
    const SwingTwist present = swingTwist(relativeFrame(constraint, bind));
    return {around(constraint.cone.swingZ, present.swing.z), around(constraint.cone.swingY, present.swing.y),
            around(constraint.cone.twist, present.twist)};
}

void setJointRange(ConstraintProfile& constraint, const JointRange& range, const BindFrames& bind) {
    if (constraint.kind == ConstraintProfile::Kind::hinge) {
        setHingeRange(constraint, range.flexion, bind);
    } else {
        setConeRange(constraint, range, bind);
    }
}

JointRange mirrored(const JointRange& range) {
    return {range.flexion, {-range.side.high, -range.side.low}, {-range.twist.high, -range.twist.low}};
}

JointWords jointWords(std::optional<Role> role) {
    if (role) return jointWords(*role);
    return {{"Bend", "bend back", "bend forward"},
            {"Side bend", "right bend", "left bend"},
            {"Twist", "right twist", "left twist"}};
}

JointWords jointWords(Role role) {
    if (animation::sideOf(role) != animation::Side::right) return leftWords(role);
    JointWords words = leftWords(animation::mirrored(role));
    std::swap(words.side.low, words.side.high);
    std::swap(words.twist.low, words.twist.high);
    return words;
}

}  // namespace lutka::physics
