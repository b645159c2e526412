// Free flight: nothing but the joints' own forces, which can change neither the momentum nor the angular momentum.
// bench/tumble.cpp looks at many figures; here are some.
#include "support/tumbling.hpp"

#include <glm/geometric.hpp>

#include "support/catch.hpp"
#include "support/falls.hpp"
#include "support/zoo.hpp"

using namespace lutka;

namespace {

void checkTumbling(const scene::RagdollAsset& asset) {
    for (const vec3& rate : {vec3(7, 0, 0), vec3(0, 7, 0), vec3(0, 0, 15), vec3(9, 9, 9)}) {
        CAPTURE(asset.character.name, rate.x, rate.y, rate.z);
        const auto lossOf = [&](const physics::RagdollProfile& profile) {
            return test::tumble(asset, profile, *test::emptySpace(physics::SolverKind::crowd), rate);
        };
        for (const physics::RagdollProfile& profile : {asset.profile, test::withoutContacts(asset.profile)}) {
            const test::Loss loss = lossOf(profile);
            CHECK(loss.angularMomentum < 0.001);
            CHECK(loss.growth < 0.002);
        }
        const test::Loss free = lossOf(test::withoutLosses(asset.profile));
        CHECK(free.angularMomentum < 0.001);
        CHECK(std::abs(free.energy) < 0.001);
        CHECK(free.growth < 0.001);
    }
}

}  // namespace

// It lost 9 % in two seconds, in proportion to the substep, and then still 2 % at 15 rad/s, with 5 % more energy.
TEST_CASE("a doll that tumbles at up to 15 rad/s keeps its angular momentum, and its energy where nothing takes any") {
    const auto asset = test::loadFigure(LUTKA_ASSETS_DIR "/models/mannequin.glb");
    REQUIRE(asset.ok());
    checkTumbling(*asset.value());
}

TEST_CASE("real models keep their angular momentum when they tumble") {
    NEEDS_ZOO();
    for (const char* file : {"quaternius_man_fbx/Male_Casual.fbx", "rocketbox_male/Male_Adult_17.fbx",
                             "makehuman_mixamo/makehuman_mixamo.glb", "minetest_character/character.b3d",
                             "raylib_greenman/greenman.glb", "ubiq_robot/ubiqrobot.fbx"}) {
        const auto asset = test::loadFigure(test::zooFile(file).string());
        REQUIRE(asset.ok());
        checkTumbling(*asset.value());
    }
}

// The reference solver pushes joints at arms of the substep's start: 7 % were lost at 7 rad/s, 22 % at 15.
TEST_CASE("a doll that tumbles in the reference solver keeps its angular momentum") {
    const auto asset = test::loadFigure(LUTKA_ASSETS_DIR "/models/mannequin.glb");
    REQUIRE(asset.ok());
    for (const vec3& rate : {vec3(7, 0, 0), vec3(0, 0, 15), vec3(9, 9, 9)}) {
        CAPTURE(rate.x, rate.y, rate.z);
        const auto world = test::emptySpace(physics::SolverKind::bullet);
        CHECK(test::tumble(*asset.value(), asset.value()->profile, *world, rate).angularMomentum < 0.001);
    }
}
