#include "physics/fit/odd_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/aabb.hpp"
#include "physics/fit/body_tips.hpp"

namespace lutka::physics {
namespace {

Aabb boxOf(const std::vector<SkinPoint>& skin) {
    Aabb box;
    for (const SkinPoint& point : skin)
        box.add(point.position);
    return box;
}

// The mirror image of a body's box about its counterpart's joint.
Aabb mirrored(const BodyPlan& plan, const Aabb& box, const PlannedBody& from, const PlannedBody& to) {
    const vec3 shift = to.start - plan.mirror(from.start);
    Aabb image;
    image.add(plan.mirror(box.low) + shift);
    image.add(plan.mirror(box.high) + shift);
    return image;
}

// An arm of one rigid part may be modelled raised where the other hangs, with both joints at the shoulders; a
// creature's wings, spread and folded. What one of them holds makes its box longer.
bool arePosedApart(const Aabb& left, const Aabb& right, float heightM) {
    constexpr float kApart = 0.08F;  // of the height, between the middles of the two
    constexpr float kAlike = 0.25F;  // of the boxes' diagonals
    const float sizes = left.diagonal() / std::max(right.diagonal(), 1e-6F);
    return std::abs(sizes - 1.0F) <= kAlike && glm::distance(left.middle(), right.middle()) > kApart * heightM;
}

// Whether the first box holds the second and is larger by what a hand holds.
bool reachesBeyond(const Aabb& outer, const Aabb& inner, float heightM) {
    constexpr float kBeyond = 0.03F;  // of the height
    const auto most = [](const vec3& v) { return std::max({v.x, v.y, v.z}); };
    const float out = std::max(most(outer.low - inner.low), most(inner.high - outer.high));
    const float further = std::max(most(inner.low - outer.low), most(outer.high - inner.high));
    return out <= 0.5F * kBeyond * heightM && further > kBeyond * heightM;
}

bool isOfArm(Role role) {
    return isEitherSide(role, Role::leftUpperArm) || isEitherSide(role, Role::leftLowerArm) ||
           isEitherSide(role, Role::leftHand);
}

}  // namespace

void findOddPairs(BodyPlan& plan) {
    for (PlannedBody& left : plan.bodies) {
        if (!left.role || left.side != animation::Side::left || left.mirror < 0) continue;
        PlannedBody& right = plan.bodies[left.mirror];
        const std::vector<SkinPoint> leftSkin = skinNearSegment(plan, left);
        const std::vector<SkinPoint> rightSkin = skinNearSegment(plan, right);
        if (leftSkin.size() < kFewestShapePoints || rightSkin.size() < kFewestShapePoints) continue;
        const Aabb leftBox = boxOf(leftSkin);
        const Aabb rightBox = mirrored(plan, boxOf(rightSkin), right, left);
        left.posedApart = right.posedApart = arePosedApart(leftBox, rightBox, plan.heightM);
        if (left.posedApart || left.endsAtJoint || right.endsAtJoint || !isOfArm(*left.role)) continue;
        left.holds = reachesBeyond(leftBox, rightBox, plan.heightM);
        right.holds = !left.holds && reachesBeyond(rightBox, leftBox, plan.heightM);
        PlannedBody& holding = left.holds ? left : right;
        const PlannedBody& other = left.holds ? right : left;
        if (holding.holds) holding.end = holding.start + plan.mirror(other.end) - plan.mirror(other.start);
    }
}

}  // namespace lutka::physics
