#include "physics/world/hand_over.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "scene/description/scenario.hpp"
#include "support/catch.hpp"
#include "support/dolls.hpp"
#include "support/rigs.hpp"
#include "world_table.hpp"

using namespace lutka;
using namespace lutka::test;
using physics::BodyState;
using physics::RagdollProfile;
using physics::SolverKind;
using physics::World;

namespace {

// A scene of the registry with the hand-made doll; pins are drags of one number more than the doll's.
struct Staged {
    scene::Scenario scenario;
    std::unique_ptr<World> world;
};

std::unique_ptr<World> stage(const scene::Scenario& scenario, SolverKind solver) {
    auto world = worldOf(solver);
    for (const physics::StaticShape& shape : scenario.statics)
        world->addStatic(shape);
    for (const physics::DynamicProp& prop : scenario.props)
        world->addProp(prop);
    return world;
}

scene::Scenario sceneOf(const std::string& name, const RagdollProfile& profile, std::uint64_t seed) {
    static const animation::Skeleton skeleton = makeBiped().skeleton;
    const auto rig = physics::bindRig(profile, skeleton);
    REQUIRE(rig.ok());
    auto made =
        scene::makeScenario({.name = name, .seed = seed},
                            scene::Figure{scene::figureBounds(profile, rig.value()), profile.standardFromModel});
    REQUIRE(made.ok());
    return std::move(made).value();
}

void addDolls(World& world, const scene::Scenario& scenario, const RagdollProfile& profile) {
    static const animation::Skeleton skeleton = makeBiped().skeleton;
    const auto rig = physics::bindRig(profile, skeleton);
    for (const scene::Placement& placement : scenario.dolls) {
        std::vector<BodyState> bodies(profile.bodies.size());
        bodiesFromPose(rig.value(), skeleton.bindModelFromJoint, placement.worldFromModel, bodies);
        for (BodyState& body : bodies)
            body.linearVelocity = placement.linearVelocity;
        world.addDoll(profile, bodies);
    }
    for (const scene::Pin& pin : scenario.pins) {
        const int body = physics::bodyNamed(profile, pin.body);
        world.addDrag({world.dolls()[pin.doll], body, vec3(0),
                       bodyOfDoll(world, pin.doll, body).worldFromBody.translation, 5000.0F});
    }
}

std::vector<std::string> sceneNames() {
    std::vector<std::string> names;
    for (const scene::ScenarioInfo& info : scene::scenarioRegistry())
        names.emplace_back(info.name);
    return names;
}

}  // namespace

TEST_CASE("a doll moves between the solvers in every scene without a jump and stays within bounds") {
    const RagdollProfile profile = makeDoll();
    for (const std::string& name : sceneNames()) {
        const scene::Scenario scenario = sceneOf(name, profile, 3);
        const std::unique_ptr<World> worlds[2] = {stage(scenario, SolverKind::bullet),
                                                  stage(scenario, SolverKind::crowd)};
        addDolls(*worlds[0], scenario, profile);
        int at = 0;
        double time = 0;
        float worstStep = 0;
        physics::QualityMeter* meter = nullptr;
        std::unique_ptr<physics::QualityMeter> meters[2];
        float separation = 0;
        float penetration = 0;
        std::int64_t broken = 0;
        for (int step = 0; step < 240; ++step) {
            INFO(name << ", step " << step);
            const auto before = bodiesOfDoll(*worlds[at], 0);
            if (step % 7 == 3) {  // at no particular moment
                const bool asleep = worlds[at]->isAsleep(worlds[at]->dolls()[0]);
                const auto drags = worlds[at]->dragsOf(worlds[at]->dolls()[0]);
                const physics::MovedDoll moved =
                    physics::moveDoll(*worlds[at], worlds[at]->dolls()[0], *worlds[1 - at]);
                CHECK(moved.doll == worlds[1 - at]->dolls()[0]);
                CHECK(moved.drags == worlds[1 - at]->dragsOf(moved.doll));
                at = 1 - at;
                const auto after = bodiesOfDoll(*worlds[at], 0);
                for (std::size_t i = 0; i < after.size(); ++i) {
                    CHECK(glm::distance(after[i].worldFromBody.translation, before[i].worldFromBody.translation) <
                          1e-6F);
                    CHECK(std::abs(glm::dot(after[i].worldFromBody.rotation, before[i].worldFromBody.rotation)) >
                          0.999999F);
                    CHECK(glm::distance(after[i].linearVelocity, before[i].linearVelocity) < 1e-5F);
                    CHECK(glm::distance(after[i].angularVelocity, before[i].angularVelocity) < 1e-4F);
                }
                CHECK(worlds[at]->isAsleep(worlds[at]->dolls()[0]) == asleep);
                CHECK(worlds[at]->dragsOf(worlds[at]->dolls()[0]).size() == drags.size());
                CHECK(worlds[1 - at]->dolls().empty());
                meters[at] = std::make_unique<physics::QualityMeter>(*worlds[at], scenario.statics, vec3(0, -9.81F, 0));
                meter = meters[at].get();
            }
            for (int side = 0; side < 2; ++side) {
                const double substep = static_cast<double>(kFrame) / worlds[side]->substepsPerStep();
                worlds[side]->step(kFrame, [&] {
                    if (side == at && meter != nullptr) meter->sample(time += substep);
                });
            }
            // Bodies move as far as their speeds say: nothing jumps.
            const auto after = bodiesOfDoll(*worlds[at], 0);
            for (std::size_t i = 0; i < after.size(); ++i) {
                const float speed =
                    std::max(glm::length(before[i].linearVelocity), glm::length(after[i].linearVelocity));
                const float moved =
                    glm::distance(after[i].worldFromBody.translation, before[i].worldFromBody.translation);
                worstStep = std::max(worstStep, moved - speed * kFrame);
            }
            if (meter != nullptr) {
                const physics::Quality quality = meter->result();
                separation = std::max(separation, quality.jointSeparationM.max);
                penetration = std::max(penetration, quality.floorPenetrationM);
                broken += quality.nonFinite;
            }
        }
        INFO(name);
        CHECK(worstStep < 0.04F);
        CHECK(separation < 0.012F);
        CHECK(penetration < 0.020F);
        CHECK(broken == 0);
    }
}

TEST_CASE("a doll that sleeps moves on asleep, with its motors and its filter, and can be woken there") {
    const RagdollProfile profile = makeDoll();
    for (const SolverKind first : kAllSolvers) {
        for (const SolverKind second : kAllSolvers) {
            INFO(physics::solverName(first) << " to " << physics::solverName(second));
            const auto from = worldOf(first);
            const auto to = worldOf(second);
            for (World* world : {from.get(), to.get()})
                world->addStatic({});
            from->addDoll(profile, standingDoll(profile, {0, 0.02F, 0}, glm::angleAxis(1.4F, vec3(1, 0, 0))));
            physics::DollState state = from->dollState(from->dolls()[0]);
            for (BodyState& body : state.bodies)
                body.worldFromBody.translation.y += 0.5F;
            state.asleep = true;
            state.filter = {2, ~8U};
            physics::JointMotor motor;
            motor.stiffness = 12.0F;
            state.motors[4] = motor;
            from->setDollState(from->dolls()[0], state);
            REQUIRE(from->isAsleep(from->dolls()[0]));
            physics::moveDoll(*from, from->dolls()[0], *to);
            CHECK(to->isAsleep(to->dolls()[0]));
            CHECK(to->dollFilter(to->dolls()[0]) == state.filter);
            REQUIRE(to->dollState(to->dolls()[0]).motors[4]);
            CHECK(to->dollState(to->dolls()[0]).motors[4]->stiffness == 12.0F);
            CHECK_FALSE(to->dollState(to->dolls()[0]).motors[3]);
            const auto hung = bodiesOfDoll(*to, 0);
            stepSeconds(*to, 0.5F);
            CHECK(bodiesOfDoll(*to, 0)[0].worldFromBody.translation == hung[0].worldFromBody.translation);
            to->wake(to->dolls()[0]);
            stepSeconds(*to, 0.5F);
            CHECK(bodiesOfDoll(*to, 0)[0].worldFromBody.translation.y < hung[0].worldFromBody.translation.y - 0.2F);
        }
    }
}

TEST_CASE("the crowd agrees with the reference world on all scenes") {
    const RagdollProfile profile = makeDoll();
    for (const std::string& name : sceneNames()) {
        float height[2] = {};
        physics::Quality worst[2];
        constexpr int kSeeds = 3;
        for (int side = 0; side < 2; ++side) {
            for (int seed = 1; seed <= kSeeds; ++seed) {
                const scene::Scenario scenario = sceneOf(name, profile, seed);
                const auto world = stage(scenario, kOurSolvers[side]);
                addDolls(*world, scenario, profile);
                const physics::Quality quality = measureSeconds(*world, scenario.statics, 3.5F);
                auto& most = worst[side];
                most.nonFinite += quality.nonFinite;
                most.jointSeparationM.max = std::max(most.jointSeparationM.max, quality.jointSeparationM.max);
                most.jointSeparationM.p99 = std::max(most.jointSeparationM.p99, quality.jointSeparationM.p99);
                most.limitViolationDeg.p99 = std::max(most.limitViolationDeg.p99, quality.limitViolationDeg.p99);
                most.floorPenetrationM = std::max(most.floorPenetrationM, quality.floorPenetrationM);
                for (const BodyState& body : bodiesOfDoll(*world, 0))
                    height[side] +=
                        body.worldFromBody.translation.y / static_cast<float>(kSeeds * profile.bodies.size());
            }
        }
        INFO(name << ": separation " << worst[0].jointSeparationM.max << ' ' << worst[1].jointSeparationM.max
                  << ", limits " << worst[0].limitViolationDeg.p99 << ' ' << worst[1].limitViolationDeg.p99
                  << ", static " << worst[0].floorPenetrationM << ' ' << worst[1].floorPenetrationM);
        for (const physics::Quality& quality : worst)
            CHECK(quality.nonFinite == 0);
        // How a doll falls is chance, how high the one that lies is, is not; on stairs and ramps it is where it
        // stopped.
        const float slope = name == "stairs" || name == "ramp" ? 0.6F : 0.08F;
        CHECK(height[1] == Approx(height[0]).margin(slope));
        CHECK(worst[1].jointSeparationM.max < 0.004F);
        CHECK(worst[1].jointSeparationM.p99 < worst[0].jointSeparationM.p99 + 0.001F);
        CHECK(worst[1].limitViolationDeg.p99 < worst[0].limitViolationDeg.p99 + 2.0F);
        CHECK(worst[1].floorPenetrationM < std::max(worst[0].floorPenetrationM, 0.010F));
    }
}
