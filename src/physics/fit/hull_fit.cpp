#include "physics/fit/hull_fit.hpp"

#include <glm/geometric.hpp>

#include "physics/collision/hull_distance.hpp"
#include "physics/fit/body_tips.hpp"

namespace lutka::physics {
namespace {

constexpr std::size_t kFewestPoints = 8;  // of skin
constexpr float kTolerance = 0.002F;      // of the height

// The mirror image of the left's hull about the right's joint.
PlacedShape mirroredHull(const BodyPlan& plan, const PlacedShape& left, const PlannedBody& from,
                         const PlannedBody& to) {
    const vec3 shift = to.start - plan.mirror(from.start);
    const RigidTransform& at = left.standardFromBody;
    const quat& q = at.rotation;
    return {mirrored(left.shape), {quat(q.w, q.x, -q.y, -q.z), plan.mirror(at.translation) + shift}};
}

}  // namespace

std::optional<PlacedShape> fitHull(const BodyPlan& plan, const PlannedBody& body, const PlacedShape& shape) {
    const std::vector<SkinPoint> skin = skinNearSegment(plan, body);
    if (skin.size() < kFewestPoints) return std::nullopt;
    // About the shape's middle, where floats are finest.
    const RigidTransform shapeFromStandard = inverse(shape.standardFromBody);
    std::vector<vec3> points;
    points.reserve(skin.size());
    for (const SkinPoint& point : skin)
        points.push_back(shapeFromStandard * point.vertex);
    const ReducedHull reduced = reduceHull(points, kTolerance * plan.heightM);
    if (reduced.hull == nullptr) return std::nullopt;
    CentredHull centred = centredHull(*reduced.hull);
    if (centred.shape.hull == nullptr) return std::nullopt;
    PlacedShape placed;
    static_cast<PrimitiveShape&>(placed.shape) = centred.shape;
    placed.standardFromBody = shape.standardFromBody * centred.frameFromShape;
    placed.standardFromBody.rotation = glm::normalize(placed.standardFromBody.rotation);
    return placed;
}

void takeHulls(const BodyPlan& plan, std::vector<PlacedShape>& shapes) {
    // The left one may come after the right one.
    for (const bool mirrored : {false, true}) {
        for (std::size_t index = 0; index < plan.bodies.size(); ++index) {
            const PlannedBody& body = plan.bodies[index];
            if (!body.asHull || plan.isMirrored(body) != mirrored) continue;
            const PlacedShape* left = mirrored ? &shapes[static_cast<std::size_t>(body.mirror)] : nullptr;
            if (left != nullptr && left->shape.kind == PrimitiveShape::Kind::hull) {
                shapes[index] = mirroredHull(plan, *left, plan.bodies[static_cast<std::size_t>(body.mirror)], body);
            } else if (auto hull = fitHull(plan, body, shapes[index])) {
                shapes[index] = std::move(*hull);
            }
        }
    }
}

}  // namespace lutka::physics
