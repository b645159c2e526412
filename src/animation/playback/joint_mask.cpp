#include "animation/playback/joint_mask.hpp"

#include "core/assert.hpp"

namespace lutka::animation {
namespace {

bool isLegOrHips(Role role) {
    constexpr std::array kLeft{Role::leftUpperLeg, Role::leftLowerLeg, Role::leftFoot, Role::leftToes};
    if (role == Role::hips) return true;
    for (const Role left : kLeft) {
        if (isEitherSide(role, left)) return true;
    }
    return false;
}

}  // namespace

JointMask maskBelow(const Skeleton& skeleton, std::span<const int> joints) {
    JointMask mask;
    mask.weights.assign(skeleton.parents.size(), 0.0F);
    for (const int joint : joints) {
        LUTKA_ASSERT(joint >= 0 && joint < skeleton.jointCount());
        mask.weights[joint] = 1.0F;
    }
    for (int joint = 0; joint < skeleton.jointCount(); ++joint) {
        const int parent = skeleton.parents[joint];
        if (parent != kNoJoint && mask.weights[parent] > 0.0F) mask.weights[joint] = 1.0F;
    }
    return mask;
}

JointMask maskOfRoles(const Skeleton& skeleton, const HumanoidMap& map,
                      const std::array<float, kRoleCount>& weightOfRole) {
    std::vector<int> roleOf(skeleton.parents.size(), -1);
    for (int role = kRoleCount - 1; role >= 0; --role) {
        const int joint = map.jointOf(roleAt(role));
        if (joint != kNoJoint) roleOf[joint] = role;
    }
    JointMask mask;
    mask.weights.assign(skeleton.parents.size(), 0.0F);
    for (int joint = 0; joint < skeleton.jointCount(); ++joint) {
        const int parent = skeleton.parents[joint];
        if (roleOf[joint] >= 0)
            mask.weights[joint] = weightOfRole[roleOf[joint]];
        else if (parent != kNoJoint)
            mask.weights[joint] = mask.weights[parent];
    }
    return mask;
}

JointMask upperBodyMask(const Skeleton& skeleton, const HumanoidMap& map) {
    std::array<float, kRoleCount> weights{};
    for (int role = 0; role < kRoleCount; ++role)
        weights[role] = isLegOrHips(roleAt(role)) ? 0.0F : 1.0F;
    return maskOfRoles(skeleton, map, weights);
}

JointMask inverted(const JointMask& mask, int joints) {
    JointMask out;
    out.weights.resize(static_cast<std::size_t>(joints));
    for (std::size_t joint = 0; joint < out.weights.size(); ++joint)
        out.weights[joint] = 1.0F - mask[joint];
    return out;
}

}  // namespace lutka::animation
