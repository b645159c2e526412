#pragma once

#include <cstdint>
#include <span>

#include "animation/character.hpp"
#include "animation/humanoid/map_humanoid.hpp"

namespace lutka::test {

/// How a humanoid's file may lie: the same figure by other conventions and of other proportions.
struct HumanoidSpec {
    float armDropDeg = 0.0F;    ///< Of the bind pose below a T-pose; 45 is an A-pose.
    float elbowBendDeg = 0.0F;  ///< Forward, in the bind pose.
    quat modelFromStandard{1, 0, 0, 0};
    float scale = 1.0F;
    std::uint64_t axesSeed = 0;  ///< 0: joint frames along the model's axes; else any.
    bool twistJoints = false;    ///< One in the middle of each forearm.
    bool fingers = false;
    bool shoulders = true;
    bool toes = true;
    int trunkJoints = 3;    ///< Above the hips, two of them mapped at most as spine and chest.
    float legShare = 1.0F;  ///< Length of the legs against the usual.
    float armShare = 1.0F;
    float hipWidth = 0.1F;  ///< Of a hip joint from the middle, metres before the scale.
};

struct TestHumanoid {
    animation::Character character;
    animation::HumanoidMap map;
    HumanoidSpec spec;
};

[[nodiscard]] TestHumanoid makeHumanoid(const HumanoidSpec& spec);

/// Four steps of a walk, 61 frames at 30 a second, 0.4 m each for a figure of the usual size: feet that stand are still
/// to the bit of a solver, arms swing and the trunk turns.
[[nodiscard]] animation::Clip makeWalk(const TestHumanoid& humanoid);

/// The pose of all joints in one frame of a clip.
[[nodiscard]] std::span<const RigidTransform> frameOf(const animation::Clip& clip, int frame);

/// Turns a joint of a parent-relative pose in standard space.
void turnInStandard(const TestHumanoid& humanoid, animation::Role role, const quat& turn,
                    std::span<RigidTransform> parentFromJoint);

/// Where a role's bone points in a pose, standard space, unit.
[[nodiscard]] vec3 boneDirection(const TestHumanoid& humanoid, std::span<const RigidTransform> parentFromJoint,
                                 animation::Role from, animation::Role to);

}  // namespace lutka::test
