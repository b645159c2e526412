#include "physics/fit/profile_plan.hpp"

#include <algorithm>

#include "physics/fit/rebind.hpp"
#include "physics/fit/separate_shapes.hpp"

namespace lutka::physics {
namespace {

using animation::kNoJoint;
using animation::Segment;

Segment::Kind kindOf(const RagdollProfile& profile, const std::vector<int>& parents, int body) {
    if (parents[body] < 0) return Segment::Kind::trunk;
    if (sideOf(profile, body) == animation::Side::center) return Segment::Kind::chain;
    return sideOf(profile, parents[body]) == animation::Side::center ? Segment::Kind::limbRoot : Segment::Kind::limb;
}

// The joint of the heaviest body that hangs on it.
int endOf(const RagdollProfile& profile, const animation::Skeleton& skeleton, int body) {
    int end = kNoJoint;
    float heaviest = 0.0F;
    for (const ConstraintProfile& constraint : profile.constraints) {
        const BodyProfile& child = profile.bodies[constraint.child];
        if (constraint.parent != body || child.massKg <= heaviest) continue;
        heaviest = child.massKg;
        end = jointOfBody(child, skeleton);
    }
    return end;
}

// The bodies without a role, in the profile's order.
std::vector<Segment> segmentsOf(const RagdollProfile& profile, const animation::Skeleton& skeleton) {
    const std::vector<int> parents = parentsOfBodies(profile);
    std::vector<int> place(profile.bodies.size(), -1);
    std::vector<Segment> segments;
    for (int body = 0; body < static_cast<int>(profile.bodies.size()); ++body) {
        const BodyProfile& own = profile.bodies[body];
        const int joint = own.role ? kNoJoint : jointOfBody(own, skeleton);
        if (joint == kNoJoint) continue;
        place[body] = static_cast<int>(segments.size());
        Segment segment;
        segment.name = own.name;
        segment.joint = joint;
        segment.parent = parents[body] >= 0 ? place[parents[body]] : -1;
        segment.end = endOf(profile, skeleton, body);
        segment.kind = kindOf(profile, parents, body);
        segment.side = sideOf(profile, body);
        segments.push_back(segment);
    }
    for (std::size_t body = 0; body < place.size(); ++body) {
        if (place[body] < 0) continue;
        const int other = counterpartOf(profile, static_cast<int>(body));
        const bool named = profile.bodies[body].mirror == profile.bodies[body].name;
        if (other >= 0 || named) segments[place[body]].mirror = named ? place[body] : place[other];
    }
    return segments;
}

}  // namespace

int jointOfBody(const BodyProfile& body, const animation::Skeleton& skeleton) {
    const int joint = findJoint(skeleton, body.jointPath);
    return joint != kNoJoint ? joint : findJoint(skeleton, body.joint);
}

BodyPlan planOfProfile(const RagdollProfile& profile, const animation::Character& character,
                       const animation::HumanoidMap& map) {
    BodyPlan plan = planBodies(character, map, rolesOf(profile), segmentsOf(profile, character.skeleton));
    const std::vector<int> places = placesInPlan(profile, plan);
    for (std::size_t body = 0; body < places.size(); ++body) {
        if (places[body] >= 0)
            plan.bodies[places[body]].asHull = profile.bodies[body].shape.kind == PrimitiveShape::Kind::hull;
    }
    return plan;
}

std::vector<int> placesInPlan(const RagdollProfile& profile, const BodyPlan& plan) {
    std::vector<int> places;
    places.reserve(profile.bodies.size());
    for (const BodyProfile& body : profile.bodies) {
        const auto found = std::find_if(plan.bodies.begin(), plan.bodies.end(), [&](const PlannedBody& planned) {
            return body.role ? planned.role == body.role : planned.segment && planned.name == body.name;
        });
        places.push_back(found == plan.bodies.end() ? -1 : static_cast<int>(found - plan.bodies.begin()));
    }
    return places;
}

}  // namespace lutka::physics
