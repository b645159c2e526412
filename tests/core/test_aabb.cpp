#include "core/aabb.hpp"

#include <limits>

#include "support/catch.hpp"

using lutka::Aabb;
using lutka::AabbOf;
using lutka::vec3;

TEST_CASE("a box around points knows its size, its middle and how far away a point is") {
    Aabb box;
    CHECK(box.empty());
    box.add(vec3(1, 2, 3));
    CHECK_FALSE(box.empty());
    CHECK(box.size() == vec3(0));
    box.add(vec3(-1, 2, 7));
    CHECK(box.low == vec3(-1, 2, 3));
    CHECK(box.high == vec3(1, 2, 7));
    CHECK(box.middle() == vec3(0, 2, 5));
    CHECK(box.distanceTo(vec3(0, 2, 4)) == 0.0F);
    CHECK(box.distanceTo(vec3(4, 6, 4)) == 5.0F);
    Aabb other;
    other.add(vec3(0, 5, 3));
    box.add(other);
    CHECK(box.high == vec3(1, 5, 7));
    CHECK(box.diagonal() * box.diagonal() > 28.9F);
    CHECK(box.diagonal() * box.diagonal() < 29.1F);
}

TEST_CASE("a point that is no number leaves a box as it is") {
    AabbOf<glm::dvec3> box;
    box.add(glm::dvec3(1.0));
    box.add(glm::dvec3(std::numeric_limits<double>::quiet_NaN()));
    CHECK(box.low == glm::dvec3(1.0));
    CHECK(box.high == glm::dvec3(1.0));
}
