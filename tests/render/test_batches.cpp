#include <algorithm>
#include <glm/geometric.hpp>

#include "core/random.hpp"
#include "render/line_batch.hpp"
#include "render/solid_batch.hpp"
#include "support/catch.hpp"

using namespace lutka;
using namespace lutka::render;

namespace {

const RigidTransform kPlace{glm::normalize(quat(0.7F, 0.2F, -0.5F, 0.3F)), vec3(1.0F, -2.0F, 0.5F)};
constexpr float kRadius = 0.3F;
constexpr float kHalfLength = 0.6F;

// Distance of a world point from the capsule's surface.
float awayFromCapsule(const vec3& world, float halfLength) {
    const vec3 local = inverse(kPlace) * world;
    const vec3 onAxis(0, std::clamp(local.y, -halfLength, halfLength), 0);
    return std::abs(glm::length(local - onAxis) - kRadius);
}

}  // namespace

TEST_CASE("a capsule's wireframe lies on its surface and reaches both poles and all sides") {
    for (const float halfLength : {kHalfLength, 0.0F}) {
        LineBatch lines;
        addCapsule(lines, kPlace, kRadius, halfLength, colors::cyan);
        REQUIRE(lines.segmentCount() > 50);
        vec3 lower(1e9F);
        vec3 upper(-1e9F);
        for (const LineVertex& vertex : lines.vertices) {
            CHECK(awayFromCapsule(vertex.position, halfLength) < 1e-5F);
            CHECK(vertex.color == colors::cyan);
            const vec3 local = inverse(kPlace) * vertex.position;
            lower = glm::min(lower, local);
            upper = glm::max(upper, local);
        }
        const vec3 reach(kRadius, halfLength + kRadius, kRadius);
        CHECK(glm::length(upper - reach) < 1e-4F);
        CHECK(glm::length(lower + reach) < 1e-4F);
    }
}

TEST_CASE("a capsule's triangles lie on its surface, face outward and enclose its volume") {
    SolidBatch solids;
    addCapsule(solids, kPlace, kRadius, kHalfLength, withAlpha(colors::orange, 0.5F));
    REQUIRE(solids.vertices.size() % 3 == 0);
    double volume = 0.0;
    for (std::size_t i = 0; i < solids.vertices.size(); i += 3) {
        const vec3& a = solids.vertices[i].position;
        const vec3& b = solids.vertices[i + 1].position;
        const vec3& c = solids.vertices[i + 2].position;
        CHECK(glm::dot(glm::cross(b - a, c - a), solids.vertices[i].normal) > 0.0F);
        const vec3 origin = kPlace.translation;
        volume += static_cast<double>(glm::dot(a - origin, glm::cross(b - origin, c - origin))) / 6.0;
        for (std::size_t k = 0; k < 3; ++k) {
            CHECK(awayFromCapsule(solids.vertices[i + k].position, kHalfLength) < 1e-5F);
            CHECK(solids.vertices[i + k].color.a == 128);
        }
    }
    const double r = kRadius;
    const double exact = static_cast<double>(kPi) * r * r * (2.0 * kHalfLength + 4.0 / 3.0 * r);
    CHECK(volume < exact);
    CHECK(volume > 0.96 * exact);
}

TEST_CASE("a box's twelve edges and twelve triangles have its corners") {
    const vec3 half(0.1F, 0.2F, 0.3F);
    LineBatch lines;
    addBox(lines, kPlace, half, colors::white);
    CHECK(lines.segmentCount() == 12);
    SolidBatch solids;
    addBox(solids, kPlace, half, colors::white);
    CHECK(solids.triangleCount() == 12);
    for (const LineVertex& vertex : lines.vertices)
        CHECK(glm::length(glm::abs(inverse(kPlace) * vertex.position) - half) < 1e-5F);
    for (std::size_t i = 0; i < solids.vertices.size(); i += 3) {
        const vec3& a = solids.vertices[i].position;
        const vec3 across = glm::cross(solids.vertices[i + 1].position - a, solids.vertices[i + 2].position - a);
        CHECK(glm::dot(across, solids.vertices[i].normal) > 0.0F);
        CHECK(glm::dot(a - kPlace.translation, solids.vertices[i].normal) > 0.0F);
    }
}

TEST_CASE("a hinge's arc runs from its lower to its upper angle about the frame's z") {
    LineBatch lines;
    addArc(lines, kPlace, radians(-30), radians(75), 0.2F, colors::green);
    float least = 10.0F;
    float most = -10.0F;
    for (const LineVertex& vertex : lines.vertices) {
        const vec3 local = inverse(kPlace) * vertex.position;
        CHECK(std::abs(local.z) < 1e-5F);
        if (glm::length(local) < 0.1F) continue;  // the spokes' inner ends
        CHECK(glm::length(local) == Approx(0.2F));
        const float angle = std::atan2(local.y, local.x);
        least = std::min(least, angle);
        most = std::max(most, angle);
    }
    CHECK(degrees(least) == Approx(-30.0F).margin(0.01));
    CHECK(degrees(most) == Approx(75.0F).margin(0.01));
}

TEST_CASE("the rim of a swing cone is where the limit's ellipse takes the x axis") {
    const float swingY = radians(40);
    const float swingZ = radians(85);
    LineBatch lines;
    addSwingCone(lines, kPlace, swingY, swingZ, 0.5F, colors::yellow);
    int onRim = 0;
    float widestY = 0.0F;
    float widestZ = 0.0F;
    for (const LineVertex& vertex : lines.vertices) {
        const vec3 local = inverse(kPlace) * vertex.position;
        if (glm::length(local) < 0.25F) continue;  // the apex
        ++onRim;
        CHECK(glm::length(local) == Approx(0.5F));
        // The swing is the shortest rotation from x; its rotation vector has no x.
        const vec3 swing = rotationVector(rotationBetween(vec3(1, 0, 0), local));
        const float inEllipse = std::pow(swing.y / swingY, 2.0F) + std::pow(swing.z / swingZ, 2.0F);
        CHECK(inEllipse == Approx(1.0F).margin(1e-3));
        widestY = std::max(widestY, std::abs(swing.y));
        widestZ = std::max(widestZ, std::abs(swing.z));
    }
    CHECK(onRim > 40);
    CHECK(widestY == Approx(swingY).margin(1e-3));
    CHECK(widestZ == Approx(swingZ).margin(1e-3));
}

TEST_CASE("an arrow ends at its tip, and one without length draws nothing") {
    LineBatch lines;
    addArrow(lines, vec3(1, 2, 3), vec3(1, 2, 3), colors::red);
    CHECK(lines.empty());
    addArrow(lines, vec3(0), vec3(0, 2, 0), colors::red);
    CHECK(lines.segmentCount() == 5);
    float highest = 0.0F;
    for (const LineVertex& vertex : lines.vertices)
        highest = std::max(highest, vertex.position.y);
    CHECK(highest == Approx(2.0F));
}

TEST_CASE("axes are red, green and blue along x, y and z") {
    LineBatch lines;
    addAxes(lines, kPlace, 0.25F);
    REQUIRE(lines.segmentCount() == 3);
    CHECK(lines.vertices[1].color == colors::red);
    CHECK(glm::length(inverse(kPlace) * lines.vertices[1].position - vec3(0.25F, 0, 0)) < 1e-6F);
    CHECK(lines.vertices[3].color == colors::green);
    CHECK(glm::length(inverse(kPlace) * lines.vertices[3].position - vec3(0, 0.25F, 0)) < 1e-6F);
    CHECK(lines.vertices[5].color == colors::blue);
    CHECK(glm::length(inverse(kPlace) * lines.vertices[5].position - vec3(0, 0, 0.25F)) < 1e-6F);
}

TEST_CASE("clearing a batch keeps its memory, so that the next frame allocates nothing") {
    LineBatch lines;
    addCapsule(lines, kPlace, kRadius, kHalfLength, colors::cyan);
    const std::size_t room = lines.vertices.capacity();
    lines.clear();
    CHECK(lines.empty());
    addCapsule(lines, kPlace, kRadius, kHalfLength, colors::cyan);
    CHECK(lines.vertices.capacity() == room);
}
