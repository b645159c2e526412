#include <glm/geometric.hpp>

#include "physics/collision/shape.hpp"
#include "physics/collision/static_distance.hpp"
#include "support/catch.hpp"

using namespace lutka;
using namespace lutka::physics;

namespace {

AddedShape sphereAt(const vec3& centre, float radius) {
    AddedShape added;
    added.kind = PrimitiveShape::Kind::sphere;
    added.radius = radius;
    added.bodyFromShape.translation = centre;
    return added;
}

// A sphere of 0.2 m with one of 0.1 m beside it, 0.5 m along x.
BodyShape dumbbell() {
    BodyShape shape;
    shape.kind = PrimitiveShape::Kind::sphere;
    shape.radius = 0.2F;
    shape.more.push_back(sphereAt({0.5F, 0, 0}, 0.1F));
    return shape;
}

float sphereVolume(float radius) {
    return 4.0F / 3.0F * kPi * radius * radius * radius;
}

}  // namespace

TEST_CASE("several shapes have the volume and the moments of their union") {
    const BodyShape apart = dumbbell();
    const float large = sphereVolume(0.2F);
    const float small = sphereVolume(0.1F);
    CHECK(shapeVolume(apart) == Approx(large + small).epsilon(0.02));
    // Two spheres of one density: 2/5 m r² each, and m d² of the one beside.
    const float massKg = 9.0F;
    const float perVolume = massKg / (large + small);
    const float own = 0.4F * perVolume * (large * 0.04F + small * 0.01F);
    const float beside = perVolume * small * 0.25F;
    const vec3 moments = shapeInertia(apart, massKg);
    CHECK(moments.x == Approx(own).epsilon(0.03));
    CHECK(moments.y == Approx(own + beside).epsilon(0.03));
    CHECK(moments.z == Approx(own + beside).epsilon(0.03));

    // What two share counts once: a sphere in itself.
    BodyShape twice = dumbbell();
    twice.more[0] = sphereAt(vec3(0), 0.2F);
    CHECK(shapeVolume(twice) == Approx(large).epsilon(0.02));
    // And a turned capsule is that capsule.
    BodyShape rod;
    rod.kind = PrimitiveShape::Kind::sphere;
    rod.radius = 0.1F;
    AddedShape lying;
    lying.radius = 0.1F;
    lying.halfLength = 0.3F;
    lying.bodyFromShape.rotation = glm::angleAxis(0.5F * kPi, vec3(0, 0, 1));
    rod.more.push_back(lying);
    PrimitiveShape capsule = lying;
    const vec3 upright = shapeInertia(capsule, 3.0F);
    const vec3 turned = shapeInertia(rod, 3.0F);
    CHECK(turned.x == Approx(upright.y).epsilon(0.03));
    CHECK(turned.y == Approx(upright.x).epsilon(0.03));
    CHECK(turned.z == Approx(upright.z).epsilon(0.03));
}

TEST_CASE("distances and extents count every shape of a body") {
    const BodyShape shape = dumbbell();
    CHECK(signedDistance(shape, {0.5F, 0.3F, 0}) == Approx(0.2F));
    CHECK(signedDistance(shape, {0.5F, 0, 0}) == Approx(-0.1F));
    CHECK(signedDistance(shape, {-0.5F, 0, 0}) == Approx(0.3F));
    CHECK(supportExtent(shape, {1, 0, 0}) == Approx(0.6F));
    CHECK(supportExtent(shape, {-1, 0, 0}) == Approx(0.2F));
    CHECK(halfWidth(shape, {-1, 0, 0}) == Approx(0.6F));
    CHECK(boundingRadius(shape) == Approx(0.6F));

    // Turned a quarter about z the small one stands on top.
    const RigidTransform placed{glm::angleAxis(0.5F * kPi, vec3(0, 0, 1)), vec3(0, 1, 0)};
    BodyShape ball;
    ball.kind = PrimitiveShape::Kind::sphere;
    ball.radius = 0.1F;
    CHECK(distanceBetween(shape, placed, ball, {quat(1, 0, 0, 0), {0, 1.8F, 0}}) == Approx(0.1F).margin(1e-5));
    CHECK(distanceBetween(ball, {quat(1, 0, 0, 0), {0, 1.8F, 0}}, shape, placed) == Approx(0.1F).margin(1e-5));
    StaticShape floor;
    floor.kind = StaticShape::Kind::plane;
    const RigidTransform hanging{glm::angleAxis(-0.5F * kPi, vec3(0, 0, 1)), vec3(0, 1, 0)};
    CHECK(distanceToStatic(shape, hanging, floor) == Approx(0.4F).margin(1e-5));
}

TEST_CASE("a mirrored shape has its further ones on the other side") {
    BodyShape shape = dumbbell();
    shape.more[0].bodyFromShape.rotation = glm::angleAxis(0.4F, glm::normalize(vec3(1, 2, 3)));
    const BodyShape image = mirrored(shape);
    CHECK(image.more[0].bodyFromShape.translation == vec3(-0.5F, 0, 0));
    for (const vec3& point : {vec3(0.45F, 0.1F, 0), vec3(0.1F, 0.3F, -0.2F)})
        CHECK(signedDistance(image, {-point.x, point.y, point.z}) == Approx(signedDistance(shape, point)).margin(1e-6));
    CHECK(mirrored(image).more[0].bodyFromShape.rotation == shape.more[0].bodyFromShape.rotation);
}
