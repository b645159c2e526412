#include <cmath>
#include <limits>

#include "physics/world/hand_over.hpp"
#include "support/catch.hpp"
#include "world_table.hpp"

using namespace lutka;
using namespace lutka::test;
using physics::BodyState;
using physics::DollId;
using physics::SolverKind;

namespace {

const float kNan = std::numeric_limits<float>::quiet_NaN();
const float kInfinity = std::numeric_limits<float>::infinity();

// Keeps what a world says about refused calls.
struct Refused {
    explicit Refused(physics::World& world) {
        world.setRefusalSink([this](std::string_view message) { messages.emplace_back(message); });
    }
    std::vector<std::string> messages;
};

}  // namespace

TEST_CASE("ids stay what they are when others go and a stale one is refused in every call") {
    const auto rod = rodProfile(0.2F, 0.05F);
    for (const SolverKind solver : kAllSolvers) {
        INFO(physics::solverName(solver));
        const auto world = worldOf(solver);
        Refused refused(*world);
        DollId dolls[3];
        for (int i = 0; i < 3; ++i)
            dolls[i] = world->addDoll(rod, std::vector{stateAt({static_cast<float>(i), 1, 0})});
        world->removeDoll(dolls[0]);
        std::vector<BodyState> bodies(1);
        world->getBodies(dolls[2], bodies);
        CHECK(bodies[0].worldFromBody.translation.x == 2.0F);
        CHECK(world->rayTest({2, 1, -1}, {2, 1, 1})->doll == dolls[2]);
        const DollId fresh = world->addDoll(rod, std::vector{stateAt({7, 1, 0})});
        CHECK(fresh.index == dolls[0].index);
        CHECK_FALSE(fresh == dolls[0]);
        REQUIRE(refused.messages.empty());

        const auto isRefused = [&](const auto& call) {
            const std::size_t before = refused.messages.size();
            call();
            return refused.messages.size() == before + 1;
        };
        const DollId stale = dolls[0];
        bodies[0].worldFromBody.translation.x = -5.0F;
        CHECK(isRefused([&] { world->getBodies(stale, bodies); }));
        CHECK(bodies[0].worldFromBody.translation.x == -5.0F);
        CHECK(isRefused([&] { world->setBodies(stale, bodies); }));
        CHECK(isRefused([&] { CHECK(world->profileOf(stale).bodies.empty()); }));
        CHECK(isRefused([&] { CHECK(world->inertiaOf(stale, 0) == vec3(0)); }));
        CHECK(isRefused([&] { CHECK_FALSE(world->isAsleep(stale)); }));
        CHECK(isRefused([&] { world->wake(stale); }));
        CHECK(isRefused([&] { CHECK(world->dollState(stale).bodies.empty()); }));
        CHECK(isRefused([&] { world->setDollState(stale, {}); }));
        CHECK(isRefused([&] { world->applyImpulse(stale, 0, vec3(1), vec3(0)); }));
        CHECK(isRefused([&] { world->applyForce(stale, 0, vec3(1), vec3(0)); }));
        CHECK(isRefused([&] { world->setMotor(stale, 0, {}); }));
        CHECK(isRefused([&] { world->setDollFilter(stale, {}); }));
        CHECK(isRefused([&] { CHECK_FALSE(world->addDrag({stale, 0}).isSet()); }));
        CHECK(isRefused([&] { world->removeDoll(stale); }));
        CHECK(isRefused([&] { world->removeDoll({}); }));
        CHECK(isRefused([&] { world->removeProp({}); }));
        CHECK(isRefused([&] { world->removeStatic({}); }));
        CHECK(isRefused([&] { world->removeDrag({}); }));
        CHECK(refused.messages.front().find("World::getBodies") != std::string::npos);
        CHECK(world->refusals() == static_cast<int>(refused.messages.size()));
        world->getBodies(fresh, bodies);
        CHECK(bodies[0].worldFromBody.translation.x == 7.0F);
    }
}

TEST_CASE("numbers that are not finite or out of range are refused and change nothing") {
    const auto rod = rodProfile(0.2F, 0.05F);
    for (const SolverKind solver : kAllSolvers) {
        INFO(physics::solverName(solver));
        const auto world = worldOf(solver);
        Refused refused(*world);
        const auto at = [](float x) { return std::vector{stateAt({x, 1, 0})}; };
        const DollId doll = world->addDoll(rod, at(0));
        REQUIRE(doll.isSet());
        CHECK_FALSE(world->addDoll(rod, at(kNan)).isSet());
        CHECK_FALSE(world->addDoll(rod, at(kInfinity)).isSet());
        CHECK_FALSE(world->addDoll(rod, std::vector<BodyState>(2)).isSet());
        CHECK_FALSE(world->addDoll(physics::RagdollProfile{}, {}).isSet());
        physics::DynamicProp prop;
        prop.massKg = kNan;
        CHECK_FALSE(world->addProp(prop).isSet());
        physics::StaticShape floor;
        floor.worldFromShape.translation.y = kNan;
        CHECK_FALSE(world->addStatic(floor).isSet());
        world->setBodies(doll, at(kNan));
        world->setBodies(doll, {});
        world->applyImpulse(doll, 0, vec3(kNan), vec3(0));
        world->applyImpulse(doll, 1, vec3(1), vec3(0));
        world->applyImpulse(doll, -1, vec3(1), vec3(0));
        world->applyForce(doll, 0, vec3(0), vec3(kInfinity));
        world->setMotor(doll, 0, physics::JointMotor{});
        CHECK_FALSE(world->addDrag({doll, 3}).isSet());
        CHECK_FALSE(world->addDrag({doll, 0, vec3(kNan)}).isSet());
        CHECK_FALSE(world->rayTest(vec3(kNan), vec3(0)));
        world->setSubsteps(0);
        world->step(kNan);
        world->step(0.0F);
        world->step(-1.0F);
        CHECK(world->refusals() == 20);
        CHECK(world->dolls().size() == 1);
        CHECK(world->props().empty());
        CHECK(world->statics().empty());
        CHECK(bodyOfDoll(*world, 0).worldFromBody.translation == vec3(0, 1, 0));
        CHECK(bodyOfDoll(*world, 0).linearVelocity == vec3(0));
        world->step(kFrame);
        CHECK(bodyOfDoll(*world, 0).worldFromBody.translation.y < 1.0F);
    }
}

TEST_CASE("moving a doll leaves its old ids of nothing and gives new ones for its drags") {
    const auto rod = rodProfile(0.2F, 0.05F);
    const auto from = worldOf(SolverKind::bullet);
    const auto to = worldOf(SolverKind::crowd);
    const DollId doll = from->addDoll(rod, std::vector{stateAt({0, 1, 0})});
    const physics::DragId drag = from->addDrag({doll, 0, vec3(0), {0, 2, 0}, 77.0F});
    const physics::MovedDoll moved = physics::moveDoll(*from, doll, *to);
    CHECK_FALSE(from->has(doll));
    CHECK_FALSE(from->has(drag));
    REQUIRE(moved.drags.size() == 1);
    CHECK(to->dragOf(moved.drags[0]).maxForceN == 77.0F);
    CHECK(to->dragOf(moved.drags[0]).doll == moved.doll);
}
