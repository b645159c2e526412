// What lies deep within a doll is mended exactly (own_wedges): of one doll, of several of a batch, of one with led
// bodies.
#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "crowd_scene.hpp"
#include "physics/collision/shape.hpp"
#include "support/catch.hpp"
#include "support/dolls.hpp"

using namespace lutka;
using namespace lutka::test;
using physics::BodyState;
using physics::createCrowdWorld;
using physics::WorldSettings;
using physics::crowd::CrowdTuning;

namespace {

// Four light limbs beside each other, as they are before they are turned.
Limbs lightLimbs(float apart) {
    Limbs limbs = besideEachOther({1.0F, 2.0F, 3.0F}, apart);
    for (std::size_t b = 1; b < limbs.bodies.size(); ++b) {
        physics::BodyProfile& body = limbs.doll.bodies[b];
        body.massKg = b % 2 == 1 ? 0.4F : 1.5F;
        body.inertia = physics::shapeInertia(body.shape, body.massKg);
    }
    return limbs;
}

// They lie across each other a little, the lowest on the ground.
std::vector<BodyState> tangled(const Limbs& limbs, Random& random) {
    std::vector<BodyState> bodies = limbs.bodies;
    for (std::size_t b = 1; b < bodies.size(); ++b) {
        RigidTransform& at = bodies[b].worldFromBody;
        const vec3 anchor = at * limbs.doll.constraints[b - 1].childFromFrame.translation;
        const vec3 axis(random.uniform(-0.3F, 0.3F), random.uniform(-1, 1), random.uniform(-0.4F, 0.4F));
        const quat turn = glm::angleAxis(random.uniform(-0.15F, 0.15F), glm::normalize(axis));
        at = {turn * at.rotation, anchor + turn * (at.translation - anchor)};
    }
    const float low = lowestPoint(limbs.doll, bodies);
    for (BodyState& body : bodies)
        body.worldFromBody.translation.y -= low;
    return bodies;
}

// How deep limbs lie in each other at most, metres.
float depthOfLimbs(const Limbs& limbs, const std::vector<BodyState>& now) {
    float depth = 0.0F;
    for (std::size_t a = 1; a < now.size(); ++a)
        for (std::size_t b = a + 1; b < now.size(); ++b)
            depth = std::max(depth, -physics::distanceBetween(limbs.doll.bodies[a].shape, now[a].worldFromBody,
                                                              limbs.doll.bodies[b].shape, now[b].worldFromBody));
    return depth;
}

void moveBy(std::vector<BodyState>& bodies, const vec3& way) {
    for (BodyState& body : bodies)
        body.worldFromBody.translation += way;
}

}  // namespace

TEST_CASE("limbs of a doll that lie across each other are mended together, so that none goes deeper by that") {
    const auto grownBy = [](float wedgeDepth) {
        float most = 0.0F;
        for (std::uint64_t seed = 0; seed < 130; ++seed) {
            Random random(seed);
            const Limbs limbs = lightLimbs(random.uniform(0.085F, 0.105F));
            const std::vector<BodyState> start = tangled(limbs, random);
            CrowdTuning tuning;
            tuning.wedgeDepth = wedgeDepth;
            const auto world = createCrowdWorld(WorldSettings{}, tuning);
            world->addStatic(floorPlane());
            world->addDoll(limbs.doll, start);
            const float before = depthOfLimbs(limbs, start);
            for (int i = 0; i < 60; ++i)
                world->step(kStep, [&] { most = std::max(most, depthOfLimbs(limbs, bodiesOf(*world, 0)) - before); });
        }
        return most;
    };
    CHECK(grownBy(1.0F) > 0.02F);  // each contact by itself, at any depth
    CHECK(grownBy(CrowdTuning{}.wedgeDepth) < 0.02F);
}

// Dolls of a profile that are far from each other share a batch, and with it the passes that mend them.
TEST_CASE("dolls of one batch that are tangled in different ways are each mended as one by itself") {
    constexpr int kDolls = 11;  // a batch and a part of one
    const auto grownBy = [](float wedgeDepth) {
        float most = 0.0F;
        for (std::uint64_t seed = 0; seed < 12; ++seed) {
            Random random(seed);
            const Limbs limbs = lightLimbs(random.uniform(0.085F, 0.105F));
            CrowdTuning tuning;
            tuning.wedgeDepth = wedgeDepth;
            const auto world = createCrowdWorld(WorldSettings{}, tuning);
            world->addStatic(floorPlane());
            std::vector<float> before;
            for (int doll = 0; doll < kDolls; ++doll) {
                std::vector<BodyState> start = tangled(limbs, random);
                before.push_back(depthOfLimbs(limbs, start));
                moveBy(start, {0, 0, 3.0F * static_cast<float>(doll)});
                world->addDoll(limbs.doll, start);
            }
            for (int i = 0; i < 60; ++i)
                world->step(kStep, [&] {
                    for (int doll = 0; doll < kDolls; ++doll)
                        most = std::max(most, depthOfLimbs(limbs, bodiesOf(*world, doll)) - before[doll]);
                });
        }
        return most;
    };
    CHECK(grownBy(1.0F) > 0.02F);
    CHECK(grownBy(CrowdTuning{}.wedgeDepth) < 0.02F);
}

// Which lane a doll has, and how many others there are, decides in which order its contacts are packed.
TEST_CASE("a tangled doll comes to lie in the same way in whichever lane it is") {
    Random random(3);
    const Limbs limbs = lightLimbs(0.09F);
    const std::vector<BodyState> start = tangled(limbs, random);
    std::vector<std::vector<BodyState>> ends;
    for (int before = 0; before < 8; ++before) {
        const auto world = createCrowdWorld(WorldSettings{});
        world->addStatic(floorPlane());
        for (int doll = 0; doll < 8; ++doll) {
            std::vector<BodyState> bodies = start;
            // The others lie elsewhere, untangled.
            if (doll != before) bodies = limbs.bodies;
            moveBy(bodies,
                   {0, doll == before ? 0.0F : 0.2F, doll == before ? 0.0F : 5.0F + 3.0F * static_cast<float>(doll)});
            world->addDoll(limbs.doll, bodies);
        }
        for (int i = 0; i < 30; ++i)
            world->step(kStep);
        ends.push_back(bodiesOf(*world, before));
    }
    for (const std::vector<BodyState>& end : ends)
        for (std::size_t b = 0; b < end.size(); ++b)
            CHECK(glm::distance(end[b].worldFromBody.translation, ends[0][b].worldFromBody.translation) < 0.002F);
}

// A limb that is led into the others does not yield to them: what presses it has nothing to push.
TEST_CASE("limbs that a led one of their doll goes through part from it without being thrown") {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        CAPTURE(seed);
        Random random(seed);
        const Limbs limbs = lightLimbs(random.uniform(0.085F, 0.105F));
        const auto world = createCrowdWorld(WorldSettings{});
        world->addStatic(floorPlane());
        std::vector<std::vector<BodyState>> starts;
        for (int doll = 0; doll < 3; ++doll) {
            starts.push_back(tangled(limbs, random));
            moveBy(starts.back(), {0, 0, 3.0F * static_cast<float>(doll)});
            world->addDoll(limbs.doll, starts.back());
        }
        float fastest = 0.0F;
        float off = 0.0F;
        for (int i = 0; i < 120; ++i) {
            // The second limb of the first doll turns about its anchor through its neighbours and back, and one of the
            // second is held where it lies.
            const auto wayAt = [&](int step) {
                const RigidTransform& at = starts[0][2].worldFromBody;
                const vec3 anchor = at * limbs.doll.constraints[1].childFromFrame.translation;
                const quat turn = glm::angleAxis(0.3F * std::sin(0.05F * static_cast<float>(step)), vec3(0, 0, 1));
                return RigidTransform{turn * at.rotation, anchor + turn * (at.translation - anchor)};
            };
            const RigidTransform from = wayAt(i);
            physics::BodyTarget target;
            target.worldFromBody = wayAt(i + 1);
            target.linearVelocity = (target.worldFromBody.translation - from.translation) / kStep;
            target.angularVelocity =
                rotationVector(glm::normalize(target.worldFromBody.rotation * glm::conjugate(from.rotation))) / kStep;
            world->setBodyTarget(world->dolls()[0], 2, target);
            physics::BodyTarget held;
            held.worldFromBody = starts[1][3].worldFromBody;
            world->setBodyTarget(world->dolls()[1], 3, held);
            world->step(kStep);
            off = std::max(
                off, glm::distance(bodiesOf(*world, 0)[2].worldFromBody.translation, target.worldFromBody.translation));
            for (int doll = 0; doll < 3; ++doll)
                for (const BodyState& body : bodiesOf(*world, doll))
                    fastest = std::max(fastest, glm::length(body.linearVelocity));
        }
        CHECK(off < 0.001F);
        CHECK(fastest < 4.0F);  // it goes at 0.7 m/s itself
        CHECK(world->caught().empty());
        CHECK(std::isfinite(world->dragWork()));
    }
}
