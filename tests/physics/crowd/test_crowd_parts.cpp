#include <algorithm>
#include <set>

#include "core/random.hpp"
#include "crowd_scene.hpp"
#include "physics/crowd/bounds.hpp"
#include "physics/crowd/broadphase.hpp"
#include "physics/crowd/detect.hpp"
#include "physics/crowd/jobs.hpp"
#include "support/catch.hpp"
#include "support/dolls.hpp"

using namespace lutka;
using namespace lutka::test;
using namespace lutka::physics::crowd;

namespace {

void findJobs(CrowdState& state) {
    gatherActive(state);
    findBounds(state, kStep);
    sweepDolls(state, kStep);
    findContacts(state, kStep);
    makeJobs(state);
}

std::unique_ptr<CrowdState> emptyState(int threads) {
    physics::WorldSettings settings;
    settings.threads = threads;
    return std::make_unique<CrowdState>(settings, CrowdTuning{});
}

// Dolls in and beside each other, turned at random: one job of many batches.
std::unique_ptr<CrowdState> heap(const physics::RagdollProfile& profile, int dolls, int threads) {
    auto state = emptyState(threads);
    Random random(3);
    for (int i = 0; i < dolls; ++i) {
        const vec3 offset(random.uniform(-2, 2), random.uniform(0, 1), random.uniform(-4, 4));
        const quat turn = glm::angleAxis(random.uniform(0, 3), glm::normalize(vec3(1, random.uniform(-1, 1), 0.3F)));
        addDoll(*state, makeTopology(profile, 0.05F), &profile, placedDoll(profile, offset, turn));
    }
    findJobs(*state);
    return state;
}

std::set<int> bodiesOfPart(const CrowdState& state, const Job& job, const PairPart& part) {
    std::set<int> bodies;
    for (std::size_t i = part.firstTouch; i < part.firstTouch + part.touchCount; ++i) {
        const TouchBrief& brief = state.briefs[job.touches[i]];
        bodies.insert({brief.bodyA, brief.bodyB});
    }
    return bodies;
}

}  // namespace

TEST_CASE("parts of a large job that are no neighbours share no body, and a small job has one part") {
    const physics::RagdollProfile profile = makeDoll();
    for (const int dolls : {40, 200}) {
        const auto state = heap(profile, dolls, 1);
        const auto largest =
            std::max_element(state->jobs.begin(), state->jobs.begin() + static_cast<std::ptrdiff_t>(state->jobCount),
                             [](const Job& a, const Job& b) { return a.batches.size() < b.batches.size(); });
        CAPTURE(dolls, largest->touches.size());
        CHECK(isSplit(*largest) == (dolls == 200));
        if (dolls == 40) CHECK(largest->parts.size() == 1);
        if (dolls == 200) CHECK(largest->parts.size() >= 6);
        std::vector<std::set<int>> bodies;
        std::size_t touches = 0;
        for (const PairPart& part : largest->parts) {
            bodies.push_back(bodiesOfPart(*state, *largest, part));
            CHECK(part.firstTouch == touches);
            touches += part.touchCount;
            // Those that press come first, since they are worth blocks of their own.
            const auto first = largest->touches.begin() + static_cast<std::ptrdiff_t>(part.firstTouch);
            CHECK(std::is_partitioned(first, first + static_cast<std::ptrdiff_t>(part.touchCount),
                                      [&](int touch) { return state->briefs[touch].presses; }));
        }
        CHECK(touches == largest->touches.size());
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            for (std::size_t k = i + 2; k < bodies.size(); ++k) {
                std::vector<int> shared;
                std::set_intersection(bodies[i].begin(), bodies[i].end(), bodies[k].begin(), bodies[k].end(),
                                      std::back_inserter(shared));
                CHECK(shared.empty());
            }
        }
    }
}

TEST_CASE("every contact lies in one lane of its part's blocks, and no block has a body twice, at any thread count") {
    const physics::RagdollProfile profile = makeDoll();
    std::vector<BlockTouches> found;
    for (const int threads : {1, 3}) {
        const auto state = heap(profile, 200, threads);
        std::vector<int> lanes(state->touches.size(), 0);
        bool twice = false;
        for (std::size_t i = 0; i < state->jobCount; ++i) {
            const Job& job = state->jobs[i];
            for (const PairPart& part : job.parts) {
                const std::span own = std::span(job.touches).subspan(part.firstTouch, part.touchCount);
                const std::set<int> ownTouches(own.begin(), own.end());
                for (int block = part.view.first; block < part.view.first + part.view.count; ++block) {
                    std::set<int> bodies;
                    int ends = 0;
                    for (const int touch : state->touchOfLane[block]) {
                        if (touch < 0) continue;
                        ++lanes[touch];
                        ends += 2;
                        bodies.insert({state->briefs[touch].bodyA, state->briefs[touch].bodyB});
                        CHECK(ownTouches.count(touch) == 1);
                    }
                    twice = twice || static_cast<int>(bodies.size()) != ends;
                }
            }
        }
        CHECK(!twice);
        CHECK(std::count(lanes.begin(), lanes.end(), 1) == static_cast<std::ptrdiff_t>(lanes.size()));
        found.push_back(state->touchOfLane);
    }
    CHECK(found[0] == found[1]);
}

TEST_CASE("a job has no room for the contacts of another") {
    const physics::RagdollProfile profile = makeDoll();
    const auto state = emptyState(1);
    const auto add = [&](const vec3& at) {
        addDoll(*state, makeTopology(profile, 0.05F), &profile, placedDoll(profile, at, quat(1, 0, 0, 0)));
    };
    // A batch of dolls a heap, each in one place, so that the first has many contacts and the others few.
    constexpr int kHeaps = 12;
    for (int i = 0; i < kHeaps * kLanes; ++i) {
        const auto heap = static_cast<float>(i / kLanes);
        add({30.0F * heap, 0, heap == 0.0F || i % kLanes == 0 ? 0.0F : 3.0F * static_cast<float>(i % kLanes)});
    }
    for (int step = 0; step < 3; ++step)
        findJobs(*state);
    REQUIRE(state->jobCount == kHeaps);
    std::size_t room = 0;
    for (const Job& job : state->jobs)
        room += job.touches.capacity();
    CAPTURE(state->touches.size(), room);
    CHECK(state->jobs[0].touches.size() > state->touches.size() / 2);
    CHECK(room < 3 * state->touches.size());
}
