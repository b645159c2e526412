#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

#include "core/math.hpp"
#include "core/random.hpp"

#define LUTKA_KERNELS test_lanes
#define LUTKA_LANE_COUNT 8
#include "core/simd/lane_shuffles.hpp"
#include "core/simd/vector4.hpp"

namespace {

using namespace lutka;
using namespace lutka::simd::test_lanes;

constexpr float kClose = 2e-6F;

vec3 anyVector(Random& random) {
    return {random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2)};
}
quat anyTurn(Random& random) {
    return glm::normalize(quat(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1), 1.1F));
}

// One vector, rotation or transform a lane, and what lies in a lane.
V3 lanesOf(const vec3 (&v)[kLanes]) {
    V3 out;
    for (int lane = 0; lane < kLanes; ++lane) {
        out.x[lane] = v[lane].x;
        out.y[lane] = v[lane].y;
        out.z[lane] = v[lane].z;
    }
    return out;
}
Q lanesOf(const quat (&q)[kLanes]) {
    Q out;
    for (int lane = 0; lane < kLanes; ++lane) {
        out.x[lane] = q[lane].x;
        out.y[lane] = q[lane].y;
        out.z[lane] = q[lane].z;
        out.w[lane] = q[lane].w;
    }
    return out;
}
vec3 at(const V3& v, int lane) {
    return {v.x[lane], v.y[lane], v.z[lane]};
}
quat at(const Q& q, int lane) {
    return {q.w[lane], q.x[lane], q.y[lane], q.z[lane]};
}
float apart(const vec3& a, const vec3& b) {
    return glm::length(a - b);
}

}  // namespace

TEST_CASE("vectors and rotations in lanes are those of glm, lane by lane") {
    Random random(5);
    for (int round = 0; round < 20; ++round) {
        vec3 a[kLanes];
        vec3 b[kLanes];
        quat p[kLanes];
        quat q[kLanes];
        for (int lane = 0; lane < kLanes; ++lane) {
            a[lane] = anyVector(random);
            b[lane] = anyVector(random);
            p[lane] = anyTurn(random);
            q[lane] = anyTurn(random);
        }
        const V3 wideA = lanesOf(a);
        const V3 wideB = lanesOf(b);
        const Q wideP = lanesOf(p);
        const Q wideQ = lanesOf(q);
        const V3 crossed = cross(wideA, wideB);
        const F dotted = dot(wideA, wideB);
        const Q product = wideP * wideQ;
        const V3 turned = wideP * wideA;
        const Axes axes = axesOf(wideP);
        const V3 byAxes = axes * wideA;
        const V3 back = transposed(axes, byAxes);
        const Rigid there{wideP, wideB};
        const Rigid home = there * inverse(there);
        for (int lane = 0; lane < kLanes; ++lane) {
            CHECK(apart(at(crossed, lane), glm::cross(a[lane], b[lane])) < 8 * kClose);
            CHECK(std::abs(dotted[lane] - glm::dot(a[lane], b[lane])) < 8 * kClose);
            CHECK(std::abs(glm::dot(at(product, lane), p[lane] * q[lane])) > 1 - kClose);
            CHECK(apart(at(turned, lane), p[lane] * a[lane]) < 8 * kClose);
            CHECK(apart(at(byAxes, lane), p[lane] * a[lane]) < 8 * kClose);
            CHECK(apart(at(back, lane), a[lane]) < 8 * kClose);
            CHECK(apart(at(home.at, lane), vec3(0)) < 8 * kClose);
            CHECK(std::abs(home.turn.w[lane]) > 1 - kClose);
        }
    }
}

TEST_CASE("tangents in lanes are of unit length and across each other, for normals of both signs of z") {
    Random random(6);
    for (int round = 0; round < 20; ++round) {
        vec3 n[kLanes];
        for (vec3& normal : n)
            normal = glm::normalize(anyVector(random));
        n[0] = {0, 0, 1};
        n[1] = {0, 0, -1};
        const V3 normal = lanesOf(n);
        V3 t1;
        V3 t2;
        tangentsOf(normal, t1, t2);
        for (int lane = 0; lane < kLanes; ++lane) {
            const vec3 first = at(t1, lane);
            const vec3 second = at(t2, lane);
            CHECK(std::abs(glm::length(first) - 1) < kClose);
            CHECK(std::abs(glm::length(second) - 1) < kClose);
            CHECK(std::abs(glm::dot(first, n[lane])) < kClose);
            CHECK(std::abs(glm::dot(second, n[lane])) < kClose);
            CHECK(std::abs(glm::dot(first, second)) < kClose);
        }
    }
}

TEST_CASE("the inverse of a symmetric matrix in lanes undoes it") {
    Random random(7);
    Symmetric m;
    for (int lane = 0; lane < kLanes; ++lane) {
        m.xx[lane] = random.uniform(2, 3);
        m.yy[lane] = random.uniform(2, 3);
        m.zz[lane] = random.uniform(2, 3);
        m.xy[lane] = random.uniform(-0.5F, 0.5F);
        m.xz[lane] = random.uniform(-0.5F, 0.5F);
        m.yz[lane] = random.uniform(-0.5F, 0.5F);
    }
    vec3 v[kLanes];
    for (vec3& each : v)
        each = anyVector(random);
    const V3 back = inverse(m) * (m * lanesOf(v));
    for (int lane = 0; lane < kLanes; ++lane)
        CHECK(apart(at(back, lane), v[lane]) < 10 * kClose);
}

TEST_CASE("angles in lanes are atan2 to a millionth, with the sign of y") {
    Random random(8);
    for (int round = 0; round < 200; ++round) {
        F y;
        F x;
        for (int lane = 0; lane < kLanes; ++lane) {
            y[lane] = random.uniform(-1, 1);
            x[lane] = random.uniform(0, 1);
        }
        y[0] = 0;
        x[1] = 0;
        const F angle = angleOf(y, x);
        for (int lane = 0; lane < kLanes; ++lane)
            CHECK(std::abs(angle[lane] - std::atan2(y[lane], x[lane])) < kClose);
    }
}

TEST_CASE("masks choose a lane at a time and tell their bits") {
    const F counting{0, 1, 2, 3, 4, 5, 6, 7};
    const Mask odd = counting == all(1.0F) | counting == all(3.0F) | counting == all(5.0F) | counting == all(7.0F);
    CHECK(bits(odd) == 0xAAU);
    CHECK(bits(noLanes()) == 0U);
    const V3 chosen = choose(odd, {all(1.0F), all(2.0F), all(3.0F)}, {-all(1.0F), -all(2.0F), -all(3.0F)});
    CHECK(at(chosen, 2) == vec3(-1, -2, -3));
    CHECK(at(chosen, 3) == vec3(1, 2, 3));
    CHECK(clampLanes(counting, all(2.0F), all(5.0F))[0] == 2.0F);
    CHECK(clampLanes(counting, all(2.0F), all(5.0F))[6] == 5.0F);
}

TEST_CASE("small structures go to lanes and back without a change") {
    float vectors[3 * kLanes];
    float rigids[7 * kLanes];
    for (int i = 0; i < 3 * kLanes; ++i)
        vectors[i] = static_cast<float>(i) + 0.5F;
    for (int i = 0; i < 7 * kLanes; ++i)
        rigids[i] = static_cast<float>(i) - 0.25F;
    const V3 loaded = loadVectors(vectors);
    long offset[kLanes];
    for (int lane = 0; lane < kLanes; ++lane) {
        CHECK(at(loaded, lane) == vec3(vectors[3 * lane], vectors[3 * lane + 1], vectors[3 * lane + 2]));
        offset[lane] = 7L * (kLanes - 1 - lane);  // any order
    }
    float copies[3 * kLanes];
    storeVectors(copies, loaded);
    for (int i = 0; i < 3 * kLanes; ++i)
        CHECK(copies[i] == vectors[i]);
    const Rigid gathered = gatherRigid(rigids, offset);
    CHECK(gathered.turn.x[0] == rigids[7 * (kLanes - 1)]);
    CHECK(gathered.at.z[kLanes - 1] == rigids[6]);
    float scattered[7 * kLanes] = {};
    scatterRigid(scattered, offset, gathered);
    for (int i = 0; i < 7 * kLanes; ++i)
        CHECK(scattered[i] == rigids[i]);
}

TEST_CASE("a vector in one register crosses, dots and inverts as glm does") {
    using simd::F4;
    Random random(9);
    for (int round = 0; round < 50; ++round) {
        const vec3 a = anyVector(random);
        const vec3 b = anyVector(random);
        const F4 wideA{a.x, a.y, a.z, 0};
        const F4 wideB{b.x, b.y, b.z, 0};
        const F4 crossed = simd::cross(wideA, wideB);
        CHECK(apart({crossed[0], crossed[1], crossed[2]}, glm::cross(a, b)) < 8 * kClose);
        CHECK(crossed[3] == 0.0F);
        CHECK(std::abs(simd::dot(wideA, wideB) - glm::dot(a, b)) < 8 * kClose);
        const F4 difference = simd::crossDifference(wideA, wideB, wideB, wideA);
        CHECK(apart({difference[0], difference[1], difference[2]}, 2.0F * glm::cross(a, b)) < 16 * kClose);
        const simd::M4 m{{3, 0.1F * a.x, 0.1F * b.x, 0}, {0.1F * a.x, 2, 0.2F, 0}, {0.1F * b.x, 0.2F, 4, 0}};
        const F4 back = simd::inverseOfSymmetric(m) * (m * wideA);
        CHECK(apart({back[0], back[1], back[2]}, a) < 10 * kClose);
    }
}
