#include "physics/collision/box_manifold.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <random>
#include <vector>

#include "physics/collision/shape_distance.hpp"
#include "support/catch.hpp"

using namespace lutka;
using namespace lutka::physics;

namespace {

constexpr float kReach = 0.01F;

class RandomBoxes {
  public:
    [[nodiscard]] BoxPlace near(float distance) {
        const quat turn = glm::normalize(quat(normal_(engine_), normal_(engine_), normal_(engine_), normal_(engine_)));
        const auto size = [&] { return 0.1F + 0.4F * unit_(engine_); };
        const auto place = [&] { return distance * (2.0F * unit_(engine_) - 1.0F); };
        return {{size(), size(), size()}, {place(), place(), place()}, glm::mat3_cast(turn)};
    }

  private:
    std::mt19937 engine_{7};
    std::normal_distribution<float> normal_{0.0F, 1.0F};
    std::uniform_real_distribution<float> unit_{0.0F, 1.0F};
};

vec3 inWorld(const BoxPlace& box, const vec3& point) {
    return box.position + box.axes * point;
}

}  // namespace

TEST_CASE("boxes that overlap touch in points on their surfaces, and part along the one normal by the depth") {
    RandomBoxes random;
    int overlapping = 0;
    for (int i = 0; i < 2000; ++i) {
        BoxPlace a = random.near(0.5F);
        const BoxPlace b = random.near(0.5F);
        const BoxManifold manifold = touchBoxes(a, b, kReach);
        const BoxAxis least = leastOverlap(a, b);
        if (least.distance >= kSamePlace) {
            REQUIRE(manifold.count == 0);
            continue;
        }
        ++overlapping;
        REQUIRE(manifold.count > 0);
        CHECK(glm::length(manifold.normal) == Approx(1.0F).margin(1e-5));
        float deepest = kReach;
        for (int k = 0; k < manifold.count; ++k) {
            const BoxManifold::Point& point = manifold.points[k];
            deepest = std::min(deepest, point.distance);
            CHECK(point.distance <= kReach);
            CHECK(std::abs(distanceToBox(point.onA, a.halfExtents).distance) < 1e-4F);
            CHECK(std::abs(distanceToBox(point.onB, b.halfExtents).distance) < 1e-4F);
            const vec3 apart = inWorld(a, point.onA) - inWorld(b, point.onB);
            CHECK(glm::dot(apart, manifold.normal) == Approx(point.distance).margin(1e-4));
            CHECK(point.feature >= 0);
            CHECK(point.feature < BoxManifold::kFeatures);
        }
        // Edges that win by less than they should are passed over for a face that is a little deeper.
        CHECK(deepest <= least.distance + 1e-4F);
        a.position += (1e-4F - deepest) * manifold.normal;
        CHECK(leastOverlap(a, b).distance >= 0.0F);
    }
    CHECK(overlapping > 500);
}

TEST_CASE("a box flat on another is held at four corners, one across an edge at two") {
    const BoxPlace floor{{2, 0.5F, 2}, {0, -0.5F, 0}, mat3(1)};
    const BoxPlace flat{{0.2F, 0.1F, 0.3F}, {0.3F, 0.099F, 0}, mat3(1)};
    const BoxManifold four = touchBoxes(flat, floor, kReach);
    CHECK(four.count == 4);
    CHECK(four.normal.y == Approx(1.0F));
    // A beam thinner than the box, under its middle: no corner of either is in the other.
    const BoxPlace beam{{0.02F, 0.5F, 2}, {0.3F, -0.5F, 0}, mat3(1)};
    const BoxManifold across = touchBoxes(flat, beam, kReach);
    CHECK(across.count == 4);
    for (int i = 0; i < across.count; ++i)
        CHECK(std::abs(std::abs(across.points[i].onA.z) - 0.3F) < 1e-5F);
}

TEST_CASE("where edges are shallower than faces, the shallowest of them counts") {
    RandomBoxes random;
    int edges = 0;
    for (int i = 0; i < 20000; ++i) {
        const BoxPlace a = random.near(0.5F);
        const BoxPlace b = random.near(0.5F);
        const BoxAxis chosen = leastOverlap(a, b, true);
        if (chosen.edgeOfA < 0 || chosen.distance >= 0.0F) continue;
        ++edges;
        CHECK(chosen.distance == leastOverlap(a, b).distance);
    }
    CHECK(edges > 100);
}

TEST_CASE("nearly parallel edges touch at both ends of what they share") {
    const mat3 onEdge = glm::mat3_cast(glm::angleAxis(kPi / 4, vec3(0, 0, 1)));
    const float reach = 0.1F * std::sqrt(2.0F);
    for (const float turn : {-0.03F, 0.05F, 0.1F}) {
        CAPTURE(turn);
        const mat3 turned = glm::mat3_cast(glm::angleAxis(turn, vec3(0, 1, 0))) * onEdge;
        const BoxPlace upper{{0.1F, 0.1F, 0.3F}, {0, 2 * reach - 0.01F, 0}, turned};
        const BoxManifold along = touchBoxes(upper, {{0.1F, 0.1F, 0.5F}, {0, 0, 0}, onEdge}, kReach);
        REQUIRE(along.count == 2);
        CHECK(along.points[0].feature != along.points[1].feature);
        CHECK(along.normal.y == Approx(1.0F));
        for (int i = 0; i < 2; ++i) {
            CHECK(std::abs(along.points[i].onA.z) == Approx(0.3F).margin(1e-4));
            CHECK(along.points[i].distance == Approx(-0.01F).margin(1e-5));
        }
    }
}

TEST_CASE("edges that cross touch in one point across both") {
    const mat3 onEdge = glm::mat3_cast(glm::angleAxis(kPi / 4, vec3(0, 0, 1)));
    const mat3 across = glm::mat3_cast(glm::angleAxis(kPi / 2, vec3(0, 1, 0))) * onEdge;
    const float half = 0.1F;
    const float reach = half * std::sqrt(2.0F);
    const BoxManifold crossed =
        touchBoxes({vec3(half), {0, 2 * reach - 0.01F, 0}, across}, {vec3(half), {0, 0, 0}, onEdge}, kReach);
    REQUIRE(crossed.count == 1);
    CHECK(crossed.normal.y == Approx(1.0F));
    CHECK(crossed.points[0].distance == Approx(-0.01F).margin(1e-5));
}

TEST_CASE("a bar that lies across an edge touches it with both its own edges, whichever way it is rolled") {
    const BoxPlace step{{1, 0.5F, 0.5F}, {0, -0.5F, -0.5F}, mat3(1)};
    const vec3 out = glm::normalize(vec3(0, 1, 1));
    const mat3 across(vec3(1, 0, 0), glm::normalize(vec3(0, 1, -1)), -out);
    std::vector<std::vector<int>> features;
    for (const float roll : {-0.02F, -0.01F, 0.01F, 0.02F}) {
        CAPTURE(roll);
        const mat3 rolled = glm::mat3_cast(glm::angleAxis(roll, across[1])) * across;
        const BoxPlace bar{{0.04F, 0.2F, 0.04F}, 0.035F * out, rolled};
        for (const bool swapped : {false, true}) {
            const BoxManifold found = swapped ? touchBoxes(step, bar, kReach) : touchBoxes(bar, step, kReach);
            REQUIRE(found.count == 2);
            CHECK(std::abs(glm::dot(found.normal, out)) > 0.999F);
            // One at either side; each deep by what it is in the step.
            const auto onBar = [&](int i) { return swapped ? found.points[i].onB : found.points[i].onA; };
            CHECK(onBar(0).x * onBar(1).x < 0.0F);
            for (int i = 0; i < 2; ++i)
                CHECK(found.points[i].distance == Approx(-0.005F).margin(0.001));
            std::vector<int> both{found.points[0].feature, found.points[1].feature};
            std::sort(both.begin(), both.end());
            features.push_back(both);
        }
    }
    // What each has pressed with finds its way from one moment to the next.
    for (std::size_t i = 2; i < features.size(); ++i)
        CHECK(features[i] == features[i - 2]);
}
