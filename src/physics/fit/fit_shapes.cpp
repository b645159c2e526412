#include "physics/fit/fit_shapes.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <optional>
#include <span>

#include "physics/collision/shape.hpp"
#include "physics/fit/body_fit.hpp"
#include "physics/fit/hull_fit.hpp"
#include "physics/fit/separate_shapes.hpp"

namespace lutka::physics {
namespace {

using animation::Side;

// The mirror image of the left's shape about the right's joint.
Capsule mirroredCapsule(const BodyPlan& plan, const Capsule& capsule, const PlannedBody& from, const PlannedBody& to) {
    const vec3 shift = to.start - plan.mirror(from.start);
    return {plan.mirror(capsule.start) + shift, plan.mirror(capsule.end) + shift, capsule.radius};
}

}  // namespace

float distanceFrom(const Capsule& capsule, const vec3& point) {
    const vec3 along = capsule.end - capsule.start;
    const float square = glm::dot(along, along);
    const float t = square > 0.0F ? std::clamp(glm::dot(point - capsule.start, along) / square, 0.0F, 1.0F) : 0.0F;
    return glm::distance(point, capsule.start + t * along) - capsule.radius;
}

int mostShapesOf(const RagdollProfile& profile) {
    std::size_t most = 0;
    for (const BodyProfile& body : profile.bodies)
        most = std::max(most, body.shape.more.size());
    return static_cast<int>(most) + 1;
}

PlacedShape placeCapsule(const Capsule& capsule) {
    const vec3 along = capsule.end - capsule.start;
    const float length = glm::length(along);
    PlacedShape placed;
    placed.shape.kind = BodyShape::Kind::capsule;
    placed.shape.radius = capsule.radius;
    placed.shape.halfLength = 0.5F * length;
    placed.standardFromBody.rotation = axesAlong(length > 1e-6F ? along / length : vec3(0, 1, 0));
    placed.standardFromBody.translation = 0.5F * (capsule.start + capsule.end);
    return placed;
}

namespace {

// The first is the main shape, about which the body's axes lie.
PlacedShape placeCapsules(const std::vector<Capsule>& capsules) {
    PlacedShape placed = placeCapsule(capsules.front());
    for (std::size_t i = 1; i < capsules.size(); ++i) {
        const PlacedShape further = placeCapsule(capsules[i]);
        RigidTransform bodyFromShape = inverse(placed.standardFromBody) * further.standardFromBody;
        bodyFromShape.rotation = glm::normalize(bodyFromShape.rotation);
        const PrimitiveShape& capsule = further.shape;
        placed.shape.more.push_back({capsule, bodyFromShape});
    }
    return placed;
}

// Whether a body with these shapes comes into one that it is not linked with where it did not with its present one.
bool comesIntoOthers(const BodyPlan& plan, const std::vector<PlacedShape>& shapes, int body,
                     const PlacedShape& wanted) {
    const auto depth = [&](const PlacedShape& own, int other) {
        return -distanceBetween(own.shape, own.standardFromBody, shapes[other].shape, shapes[other].standardFromBody);
    };
    for (int other = 0; other < static_cast<int>(shapes.size()); ++other) {
        const bool linked = plan.bodies[other].parent == body || plan.bodies[body].parent == other;
        if (other == body || linked) continue;
        if (depth(wanted, other) > std::max(0.0F, depth(shapes[body], other))) return true;
    }
    return false;
}

PlacedShape placeBox(const PlacedBox& box) {
    PlacedShape placed;
    placed.shape.kind = BodyShape::Kind::box;
    placed.shape.halfExtents = box.halfExtents;
    placed.standardFromBody = box.standardFromBox;
    return placed;
}

// The mirror image of the left's box about the right's joint. Its sides are the box's own.
PlacedBox mirroredBox(const BodyPlan& plan, const PlacedBox& box, const PlannedBody& from, const PlannedBody& to) {
    const vec3 shift = to.start - plan.mirror(from.start);
    const quat& q = box.standardFromBox.rotation;
    return {{quat(q.w, q.x, -q.y, -q.z), plan.mirror(box.standardFromBox.translation) + shift}, box.halfExtents};
}

// Bodies whose skin is a box, as in figures made of blocks, become one, both of a pair or none. What they touch beside
// them separateShapes() parts.
void takeBoxes(const BodyPlan& plan, std::span<const std::optional<BodyFit>> fits, const std::vector<Capsule>& capsules,
               std::vector<PlacedShape>& shapes) {
    for (int body = 0; body < static_cast<int>(plan.bodies.size()); ++body) {
        const PlannedBody& planned = plan.bodies[body];
        const bool paired = plan.isPaired(planned);
        const auto box = fits[body] ? fits[body]->fitBox(capsules[body]) : std::nullopt;
        if (!box) continue;
        shapes[body] = placeBox(*box);
        if (!paired) continue;
        const int other = planned.mirror;
        shapes[other] = placeBox(mirroredBox(plan, *box, planned, plan.bodies[other]));
    }
}

void addFurtherShapes(const BodyPlan& plan, std::span<const std::optional<BodyFit>> fits, int most,
                      const std::vector<Capsule>& capsules, std::vector<PlacedShape>& shapes) {
    for (int body = 0; body < static_cast<int>(plan.bodies.size()); ++body) {
        const PlannedBody& planned = plan.bodies[body];
        if (plan.symmetric && planned.side != Side::center && planned.mirror >= 0) continue;
        if (shapes[body].shape.kind == BodyShape::Kind::box) continue;
        const auto several = fits[body]->fitSeveral(capsules[body], most);
        if (!several) continue;
        PlacedShape wanted = placeCapsules(*several);
        if (!comesIntoOthers(plan, shapes, body, wanted)) shapes[body] = std::move(wanted);
    }
}

}  // namespace

std::vector<PlacedShape> fitShapes(const BodyPlan& plan, const Anatomy& anatomy, int mostShapes) {
    std::vector<Capsule> capsules(plan.bodies.size());
    std::vector<std::optional<BodyFit>> fits(plan.bodies.size());  // of those that are not mirrored from the left
    for (int body = 0; body < static_cast<int>(plan.bodies.size()); ++body) {
        if (!plan.isMirrored(plan.bodies[body])) capsules[body] = fits[body].emplace(plan, anatomy, body).fit();
    }
    // The left one may come after the right one.
    for (int body = 0; body < static_cast<int>(plan.bodies.size()); ++body) {
        const PlannedBody& planned = plan.bodies[body];
        const int left = planned.mirror;
        if (plan.isMirrored(planned))
            capsules[body] = mirroredCapsule(plan, capsules[left], plan.bodies[left], planned);
    }
    std::vector<PlacedShape> shapes;
    shapes.reserve(capsules.size());
    for (const Capsule& capsule : capsules)
        shapes.push_back(placeCapsule(capsule));
    takeBoxes(plan, fits, capsules, shapes);
    addFurtherShapes(plan, fits, mostShapes, capsules, shapes);
    takeHulls(plan, shapes);
    separateShapes(plan, shapes);
    return shapes;
}

}  // namespace lutka::physics
