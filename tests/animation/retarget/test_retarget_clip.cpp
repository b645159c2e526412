#include "animation/retarget/retarget_clip.hpp"

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <limits>

#include "support/catch.hpp"
#include "walking_biped.hpp"

using namespace lutka;
using namespace lutka::animation;

namespace {

RetargetFigures walkOn(const test::HumanoidSpec& spec, bool keepFeet = true) {
    const test::TestHumanoid plain = test::makeHumanoid({});
    const test::TestHumanoid target = test::makeHumanoid(spec);
    const Clip walk = test::makeWalk(plain);
    auto retargeter = Retargeter::make(plain.character, plain.map, target.character, target.map);
    REQUIRE(retargeter);
    RetargetOptions options;
    options.keepFeet = keepFeet;
    const auto made = retargetClip(retargeter.value(), walk, options);
    REQUIRE(made);
    CHECK(made.value().clip.frameCount == walk.frameCount);
    CHECK(made.value().clip.parentFromJoint.size() ==
          target.character.skeleton.parents.size() * static_cast<std::size_t>(walk.frameCount));
    return made.value().figures;
}

}  // namespace

TEST_CASE("feet that stand stay where they are and out of the floor on figures of other proportions") {
    for (const float legs : {0.7F, 1.0F, 1.3F}) {
        for (const float width : {0.06F, 0.1F, 0.16F}) {
            test::HumanoidSpec spec;
            spec.legShare = legs;
            spec.hipWidth = width;
            spec.armDropDeg = 40.0F;
            spec.axesSeed = 3;
            const RetargetFigures figures = walkOn(spec);
            INFO(legs << " " << width);
            CHECK(figures.contacts >= 4);
            CHECK(figures.slideCm.most < 0.5);
            CHECK(figures.penetrationCm.most < 0.2);
            CHECK(figures.meanLimbDeg() < 3.0);
            for (const DirectionError& error : figures.directions) {
                const bool arm = error.part.find("Arm") != std::string::npos;
                if (arm || error.part == "face") CHECK(error.degrees.most < 0.3);
            }
        }
    }
}

TEST_CASE("hips that are wide over short legs turn less, so that legs point as the source's and feet stay") {
    test::HumanoidSpec narrow;
    narrow.hipWidth = 0.02F;
    const test::TestHumanoid source = test::makeHumanoid(narrow);
    test::HumanoidSpec stubby;
    stubby.hipWidth = 0.25F;
    stubby.legShare = 0.5F;
    const test::TestHumanoid target = test::makeHumanoid(stubby);
    // Hips that turn by 20 degrees to either side over legs that stay as they are.
    Clip clip;
    clip.name = "turn";
    clip.framesPerSecond = 30.0F;
    clip.frameCount = 91;
    for (int frame = 0; frame < clip.frameCount; ++frame) {
        std::vector<RigidTransform> pose = source.character.skeleton.nodeParentFromJoint;
        const float yaw = radians(20.0F) * std::sin(2.0F * kPi * static_cast<float>(frame) / 90.0F);
        const vec3 up(0, 1, 0);
        turnInStandard(source, Role::hips, glm::angleAxis(yaw, up), pose);
        for (const Role thigh : {Role::leftUpperLeg, Role::rightUpperLeg})
            turnInStandard(source, thigh, glm::angleAxis(-yaw, up), pose);
        clip.parentFromJoint.append(pose);
    }
    auto retargeter = Retargeter::make(source.character, source.map, target.character, target.map);
    REQUIRE(retargeter);
    const auto made = retargetClip(retargeter.value(), clip);
    REQUIRE(made);
    const RetargetFigures& figures = made.value().figures;
    INFO(figures.meanLimbDeg() << " degrees, " << figures.slideCm.most << " cm");
    CHECK(figures.contacts >= 2);
    CHECK(figures.meanLimbDeg() < 0.5);
    CHECK(figures.slideCm.most < 0.1);
    for (const DirectionError& error : figures.directions)
        if (error.part == "trunk" || error.part == "face") CHECK(error.degrees.most < 0.5);
}

TEST_CASE("a figure without toes stands on a ball that is thought up, its heel free to rise") {
    test::HumanoidSpec spec;
    spec.toes = false;
    const RetargetFigures figures = walkOn(spec);
    CHECK(figures.slideCm.most < 0.5);
    CHECK(figures.meanLimbDeg() < 1.5);
}

TEST_CASE("a spine whose joints do not hang on each other is leant as one that does") {
    const test::TestHumanoid plain = test::makeHumanoid({});
    test::TestHumanoid flat = test::makeHumanoid({});
    Skeleton& skeleton = flat.character.skeleton;
    for (const Role role : {Role::spine, Role::chest, Role::neck})
        skeleton.parents[flat.map.jointOf(role)] = kNoJoint;
    const Clip walk = test::makeWalk(plain);
    auto retargeter = Retargeter::make(plain.character, plain.map, flat.character, flat.map);
    REQUIRE(retargeter);
    const auto made = retargetClip(retargeter.value(), walk);
    REQUIRE(made);
    for (const DirectionError& error : made.value().figures.directions) {
        INFO(error.part);
        if (error.part == "trunk" || error.part == "neck" || error.part == "face") CHECK(error.degrees.most < 1.0);
    }
}

TEST_CASE("without keeping the feet they slide where the figures differ, which the figures tell") {
    test::HumanoidSpec spec;
    spec.trunkJoints = 2;
    spec.legShare = 1.3F;
    spec.hipWidth = 0.2F;
    const RetargetFigures loose = walkOn(spec, false);
    const RetargetFigures kept = walkOn(spec, true);
    CHECK(kept.slideCm.most <= loose.slideCm.most + 0.05);
    CHECK(loose.sourceSlideCm.most < 2.0);
}

TEST_CASE("a Z-up rig in hundredths of a metre walks too") {
    test::HumanoidSpec spec;
    spec.modelFromStandard = glm::angleAxis(kPi / 2, vec3(1, 0, 0));
    spec.scale = 0.01F;
    const RetargetFigures figures = walkOn(spec);
    CHECK(figures.scale == Approx(0.01F).epsilon(1e-3));
    CHECK(figures.meanLimbDeg() < 1.5);
    CHECK(figures.slideCm.most < 0.01);
}

TEST_CASE("clips of other skeletons and numbers that are none are refused") {
    const test::TestHumanoid plain = test::makeHumanoid({});
    auto retargeter = Retargeter::make(plain.character, plain.map, plain.character, plain.map);
    REQUIRE(retargeter);
    Clip walk = test::makeWalk(plain);
    walk.frameCount = 60;
    const auto shorter = retargetClip(retargeter.value(), walk);
    REQUIRE(!shorter);
    CHECK(shorter.error().code == ErrorCode::input);
    walk.frameCount = 61;
    walk.parentFromJoint.change()[5].translation.y = std::numeric_limits<float>::quiet_NaN();
    CHECK(!retargetClip(retargeter.value(), walk));
}
