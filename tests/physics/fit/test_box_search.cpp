#include "physics/fit/box_search.hpp"

#include <glm/gtc/quaternion.hpp>
#include <glm/gtx/quaternion.hpp>

#include "physics/fit/fit_shapes.hpp"
#include "support/catch.hpp"

using namespace lutka;
using namespace lutka::physics;

namespace {

constexpr int kPerSide = 8;

// Points on the six faces of a box, all of one area.
std::vector<SkinPoint> skinOfBox(const vec3& half, const RigidTransform& place) {
    std::vector<SkinPoint> points;
    for (int face = 0; face < 6; ++face) {
        const int axis = face / 2;
        for (int i = 0; i < kPerSide * kPerSide; ++i) {
            vec3 point(0);
            point[axis] = face % 2 == 0 ? half[axis] : -half[axis];
            const auto spread = [](int step) { return (2.0F * static_cast<float>(step) + 1.0F) / kPerSide - 1.0F; };
            point[(axis + 1) % 3] = spread(i % kPerSide) * half[(axis + 1) % 3];
            point[(axis + 2) % 3] = spread(i / kPerSide) * half[(axis + 2) % 3];
            points.push_back({place * point, 1e-3F});
        }
    }
    return points;
}

std::vector<SkinPoint> skinOfTube(float radius, float halfLength) {
    std::vector<SkinPoint> points;
    for (int ring = 0; ring <= 12; ++ring) {
        for (int step = 0; step < 24; ++step) {
            const float turn = 2.0F * kPi * static_cast<float>(step) / 24.0F;
            const float y = halfLength * (static_cast<float>(ring) / 6.0F - 1.0F);
            points.push_back({{radius * std::cos(turn), y, radius * std::sin(turn)}, 1e-3F});
        }
    }
    return points;
}

BoxBounds bounds() {
    BoxBounds bounds;
    bounds.smallestHalf = 0.01F;
    bounds.largestHalf = 0.5F;
    bounds.cutoff = 0.08F;
    bounds.nearM = 0.035F;
    return bounds;
}

}  // namespace

TEST_CASE("a block whose joints lie askew in it becomes an upright box, and not one along the joints") {
    const vec3 half(0.16F, 0.19F, 0.16F);
    const std::vector<SkinPoint> skin = skinOfBox(half, {quat(1, 0, 0, 0), {0.5F, 1.2F, 0.0F}});
    const vec3 shoulder(0.475F, 1.36F, 0.0F);
    const vec3 elbow(0.5F, 1.2F, 0.0F);
    BoxBounds limits = bounds();
    limits.standardFromAxes = glm::rotation(vec3(0, 1, 0), glm::normalize(elbow - shoulder));
    limits.alsoUpright = true;
    const auto box = fitBox(skin, Capsule{shoulder, elbow, 0.1F}, limits);
    REQUIRE(box);
    CHECK(std::abs((box->standardFromBox.rotation * vec3(0, 1, 0)).y) > 0.999F);
    CHECK(box->halfExtents.x == Approx(half.x).margin(0.005));
    CHECK(box->halfExtents.y == Approx(half.y).margin(0.005));
}

TEST_CASE("a block becomes the box that it is, however it is turned about the limb") {
    const vec3 half(0.08F, 0.2F, 0.06F);
    for (const float degrees : {0.0F, 25.0F, 60.0F}) {
        INFO(degrees);
        const RigidTransform place{glm::angleAxis(radians(degrees), vec3(0, 1, 0)), {0.3F, 1.0F, 0.1F}};
        const Capsule capsule{{0.3F, 0.87F, 0.1F}, {0.3F, 1.13F, 0.1F}, 0.07F};
        const auto box = fitBox(skinOfBox(half, place), capsule, bounds());
        REQUIRE(box);
        CHECK(glm::distance(box->standardFromBox.translation, place.translation) < 0.002F);
        CHECK(box->halfExtents.y == Approx(half.y).margin(0.002));
        // A turn of 90 degrees would change the sides' names.
        const float wide = std::max(box->halfExtents.x, box->halfExtents.z);
        const float thin = std::min(box->halfExtents.x, box->halfExtents.z);
        CHECK(wide == Approx(half.x).margin(0.002));
        CHECK(thin == Approx(half.z).margin(0.002));
    }
}

TEST_CASE("a tube and a plate stay capsules") {
    const Capsule along{{0, -0.1F, 0}, {0, 0.1F, 0}, 0.06F};
    CHECK_FALSE(fitBox(skinOfTube(0.06F, 0.16F), along, bounds()));
    CHECK_FALSE(fitBox(skinOfBox({0.1F, 0.12F, 0.02F}, {}), along, bounds()));
}
