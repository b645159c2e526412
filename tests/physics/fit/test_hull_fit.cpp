#include "physics/fit/hull_fit.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "physics/collision/shape.hpp"
#include "physics/fit/body_tips.hpp"
#include "physics/fit/fit_ragdoll.hpp"
#include "physics/fit/rebind.hpp"
#include "support/catch.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using namespace lutka::physics;

namespace {

RagdollProfile fitted(bool hulls) {
    const auto biped = test::makeBiped();
    FitOptions options;
    options.hulls = hulls;
    Result<RagdollProfile> profile = fitRagdoll(biped, test::mapOfBiped(biped), options);
    REQUIRE(profile);
    return std::move(profile).value();
}

}  // namespace

TEST_CASE("on request every body is the hull of its skin, about its middle, along its principal axes") {
    const RagdollProfile plain = fitted(false);
    const RagdollProfile profile = fitted(true);
    CHECK(validate(profile).empty());
    REQUIRE(profile.bodies.size() == plain.bodies.size());
    for (std::size_t i = 0; i < profile.bodies.size(); ++i) {
        INFO(profile.bodies[i].name);
        CHECK(plain.bodies[i].shape.kind != BodyShape::Kind::hull);
        const BodyShape& shape = profile.bodies[i].shape;
        const bool isHand = profile.bodies[i].role == Role::leftHand || profile.bodies[i].role == Role::rightHand;
        if (isHand && shape.kind != BodyShape::Kind::hull) continue;  // the biped's have next to no skin
        REQUIRE(shape.kind == BodyShape::Kind::hull);
        CHECK(isCentred(*shape.hull));
        CHECK(shape.hull->points().size() <= ConvexHull::kMostPoints);
        // The tubes that the biped's skin is made of are as thick as their capsules.
        const float volume = shapeVolume(plain.bodies[i].shape);
        CHECK(shapeVolume(shape) > 0.4F * volume);
        CHECK(shapeVolume(shape) < 2.0F * volume);
        CHECK(profile.bodies[i].massKg == plain.bodies[i].massKg);
    }
}

TEST_CASE("the skin lies within 1.2 percent of the height of a body's hull") {
    const auto biped = test::makeBiped();
    const BodyPlan plan = planBodies(biped, test::mapOfBiped(biped), FitOptions{});
    for (const PlannedBody& body : plan.bodies) {
        INFO(body.name);
        PlacedShape shape;
        shape.standardFromBody.translation = 0.5F * (body.start + body.end);
        const auto hull = fitHull(plan, body, shape);
        REQUIRE(hull);
        const RigidTransform bodyFromStandard = inverse(hull->standardFromBody);
        for (const SkinPoint& point : skinNearSegment(plan, body))
            CHECK(signedDistance(hull->shape, bodyFromStandard * point.vertex) < 0.012F * plan.heightM);
    }
}

TEST_CASE("hulls of both sides are mirror images") {
    const RagdollProfile profile = fitted(true);
    for (int body = 0; body < static_cast<int>(profile.bodies.size()); ++body) {
        if (sideOf(profile, body) != animation::Side::left) continue;
        const int other = counterpartOf(profile, body);
        REQUIRE(other >= 0);
        if (profile.bodies[body].shape.kind != BodyShape::Kind::hull) continue;
        CHECK(sameHull(mirrored(profile.bodies[body].shape).hull, profile.bodies[other].shape.hull));
    }
}

TEST_CASE("a body with next to no skin keeps the shape that it has") {
    BodyPlan plan;
    plan.heightM = 1.75F;
    PlannedBody body;
    body.end = {0, 0.4F, 0};
    body.asHull = true;
    for (int i = 0; i < 7; ++i) {
        const vec3 at(0.01F * static_cast<float>(i * i), 0.02F * static_cast<float>(i),
                      0.03F * static_cast<float>(i % 3));
        body.skin.push_back({at, 1.0F, at});
    }
    plan.bodies.push_back(body);
    std::vector<PlacedShape> shapes(1);
    takeHulls(plan, shapes);
    CHECK(shapes[0].shape.kind == BodyShape::Kind::capsule);
}

TEST_CASE("hulls are fitted anew as hulls, other bodies as what they are") {
    const auto biped = test::makeBiped();
    RagdollProfile profile = fitted(true);
    profile.bodies[3] = fitted(false).bodies[3];
    const auto bound = rebindProfile(profile, biped, test::mapOfBiped(biped), false);
    REQUIRE(bound);
    for (std::size_t i = 0; i < profile.bodies.size(); ++i) {
        INFO(profile.bodies[i].name);
        CHECK(bound.value().bodies[i].shape.kind == profile.bodies[i].shape.kind);
        CHECK(shapeVolume(bound.value().bodies[i].shape) == Approx(shapeVolume(profile.bodies[i].shape)).epsilon(0.02));
    }
}
