#include "physics/powered/reachable_pose.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "core/random.hpp"
#include "physics/collision/shape.hpp"
#include "physics/powered/pose_drive.hpp"
#include "physics/profile/constraint_state.hpp"
#include "physics/worlds/world_table.hpp"
#include "support/catch.hpp"
#include "support/counting_new.hpp"
#include "support/dolls.hpp"

using namespace lutka;
using namespace lutka::test;
using physics::RagdollProfile;
using physics::ReachablePose;
using physics::Role;

namespace {

std::vector<RigidTransform> standingPose(const RagdollProfile& profile) {
    std::vector<RigidTransform> pose;
    for (const physics::BodyState& body : standingDoll(profile, vec3(0)))
        pose.push_back(body.worldFromBody);
    return pose;
}

void closeJointsOf(const RagdollProfile& profile, std::vector<RigidTransform>& pose) {
    for (const physics::ConstraintProfile& joint : profile.constraints)
        pose[joint.child].translation = pose[joint.parent] * joint.parentFromFrame.translation -
                                        pose[joint.child].rotation * joint.childFromFrame.translation;
}

// The most that a joint is beyond its limits, degrees, and its bodies are apart, metres.
physics::ConstraintState worstOf(const RagdollProfile& profile, const std::vector<RigidTransform>& pose) {
    physics::ConstraintState worst;
    for (const physics::ConstraintProfile& joint : profile.constraints) {
        const auto state = physics::measureConstraint(joint, pose[joint.parent], pose[joint.child]);
        worst.violation = std::max(worst.violation, state.violation);
        worst.separationM = std::max(worst.separationM, state.separationM);
    }
    return worst;
}

float mostTurned(const RagdollProfile& profile, const std::vector<RigidTransform>& a,
                 const std::vector<RigidTransform>& b) {
    std::vector<float> errors(profile.constraints.size());
    physics::jointErrors(profile, a, b, errors);
    return degrees(*std::max_element(errors.begin(), errors.end()));
}

quat anyTurn(Random& random, float most) {
    const vec3 axis(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    return glm::angleAxis(random.uniform(0, most), glm::normalize(axis + vec3(0, 1e-3F, 0)));
}

}  // namespace

TEST_CASE("a pose that the doll can take stays as it is") {
    const RagdollProfile profile = makeDoll();
    ReachablePose reachable(profile);
    const auto before = standingPose(profile);
    auto pose = before;
    reachable.apply(pose);
    CHECK(mostTurned(profile, before, pose) < 0.1F);
    CHECK(glm::distance(pose.back().translation, before.back().translation) < 1e-3F);
}

TEST_CASE("any pose comes within the limits with closed joints, its root stays, and nothing is allocated") {
    const RagdollProfile profile = makeDoll();
    ReachablePose reachable(profile);
    Random random(7);
    for (int trial = 0; trial < 300; ++trial) {
        auto pose = standingPose(profile);
        for (RigidTransform& body : pose)
            body.rotation = anyTurn(random, kPi) * body.rotation;
        closeJointsOf(profile, pose);
        const RigidTransform root = pose[0];
        const std::size_t news = allocationCount();
        reachable.apply(pose);
        CHECK(allocationCount() == news);
        const auto worst = worstOf(profile, pose);
        CHECK(degrees(worst.violation) < 0.1F);
        CHECK(worst.separationM < 1e-4F);
        CHECK(pose[0].translation == root.translation);
        CHECK(pose[0].rotation == root.rotation);
    }
}

TEST_CASE("a leg whose shin is turned out of its knee's plane keeps its foot where it is and as it is turned") {
    const RagdollProfile profile = makeDoll();
    ReachablePose reachable(profile);
    auto pose = standingPose(profile);
    const int thigh = physics::bodyOf(profile, Role::leftUpperLeg);
    const int shin = physics::bodyOf(profile, Role::leftLowerLeg);
    const int foot = physics::bodyOf(profile, Role::leftFoot);
    pose[thigh].rotation = glm::angleAxis(radians(-25.0F), vec3(1, 0, 0)) * pose[thigh].rotation;
    pose[shin].rotation = glm::angleAxis(radians(15.0F), vec3(0, 0, 1)) *
                          glm::angleAxis(radians(25.0F), vec3(1, 0, 0)) * pose[shin].rotation;
    closeJointsOf(profile, pose);
    const auto before = pose;
    reachable.apply(pose);
    CHECK(degrees(worstOf(profile, pose).violation) < 0.1F);
    CHECK(mostTurned(profile, before, pose) > 5.0F);
    CHECK(glm::distance(pose[foot].translation, before[foot].translation) < 2e-3F);
    CHECK(std::abs(glm::dot(pose[foot].rotation, before[foot].rotation)) > 0.9999F);
}

TEST_CASE("an arm in the trunk is turned out of it, and one that is kept stays there") {
    const RagdollProfile profile = makeDoll();
    const int forearm = physics::bodyOf(profile, Role::leftLowerArm);
    const int upperArm = physics::bodyOf(profile, Role::leftUpperArm);
    const auto deepest = [&](const std::vector<RigidTransform>& pose) {
        float depth = 0.0F;
        for (const Role role : {Role::hips, Role::spine, Role::chest}) {
            const int trunk = physics::bodyOf(profile, role);
            if (trunk < 0) continue;
            depth = std::max(depth, -physics::distanceBetween(profile.bodies[forearm].shape, pose[forearm],
                                                              profile.bodies[trunk].shape, pose[trunk]));
        }
        return depth;
    };
    auto inside = standingPose(profile);
    // Down along the trunk and into it, from arms to the side.
    const quat down = glm::angleAxis(radians(-105.0F), vec3(0, 0, 1));
    for (const Role role : {Role::leftUpperArm, Role::leftLowerArm, Role::leftHand}) {
        const int body = physics::bodyOf(profile, role);
        inside[body].rotation = down * inside[body].rotation;
    }
    closeJointsOf(profile, inside);
    REQUIRE(deepest(inside) > 0.03F);
    auto pose = inside;
    ReachablePose(profile).apply(pose);
    CHECK(deepest(pose) < 2e-3F);
    CHECK(degrees(worstOf(profile, pose).violation) < 0.1F);

    // An arm that has no hand is a limb as well.
    RagdollProfile handless = profile;
    handless.bodies[physics::bodyOf(profile, Role::leftHand)].role.reset();
    pose = inside;
    ReachablePose(handless).apply(pose);
    CHECK(deepest(pose) < 2e-3F);

    std::vector<bool> keeps(profile.bodies.size(), false);
    keeps[upperArm] = keeps[forearm] = keeps[physics::bodyOf(profile, Role::leftHand)] = true;
    auto kept = inside;
    ReachablePose(profile, keeps).apply(kept);
    CHECK(kept[forearm].rotation == inside[forearm].rotation);
}

TEST_CASE("a leg whose foot is folded into the trunk opens its knee") {
    RagdollProfile profile = makeDoll();
    const int hips = physics::bodyOf(profile, Role::hips);
    const int thigh = physics::bodyOf(profile, Role::leftUpperLeg);
    const int shin = physics::bodyOf(profile, Role::leftLowerLeg);
    const int foot = physics::bodyOf(profile, Role::leftFoot);
    const auto depth = [&](const std::vector<RigidTransform>& pose) {
        return -physics::distanceBetween(profile.bodies[foot].shape, pose[foot], profile.bodies[hips].shape,
                                         pose[hips]);
    };
    const physics::ConstraintProfile& knee = profile.constraints[shin - 1];
    // With its knee at a limit.
    const auto bent = [&](float angle) {
        auto pose = standingPose(profile);
        const auto now = physics::measureConstraint(knee, pose[thigh], pose[shin]);
        const vec3 axis = pose[thigh].rotation * (knee.parentFromFrame.rotation * vec3(0, 0, 1));
        for (const int body : {shin, foot})
            pose[body].rotation = glm::angleAxis(angle - now.hingeAngle, axis) * pose[body].rotation;
        closeJointsOf(profile, pose);
        return pose;
    };
    auto folded = bent(knee.hinge.lower);
    if (depth(bent(knee.hinge.upper)) > depth(folded)) folded = bent(knee.hinge.upper);
    profile.bodies[hips].shape.radius += 0.03F - depth(folded);
    auto pose = folded;
    ReachablePose(profile).apply(pose);
    INFO(depth(folded) << " m deep, " << depth(pose) << " after");
    CHECK(depth(folded) > 0.02F);
    CHECK(depth(pose) < 2e-3F);
    CHECK(degrees(worstOf(profile, pose).violation) < 0.1F);
}
