#include "core/quantile.hpp"

#include <algorithm>
#include <vector>

#include "core/random.hpp"
#include "support/catch.hpp"

using namespace lutka;

namespace {

struct Point {
    float at = 0.0F;
    float area = 0.0F;
};

// By the definition: all in order, counted from below.
float plainQuantile(std::vector<Point> points, double share) {
    std::sort(points.begin(), points.end(), [](const Point& a, const Point& b) { return a.at < b.at; });
    double total = 0.0;
    for (const Point& point : points)
        total += static_cast<double>(point.area);
    double below = 0.0;
    for (const Point& point : points) {
        below += total > 0.0 ? static_cast<double>(point.area) : 1.0;
        if (below >= share * (total > 0.0 ? total : static_cast<double>(points.size()))) return point.at;
    }
    return points.back().at;
}

std::vector<Point> randomPoints(std::size_t count, float leastArea, float mostArea, std::uint64_t seed) {
    Random random(seed);
    std::vector<Point> points(count);
    for (Point& point : points) {
        point.at = random.uniform(-1.0F, 1.0F);
        point.area = random.uniform(leastArea, mostArea);
    }
    return points;
}

float at(const Point& point) {
    return point.at;
}

}  // namespace

TEST_CASE("quantiles are those of the points in order, from whichever end they are counted") {
    for (const std::size_t count : {1, 2, 7, 30, 400, 3000}) {
        for (std::uint64_t seed = 1; seed <= 20; ++seed) {
            INFO("count " << count << ", seed " << seed);
            const std::vector<Point> weighted = randomPoints(count, 0.1F, 1.0F, seed);
            const std::vector<Point> unweighted = randomPoints(count, 0.0F, 0.0F, seed);
            for (const float share : {0.0F, 0.0111F, 0.3137F, 0.5F, 0.8123F, 0.9902F}) {
                INFO("share " << share);
                CHECK(quantileOf(weighted, share, at) == plainQuantile(weighted, share));
                CHECK(quantileOf(unweighted, share, at) == plainQuantile(unweighted, share));
            }
        }
    }
}

TEST_CASE("an end of the points whose area is small is passed to its whole length") {
    std::vector<Point> points = randomPoints(1000, 1.0F, 1.0F, 5);
    for (Point& point : points) {
        if (point.at < 0.2F) point.area = 1e-6F;
    }
    const auto ends = quantilesOf(points, std::array<float, 2>{0.01F, 0.99F}, at);
    CHECK(ends[0] == plainQuantile(points, 0.01));
    CHECK(ends[0] >= 0.2F);
    CHECK(ends[1] == plainQuantile(points, 0.99));
}

TEST_CASE("points of one value have it as all their quantiles") {
    const std::vector<Point> points(50, Point{0.25F, 0.1F});
    for (const float share : {0.0F, 0.01F, 0.5F, 0.99F, 1.0F})
        CHECK(quantileOf(points, share, at) == 0.25F);
}
