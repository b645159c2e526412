#include "scene/description/free_places.hpp"

#include <cmath>

#include "physics/world/doll_overlap.hpp"
#include "scene/description/scenario.hpp"
#include "support/catch.hpp"
#include "support/ragdolls.hpp"

using namespace lutka;
using namespace lutka::scene;

namespace {

// How deep any two of a scene's figures lie in each other where they start, metres, from the placements.
float deepestStart(const RagdollAsset& asset, const Scenario& scenario) {
    physics::DollOverlap overlap;
    for (std::size_t doll = 0; doll < scenario.dolls.size(); ++doll) {
        for (std::size_t body = 0; body < asset.profile.bodies.size(); ++body)
            overlap.add(static_cast<int>(doll), asset.profile.bodies[body].shape,
                        scenario.dolls[doll].worldFromModel * asset.rig.bindModelFromBody[body]);
    }
    overlap.depths();
    return overlap.deepest();
}

}  // namespace

TEST_CASE("a place is as deep as the figure that would lie in another there") {
    FigureBounds figure{vec3(-0.5F), vec3(0.5F)};
    physics::BodyShape ball;
    ball.kind = physics::BodyShape::Kind::sphere;
    ball.radius = 0.5F;
    figure.bodies.push_back({ball, {}});
    FreePlaces places(figure);
    const quat upright(1, 0, 0, 0);
    CHECK(places.depthAt(vec3(0), upright) == 0.0F);
    places.take(vec3(0, 2, 0), upright);
    CHECK(places.depthAt(vec3(0), upright) == 0.0F);
    CHECK(std::abs(places.depthAt(vec3(0, 1.25F, 0), upright) - 0.25F) < 1e-4F);
}

// Dolls that were turned at random beside each other started up to 14 cm deep in one another, and were thrown apart.
TEST_CASE("nobody starts inside another in a pile") {
    const auto asset = test::bipedRagdoll();
    for (const std::uint64_t seed : {1, 2, 3}) {
        const auto scenario = makeScenario({.name = "pile", .count = 50, .seed = seed}, *asset);
        REQUIRE(scenario);
        CAPTURE(seed);
        CHECK(deepestStart(*asset, scenario.value()) < 0.001F);
    }
}
