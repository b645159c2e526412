#include "physics/fit/trunk_roles.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace lutka::physics {
namespace {

constexpr std::array<Role, 3> kSpineRoles = {Role::spine, Role::chest, Role::upperChest};

// Trunk roles with a joint of their own, from below; a trunk of one joint may be hips and spine at once.
std::vector<Role> trunkOfRig(const animation::HumanoidMap& map) {
    std::vector<Role> roles;
    for (const Role role : kSpineRoles) {
        const int joint = map.jointOf(role);
        if (joint != animation::kNoJoint && joint != map.jointOf(Role::hips)) roles.push_back(role);
    }
    return roles;
}

std::vector<int> trunkBodies(const RagdollProfile& profile) {
    std::vector<int> bodies;
    for (const Role role : kSpineRoles) {
        if (const int body = bodyOf(profile, role); body >= 0) bodies.push_back(body);
    }
    return bodies;
}

void mergePairs(RagdollProfile& profile, int body, int into) {
    std::vector<std::pair<int, int>> pairs;
    const auto moved = [&](int index) { return index == body ? into : index; };
    const auto shifted = [&](int index) { return index > body ? index - 1 : index; };
    for (const auto& [first, second] : profile.filteredPairs) {
        const int a = shifted(moved(first));
        const int b = shifted(moved(second));
        if (a != b) pairs.emplace_back(std::min(a, b), std::max(a, b));
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    profile.filteredPairs = std::move(pairs);
}

void mergeIntoParent(RagdollProfile& profile, int body) {
    const ConstraintProfile link = profile.constraints[body - 1];
    profile.bodies[link.parent].massKg += profile.bodies[body].massKg;
    const RigidTransform parentFromBody = link.parentFromFrame * inverse(link.childFromFrame);
    mergePairs(profile, body, link.parent);
    profile.bodies.erase(profile.bodies.begin() + body);
    profile.constraints.erase(profile.constraints.begin() + (body - 1));
    for (ConstraintProfile& constraint : profile.constraints) {
        if (constraint.parent == body) {
            constraint.parent = link.parent;
            constraint.parentFromFrame = parentFromBody * constraint.parentFromFrame;
        }
        if (constraint.parent > body) --constraint.parent;
        if (constraint.child > body) --constraint.child;
    }
}

// Linked bodies never collide anyway, and a merge may have linked two that were filtered.
void dropPairsOfJoints(RagdollProfile& profile) {
    std::erase_if(profile.filteredPairs, [&](const std::pair<int, int>& pair) {
        return profile.constraints[pair.second - 1].parent == pair.first;
    });
}

}  // namespace

RagdollProfile adaptTrunk(RagdollProfile profile, const animation::HumanoidMap& map) {
    const std::vector<Role> rig = trunkOfRig(map);
    std::vector<int> bodies = trunkBodies(profile);
    const bool fits = std::all_of(bodies.begin(), bodies.end(), [&](int body) {
        return std::find(rig.begin(), rig.end(), *profile.bodies[body].role) != rig.end();
    });
    if (fits) return profile;
    while (bodies.size() > rig.size()) {
        // From below the top: the topmost carries arms and head and keeps its own limits where it can.
        mergeIntoParent(profile, bodies.size() > 1 && !rig.empty() ? bodies[bodies.size() - 2] : bodies.back());
        bodies = trunkBodies(profile);
    }
    for (std::size_t i = 0; i + 1 < bodies.size(); ++i)
        setRole(profile.bodies[bodies[i]], rig[i]);
    if (!bodies.empty()) setRole(profile.bodies[bodies.back()], rig.back());
    dropPairsOfJoints(profile);
    return profile;
}

}  // namespace lutka::physics
