#include "physics/fit/edit_bodies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <glm/geometric.hpp>

#include "physics/collision/shape.hpp"
#include "physics/fit/fit_shapes.hpp"
#include "physics/fit/hull_fit.hpp"
#include "physics/fit/profile_plan.hpp"
#include "physics/fit/rebind.hpp"
#include "physics/fit/separate_shapes.hpp"
#include "physics/profile/constraint_frames.hpp"

namespace lutka::physics {
namespace {

using animation::Character;
using animation::HumanoidMap;
using animation::kNoJoint;
using animation::Skeleton;

using Placed = std::vector<PlacedShape>;

bool hangsBelow(const Skeleton& skeleton, int joint, const BodyProfile& body) {
    const int own = jointOfBody(body, skeleton);
    return own != kNoJoint && animation::isAncestorOrSelf(skeleton, joint, own);
}

std::string freeName(const RagdollProfile& profile, const std::string& wanted) {
    std::string name = wanted;
    for (int number = 2; bodyNamed(profile, name) >= 0; ++number)
        name = fmt::format("{} {}", wanted, number);
    return name;
}

// Every index of a body as `moved` tells it; pairs that lose a body, or become linked, go.
void renumber(RagdollProfile& profile, const std::function<int(int)>& moved) {
    for (ConstraintProfile& constraint : profile.constraints) {
        constraint.parent = moved(constraint.parent);
        constraint.child = moved(constraint.child);
    }
    for (auto& [first, second] : profile.filteredPairs) {
        first = moved(first);
        second = moved(second);
    }
}

void dropLinkedPairs(RagdollProfile& profile) {
    std::erase_if(profile.filteredPairs, [&](const std::pair<int, int>& pair) {
        if (pair.first < 0 || pair.second < 0) return true;
        return std::any_of(profile.constraints.begin(), profile.constraints.end(), [&](const ConstraintProfile& c) {
            return std::pair(std::min(c.parent, c.child), std::max(c.parent, c.child)) == pair;
        });
    });
    std::sort(profile.filteredPairs.begin(), profile.filteredPairs.end());
}

// The constraint stays where it is in the bind pose and hangs on another body.
void rehang(ConstraintProfile& constraint, int parent, const Placed& placed) {
    constraint.parentFromFrame = inverse(placed[parent].standardFromBody) * placed[constraint.parent].standardFromBody *
                                 constraint.parentFromFrame;
    constraint.parentFromFrame.rotation = glm::normalize(constraint.parentFromFrame.rotation);
    constraint.parent = parent;
}

// The map without the limb roles that the body stands for beside its own: an arm without a forearm reaches to the hand.
HumanoidMap mapOfBody(const RagdollProfile& profile, const HumanoidMap& map, int body) {
    HumanoidMap own = map;
    for (int index = 0; index < animation::kRoleCount; ++index) {
        const Role role = animation::roleAt(index);
        if (animation::sideOf(role) == animation::Side::center || bodyOf(profile, role) >= 0) continue;
        std::optional<Role> above = animation::parentRole(role);
        while (above && bodyOf(profile, *above) < 0)
            above = animation::parentRole(*above);
        if (above && bodyOf(profile, *above) == body) own.roles[static_cast<std::size_t>(index)].reset();
    }
    return own;
}

// The shape that the skin asks for, and its place in the body's joint.
void fitBody(RagdollProfile& profile, const Character& character, const HumanoidMap& map, int body) {
    const BodyPlan plan = planOfProfile(profile, character, mapOfBody(profile, map, body));
    const int place = placesInPlan(profile, plan)[body];
    if (place < 0) return;
    const PlacedShape fitted = fitShapes(plan, findAnatomy(plan), mostShapesOf(profile))[place];
    const int joint = plan.bodies[place].joint;
    const RigidTransform standardFromModel{profile.standardFromModel, vec3(0)};
    RigidTransform jointFromBody =
        inverse(standardFromModel * character.skeleton.bindModelFromJoint[joint]) * fitted.standardFromBody;
    jointFromBody.rotation = glm::normalize(jointFromBody.rotation);
    moveBody(profile, body, jointFromBody);
    profile.bodies[body].shape = fitted.shape;
    profile.bodies[body].inertia = shapeInertia(fitted.shape, profile.bodies[body].massKg);
}

// By volume, of what the body above has.
void shareMass(BodyProfile& above, BodyProfile& body) {
    constexpr float most = 0.5F;
    const float volume = shapeVolume(body.shape);
    const float share = std::min(volume / (volume + shapeVolume(above.shape)), most);
    body.massKg = above.massKg * share;
    above.massKg -= body.massKg;
    for (BodyProfile* one : {&above, &body})
        one->inertia = shapeInertia(one->shape, one->massKg);
}

void linkBody(RagdollProfile& profile, const Character& character, const HumanoidMap& map, int body) {
    const BodyPlan plan = planOfProfile(profile, character, map);
    const int place = placesInPlan(profile, plan)[body];
    const Placed placed = shapesInBindPose(profile, character.skeleton);
    ConstraintProfile& constraint = profile.constraints[body - 1];
    const RigidTransform& above = placed[constraint.parent].standardFromBody;
    const RigidTransform& own = placed[body].standardFromBody;
    setFrames(constraint, jointFrames(plan, findAnatomy(plan), place), above, own);
    setRange(constraint, plan, place);
    if (std::string note = widenToHold(constraint, above, own, profile.bodies[body].name); !note.empty())
        profile.notes.push_back(std::move(note));
    RagdollProfile all = profile;
    setJointFriction(all);
    constraint.frictionNm = all.constraints[body - 1].frictionNm;
}

// Pairs that overlap now, of this body and of those that were linked before.
void filterPairs(RagdollProfile& profile, const Character& character, int body, int above) {
    std::vector<RigidTransform> places;
    for (const PlacedShape& shape : shapesInBindPose(profile, character.skeleton))
        places.push_back(shape.standardFromBody);
    for (const std::pair<int, int>& pair : pairsToFilter(profile, places)) {
        const auto has = [&](int one) { return pair.first == one || pair.second == one; };
        auto& pairs = profile.filteredPairs;
        const bool known = std::find(pairs.begin(), pairs.end(), pair) != pairs.end();
        if ((has(body) || has(above)) && !known) pairs.push_back(pair);
    }
    dropLinkedPairs(profile);
}

// Two bodies without roles whose joints lie across the figure from one another are each other's counterpart.
void findCounterpart(RagdollProfile& profile, const Skeleton& skeleton, int body) {
    const auto placeOf = [&](const BodyProfile& one) {
        const int joint = jointOfBody(one, skeleton);
        return profile.standardFromModel * skeleton.bindModelFromJoint[joint].translation;
    };
    const float middle = placeOf(profile.bodies.front()).x;
    vec3 across = placeOf(profile.bodies[body]);
    if (std::abs(across.x - middle) < 0.5F * kSymmetryTolerance * profile.heightM) return;
    across.x = 2.0F * middle - across.x;
    for (BodyProfile& other : profile.bodies) {
        if (other.role || !other.mirror.empty() || other.name == profile.bodies[body].name) continue;
        if (glm::distance(placeOf(other), across) > kSymmetryTolerance * profile.heightM) continue;
        other.mirror = profile.bodies[body].name;
        profile.bodies[body].mirror = other.name;
        return;
    }
}

// Makes room for a body at `place` and hangs it on `parent`; its joint's children among the bodies go along.
void insertBody(RagdollProfile& profile, const Skeleton& skeleton, int joint, int parent, int place) {
    renumber(profile, [&](int old) { return old >= place ? old + 1 : old; });
    BodyProfile body;
    body.name = freeName(profile, skeleton.names[joint]);
    body.joint = skeleton.names[joint];
    body.jointPath = animation::jointPath(skeleton, joint);
    body.massKg = profile.bodies[parent].massKg * 0.1F;
    profile.bodies.insert(profile.bodies.begin() + place, body);
    ConstraintProfile link;
    link.parent = parent;
    link.child = place;
    profile.constraints.insert(profile.constraints.begin() + place - 1, link);
    const Placed placed = shapesInBindPose(profile, skeleton);
    for (ConstraintProfile& constraint : profile.constraints) {
        if (constraint.child == place || constraint.parent != parent) continue;
        if (hangsBelow(skeleton, joint, profile.bodies[constraint.child])) rehang(constraint, place, placed);
    }
}

// The joint inside a body's part that is nearest to its middle; kNoJoint: none.
int middleJoint(const RagdollProfile& profile, const Skeleton& skeleton, int body) {
    const int start = jointOfBody(profile.bodies[body], skeleton);
    const auto at = [&](int joint) { return skeleton.bindModelFromJoint[joint].translation; };
    std::vector<int> inside;
    std::vector<int> towards;  // those on the way to another body
    float longest = 0.0F;
    for (int joint = 0; joint < skeleton.jointCount(); ++joint) {
        if (joint == start || bodyCarryingJoint(profile, skeleton, joint) != body) continue;
        inside.push_back(joint);
        const bool leads = std::any_of(profile.constraints.begin(), profile.constraints.end(), [&](const auto& c) {
            return c.parent == body && hangsBelow(skeleton, joint, profile.bodies[c.child]);
        });
        if (leads) towards.push_back(joint);
    }
    for (const ConstraintProfile& constraint : profile.constraints) {
        if (constraint.parent != body) continue;
        const int end = jointOfBody(profile.bodies[constraint.child], skeleton);
        if (!towards.empty()) longest = std::max(longest, glm::distance(at(start), at(end)));
    }
    const std::vector<int>& candidates = towards.empty() ? inside : towards;
    for (const int joint : candidates)
        longest = std::max(longest, glm::distance(at(start), at(joint)));
    int best = kNoJoint;
    float nearest = 0.0F;
    for (const int joint : candidates) {
        const float length = glm::distance(at(start), at(joint));
        const float off = std::abs(length - 0.5F * longest);
        if (length < 0.005F * profile.heightM || (best != kNoJoint && off >= nearest)) continue;
        best = joint;
        nearest = off;
    }
    return best;
}

Result<RagdollProfile> whole(RagdollProfile profile, const Character& character) {
    if (const std::vector<std::string> problems = validate(profile); !problems.empty())
        return Error{ErrorCode::input, "no valid ragdoll comes out: " + problems.front(), character.name, {}};
    return profile;
}

}  // namespace

int bodyCarryingJoint(const RagdollProfile& profile, const Skeleton& skeleton, int joint) {
    for (int at = joint; at >= 0; at = skeleton.parents[at]) {
        for (std::size_t body = 0; body < profile.bodies.size(); ++body) {
            if (jointOfBody(profile.bodies[body], skeleton) == at) return static_cast<int>(body);
        }
    }
    return -1;
}

Result<RagdollProfile> addBody(const RagdollProfile& profile, const Character& character, const HumanoidMap& map,
                               int joint) {
    const Skeleton& skeleton = character.skeleton;
    const std::string& name = skeleton.names[joint];
    const int parent = bodyCarryingJoint(profile, skeleton, joint);
    if (parent < 0) {
        return Error{ErrorCode::usage, fmt::format("\"{}\" lies above the root's joint", name), "",
                     "choose a joint below " + profile.bodies.front().name};
    }
    if (jointOfBody(profile.bodies[parent], skeleton) == joint)
        return Error{ErrorCode::usage, fmt::format("\"{}\" has a body already", name), "", "choose another joint"};
    if (profile.bodies.size() >= RagdollProfile::kMostBodies)
        return Error{ErrorCode::usage, fmt::format("a ragdoll has {} bodies at most", RagdollProfile::kMostBodies), "",
                     ""};
    const bool between = std::any_of(profile.constraints.begin(), profile.constraints.end(), [&](const auto& c) {
        return c.parent == parent && hangsBelow(skeleton, joint, profile.bodies[c.child]);
    });
    // Parents come first; one that carries nothing goes to the end, so that the others keep their places.
    const int place = between ? parent + 1 : static_cast<int>(profile.bodies.size());
    RagdollProfile work = profile;
    insertBody(work, skeleton, joint, parent, place);
    fitBody(work, character, map, place);
    shareMass(work.bodies[parent], work.bodies[place]);
    linkBody(work, character, map, place);
    filterPairs(work, character, place, parent);
    findCounterpart(work, skeleton, place);
    return whole(std::move(work), character);
}

Result<RagdollProfile> removeBody(const RagdollProfile& profile, const Character& character, int body) {
    if (body <= 0) {
        return Error{ErrorCode::usage, profile.bodies.front().name + " is the root: all others hang on it", "",
                     "remove others, or make the ragdoll anew"};
    }
    RagdollProfile work = profile;
    const int parent = profile.constraints[body - 1].parent;
    const Placed placed = shapesInBindPose(profile, character.skeleton);
    for (ConstraintProfile& constraint : work.constraints) {
        if (constraint.parent == body) rehang(constraint, parent, placed);
    }
    BodyProfile& above = work.bodies[parent];
    above.massKg += profile.bodies[body].massKg;
    above.inertia = shapeInertia(above.shape, above.massKg);
    for (BodyProfile& other : work.bodies) {
        if (other.mirror == profile.bodies[body].name) other.mirror.clear();
    }
    work.bodies.erase(work.bodies.begin() + body);
    work.constraints.erase(work.constraints.begin() + body - 1);
    renumber(work, [&](int old) { return old == body ? -1 : old > body ? old - 1 : old; });
    dropLinkedPairs(work);
    return whole(std::move(work), character);
}

Result<RagdollProfile> mergeBody(const RagdollProfile& profile, const Character& character, const HumanoidMap& map,
                                 int body) {
    auto removed = removeBody(profile, character, body);
    if (!removed) return removed;
    RagdollProfile work = std::move(removed).value();
    fitBody(work, character, map, profile.constraints[body - 1].parent);
    return whole(std::move(work), character);
}

Result<RagdollProfile> splitBody(const RagdollProfile& profile, const Character& character, const HumanoidMap& map,
                                 int body) {
    const int joint = middleJoint(profile, character.skeleton, body);
    const std::string name = profile.bodies[body].name;
    if (joint == kNoJoint) {
        return Error{ErrorCode::usage, fmt::format("no joint lies inside {}", name), "",
                     "split a body whose part has more than one joint"};
    }
    auto added = addBody(profile, character, map, joint);
    if (!added) return added;
    RagdollProfile work = std::move(added).value();
    fitBody(work, character, map, bodyNamed(work, name));
    return whole(std::move(work), character);
}

Result<HullOfSkin> hullOfSkin(const RagdollProfile& profile, const Character& character, const HumanoidMap& map,
                              int body) {
    const BodyPlan plan = planOfProfile(profile, character, mapOfBody(profile, map, body));
    const int place = placesInPlan(profile, plan)[body];
    const PlacedShape present = shapesInBindPose(profile, character.skeleton)[body];
    const auto hull = place >= 0 ? fitHull(plan, plan.bodies[place], present) : std::nullopt;
    if (!hull) {
        return Error{ErrorCode::usage,
                     fmt::format("{} has no skin that a hull could be made of", profile.bodies[body].name), "",
                     "choose another shape"};
    }
    // The present shape's place in the joint, and in it the hull's.
    RigidTransform jointFromBody =
        profile.bodies[body].jointFromBody * inverse(present.standardFromBody) * hull->standardFromBody;
    jointFromBody.rotation = glm::normalize(jointFromBody.rotation);
    return HullOfSkin{hull->shape, jointFromBody};
}

RagdollProfile rootAlone(const RagdollProfile& profile, const Character& character, const HumanoidMap& map) {
    RagdollProfile work = profile;
    work.bodies.resize(1);
    work.constraints.clear();
    work.filteredPairs.clear();
    work.notes.clear();
    work.bodies.front().mirror.clear();
    work.bodies.front().massKg = profile.totalMassKg;
    fitBody(work, character, map, 0);
    return work;
}

}  // namespace lutka::physics
