#include "animation/playback/clip_batch.hpp"

#include <cstring>
#include <numeric>

#include "animation/playback/clip_player.hpp"
#include "core/random.hpp"
#include "made_clips.hpp"
#include "support/catch.hpp"
#include "support/counting_new.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using namespace lutka::animation;

namespace {

struct MarchingCrowd {
    Skeleton skeleton = test::makeBiped().skeleton;
    std::size_t joints = skeleton.parents.size();
    ClipLibrary library = make();
    std::vector<ClipMix> mixes;
    std::vector<int> all;

    explicit MarchingCrowd(std::size_t count) : mixes(count), all(count) {
        std::iota(all.begin(), all.end(), 0);
        Random random(3);
        for (ClipMix& mix : mixes) {
            mix.count = 1 + static_cast<int>(random.next() % kMostClipTerms);
            for (ClipTerm& term : mix.terms)
                term = {static_cast<int>(random.next() % 3), random.uniform(-0.1F, 1.2F), random.uniform(0.0F, 1.0F)};
        }
    }
    [[nodiscard]] ClipLibrary make() const {
        std::vector<Clip> clips;
        for (const std::uint64_t seed : {1U, 2U, 3U})
            clips.push_back(test::makeWavingClip(skeleton, "clip", seed, vec3(0, 0, static_cast<float>(seed))));
        clips[1].steppedRotations.assign(joints, false);
        clips[1].steppedTranslations.assign(joints, false);
        clips[1].steppedRotations[0] = clips[1].steppedRotations[4] = true;
        clips[1].steppedTranslations[0] = clips[1].steppedTranslations[5] = true;
        RootMotionSettings root;
        root.joint = 0;
        return ClipLibrary::create(skeleton, clips, root).value();
    }
    [[nodiscard]] std::vector<RigidTransform> room() const {
        return std::vector<RigidTransform>(mixes.size() * joints);
    }
    // What the batch should give, one figure after the other.
    [[nodiscard]] std::vector<RigidTransform> expected(bool inPlace) const {
        std::vector<RigidTransform> out = room();
        std::vector<RigidTransform> one(joints);
        for (std::size_t i = 0; i < mixes.size(); ++i) {
            for (int term = 0; term < mixes[i].count; ++term) {
                const ClipTerm& of = mixes[i].terms[term];
                if (inPlace)
                    library.sampleInPlace(of.clip, of.seconds, one);
                else
                    library.sample(of.clip, of.seconds, one);
                for (std::size_t joint = 0; joint < joints; ++joint) {
                    RigidTransform& to = out[i * joints + joint];
                    to = term == 0 ? one[joint] : interpolate(to, one[joint], of.cover);
                }
            }
        }
        return out;
    }
};

bool sameBits(std::span<const RigidTransform> a, std::span<const RigidTransform> b) {
    return std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

}  // namespace

TEST_CASE("a batch of clips gives each figure the pose that it would get alone") {
    for (const bool inPlace : {false, true}) {
        for (const std::size_t count : {1, 5, 8, 21}) {
            const MarchingCrowd crowd(count);
            const TaskPool pool;
            ClipBatch batch(crowd.library, pool, inPlace);
            std::vector<RigidTransform> got = crowd.room();
            batch.run(crowd.all, crowd.mixes, got);
            CHECK(test::differenceOf(got, crowd.expected(inPlace)) < 1e-5F);
        }
    }
}

TEST_CASE("a batch of clips gives the same bits on every instruction set and at every number of threads") {
    const MarchingCrowd crowd(50);
    std::vector<RigidTransform> reference = crowd.room();
    {
        const TaskPool pool;
        ClipBatch batch(crowd.library, pool, true);
        batch.useInstructionSet(InstructionSet::baseline);
        batch.run(crowd.all, crowd.mixes, reference);
    }
    for (const int threads : {1, 2, 3}) {
        const TaskPool pool(threads);
        ClipBatch batch(crowd.library, pool, true);
        std::vector<RigidTransform> got = crowd.room();
        batch.run(crowd.all, crowd.mixes, got);
        CHECK(sameBits(got, reference));
    }
}

TEST_CASE("a batch of clips leaves the figures that are not asked for and allocates nothing") {
    const MarchingCrowd crowd(20);
    const TaskPool pool;
    ClipBatch batch(crowd.library, pool, true);
    std::vector<RigidTransform> everything = crowd.room();
    batch.run(crowd.all, crowd.mixes, everything);
    std::vector<RigidTransform> some = crowd.room();
    const std::vector<RigidTransform> untouched = crowd.room();
    const std::vector<int> odd{1, 3, 5, 7, 9, 11, 13, 15, 17, 19};
    const std::size_t before = test::allocationCount();
    batch.run(odd, crowd.mixes, some);
    CHECK(test::allocationCount() == before);
    for (std::size_t i = 0; i < crowd.mixes.size(); ++i) {
        const auto& from = i % 2 == 1 ? everything : untouched;
        const std::size_t at = i * crowd.joints;
        CHECK(sameBits(std::span(some).subspan(at, crowd.joints), std::span(from).subspan(at, crowd.joints)));
    }
}

TEST_CASE("a player's mix sampled by a batch is the player's pose") {
    const MarchingCrowd crowd(1);
    ClipPlayer player(crowd.library);
    player.play(0, 0);
    player.advance(0.2F);
    player.play(0, 1, {.fadeSeconds = 0.5F});
    player.advance(0.1F);
    player.play(0, 2, {.speed = -0.7F, .fadeSeconds = 0.5F});
    player.advance(0.1F);
    const auto mix = player.mix(0);
    REQUIRE(mix);
    CHECK(mix->count == 3);
    const TaskPool pool;
    ClipBatch batch(crowd.library, pool);
    std::vector<RigidTransform> wide = crowd.room();
    std::vector<RigidTransform> alone = crowd.room();
    batch.run(crowd.all, std::span(&*mix, 1), wide);
    player.pose(alone);
    CHECK(test::differenceOf(wide, alone) < 1e-5F);
    player.stop(0, 0.5F);
    CHECK(!player.mix(0));
}
