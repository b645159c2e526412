#include "animation/playback/clip_player.hpp"

#include <glm/geometric.hpp>

#include "core/random.hpp"
#include "made_clips.hpp"
#include "support/catch.hpp"
#include "support/counting_new.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using namespace lutka::animation;

namespace {

/// Three waving clips of a second, the first of which goes two metres ahead, and one that turns a joint.
struct Stage {
    Character biped = test::makeBiped();
    Skeleton& skeleton = biped.skeleton;
    HumanoidMap map = test::mapOfBiped(biped);
    std::size_t joints = skeleton.parents.size();
    int elbow = map.jointOf(Role::leftLowerArm);
    ClipLibrary library = make();

    [[nodiscard]] ClipLibrary make() const {
        std::vector<Clip> clips{test::makeWavingClip(skeleton, "walk", 1, vec3(0, 0, 2)),
                                test::makeWavingClip(skeleton, "run", 2), test::makeWavingClip(skeleton, "wave", 3),
                                test::makeTurnedClip(skeleton, "bend", elbow, 0.5F)};
        RootMotionSettings root;
        root.joint = map.jointOf(Role::hips);
        return ClipLibrary::create(skeleton, clips, root).value();
    }
    std::vector<RigidTransform> poseOf(ClipPlayer& player) const {
        std::vector<RigidTransform> pose(joints);
        player.pose(pose);
        return pose;
    }
    std::vector<RigidTransform> sample(int clip, float seconds) const {
        std::vector<RigidTransform> pose(joints);
        library.sample(clip, seconds, pose);
        return pose;
    }
};

}  // namespace

TEST_CASE("a player loops, stops at an end, and runs at any speed, backwards too") {
    const Stage stage;
    ClipPlayer player(stage.library);
    CHECK(test::differenceOf(stage.poseOf(player), stage.library.restPose()) == 0.0F);
    player.play(0, 1, {.speed = 2.0F});
    player.advance(0.6F);
    CHECK(player.seconds(0) == Approx(0.2F).margin(1e-5));
    CHECK(test::differenceOf(stage.poseOf(player), stage.sample(1, 0.2F)) < 1e-4F);
    CHECK(!player.hasEnded(0));
    player.play(0, 1, {.loop = false});
    player.advance(5.0F);
    CHECK(player.hasEnded(0));
    CHECK(test::differenceOf(stage.poseOf(player), stage.sample(1, 1.0F)) < 1e-5F);
    player.setSpeed(0, -1.0F);
    player.advance(0.25F);
    CHECK(!player.hasEnded(0));
    CHECK(player.seconds(0) == Approx(0.75F));
    player.play(0, 1, {.speed = -1.0F});
    player.advance(0.3F);
    CHECK(player.seconds(0) == Approx(0.7F));
    player.advance(1.9F);
    CHECK(player.seconds(0) == Approx(0.8F));
    player.setSpeed(0, 0.0F);
    player.advance(1.0F);
    CHECK(player.seconds(0) == Approx(0.8F));
    player.seek(0, 0.1F);
    CHECK(player.seconds(0) == Approx(0.1F));
}

TEST_CASE("a fade begins at the old pose, ends at the new one and never jumps, however often it is interrupted") {
    const Stage stage;
    ClipPlayer player(stage.library);
    Random random(17);
    player.play(0, 0);
    const float dt = 1.0F / 240.0F;
    std::vector<RigidTransform> last = stage.poseOf(player);
    float worst = 0.0F;
    for (int step = 0; step < 2000; ++step) {
        // Ten starts a second, many more than a layer's plays can hold in their fades.
        if (step % 24 == 0) {
            const int clip = static_cast<int>(random.next() % 4);
            const auto before = stage.poseOf(player);
            if (random.next() % 6 == 0)
                player.stop(0, random.uniform(0.3F, 1.0F));
            else
                player.play(0, clip, {.fadeSeconds = random.uniform(0.3F, 1.0F), .start = random.uniform(0.0F, 1.0F)});
            CHECK(test::differenceOf(stage.poseOf(player), before) < 1e-6F);
        }
        player.advance(dt);
        const std::vector<RigidTransform> now = stage.poseOf(player);
        // The walk's own seam throws the hips back by two metres, which is its file's.
        float jump = 0.0F;
        for (std::size_t joint = 1; joint < now.size(); ++joint)
            jump = std::max(jump, test::differenceOf(std::span(&now[joint], 1), std::span(&last[joint], 1)));
        worst = std::max(worst, jump);
        last = now;
    }
    CHECK(worst < 0.05F);
    player.play(0, 2, {.fadeSeconds = 0.5F});
    player.advance(0.5F);
    CHECK(test::differenceOf(stage.poseOf(player), stage.sample(2, 0.5F)) < 1e-4F);
}

TEST_CASE("a masked layer moves its own joints and leaves the others to the bit") {
    const Stage stage;
    ClipPlayer both(stage.library, {{}, {.mask = upperBodyMask(stage.skeleton, stage.map)}});
    both.play(0, 0);
    both.play(1, 2, {.fadeSeconds = 0.2F});
    both.advance(0.3F);
    const auto pose = stage.poseOf(both);
    const auto lower = stage.sample(0, 0.3F);
    const auto upper = stage.sample(2, 0.3F);
    const int knee = stage.map.jointOf(Role::leftLowerLeg);
    const int hand = stage.map.jointOf(Role::rightHand);
    CHECK(test::differenceOf(std::span(&pose[knee], 1), std::span(&lower[knee], 1)) == 0.0F);
    CHECK(test::differenceOf(std::span(&pose[hand], 1), std::span(&upper[hand], 1)) == 0.0F);
    both.setWeight(1, 0.0F);
    CHECK(test::differenceOf(stage.poseOf(both), lower) == 0.0F);
    both.setWeight(1, 1.0F);
    both.stop(1, 0.1F);
    both.advance(0.1F);
    CHECK(test::differenceOf(stage.poseOf(both), stage.sample(0, 0.4F)) < 1e-4F);
}

TEST_CASE("an additive layer adds its difference from its first frame, by its weight") {
    const Stage stage;
    std::vector<Clip> clips{test::makeWavingClip(stage.skeleton, "base", 4)};
    Clip nod = test::makeTurnedClip(stage.skeleton, "nod", stage.elbow, 0.0F);
    const Clip bent = test::makeTurnedClip(stage.skeleton, "bent", stage.elbow, 0.6F);
    std::copy(bent.parentFromJoint.begin(), bent.parentFromJoint.begin() + static_cast<long>(stage.joints),
              nod.parentFromJoint.change().begin() + static_cast<long>(stage.joints));
    clips.push_back(nod);
    const auto library = ClipLibrary::create(stage.skeleton, clips);
    REQUIRE(library);
    for (const float weight : {0.0F, 0.5F, 1.0F}) {
        ClipPlayer player(library.value(), {{}, {.additive = true, .weight = weight}});
        player.play(0, 0);
        player.play(1, 1, {.loop = false});
        player.advance(1.0F);
        std::vector<RigidTransform> pose(stage.joints);
        player.pose(pose);
        std::vector<RigidTransform> base(stage.joints);
        library.value().sample(0, 1.0F, base);
        const quat added = glm::conjugate(base[stage.elbow].rotation) * pose[stage.elbow].rotation;
        CHECK(rotationVector(added).z == Approx(0.6F * weight).margin(1e-4));
        base[stage.elbow] = pose[stage.elbow];
        CHECK(test::differenceOf(pose, base) < 1e-5F);
    }
}

TEST_CASE("travel taken out as a delta leads where the clip goes, across seams and at steps of any size") {
    const Stage stage;
    for (const float dt : {1.0F / 60.0F, 0.3F, 2.5F, 10.0F}) {
        for (const float speed : {1.0F, -1.0F}) {
            ClipPlayer player(stage.library, {}, RootMotion::extract);
            player.play(0, 0, {.speed = speed});
            RigidTransform worldFromModel;
            float seconds = 0.0F;
            while (seconds < 9.99F) {
                player.advance(dt);
                worldFromModel = worldFromModel * player.rootDelta();
                seconds += dt;
                const auto pose = stage.poseOf(player);
                CHECK(std::abs(pose[0].translation.z) < 1e-4F);
            }
            // Two metres a second.
            CHECK(worldFromModel.translation.z == Approx(2.0F * seconds * speed).margin(2e-3));
            CHECK(std::abs(worldFromModel.translation.x) < 1e-3F);
        }
    }
    ClipPlayer kept(stage.library);
    kept.play(0, 0);
    kept.advance(0.5F);
    CHECK(kept.rootDelta().translation == vec3(0));
    CHECK(stage.poseOf(kept)[0].translation.z == Approx(1.0F).margin(1e-4));
}

TEST_CASE("half-way through a fade the travel is half of both") {
    const Stage stage;
    ClipPlayer player(stage.library, {}, RootMotion::extract);
    player.play(0, 0);
    player.play(0, 1, {.fadeSeconds = 0.2F});
    player.advance(0.1F);
    CHECK(player.rootDelta().translation.z == Approx(0.1F).margin(1e-4));
}

TEST_CASE("every event is told once a pass, whatever the step, the direction and the seam") {
    Stage stage;
    // One on either side of the seam, one on it, some within.
    for (const float seconds : {0.0F, 0.25F, 0.5F, 0.999F, 1.0F})
        REQUIRE(stage.library.addEvent(1, {seconds, "step"}));
    for (const float speed : {1.0F, -1.0F, 3.7F}) {
        for (const float dt : {1.0F / 60.0F, 0.01F, 0.333F, 1.0F, 7.25F}) {
            ClipPlayer player(stage.library);
            player.play(0, 1, {.speed = speed});
            std::array<int, 5> told{};
            double seconds = 0;
            double last = -1.0;
            bool ordered = true;
            const EventSink sink = [&](const FiredEvent& event) {
                ++told[event.event];
                const double at = seconds - static_cast<double>(event.secondsAgo);
                ordered = ordered && at > last - 1e-3;
                last = at;
            };
            for (int step = 0; step < 300; ++step) {
                seconds += static_cast<double>(dt);
                player.advance(dt, sink);
            }
            const double passes = seconds * std::abs(static_cast<double>(speed));
            for (const int count : told) {
                CHECK(count >= static_cast<int>(passes) - 1);
                CHECK(count <= static_cast<int>(passes) + 1);
            }
            CHECK(ordered);
        }
    }
}

TEST_CASE("a clip that is played once tells its first and its last moment once") {
    Stage stage;
    for (const float seconds : {0.0F, 0.5F, 1.0F})
        REQUIRE(stage.library.addEvent(1, {seconds, "step"}));
    for (const float speed : {1.0F, -1.0F}) {
        ClipPlayer player(stage.library);
        player.play(0, 1, {.loop = false, .speed = speed});
        std::vector<int> told;
        const EventSink sink = [&](const FiredEvent& event) { told.push_back(event.event); };
        for (int step = 0; step < 40; ++step)
            player.advance(0.05F, sink);
        CHECK(told == (speed > 0.0F ? std::vector<int>{0, 1, 2} : std::vector<int>{2, 1, 0}));
    }
}

TEST_CASE("an absurd step neither hangs nor loses the clip's time") {
    Stage stage;
    REQUIRE(stage.library.addEvent(1, {0.5F, "step"}));
    ClipPlayer player(stage.library, {}, RootMotion::extract);
    player.play(0, 1);
    int told = 0;
    player.advance(1e7F, [&](const FiredEvent&) { ++told; });
    CHECK(told >= ClipPlayer::kMostPassesTold);
    CHECK(told <= ClipPlayer::kMostPassesTold + 2);
    CHECK(player.seconds(0) == Approx(0.0F).margin(1e-6));
}

TEST_CASE("playing allocates nothing a frame, fades that are interrupted included") {
    Stage stage;
    REQUIRE(stage.library.addEvent(1, {0.1F, "step"}));
    ClipPlayer player(stage.library, {{}, {.mask = upperBodyMask(stage.skeleton, stage.map)}, {.additive = true}},
                      RootMotion::extract);
    std::vector<RigidTransform> pose(stage.joints);
    int told = 0;
    const EventSink sink = [&](const FiredEvent&) { ++told; };
    const std::size_t before = test::allocationCount();
    for (int step = 0; step < 300; ++step) {
        if (step % 10 == 0) player.play(step % 3, step / 10 % 4, {.fadeSeconds = 0.7F});
        if (step % 70 == 0) player.stop(1, 0.2F);
        player.advance(1.0F / 60.0F, sink);
        player.pose(pose);
    }
    CHECK(test::allocationCount() == before);
    CHECK(told > 0);
}
