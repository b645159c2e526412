#include "scene/free_places.hpp"

#include <algorithm>
#include <cmath>

#include "physics/collision/shape.hpp"
#include "scene/scenario.hpp"
#include "support/catch.hpp"
#include "support/ragdolls.hpp"

using namespace lutka;
using namespace lutka::scene;

namespace {

// How deep any two of a scene's figures lie in each other where they start, metres: body by body, from the placements.
float deepestStart(const RagdollAsset& asset, const Scenario& scenario) {
    float deepest = 0.0F;
    const auto& bodies = asset.profile.bodies;
    const auto place = [&](std::size_t doll, std::size_t body) {
        return scenario.dolls[doll].worldFromModel * asset.rig.bindModelFromBody[body];
    };
    for (std::size_t a = 0; a < scenario.dolls.size(); ++a) {
        for (std::size_t b = a + 1; b < scenario.dolls.size(); ++b) {
            for (std::size_t i = 0; i < bodies.size(); ++i) {
                for (std::size_t k = 0; k < bodies.size(); ++k)
                    deepest = std::max(
                        deepest, -physics::distanceBetween(bodies[i].shape, place(a, i), bodies[k].shape, place(b, k)));
            }
        }
    }
    return deepest;
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
