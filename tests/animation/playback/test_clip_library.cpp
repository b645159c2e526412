#include "animation/playback/clip_library.hpp"

#include <glm/geometric.hpp>
#include <limits>

#include "animation/pose.hpp"
#include "made_clips.hpp"
#include "support/catch.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using namespace lutka::animation;

namespace {

const Skeleton& bipedSkeleton() {
    static const Character biped = test::makeBiped();
    return biped.skeleton;
}

}  // namespace

TEST_CASE("a library gives the poses that sampleClip() gives, of clips that hold joints too") {
    const Skeleton& skeleton = bipedSkeleton();
    std::vector<Clip> clips{test::makeWavingClip(skeleton, "a", 1), test::makeWavingClip(skeleton, "b", 2)};
    clips[1].steppedRotations.assign(skeleton.parents.size(), false);
    clips[1].steppedTranslations.assign(skeleton.parents.size(), false);
    clips[1].steppedRotations[3] = true;
    clips[1].steppedTranslations[4] = true;
    const auto library = ClipLibrary::create(skeleton, clips);
    REQUIRE(library);
    CHECK(library.value().find("b") == 1);
    CHECK(library.value().find("c") == -1);
    std::vector<RigidTransform> expected(skeleton.parents.size());
    std::vector<RigidTransform> got(skeleton.parents.size());
    for (int clip = 0; clip < 2; ++clip) {
        for (const float seconds : {-1.0F, 0.0F, 0.0166F, 0.5F, 0.73F, 1.0F, 9.0F}) {
            sampleClip(clips[clip], seconds, expected);
            library.value().sample(clip, seconds, got);
            CHECK(test::differenceOf(got, expected) == 0.0F);
        }
    }
}

TEST_CASE("a library refuses clips of other skeletons and numbers that are none") {
    const Skeleton& skeleton = bipedSkeleton();
    const auto codeOf = [&](const Clip& clip) {
        const auto library = ClipLibrary::create(skeleton, std::span(&clip, 1));
        return library ? std::nullopt : std::optional(library.error().code);
    };
    const Clip good = test::makeWavingClip(skeleton, "good", 1);
    CHECK(!codeOf(good));
    Clip shorter = good;
    shorter.frameCount = 30;
    CHECK(codeOf(shorter) == ErrorCode::input);
    Clip none = good;
    none.frameCount = 0;
    CHECK(codeOf(none) == ErrorCode::input);
    Clip rate = good;
    rate.framesPerSecond = std::numeric_limits<float>::quiet_NaN();
    CHECK(codeOf(rate) == ErrorCode::input);
    Clip wild = good;
    wild.parentFromJoint.change()[7].translation.x = std::numeric_limits<float>::infinity();
    CHECK(codeOf(wild) == ErrorCode::input);
}

TEST_CASE("travel is what in-place sampling leaves out, over the ground and in heading") {
    const Skeleton& skeleton = bipedSkeleton();
    const Clip clip = test::makeWavingClip(skeleton, "walk", 5, vec3(0.4F, 0.1F, 1.5F));
    for (const bool turn : {false, true}) {
        RootMotionSettings root;
        root.joint = 0;
        root.turn = turn;
        root.vertical = turn;
        const auto library = ClipLibrary::create(skeleton, std::span(&clip, 1), root);
        REQUIRE(library);
        std::vector<RigidTransform> kept(skeleton.parents.size());
        std::vector<RigidTransform> inPlace(skeleton.parents.size());
        for (const float seconds : {0.0F, 0.31F, 1.0F}) {
            library.value().sample(0, seconds, kept);
            library.value().sampleInPlace(0, seconds, inPlace);
            CHECK(std::abs(inPlace[0].translation.x) < 1e-5F);
            CHECK(std::abs(inPlace[0].translation.z) < 1e-5F);
            const RigidTransform ground = library.value().groundFrame(0, seconds);
            for (const int joint : library.value().rootJoints())
                inPlace[joint] = ground * inPlace[joint];
            CHECK(test::differenceOf(kept, inPlace) < 1e-5F);
        }
    }
}

TEST_CASE("events lie within their clip and are kept in order") {
    const Skeleton& skeleton = bipedSkeleton();
    const Clip clip = test::makeWavingClip(skeleton, "walk", 5);
    auto library = ClipLibrary::create(skeleton, std::span(&clip, 1));
    REQUIRE(library);
    CHECK(library.value().addEvent(0, {0.9F, "right"}).ok());
    CHECK(library.value().addEvent(0, {0.4F, "left"}).ok());
    CHECK(library.value().events(0)[0].name == "left");
    const auto late = library.value().addEvent(0, {1.1F, "late"});
    REQUIRE(!late);
    CHECK(late.error().code == ErrorCode::usage);
    CHECK(!library.value().addEvent(0, {std::numeric_limits<float>::quiet_NaN(), "never"}));
}
