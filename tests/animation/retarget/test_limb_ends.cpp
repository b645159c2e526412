#include "animation/retarget/limb_ends.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "animation/retarget/retarget_clip.hpp"
#include "support/catch.hpp"
#include "support/counting_new.hpp"
#include "walking_biped.hpp"

using namespace lutka;
using namespace lutka::animation;

namespace {

void takeAway(HumanoidMap& map, std::initializer_list<Role> left) {
    for (const Role of : left) {
        for (const Role role : {of, mirrored(of)}) {
            map.roles[indexOf(role)].reset();
            if (isRequired(role)) map.missing.push_back(role);
        }
    }
}

float degreesBetween(const vec3& a, const vec3& b) {
    return degrees(std::acos(std::clamp(glm::dot(glm::normalize(a), glm::normalize(b)), -1.0F, 1.0F)));
}

float lowestFoot(const AnatomicalRig& rig, std::span<const RigidTransform> pose) {
    return std::min(pose[rig.feet[0].joint].translation.y, pose[rig.feet[1].joint].translation.y);
}

}  // namespace

TEST_CASE("a whole humanoid keeps its own skeleton") {
    const test::TestHumanoid whole = test::makeHumanoid({});
    const LimbEnds ends = addLimbEnds(whole.character, whole.map);
    CHECK(ends.skeleton.get() == &whole.character.skeleton);
    CHECK(ends.stiff.empty());
    CHECK(ends.missing.empty());
}

TEST_CASE("hands and feet are added where the skin ends, and the limbs point as the source's") {
    const test::TestHumanoid source = test::makeHumanoid({});
    test::TestHumanoid target = test::makeHumanoid({.armDropDeg = 40.0F, .axesSeed = 3});
    const Character& character = target.character;
    const int wrist = target.map.jointOf(Role::leftHand);
    const int elbow = target.map.jointOf(Role::leftLowerArm);
    takeAway(target.map, {Role::leftHand, Role::leftFoot, Role::leftToes});
    // Skin of a forearm with a hand: 1.2 times as far as the wrist's joint.
    SkinnedMesh arm;
    const vec3 from = character.skeleton.bindModelFromJoint[elbow].translation;
    const vec3 to = character.skeleton.bindModelFromJoint[wrist].translation;
    for (const float share : {0.0F, 0.4F, 0.8F, 1.2F}) {
        arm.positions.push_back(from + share * (to - from));
        arm.joints.push_back({static_cast<std::uint16_t>(elbow), 0, 0, 0});
        arm.weights.push_back({1, 0, 0, 0});
    }
    target.character.meshes.push_back(arm);
    const LimbEnds ends = addLimbEnds(character, target.map);
    CHECK(ends.missing.empty());
    CHECK(ends.stiff.empty());
    CHECK(validate(*ends.skeleton).empty());
    CHECK(ends.skeleton->jointCount() == character.skeleton.jointCount() + 4);
    const vec3 hand = ends.skeleton->bindModelFromJoint[ends.joint[indexOf(Role::leftHand)]].translation;
    CHECK(degreesBetween(hand - from, to - from) < 0.1F);
    CHECK(glm::distance(hand, from) == Approx(1.2F * 0.575F * glm::distance(to, from)).epsilon(0.01));

    auto retargeter = Retargeter::make(source.character, source.map, character, target.map);
    REQUIRE(retargeter);
    const auto made = retargetClip(retargeter.value(), test::makeWalk(source));
    REQUIRE(made);
    const std::size_t joints = character.skeleton.parents.size();
    CHECK(made.value().clip.parentFromJoint.size() == joints * static_cast<std::size_t>(made.value().clip.frameCount));
    CHECK(made.value().figures.meanLimbDeg() < 3.0);
    CHECK(made.value().figures.slideCm.most < 0.5);
    CHECK(made.value().figures.penetrationCm.most < 0.5);
}

TEST_CASE("a limb of one joint points to where the source's ends, and legs stand as high over the floor") {
    const test::TestHumanoid source = test::makeHumanoid({});
    test::TestHumanoid target = test::makeHumanoid({.axesSeed = 5, .toes = false, .legShare = 0.6F});
    const std::vector<RigidTransform> bind = target.character.skeleton.bindModelFromJoint;
    const bool hasHands = GENERATE(false, true);
    INFO("with hands " << hasHands);
    takeAway(target.map, {Role::leftLowerArm, Role::leftLowerLeg, Role::leftFoot});
    if (!hasHands) takeAway(target.map, {Role::leftHand});
    auto made = Retargeter::make(source.character, source.map, target.character, target.map);
    REQUIRE(made);
    Retargeter& retargeter = made.value();
    const AnatomicalRig& rig = retargeter.target();
    CHECK(rig.stiffLimbs.size() == 4);
    CHECK(rig.hasStiffLegs());
    const Clip walk = test::makeWalk(source);
    std::vector<RigidTransform> pose(target.character.skeleton.parents.size());
    float highest = -1.0F;
    for (int frame = 0; frame < walk.frameCount; ++frame) {
        INFO("frame " << frame);
        retargeter.pose(test::frameOf(walk, frame), {}, pose);
        const auto theirs = retargeter.sourcePose();
        const auto ours = retargeter.targetPose();
        for (const StiffLimb& limb : rig.stiffLimbs) {
            const auto role = std::find(rig.joint.begin(), rig.joint.end(), limb.upper) - rig.joint.begin();
            const auto end = std::find(rig.joint.begin(), rig.joint.end(), limb.end) - rig.joint.begin();
            const AnatomicalRig& from = retargeter.source();
            const vec3 wanted = theirs[from.joint[static_cast<std::size_t>(end)]].translation -
                                theirs[from.joint[static_cast<std::size_t>(role)]].translation;
            // Legs and arms are cut at other places than the source's, which bends the added middle a little.
            CHECK(degreesBetween(ours[limb.end].translation - ours[limb.upper].translation, wanted) < 4.0F);
            const float length =
                glm::distance(rig.standardBind[limb.end].translation, rig.standardBind[limb.upper].translation);
            CHECK(glm::distance(ours[limb.end].translation, ours[limb.upper].translation) == Approx(length));
        }
        highest = std::max(highest, lowestFoot(rig, ours) - rig.floor - rig.ankleHeight());
        CHECK(lowestFoot(rig, ours) > rig.floor - 0.01F);
    }
    // One foot of a walk is always down.
    CHECK(highest < 0.05F);
    const auto clip = retargetClip(retargeter, walk);
    REQUIRE(clip);
    CHECK(clip.value().figures.penetrationCm.most < 0.5);

    const std::size_t before = test::allocationCount();
    retargeter.pose(test::frameOf(walk, 3), {}, pose);
    CHECK(test::allocationCount() == before);
}

TEST_CASE("a source of few joints plays on a whole figure") {
    const test::TestHumanoid target = test::makeHumanoid({});
    test::TestHumanoid source = test::makeHumanoid({});
    const Clip walk = test::makeWalk(source);
    takeAway(source.map, {Role::leftHand, Role::leftFoot, Role::leftToes});
    auto retargeter = Retargeter::make(source.character, source.map, target.character, target.map);
    REQUIRE(retargeter);
    const auto made = retargetClip(retargeter.value(), walk);
    REQUIRE(made);
    CHECK(made.value().figures.meanLimbDeg() < 3.0);
    CHECK(made.value().clip.frameCount == walk.frameCount);
}

TEST_CASE("what can't be added is told by its role") {
    test::TestHumanoid humanoid = test::makeHumanoid({});
    const auto refusal = [&] {
        const auto rig = makeAnatomicalRig(humanoid.character, humanoid.map);
        REQUIRE_FALSE(rig);
        return rig.error().message;
    };
    SECTION("a head without shoulders") {
        takeAway(humanoid.map, {Role::leftUpperArm, Role::leftLowerArm, Role::leftHand});
        humanoid.map.roles[indexOf(Role::head)].reset();
        humanoid.map.missing = {Role::head};
        CHECK_THAT(refusal(), Catch::Contains("head"));
    }
    SECTION("one whole leg") {
        for (const Role role : {Role::leftUpperLeg, Role::leftLowerLeg, Role::leftFoot}) {
            humanoid.map.roles[indexOf(role)].reset();
            humanoid.map.missing.push_back(role);
        }
        CHECK_THAT(refusal(), Catch::Contains("leftUpperLeg"));
    }
    SECTION("legs without arms") {
        takeAway(humanoid.map, {Role::leftUpperLeg, Role::leftLowerLeg, Role::leftFoot, Role::leftUpperArm,
                                Role::leftLowerArm, Role::leftHand});
        CHECK_THAT(refusal(), Catch::Contains("UpperLeg"));
    }
}

TEST_CASE("a figure without a head walks, and its clips play on a whole one") {
    const test::TestHumanoid whole = test::makeHumanoid({});
    for (const bool neck : {true, false}) {
        INFO((neck ? "with a neck" : "without a neck"));
        test::TestHumanoid lacking = test::makeHumanoid({.axesSeed = 2});
        lacking.map.roles[indexOf(Role::head)].reset();
        if (!neck) lacking.map.roles[indexOf(Role::neck)].reset();
        lacking.map.missing = {Role::head};
        for (const bool source : {true, false}) {
            const test::TestHumanoid& from = source ? lacking : whole;
            const test::TestHumanoid& to = source ? whole : lacking;
            auto retargeter = Retargeter::make(from.character, from.map, to.character, to.map);
            REQUIRE(retargeter);
            const auto made = retargetClip(retargeter.value(), test::makeWalk(from));
            REQUIRE(made);
            CHECK(made.value().figures.meanLimbDeg() < 3.0);
            CHECK(made.value().figures.penetrationCm.most < 0.5);
        }
    }
}

TEST_CASE("a figure without an arm walks, and its clips play on a whole one") {
    const test::TestHumanoid whole = test::makeHumanoid({});
    test::TestHumanoid lacking = test::makeHumanoid({.axesSeed = 2});
    const Clip walkOfWhole = test::makeWalk(whole);
    const Clip walkOfLacking = test::makeWalk(lacking);  // which asks for all limbs
    for (const Role role : {Role::leftUpperArm, Role::leftLowerArm, Role::leftHand}) {
        lacking.map.roles[indexOf(role)].reset();
        lacking.map.missing.push_back(role);
    }
    const auto figures = [](const test::TestHumanoid& source, const Clip& walk, const test::TestHumanoid& target) {
        auto retargeter = Retargeter::make(source.character, source.map, target.character, target.map);
        REQUIRE(retargeter);
        const auto made = retargetClip(retargeter.value(), walk);
        REQUIRE(made);
        return made.value().figures;
    };
    for (const RetargetFigures& made : {figures(whole, walkOfWhole, lacking), figures(lacking, walkOfLacking, whole)}) {
        CHECK(made.meanLimbDeg() < 3.0);
        CHECK(std::none_of(made.directions.begin(), made.directions.end(),
                           [](const auto& part) { return part.part == "leftUpperArm"; }));
    }
}

TEST_CASE("a ghost without legs goes along as if it had them, and whole figures stand to its clips") {
    const test::TestHumanoid whole = test::makeHumanoid({});
    test::TestHumanoid ghost = test::makeHumanoid(
        {.modelFromStandard = glm::angleAxis(kPi * 0.5F, vec3(1, 0, 0)), .scale = 0.5F, .axesSeed = 3});
    const Clip walkOfWhole = test::makeWalk(whole);
    const Clip walkOfGhost = test::makeWalk(ghost);  // which asks for all limbs
    takeAway(ghost.map, {Role::leftUpperLeg, Role::leftLowerLeg, Role::leftFoot, Role::leftToes});
    const auto rig = makeAnatomicalRig(ghost.character, ghost.map);
    REQUIRE(rig);
    CHECK_FALSE(rig.value().hasLegs());
    // A human's leg for this trunk, nearly the one that was taken away.
    CHECK(rig.value().legLength > 0.5F * 0.5F);
    CHECK(rig.value().legLength < 0.5F * 1.1F);
    CHECK(rig.value().bindOf(Role::leftFoot).x > 0.02F);

    const auto retargeted = [](const test::TestHumanoid& from, const Clip& walk, const test::TestHumanoid& to,
                               auto look) {
        auto retargeter = Retargeter::make(from.character, from.map, to.character, to.map);
        REQUIRE(retargeter);
        const auto made = retargetClip(retargeter.value(), walk);
        REQUIRE(made);
        CHECK(made.value().figures.meanLimbDeg() < 1.0);
        CHECK(made.value().figures.contacts == 0);
        for (const auto& part : made.value().figures.directions)
            CHECK(part.part.find("Leg") == std::string::npos);
        look(retargeter.value());
    };
    // Its hips are as high over where its soles would be as the whole figure's are over its own.
    retargeted(whole, walkOfWhole, ghost, [](const Retargeter& made) {
        const auto heightOfHips = [](const AnatomicalRig& of, std::span<const RigidTransform> pose) {
            const vec3 middle = 0.5F * (pose[of.jointOf(Role::leftUpperLeg)].translation +
                                        pose[of.jointOf(Role::rightUpperLeg)].translation);
            return (middle.y - of.floor - of.ankleHeight()) / of.legLength;
        };
        CHECK(heightOfHips(made.target(), made.targetPose()) ==
              Approx(heightOfHips(made.source(), made.sourcePose())).margin(0.02));
    });
    // Legs that nothing moves hang straight, with the feet at the floor.
    retargeted(ghost, walkOfGhost, whole, [](const Retargeter& made) {
        const AnatomicalRig& to = made.target();
        const auto at = [&](Role role) { return made.targetPose()[to.jointOf(role)].translation; };
        const vec3 thigh = at(Role::leftLowerLeg) - at(Role::leftUpperLeg);
        CHECK(degreesBetween(thigh, at(Role::leftFoot) - at(Role::leftLowerLeg)) < 2.0F);
        CHECK(lowestFoot(to, made.targetPose()) == Approx(to.floor + to.ankleHeight()).margin(0.1F * to.legLength));
    });
}
