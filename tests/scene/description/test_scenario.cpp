#include "scene/description/scenario.hpp"

#include <glm/geometric.hpp>

#include "scene/asset/body_bounds.hpp"
#include "support/catch.hpp"
#include "support/ragdolls.hpp"

using namespace lutka;
using namespace lutka::scene;

namespace {

Scenario make(const RagdollAsset& asset, std::string_view name, int count = 1, std::uint64_t seed = 0) {
    auto scenario = makeScenario({.name = name, .count = count, .seed = seed}, asset);
    REQUIRE(scenario);
    return std::move(scenario).value();
}

// Lowest point of any body of a doll as it is placed.
float lowestPoint(const RagdollAsset& asset, const Placement& placement) {
    float lowest = 1e9F;
    for (std::size_t body = 0; body < asset.profile.bodies.size(); ++body) {
        const RigidTransform world = placement.worldFromModel * asset.rig.bindModelFromBody[body];
        lowest = std::min(lowest, world.translation.y - halfAabbOf(asset.profile.bodies[body].shape, world.rotation).y);
    }
    return lowest;
}

bool sameStart(const Scenario& a, const Scenario& b) {
    for (std::size_t i = 0; i < a.dolls.size(); ++i) {
        const Placement& p = a.dolls[i];
        const Placement& q = b.dolls[i];
        if (p.worldFromModel.translation != q.worldFromModel.translation || p.linearVelocity != q.linearVelocity ||
            p.worldFromModel.rotation != q.worldFromModel.rotation || p.angularVelocity != q.angularVelocity) {
            return false;
        }
    }
    return a.dolls.size() == b.dolls.size();
}

}  // namespace

TEST_CASE("every scene of the registry has its dolls above the ground and something to fall on") {
    const auto asset = test::bipedRagdoll();
    for (const ScenarioInfo& info : scenarioRegistry()) {
        INFO(info.name);
        const Scenario scenario = make(*asset, info.name, 3, 7);
        CHECK(scenario.dolls.size() == 3);
        CHECK_FALSE(scenario.statics.empty());
        for (const Placement& doll : scenario.dolls)
            CHECK(lowestPoint(*asset, doll) > 0.0F);
    }
}

TEST_CASE("a figure that stands with its legs wide apart starts above the ground as well") {
    const auto asset = test::bipedRagdoll();
    auto bounds = figureBounds(asset->profile, asset->rig);
    CHECK(bounds.stance > 0.1F);
    CHECK(bounds.stance < 0.5F);
    bounds.stance = 0.75F;
    const auto clearance = [&](const FigureBounds& figure, std::string_view scene, std::uint64_t seed) {
        const auto scenario = makeScenario({.name = scene, .seed = seed}, Figure{figure});
        REQUIRE(scenario);
        // Where a sole as far out as that comes, whichever way it points.
        const RigidTransform& world = scenario.value().dolls[0].worldFromModel;
        const vec3 down = glm::conjugate(world.rotation) * vec3(0, -1, 0);
        const vec3 out = glm::normalize(vec3(down.x, 0, down.z) + vec3(1e-6F, 0, 0));
        return (world * (vec3(0, figure.low.y, 0) + figure.stance * out)).y;
    };
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        INFO(seed);
        CHECK(clearance(bounds, "balls", seed) > 0.0F);
        CHECK(clearance(bounds, "stairs", seed) > 12 * 0.17F);  // on the topmost step
    }
}

TEST_CASE("drop hangs the soles one metre above the floor, leaning by four degrees for seed 0") {
    const auto asset = test::bipedRagdoll();
    const Scenario scenario = make(*asset, "drop");
    CHECK(lowestPoint(*asset, scenario.dolls[0]) == Approx(1.0F).margin(0.02));  // the lean lowers one sole
    const quat standing = scenario.dolls[0].worldFromModel.rotation * glm::conjugate(asset->profile.standardFromModel);
    CHECK(glm::length(rotationVector(standing)) == Approx(4.0F * kPi / 180.0F).margin(1e-4));
}

TEST_CASE("the same seed gives the same start and another seed another one") {
    const auto asset = test::bipedRagdoll();
    for (const ScenarioInfo& info : scenarioRegistry()) {
        INFO(info.name);
        CHECK(sameStart(make(*asset, info.name, 4, 5), make(*asset, info.name, 4, 5)));
        CHECK_FALSE(sameStart(make(*asset, info.name, 4, 5), make(*asset, info.name, 4, 6)));
    }
}

TEST_CASE("with seed 0, too, no two dolls of a scene fall in step") {
    const auto asset = test::bipedRagdoll();
    for (const std::string_view name : {"drop", "ramp", "hang", "balls", "stairs", "throw"}) {
        INFO(name);
        const auto dolls = make(*asset, name, 4, 0).dolls;
        CHECK(dolls[0].worldFromModel.rotation == make(*asset, name, 1, 0).dolls[0].worldFromModel.rotation);
        for (std::size_t i = 1; i < dolls.size(); ++i)
            CHECK(dolls[i].worldFromModel.rotation != dolls[i - 1].worldFromModel.rotation);
    }
}

TEST_CASE("a figure that faces elsewhere in its file stands the same way in a scene") {
    const FigureBounds figure{{-0.8F, 0, -0.1F}, {0.8F, 1.75F, 0.1F}};
    const quat turned = glm::angleAxis(1.0F, vec3(0, 1, 0));
    const auto straight = makeScenario({.name = "drop"}, Figure{figure});
    const auto other = makeScenario({.name = "drop"}, Figure{figure, turned});
    REQUIRE(straight);
    REQUIRE(other);
    const vec3 point(0.2F, 1.0F, 0.1F);  // in the standard stance
    const vec3 a = straight.value().dolls[0].worldFromModel * point;
    const vec3 b = other.value().dolls[0].worldFromModel * (glm::conjugate(turned) * point);
    CHECK(glm::distance(a, b) < 1e-5F);
}

TEST_CASE("an unknown scene and an absurd count are usage errors that list what there is") {
    const FigureBounds figure{vec3(-1), vec3(1)};
    const auto unknown = makeScenario({.name = "dropp"}, Figure{figure});
    REQUIRE_FALSE(unknown);
    CHECK(unknown.error().code == ErrorCode::usage);
    CHECK(unknown.error().mend.find("drop, spread") != std::string::npos);
    CHECK_FALSE(makeScenario({.name = "drop", .count = 0}, Figure{figure}));
    CHECK_FALSE(makeScenario({.name = "drop", .count = 10001}, Figure{figure}));
}

TEST_CASE("a creature four metres long is thrown clear of floor and wall, however it is turned") {
    const Figure figure{{{-0.4F, 0, -2}, {0.4F, 2, 2}}};
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const auto scenario = makeScenario({.name = "throw", .seed = seed}, figure);
        REQUIRE(scenario);
        const RigidTransform& world = scenario.value().dolls.front().worldFromModel;
        for (int corner = 0; corner < 8; ++corner) {
            const vec3 at = world * vec3((corner & 1) != 0 ? 0.4F : -0.4F, (corner & 2) != 0 ? 2.0F : 0.0F,
                                         (corner & 4) != 0 ? 2.0F : -2.0F);
            CHECK(at.y > 0.0F);
            CHECK(at.z < 1.975F);
        }
    }
}
