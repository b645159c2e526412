// Convex hulls in every format: carried, or replaced with a word.
#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "animation/import/import_character.hpp"
#include "core/files.hpp"
#include "export/doll_layout.hpp"
#include "export/doll_source.hpp"
#include "export/read_gltf_physics.hpp"
#include "export/text_builder.hpp"
#include "export/xml_tags.hpp"
#include "physics/collision/shape.hpp"
#include "support/catch.hpp"
#include "support/command.hpp"
#include "support/dolls.hpp"

using namespace lutka;
using namespace lutka::exporting;
using namespace lutka::test;

namespace {

// The doll with a hull as its head, and another in it.
physics::RagdollProfile headOfHulls() {
    physics::RagdollProfile profile = makeDoll();
    physics::BodyProfile& head = profile.bodies[kHornedBody];
    physics::AddedShape horn = hornOfHead();
    horn.hull = physics::hullWithin(horn);
    horn.kind = physics::PrimitiveShape::Kind::hull;
    head.shape.hull = physics::hullWithin(head.shape);
    head.shape.kind = physics::PrimitiveShape::Kind::hull;
    head.shape.more = {horn};
    head.inertia = physics::shapeInertia(head.shape, head.massKg);
    return profile;
}

Exported hullsAs(ExportFormat format) {
    return exportedAs(format, DollSource(headOfHulls()));
}

const physics::ConvexHull& headsHull(const DollSource& doll) {
    return *doll.profile.bodies[kHornedBody].shape.hull;
}

}  // namespace

TEST_CASE("hulls: MJCF has a mesh of the corners for each, and a geom of it") {
    const DollSource doll(headOfHulls());
    const auto tags = xmlTags(hullsAs(ExportFormat::mjcf).bytes);
    std::vector<const XmlTag*> meshes;
    std::vector<const XmlTag*> geoms;
    for (const XmlTag& tag : tags) {
        if (tag.name == "mesh") meshes.push_back(&tag);
        const bool isDefault = tag.parent >= 0 && tags[tag.parent].name == "default";
        if (tag.name == "geom" && !isDefault && tag["type"] == "mesh") geoms.push_back(&tag);
    }
    REQUIRE(meshes.size() == 2);
    REQUIRE(geoms.size() == 2);
    const std::vector<float> corners = meshes[0]->numbers("vertex");
    const auto points = headsHull(doll).points();
    REQUIRE(corners.size() == 3 * points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
        CHECK(vec3(corners[3 * i], corners[3 * i + 1], corners[3 * i + 2]) == points[i]);
    CHECK((*geoms[0])["mesh"] == (*meshes[0])["name"]);
    CHECK((*geoms[1])["mesh"] == (*meshes[1])["name"]);
}

TEST_CASE("hulls: both Godots get their corners") {
    const DollSource doll(headOfHulls());
    const std::string corners = pointsText(headsHull(doll), ", ");
    const std::string four = hullsAs(ExportFormat::godot4).bytes;
    CHECK(occurrences(four, "type=\"ConvexPolygonShape3D\"") == 2);
    CHECK(four.find("points = PackedVector3Array( " + corners + " )") != std::string::npos);
    const std::string three = hullsAs(ExportFormat::godot3).bytes;
    CHECK(occurrences(three, "type=\"ConvexPolygonShape\"") == 2);
    CHECK(three.find("points = PoolVector3Array( " + corners + " )") != std::string::npos);
}

TEST_CASE("hulls: URDF has what stands best for them, and says so") {
    const Exported urdf = hullsAs(ExportFormat::urdf);
    const auto warned = std::count_if(urdf.warnings.begin(), urdf.warnings.end(), [](const std::string& warning) {
        return warning.find("head: a hull can't be written") != std::string::npos;
    });
    CHECK(warned == 2);
    const DollSource plain;
    const auto without = exportRagdoll(ExportFormat::urdf, plain.source());
    REQUIRE(without);
    for (const std::string& warning : without.value().warnings)
        CHECK(warning.find("hull") == std::string::npos);
    const auto tags = xmlTags(urdf.bytes);
    CHECK(std::none_of(tags.begin(), tags.end(), [](const XmlTag& tag) { return tag.name == "mesh"; }));
    const auto ofHead = std::count_if(tags.begin(), tags.end(), [&](const XmlTag& tag) {
        return tag.name == "collision" && tags[tag.parent]["name"] == "head";
    });
    CHECK(ofHead >= 2);
}

TEST_CASE("hulls: USD has a mesh whose convex hull collides") {
    const std::string usd = hullsAs(ExportFormat::usd).bytes;
    CHECK(occurrences(usd, "def Mesh \"shape") == 2);
    CHECK(occurrences(usd, "physics:approximation = \"convexHull\"") == 2);
    CHECK(occurrences(usd, "\"PhysicsMeshCollisionAPI\"") == 2);
    CHECK(occurrences(usd, "int[] faceVertexIndices") == 2);
}

TEST_CASE("hulls: Blender and Bullet build them of their corners") {
    const DollSource doll(headOfHulls());
    const std::string blender = hullsAs(ExportFormat::blender).bytes;
    CHECK(occurrences(blender, "'CONVEX_HULL', [(") == 1);  // a body has one shape there
    const std::string bullet = hullsAs(ExportFormat::bullet).bytes;
    CHECK(occurrences(bullet, "hull({btVector3(") == 2);
    CHECK(occurrences(bullet, "std::unique_ptr<btCollisionShape> hull(") == 1);
    const DollSource plain;
    CHECK(exportRagdoll(ExportFormat::bullet, plain.source()).value().bytes.find("hull(") == std::string::npos);
}

TEST_CASE("hulls: the glTF's come back, and draw nothing") {
    const DollSource doll(headOfHulls());
    for (const auto& [format, name] :
         {std::pair(ExportFormat::glb, "doll.glb"), std::pair(ExportFormat::gltf, "doll.gltf")}) {
        INFO(name);
        const ScratchFolder folder;
        REQUIRE(writeFileAtomically(folder / name, hullsAs(format).bytes));
        auto character = animation::importCharacter(folder / name);
        REQUIRE(character);
        CHECK(character.value().meshes.size() == doll.character.meshes.size());
        CHECK(character.value().skeleton.jointCount() < doll.character.skeleton.jointCount() + 80);
        const auto map = animation::mapHumanoid(character.value());
        const auto read = readGltfPhysics(folder / name, character.value(), map, doll.profile);
        REQUIRE(read);
        REQUIRE(read.value());
        const physics::RagdollProfile& back = *read.value();
        const int head = physics::bodyNamed(back, "head");
        REQUIRE(head >= 0);
        const physics::BodyShape& got = back.bodies[head].shape;
        const physics::BodyShape& wanted = doll.profile.bodies[kHornedBody].shape;
        REQUIRE(got.kind == physics::PrimitiveShape::Kind::hull);
        REQUIRE(got.more.size() == 1);
        REQUIRE(got.more[0].kind == physics::PrimitiveShape::Kind::hull);
        CHECK(physics::sameHull(got.hull, wanted.hull));
        CHECK(physics::sameHull(got.more[0].hull, wanted.more[0].hull));
        CHECK(poseDifference(got.more[0].bodyFromShape, wanted.more[0].bodyFromShape) < 1e-5F);
        CHECK(poseDifference(back.bodies[head].jointFromBody, doll.profile.bodies[kHornedBody].jointFromBody) < 1e-5F);
    }
}
