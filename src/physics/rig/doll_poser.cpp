#include "physics/rig/doll_poser.hpp"

#include <algorithm>

#include "animation/wide/kernels.hpp"
#include "core/assert.hpp"

namespace lutka::physics {
namespace {

using animation::wide::FollowJoint;
namespace wide = animation::wide;

static_assert(sizeof(quat) == 4 * sizeof(float) && sizeof(RigidTransform) == wide::kRigidFloats * sizeof(float));

void put(const quat& q, float* to) {
    to[0] = q.x;
    to[1] = q.y;
    to[2] = q.z;
    to[3] = q.w;
}

void put(const RigidTransform& t, float* to) {
    put(t.rotation, to);
    for (int axis = 0; axis < 3; ++axis)
        to[4 + axis] = t.translation[axis];
}

FollowJoint::Drive driveOf(const Rig::Joint& joint) {
    if (joint.base == animation::kNoJoint) return FollowJoint::root;
    if (joint.drive == JointDrive::mapped) return FollowJoint::mapped;
    return joint.drive == JointDrive::chain ? FollowJoint::chain : FollowJoint::follower;
}

FollowJoint followJoint(const Rig& rig, const animation::Skeleton& skeleton, int index) {
    const Rig::Joint& joint = rig.joints[index];
    FollowJoint out{};
    out.drive = driveOf(joint);
    out.joint = index;
    out.base = joint.base;
    out.body = joint.body;
    out.upperBody = joint.upperBody;
    out.share = joint.share;
    out.twistOnly = joint.twistAxis != vec3(0) ? 1 : 0;
    for (int axis = 0; axis < 3; ++axis)
        out.twistAxis[axis] = joint.twistAxis[axis];
    put(out.drive == FollowJoint::root ? rig.bodyFromJoint[joint.body] : joint.baseFromJoint, out.baseFromJoint);
    if (out.drive == FollowJoint::mapped) put(rig.bodyFromJoint[joint.body].rotation, out.bodyFromJointTurn);
    put(skeleton.bindModelFromJoint[index], out.bindModelFromJoint);
    return out;
}

}  // namespace

DollPoser::DollPoser(const Rig& rig, const animation::Skeleton& skeleton, const TaskPool& pool)
    : pool_(pool),
      kernels_(&wide::kernelsOf(bestInstructionSet())),
      scratch_(pool, (rig.joints.size() + 2 * rig.jointOfBody.size()) * wide::kRigidFloats * wide::kMostLanes) {
    for (const int joint : rig.order)
        joints_.push_back(followJoint(rig, skeleton, joint));
    for (const RigidTransform& bind : rig.bindModelFromBody)
        bindBodyTurns_.push_back(glm::conjugate(bind.rotation));
}

void DollPoser::useInstructionSet(InstructionSet set) {
    kernels_ = &wide::kernelsOf(set);
}

void DollPoser::run(const Source& source, std::span<const int> dolls, std::span<animation::SkinMatrix> palettes,
                    std::span<RigidTransform> modelFromJoint) {
    const std::size_t count = source.worldFromModel.size();
    LUTKA_ASSERT(source.firstBody.size() == (source.firstBody.empty() ? 0 : count));
    LUTKA_ASSERT(source.firstJoint.size() == (source.firstJoint.empty() ? 0 : count));
    LUTKA_ASSERT(!source.firstBody.empty() || source.present.size() >= count * bindBodyTurns_.size());
    LUTKA_ASSERT(source.alpha >= 1.0F || source.previous.size() >= source.present.size());
    LUTKA_ASSERT(palettes.empty() || !source.firstJoint.empty() || palettes.size() == count * joints_.size());
    LUTKA_ASSERT(modelFromJoint.empty() || palettes.empty() || modelFromJoint.size() == palettes.size());
    if (count == 0 || dolls.empty()) return;
    wide::FollowJob job{};
    job.joints = joints_.data();
    job.jointCount = static_cast<int>(joints_.size());
    job.bindBodyTurns = &bindBodyTurns_[0].x;
    job.bodyCount = static_cast<int>(bindBodyTurns_.size());
    job.previous = source.previous.empty() ? nullptr : &source.previous[0].rotation.x;
    job.present = &source.present[0].rotation.x;
    job.alpha = source.alpha;
    job.worldFromModel = &source.worldFromModel[0].rotation.x;
    job.firstBody = source.firstBody.empty() ? nullptr : source.firstBody.data();
    job.firstJoint = source.firstJoint.empty() ? nullptr : source.firstJoint.data();
    job.palettes = palettes.empty() ? nullptr : &palettes[0].rows[0].x;
    job.poses = modelFromJoint.empty() ? nullptr : &modelFromJoint[0].rotation.x;
    wide::forGroups(pool_, scratch_, dolls, kernels_->lanes, [&](const int* members, float* scratch) {
        wide::FollowJob group = job;
        group.dolls = members;
        group.scratch = scratch;
        kernels_->follow(group);
    });
}

}  // namespace lutka::physics
