#include "scene/run/load_shedding.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "physics/bullet/bullet_world.hpp"
#include "physics/crowd/crowd_world.hpp"
#include "support/catch.hpp"
#include "support/dolls.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using physics::BodyState;
using scene::LoadShedder;
using scene::ShedSettings;

namespace {

constexpr float kDt = 1.0F / 60.0F;
constexpr physics::SolverKind kSolvers[] = {physics::SolverKind::bullet, physics::SolverKind::crowd};

// Dolls over a floor with a shedder, all of one profile, at the given places.
struct Crowd {
    animation::Character character = test::makeBiped();
    physics::RagdollProfile profile = test::makeDoll();
    physics::Rig rig;
    std::unique_ptr<physics::World> world;
    std::unique_ptr<LoadShedder> shedder;
    std::size_t bodies = profile.bodies.size();

    Crowd(physics::SolverKind solver, const std::vector<vec3>& places, const ShedSettings& settings,
          bool sleeping = false, float height = 0.5F) {
        auto bound = physics::bindRig(profile, character.skeleton);
        REQUIRE(bound.ok());
        rig = std::move(bound).value();
        physics::WorldSettings options;
        options.solver = solver;
        options.sleeping = sleeping;
        world = solver == physics::SolverKind::crowd ? physics::createCrowdWorld(options)
                                                     : physics::createBulletWorld(options);
        const physics::StaticShape floor;
        world->addStatic(floor);
        std::vector<BodyState> states(bodies);
        for (const vec3& place : places) {
            const RigidTransform worldFromModel{glm::angleAxis(0.4F, glm::normalize(vec3(1, 0.3F, 0.2F))),
                                                place + vec3(0, height, 0)};
            physics::bodiesFromPose(rig, character.skeleton.bindModelFromJoint, worldFromModel, states);
            world->addDoll(profile, states);
        }
        const std::vector<LoadShedder::Kind> kinds(places.size(), LoadShedder::Kind{&profile, &rig});
        shedder = std::make_unique<LoadShedder>(kinds, *world, std::span(&floor, 1), options, settings);
    }

    [[nodiscard]] std::vector<RigidTransform> shown(int doll) const {
        std::vector<RigidTransform> out(bodies);
        shedder->getBodies(doll, out);
        return out;
    }
    [[nodiscard]] std::vector<RigidTransform> pose(int doll) const {
        std::vector<RigidTransform> out(character.skeleton.parents.size());
        physics::poseFromBodies(rig, character.skeleton, shown(doll), {}, out);
        return out;
    }
    [[nodiscard]] std::vector<BodyState> states(int doll) const {
        std::vector<BodyState> out(bodies);
        shedder->getStates(doll, out);
        return out;
    }
};

float farthest(const std::vector<RigidTransform>& a, const std::vector<RigidTransform>& b) {
    float worst = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        worst = std::max({worst, glm::distance(a[i].translation, b[i].translation),
                          glm::distance(a[i] * vec3(0.2F), b[i] * vec3(0.2F))});
    return worst;
}

// How far any point of a doll can move in a step at its present speeds.
float reach(const std::vector<BodyState>& states, float dt) {
    float fastest = 0;
    for (const BodyState& body : states)
        fastest = std::max(fastest, glm::length(body.linearVelocity) + 0.8F * glm::length(body.angularVelocity));
    return fastest * dt;
}

const vec3 kNear(0, 1, 0);
const vec3 kFar(0, 1, 50);

}  // namespace

TEST_CASE("what is spared is read from a list") {
    const auto settings = scene::parseShedSettings("lod7@5,apart@8.5,slow3@12,frozen@40");
    REQUIRE(settings.ok());
    CHECK(settings.value().lodFrom == 5.0F);
    CHECK(settings.value().lodLevel == physics::LodLevel::block);
    CHECK(settings.value().apartFrom == 8.5F);
    CHECK(settings.value().slowFrom == 12.0F);
    CHECK(settings.value().slowEvery == 3);
    CHECK(settings.value().frozenFrom == 40.0F);
    CHECK_FALSE(scene::parseShedSettings("").value().any());
    for (const char* wrong :
         {"lod", "lod@", "lod@x", "lod@-1", "slow1@3", "slow9@3", "slowest@3", "ice@3", "lod@nan"}) {
        const auto refused = scene::parseShedSettings(wrong);
        INFO(wrong);
        REQUIRE_FALSE(refused.ok());
        CHECK(refused.error().code == ErrorCode::usage);
    }
}

TEST_CASE("without measures a shedder is the world alone, bit for bit") {
    for (const auto solver : kSolvers) {
        Crowd with(solver, {vec3(0), vec3(3, 0, 0)}, {});
        Crowd alone(solver, {vec3(0), vec3(3, 0, 0)}, {});
        for (int step = 0; step < 60; ++step) {
            with.shedder->step(kDt, kFar);
            alone.world->step(kDt);
        }
        const auto got = with.states(1);
        std::vector<BodyState> expected(with.bodies);
        alone.world->getBodies(alone.world->dolls()[1], expected);
        for (std::size_t i = 0; i < got.size(); ++i)
            CHECK(got[i].worldFromBody.translation == expected[i].worldFromBody.translation);
        CHECK(with.shedder->switches() == 0);
    }
}

TEST_CASE("a far doll freezes and goes on when it is near again as if nothing had been") {
    for (const auto solver : kSolvers) {
        ShedSettings settings;
        settings.frozenFrom = 20.0F;
        Crowd crowd(solver, {vec3(0)}, settings);
        for (int step = 0; step < 15; ++step)
            crowd.shedder->step(kDt, kNear);
        const auto before = crowd.states(0);
        const auto shown = crowd.shown(0);
        for (int step = 0; step < 30; ++step)
            crowd.shedder->step(kDt, kFar);
        CHECK(crowd.shedder->measuresOf(0).frozen);
        CHECK(crowd.shedder->still(0));
        CHECK(crowd.world->dolls().size() == 0);
        CHECK(farthest(crowd.shown(0), shown) == 0.0F);
        crowd.shedder->step(kDt, kNear);
        CHECK_FALSE(crowd.shedder->measuresOf(0).frozen);
        CHECK(farthest(crowd.shown(0), shown) < 1.05F * reach(before, kDt) + 0.002F);
        const auto after = crowd.states(0);
        CHECK(glm::distance(after[0].linearVelocity, before[0].linearVelocity) < 0.6F);  // gravity's step and joints
        CHECK(after[0].linearVelocity.y < -1.0F);
    }
}

TEST_CASE("a measure ends only when the doll has come nearer by the hysteresis") {
    ShedSettings settings;
    settings.frozenFrom = 20.0F;
    settings.hysteresis = 0.2F;
    Crowd crowd(physics::SolverKind::crowd, {vec3(0)}, settings);
    const auto at = [&](float metres) {
        crowd.shedder->step(kDt, crowd.shown(0)[0].translation + vec3(0, 0, metres));
        return crowd.shedder->measuresOf(0).frozen;
    };
    CHECK_FALSE(at(19.9F));
    CHECK(at(20.1F));
    for (int i = 0; i < 20; ++i) {
        CHECK(at(19.5F));
        CHECK(at(20.5F));
    }
    CHECK(at(16.1F));
    CHECK_FALSE(at(15.9F));
    CHECK_FALSE(at(19.0F));
    CHECK(crowd.shedder->switches() == 2);
}

TEST_CASE("merging bodies and back shows no jump in the pose and none in the speed") {
    for (const auto solver : kSolvers) {
        for (const auto level : {physics::LodLevel::limbs, physics::LodLevel::block}) {
            ShedSettings settings;
            settings.lodFrom = 20.0F;
            settings.lodLevel = level;
            Crowd crowd(solver, {vec3(0)}, settings);
            bool merged = false;
            for (int step = 0; step < 90; ++step) {
                // Twelve steps near, twelve far: while it falls, lands and rolls.
                const vec3 eye = step / 12 % 2 == 0 ? kNear : kFar;
                const auto before = crowd.states(0);
                const auto pose = crowd.pose(0);
                crowd.shedder->step(kDt, eye);
                const auto after = crowd.states(0);
                if (crowd.shedder->measuresOf(0).lod == merged) continue;
                merged = !merged;
                INFO("step " << step << ", level " << static_cast<int>(level));
                // A step's own motion, which may be a landing, and what the ground adds that pushes out what lay closer
                // than the other shapes.
                const float moved = std::max(reach(before, kDt), reach(after, kDt));
                CHECK(farthest(crowd.pose(0), pose) < 1.5F * moved + 0.13F);
                CHECK(glm::distance(after[0].linearVelocity, before[0].linearVelocity) <
                      1.0F + 0.75F * glm::length(before[0].linearVelocity));
            }
            CHECK(crowd.shedder->switches() == 7);
        }
    }
}

TEST_CASE("a slow doll falls as fast as the others and is drawn at every step") {
    for (const auto solver : kSolvers) {
        for (const int every : {2, 3}) {
            ShedSettings settings;
            settings.slowFrom = 20.0F;
            settings.slowEvery = every;
            Crowd crowd(solver, {vec3(0), vec3(0, 0, 60)}, settings, false, 6.0F);
            float last = crowd.shown(1)[0].translation.y;
            const float start = last;
            for (int step = 0; step < 42; ++step) {
                crowd.shedder->step(kDt, kNear);
                const float now = crowd.shown(1)[0].translation.y;
                CHECK(now < last);
                last = now;
            }
            CHECK(crowd.shedder->measuresOf(1).slow);
            CHECK_FALSE(crowd.shedder->measuresOf(0).slow);
            CHECK(crowd.world->dolls().size() == 1);
            const float fallen = start - last;
            CHECK(fallen == Approx(0.5F * 9.81F * 0.7F * 0.7F).epsilon(0.06));
            const float other = start - crowd.shown(0)[0].translation.y;
            CHECK(fallen == Approx(other).margin(0.15F));
            // Near again: it goes on from where it is drawn.
            const auto pose = crowd.pose(1);
            const auto states = crowd.states(1);
            crowd.shedder->step(kDt, vec3(0, 1, 60));
            CHECK_FALSE(crowd.shedder->measuresOf(1).slow);
            CHECK(farthest(crowd.pose(1), pose) < 1.3F * reach(states, kDt) + 0.01F);
        }
    }
}

TEST_CASE("a slow doll's long step has the substeps of one ordinary step") {
    // n substeps of a fall from rest reach (n + 1) / n times as far as it should.
    const auto substepsOf = [](const Crowd& crowd, float before, float seconds) {
        const float right = 0.5F * 9.81F * seconds * seconds;
        return 1.0F / ((before - crowd.states(0)[0].worldFromBody.translation.y) / right - 1.0F);
    };
    Crowd usual(physics::SolverKind::crowd, {vec3(0, 5, 0)}, {});
    const float height = usual.states(0)[0].worldFromBody.translation.y;
    usual.shedder->step(kDt, kFar);
    const float expected = substepsOf(usual, height, kDt);
    CHECK(expected > 0.9F);
    for (const int every : {2, 4}) {
        ShedSettings settings;
        settings.slowFrom = 20.0F;
        settings.slowEvery = every;
        Crowd slow(physics::SolverKind::crowd, {vec3(0, 5, 0)}, settings);
        slow.shedder->step(kDt, kFar);
        REQUIRE(slow.shedder->measuresOf(0).slow);
        CHECK(substepsOf(slow, height, static_cast<float>(every) * kDt) == Approx(expected).epsilon(0.02));
    }
}

TEST_CASE("dolls that are apart pass through each other and still land on the floor") {
    for (const auto solver : kSolvers) {
        for (const bool apart : {false, true}) {
            ShedSettings settings;
            if (apart) settings.apartFrom = 20.0F;
            Crowd crowd(solver, {vec3(0), vec3(0, 1.2F, 0)}, settings);
            for (int step = 0; step < 180; ++step)
                crowd.shedder->step(kDt, kFar);
            float highest = 0;
            for (const RigidTransform& body : crowd.shown(1))
                highest = std::max(highest, body.translation.y);
            float lowest = 1;
            for (int doll : {0, 1}) {
                for (const RigidTransform& body : crowd.shown(doll))
                    lowest = std::min(lowest, body.translation.y);
            }
            CHECK(lowest > 0.0F);
            INFO(apart << " highest " << highest);
            const float centre = glm::distance(crowd.shown(0)[0].translation, crowd.shown(1)[0].translation);
            if (apart) CHECK(centre < 0.6F);
            CHECK(crowd.shedder->counts().apart == (apart ? 2 : 0));
        }
    }
}

TEST_CASE("what sleeps or is dragged is left as it is") {
    ShedSettings settings;
    settings.frozenFrom = 20.0F;
    settings.lodFrom = 20.0F;
    Crowd crowd(physics::SolverKind::crowd, {vec3(0), vec3(4, 0, 0)}, settings, true);
    const physics::DragId pull = crowd.world->addDrag({crowd.world->dolls()[1], 0, {0, 0, 0}, {4, 1.5F, 0}, 1500.0F});
    for (int step = 0; step < 600 && !crowd.world->isAsleep(crowd.world->dolls()[0]); ++step)
        crowd.shedder->step(kDt, kNear);
    REQUIRE(crowd.world->isAsleep(crowd.world->dolls()[0]));
    for (int step = 0; step < 10; ++step)
        crowd.shedder->step(kDt, kFar);
    CHECK(crowd.shedder->switches() == 0);
    CHECK(crowd.shedder->still(0));
    crowd.world->removeDrag(pull);
    crowd.shedder->step(kDt, kFar);
    CHECK(crowd.shedder->measuresOf(1).frozen);
    CHECK_FALSE(crowd.shedder->measuresOf(0).frozen);
}

TEST_CASE("measures are taken together and every doll keeps its own state") {
    for (const auto solver : kSolvers) {
        ShedSettings settings;
        settings.lodFrom = 10.0F;
        settings.slowFrom = 20.0F;
        settings.frozenFrom = 40.0F;
        std::vector<vec3> places;
        for (int i = 0; i < 12; ++i)
            places.emplace_back(0, 0, 5.0F * static_cast<float>(i));
        Crowd crowd(solver, places, settings);
        for (int step = 0; step < 120; ++step) {
            crowd.shedder->step(kDt, vec3(0, 1, 0.5F * static_cast<float>(step)));
            for (int doll = 0; doll < 12; ++doll) {
                // No doll has taken another's place.
                CHECK(std::abs(crowd.shown(doll)[0].translation.z - places[doll].z) < 2.0F);
            }
        }
        const auto counts = crowd.shedder->counts();
        CHECK(counts.lod > counts.slow);
        CHECK(counts.slow > counts.frozen);
        CHECK(counts.frozen > 0);
        CHECK(crowd.shedder->switches() > 12);
    }
}
