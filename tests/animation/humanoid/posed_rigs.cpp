#include "posed_rigs.hpp"

#include <algorithm>
#include <glm/gtc/quaternion.hpp>
#include <string>

#include "animation/humanoid/map_humanoid.hpp"
#include "support/catch.hpp"

namespace lutka::test {

using animation::HumanoidMap;
using animation::Role;

int jointOf(const SyntheticRig& rig, Role role) {
    const auto& names = rig.character.skeleton.names;
    return static_cast<int>(std::find(names.begin(), names.end(), rig.truth.roles[indexOf(role)]->front()) -
                            names.begin());
}

bool isBelow(const animation::Skeleton& skeleton, int top, int joint) {
    while (joint != animation::kNoJoint && joint != top)
        joint = skeleton.parents[joint];
    return joint == top;
}

void turn(SyntheticRig& rig, Role role, float angle, const vec3& axis) {
    animation::Skeleton& skeleton = rig.character.skeleton;
    const int top = jointOf(rig, role);
    const vec3 pivot = skeleton.bindModelFromJoint[top].translation;
    const quat rotation = glm::angleAxis(angle, axis);
    for (int joint = 0; joint < skeleton.jointCount(); ++joint) {
        if (!isBelow(skeleton, top, joint)) continue;
        vec3& place = skeleton.bindModelFromJoint[joint].translation;
        place = pivot + rotation * (place - pivot);
    }
}

void turnBoth(SyntheticRig& rig, Role left, float angle) {
    turn(rig, left, angle, vec3(1, 0, 0));
    turn(rig, animation::mirrored(left), angle, vec3(1, 0, 0));
}

void cutOff(SyntheticRig& rig, Role role) {
    animation::Skeleton& skeleton = rig.character.skeleton;
    const int top = jointOf(rig, role);
    animation::Skeleton left;
    std::vector<int> fresh;
    for (int joint = 0; joint < skeleton.jointCount(); ++joint) {
        const bool gone = isBelow(skeleton, top, joint);
        fresh.push_back(gone ? animation::kNoJoint : static_cast<int>(left.names.size()));
        if (gone) continue;
        left.names.push_back(skeleton.names[joint]);
        left.parents.push_back(skeleton.parents[joint] < 0 ? animation::kNoJoint : fresh[skeleton.parents[joint]]);
        left.bindModelFromJoint.push_back(skeleton.bindModelFromJoint[joint]);
        left.nodeParentFromJoint.push_back(skeleton.nodeParentFromJoint[joint]);
        left.skinWeight.push_back(skeleton.skinWeight[joint]);
    }
    skeleton = left;
}

void checkWhole(const SyntheticRig& rig) {
    const HumanoidMap map = animation::mapHumanoid(rig.character);
    const Score score = scoreMap(rig.truth, map, rig.character.skeleton.names);
    INFO(score.faults);
    INFO((map.warnings.empty() ? std::string() : map.warnings.front()));
    CHECK(map.humanoid);
    CHECK(score.right == score.of);
}

void checkWhatIsLeft(const SyntheticRig& rig) {
    const HumanoidMap map = animation::mapHumanoid(rig.character);
    INFO((map.warnings.empty() ? std::string() : map.warnings.front()));
    REQUIRE(map.humanoid);
    const animation::Skeleton& skeleton = rig.character.skeleton;
    for (int index = 0; index < animation::kRoleCount; ++index) {
        const Role role = animation::roleAt(index);
        if (animation::sideOf(role) == animation::Side::center || !rig.truth.roles[index]) continue;
        const std::vector<std::string>& right = *rig.truth.roles[index];
        const int joint = map.jointOf(role);
        const std::string got = joint == animation::kNoJoint ? "" : skeleton.names[joint];
        const bool there = std::any_of(right.begin(), right.end(), [&](const std::string& name) {
            return std::find(skeleton.names.begin(), skeleton.names.end(), name) != skeleton.names.end();
        });
        INFO(animation::roleName(role) << " at \"" << got << "\"");
        if (there && animation::isRequired(role)) CHECK(std::find(right.begin(), right.end(), got) != right.end());
        if (!there) CHECK(got.empty());
    }
    CHECK_FALSE(map.missing.empty());
}

}  // namespace lutka::test
