#include "physics/rig/lod_profile.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <set>

#include "core/assert.hpp"
#include "core/math.hpp"
#include "physics/collision/shape.hpp"

namespace lutka::physics {
namespace {

// The role whose body takes a body of this role in; its own where it stays.
Role mergedInto(Role role, LodLevel level) {
    using enum Role;
    const bool block = level == LodLevel::block;
    switch (role) {
        case leftHand:
            return block ? leftUpperArm : leftLowerArm;
        case rightHand:
            return block ? rightUpperArm : rightLowerArm;
        case leftLowerArm:
            return block ? leftUpperArm : role;
        case rightLowerArm:
            return block ? rightUpperArm : role;
        case leftFoot:
        case leftToes:
            return leftLowerLeg;
        case rightFoot:
        case rightToes:
            return rightLowerLeg;
        case spine:
        case chest:
        case upperChest:
        case leftShoulder:
        case rightShoulder:
            return block ? hips : spine;
        case neck:
        case head:
            return block ? hips : neck;
        default:
            return role;
    }
}

// Whether a body without a role becomes one with its parent, by the tree alone: the end of a chain with the link above
// it, and at the coarsest level all of an unbranched chain. Nothing merges into the root or into a part with a role.
bool joinsParent(const RagdollProfile& full, const Rig& rig, const std::vector<int>& childCount, int body,
                 LodLevel level) {
    const int parent = rig.parentBody[body];
    if (parent <= 0 || full.bodies[parent].role || childCount[parent] != 1) return false;
    return level == LodLevel::block || childCount[body] == 0;
}

// Which body of the full profile leads each body's group: the uppermost that is merged into the same role.
std::vector<int> leadersOf(const RagdollProfile& full, const Rig& rig, LodLevel level) {
    std::vector<int> childCount(full.bodies.size(), 0);
    for (const ConstraintProfile& constraint : full.constraints)
        ++childCount[constraint.parent];
    std::vector<int> leader(full.bodies.size());
    for (int body = 0; body < static_cast<int>(leader.size()); ++body) {
        leader[body] = body;
        const int parent = rig.parentBody[body];
        // Bodies come parents first, so that the parent's leader is known.
        if (parent < 0) continue;
        const std::optional<Role> own = full.bodies[body].role;
        const std::optional<Role> above = full.bodies[parent].role;
        const bool joins = own ? above && mergedInto(*own, level) == mergedInto(*above, level)
                               : joinsParent(full, rig, childCount, body, level);
        if (joins) leader[body] = leader[parent];
    }
    return leader;
}

mat3 inertiaAbout(const BodyProfile& body, const RigidTransform& modelFromBody, const vec3& centre) {
    const mat3 r = glm::mat3_cast(modelFromBody.rotation);
    const mat3 diagonal(body.inertia.x, 0, 0, 0, body.inertia.y, 0, 0, 0, body.inertia.z);
    const vec3 d = modelFromBody.translation - centre;
    return r * diagonal * glm::transpose(r) + body.massKg * (glm::dot(d, d) * mat3(1.0F) - glm::outerProduct(d, d));
}

// The thickness of a member across its length.
float thicknessOf(const BodyShape& shape) {
    if (!shape.more.empty()) return 0.5F * (halfWidth(shape, {1, 0, 0}) + halfWidth(shape, {0, 0, 1}));
    if (!shape.isAngular()) return shape.radius;
    const vec3 h = halfBox(shape);
    return (h.x + h.y + h.z - std::max({h.x, h.y, h.z})) / 2.0F;
}

// A rotation of principal axes with y along the smallest moment, which is the longest extent, pointing with `like`.
quat longestAlongY(const mat3& axes, const mat3& moments, const vec3& like) {
    int y = 0;
    for (int i = 1; i < 3; ++i)
        if (moments[i][i] < moments[y][y]) y = i;
    const vec3 up = glm::dot(axes[y], like) < 0.0F ? -axes[y] : axes[y];
    const vec3& x = axes[(y + 1) % 3];
    return glm::normalize(glm::quat_cast(mat3(x, up, glm::cross(x, up))));
}

// What is merged, while it is put together.
struct Group {
    std::vector<int> members;  // of the full profile, uppermost first
    RigidTransform bindModelFromLod;
    BodyProfile body;
};

void mergeShape(const RagdollProfile& full, const Rig& rig, Group& group) {
    const RigidTransform lodFromModel = inverse(group.bindModelFromLod);
    float low = 0.0F;
    float high = 0.0F;
    float thickness = 0.0F;
    for (const int member : group.members) {
        const BodyProfile& body = full.bodies[member];
        const RigidTransform lodFromBody = lodFromModel * rig.bindModelFromBody[member];
        const vec3 up = glm::conjugate(lodFromBody.rotation) * vec3(0, 1, 0);
        low = std::min(low, lodFromBody.translation.y - supportExtent(body.shape, -up));
        high = std::max(high, lodFromBody.translation.y + supportExtent(body.shape, up));
        thickness += thicknessOf(body.shape) * body.massKg / group.body.massKg;
    }
    group.body.shape = {};
    group.body.shape.radius = thickness;
    group.body.shape.halfLength = std::max(0.0F, (high - low) / 2.0F - thickness);
}

Group mergeGroup(const RagdollProfile& full, const Rig& rig, std::vector<int> members) {
    Group group;
    group.members = std::move(members);
    const int lead = group.members.front();
    group.body = full.bodies[lead];
    group.bindModelFromLod = rig.bindModelFromBody[lead];
    if (group.members.size() == 1) return group;
    vec3 centre(0);
    float mass = 0.0F;
    for (const int member : group.members) {
        centre += full.bodies[member].massKg * rig.bindModelFromBody[member].translation;
        mass += full.bodies[member].massKg;
    }
    centre /= mass;
    mat3 inertia(0.0F);
    for (const int member : group.members)
        inertia += inertiaAbout(full.bodies[member], rig.bindModelFromBody[member], centre);
    const mat3 axes = diagonalise(inertia);
    const vec3 like = rig.bindModelFromBody[lead].rotation * vec3(0, 1, 0);
    group.bindModelFromLod = {longestAlongY(axes, inertia, like), centre};
    const mat3 turned = glm::transpose(axes) * glm::mat3_cast(group.bindModelFromLod.rotation);
    // The axes changed places only: each column of `turned` is ± a unit vector.
    for (int i = 0; i < 3; ++i)
        group.body.inertia[i] = glm::dot(turned[i] * turned[i], vec3(inertia[0][0], inertia[1][1], inertia[2][2]));
    group.body.massKg = mass;
    group.body.jointFromBody =
        full.bodies[lead].jointFromBody * inverse(rig.bindModelFromBody[lead]) * group.bindModelFromLod;
    mergeShape(full, rig, group);
    return group;
}

// Groups that were filtered in part, and those whose shapes overlap in the bind pose, never collide.
void filterGroups(const RagdollProfile& full, const std::vector<Group>& groups, LodProfile& lod) {
    std::set<std::pair<int, int>> linked;
    for (const ConstraintProfile& constraint : lod.profile.constraints)
        linked.emplace(std::minmax(constraint.parent, constraint.child));
    std::set<std::pair<int, int>> filtered;
    for (const auto& [a, b] : full.filteredPairs)
        if (lod.bodyOf[a] != lod.bodyOf[b]) filtered.insert(std::minmax(lod.bodyOf[a], lod.bodyOf[b]));
    for (int a = 0; a < static_cast<int>(groups.size()); ++a) {
        for (int b = a + 1; b < static_cast<int>(groups.size()); ++b) {
            if (distanceBetween(groups[a].body.shape, groups[a].bindModelFromLod, groups[b].body.shape,
                                groups[b].bindModelFromLod) < 0.0F)
                filtered.emplace(a, b);
        }
    }
    lod.profile.filteredPairs.clear();
    std::set_difference(filtered.begin(), filtered.end(), linked.begin(), linked.end(),
                        std::back_inserter(lod.profile.filteredPairs));
}

}  // namespace

LodProfile makeLodProfile(const RagdollProfile& full, const Rig& rig, LodLevel level) {
    LUTKA_ASSERT(rig.jointOfBody.size() == full.bodies.size());
    const std::vector<int> leader = leadersOf(full, rig, level);
    std::map<int, std::vector<int>> membersOf;  // by leader, which comes first
    for (int body = 0; body < static_cast<int>(leader.size()); ++body)
        membersOf[leader[body]].push_back(body);
    LodProfile lod;
    lod.profile = full;
    lod.profile.bodies.clear();
    lod.profile.constraints.clear();
    lod.bodyOf.resize(full.bodies.size());
    lod.lodFromBody.resize(full.bodies.size());
    std::vector<Group> groups;
    for (auto& [lead, members] : membersOf) {
        Group group = mergeGroup(full, rig, std::move(members));
        for (const int member : group.members) {
            lod.bodyOf[member] = static_cast<int>(groups.size());
            lod.lodFromBody[member] = inverse(group.bindModelFromLod) * rig.bindModelFromBody[member];
        }
        lod.upper.push_back(lead);
        lod.profile.bodies.push_back(group.body);
        groups.push_back(std::move(group));
    }
    for (const ConstraintProfile& constraint : full.constraints) {
        if (lod.bodyOf[constraint.parent] == lod.bodyOf[constraint.child]) continue;
        ConstraintProfile& kept = lod.profile.constraints.emplace_back(constraint);
        kept.parent = lod.bodyOf[constraint.parent];
        kept.child = lod.bodyOf[constraint.child];
        kept.parentFromFrame = lod.lodFromBody[constraint.parent] * constraint.parentFromFrame;
        kept.childFromFrame = lod.lodFromBody[constraint.child] * constraint.childFromFrame;
    }
    filterGroups(full, groups, lod);
    return lod;
}

namespace {

// From the root on, every body goes where its constraint closes.
void closeConstraints(const RagdollProfile& profile, std::span<BodyState> bodies) {
    for (const ConstraintProfile& constraint : profile.constraints) {
        RigidTransform& child = bodies[constraint.child].worldFromBody;
        child.translation = bodies[constraint.parent].worldFromBody * constraint.parentFromFrame.translation -
                            child.rotation * constraint.childFromFrame.translation;
    }
}

vec3 turnedBy(const quat& rotation, const vec3& principal, const vec3& v) {
    return rotation * (principal * (glm::conjugate(rotation) * v));
}

}  // namespace

void fullToLod(const LodProfile& lod, const RagdollProfile& full, std::span<const BodyState> bodies,
               std::span<BodyState> lodBodies, std::span<quat> lodFromMember) {
    LUTKA_ASSERT(bodies.size() == full.bodies.size() && lodFromMember.size() == bodies.size());
    LUTKA_ASSERT(lodBodies.size() == lod.profile.bodies.size());
    std::vector<vec3> centres(lodBodies.size(), vec3(0));
    for (BodyState& group : lodBodies)
        group = {};
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const int group = lod.bodyOf[i];
        const float share = full.bodies[i].massKg / lod.profile.bodies[group].massKg;
        centres[group] += share * bodies[i].worldFromBody.translation;
        lodBodies[group].linearVelocity += share * bodies[i].linearVelocity;
    }
    for (std::size_t group = 0; group < lodBodies.size(); ++group) {
        const RigidTransform& upper = bodies[lod.upper[group]].worldFromBody;
        lodBodies[group].worldFromBody = upper * inverse(lod.lodFromBody[lod.upper[group]]);
        lodBodies[group].worldFromBody.rotation = glm::normalize(lodBodies[group].worldFromBody.rotation);
    }
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        BodyState& group = lodBodies[lod.bodyOf[i]];
        const BodyState& body = bodies[i];
        const vec3 arm = body.worldFromBody.translation - centres[lod.bodyOf[i]];
        // Angular momentum, until all members are in.
        group.angularVelocity += turnedBy(body.worldFromBody.rotation, full.bodies[i].inertia, body.angularVelocity) +
                                 full.bodies[i].massKg * glm::cross(arm, body.linearVelocity - group.linearVelocity);
        lodFromMember[i] = glm::conjugate(group.worldFromBody.rotation) * body.worldFromBody.rotation;
    }
    for (std::size_t group = 0; group < lodBodies.size(); ++group) {
        lodBodies[group].angularVelocity =
            turnedBy(lodBodies[group].worldFromBody.rotation, 1.0F / lod.profile.bodies[group].inertia,
                     lodBodies[group].angularVelocity);
    }
    closeConstraints(lod.profile, lodBodies);
}

void lodToFull(const LodProfile& lod, const RagdollProfile& full, std::span<const BodyState> lodBodies,
               std::span<const quat> lodFromMember, std::span<BodyState> bodies) {
    LUTKA_ASSERT(bodies.size() == full.bodies.size() && lodFromMember.size() == bodies.size());
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const BodyState& group = lodBodies[lod.bodyOf[i]];
        bodies[i].worldFromBody = group.worldFromBody * lod.lodFromBody[i];
        bodies[i].worldFromBody.rotation = glm::normalize(group.worldFromBody.rotation * lodFromMember[i]);
    }
    closeConstraints(full, bodies);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const BodyState& group = lodBodies[lod.bodyOf[i]];
        const vec3 arm = bodies[i].worldFromBody.translation - group.worldFromBody.translation;
        bodies[i].angularVelocity = group.angularVelocity;
        bodies[i].linearVelocity = group.linearVelocity + glm::cross(group.angularVelocity, arm);
    }
}

}  // namespace lutka::physics
