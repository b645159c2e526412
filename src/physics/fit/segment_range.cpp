#include "physics/fit/segment_range.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

namespace lutka::physics {
namespace {

using RigSegment = animation::Segment;
using animation::Side;

constexpr float kBeyondClips = 15.0F;  // degrees
constexpr float kLeastHinge = 20.0F;
constexpr float kMostHinge = 170.0F;

// Half angles in degrees: about y (side), z (flexion) and x (twist).
struct ConeDegrees {
    float side, flexion, twist;
};

ConeDegrees coneOf(RigSegment::Kind kind) {
    switch (kind) {
        case RigSegment::Kind::trunk:
            return {25, 25, 20};
        case RigSegment::Kind::limbRoot:
            return {50, 60, 35};
        case RigSegment::Kind::limb:
            return {30, 60, 25};
        case RigSegment::Kind::held:
            return {10, 10, 10};
        case RigSegment::Kind::chain:
            break;
    }
    return {40, 40, 30};
}

vec3 acrossSegment(const vec3& axis, const vec3& along) {
    const vec3 part = axis - glm::dot(axis, along) * along;
    return glm::length(part) > 0.3F ? glm::normalize(part) : vec3(0);
}

vec3 flexionAxis(const vec3& along) {
    for (const vec3& axis : {vec3(1, 0, 0), vec3(0, 1, 0)}) {
        const vec3 across = acrossSegment(axis, along);
        if (across != vec3(0)) return across;
    }
    return anyPerpendicular(along);
}

// The frame of a body on the left or in the middle.
quat leftFrame(const vec3& along, const vec3& axis) {
    return rotationFromXY(along, glm::cross(axis, along));
}

}  // namespace

quat segmentFrame(const BodyPlan& plan, int child) {
    const PlannedBody& body = plan.bodies[child];
    const bool right = body.side == Side::right;
    // Seen in a mirror, so that both sides come out alike; an axis of rotation mirrors as a pseudovector.
    const vec3 along = right ? body.direction() * vec3(-1, 1, 1) : body.direction();
    vec3 axis = flexionAxis(along);
    if (body.segment && body.segment->hinge) {
        const vec3 seen = body.segment->hinge->axis * (right ? vec3(1, -1, -1) : vec3(1));
        const vec3 across = acrossSegment(seen, along);
        if (across != vec3(0)) axis = across;
    }
    if (!right) return leftFrame(along, axis);
    return leftFrame(body.direction(), axis * vec3(1, -1, -1));
}

void setSegmentRange(ConstraintProfile& constraint, const PlannedBody& body) {
    const RigSegment segment = body.segment.value_or(RigSegment{});
    if (segment.hinge) {
        const auto beyond = [](float angle) {
            return radians(std::clamp(degrees(std::abs(angle)) + kBeyondClips, kLeastHinge, kMostHinge));
        };
        constraint.kind = ConstraintProfile::Kind::hinge;
        constraint.hinge = {-beyond(segment.hinge->low), beyond(segment.hinge->high)};
        return;
    }
    const ConeDegrees cone = coneOf(segment.kind);
    constraint.kind = ConstraintProfile::Kind::coneTwist;
    constraint.cone = {radians(cone.side), radians(cone.flexion), radians(cone.twist)};
}

}  // namespace lutka::physics
