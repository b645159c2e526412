#include "animation/retarget/anatomical_rig.hpp"

#include <glm/geometric.hpp>

#include "support/catch.hpp"
#include "walking_biped.hpp"

using namespace lutka;
using namespace lutka::animation;

namespace {

quat axesInBind(const AnatomicalRig& rig, Role role) {
    return rig.standardBind[rig.jointOf(role)].rotation * rig.jointFromAnatomy[indexOf(role)];
}

float angleBetween(const quat& a, const quat& b) {
    return degrees(glm::length(rotationVector(glm::conjugate(a) * b)));
}

const quat kZUp = glm::angleAxis(kPi / 2, vec3(1, 0, 0));

}  // namespace

TEST_CASE("anatomical axes are the same by whatever axes, up direction and unit the file has its joints") {
    const test::TestHumanoid plain = test::makeHumanoid({});
    const auto expected = makeAnatomicalRig(plain.character, plain.map);
    REQUIRE(expected);
    test::HumanoidSpec spec;
    spec.axesSeed = 5;
    spec.modelFromStandard = kZUp * glm::angleAxis(0.8F, vec3(0, 1, 0));
    spec.scale = 0.01F;
    const test::TestHumanoid odd = test::makeHumanoid(spec);
    const auto got = makeAnatomicalRig(odd.character, odd.map);
    REQUIRE(got);
    for (int index = 0; index < kRoleCount; ++index) {
        const Role role = roleAt(index);
        if (!expected.value().has(role)) continue;
        INFO(roleName(role));
        CHECK(angleBetween(axesInBind(expected.value(), role), axesInBind(got.value(), role)) < 0.2F);
    }
    CHECK(got.value().legLength == Approx(0.01F * expected.value().legLength).epsilon(1e-3));
    CHECK(got.value().feet[0].ankleHeight == Approx(0.0009F).epsilon(0.02));
    CHECK(got.value().trunk.size() == expected.value().trunk.size());
}

TEST_CASE("x lies along each bone, and between T-pose and A-pose the arm's axes turn as the arm does") {
    const test::TestHumanoid tPose = test::makeHumanoid({});
    test::HumanoidSpec spec;
    spec.armDropDeg = 45.0F;
    const test::TestHumanoid aPose = test::makeHumanoid(spec);
    const auto t = makeAnatomicalRig(tPose.character, tPose.map);
    const auto a = makeAnatomicalRig(aPose.character, aPose.map);
    REQUIRE(t);
    REQUIRE(a);
    for (const Role role : {Role::leftUpperArm, Role::rightLowerArm, Role::leftUpperLeg, Role::rightLowerLeg}) {
        const vec3 bone = glm::normalize(a.value().bindOf(*endOfBone(role)) - a.value().bindOf(role));
        CHECK(glm::dot(axesInBind(a.value(), role) * vec3(1, 0, 0), bone) > 0.9999F);
    }
    const quat drop = glm::angleAxis(radians(-45.0F), vec3(0, 0, 1));
    for (const Role role : {Role::leftUpperArm, Role::leftLowerArm, Role::leftHand})
        CHECK(angleBetween(drop * axesInBind(t.value(), role), axesInBind(a.value(), role)) < 0.2F);
    CHECK(angleBetween(axesInBind(t.value(), Role::head), axesInBind(a.value(), Role::head)) < 0.1F);
}

TEST_CASE("what is no whole humanoid is refused with its file's name") {
    test::TestHumanoid humanoid = test::makeHumanoid({});
    humanoid.character.file = "some.glb";
    HumanoidMap refused;
    const auto none = makeAnatomicalRig(humanoid.character, refused);
    REQUIRE(!none);
    CHECK(none.error().code == ErrorCode::input);
    CHECK(none.error().location == "some.glb");
    HumanoidMap partial = humanoid.map;
    partial.missing.push_back(Role::leftFoot);
    CHECK(!makeAnatomicalRig(humanoid.character, partial));
}

TEST_CASE("fingers are found by name, at most three joints each") {
    test::HumanoidSpec spec;
    spec.fingers = true;
    const test::TestHumanoid humanoid = test::makeHumanoid(spec);
    const FingerChains chains = fingersOf(humanoid.character.skeleton, humanoid.map.jointOf(Role::leftHand));
    CHECK(chains[static_cast<std::size_t>(Finger::thumb)].size() == 3);
    CHECK(chains[static_cast<std::size_t>(Finger::index)].size() == 3);
    CHECK(chains[static_cast<std::size_t>(Finger::little)].empty());
}
