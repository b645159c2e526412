#include "physics/fit/rebind.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "animation/pose.hpp"
#include "physics/fit/fit_ragdoll.hpp"
#include "support/catch.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using namespace lutka::physics;

namespace {

// The biped under other names, half as tall again, turned about Y and with scrambled local axes: another rig.
animation::Character otherRig() {
    animation::Character rig = test::makeBiped();
    rig.name = "other";
    const quat turn = glm::angleAxis(radians(90), vec3(0, 1, 0));
    for (int joint = 0; joint < rig.skeleton.jointCount(); ++joint) {
        rig.skeleton.names[joint] = "joint_" + std::to_string(joint);
        RigidTransform& frame = rig.skeleton.bindModelFromJoint[joint];
        frame.translation = turn * (1.5F * frame.translation);
        frame.rotation = glm::normalize(quat(1, 0.3F * static_cast<float>(joint), -0.7F, 0.2F));
    }
    animation::modelToLocal(rig.skeleton, rig.skeleton.bindModelFromJoint, rig.skeleton.nodeParentFromJoint);
    for (animation::SkinnedMesh& mesh : rig.meshes) {
        for (vec3& position : mesh.positions)
            position = turn * (1.5F * position);
    }
    return rig;
}

animation::HumanoidMap mapOfOther() {
    const animation::Character biped = test::makeBiped();
    animation::HumanoidMap map = test::mapOfBiped(biped);
    map.standardFromModel = glm::angleAxis(radians(-90), vec3(0, 1, 0));
    return map;
}

RagdollProfile bipedToRebind() {
    const animation::Character biped = test::makeBiped();
    FitOptions options;
    options.massPreset = MassPreset::balanced;
    RagdollProfile profile = fitRagdoll(biped, test::mapOfBiped(biped), options).value();
    // What a user would have edited.
    profile.constraints[bodyOf(profile, Role::leftLowerLeg) - 1].hinge.upper = radians(40);
    profile.constraints[bodyOf(profile, Role::head) - 1].frictionNm = 7.5F;
    profile.filteredPairs = {{1, 9}};
    return profile;
}

}  // namespace

TEST_CASE("a profile re-bound to another rig fits it and keeps what was edited") {
    const animation::Character rig = otherRig();
    const auto bound = rebindProfile(bipedToRebind(), rig, mapOfOther());
    REQUIRE(bound);
    const RagdollProfile& profile = bound.value();
    const RagdollProfile original = bipedToRebind();
    const RagdollProfile fresh = fitRagdoll(rig, mapOfOther()).value();
    CHECK(validate(profile).empty());
    CHECK(profile.name == "other");
    CHECK(profile.heightM == fresh.heightM);
    CHECK(profile.filteredPairs == original.filteredPairs);
    for (std::size_t i = 0; i < profile.bodies.size(); ++i) {
        INFO(profile.bodies[i].name);
        CHECK(profile.bodies[i].jointPath == fresh.bodies[i].jointPath);
        CHECK(profile.bodies[i].massKg == original.bodies[i].massKg);
        CHECK(profile.bodies[i].shape.radius == Approx(fresh.bodies[i].shape.radius));
        CHECK(profile.bodies[i].shape.radius == Approx(1.5F * original.bodies[i].shape.radius).epsilon(0.02));
    }
    const int knee = bodyOf(profile, Role::leftLowerLeg) - 1;
    CHECK(profile.constraints[knee].hinge.upper == radians(40));
    CHECK(profile.constraints[bodyOf(profile, Role::head) - 1].frictionNm == 7.5F);
    for (std::size_t i = 0; i < profile.constraints.size(); ++i) {
        const quat difference = glm::conjugate(profile.constraints[i].childFromFrame.rotation) *
                                fresh.constraints[i].childFromFrame.rotation;
        CHECK(glm::length(rotationVector(difference)) < 1e-2F);
    }
}

TEST_CASE("re-binding to its own character changes nothing") {
    const animation::Character biped = test::makeBiped();
    const RagdollProfile before = bipedToRebind();
    for (const bool keepShapes : {false, true}) {
        const RagdollProfile after = rebindProfile(before, biped, test::mapOfBiped(biped), keepShapes).value();
        for (std::size_t i = 0; i < before.bodies.size(); ++i) {
            INFO(before.bodies[i].name);
            CHECK(after.bodies[i].shape.radius == Approx(before.bodies[i].shape.radius));
            CHECK(glm::distance(after.bodies[i].jointFromBody.translation, before.bodies[i].jointFromBody.translation) <
                  1e-4F);
            CHECK(std::abs(glm::dot(after.bodies[i].jointFromBody.rotation, before.bodies[i].jointFromBody.rotation)) >
                  0.99999F);
        }
        for (std::size_t i = 0; i < before.constraints.size(); ++i) {
            CHECK(glm::distance(after.constraints[i].parentFromFrame.translation,
                                before.constraints[i].parentFromFrame.translation) < 1e-4F);
        }
    }
}

TEST_CASE("kept shapes keep their size and their place in the limb on another rig") {
    const animation::Character rig = otherRig();
    const RagdollProfile original = bipedToRebind();
    const RagdollProfile bound = rebindProfile(original, rig, mapOfOther(), true).value();
    for (std::size_t i = 0; i < bound.bodies.size(); ++i) {
        CHECK(bound.bodies[i].shape.radius == original.bodies[i].shape.radius);
        CHECK(bound.bodies[i].inertia == original.bodies[i].inertia);
    }
    for (std::size_t i = 0; i < bound.constraints.size(); ++i) {
        CHECK(glm::distance(bound.constraints[i].childFromFrame.translation,
                            original.constraints[i].childFromFrame.translation) < 1e-4F);
    }
}

TEST_CASE("re-binding names every role that the rig lacks") {
    const animation::Character rig = otherRig();
    animation::HumanoidMap map = mapOfOther();
    map.roles[animation::indexOf(Role::leftHand)].reset();
    map.roles[animation::indexOf(Role::head)].reset();
    const auto bound = rebindProfile(bipedToRebind(), rig, map);
    REQUIRE_FALSE(bound);
    CHECK(bound.error().code == ErrorCode::input);
    CHECK(bound.error().message.find("head, leftHand") != std::string::npos);
}

TEST_CASE("a trunk of fewer joints takes the profile's trunk bodies together, their masses with them") {
    const animation::Character biped = test::makeBiped();
    const animation::HumanoidMap whole = test::mapOfBiped(biped);
    const auto profile = fitRagdoll(biped, whole);
    REQUIRE(profile);
    animation::HumanoidMap shorter = whole;
    shorter.roles[animation::indexOf(Role::chest)].reset();
    const auto bound = rebindProfile(profile.value(), biped, shorter);
    REQUIRE(bound);
    CHECK(bound.value().bodies.size() == profile.value().bodies.size() - 1);
    CHECK(bodyOf(bound.value(), Role::chest) == -1);
    CHECK(bodyOf(bound.value(), Role::spine) > 0);
    float mass = 0;
    for (const BodyProfile& body : bound.value().bodies)
        mass += body.massKg;
    CHECK(mass == Approx(profile.value().totalMassKg));
    CHECK(validate(bound.value()).empty());
}

TEST_CASE("the topmost trunk body goes to the topmost trunk role of the other rig") {
    const animation::Character biped = test::makeBiped();
    animation::HumanoidMap tall = test::mapOfBiped(biped);
    auto& roles = tall.roles;
    std::swap(roles[animation::indexOf(Role::chest)], roles[animation::indexOf(Role::upperChest)]);
    const auto profile = fitRagdoll(biped, tall);
    REQUIRE(profile);
    REQUIRE(bodyOf(profile.value(), Role::upperChest) > 0);
    const auto bound = rebindProfile(profile.value(), biped, test::mapOfBiped(biped));
    REQUIRE(bound);
    CHECK(bodyOf(bound.value(), Role::chest) > 0);
    CHECK(bound.value().bodies.size() == profile.value().bodies.size());
    CHECK(validate(bound.value()).empty());
}
