#include "physics/crowd/topology.hpp"

#include <algorithm>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>

#include "physics/collision/shape.hpp"
#include "physics/crowd/narrowphase.hpp"

namespace lutka::physics::crowd {
namespace {

// An ellipse whose axes differ by less is held by one row.
constexpr float kRound = 1.2F;

void copy(float (&to)[3], const vec3& v) {
    to[0] = v.x;
    to[1] = v.y;
    to[2] = v.z;
}
void copy(float (&to)[4], const quat& q) {
    to[0] = q.x;
    to[1] = q.y;
    to[2] = q.z;
    to[3] = q.w;
}

BodyConstants constantsOf(const BodyShape& shape, float massKg, const vec3& inertia) {
    BodyConstants constants{};
    constants.mass = massKg;
    constants.inverseMass = 1.0F / massKg;
    copy(constants.inertia, inertia);
    copy(constants.inverseInertia, 1.0F / inertia);
    vec3 extent(0);
    if (shape.kind == BodyShape::Kind::capsule) extent.y = shape.halfLength;
    if (shape.kind == BodyShape::Kind::box) extent = shape.halfExtents;
    if (shape.kind == BodyShape::Kind::hull) extent = shape.hull->halfBounds();
    copy(constants.extent, extent);
    constants.radius = shape.isAngular() ? 0.0F : shape.radius;
    constants.reach = shape.kind == BodyShape::Kind::hull ? shape.hull->reach() : glm::length(extent);
    constants.size = shape.more.empty() ? constants.reach + constants.radius : boundingRadius(shape);
    // Turning moves the cores of the others as well.
    for (const AddedShape& added : shape.more) {
        const float core =
            boundingRadius(static_cast<const PrimitiveShape&>(added)) - (added.isAngular() ? 0.0F : added.radius);
        constants.reach = std::max(constants.reach, glm::length(added.bodyFromShape.translation) + core);
    }
    return constants;
}

// Half the width of a range, radians, up to which a joint that it bounds is locked. Its stops on both sides would hold
// by turns, it would tremble between them, and stops are only as stiff as single bodies are heavy.
constexpr float kLocked = radians(1.0F);

// The rotation that a locked joint is held in; nothing for one that turns.
std::optional<quat> lockedTurn(const ConstraintProfile& constraint) {
    if (constraint.kind == ConstraintProfile::Kind::hinge) {
        const HingeLimits& hinge = constraint.hinge;
        if (hinge.upper - hinge.lower > 2.0F * kLocked) return std::nullopt;
        return glm::angleAxis(0.5F * (hinge.lower + hinge.upper), vec3(0, 0, 1));
    }
    const ConeTwistLimits& cone = constraint.cone;
    if (std::max({cone.swingY, cone.swingZ, cone.twist}) > kLocked) return std::nullopt;
    return quat(1, 0, 0, 0);
}

JointConstants constantsOf(const ConstraintProfile& constraint) {
    JointConstants constants{};
    constants.parent = constraint.parent;
    constants.child = constraint.child;
    constants.longAxis = -1;
    copy(constants.parentAnchor, constraint.parentFromFrame.translation);
    copy(constants.childAnchor, constraint.childFromFrame.translation);
    copy(constants.parentFrame, constraint.parentFromFrame.rotation);
    copy(constants.childFrame, constraint.childFromFrame.rotation);
    if (const std::optional<quat> turn = lockedTurn(constraint)) {
        constants.isLocked = 1;
        copy(constants.childFrame, constraint.childFromFrame.rotation * glm::conjugate(*turn));
        return constants;
    }
    constants.frictionNm = constraint.frictionNm;
    if (constraint.kind == ConstraintProfile::Kind::hinge) {
        constants.isHinge = 1;
        copy(constants.limit, vec3(constraint.hinge.lower, constraint.hinge.upper, 0));
        return constants;
    }
    // One of no width has its stops on both sides at once.
    copy(constants.limit,
         glm::max(vec3(constraint.cone.swingY, constraint.cone.swingZ, constraint.cone.twist), vec3(kLocked)));
    const float y = constants.limit[0];
    const float z = constants.limit[1];
    if (std::max(y, z) > kRound * std::min(y, z)) constants.longAxis = y > z ? 0 : 1;
    return constants;
}

bool mayCollide(const RagdollProfile& profile, int a, int b) {
    const bool linked =
        std::any_of(profile.constraints.begin(), profile.constraints.end(), [&](const ConstraintProfile& c) {
            return std::min(c.parent, c.child) == a && std::max(c.parent, c.child) == b;
        });
    const auto& filtered = profile.filteredPairs;
    return !linked && std::find(filtered.begin(), filtered.end(), std::pair(a, b)) == filtered.end();
}

void addPoints(Topology& topology) {
    for (int body = 0; body < topology.bodyCount(); ++body) {
        for (int shape = 0; shape < topology.shapeCount(body); ++shape) {
            const CorePoints points = corePoints(topology.shapeOf(body, shape));
            for (int i = 0; i < points.count; ++i) {
                PlanePoint point{body, shape, i, {}, points.radius};
                copy(point.local, topology.inBody(body, shape, points.local[i]));
                topology.points.push_back(point);
            }
        }
    }
}

bool sameKind(const PrimitiveShape& a, const PrimitiveShape& b) {
    return a.kind == b.kind && sameHull(a.hull, b.hull);
}

bool sameAdded(const BodyShape& a, const BodyShape& b) {
    return std::equal(
        a.more.begin(), a.more.end(), b.more.begin(), b.more.end(), [](const AddedShape& x, const AddedShape& y) {
            return sameKind(x, y) && x.radius == y.radius && x.halfLength == y.halfLength &&
                   x.halfExtents == y.halfExtents && x.bodyFromShape.rotation == y.bodyFromShape.rotation &&
                   x.bodyFromShape.translation == y.bodyFromShape.translation;
        });
}

template <class T>
bool sameBytes(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

}  // namespace

Topology makeTopology(const RagdollProfile& profile, float leastGyration) {
    Topology topology;
    for (const BodyProfile& body : profile.bodies) {
        const vec3 inertia = conditionedInertia(profile, body, leastGyration);
        topology.bodies.push_back(constantsOf(body.shape, body.massKg, inertia));
        topology.shapes.push_back(body.shape);
        topology.anyAdded = topology.anyAdded || !body.shape.more.empty();
    }
    for (const ConstraintProfile& constraint : profile.constraints)
        topology.joints.push_back(constantsOf(constraint));
    for (std::size_t j = 0; j < topology.joints.size(); ++j) {
        JointConstants& joint = topology.joints[j];
        joint.opens = 1;
        const auto lengthOf = [](const float(&v)[3]) { return glm::length(vec3(v[0], v[1], v[2])); };
        float& parentReach = topology.bodies[joint.parent].armReach;
        float& childReach = topology.bodies[joint.child].armReach;
        parentReach = std::max(parentReach, lengthOf(joint.parentAnchor));
        childReach = std::max(childReach, lengthOf(joint.childAnchor));
        for (std::size_t k = 0; k < topology.joints.size(); ++k) {
            if (k > j && topology.joints[k].parent == joint.parent) joint.opens = 0;
            if (topology.joints[k].parent == joint.child) joint.childGathers = 1;
        }
    }
    for (int a = 0; a < topology.bodyCount(); ++a) {
        for (int b = a + 1; b < topology.bodyCount(); ++b) {
            if (mayCollide(profile, a, b)) topology.selfPairs.push_back({a, b});
        }
    }
    addPoints(topology);
    return topology;
}

Topology makeTopology(const DynamicProp& prop) {
    Topology topology;
    topology.bodies.push_back(constantsOf(prop.shape, prop.massKg, shapeInertia(prop.shape, prop.massKg)));
    topology.shapes.push_back(prop.shape);
    topology.anyAdded = !prop.shape.more.empty();
    addPoints(topology);
    return topology;
}

bool sameTopology(const Topology& a, const Topology& b) {
    // The main shapes follow from the constants but for their kind and hull.
    return sameBytes(a.bodies, b.bodies) && sameBytes(a.joints, b.joints) && sameBytes(a.selfPairs, b.selfPairs) &&
           std::equal(a.shapes.begin(), a.shapes.end(), b.shapes.begin(), b.shapes.end(),
                      [](const BodyShape& x, const BodyShape& y) { return sameKind(x, y) && sameAdded(x, y); });
}

}  // namespace lutka::physics::crowd
