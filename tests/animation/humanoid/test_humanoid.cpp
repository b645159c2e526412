#include "animation/humanoid/map_humanoid.hpp"
#include "rig_variations.hpp"
#include "support/catch.hpp"
#include "support/rigs.hpp"

namespace lutka::test {

using animation::HumanoidMap;
using animation::mapHumanoid;

namespace {

void requireSameJoints(const HumanoidMap& map, const HumanoidMap& truth) {
    REQUIRE(map.humanoid);
    for (int index = 0; index < animation::kRoleCount; ++index) {
        const animation::Role role = animation::roleAt(index);
        INFO(animation::roleName(role));
        CHECK(map.jointOf(role) == truth.jointOf(role));
    }
}

}  // namespace

TEST_CASE("the hand-made biped maps to itself with and without names") {
    const animation::Character biped = makeBiped();
    const HumanoidMap truth = mapOfBiped(biped);
    requireSameJoints(mapHumanoid(biped), truth);
    requireSameJoints(mapHumanoid(withoutNames(biped)), truth);
}

}  // namespace lutka::test
