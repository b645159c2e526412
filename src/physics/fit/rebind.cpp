#include "physics/fit/rebind.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "core/assert.hpp"
#include "physics/collision/shape.hpp"
#include "physics/fit/fit_shapes.hpp"
#include "physics/fit/profile_plan.hpp"
#include "physics/fit/separate_shapes.hpp"
#include "physics/fit/trunk_roles.hpp"
#include "physics/rig/rig.hpp"

namespace lutka::physics {
namespace {

Result<void> checkRoles(const RagdollProfile& profile, const animation::Character& character,
                        const animation::HumanoidMap& map) {
    std::string lacking;
    for (const BodyProfile& body : profile.bodies) {
        const int joint = body.role ? map.jointOf(*body.role) : jointOfBody(body, character.skeleton);
        if (joint == animation::kNoJoint) lacking += (lacking.empty() ? "" : ", ") + body.name;
    }
    if (lacking.empty()) return {};
    return Error{ErrorCode::input, "the profile has bodies for roles or joints that the rig lacks: " + lacking,
                 character.file.string(),
                 "build a profile for this rig (`lutka build`), or one with fewer bodies for both"};
}

// Where the old shapes sit on the new rig: in the same place relative to the constraint frames, which mean the same on
// every rig. The root has no frame of its own and takes that of its first child.
std::vector<PlacedShape> keptShapes(const RagdollProfile& profile, const BodyPlan& plan, const Anatomy& anatomy) {
    std::vector<PlacedShape> shapes(profile.bodies.size());
    for (std::size_t body = 0; body < shapes.size(); ++body)
        shapes[body].shape = profile.bodies[body].shape;
    for (std::size_t i = profile.constraints.size(); i-- > 0;) {
        const ConstraintProfile& constraint = profile.constraints[i];
        const JointFrames frames = jointFrames(plan, anatomy, constraint.child);
        shapes[constraint.child].standardFromBody =
            RigidTransform{frames.child, frames.anchor} * inverse(constraint.childFromFrame);
        if (constraint.parent != 0) continue;
        shapes[0].standardFromBody = RigidTransform{frames.parent, frames.anchor} * inverse(constraint.parentFromFrame);
    }
    if (profile.constraints.empty()) shapes[0].standardFromBody.translation = plan.bodies[0].start;
    return shapes;
}

// `turns`: the rotation of each body as it lay in its joint before the shapes were made anew, in the standard stance's
// axes.
void rebuildConstraints(RagdollProfile& profile, const BodyPlan& plan, const Anatomy& anatomy,
                        std::span<const PlacedShape> shapes, std::span<const quat> turns) {
    profile.notes.clear();
    for (ConstraintProfile& constraint : profile.constraints) {
        const RigidTransform& parent = shapes[constraint.parent].standardFromBody;
        const RigidTransform& child = shapes[constraint.child].standardFromBody;
        JointFrames frames = jointFrames(plan, anatomy, constraint.child);
        // Without a role there is no anatomy to tell the axes: they stay as they lie in the joints.
        if (!profile.bodies[constraint.child].role) {
            frames.parent = turns[constraint.parent] * constraint.parentFromFrame.rotation;
            frames.child = turns[constraint.child] * constraint.childFromFrame.rotation;
        }
        setFrames(constraint, frames, parent, child);
        std::string note = widenToHold(constraint, parent, child, profile.bodies[constraint.child].name);
        if (!note.empty()) profile.notes.push_back(std::move(note));
    }
}

void addFilteredPairs(RagdollProfile& profile, std::span<const PlacedShape> shapes) {
    std::vector<RigidTransform> placed;
    placed.reserve(shapes.size());
    for (const PlacedShape& shape : shapes)
        placed.push_back(shape.standardFromBody);
    for (const auto& pair : pairsToFilter(profile, placed)) {
        auto& pairs = profile.filteredPairs;
        if (std::find(pairs.begin(), pairs.end(), pair) == pairs.end()) pairs.push_back(pair);
    }
    std::sort(profile.filteredPairs.begin(), profile.filteredPairs.end());
}

// The profile's bodies, constraints and pairs in the order of the plan, which is that of the roles.
RagdollProfile inPlanOrder(const RagdollProfile& profile, const BodyPlan& plan) {
    RagdollProfile ordered = profile;
    std::vector<int> newIndex(profile.bodies.size());
    const std::vector<int> places = placesInPlan(profile, plan);
    for (std::size_t body = 0; body < profile.bodies.size(); ++body) {
        newIndex[body] = places[body];
        ordered.bodies[newIndex[body]] = profile.bodies[body];
    }
    for (const ConstraintProfile& constraint : profile.constraints) {
        ConstraintProfile& target = ordered.constraints[newIndex[constraint.child] - 1];
        target = constraint;
        target.child = newIndex[constraint.child];
        target.parent = newIndex[constraint.parent];
    }
    for (auto& [first, second] : ordered.filteredPairs) {
        const int a = newIndex[first];
        const int b = newIndex[second];
        first = std::min(a, b);
        second = std::max(a, b);
    }
    return ordered;
}

// Whether the two anchors of every constraint meet in the rig's bind pose: a rig of the same joint names but other
// proportions is another rig.
bool anchorsMeet(const RagdollProfile& profile, const Rig& rig) {
    constexpr float kShareOfHeight = 0.01F;
    for (const ConstraintProfile& constraint : profile.constraints) {
        const vec3 onParent = rig.bindModelFromBody[constraint.parent] * constraint.parentFromFrame.translation;
        const vec3 onChild = rig.bindModelFromBody[constraint.child] * constraint.childFromFrame.translation;
        if (glm::distance(onParent, onChild) > kShareOfHeight * profile.heightM) return false;
    }
    return true;
}

bool sharesMostJoints(const RagdollProfile& profile, const animation::Skeleton& skeleton) {
    const auto there = std::count_if(profile.bodies.begin(), profile.bodies.end(), [&](const BodyProfile& body) {
        return jointOfBody(body, skeleton) != animation::kNoJoint;
    });
    return 2 * there > static_cast<std::ptrdiff_t>(profile.bodies.size());
}

}  // namespace

std::vector<Role> rolesOf(const RagdollProfile& profile) {
    std::vector<Role> roles;
    roles.reserve(profile.bodies.size());
    for (const BodyProfile& body : profile.bodies)
        if (body.role) roles.push_back(*body.role);
    return roles;
}

void placeBodies(RagdollProfile& profile, const animation::Character& character, const BodyPlan& plan,
                 std::span<const PlacedShape> shapes) {
    const RigidTransform modelFromStandard{glm::conjugate(profile.standardFromModel), vec3(0)};
    for (std::size_t i = 0; i < plan.bodies.size(); ++i) {
        const PlannedBody& planned = plan.bodies[i];
        BodyProfile& body = profile.bodies[i];
        body.role = planned.role;
        if (body.name.empty()) body.name = planned.name;
        if (planned.segment && planned.mirror >= 0 && body.mirror.empty())
            body.mirror = plan.bodies[planned.mirror].name;
        body.joint = character.skeleton.names[planned.joint];
        body.jointPath = jointPath(character.skeleton, planned.joint);
        body.shape = shapes[i].shape;
        const RigidTransform modelFromBody = modelFromStandard * shapes[i].standardFromBody;
        body.jointFromBody = inverse(character.skeleton.bindModelFromJoint[planned.joint]) * modelFromBody;
        body.jointFromBody.rotation = glm::normalize(body.jointFromBody.rotation);
    }
}

std::vector<PlacedShape> shapesInBindPose(const RagdollProfile& profile, const animation::Skeleton& skeleton) {
    const RigidTransform standardFromModel{profile.standardFromModel, vec3(0)};
    std::vector<PlacedShape> shapes;
    shapes.reserve(profile.bodies.size());
    for (const BodyProfile& body : profile.bodies) {
        const int joint = jointOfBody(body, skeleton);
        LUTKA_ASSERT(joint != animation::kNoJoint);
        shapes.push_back({body.shape, standardFromModel * skeleton.bindModelFromJoint[joint] * body.jointFromBody});
    }
    return shapes;
}

Result<RagdollProfile> rebindProfile(const RagdollProfile& given, const animation::Character& character,
                                     const animation::HumanoidMap& map, bool keepShapes) {
    const RagdollProfile profile = adaptTrunk(given, map);
    if (const Result<void> checked = checkRoles(profile, character, map); !checked) return checked.error();
    const BodyPlan plan = planOfProfile(profile, character, map);
    if (plan.bodies.size() != profile.bodies.size()) {
        return Error{ErrorCode::input, "two roles of the profile are on one joint of the rig", character.file.string(),
                     "build a profile for this rig (`lutka build`)"};
    }
    const Anatomy anatomy = findAnatomy(plan);
    RagdollProfile bound = inPlanOrder(profile, plan);
    bound.name = character.name;
    bound.heightM = plan.heightM;
    bound.standardFromModel = map.standardFromModel;
    std::vector<quat> turns;
    for (std::size_t i = 0; i < plan.bodies.size(); ++i) {
        turns.push_back(map.standardFromModel * character.skeleton.bindModelFromJoint[plan.bodies[i].joint].rotation *
                        bound.bodies[i].jointFromBody.rotation);
    }
    const std::vector<PlacedShape> shapes =
        keepShapes ? keptShapes(bound, plan, anatomy) : fitShapes(plan, anatomy, mostShapesOf(profile));
    placeBodies(bound, character, plan, shapes);
    if (!keepShapes) {
        for (BodyProfile& body : bound.bodies)
            body.inertia = shapeInertia(body.shape, body.massKg);
    }
    rebuildConstraints(bound, plan, anatomy, shapes, turns);
    addFilteredPairs(bound, shapes);
    if (const auto problems = validate(bound); !problems.empty()) {
        return Error{ErrorCode::input, "no valid ragdoll comes out: " + problems.front(), character.name, {}};
    }
    return bound;
}

Result<BoundProfile> bindOrRebind(RagdollProfile profile, const animation::Character& character,
                                  const animation::HumanoidMap& map, bool keepShapes) {
    const Result<Rig> rig = bindRig(profile, character.skeleton);
    if (!rig && sharesMostJoints(profile, character.skeleton)) return rig.error();
    if (rig && anchorsMeet(profile, rig.value())) return BoundProfile{std::move(profile), false};
    Result<RagdollProfile> rebound = rebindProfile(profile, character, map, keepShapes);
    if (!rebound) return rebound.error();
    return BoundProfile{std::move(rebound).value(), true};
}

}  // namespace lutka::physics
