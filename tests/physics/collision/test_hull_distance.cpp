#include "physics/collision/hull_distance.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "core/random.hpp"
#include "physics/collision/contacts.hpp"
#include "physics/collision/shape.hpp"
#include "physics/collision/static_distance.hpp"
#include "support/catch.hpp"
#include "support/dolls.hpp"

using namespace lutka;
using namespace lutka::physics;

namespace {

const vec3 kHalf(0.1F, 0.2F, 0.3F);

PrimitiveShape boxAsHull() {
    PrimitiveShape box;
    box.kind = PrimitiveShape::Kind::box;
    box.halfExtents = kHalf;
    box.hull = hullWithin(box);
    box.kind = PrimitiveShape::Kind::hull;
    return box;
}

vec3 anywhere(Random& random, float reach) {
    const float x = random.uniform(-reach, reach);
    const float y = random.uniform(-reach, reach);
    return {x, y, random.uniform(-reach, reach)};
}

float mostOutside(const ConvexHull& hull, std::span<const vec3> points) {
    float most = 0.0F;
    for (const vec3& point : points)
        most = std::max(most, distanceToHull(point, hull).distance);
    return most;
}

}  // namespace

TEST_CASE("points are as far from a box's hull as from the box") {
    const PrimitiveShape hull = boxAsHull();
    Random random(2);
    for (int i = 0; i < 500; ++i) {
        const vec3 point = anywhere(random, 0.5F);
        const SurfaceDistance box = distanceToBox(point, kHalf);
        const SurfaceDistance own = distanceToHull(point, *hull.hull);
        CHECK(own.distance == Approx(box.distance).margin(1e-5));
        // Inside, near the middle of two sides, either normal is right.
        if (box.distance > 1e-3F) CHECK(glm::dot(own.normal, box.normal) > 0.999F);
        CHECK(signedDistance(hull, point) == own.distance);
    }
}

TEST_CASE("segments touch a box's hull where they touch the box") {
    const PrimitiveShape hull = boxAsHull();
    Random random(4);
    for (int i = 0; i < 300; ++i) {
        const Segment core{anywhere(random, 0.5F), anywhere(random, 0.5F)};
        const CoreTouches box = touchBox(core, kHalf, 0.1F);
        const CoreTouches own = touchHull(core, *hull.hull, 0.1F);
        const auto deepest = [](const CoreTouches& touches) {
            float least = 1.0F;
            for (int k = 0; k < touches.count; ++k)
                least = std::min(least, touches.points[k].surface.distance);
            return least;
        };
        // Two halvings of the same length end at the same point but where two sides are equally near.
        CHECK(deepest(own) == Approx(deepest(box)).margin(0.003));
    }
}

TEST_CASE("a hull's contacts with a plane are its lowest corners") {
    const PrimitiveShape hull = boxAsHull();
    const RigidTransform place{glm::angleAxis(0.3F, vec3(0, 0, 1)), {0, 0.2F, 0}};
    const StaticShape floor;
    const ContactList found = findContacts(geometryOf(hull, place), geometryOf(floor), 0.02F);
    REQUIRE(found.count == 2);  // an edge
    for (int i = 0; i < found.count; ++i)
        CHECK(found.contacts[i].distance == Approx(distanceToStatic(hull, place, floor)).margin(1e-5));
    // And the other way about the same points, seen from below.
    const ContactList flipped = findContacts(geometryOf(floor), geometryOf(hull, place), 0.02F);
    REQUIRE(flipped.count == 2);
    CHECK(flipped.contacts[0].normal.y == -1.0F);
}

TEST_CASE("a hull that is no box reaches as far as its corners, each way by itself") {
    const std::vector<vec3> points{{0, 0.3F, 0}, {0.1F, -0.1F, 0.1F}, {-0.1F, -0.1F, 0.1F}, {0, -0.1F, -0.2F}};
    PrimitiveShape shape;
    shape.kind = PrimitiveShape::Kind::hull;
    shape.hull = makeConvexHull(points);
    CHECK(supportExtent(shape, {0, 1, 0}) == Approx(0.3F));
    CHECK(supportExtent(shape, {0, -1, 0}) == Approx(0.1F));
    BodyShape body;
    static_cast<PrimitiveShape&>(body) = shape;
    CHECK(halfWidth(body, {0, -1, 0}) == Approx(0.3F));
    CHECK(boundingRadius(shape) == Approx(0.3F));
    const StaticShape floor;
    CHECK(distanceToStatic(shape, {quat(1, 0, 0, 0), {0, 0.5F, 0}}, floor) == Approx(0.4F));
}

TEST_CASE("a hull of many points is reduced to few, which lie near them") {
    Random random(11);
    const std::vector<vec3> points = test::pointsOnEllipsoid({0.08F, 0.25F, 0.07F}, 2000, random);
    float before = 1.0F;
    for (const int most : {8, 16, 32}) {
        const ReducedHull reduced = reduceHull(points, 1e-4F, most);
        REQUIRE(reduced.hull != nullptr);
        CHECK(static_cast<int>(reduced.hull->points().size()) <= most);
        CHECK(reduced.deviation == Approx(mostOutside(*reduced.hull, points)).margin(1e-6));
        CHECK(reduced.deviation < before);
        before = reduced.deviation;
    }
    CHECK(before < 0.014F);  // of what is half a metre long
    // It stops where the tolerance is kept.
    const ReducedHull coarse = reduceHull(points, 0.02F);
    CHECK(coarse.deviation <= 0.02F);
    CHECK(coarse.hull->points().size() < 25);
}
