#include "physics/collision/triangle_mesh.hpp"

#include <glm/geometric.hpp>
#include <limits>

#include "core/random.hpp"
#include "physics/collision/box_manifold.hpp"
#include "physics/collision/contacts.hpp"
#include "physics/collision/mesh_contacts.hpp"
#include "physics/collision/shape_distance.hpp"
#include "physics/collision/solid_manifold.hpp"
#include "physics/collision/static_distance.hpp"
#include "support/catch.hpp"

using namespace lutka;
using physics::TriangleMesh;

namespace {

std::shared_ptr<const TriangleMesh> boxOf(const vec3& half) {
    std::vector<vec3> vertices;
    for (int i = 0; i < 8; ++i)
        vertices.push_back(half * vec3((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1));
    const std::vector<TriangleMesh::Triangle> triangles{{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6},
                                                        {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7},
                                                        {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    auto mesh = TriangleMesh::make(vertices, triangles);
    REQUIRE(mesh.ok());
    return std::move(mesh).value();
}

physics::CollisionGeometry meshGeometry(const TriangleMesh& mesh) {
    physics::CollisionGeometry geometry;
    geometry.kind = ShapeKind::mesh;
    geometry.mesh = &mesh;
    return geometry;
}

}  // namespace

TEST_CASE("a box of triangles has the distances of a box", "[mesh]") {
    const vec3 half(0.7F, 0.4F, 1.1F);
    const auto mesh = boxOf(half);
    Random random(3);
    for (int i = 0; i < 2000; ++i) {
        const vec3 point(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2));
        const physics::SurfaceDistance expected = physics::distanceToBox(point, half);
        const physics::MeshDistance found = mesh->distanceTo(point, 10.0F);
        REQUIRE(found.found);
        CHECK(found.distance == Approx(expected.distance).margin(1e-4));
        if (expected.distance > 0.01F) CHECK(glm::dot(found.normal, expected.normal) > 0.999F);
    }
    CHECK_FALSE(mesh->distanceTo({5, 0, 0}, 1.0F).found);
}

TEST_CASE("contacts with a box of triangles are those with a box", "[mesh]") {
    const vec3 half(0.5F, 0.3F, 0.6F);
    const auto mesh = boxOf(half);
    physics::CollisionGeometry box;
    box.kind = ShapeKind::box;
    box.halfExtents = half;
    Random random(11);
    int touching = 0;
    for (int i = 0; i < 3000; ++i) {
        physics::CollisionGeometry capsule;
        capsule.radius = 0.1F;
        capsule.halfLength = i % 3 == 0 ? 0.0F : 0.25F;
        capsule.worldFromShape.translation = {random.uniform(-1, 1), random.uniform(-0.8F, 0.8F),
                                              random.uniform(-1, 1)};
        capsule.worldFromShape.rotation =
            glm::normalize(quat(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1), 0.3F));
        const auto ours = findContacts(capsule, meshGeometry(*mesh), 0.04F);
        const auto theirs = findContacts(capsule, box, 0.04F);
        float nearest[2] = {1, 1};
        for (int k = 0; k < ours.count; ++k)
            nearest[0] = std::min(nearest[0], ours.contacts[k].distance);
        for (int k = 0; k < theirs.count; ++k)
            nearest[1] = std::min(nearest[1], theirs.contacts[k].distance);
        // Where the core is inside, both lead out, a box by its nearest face at that point.
        if (nearest[1] < -capsule.radius) continue;
        CHECK((ours.count > 0) == (theirs.count > 0));
        if (theirs.count > 0) CHECK(nearest[0] == Approx(nearest[1]).margin(2e-3));
        touching += theirs.count > 0 ? 1 : 0;
    }
    CHECK(touching > 500);
}

TEST_CASE("boxes that overlap a box of triangles are led out as far as two boxes that overlap", "[mesh]") {
    const vec3 half(0.5F, 0.3F, 0.6F);
    const auto mesh = boxOf(half);
    const vec3 own(0.2F, 0.15F, 0.3F);
    std::vector<vec3> corners;
    for (int i = 0; i < 8; ++i)
        corners.push_back(physics::boxCorner(own, i));
    const physics::ConvexHullPtr hull = physics::makeConvexHull(corners);
    REQUIRE(hull);
    Random random(17);
    int edges = 0;
    int overlapping = 0;
    int misses = 0;
    int tooDeep = 0;
    for (int i = 0; i < 20000; ++i) {
        physics::CollisionGeometry solid;
        const bool isHull = i % 4 == 0;
        solid.kind = isHull ? ShapeKind::hull : ShapeKind::box;
        solid.halfExtents = own;
        if (isHull) solid.hull = hull.get();
        solid.worldFromShape.translation = {random.uniform(-0.9F, 0.9F), random.uniform(-0.7F, 0.7F),
                                            random.uniform(-1, 1)};
        solid.worldFromShape.rotation =
            glm::normalize(quat(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1), 0.3F));
        const physics::SolidPlace place{nullptr, solid.halfExtents, solid.worldFromShape.translation,
                                        glm::mat3_cast(solid.worldFromShape.rotation)};
        const float depth = -distanceBetweenSolids(place, {nullptr, half, vec3(0), mat3(1)});
        if (depth < 0.001F || depth > 0.04F) continue;
        ++overlapping;
        const auto contacts = findContacts(solid, meshGeometry(*mesh), 0.02F);
        float deepest = -1.0F;
        for (int k = 0; k < contacts.count; ++k) {
            deepest = std::max(deepest, -contacts.contacts[k].distance);
            edges += contacts.contacts[k].feature >= physics::MeshContact::kFirstCrossing ? 1 : 0;
        }
        INFO(i << (isHull ? " hull" : " box"));
        CHECK(deepest > 0.0F);
        tooDeep += deepest > 1.15F * depth + 3e-3F ? 1 : 0;
        const physics::BoxManifold manifold =
            physics::touchBoxes({own, place.position, place.axes}, {half, vec3(0), mat3(1)}, 0.0F);
        float expected = 0.0F;
        for (int k = 0; k < manifold.count; ++k)
            expected = std::max(expected, -manifold.points[k].distance);
        misses += deepest < expected - 2e-3F ? 1 : 0;
    }
    // What overlaps most may lie beyond an edge, where nothing touches.
    CHECK(misses < overlapping / 50);
    CHECK(tooDeep < overlapping / 200);
    CHECK(overlapping > 1000);
    CHECK(edges > 500);
}

TEST_CASE("a box across the ridge of a roof touches it where its edges cross the ridge", "[mesh]") {
    // A roof along x, five metres long: the box's corners and the roof's are far from where they meet.
    const std::vector<vec3> vertices{{-2.5F, 0, 0}, {2.5F, 0, 0},    {-2.5F, -1, 1},
                                     {2.5F, -1, 1}, {-2.5F, -1, -1}, {2.5F, -1, -1}};
    const std::vector<TriangleMesh::Triangle> triangles{{0, 2, 1}, {1, 2, 3}, {0, 1, 4}, {1, 5, 4}};
    const auto mesh = TriangleMesh::make(vertices, triangles);
    REQUIRE(mesh.ok());
    physics::CollisionGeometry box;
    box.kind = ShapeKind::box;
    box.halfExtents = {0.2F, 0.1F, 0.8F};
    box.worldFromShape.translation = {0.3F, 0.095F, 0.1F};
    const auto contacts = findContacts(box, meshGeometry(*mesh.value()), 0.02F);
    REQUIRE(contacts.count == 2);
    for (int i = 0; i < 2; ++i) {
        CHECK(contacts.contacts[i].normal.y > 0.999F);
        CHECK(contacts.contacts[i].distance == Approx(-0.005F).margin(1e-4));
        CHECK(std::abs(contacts.contacts[i].position.x - 0.3F) == Approx(0.2F).margin(1e-4));
    }
}

TEST_CASE("a box over the rim of a sheet is held up by it, and never down", "[mesh]") {
    const std::vector<vec3> vertices{{-2, 0, -2}, {2, 0, -2}, {2, 0, 0}, {-2, 0, 0}};
    const auto sheet = TriangleMesh::make(vertices, std::vector<TriangleMesh::Triangle>{{0, 2, 1}, {0, 3, 2}});
    REQUIRE(sheet.ok());
    REQUIRE(sheet.value()->normals()[0].y > 0.9F);
    physics::CollisionGeometry box;
    box.kind = ShapeKind::box;
    box.halfExtents = {0.2F, 0.1F, 0.4F};
    for (const float height : {0.01F, -0.01F}) {
        box.worldFromShape.translation = {0.1F, 0.1F + height, 0.1F};
        const auto contacts = findContacts(box, meshGeometry(*sheet.value()), 0.02F);
        INFO(height);
        CHECK(contacts.count == 4);  // two corners and two crossings
        for (int i = 0; i < contacts.count; ++i) {
            CHECK(contacts.contacts[i].normal.y > 0.99F);
            CHECK(contacts.contacts[i].distance == Approx(height).margin(1e-4));
        }
    }
}

TEST_CASE("a box on a ridge is kept out of a post that is part of the same mesh", "[mesh]") {
    // The roof of above, and an upright blade whose edge is as sharp.
    const std::vector<vec3> vertices{{-2.5F, 0, 0},    {2.5F, 0, 0},    {-2.5F, -1, 1},    {2.5F, -1, 1},
                                     {-2.5F, -1, -1},  {2.5F, -1, -1},  {0.49F, -2, 0},    {0.49F, 2, 0},
                                     {1.5F, -2, 0.4F}, {1.5F, 2, 0.4F}, {1.5F, -2, -0.4F}, {1.5F, 2, -0.4F}};
    const std::vector<TriangleMesh::Triangle> triangles{{0, 2, 1}, {1, 2, 3}, {0, 1, 4},  {1, 5, 4},
                                                        {6, 8, 7}, {7, 8, 9}, {6, 7, 10}, {7, 11, 10}};
    const auto mesh = TriangleMesh::make(vertices, triangles);
    REQUIRE(mesh.ok());
    physics::CollisionGeometry box;
    box.kind = ShapeKind::box;
    box.halfExtents = {0.2F, 0.1F, 0.8F};
    box.worldFromShape.translation = {0.3F, 0.0994F, 0.1F};  // 0.6 mm in the ridge, 10 mm in the post
    const auto contacts = findContacts(box, meshGeometry(*mesh.value()), 0.02F);
    int up = 0;
    int aside = 0;
    for (int i = 0; i < contacts.count; ++i) {
        up += contacts.contacts[i].normal.y > 0.99F ? 1 : 0;
        aside +=
            contacts.contacts[i].normal.x < -0.99F && std::abs(contacts.contacts[i].distance + 0.01F) < 1e-3F ? 1 : 0;
    }
    CHECK(up == 2);
    CHECK(aside == 2);
}

TEST_CASE("a capsule on a plane of many triangles has two contacts with the plane's normal", "[mesh]") {
    std::vector<vec3> vertices;
    std::vector<TriangleMesh::Triangle> triangles;
    constexpr int kSide = 21;
    for (int i = 0; i < kSide * kSide; ++i)
        vertices.emplace_back(0.1F * static_cast<float>(i % kSide) - 1.0F, 0.0F,
                              0.1F * static_cast<float>(i / kSide) - 1.0F);
    for (int row = 0; row + 1 < kSide; ++row) {
        for (int column = 0; column + 1 < kSide; ++column) {
            const int at = row * kSide + column;
            triangles.push_back({at, at + kSide, at + 1});
            triangles.push_back({at + 1, at + kSide, at + kSide + 1});
        }
    }
    const auto mesh = TriangleMesh::make(vertices, triangles);
    REQUIRE(mesh.ok());
    for (int i = 0; i < 200; ++i) {
        physics::CollisionGeometry capsule;
        capsule.radius = 0.08F;
        capsule.halfLength = 0.2F;
        // On a grid that meets edges and corners exactly, too.
        capsule.worldFromShape.translation = {0.05F * static_cast<float>(i % 9) - 0.2F, 0.07F,
                                              0.05F * static_cast<float>(i % 11) - 0.25F};
        capsule.worldFromShape.rotation = glm::angleAxis(static_cast<float>(i % 8) * 0.25F * kPi, vec3(0, 1, 0)) *
                                          glm::angleAxis(0.5F * kPi, vec3(0, 0, 1));
        const auto contacts = findContacts(capsule, meshGeometry(*mesh.value()), 0.02F);
        REQUIRE(contacts.count == 2);
        for (int k = 0; k < 2; ++k) {
            CHECK(contacts.contacts[k].normal.y > 0.9999F);
            CHECK(contacts.contacts[k].distance == Approx(-0.01F).margin(1e-4));
        }
    }
}

TEST_CASE("the depth in a mesh that quality reports is that in the box it stands for", "[mesh]") {
    physics::StaticShape box;
    box.kind = physics::StaticShape::Kind::box;
    box.halfExtents = {1, 0.5F, 1};
    box.worldFromShape = {glm::angleAxis(0.3F, vec3(0, 0, 1)), {0.2F, -0.5F, 0}};
    physics::StaticShape mesh = box;
    mesh.kind = physics::StaticShape::Kind::mesh;
    mesh.mesh = boxOf(box.halfExtents);
    physics::BodyShape capsule;
    capsule.radius = 0.1F;
    capsule.halfLength = 0.3F;
    Random random(5);
    for (int i = 0; i < 500; ++i) {
        const RigidTransform at{
            glm::normalize(quat(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1), 0.3F)),
            {random.uniform(-1.5F, 1.5F), random.uniform(-0.3F, 0.8F), random.uniform(-1, 1)}};
        const float expected = distanceToStatic(capsule, at, box);
        if (expected > 0.2F) continue;
        CHECK(distanceToStatic(capsule, at, mesh) == Approx(expected).margin(2e-3));
    }
}

TEST_CASE("the depth of a box in a mesh counts edges that cross", "[mesh]") {
    physics::StaticShape mesh;
    mesh.kind = physics::StaticShape::Kind::mesh;
    mesh.mesh = boxOf({1, 0.5F, 1});
    physics::BodyShape box;
    box.kind = physics::PrimitiveShape::Kind::box;
    box.halfExtents = {0.2F, 0.1F, 0.6F};
    // Half over the edge, 1 cm in it: no corner of either is in the other on that side.
    CHECK(distanceToStatic(box, {quat(1, 0, 0, 0), {0, 0.59F, 1}}, mesh) == Approx(-0.01F).margin(1e-4));
    // Tilted about the edge, its own corners are outside altogether.
    const quat tilt = glm::angleAxis(0.6F, vec3(1, 0, 0));
    const vec3 centre = vec3(0, 0.5F, 1) + tilt * vec3(0, 0.09F, 0);
    CHECK(distanceToStatic(box, {tilt, centre}, mesh) == Approx(-0.01F).margin(1e-4));
}

TEST_CASE("a mesh of nonsense is refused with a reason", "[mesh]") {
    const std::vector<vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
    const std::vector<TriangleMesh::Triangle> outside{{0, 1, 3}};
    CHECK(TriangleMesh::make(corners, outside).error().message.find("vertex 3 of 3") != std::string::npos);
    const std::vector<TriangleMesh::Triangle> thin{{0, 1, 1}};
    CHECK_FALSE(TriangleMesh::make(corners, thin).ok());
    const std::vector<vec3> broken{{0, 0, 0}, {1, std::numeric_limits<float>::quiet_NaN(), 0}, {0, 0, 1}};
    const std::vector<TriangleMesh::Triangle> good{{0, 2, 1}};
    CHECK_FALSE(TriangleMesh::make(broken, good).ok());
    CHECK(TriangleMesh::make(corners, good).ok());
    CHECK_FALSE(TriangleMesh::make({}, {}).ok());
}
