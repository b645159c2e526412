#include "physics/collision/solid_manifold.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <random>

#include "physics/collision/shape.hpp"
#include "support/catch.hpp"

using namespace lutka;
using namespace lutka::physics;

namespace {

class Chance {
  public:
    explicit Chance(unsigned seed) : engine_(seed) {}
    float operator()(float low, float high) { return std::uniform_real_distribution<float>(low, high)(engine_); }
    vec3 direction() {
        vec3 d(0);
        do
            d = {(*this)(-1, 1), (*this)(-1, 1), (*this)(-1, 1)};
        while (glm::dot(d, d) > 1.0F || glm::dot(d, d) < 0.01F);
        return glm::normalize(d);
    }
    quat rotation() { return glm::angleAxis((*this)(0, 3), direction()); }

  private:
    std::mt19937 engine_;
};

// Corners on an ellipsoid of about a limb's size.
PrimitiveShape roundHull(Chance& chance, int corners) {
    std::vector<vec3> points;
    const vec3 half(0.08F, 0.2F, 0.06F);
    for (int i = 0; i < corners; ++i)
        points.push_back(half * chance.direction());
    return centredHull(*makeConvexHull(points)).shape;
}

SolidPlace placed(const PrimitiveShape& shape, const RigidTransform& world) {
    return {shape.hull.get(), shape.halfExtents, world.translation, glm::mat3_cast(world.rotation)};
}

// How deep two shapes overlap at least in any of many directions; negative: in one of them they are apart.
float depthBySampling(const PrimitiveShape& a, const RigidTransform& inA, const PrimitiveShape& b,
                      const RigidTransform& inB, Chance& chance) {
    float least = 1e9F;
    vec3 best(0);
    const auto depthAlong = [&](const vec3& n) {  // from B to A
        return supportExtent(b, glm::conjugate(inB.rotation) * n) +
               supportExtent(a, glm::conjugate(inA.rotation) * -n) - glm::dot(n, inA.translation - inB.translation);
    };
    for (int i = 0; i < 2000; ++i) {
        const vec3 n = chance.direction();
        const float depth = depthAlong(n);
        if (depth < least) {
            least = depth;
            best = n;
        }
    }
    for (float step = 0.2F; step > 1e-4F; step *= 0.7F) {
        for (int i = 0; i < 20; ++i) {
            const vec3 n = glm::normalize(best + step * chance.direction());
            if (depthAlong(n) >= least) continue;
            least = depthAlong(n);
            best = n;
        }
    }
    return least;
}

}  // namespace

TEST_CASE("hulls: the depth is the least overlap of all directions, and some point has it") {
    Chance chance(7);
    for (int trial = 0; trial < 200; ++trial) {
        const PrimitiveShape a = roundHull(chance, 12 + trial % 20);
        PrimitiveShape b = roundHull(chance, 30);
        if (trial % 3 == 0) {
            b = {};
            b.kind = PrimitiveShape::Kind::box;
            b.halfExtents = {0.3F, 0.1F, 0.2F};
        }
        const RigidTransform inA{chance.rotation(), 0.12F * chance.direction()};
        const RigidTransform inB{chance.rotation(), vec3(0)};
        const float sampled = depthBySampling(a, inA, b, inB, chance);
        if (sampled < 0.002F) continue;
        INFO("trial " << trial);
        const float distance = distanceBetweenSolids(placed(a, inA), placed(b, inB));
        CHECK(-distance > 0.9F * sampled - 0.001F);
        CHECK(-distance < sampled + 0.001F);
        const SolidManifold manifold = touchSolids(placed(a, inA), placed(b, inB), 0.02F, 4);
        REQUIRE(manifold.count > 0);
        REQUIRE(manifold.count <= 4);
        float deepest = 1.0F;
        for (int i = 0; i < manifold.count; ++i) {
            const SolidManifold::Point& point = manifold.points[i];
            deepest = std::min(deepest, point.distance);
            // The two points are apart by that along the normal.
            const float apart = glm::dot(manifold.normal, inA * point.onA - inB * point.onB);
            CHECK(apart == Approx(point.distance).margin(1e-4));
        }
        CHECK(-deepest > 0.85F * sampled - 0.002F);
        CHECK(-deepest < 1.15F * sampled + 0.003F);
    }
}
