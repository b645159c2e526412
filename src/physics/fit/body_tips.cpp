#include "physics/fit/body_tips.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "core/quantile.hpp"
#include "physics/fit/principal_axes.hpp"
#include "physics/fit/trunk_roles.hpp"

namespace lutka::physics {
namespace {

using animation::Character;
using animation::HumanoidMap;

constexpr std::size_t kFewestTipPoints = 8;

// Length of a tip without skin, as a share of the height; and how far from its joint skin may still be the limb's own.
struct TipProportions {
    float length, reach;
};
TipProportions proportionsOf(std::optional<Role> role) {
    if (role == Role::head) return {0.12F, 0.35F};
    if (isEitherSide(role, Role::leftHand)) return {0.10F, 0.14F};
    if (isEitherSide(role, Role::leftFoot)) return {0.13F, 0.22F};
    if (isEitherSide(role, Role::leftToes)) return {0.05F, 0.10F};
    return {0.14F, 0.35F};
}

// How far from its joint that share of a body's skin lies; its skin is not empty.
float distanceOf(const PlannedBody& body, float share) {
    return quantileOf(body.skin, share,
                      [&](const SkinPoint& point) { return glm::distance(point.position, body.start); });
}
float medianDistance(const PlannedBody& body) {
    return distanceOf(body, 0.5F);
}

// A limb of one joint is as long as most of its skin reaches, but for what it carries.
float reachOfWholeLimb(const PlannedBody& body, float heightM) {
    constexpr float kMost = 0.6F;  // of the height: to the floor, for legs and for arms of a giant
    return std::min(1.2F * distanceOf(body, 0.75F), kMost * heightM);
}

// A hand of a figure with large hands may reach as far as its forearm is long, a large head as far as most of it does.
float reachOf(const BodyPlan& plan, const PlannedBody& body) {
    const float reach = proportionsOf(body.role).reach * plan.heightM;
    if (isEitherSide(body.role, Role::leftHand) && body.parent >= 0) {
        return std::max(reach, 0.8F * plan.bodies[body.parent].length());
    }
    if (body.role == Role::head && !body.skin.empty()) return std::max(reach, 1.5F * medianDistance(body));
    if (isEitherSide(body.role, Role::leftFoot) && !body.skin.empty()) {
        // A beast's heel is its ankle: its claws lie far ahead and below.
        constexpr float kMostOfFoot = 0.35F;  // of the height
        return std::clamp(1.3F * distanceOf(body, 0.75F), reach, kMostOfFoot * plan.heightM);
    }
    const bool starts = isEitherSide(body.role, Role::leftUpperArm) || isEitherSide(body.role, Role::leftUpperLeg);
    if (starts && !body.skin.empty()) return std::max(reach, reachOfWholeLimb(body, plan.heightM));
    return reach;
}

// As far as the body is long, and for a trunk that is wider than long as far as most of its skin is.
float reachBetweenJoints(const BodyPlan& plan, const PlannedBody& body) {
    const float reach = body.length() + 0.08F * plan.heightM;
    if (!isTrunk(body.role) || body.skin.empty()) return reach;
    return std::max(reach, 1.2F * medianDistance(body));
}

// The joints below a body's joint (fingers, toe) tell its direction where there is no skin, as far as it may reach:
// some programs put a leaf behind the last joint of a chain, as far again as that is long.
std::vector<SkinPoint> jointsBelow(const Character& character, const HumanoidMap& map, const BodyPlan& plan,
                                   const PlannedBody& body) {
    const float reach = reachOf(plan, body);
    std::vector<SkinPoint> points;
    const animation::Skeleton& skeleton = character.skeleton;
    for (int child = body.joint + 1; child < skeleton.jointCount(); ++child) {
        if (!isAncestorOrSelf(skeleton, body.joint, child)) continue;
        const vec3 position = map.standardFromModel * skeleton.bindModelFromJoint[child].translation;
        if (glm::distance(position, body.start) < reach) points.push_back({position, 0.0F});
    }
    return points;
}

void setTip(PlannedBody& body, const std::vector<SkinPoint>& points, const vec3& direction, float least) {
    const auto along = [&](const SkinPoint& point) { return glm::dot(point.position - body.start, direction); };
    body.end = body.start + direction * std::max(quantileOf(points, 0.98F, along), least);
}

// The way a foot points, level: to its toe joint, else along its skin where that is longer than wide, else ahead.
vec3 footHeading(const PlannedBody& foot, const std::vector<SkinPoint>& points, const Character& character,
                 const HumanoidMap& map) {
    constexpr float kLong = 1.3F;  // ratio of the spreads
    constexpr float kPlausible = 0.7F;
    const vec3 ahead(0, 0, 1);
    const Role toes = foot.side == animation::Side::left ? Role::leftToes : Role::rightToes;
    const int joint = map.jointOf(toes);
    vec3 way(0);
    if (joint != animation::kNoJoint && joint != foot.joint) {
        way = map.standardFromModel * character.skeleton.bindModelFromJoint[joint].translation - foot.start;
    } else if (!points.empty()) {
        const PrincipalAxes axes = principalAxes(points);
        if (axes.spread[0] > kLong * axes.spread[1]) way = axes.axis[0] * (axes.axis[0].z < 0.0F ? -1.0F : 1.0F);
        if (way.z < kPlausible) way = ahead;
    }
    const vec3 level(way.x, 0, way.z);
    return glm::length(level) > 0.25F * glm::length(way) && glm::length(way) > 1e-4F ? glm::normalize(level) : ahead;
}

// A foot runs from the ankle to the height of the skin that lies furthest along its heading; the toe joint itself may
// lie far below the ankle.
void setFootTip(PlannedBody& foot, const std::vector<SkinPoint>& points, const vec3& heading) {
    const auto along = [&](const SkinPoint& point) { return glm::dot(point.position - foot.start, heading); };
    const float front = quantileOf(points, 0.9F, along);
    vec3 sum(0);
    float total = 0.0F;
    for (const SkinPoint& point : points) {
        if (along(point) < front) continue;
        sum += (point.area + 1e-9F) * point.position;
        total += point.area + 1e-9F;
    }
    if (total <= 0.0F) return;
    const vec3 tip = sum / total - foot.start;
    const vec3 end = glm::dot(tip, heading) * heading + vec3(0, tip.y, 0);
    if (glm::length(end) > 1e-3F) foot.end = foot.start + end;
}

}  // namespace

std::vector<SkinPoint> skinNearSegment(const BodyPlan& plan, const PlannedBody& body) {
    if (body.segment) return body.skin;  // what hangs on a creature is its own
    const bool isWholeTop = isTrunk(body.role) && !body.endsAtJoint && plan.bodyOf(Role::head) < 0;
    if (isWholeTop) return body.skin;  // a bean's trunk is its head as well
    const float reach = body.endsAtJoint ? reachBetweenJoints(plan, body) : reachOf(plan, body);
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
        // The last joint of a chain without skin may be an eye or the stub that a file ends every chain with. Flesh
        // does not end there.
        float leastShare = 0.3F;
        if (points.size() < kFewestTipPoints) {
            points = jointsBelow(character, map, plan, body);
            leastShare = 0.9F;
        }
        const float least = leastShare * proportionsOf(body.role).length * plan.heightM;
        vec3 direction = body.direction();
        if ((isEitherSide(body.role, Role::leftFoot) || isEitherSide(body.role, Role::leftToes)) && !points.empty()) {
            setFootTip(body, points, footHeading(body, points, character, map));
            continue;
        }
        if (body.role != Role::head && !points.empty()) {
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
