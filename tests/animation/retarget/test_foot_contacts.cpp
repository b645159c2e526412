#include "animation/retarget/foot_contacts.hpp"

#include "support/catch.hpp"
#include "walking_biped.hpp"

using namespace lutka;
using namespace lutka::animation;

namespace {

/// A foot that stands for a second, swings for half of one and stands again, its floor at a height.
FootTrack stepAndStand(float floor) {
    FootTrack track;
    for (int frame = 0; frame < 75; ++frame) {
        const float swing = std::clamp((static_cast<float>(frame) - 30.0F) / 15.0F, 0.0F, 1.0F);
        const vec3 at(0.1F, floor + 0.2F * std::sin(kPi * swing), swing);
        track.ankle.push_back(at + vec3(0, 0.09F, 0));
        track.ball.push_back(at + vec3(0, 0.03F, 0.14F));
    }
    return track;
}

}  // namespace

TEST_CASE("a foot stands where it is slow and low, on whatever height the floor is") {
    const test::TestHumanoid humanoid = test::makeHumanoid({});
    const auto rig = makeAnatomicalRig(humanoid.character, humanoid.map);
    REQUIRE(rig);
    for (const float floor : {0.0F, 0.7F, -0.3F}) {
        const std::array<FootTrack, 2> tracks{stepAndStand(floor), stepAndStand(floor)};
        CHECK(floorOfMotion(rig.value(), tracks) == Approx(floor).margin(1e-4));
        const FootContact contact = contactsOf(rig.value().feet[0], tracks[0], floor, rig.value().legLength, 30.0F);
        const std::vector<FrameRun> runs = runsOf(contact.ball);
        REQUIRE(runs.size() == 2);
        CHECK(runs[0].first == 0);
        CHECK(std::abs(runs[0].last - 30) <= 2);
        CHECK(std::abs(runs[1].first - 45) <= 2);
        CHECK(runs[1].last == 74);
        CHECK(runsOf(contact.heel).size() == 2);
        const FootContact high = contactsOf(rig.value().feet[0], tracks[0], floor - 0.5F, rig.value().legLength, 30.0F);
        CHECK(runsOf(high.ball).empty());
    }
}

TEST_CASE("a flicker is no contact, and one in a contact does not part it") {
    const test::TestHumanoid humanoid = test::makeHumanoid({});
    const auto rig = makeAnatomicalRig(humanoid.character, humanoid.map);
    REQUIRE(rig);
    FootTrack track;
    for (int frame = 0; frame < 120; ++frame) {
        const bool up = frame < 40 ? frame == 20 : frame != 80;
        track.ankle.emplace_back(0.0F, up ? 0.5F : 0.09F, 0.0F);
        track.ball.emplace_back(0.0F, up ? 0.5F : 0.03F, 0.0F);
    }
    const FootContact contact = contactsOf(rig.value().feet[0], track, 0.0F, rig.value().legLength, 120.0F);
    const std::vector<FrameRun> runs = runsOf(contact.ball);
    REQUIRE(runs.size() == 1);
    CHECK(runs[0].first == 0);
    CHECK(runs[0].last >= 37);
    CHECK(runs[0].last < 42);
}

TEST_CASE("a clip of one frame stands, and one of none has no floor") {
    const test::TestHumanoid humanoid = test::makeHumanoid({});
    const auto rig = makeAnatomicalRig(humanoid.character, humanoid.map);
    REQUIRE(rig);
    FootTrack track;
    track.ankle.emplace_back(0.0F, 0.09F, 0.0F);
    track.ball.emplace_back(0.0F, 0.03F, 0.0F);
    CHECK(contactsOf(rig.value().feet[0], track, 0.0F, 0.9F, 30.0F).ball[0]);
    const std::array<FootTrack, 2> none;
    CHECK(floorOfMotion(rig.value(), none) == 0.0F);
}
