#include "scene/puppet/puppet_tally.hpp"

#include <array>

#include "support/catch.hpp"
#include "support/ragdolls.hpp"

using namespace lutka;

TEST_CASE("joints' errors are added up by name over characters, and the farthest names its joint") {
    const auto one = test::bipedRagdoll();
    const auto other = test::bipedRagdoll();
    const std::array<const scene::RagdollAsset*, 2> assets{one.get(), other.get()};
    scene::TrackingTally tally(assets);
    std::vector<float> errors(one->profile.constraints.size(), 0.0F);
    errors[1] = radians(3.0F);
    tally.addJoints(0, errors);
    errors[1] = radians(4.0F);
    tally.addJoints(1, errors);
    const scene::PuppetFigures figures = tally.figures();
    REQUIRE(figures.joints.size() == errors.size());
    const std::string& name = one->profile.bodies[one->profile.constraints[1].child].name;
    CHECK(figures.joints[1].name == name);
    CHECK(figures.joints[1].rmsDeg == Approx(std::sqrt(12.5F)));
    CHECK(figures.joints[1].maxDeg == Approx(4.0F));
    CHECK(figures.joints[0].maxDeg == 0.0F);
    CHECK(figures.worstJoint == name);
    CHECK(figures.rmsDeg == Approx(std::sqrt(25.0F / (2.0F * static_cast<float>(errors.size())))));
}

TEST_CASE("a foot over the ground and one in it count in the mean as what they are above it") {
    scene::TrackingTally tally({});
    CHECK(tally.figures().footGapMeanM == 0.0F);
    tally.addFooting(0.02F);
    tally.addFooting(-0.01F);
    const scene::PuppetFigures figures = tally.figures();
    CHECK(figures.footGapM == 0.02F);
    CHECK(figures.footDepthM == 0.01F);
    CHECK(figures.footGapMeanM == Approx(0.01F));
}

TEST_CASE("means of getting up are over those that stood and those that began") {
    scene::GetUpTally tally;
    CHECK(tally.figures().meanSeconds == 0.0F);
    tally.begin(0.1F);
    tally.begin(0.3F);
    tally.stand(3.0F);
    tally.turn(5.0F, "head");
    tally.turn(4.0F, "leftFoot");
    tally.slide(0.02F);
    const scene::GetUpFigures figures = tally.figures();
    CHECK(figures.begun == 2);
    CHECK(figures.stood == 1);
    CHECK(figures.meanSeconds == 3.0F);
    CHECK(figures.meanDistanceM == Approx(0.2F));
    CHECK(figures.mostStepDeg == 5.0F);
    CHECK(figures.stepJoint == "head");
    CHECK(figures.mostSlideM == 0.02F);
}
