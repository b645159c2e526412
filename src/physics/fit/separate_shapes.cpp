#include "physics/fit/separate_shapes.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "core/swing_twist.hpp"
#include "physics/collision/shape.hpp"

namespace lutka::physics {
namespace {

constexpr float kLargestShrink = 0.25F;
constexpr float kGap = 1e-4F;  // metres left between parted shapes, so that rounding does not close them

// Brings its surface in by a share of its thickness.
void shrink(PrimitiveShape& shape, float share) {
    if (shape.kind == PrimitiveShape::Kind::box)
        shape.halfExtents -= share * thicknessOf(shape);
    else if (shape.kind == PrimitiveShape::Kind::hull)
        scaleHull(shape, vec3(1.0F - share));
    else
        shape.radius *= 1.0F - share;
}

float distanceOf(const std::vector<PlacedShape>& shapes, int a, int b) {
    return distanceBetween(shapes[a].shape, shapes[a].standardFromBody, shapes[b].shape, shapes[b].standardFromBody);
}

bool isTrunkSegment(const PlannedBody& body) {
    return body.segment && body.segment->kind == animation::Segment::Kind::trunk;
}

// The orientations that a constraint's child takes relative to the parent's frame, over its range.
std::vector<quat> sampleRange(const ConstraintProfile& constraint) {
    const auto aboutZ = [](float angle) { return rotationOf({{0, 0, angle}, 0.0F}); };
    if (constraint.kind == ConstraintProfile::Kind::hinge) {
        return {quat(1, 0, 0, 0), aboutZ(constraint.hinge.lower), aboutZ(constraint.hinge.upper)};
    }
    const ConeTwistLimits& cone = constraint.cone;
    return {quat(1, 0, 0, 0), aboutZ(cone.swingZ), aboutZ(-cone.swingZ), rotationOf({{0, cone.swingY, 0}, 0.0F}),
            rotationOf({{0, -cone.swingY, 0}, 0.0F})};
}

std::vector<RigidTransform> sampleChild(const ConstraintProfile& constraint) {
    std::vector<RigidTransform> parentFromChild;
    for (const quat& rotation : sampleRange(constraint))
        parentFromChild.push_back(constraint.parentFromFrame * RigidTransform{rotation, vec3(0)} *
                                  inverse(constraint.childFromFrame));
    return parentFromChild;
}

// Whether two bodies with one body between them (both its children, or its parent and its child) overlap in at least
// half of the sampled poses.
bool mostlyOverlap(const RagdollProfile& profile, const std::vector<int>& parents, int a, int b) {
    std::vector<RigidTransform> poseOfA;
    const std::vector<RigidTransform> poseOfB = sampleChild(profile.constraints[b - 1]);
    if (a == 0 || parents[b] != parents[a]) {
        // `a` is the grandparent: place it in the frame of the body between.
        for (const RigidTransform& pose : sampleChild(profile.constraints[parents[b] - 1]))
            poseOfA.push_back(inverse(pose));
    } else {
        poseOfA = sampleChild(profile.constraints[a - 1]);
    }
    int overlaps = 0;
    for (const RigidTransform& placeA : poseOfA) {
        for (const RigidTransform& placeB : poseOfB)
            overlaps +=
                distanceBetween(profile.bodies[a].shape, placeA, profile.bodies[b].shape, placeB) < 0.0F ? 1 : 0;
    }
    return 2 * overlaps >= static_cast<int>(poseOfA.size() * poseOfB.size());
}

}  // namespace

std::vector<int> parentsOfBodies(const RagdollProfile& profile) {
    std::vector<int> parents(profile.bodies.size(), -1);
    for (const ConstraintProfile& constraint : profile.constraints)
        parents[constraint.child] = constraint.parent;
    return parents;
}

void separateShapes(const BodyPlan& plan, std::vector<PlacedShape>& shapes) {
    const int count = static_cast<int>(shapes.size());
    const auto linked = [&](int a, int b) { return plan.bodies[a].parent == b || plan.bodies[b].parent == a; };
    // A creature's trunk is thicker than its joints are apart: along it, beside where a limb leaves it, and where one
    // body lies between two, the limits keep shapes apart.
    const auto heldApart = [&](int a, int b) {
        const PlannedBody& above = plan.bodies[a];
        const PlannedBody& below = plan.bodies[b];
        if (!above.segment || !below.segment) return false;
        const int trunks = (isTrunkSegment(above) ? 1 : 0) + (isTrunkSegment(below) ? 1 : 0);
        return trunks == 2 || (trunks == 1 && above.parent == below.parent) || plan.bodies[below.parent].parent == a;
    };
    // Which of a body's shapes lies in the other is not told: the thinnest has least to give.
    const auto radiusOf = [&](int body) {
        float least = thicknessOf(shapes[body].shape);
        for (const AddedShape& added : shapes[body].shape.more)
            least = std::min(least, thicknessOf(added));
        return least;
    };
    // The largest shrink that any pair asks of a body, as a share of its radius.
    std::vector<float> shares(shapes.size(), 0.0F);
    for (int a = 0; a < count; ++a) {
        for (int b = a + 1; b < count; ++b) {
            const float overlap = kGap - distanceOf(shapes, a, b);
            if (linked(a, b) || overlap <= 0.0F) continue;
            // What hangs on a humanoid gives way to it alone.
            const bool aGives = plan.bodies[a].segment || !plan.bodies[b].segment;
            const bool bGives = plan.bodies[b].segment || !plan.bodies[a].segment;
            const float share = overlap / ((aGives ? radiusOf(a) : 0.0F) + (bGives ? radiusOf(b) : 0.0F));
            if (share > kLargestShrink || (aGives && bGives && heldApart(a, b))) continue;
            if (aGives) shares[a] = std::max(shares[a], share);
            if (bGives) shares[b] = std::max(shares[b], share);
        }
    }
    for (int body = 0; body < count; ++body) {
        const int other = plan.bodies[body].mirror;
        const float share = plan.symmetric && other >= 0 ? std::max(shares[body], shares[other]) : shares[body];
        BodyShape& shape = shapes[body].shape;
        shrink(shape, share);
        for (AddedShape& added : shape.more)
            shrink(added, share);
    }
}

std::vector<std::pair<int, int>> pairsToFilter(const RagdollProfile& profile,
                                               const std::vector<RigidTransform>& modelFromBody) {
    const std::vector<int> parents = parentsOfBodies(profile);
    const int count = static_cast<int>(profile.bodies.size());
    std::vector<std::pair<int, int>> pairs;
    for (int a = 0; a < count; ++a) {
        for (int b = a + 1; b < count; ++b) {
            if (parents[b] == a || parents[a] == b) continue;
            const bool near = parents[a] == parents[b] || (parents[b] >= 0 && parents[parents[b]] == a);
            const bool overlap = distanceBetween(profile.bodies[a].shape, modelFromBody[a], profile.bodies[b].shape,
                                                 modelFromBody[b]) < 0.0F;
            if (overlap || (near && mostlyOverlap(profile, parents, a, b))) pairs.emplace_back(a, b);
        }
    }
    return pairs;
}

}  // namespace lutka::physics
