#include <glm/geometric.hpp>

#include "core/random.hpp"
#include "core/rigid_transform.hpp"
#include "support/catch.hpp"

using namespace lutka;

namespace {

vec3 randomDirection(Random& random) {
    for (;;) {
        const vec3 v(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
        if (glm::length(v) > 0.1F && glm::length(v) < 1.0F) return glm::normalize(v);
    }
}

}  // namespace

TEST_CASE("rotationBetween takes one direction to the other by the shortest way") {
    Random random(1);
    for (int i = 0; i < 200; ++i) {
        const vec3 from = randomDirection(random);
        const vec3 to = i % 10 == 0 ? -from : randomDirection(random);
        const quat r = rotationBetween(from * 3.0F, to * 0.5F);
        CHECK(glm::distance(r * from, to) < 1e-3F);
        CHECK(glm::length(rotationVector(r)) ==
              Approx(std::acos(std::clamp(glm::dot(from, to), -1.0F, 1.0F))).margin(2e-3));
    }
}

TEST_CASE("rotationVector is axis times angle up to half a turn") {
    Random random(2);
    for (int i = 0; i < 200; ++i) {
        const vec3 axis = randomDirection(random);
        const float angle = random.uniform(0.0F, 3.1F);
        CHECK(glm::distance(rotationVector(glm::angleAxis(angle, axis)), axis * angle) < 1e-4F);
        CHECK(glm::distance(rotationVector(-glm::angleAxis(angle, axis)), axis * angle) < 1e-4F);
    }
    CHECK(glm::length(rotationVector(quat(1, 0, 0, 0))) == 0.0F);
}

TEST_CASE("rotationFromXY keeps x and puts y into its plane") {
    const quat r = rotationFromXY({0, 2, 0}, {1, 1, 0});
    CHECK(glm::distance(r * vec3(1, 0, 0), vec3(0, 1, 0)) < 1e-6F);
    CHECK(glm::distance(r * vec3(0, 1, 0), vec3(1, 0, 0)) < 1e-6F);
    CHECK(glm::distance(r * vec3(0, 0, 1), vec3(0, 0, -1)) < 1e-6F);
}

TEST_CASE("a rigid transform times its inverse is the identity") {
    Random random(3);
    for (int i = 0; i < 100; ++i) {
        const RigidTransform t{glm::angleAxis(random.uniform(-3, 3), randomDirection(random)),
                               randomDirection(random) * 9.0F};
        const RigidTransform one = t * inverse(t);
        CHECK(glm::length(one.translation) < 1e-5F);
        CHECK(glm::length(rotationVector(one.rotation)) < 1e-5F);
        const vec3 p = randomDirection(random);
        CHECK(glm::distance(vec3(toMatrix(t) * vec4(p, 1)), t * p) < 1e-5F);
    }
}

TEST_CASE("interpolate meets both ends and takes the shorter arc") {
    const RigidTransform a{quat(1, 0, 0, 0), {0, 0, 0}};
    const RigidTransform b{-glm::angleAxis(1.0F, vec3(0, 1, 0)), {2, 0, 0}};
    CHECK(glm::distance(interpolate(a, b, 1.0F).rotation * vec3(1, 0, 0), b.rotation * vec3(1, 0, 0)) < 1e-6F);
    const RigidTransform half = interpolate(a, b, 0.5F);
    CHECK(half.translation.x == Approx(1.0F));
    CHECK(glm::length(rotationVector(half.rotation)) == Approx(0.5F).margin(1e-4));
}
