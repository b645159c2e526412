#include "physics/collision/contacts.hpp"

#include <glm/geometric.hpp>

#include "core/random.hpp"
#include "physics/collision/shape.hpp"
#include "support/catch.hpp"

using namespace lutka;
using physics::CollisionGeometry;
using physics::ContactList;
using physics::findContacts;
using Kind = ShapeKind;

namespace {

CollisionGeometry capsule(float radius, float halfLength, const vec3& centre, const quat& turn = quat(1, 0, 0, 0)) {
    return {Kind::capsule, radius, halfLength, vec3(0), {turn, centre}};
}
CollisionGeometry block(const vec3& halfExtents, const vec3& centre, const quat& turn = quat(1, 0, 0, 0)) {
    return {Kind::box, 0, 0, halfExtents, {turn, centre}};
}
const CollisionGeometry kFloor{Kind::plane, 0, 0, vec3(0), {}};
const quat kAlongX = glm::angleAxis(radians(90.0F), vec3(0, 0, 1));
constexpr float kMargin = 0.04F;

float nearest(const ContactList& list) {
    float distance = 1e9F;
    for (int i = 0; i < list.count; ++i)
        distance = std::min(distance, list.contacts[i].distance);
    return distance;
}

physics::BodyShape shapeOf(const CollisionGeometry& geometry) {
    physics::BodyShape shape;
    shape.kind = geometry.kind == Kind::box ? physics::BodyShape::Kind::box : physics::BodyShape::Kind::capsule;
    shape.radius = geometry.radius;
    shape.halfLength = geometry.halfLength;
    shape.halfExtents = geometry.halfExtents;
    return shape;
}

quat anyTurn(Random& random) {
    return glm::normalize(
        quat(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)));
}

}  // namespace

TEST_CASE("a capsule lying on a plane or a box has a contact under each end", "[contacts]") {
    const CollisionGeometry lying = capsule(0.1F, 0.3F, {1, 0.09F, 0}, kAlongX);
    for (const CollisionGeometry& ground : {kFloor, block({5, 1, 5}, {0, -1, 0})}) {
        const ContactList list = findContacts(lying, ground, kMargin);
        REQUIRE(list.count == 2);
        CHECK(glm::distance(list.contacts[0].position, list.contacts[1].position) == Approx(0.6F));
        for (int i = 0; i < 2; ++i) {
            CHECK(list.contacts[i].distance == Approx(-0.01F).margin(1e-5));
            CHECK(glm::distance(list.contacts[i].normal, vec3(0, 1, 0)) < 1e-5F);
            CHECK(list.contacts[i].position.y == Approx(0.0F).margin(1e-5));
        }
    }
}

TEST_CASE("a pair seen from the other side has the same contacts with opposite normals", "[contacts]") {
    const CollisionGeometry lying = capsule(0.1F, 0.3F, {0.2F, 0.12F, 0}, kAlongX);
    const CollisionGeometry ground = block({5, 1, 5}, {0, -1, 0});
    const ContactList one = findContacts(lying, ground, kMargin);
    const ContactList other = findContacts(ground, lying, kMargin);
    REQUIRE(one.count == other.count);
    for (int i = 0; i < one.count; ++i) {
        CHECK(other.contacts[i].feature == one.contacts[i].feature);
        CHECK(glm::distance(other.contacts[i].normal, -one.contacts[i].normal) < 1e-6F);
        const vec3 onCapsule = one.contacts[i].position + one.contacts[i].distance * one.contacts[i].normal;
        CHECK(glm::distance(other.contacts[i].position, onCapsule) < 1e-6F);
    }
}

TEST_CASE("a box on a plane has its four lowest corners as contacts", "[contacts]") {
    const ContactList list = findContacts(block({0.1F, 0.2F, 0.3F}, {0, 0.21F, 0}), kFloor, kMargin);
    REQUIRE(list.count == 4);
    for (int i = 0; i < 4; ++i)
        CHECK(list.contacts[i].distance == Approx(0.01F));
}

TEST_CASE("an edge that presses between a capsule's ends has a contact there", "[contacts]") {
    const CollisionGeometry step = block({1, 0.5F, 1}, {0, 0, 0});
    const quat slope = glm::angleAxis(radians(45.0F), vec3(0, 0, 1));
    const vec3 out = glm::normalize(vec3(1, 1, 0));
    const ContactList list = findContacts(capsule(0.05F, 0.4F, vec3(1, 0.5F, 0) + 0.04F * out, slope), step, kMargin);
    REQUIRE(list.count == 1);
    CHECK(list.contacts[0].distance == Approx(-0.01F).margin(1e-4));
    CHECK(glm::distance(list.contacts[0].normal, out) < 1e-2F);
}

TEST_CASE("capsules side by side touch at both ends of the line, crossed ones in a point", "[contacts]") {
    const ContactList line =
        findContacts(capsule(0.05F, 0.2F, {0, 0, 0}), capsule(0.05F, 0.2F, {0.11F, 0.1F, 0}), kMargin);
    REQUIRE(line.count == 2);
    CHECK(std::abs(line.contacts[0].position.y - line.contacts[1].position.y) == Approx(0.3F));
    CHECK(line.contacts[0].distance == Approx(0.01F).margin(1e-5));
    const ContactList point =
        findContacts(capsule(0.05F, 0.2F, {0, 0, 0}), capsule(0.05F, 0.2F, {0, 0, 0.09F}, kAlongX), kMargin);
    REQUIRE(point.count == 1);
    CHECK(point.contacts[0].distance == Approx(-0.01F).margin(1e-5));
    CHECK(glm::distance(point.contacts[0].normal, vec3(0, 0, -1)) < 1e-4F);
}

TEST_CASE("the nearest contact of any two shapes is as far as they are", "[contacts]") {
    Random random(11);
    int touching = 0;
    for (int i = 0; i < 3000; ++i) {
        const auto place = [&] { return vec3(random.uniform(-0.4F, 0.4F), random.uniform(-0.4F, 0.4F), 0); };
        const CollisionGeometry a = capsule(0.06F, random.uniform(0.05F, 0.25F), place(), anyTurn(random));
        const CollisionGeometry b = i % 2 == 0 ? capsule(0.05F, random.uniform(0, 0.2F), place(), anyTurn(random))
                                               : block({0.2F, 0.1F, 0.15F}, place(), anyTurn(random));
        const float distance = distanceBetween(shapeOf(a), a.worldFromShape, shapeOf(b), b.worldFromShape);
        const ContactList list = findContacts(a, b, kMargin);
        if (distance >= kMargin) {
            CHECK(list.count == 0);
        } else {
            ++touching;
            REQUIRE(list.count > 0);
            // Contacts within 5 mm along a capsule are taken for one.
            CHECK(nearest(list) == Approx(distance).margin(0.0051));
        }
    }
    CHECK(touching > 500);
}

TEST_CASE("nothing is reported beyond the margin", "[contacts]") {
    CHECK(findContacts(capsule(0.1F, 0.3F, {0, 0.45F, 0}), kFloor, kMargin).count == 0);
    CHECK(findContacts(capsule(0.1F, 0.3F, {0, 0.43F, 0}), kFloor, kMargin).count == 1);
}
