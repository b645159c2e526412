#include "animation/clip.hpp"

#include <thread>

#include "support/catch.hpp"

using namespace lutka;
using namespace lutka::animation;

namespace {

RigidTransform at(float x) {
    return {quat(1, 0, 0, 0), {x, 0, 0}};
}

}  // namespace

TEST_CASE("the poses of a clip are made at their first use, once for all its copies") {
    int made = 0;
    Clip clip{"walk",
              30.0F,
              2,
              ClipFrames(2,
                         [&] {
                             ++made;
                             return std::vector<RigidTransform>{at(1), at(3)};
                         }),
              {}};
    const Clip copy = clip;
    CHECK(clip.seconds() == Approx(1.0F / 30.0F));
    CHECK(clip.parentFromJoint.size() == 2);
    CHECK(made == 0);
    std::vector<RigidTransform> pose(1);
    sampleClip(clip, 1.0F / 60.0F, pose);
    CHECK(pose[0].translation.x == Approx(2.0F));
    sampleClip(copy, 1.0F, pose);
    CHECK(pose[0].translation.x == 3.0F);
    CHECK(made == 1);
}

TEST_CASE("changing a clip leaves its copies as they were") {
    Clip clip{"walk", 30.0F, 1, ClipFrames(1, [] { return std::vector<RigidTransform>{at(1)}; }), {}};
    const Clip before = clip;
    clip.parentFromJoint.append(std::vector<RigidTransform>{at(2)});
    CHECK(clip.parentFromJoint.size() == 2);
    CHECK(clip.parentFromJoint[1].translation.x == 2.0F);
    clip.parentFromJoint.change()[0] = at(5);
    CHECK(clip.parentFromJoint[0].translation.x == 5.0F);
    CHECK(before.parentFromJoint.size() == 1);
    CHECK(before.parentFromJoint[0].translation.x == 1.0F);
}

TEST_CASE("several threads may come to a clip first") {
    int made = 0;
    const Clip clip{"walk",
                    30.0F,
                    1,
                    ClipFrames(1,
                               [&] {
                                   ++made;
                                   return std::vector<RigidTransform>{at(7)};
                               }),
                    {}};
    std::vector<std::thread> threads;
    std::vector<float> seen(8);
    for (float& x : seen)
        threads.emplace_back([&clip, &x] { x = clip.parentFromJoint[0].translation.x; });
    for (std::thread& thread : threads)
        thread.join();
    CHECK(made == 1);
    for (const float x : seen)
        CHECK(x == 7.0F);
}
