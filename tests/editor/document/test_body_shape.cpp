#include "editor/document/body_shape.hpp"

#include "physics/collision/shape.hpp"
#include "support/catch.hpp"

using namespace lutka;
using namespace lutka::editor;
using physics::BodyShape;

namespace {

BodyShape thigh() {
    BodyShape shape;
    shape.kind = BodyShape::Kind::capsule;
    shape.radius = 0.08F;
    shape.halfLength = 0.16F;
    return shape;
}

BodyShape shapeOfKind(BodyShape shape, BodyShape::Kind kind) {
    setKind(shape, kind);
    return shape;
}

}  // namespace

TEST_CASE("a shape of another kind has the old one's measures") {
    const BodyShape box = shapeOfKind(thigh(), BodyShape::Kind::box);
    CHECK(box.halfExtents.x == Approx(0.08F));
    CHECK(box.halfExtents.y == Approx(0.24F));
    CHECK(box.halfExtents.z == Approx(0.08F));
    const BodyShape back = shapeOfKind(box, BodyShape::Kind::capsule);
    CHECK(back.radius == Approx(0.08F));
    CHECK(back.halfLength == Approx(0.16F));
    const BodyShape ball = shapeOfKind(thigh(), BodyShape::Kind::sphere);
    CHECK(ball.radius > 0.08F);
    CHECK(ball.radius < 0.24F);
    BodyShape flat = box;
    flat.halfExtents = {0.2F, 0.05F, 0.2F};
    CHECK(shapeOfKind(flat, BodyShape::Kind::capsule).halfLength == Approx(0.0F).margin(1e-6));
}

TEST_CASE("a hull made of a shape lies in it, and what is made of a hull is as large") {
    const BodyShape hull = shapeOfKind(thigh(), BodyShape::Kind::hull);
    REQUIRE(hull.hull != nullptr);
    CHECK(physics::isCentred(*hull.hull));
    for (const vec3& corner : hull.hull->points())
        CHECK(physics::signedDistance(static_cast<const physics::PrimitiveShape&>(thigh()), corner) < 1e-5F);
    const BodyShape back = shapeOfKind(hull, BodyShape::Kind::capsule);
    CHECK(back.hull == nullptr);
    CHECK(back.radius == Approx(0.08F).epsilon(0.2));
    CHECK(back.radius + back.halfLength == Approx(0.24F).epsilon(0.15));
    CHECK(shapeOfKind(hull, BodyShape::Kind::box).halfExtents.y == Approx(0.24F).epsilon(0.15));
}

TEST_CASE("a capsule's radius leaves its length alone, as far as it can") {
    BodyShape shape = thigh();
    setRadius(shape, 0.1F);
    CHECK(shape.halfLength + shape.radius == Approx(0.24F));
    setRadius(shape, 0.3F);
    CHECK(shape.halfLength == 0.0F);
    CHECK(shape.radius == 0.3F);
}

TEST_CASE("a body takes two further shapes, and gives them back") {
    BodyShape shape = thigh();
    REQUIRE(addShape(shape, BodyShape::Kind::sphere).ok());
    REQUIRE(addShape(shape, BodyShape::Kind::box).ok());
    const auto refused = addShape(shape, BodyShape::Kind::capsule);
    REQUIRE_FALSE(refused.ok());
    CHECK_THAT(refused.error().message, Catch::Contains("3 shapes"));
    REQUIRE(shape.more.size() == 2);
    CHECK(shape.more[0].radius == Approx(0.04F));
    CHECK(shape.more[0].bodyFromShape.translation.z == Approx(0.08F));
    removeShape(shape, 0);
    REQUIRE(shape.more.size() == 1);
    CHECK(shape.more[0].kind == BodyShape::Kind::box);
    removeShape(shape, 5);
    CHECK(shape.more.size() == 1);
    // The main shape's kind and radius leave them alone.
    CHECK(shapeOfKind(shape, BodyShape::Kind::box).more.size() == 1);
}
