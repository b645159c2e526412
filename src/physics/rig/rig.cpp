#include "physics/rig/rig.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <string>

#include "core/assert.hpp"

namespace lutka::physics {
namespace {

using animation::isAncestorOrSelf;
using animation::kNoJoint;
using animation::Skeleton;

// Joints that a body owns, while the rig is being bound.
struct Binding {
    const Skeleton& skeleton;
    const RagdollProfile& profile;
    Rig rig;
    std::vector<int> bodyOfJoint;  // -1: none

    [[nodiscard]] vec3 position(int joint) const { return skeleton.bindModelFromJoint[joint].translation; }
    [[nodiscard]] bool isMapped(int joint) const { return bodyOfJoint[joint] >= 0; }
    void setBase(int joint, int base) {
        rig.joints[joint].base = base;
        rig.joints[joint].baseFromJoint =
            base == kNoJoint ? skeleton.bindModelFromJoint[joint]
                             : inverse(skeleton.bindModelFromJoint[base]) * skeleton.bindModelFromJoint[joint];
    }
};

// Spine and neck bend as an arc.
bool isTrunkLink(const BodyProfile& body) {
    return body.role && animation::sideOf(*body.role) == animation::Side::center;
}

// Whether the joints between this body's and its parent's stay with the parent. They do where a limb leaves the trunk,
// and where a body without a role has siblings.
bool isLimbRoot(const RagdollProfile& profile, int body, int parent) {
    using enum Role;
    if (const auto& role = profile.bodies[body].role) {
        return *role == leftUpperArm || *role == rightUpperArm || *role == leftUpperLeg || *role == rightUpperLeg ||
               *role == leftShoulder || *role == rightShoulder;
    }
    return std::count_if(profile.constraints.begin(), profile.constraints.end(),
                         [&](const ConstraintProfile& c) { return c.parent == parent; }) > 1;
}

Result<void> findJoints(Binding& b) {
    std::string missing;
    for (const BodyProfile& body : b.profile.bodies) {
        int joint = animation::findJoint(b.skeleton, body.jointPath);
        if (joint == kNoJoint) joint = animation::findJoint(b.skeleton, body.joint);
        if (joint == kNoJoint || b.isMapped(joint)) {
            missing += (missing.empty() ? "" : ", ") + body.jointPath + (joint == kNoJoint ? "" : " (taken twice)");
            joint = kNoJoint;
        } else {
            b.bodyOfJoint[joint] = static_cast<int>(b.rig.jointOfBody.size());
        }
        b.rig.jointOfBody.push_back(joint);
    }
    if (missing.empty()) return {};
    return Error{ErrorCode::input, "the skeleton lacks joints that the profile's bodies stand for: " + missing,
                 b.profile.name, "build the profile anew from this model"};
}

// Joints strictly between the child body's joint and its parent body's, lowest first; `found` is false when the child's
// joint is not below the parent's, or another body's joint lies between.
std::vector<int> jointsBetween(const Binding& b, int child, int parent, bool& found) {
    std::vector<int> between;
    found = false;
    for (int joint = b.skeleton.parents[child]; joint != kNoJoint; joint = b.skeleton.parents[joint]) {
        if (joint == parent) {
            found = true;
            break;
        }
        if (b.isMapped(joint)) break;
        between.push_back(joint);
    }
    return between;
}

// The joints between two bodies share the rotation between them by their place along the way: the trunk bends as an
// arc, a limb only twists. Where a limb leaves the trunk (clavicles) they stay with the trunk, because there the
// physical anchor does.
void makeChain(Binding& b, const std::vector<int>& between, int upperBody, int lowerBody) {
    if (between.empty() || isLimbRoot(b.profile, lowerBody, upperBody)) return;
    const bool arc = isTrunkLink(b.profile.bodies[lowerBody]);
    const int upper = b.rig.jointOfBody[upperBody];
    const int lower = b.rig.jointOfBody[lowerBody];
    std::vector<float> along;  // length from the upper joint, in the order of `between` reversed
    float length = 0.0F;
    vec3 last = b.position(upper);
    for (auto it = between.rbegin(); it != between.rend(); ++it) {
        length += glm::distance(last, b.position(*it));
        last = b.position(*it);
        along.push_back(length);
    }
    length += glm::distance(last, b.position(lower));
    const vec3 axis = b.position(lower) - b.position(upper);
    for (std::size_t i = 0; i < along.size(); ++i) {
        Rig::Joint& joint = b.rig.joints[between[between.size() - 1 - i]];
        const float byIndex = static_cast<float>(i + 1) / static_cast<float>(along.size() + 1);
        joint.drive = JointDrive::chain;
        joint.upperBody = upperBody;
        joint.body = lowerBody;
        joint.share = length > 1e-6F ? along[i] / length : byIndex;
        if (!arc && glm::length(axis) > 1e-6F) joint.twistAxis = glm::normalize(axis);
    }
}

// Gives a joint on the line from one body's joint to the next one's its part of the twist; false when it lies
// elsewhere.
bool takesTwist(Binding& b, int joint, int upperBody, int lowerBody) {
    const vec3 start = b.position(b.rig.jointOfBody[upperBody]);
    const vec3 axis = b.position(b.rig.jointOfBody[lowerBody]) - start;
    const float length = glm::length(axis);
    if (length < 1e-6F) return false;
    const vec3 offset = b.position(joint) - start;
    const float along = glm::dot(offset, axis) / (length * length);
    const bool onTheLine = glm::length(offset - along * axis) < 0.02F * length && along > 0.05F && along < 1.05F;
    if (!onTheLine) return false;
    Rig::Joint& helper = b.rig.joints[joint];
    helper.drive = JointDrive::chain;
    helper.upperBody = upperBody;
    helper.body = lowerBody;
    helper.share = std::min(along, 1.0F);
    helper.twistAxis = axis / length;
    return true;
}

// Twist helpers beside the way: a limb's unmapped child that lies on the line to the next body takes its part of the
// twist as well.
void makeTwistHelpers(Binding& b, int upperBody, int lowerBody) {
    if (isTrunkLink(b.profile.bodies[lowerBody]) || isLimbRoot(b.profile, lowerBody, upperBody)) return;
    const int upper = b.rig.jointOfBody[upperBody];
    for (int joint = upper + 1; joint < b.skeleton.jointCount(); ++joint) {
        const bool beside = b.skeleton.parents[joint] == upper && !b.isMapped(joint);
        if (beside && b.rig.joints[joint].drive != JointDrive::chain) takesTwist(b, joint, upperBody, lowerBody);
    }
}

// Halves of a segment that hang side by side ("arm_twist" at the shoulder, "arm_stretch" halfway down, which carries
// the forearm): the half between two bodies goes with the upper one and takes its part of the twist.
void makeHalves(Binding& b, int upperBody, int lowerBody) {
    if (isTrunkLink(b.profile.bodies[lowerBody]) || isLimbRoot(b.profile, lowerBody, upperBody)) return;
    const int upper = b.rig.jointOfBody[upperBody];
    const int lower = b.rig.jointOfBody[lowerBody];
    for (int joint = b.skeleton.parents[lower]; joint != kNoJoint; joint = b.skeleton.parents[joint]) {
        const bool free = !b.isMapped(joint) && b.rig.joints[joint].drive == JointDrive::follower;
        if (!free || !takesTwist(b, joint, upperBody, lowerBody)) return;
        b.setBase(joint, upper);
    }
}

// Unmapped joints above a mapped one that nothing else moves follow it, so that the relation in the file holds.
void carryAncestors(Binding& b, int mappedJoint) {
    int child = mappedJoint;
    for (int joint = b.skeleton.parents[child]; joint != kNoJoint; joint = b.skeleton.parents[child]) {
        const bool free = !b.isMapped(joint) && b.rig.joints[joint].drive == JointDrive::follower;
        const bool ownedByAnother = std::any_of(b.rig.jointOfBody.begin() + 1, b.rig.jointOfBody.end(), [&](int other) {
            return mappedJoint != b.rig.jointOfBody[0] && other != mappedJoint &&
                   isAncestorOrSelf(b.skeleton, joint, other);
        });
        if (!free || ownedByAnother ||
            (mappedJoint != b.rig.jointOfBody[0] && isAncestorOrSelf(b.skeleton, joint, b.rig.jointOfBody[0])))
            return;
        b.setBase(joint, child);
        child = joint;
    }
}

// What lies beside the figure in the file (a hat with a skeleton of its own) goes along with the nearest joint that a
// body moves.
void carryBeside(Binding& b) {
    const int count = b.skeleton.jointCount();
    std::vector<bool> isBelow(static_cast<std::size_t>(count)), isAbove(static_cast<std::size_t>(count));
    for (int joint = 0; joint < count; ++joint) {
        const int parent = b.skeleton.parents[joint];
        isBelow[joint] = b.isMapped(joint) || (parent != kNoJoint && isBelow[parent]);
    }
    for (int joint = 0; joint < count; ++joint)
        for (int above = joint; b.isMapped(joint) && above != kNoJoint; above = b.skeleton.parents[above])
            isAbove[above] = true;
    for (int joint = 0; joint < count; ++joint) {
        const int parent = b.skeleton.parents[joint];
        const bool isTop = parent == kNoJoint || isAbove[parent];
        if (isBelow[joint] || isAbove[joint] || !isTop) continue;
        int nearest = b.rig.jointOfBody[0];
        for (int other = 0; other < count; ++other)
            if (isBelow[other] && glm::distance(b.position(other), b.position(joint)) <
                                      glm::distance(b.position(nearest), b.position(joint)))
                nearest = other;
        b.setBase(joint, nearest);
    }
}

// Every joint after its base; false when the bases run in a circle.
bool orderByBase(Rig& rig) {
    std::vector<std::vector<int>> dependants(rig.joints.size());
    for (int joint = 0; joint < static_cast<int>(rig.joints.size()); ++joint) {
        const int base = rig.joints[joint].base;
        if (base == kNoJoint)
            rig.order.push_back(joint);
        else
            dependants[base].push_back(joint);
    }
    for (std::size_t i = 0; i < rig.order.size(); ++i) {
        const std::vector<int>& next = dependants[rig.order[i]];
        rig.order.insert(rig.order.end(), next.begin(), next.end());
    }
    return rig.order.size() == rig.joints.size();
}

void bindBodies(Binding& b) {
    const RagdollProfile& profile = b.profile;
    b.rig.anchors.resize(profile.bodies.size());
    b.rig.parentBody.assign(profile.bodies.size(), -1);
    for (const ConstraintProfile& constraint : profile.constraints) {
        b.rig.parentBody[constraint.child] = constraint.parent;
        b.rig.anchors[constraint.child] = {constraint.parentFromFrame.translation,
                                           constraint.childFromFrame.translation};
    }
    for (std::size_t body = 0; body < profile.bodies.size(); ++body) {
        const RigidTransform& jointFromBody = profile.bodies[body].jointFromBody;
        const int joint = b.rig.jointOfBody[body];
        b.rig.bindModelFromBody.push_back(b.skeleton.bindModelFromJoint[joint] * jointFromBody);
        b.rig.bodyFromJoint.push_back(inverse(jointFromBody));
        b.rig.joints[joint].drive = JointDrive::mapped;
        b.rig.joints[joint].body = static_cast<int>(body);
    }
}

void bindBases(Binding& b) {
    const int hips = b.rig.jointOfBody[0];
    for (int joint = 0; joint < b.skeleton.jointCount(); ++joint) {
        const int parent = b.skeleton.parents[joint];
        b.setBase(joint, parent == kNoJoint ? hips : parent);
    }
    b.setBase(hips, kNoJoint);
    std::vector<int> detached;
    for (int body = 1; body < static_cast<int>(b.rig.jointOfBody.size()); ++body) {
        const int parentBody = b.rig.parentBody[body];
        const int joint = b.rig.jointOfBody[body];
        bool found = false;
        const std::vector<int> between = jointsBetween(b, joint, b.rig.jointOfBody[parentBody], found);
        if (found) {
            makeChain(b, between, parentBody, body);
        } else {
            b.setBase(joint, b.rig.jointOfBody[parentBody]);
            makeHalves(b, parentBody, body);
            detached.push_back(joint);
        }
        makeTwistHelpers(b, parentBody, body);
    }
    carryAncestors(b, hips);
    for (const int joint : detached)
        carryAncestors(b, joint);
    carryBeside(b);
}

// Rotation about `axis` (unit) that is left of q when the swing across it is taken away.
quat twistAbout(const quat& q, const vec3& axis) {
    const float along = glm::dot(vec3(q.x, q.y, q.z), axis);
    const float norm = std::sqrt(q.w * q.w + along * along);
    if (norm < 1e-6F) return {1, 0, 0, 0};
    return {q.w / norm, axis.x * along / norm, axis.y * along / norm, axis.z * along / norm};
}

quat partOf(const quat& q, float share) {
    const quat shorter = q.w < 0.0F ? -q : q;
    return glm::slerp(quat(1, 0, 0, 0), shorter, share);
}

}  // namespace

Result<Rig> bindRig(const RagdollProfile& profile, const Skeleton& skeleton) {
    const std::vector<std::string> problems = validate(profile);
    if (!problems.empty()) return Error{ErrorCode::input, problems.front(), profile.name, "mend the profile"};
    Binding b{skeleton, profile, {}, std::vector<int>(static_cast<std::size_t>(skeleton.jointCount()), -1)};
    b.rig.joints.resize(static_cast<std::size_t>(skeleton.jointCount()));
    if (Result<void> found = findJoints(b); !found) return found.error();
    bindBodies(b);
    bindBases(b);
    if (!orderByBase(b.rig)) {
        return Error{ErrorCode::input, "the joints of the profile's bodies hang below each other in a circle",
                     profile.name, "check which joint each body stands for"};
    }
    return std::move(b.rig);
}

void bodiesFromPose(const Rig& rig, std::span<const RigidTransform> modelFromJoint,
                    const RigidTransform& worldFromModel, std::span<BodyState> bodies) {
    LUTKA_ASSERT(modelFromJoint.size() == rig.joints.size());
    LUTKA_ASSERT(bodies.size() == rig.jointOfBody.size());
    for (std::size_t body = 0; body < bodies.size(); ++body) {
        const RigidTransform modelFromBody = modelFromJoint[rig.jointOfBody[body]] * inverse(rig.bodyFromJoint[body]);
        bodies[body] = {worldFromModel * modelFromBody, {0, 0, 0}, {0, 0, 0}};
        const int parent = rig.parentBody[body];
        if (parent < 0) continue;
        // The pose may bend what lies between two bodies or stretch a joint: rotations are the pose's, positions close
        // the constraints.
        RigidTransform& placed = bodies[body].worldFromBody;
        placed.translation =
            bodies[parent].worldFromBody * rig.anchors[body].inParent - placed.rotation * rig.anchors[body].inChild;
    }
}

void poseFromBodies(const Rig& rig, const Skeleton& skeleton, std::span<const RigidTransform> worldFromBody,
                    const RigidTransform& worldFromModel, std::span<RigidTransform> modelFromJoint,
                    std::span<const RigidTransform> followerParentFromJoint) {
    LUTKA_ASSERT(worldFromBody.size() == rig.jointOfBody.size());
    LUTKA_ASSERT(modelFromJoint.size() == rig.joints.size());
    LUTKA_ASSERT(followerParentFromJoint.empty() || followerParentFromJoint.size() == rig.joints.size());
    const RigidTransform modelFromWorld = inverse(worldFromModel);
    // How far a body has turned from the bind pose, in model axes.
    const auto turn = [&](int body) {
        return modelFromWorld.rotation * worldFromBody[body].rotation *
               glm::conjugate(rig.bindModelFromBody[body].rotation);
    };
    for (const int index : rig.order) {
        const Rig::Joint& joint = rig.joints[index];
        if (joint.base == kNoJoint) {
            modelFromJoint[index] = modelFromWorld * worldFromBody[joint.body] * rig.bodyFromJoint[joint.body];
            continue;
        }
        const bool givenPose = joint.drive == JointDrive::follower && !followerParentFromJoint.empty() &&
                               joint.base == skeleton.parents[index];
        RigidTransform& out = modelFromJoint[index];
        out = modelFromJoint[joint.base] * (givenPose ? followerParentFromJoint[index] : joint.baseFromJoint);
        if (joint.drive == JointDrive::mapped) {
            out.rotation =
                modelFromWorld.rotation * worldFromBody[joint.body].rotation * rig.bodyFromJoint[joint.body].rotation;
        } else if (joint.drive == JointDrive::chain) {
            const quat upper = turn(joint.upperBody);
            quat between = glm::conjugate(upper) * turn(joint.body);
            if (joint.twistAxis != vec3(0)) between = twistAbout(between, joint.twistAxis);
            out.rotation = upper * partOf(between, joint.share) * skeleton.bindModelFromJoint[index].rotation;
        }
        out.rotation = glm::normalize(out.rotation);
    }
}

}  // namespace lutka::physics
