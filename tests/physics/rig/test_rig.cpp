#include <glm/geometric.hpp>

#include "animation/pose.hpp"
#include "core/random.hpp"
#include "physics/rig/rig.hpp"
#include "support/catch.hpp"
#include "support/counting_new.hpp"
#include "support/dolls.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using animation::Role;
using animation::Skeleton;
using physics::bindRig;
using physics::BodyState;
using physics::JointDrive;
using physics::RagdollProfile;
using physics::Rig;

namespace {

constexpr float kHeight = 1.75F;

const RigidTransform kSomewhere{glm::normalize(quat(0.8F, 0.1F, 0.5F, -0.2F)), {3, -1, 2}};

std::vector<RigidTransform> transformsOf(const std::vector<BodyState>& bodies) {
    std::vector<RigidTransform> out;
    for (const BodyState& body : bodies)
        out.push_back(body.worldFromBody);
    return out;
}

quat anyRotation(Random& random) {
    const quat q(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    return glm::normalize(q);
}

float angleBetween(const quat& a, const quat& b) {
    return glm::length(rotationVector(glm::conjugate(a) * b));
}

// The pose that the bodies of `modelFromJoint` give back.
std::vector<RigidTransform> throughTheBodies(const Rig& rig, const Skeleton& skeleton,
                                             const std::vector<RigidTransform>& modelFromJoint) {
    std::vector<BodyState> bodies(rig.jointOfBody.size());
    bodiesFromPose(rig, modelFromJoint, kSomewhere, bodies);
    std::vector<RigidTransform> pose(modelFromJoint.size());
    poseFromBodies(rig, skeleton, transformsOf(bodies), kSomewhere, pose);
    return pose;
}

void requireBindPose(const Skeleton& skeleton, const std::vector<RigidTransform>& pose) {
    for (int joint = 0; joint < skeleton.jointCount(); ++joint) {
        INFO(skeleton.names[joint]);
        const RigidTransform& bind = skeleton.bindModelFromJoint[joint];
        CHECK(glm::distance(pose[joint].translation, bind.translation) < 1e-5F * kHeight);
        CHECK(angleBetween(pose[joint].rotation, bind.rotation) < 1e-3F);
    }
}

// makeBiped()'s joints with other parents for some, by name.
Skeleton bipedWith(const std::vector<std::pair<std::string, std::string>>& newParents,
                   const std::vector<test::JointSpec>& before = {}) {
    const Skeleton biped = test::makeBiped().skeleton;
    std::vector<test::JointSpec> joints = before;
    const int shift = static_cast<int>(before.size());
    for (int i = 0; i < biped.jointCount(); ++i) {
        int parent = biped.parents[i] < 0 ? shift - 1 : biped.parents[i] + shift;
        for (const auto& [name, newParent] : newParents) {
            if (biped.names[i] != name) continue;
            parent = -1;
            for (std::size_t k = 0; k < joints.size(); ++k) {
                if (joints[k].name == newParent) parent = static_cast<int>(k);
            }
        }
        joints.push_back({biped.names[i], parent, biped.bindModelFromJoint[i].translation});
    }
    return test::makeSkeleton(joints);
}

RagdollProfile dollWithoutPaths() {
    RagdollProfile doll = test::makeDoll();
    for (physics::BodyProfile& body : doll.bodies)
        body.jointPath = body.joint;
    return doll;
}

Rig boundTo(const Skeleton& skeleton, const RagdollProfile& profile) {
    const auto rig = bindRig(profile, skeleton);
    REQUIRE(rig.ok());
    return rig.value();
}

int jointNamed(const Skeleton& skeleton, std::string_view name) {
    return animation::findJoint(skeleton, name);
}

// The pose of a skeleton along x with bodies at two of its joints, of which the second is bent by 0.7 about z and
// twisted by 1 about x.
std::vector<RigidTransform> bentAndTwisted(const Skeleton& skeleton, const std::string& first,
                                           const std::string& second) {
    RagdollProfile profile = test::makePair(physics::ConeTwistLimits{1, 1, 1});
    profile.bodies[0].joint = profile.bodies[0].jointPath = first;
    profile.bodies[1].joint = profile.bodies[1].jointPath = second;
    setRole(profile.bodies[1], Role::leftHand);
    const Rig rig = boundTo(skeleton, profile);
    std::vector<BodyState> bodies(2);
    bodiesFromPose(rig, skeleton.bindModelFromJoint, {}, bodies);
    std::vector<RigidTransform> worldFromBody = transformsOf(bodies);
    const quat bend = glm::angleAxis(0.7F, vec3(0, 0, 1));
    const quat twist = glm::angleAxis(1.0F, vec3(1, 0, 0));
    worldFromBody[1].rotation = bend * twist * worldFromBody[1].rotation;
    std::vector<RigidTransform> pose(static_cast<std::size_t>(skeleton.jointCount()));
    poseFromBodies(rig, skeleton, worldFromBody, {}, pose);
    return pose;
}

}  // namespace

TEST_CASE("the bind pose comes back through the bodies", "[rig]") {
    const Skeleton skeleton = test::makeBiped().skeleton;
    const Rig rig = boundTo(skeleton, test::makeDoll());
    requireBindPose(skeleton, throughTheBodies(rig, skeleton, skeleton.bindModelFromJoint));
}

TEST_CASE("the bind pose comes back when feet and arms hang on controls elsewhere in the file", "[rig]") {
    const Skeleton skeleton = bipedWith({{"leftFoot", "control"}, {"rightFoot", "root"}, {"leftUpperArm", "control"}},
                                        {{"root", -1, {0, 0, 0}}, {"control", 0, {0.1F, 0, 0.2F}}});
    const Rig rig = boundTo(skeleton, dollWithoutPaths());
    requireBindPose(skeleton, throughTheBodies(rig, skeleton, skeleton.bindModelFromJoint));
}

TEST_CASE("a foot below an IK root keeps its place at the lower leg's end", "[rig]") {
    const Skeleton skeleton = bipedWith({{"leftFoot", "root"}}, {{"root", -1, {0, 0, 0}}});
    const Rig rig = boundTo(skeleton, dollWithoutPaths());
    const int foot = jointNamed(skeleton, "leftFoot");
    CHECK(rig.joints[foot].base == jointNamed(skeleton, "leftLowerLeg"));

    std::vector<BodyState> bodies(rig.jointOfBody.size());
    bodiesFromPose(rig, skeleton.bindModelFromJoint, {}, bodies);
    std::vector<RigidTransform> worldFromBody = transformsOf(bodies);
    const int hips = 0;
    // The whole figure lifted: the foot comes along though its file parent has no body.
    for (RigidTransform& body : worldFromBody)
        body.translation.y += 2.0F;
    std::vector<RigidTransform> pose(rig.joints.size());
    poseFromBodies(rig, skeleton, worldFromBody, {}, pose);
    CHECK(pose[foot].translation.y == Approx(2.09F));
    CHECK(pose[rig.jointOfBody[hips]].translation.y == Approx(2.95F));
}

TEST_CASE("mapped joints take exactly the rotations of their bodies", "[rig]") {
    const Skeleton skeleton = test::makeBiped().skeleton;
    const Rig rig = boundTo(skeleton, test::makeDoll());
    Random random(7);
    std::vector<RigidTransform> worldFromBody(rig.jointOfBody.size());
    for (RigidTransform& body : worldFromBody)
        body = {anyRotation(random), {random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2)}};
    std::vector<RigidTransform> pose(rig.joints.size());
    poseFromBodies(rig, skeleton, worldFromBody, kSomewhere, pose);
    for (std::size_t body = 0; body < worldFromBody.size(); ++body) {
        const RigidTransform wanted = worldFromBody[body] * rig.bodyFromJoint[body];
        const RigidTransform got = kSomewhere * pose[rig.jointOfBody[body]];
        CHECK(angleBetween(got.rotation, wanted.rotation) < 1e-3F);
    }
    const RigidTransform root = kSomewhere * pose[rig.jointOfBody[0]];
    CHECK(glm::distance(root.translation, (worldFromBody[0] * rig.bodyFromJoint[0]).translation) < 1e-5F);
}

TEST_CASE("stretched constraints don't show in the pose", "[rig]") {
    const Skeleton skeleton = test::makeBiped().skeleton;
    const Rig rig = boundTo(skeleton, test::makeDoll());
    std::vector<BodyState> bodies(rig.jointOfBody.size());
    bodiesFromPose(rig, skeleton.bindModelFromJoint, {}, bodies);
    std::vector<RigidTransform> worldFromBody = transformsOf(bodies);
    for (std::size_t body = 1; body < worldFromBody.size(); ++body)
        worldFromBody[body].translation += vec3(0.1F, 0.2F, 0.3F);
    std::vector<RigidTransform> pose(rig.joints.size());
    poseFromBodies(rig, skeleton, worldFromBody, {}, pose);
    requireBindPose(skeleton, pose);
}

TEST_CASE("a spine joint between two bodies takes half of the bend", "[rig]") {
    const Skeleton skeleton = test::makeSkeleton(
        {{"hips", -1, {0, 1, 0}}, {"middle", 0, {0, 1.2F, 0}}, {"chest", 1, {0, 1.4F, 0}}, {"tip", 2, {0, 1.6F, 0}}});
    RagdollProfile profile = test::makePair(physics::ConeTwistLimits{1, 1, 1});
    setRole(profile.bodies[1], Role::chest);
    profile.bodies[1].joint = profile.bodies[1].jointPath = "chest";
    const Rig rig = boundTo(skeleton, profile);
    REQUIRE(rig.joints[1].drive == JointDrive::chain);
    CHECK(rig.joints[1].share == Approx(0.5F));
    CHECK(rig.joints[3].drive == JointDrive::follower);

    std::vector<BodyState> bodies(2);
    bodiesFromPose(rig, skeleton.bindModelFromJoint, {}, bodies);
    std::vector<RigidTransform> worldFromBody = transformsOf(bodies);
    const quat bend = glm::angleAxis(radians(80.0F), vec3(1, 0, 0));
    worldFromBody[1].rotation = bend * worldFromBody[1].rotation;
    std::vector<RigidTransform> pose(4);
    poseFromBodies(rig, skeleton, worldFromBody, {}, pose);
    CHECK(angleBetween(pose[1].rotation, glm::angleAxis(radians(40.0F), vec3(1, 0, 0))) < 1e-3F);
    const vec3 chest = vec3(0, 1.2F, 0) + 0.2F * vec3(0, std::cos(radians(40.0F)), std::sin(radians(40.0F)));
    CHECK(glm::distance(pose[2].translation, chest) < 1e-5F);
    CHECK(glm::distance(pose[3].translation, chest + 0.2F * (bend * vec3(0, 1, 0))) < 1e-5F);
}

TEST_CASE("twist joints of a limb share the twist and not the bend", "[rig]") {
    for (const bool inTheChain : {true, false}) {
        INFO((inTheChain ? "between the two joints" : "beside the way"));
        const Skeleton skeleton = test::makeSkeleton(
            {{"arm", -1, {0, 0, 0}}, {"twist", 0, {0.15F, 0, 0}}, {"hand", inTheChain ? 1 : 0, {0.3F, 0, 0}}});
        const std::vector<RigidTransform> pose = bentAndTwisted(skeleton, "arm", "hand");
        CHECK(angleBetween(pose[1].rotation, glm::angleAxis(0.5F, vec3(1, 0, 0))) < 1e-3F);
        CHECK(glm::distance(pose[2].translation, vec3(0.3F, 0, 0)) < 1e-5F);
    }
}

TEST_CASE("the lower half of a segment that hangs beside the upper one goes with it", "[rig]") {
    const Skeleton skeleton = test::makeSkeleton({{"shoulder", -1, {-0.1F, 0, 0}},
                                                  {"arm_twist", 0, {0, 0, 0}},
                                                  {"arm_stretch", 0, {0.15F, 0, 0}},
                                                  {"forearm", 2, {0.3F, 0, 0}}});
    const std::vector<RigidTransform> pose = bentAndTwisted(skeleton, "arm_twist", "forearm");
    CHECK(glm::distance(pose[2].translation, vec3(0.15F, 0, 0)) < 1e-5F);
    CHECK(angleBetween(pose[2].rotation, glm::angleAxis(0.5F, vec3(1, 0, 0))) < 1e-3F);
    CHECK(glm::distance(pose[3].translation, vec3(0.3F, 0, 0)) < 1e-5F);
}

TEST_CASE("roots above the hips move with them", "[rig]") {
    const Skeleton skeleton = bipedWith({}, {{"armature", -1, {0, 0, 0}}, {"root", 0, {0, 0.1F, 0}}});
    const Rig rig = boundTo(skeleton, dollWithoutPaths());
    std::vector<BodyState> bodies(rig.jointOfBody.size());
    bodiesFromPose(rig, skeleton.bindModelFromJoint, {}, bodies);
    std::vector<RigidTransform> worldFromBody = transformsOf(bodies);
    for (RigidTransform& body : worldFromBody)
        body.translation.x += 5.0F;
    std::vector<RigidTransform> pose(rig.joints.size());
    poseFromBodies(rig, skeleton, worldFromBody, {}, pose);
    CHECK(glm::distance(pose[0].translation, vec3(5, 0, 0)) < 1e-5F);
    CHECK(glm::distance(pose[1].translation, vec3(5, 0.1F, 0)) < 1e-5F);
}

TEST_CASE("what has a skeleton of its own beside the figure goes along with the body that it is at", "[rig]") {
    const Skeleton skeleton = bipedWith({}, {{"armature", -1, {0, 0, 0}},
                                             {"hatRoot", 0, {0, 1.75F, 0}},
                                             {"hat", 1, {0, 1.8F, 0}},
                                             {"root", 0, {0, 0.1F, 0}}});
    const RagdollProfile doll = dollWithoutPaths();
    const Rig rig = boundTo(skeleton, doll);
    std::vector<BodyState> bodies(rig.jointOfBody.size());
    bodiesFromPose(rig, skeleton.bindModelFromJoint, {}, bodies);
    std::vector<RigidTransform> worldFromBody = transformsOf(bodies);
    const int head = physics::bodyOf(doll, Role::head);
    const quat nod = glm::angleAxis(0.5F, vec3(1, 0, 0));
    worldFromBody[head].rotation = nod * worldFromBody[head].rotation;
    std::vector<RigidTransform> pose(rig.joints.size());
    poseFromBodies(rig, skeleton, worldFromBody, {}, pose);
    const int joint = rig.jointOfBody[head];
    const vec3 offset = vec3(0, 1.8F, 0) - skeleton.bindModelFromJoint[joint].translation;
    CHECK(glm::distance(pose[2].translation, pose[joint].translation + nod * offset) < 1e-4F);
    CHECK(angleBetween(pose[2].rotation, nod) < 1e-3F);
    CHECK(angleBetween(pose[3].rotation, quat(1, 0, 0, 0)) < 1e-3F);
}

TEST_CASE("followers keep the local pose that is given", "[rig]") {
    const Skeleton skeleton =
        test::makeSkeleton({{"hips", -1, {0, 0, 0}}, {"spine", 0, {0, 0.2F, 0}}, {"finger", 1, {0, 0.4F, 0}}});
    RagdollProfile profile = test::makePair(physics::ConeTwistLimits{1, 1, 1});
    const Rig rig = boundTo(skeleton, profile);
    std::vector<BodyState> bodies(2);
    bodiesFromPose(rig, skeleton.bindModelFromJoint, {}, bodies);
    std::vector<RigidTransform> local = skeleton.nodeParentFromJoint;
    local[2].rotation = glm::angleAxis(0.4F, vec3(0, 0, 1));
    std::vector<RigidTransform> pose(3);
    poseFromBodies(rig, skeleton, transformsOf(bodies), {}, pose, local);
    CHECK(angleBetween(pose[2].rotation, local[2].rotation) < 1e-3F);
}

TEST_CASE("bodies of a bent pose have closed constraints", "[rig]") {
    const Skeleton skeleton = test::makeBiped().skeleton;
    const RagdollProfile doll = test::makeDoll();
    const Rig rig = boundTo(skeleton, doll);
    Random random(3);
    std::vector<RigidTransform> local = skeleton.nodeParentFromJoint;
    for (RigidTransform& joint : local)
        joint.rotation = glm::slerp(quat(1, 0, 0, 0), anyRotation(random), 0.2F);
    std::vector<RigidTransform> pose(local.size());
    localToModel(skeleton, local, pose);
    std::vector<BodyState> bodies(rig.jointOfBody.size());
    bodiesFromPose(rig, pose, kSomewhere, bodies);
    for (const physics::ConstraintProfile& c : doll.constraints) {
        const vec3 onParent = bodies[c.parent].worldFromBody * c.parentFromFrame.translation;
        const vec3 onChild = bodies[c.child].worldFromBody * c.childFromFrame.translation;
        CHECK(glm::distance(onParent, onChild) < 1e-5F);
        const quat wanted = kSomewhere.rotation * pose[rig.jointOfBody[c.child]].rotation;
        CHECK(angleBetween((bodies[c.child].worldFromBody * rig.bodyFromJoint[c.child]).rotation, wanted) < 1e-3F);
    }
}

TEST_CASE("binding names every joint that the skeleton lacks", "[rig]") {
    RagdollProfile doll = test::makeDoll();
    doll.bodies[3].joint = doll.bodies[3].jointPath = "kopf";
    doll.bodies[5].joint = doll.bodies[5].jointPath = "unterarm";
    const auto rig = bindRig(doll, test::makeBiped().skeleton);
    REQUIRE_FALSE(rig.ok());
    CHECK(rig.error().code == ErrorCode::input);
    CHECK_THAT(rig.error().message, Catch::Contains("kopf") && Catch::Contains("unterarm"));
}

TEST_CASE("the way through the bodies allocates nothing", "[rig]") {
    const Skeleton skeleton = test::makeBiped().skeleton;
    const Rig rig = boundTo(skeleton, test::makeDoll());
    std::vector<BodyState> bodies(rig.jointOfBody.size());
    std::vector<RigidTransform> pose(rig.joints.size());
    const std::vector<RigidTransform> worldFromBody(rig.jointOfBody.size());
    const std::size_t before = test::allocationCount();
    bodiesFromPose(rig, skeleton.bindModelFromJoint, kSomewhere, bodies);
    poseFromBodies(rig, skeleton, worldFromBody, kSomewhere, pose);
    CHECK(test::allocationCount() == before);
    const auto counted = std::make_unique<int>(1);
    CHECK(test::allocationCount() == before + 1);
}
