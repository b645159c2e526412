#include <glm/gtc/quaternion.hpp>

#include "support/catch.hpp"
#include "support/dolls.hpp"
#include "world_table.hpp"

using namespace lutka;
using namespace lutka::test;
using physics::SolverKind;

namespace {

physics::DynamicProp crateAt(const vec3& halfExtents, const vec3& position, const quat& turn = {1, 0, 0, 0}) {
    physics::DynamicProp crate;
    crate.shape.kind = physics::BodyShape::Kind::box;
    crate.shape.halfExtents = halfExtents;
    crate.massKg = 8.0F;
    crate.state.worldFromBody = {turn, position};
    return crate;
}

}  // namespace

// Where only edges meet: no corner of either box is in the other.
TEST_CASE("a crate that falls across a beam stays on it") {
    for (const SolverKind solver : kAllSolvers) {
        INFO(physics::solverName(solver));
        const auto world = worldOf(solver, {});
        CHECK(world->addStatic({}).isSet());
        CHECK(world->addStatic(staticBoxAt({0, 0.5F, 0}, {0.05F, 0.5F, 2})).isSet());
        const auto crate = world->addProp(crateAt({0.4F, 0.1F, 0.3F}, {0, 1.4F, 0}));
        stepSeconds(*world, 3.0F);
        const RigidTransform place = world->propState(crate).worldFromBody;
        CHECK(place.translation.y == Approx(1.1F).margin(0.005));
        CHECK((place.rotation * vec3(0, 1, 0)).y > 0.99F);
    }
}

TEST_CASE("crates that fall on each other's edges crosswise rest on one another") {
    const quat across = glm::angleAxis(kPi / 2, vec3(0, 1, 0));
    for (const SolverKind solver : kAllSolvers) {
        INFO(physics::solverName(solver));
        const auto world = worldOf(solver, {});
        CHECK(world->addStatic({}).isSet());
        const auto lower = world->addProp(crateAt({0.6F, 0.1F, 0.1F}, {0, 0.1F, 0}));
        const auto upper = world->addProp(crateAt({0.6F, 0.1F, 0.1F}, {0, 0.5F, 0}, across));
        stepSeconds(*world, 3.0F);
        CHECK(world->propState(lower).worldFromBody.translation.y == Approx(0.1F).margin(0.005));
        CHECK(world->propState(upper).worldFromBody.translation.y == Approx(0.3F).margin(0.005));
    }
}
