#include "physics/profile/convex_hull.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/random.hpp"
#include "physics/collision/shape.hpp"
#include "support/catch.hpp"
#include "support/dolls.hpp"

using namespace lutka;
using namespace lutka::physics;

namespace {

std::vector<vec3> boxCorners(const vec3& half, const vec3& middle = vec3(0)) {
    std::vector<vec3> corners;
    for (const float x : {-half.x, half.x})
        for (const float y : {-half.y, half.y})
            for (const float z : {-half.z, half.z})
                corners.push_back(middle + vec3(x, y, z));
    return corners;
}

float farthestOut(const ConvexHull& hull, std::span<const vec3> points) {
    float most = 0.0F;
    for (const vec3& point : points)
        for (const ConvexHull::Face& face : hull.faces())
            most = std::max(most, glm::dot(face.normal, point) - face.offset);
    return most;
}

}  // namespace

TEST_CASE("the hull of a box's corners has six sides, its volume and its moments") {
    const vec3 half(0.1F, 0.2F, 0.3F);
    std::vector<vec3> points = boxCorners(half, {1, 2, 3});
    points.emplace_back(1.02F, 2.1F, 2.9F);  // inside
    const ConvexHullPtr hull = makeConvexHull(points);
    REQUIRE(hull != nullptr);
    CHECK(hull->points().size() == 8);
    CHECK(hull->faces().size() == 6);
    CHECK(hull->edges().size() == 12);
    CHECK(hull->volume() == Approx(8.0F * half.x * half.y * half.z).epsilon(1e-5));
    CHECK(glm::distance(hull->centroid(), vec3(1, 2, 3)) < 1e-5F);
    CHECK(hull->thickness() == Approx(0.2F));

    const CentredHull centred = centredHull(*hull);
    CHECK(isCentred(*centred.shape.hull));
    CHECK(glm::distance(centred.frameFromShape.translation, vec3(1, 2, 3)) < 1e-5F);
    PrimitiveShape box;
    box.kind = PrimitiveShape::Kind::box;
    box.halfExtents = half;
    CHECK(shapeVolume(centred.shape) == Approx(shapeVolume(box)).epsilon(1e-4));
    CHECK(glm::distance(shapeInertia(centred.shape, 5.0F), shapeInertia(box, 5.0F)) < 1e-5F);
}

TEST_CASE("what is turned comes back along its principal axes") {
    const quat turn = glm::angleAxis(0.4F, glm::normalize(vec3(1, 2, 3)));
    std::vector<vec3> points = boxCorners({0.1F, 0.3F, 0.2F});
    for (vec3& point : points)
        point = turn * point;
    const CentredHull centred = centredHull(*makeConvexHull(points));
    CHECK(std::abs(glm::dot(centred.frameFromShape.rotation, turn)) > 0.9999F);
    CHECK(glm::distance(centred.shape.hull->halfBounds(), vec3(0.1F, 0.3F, 0.2F)) < 1e-4F);
}

TEST_CASE("edges join two sides, sides are planar, and Euler's formula holds") {
    Random random(3);
    for (int trial = 0; trial < 20; ++trial) {
        const ConvexHullPtr hull = makeConvexHull(test::pointsOnEllipsoid({0.1F, 0.3F, 0.2F}, 8 + trial, random));
        REQUIRE(hull != nullptr);
        const auto count = [](const auto& list) { return static_cast<int>(list.size()); };
        CHECK(count(hull->points()) - count(hull->edges()) + count(hull->faces()) == 2);
        CHECK(farthestOut(*hull, hull->points()) <= 0.0F);
        for (const ConvexHull::Edge& edge : hull->edges())
            CHECK(edge.left != edge.right);
        for (const ConvexHull::Face& face : hull->faces())
            for (const int corner : hull->cornersOf(face))
                CHECK(std::abs(glm::dot(face.normal, hull->points()[corner]) - face.offset) <
                      1e-4F);  // exact on a grid of 10⁻⁴
    }
}

TEST_CASE("a hull made of a hull's corners is the same, to the last bit") {
    Random random(5);
    for (int trial = 0; trial < 20; ++trial) {
        const ConvexHullPtr first = makeConvexHull(test::pointsOnEllipsoid({0.1F, 0.3F, 0.2F}, 60, random));
        const ConvexHullPtr again = makeConvexHull(first->points());
        CHECK(sameHull(first, again));
    }
}

TEST_CASE("flat, straight and few points have no hull") {
    CHECK(makeConvexHull({}) == nullptr);
    const std::vector<vec3> three{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    CHECK(makeConvexHull(three) == nullptr);
    const std::vector<vec3> same(6, vec3(1, 2, 3));
    CHECK(makeConvexHull(same) == nullptr);
    std::vector<vec3> flat = boxCorners({1, 1, 1});
    for (vec3& point : flat)
        point.y = 0.25F * point.x;
    CHECK(makeConvexHull(flat) == nullptr);
    CHECK(makeConvexHull(boxCorners({1, 1e-4F, 1})) == nullptr);
}

TEST_CASE("the mirror image of a hull is its counterpart's, a scaled one stays about its middle") {
    Random random(17);
    BodyShape shape;
    static_cast<PrimitiveShape&>(shape) =
        centredHull(*makeConvexHull(test::pointsOnEllipsoid({0.1F, 0.3F, 0.2F}, 20, random))).shape;
    const BodyShape other = mirrored(shape);
    for (int i = 0; i < static_cast<int>(shape.hull->points().size()); ++i) {
        const vec3 point = shape.hull->points()[i];
        CHECK(other.hull->points()[i] == vec3(-point.x, point.y, point.z));
    }
    CHECK(sameHull(mirrored(other).hull, shape.hull));

    PrimitiveShape scaled = shape;
    scaleHull(scaled, {2, 1, 0.5F});
    CHECK(shapeVolume(scaled) == Approx(shapeVolume(shape)).epsilon(1e-4));
    CHECK(isCentred(*scaled.hull));
    scaleHull(scaled, {1, 1e-5F, 1});  // flat: nothing changes
    CHECK(shapeVolume(scaled) == Approx(shapeVolume(shape)).epsilon(1e-4));
}

TEST_CASE("what stands for a hull has its kind, its length and its volume, about") {
    const ConvexHullPtr block = makeConvexHull(boxCorners({0.1F, 0.2F, 0.3F}));
    const StandIn box = standInFor(*block);
    CHECK(box.shape.kind == PrimitiveShape::Kind::box);
    CHECK(glm::distance(box.shape.halfExtents, vec3(0.1F, 0.2F, 0.3F)) < 1e-4F);

    PrimitiveShape rod;
    rod.radius = 0.05F;
    rod.halfLength = 0.2F;
    const StandIn round = standInFor(*hullWithin(rod));
    CHECK(round.shape.kind == PrimitiveShape::Kind::capsule);
    CHECK(round.shape.radius == Approx(0.05F).epsilon(0.1));
    CHECK(round.shape.radius + round.shape.halfLength == Approx(0.25F).epsilon(0.02));
    CHECK(shapeVolume(round.shape) == Approx(shapeVolume(rod)).epsilon(0.25));
}
