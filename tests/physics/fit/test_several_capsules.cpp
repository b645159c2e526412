#include "physics/fit/several_capsules.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "support/catch.hpp"

using namespace lutka;
using namespace lutka::physics;

namespace {

// Points on the surface of the union of capsules, all of one area.
std::vector<SkinPoint> skinOf(const std::vector<Capsule>& capsules) {
    std::vector<SkinPoint> points;
    for (const Capsule& capsule : capsules) {
        for (int ring = 0; ring <= 24; ++ring) {
            for (int step = 0; step < 24; ++step) {
                const float polar = kPi * static_cast<float>(ring) / 24.0F;
                const float turn = 2.0F * kPi * static_cast<float>(step) / 24.0F;
                const vec3 normal(std::sin(polar) * std::cos(turn), std::cos(polar), std::sin(polar) * std::sin(turn));
                const bool atEnd = glm::dot(normal, capsule.end - capsule.start) > 0.0F;
                const vec3 point = (atEnd ? capsule.end : capsule.start) + capsule.radius * normal;
                const bool outside = std::all_of(capsules.begin(), capsules.end(), [&](const Capsule& other) {
                    return distanceFrom(other, point) > -1e-4F;
                });
                if (outside) points.push_back({point, 1e-3F});
            }
        }
    }
    return points;
}

CapsuleBounds boundsOf(bool symmetric) {
    CapsuleBounds bounds;
    bounds.symmetric = symmetric;
    bounds.smallestRadius = 0.02F;
    bounds.largestRadius = 0.5F;
    bounds.nearM = 0.02F;
    return bounds;
}

float meanDistance(const std::vector<Capsule>& capsules, const std::vector<SkinPoint>& points) {
    float sum = 0.0F;
    for (const SkinPoint& point : points) {
        float least = 1e9F;
        for (const Capsule& capsule : capsules)
            least = std::min(least, distanceFrom(capsule, point.position));
        sum += std::abs(least);
    }
    return sum / static_cast<float>(points.size());
}

}  // namespace

TEST_CASE("a chest with a belly in front gets two capsules") {
    const Capsule chest{{0, 0.2F, 0}, {0, 0.6F, 0}, 0.15F};
    const Capsule belly{{0, 0.2F, 0.2F}, {0, 0.2F, 0.2F}, 0.2F};
    const auto skin = skinOf({chest, belly});
    const Capsule single{{0, 0.25F, 0.1F}, {0, 0.55F, 0.1F}, 0.2F};
    const auto found = fitSeveralCapsules(skin, single, boundsOf(true), 3);
    REQUIRE(found);
    CHECK(found->size() >= 2);
    CHECK(meanDistance(*found, skin) < 0.5F * meanDistance({single}, skin));
    float aside = 0.0F;
    for (const Capsule& capsule : *found)
        aside += capsule.start.x + capsule.end.x;
    CHECK(std::abs(aside) < 1e-5F);
}

TEST_CASE("shoulders beside a chest are a pair of mirror images, the middle one first") {
    const Capsule chest{{0, 0, 0}, {0, 0.5F, 0}, 0.16F};
    const Capsule left{{0.28F, 0.1F, 0}, {0.28F, 0.5F, 0}, 0.12F};
    const Capsule right{{-0.28F, 0.1F, 0}, {-0.28F, 0.5F, 0}, 0.12F};
    const auto skin = skinOf({chest, left, right});
    const Capsule single{{0, 0.1F, 0}, {0, 0.4F, 0}, 0.25F};
    const auto found = fitSeveralCapsules(skin, single, boundsOf(true), 3);
    REQUIRE(found);
    REQUIRE(found->size() == 3);
    CHECK(std::abs((*found)[0].start.x + (*found)[0].end.x) < 1e-6F);
    CHECK((*found)[1].start.x == Approx(-(*found)[2].start.x));
    CHECK((*found)[1].radius == Approx((*found)[2].radius));
    CHECK(meanDistance(*found, skin) < 0.01F);
    // With two at most there is no pair.
    const auto two = fitSeveralCapsules(skin, single, boundsOf(true), 2);
    CHECK((!two || two->size() == 2));
}

TEST_CASE("capsules that cling to the skin may not leave a body hollow") {
    // Skirts: cones of an oval cut, open at both ends.
    int several = 0;
    for (const float height : {0.2F, 0.3F, 0.45F}) {
        for (const float hem : {0.2F, 0.3F, 0.4F}) {
            for (const float depth : {0.5F, 0.75F, 1.0F}) {
                constexpr float kWaist = 0.13F;
                std::vector<SkinPoint> skin;
                std::vector<vec3> inside;
                for (int ring = 0; ring <= 16; ++ring) {
                    const float down = static_cast<float>(ring) / 16.0F;
                    const float radius = kWaist + (hem - kWaist) * down;
                    for (int step = 0; step < 32; ++step) {
                        const float turn = 2.0F * kPi * static_cast<float>(step) / 32.0F;
                        const vec3 way(std::cos(turn), 0, depth * std::sin(turn));
                        const vec3 middle(0, (0.5F - down) * height, 0);
                        skin.push_back({middle + radius * way, radius});
                        for (const float share : {0.1F, 0.3F, 0.5F, 0.7F, 0.9F})
                            inside.push_back(middle + radius * std::sqrt(share) * way);
                    }
                }
                const float radius = 0.5F * (kWaist + hem);
                const vec3 end(0, std::max(0.5F * height - radius, 0.0F), 0);
                const Capsule single{-end, end, radius};
                const auto covered = [&](const std::vector<Capsule>& capsules) {
                    const auto count = std::count_if(inside.begin(), inside.end(), [&](const vec3& point) {
                        return std::any_of(capsules.begin(), capsules.end(), [&](const Capsule& capsule) {
                            return distanceFrom(capsule, point) <= 0.0F;
                        });
                    });
                    return static_cast<float>(count) / static_cast<float>(inside.size());
                };
                for (const bool symmetric : {false, true}) {
                    const auto found = fitSeveralCapsules(skin, single, boundsOf(symmetric), 3);
                    if (!found) continue;
                    ++several;
                    INFO(height << " high, hem " << hem << " by " << depth * hem);
                    CHECK(covered(*found) > covered({single}) - 0.1F);
                }
            }
        }
    }
    CHECK(several > 0);
}

TEST_CASE("skin that one capsule covers keeps it") {
    const Capsule chest{{0, 0, 0}, {0, 0.5F, 0}, 0.16F};
    const auto skin = skinOf({chest});
    CHECK_FALSE(fitSeveralCapsules(skin, chest, boundsOf(true), 3));
    CHECK_FALSE(fitSeveralCapsules(skin, chest, boundsOf(false), 3));
}
