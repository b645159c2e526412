#include "physics/body_tips.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "physics/principal_axes.hpp"
#include "physics/quantile.hpp"

namespace lutka::physics {
namespace {

using animation::Character;
using animation::HumanoidMap;

constexpr std::size_t kFewestPoints = 8;

bool isOneOf(Role role, Role left) {
    return role == left || role == mirrored(left);
}

// Length of a tip without skin, as a share of the height; and how far from its joint skin may still be the limb's own.
struct TipProportions {
    float length, reach;
};
TipProportions proportionsOf(Role role) {
    if (role == Role::head) return {0.12F, 0.35F};
    if (isOneOf(role, Role::leftHand)) return {0.10F, 0.14F};
    if (isOneOf(role, Role::leftFoot)) return {0.13F, 0.22F};
    if (isOneOf(role, Role::leftToes)) return {0.05F, 0.10F};
    return {0.14F, 0.35F};
}

// A hand of a figure with large hands may reach as far as its forearm is long.
float reachOf(const BodyPlan& plan, const PlannedBody& body) {
    const float reach = proportionsOf(body.role).reach * plan.heightM;
    if (isOneOf(body.role, Role::leftHand) && body.parent >= 0) {
        return std::max(reach, 0.8F * plan.bodies[body.parent].length());
    }
    return reach;
}

// The joints right below a body's joint (fingers, toe) tell its direction where there is no skin.
std::vector<SkinPoint> jointsBelow(const Character& character, const HumanoidMap& map, int joint) {
    std::vector<SkinPoint> points;
    const animation::Skeleton& skeleton = character.skeleton;
    for (int child = joint + 1; child < skeleton.jointCount(); ++child) {
        if (!isAncestorOrSelf(skeleton, joint, child)) continue;
        points.push_back({map.standardFromModel * skeleton.bindModelFromJoint[child].translation, 0.0F});
    }
    return points;
}

void setTip(PlannedBody& body, const std::vector<SkinPoint>& points, vec3 direction, float least) {
    const auto along = [&](const SkinPoint& point) { return glm::dot(point.position - body.start, direction); };
    body.end = body.start + direction * std::max(quantileOf(points, 0.98F, along), least);
}

// The foot's way from ankle to toes: the toe joint's, else the skin's.
vec3 footDirection(const PlannedBody& foot, const std::vector<SkinPoint>& points, const Character& character,
                   const HumanoidMap& map) {
    const Role toes = sideOf(foot.role) == animation::Side::left ? Role::leftToes : Role::rightToes;
    const int joint = map.jointOf(toes);
    if (joint != animation::kNoJoint) {
        const vec3 toe = map.standardFromModel * character.skeleton.bindModelFromJoint[joint].translation;
        if (glm::distance(toe, foot.start) > 1e-3F) return glm::normalize(toe - foot.start);
    }
    if (points.size() < kFewestPoints) return foot.direction();
    vec3 toCentre = principalAxes(points).centroid - foot.start;
    if (toCentre.y > -glm::length(vec3(toCentre.x, 0, toCentre.z))) toCentre.y = 0.0F;
    const float length = glm::length(toCentre);
    return length > 1e-3F ? toCentre / length : foot.direction();
}

}  // namespace

std::vector<SkinPoint> skinNearSegment(const BodyPlan& plan, const PlannedBody& body) {
    const float reach = body.endsAtJoint ? body.length() + 0.08F * plan.heightM : reachOf(plan, body);
    std::vector<SkinPoint> near;
    for (const SkinPoint& point : body.skin) {
        if (glm::distance(point.position, body.start) < reach) near.push_back(point);
    }
    return near;
}

void findTips(BodyPlan& plan, const Character& character, const HumanoidMap& map) {
    for (PlannedBody& body : plan.bodies) {
        if (body.endsAtJoint) continue;
        std::vector<SkinPoint> points = skinNearSegment(plan, body);
        if (points.size() < kFewestPoints) points = jointsBelow(character, map, body.joint);
        const float least = 0.3F * proportionsOf(body.role).length * plan.heightM;
        vec3 direction = body.direction();
        if (isOneOf(body.role, Role::leftFoot) || isOneOf(body.role, Role::leftToes)) {
            direction = footDirection(body, points, character, map);
        } else if (body.role != Role::head && !points.empty()) {
            const vec3 toCentre = principalAxes(points).centroid - body.start;
            if (glm::length(toCentre) > 0.01F * plan.heightM) direction = glm::normalize(toCentre);
        }
        if (points.empty()) {
            body.end = body.start + direction * (proportionsOf(body.role).length * plan.heightM);
        } else {
            setTip(body, points, direction, least);
        }
    }
}

}  // namespace lutka::physics
