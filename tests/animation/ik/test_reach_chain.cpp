#include "animation/ik/reach_chain.hpp"

#include <glm/geometric.hpp>

#include "animation/pose.hpp"
#include "random_chain.hpp"
#include "support/catch.hpp"
#include "support/counting_new.hpp"

using namespace lutka;
using namespace lutka::animation;

namespace {

ReachChain whole(const test::RandomChain& chain) {
    ReachChain reach;
    reach.joints = std::span(chain.joints).first(chain.joints.size() - 1);
    reach.tip = chain.joints.back();
    return reach;
}

// A target that the chain may well be bent to.
vec3 nearTarget(Random& random, const test::RandomChain& chain) {
    const vec3 start = chain.at(0);
    const vec3 tip = chain.at(static_cast<int>(chain.joints.size()) - 1);
    const vec3 way = test::randomTurn(random, 1.0F) * (tip - start);
    return start + glm::normalize(way) * chain.length() * random.uniform(0.55F, 0.9F);
}

}  // namespace

TEST_CASE("a chain of three to eight joints brings its tip to the target and keeps its lengths") {
    Random random(1);
    float worst = 0.0F;
    for (int i = 0; i < 500; ++i) {
        test::RandomChain chain = test::makeRandomChain(random, 4 + static_cast<int>(random.next() % 6));
        const std::vector<RigidTransform> before = chain.pose;
        const vec3 target = nearTarget(random, chain);
        const Reached reached = solveReachChain(chain.skeleton, whole(chain), target, chain.pose);
        worst = std::max(worst, reached.errorM);
        CHECK(test::stretchBetween(chain.skeleton, before, chain.pose) < 1e-5F);
    }
    INFO(worst);
    CHECK(worst < 1e-3F);
}

TEST_CASE("a chain keeps its joints' ranges and tells how far it misses") {
    Random random(2);
    for (int i = 0; i < 300; ++i) {
        test::RandomChain chain = test::makeRandomChain(random, 5);
        std::vector<SwingTwistRange> ranges(4);
        for (std::size_t joint = 0; joint < ranges.size(); ++joint) {
            ranges[joint].parentFromNeutral = chain.pose[chain.joints[joint]].rotation;
            ranges[joint].mostSwingY = random.uniform(0.1F, 0.5F);
            ranges[joint].mostSwingZ = random.uniform(0.1F, 0.5F);
            ranges[joint].leastTwist = -0.2F;
            ranges[joint].mostTwist = 0.2F;
        }
        ReachChain reach = whole(chain);
        reach.ranges = ranges;
        const vec3 target = nearTarget(random, chain);
        const Reached reached = solveReachChain(chain.skeleton, reach, target, chain.pose);
        for (std::size_t joint = 0; joint < ranges.size(); ++joint)
            CHECK(excessOf(ranges[joint], chain.pose[chain.joints[joint]].rotation) < 1e-3F);
        CHECK(reached.errorM == Approx(glm::distance(chain.at(4), target)).margin(1e-5));
    }
}

TEST_CASE("a stiff joint turns less than a free one") {
    Random random(3);
    float stiffTurn = 0.0F;
    float freeTurn = 0.0F;
    for (int i = 0; i < 50; ++i) {
        test::RandomChain chain = test::makeRandomChain(random, 5);
        const std::vector<RigidTransform> rest = chain.pose;
        const vec3 target = nearTarget(random, chain);
        ReachChain reach = whole(chain);
        solveReachChain(chain.skeleton, reach, target, chain.pose);
        const std::size_t first = chain.joints[0];
        freeTurn += test::turnBetween(std::span(rest).subspan(first, 1), std::span(chain.pose).subspan(first, 1));
        chain.pose = rest;
        const std::vector<float> stiffness{0.9F, 0.0F, 0.0F, 0.0F};
        reach.stiffness = stiffness;
        solveReachChain(chain.skeleton, reach, target, chain.pose);
        stiffTurn += test::turnBetween(std::span(rest).subspan(first, 1), std::span(chain.pose).subspan(first, 1));
    }
    CHECK(stiffTurn < 0.5F * freeTurn);
}

// 1 mm of the target turns no joint by more than 3 degrees, from near into the unreachable.
TEST_CASE("a chain follows a target without a snap, out of reach too") {
    Random random(4);
    float worst = 0.0F;
    for (int i = 0; i < 40; ++i) {
        test::RandomChain chain = test::makeRandomChain(random, 5);
        const std::vector<RigidTransform> rest = chain.pose;
        const vec3 start = chain.at(0);
        const vec3 line = glm::normalize(test::randomTurn(random, 0.7F) * (chain.at(4) - start));
        std::vector<RigidTransform> last;
        for (float way = chain.length() * 0.6F; way < chain.length() * 1.3F; way += 1e-3F) {
            chain.pose = rest;
            solveReachChain(chain.skeleton, whole(chain), start + line * way, chain.pose);
            if (!last.empty()) worst = std::max(worst, test::turnBetween(last, chain.pose));
            last = chain.pose;
        }
    }
    INFO(degrees(worst));
    CHECK(degrees(worst) < 3.0F);
}

TEST_CASE("a chain allocates nothing and gives the same bits again") {
    Random random(5);
    test::RandomChain chain = test::makeRandomChain(random, 6);
    const std::vector<RigidTransform> rest = chain.pose;
    const vec3 target = nearTarget(random, chain);
    const ReachChain reach = whole(chain);
    const std::size_t before = test::allocationCount();
    solveReachChain(chain.skeleton, reach, target, chain.pose);
    CHECK(test::allocationCount() == before);
    const std::vector<RigidTransform> first = chain.pose;
    chain.pose = rest;
    solveReachChain(chain.skeleton, reach, target, chain.pose);
    CHECK(test::turnBetween(first, chain.pose) == 0.0F);
}
