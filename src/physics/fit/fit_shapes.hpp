#pragma once

#include <vector>

#include "physics/fit/anatomy.hpp"
#include "physics/fit/body_plan.hpp"
#include "physics/fit/limits.hpp"

namespace lutka::physics {

/// The widest that a body may be, as a share of the figure's height: the trunk of a man that is an egg, and a segment
/// of any rig.
inline constexpr float kLargestTrunkRadius = 0.35F;
inline constexpr float kLargestSegmentRadius = 0.5F;

/// A capsule by the centres of its caps.
struct Capsule {
    vec3 start{0, 0, 0};
    vec3 end{0, 0, 0};
    float radius = 0.0F;
};
/// Of a point from its surface, metres; negative inside.
[[nodiscard]] float distanceFrom(const Capsule& capsule, const vec3& point);

/// A shape for every body of the plan.
///
/// A coordinate search from robust quantiles finds the capsule with the least area-weighted mean distance between skin
/// and surface. A distance counts at most 4 % of the height, or half the spread of the part where that is more, so that
/// hair, skirts and weapons weigh little.
/// - Limbs keep the axis from joint to joint, displaced towards the middle of the flesh, and end near the joints. Trunk
///   capsules stand or lie across, whichever fits better. The head stands. Feet lie on the sole.
/// - Bodies with fewer than 24 points of skin get a man's proportions.
/// - Radii are between 1 % and 15 % of the height (trunk 35 %, head 30 %).
/// - On a symmetric rig both sides are fitted as one and come out as mirror images.
/// - Bodies whose skin is a block become boxes (fitBox()), but for feet and the lowest bodies of legs.
/// - A trunk or head that several capsules cover clearly better (fitSeveralCapsules()) gets up to `mostShapes` of them,
///   if none of the further ones reaches into a body that is not linked.
/// - Bodies that are asked for as hulls become hulls (takeHulls()).
/// - At last, shapes of bodies that are not linked shrink by up to a quarter where that keeps them apart.
[[nodiscard]] std::vector<PlacedShape> fitShapes(const BodyPlan& plan, const Anatomy& anatomy,
                                                 int mostShapes = FitOptions{}.mostShapes);

/// The number of shapes of the body that has most: what a new fit of the profile may give a body.
[[nodiscard]] int mostShapesOf(const RagdollProfile& profile);

/// A capsule as a placed shape: axis along body Y, body Z as near to straight ahead as the axis lets it.
[[nodiscard]] PlacedShape placeCapsule(const Capsule& capsule);

}  // namespace lutka::physics
