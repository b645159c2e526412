// Bodies of several shapes in every format.
#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "animation/import/import_character.hpp"
#include "core/files.hpp"
#include "export/doll_layout.hpp"
#include "export/doll_source.hpp"
#include "export/read_gltf_physics.hpp"
#include "export/xml_tags.hpp"
#include "physics/collision/shape.hpp"
#include "support/catch.hpp"
#include "support/command.hpp"
#include "support/dolls.hpp"

using namespace lutka;
using namespace lutka::exporting;
using namespace lutka::test;

namespace {

// The doll with a capsule aslant and a box in its head.
physics::RagdollProfile headOfThree() {
    physics::RagdollProfile profile = makeDoll();
    physics::BodyProfile& head = profile.bodies[kHornedBody];
    const physics::AddedShape horn = hornOfHead();
    physics::AddedShape hat;
    hat.kind = physics::PrimitiveShape::Kind::box;
    hat.halfExtents = {0.1F, 0.03F, 0.12F};
    hat.bodyFromShape.translation = {0, 0.15F, 0};
    head.shape.more = {horn, hat};
    head.inertia = physics::shapeInertia(head.shape, head.massKg);
    return profile;
}

Exported threeAs(ExportFormat format) {
    return exportedAs(format, DollSource(headOfThree()));
}

std::string textAs(ExportFormat format) {
    return threeAs(format).bytes;
}

vec3 vec3From(const std::vector<float>& v) {
    return {v.at(0), v.at(1), v.at(2)};
}

}  // namespace

TEST_CASE("several shapes: MJCF has a geom for each, in its place") {
    const DollSource doll(headOfThree());
    const auto tags = xmlTags(textAs(ExportFormat::mjcf));
    std::vector<const XmlTag*> geoms;
    for (const XmlTag& tag : tags) {
        const bool ofHead = tag.name == "geom" && tag.parent >= 0 && tags[tag.parent].name == "body" &&
                            tags[tag.parent]["name"] == "head";
        if (ofHead) geoms.push_back(&tag);
    }
    REQUIRE(geoms.size() == 3);
    const physics::BodyShape& shape = doll.profile.bodies[kHornedBody].shape;
    CHECK(glm::distance(vec3From(geoms[1]->numbers("pos")), shape.more[0].bodyFromShape.translation) < 1e-6F);
    const auto q = geoms[1]->numbers("quat");
    // Their capsules lie along z.
    const vec3 axis = quat(q.at(0), q.at(1), q.at(2), q.at(3)) * vec3(0, 0, 1);
    CHECK(glm::distance(axis, shape.more[0].bodyFromShape.rotation * vec3(0, 1, 0)) < 1e-5F);
    CHECK((*geoms[2])["type"] == "box");
    CHECK(vec3From(geoms[2]->numbers("size")) == shape.more[1].halfExtents);
}

TEST_CASE("several shapes: URDF has a collision for each, three for a capsule") {
    const auto tags = xmlTags(textAs(ExportFormat::urdf));
    const auto ofHead = std::count_if(tags.begin(), tags.end(), [&](const XmlTag& tag) {
        return tag.name == "collision" && tags[tag.parent]["name"] == "head";
    });
    const bool capsule = headOfThree().bodies[kHornedBody].shape.kind == physics::PrimitiveShape::Kind::capsule;
    CHECK(ofHead == (capsule ? 3 : 1) + 3 + 1);
}

TEST_CASE("several shapes: Godot has a node and a resource for each") {
    const DollSource doll(headOfThree());
    const auto bodies = static_cast<int>(doll.profile.bodies.size());
    for (const ExportFormat format : {ExportFormat::godot4, ExportFormat::godot3}) {
        const std::string text = textAs(format);
        CHECK(occurrences(text, "type=\"CollisionShape") == bodies + 2);
        CHECK(occurrences(text, "[sub_resource") == bodies + 2 + 1);
        CHECK(text.find(fmt::format("load_steps={}", bodies + 4)) != std::string::npos);
        CHECK(text.find("[node name=\"Shape2\"") != std::string::npos);
        CHECK(text.find("[node name=\"Shape3\"") != std::string::npos);
    }
}

TEST_CASE("several shapes: the glTF's further colliders come back") {
    const DollSource doll(headOfThree());
    for (const auto& [format, name] :
         {std::pair(ExportFormat::glb, "doll.glb"), std::pair(ExportFormat::gltf, "doll.gltf")}) {
        INFO(name);
        const ScratchFolder folder;
        REQUIRE(writeFileAtomically(folder / name, textAs(format)));
        auto character = animation::importCharacter(folder / name);
        REQUIRE(character);
        const auto map = animation::mapHumanoid(character.value());
        const auto read = readGltfPhysics(folder / name, character.value(), map, doll.profile);
        REQUIRE(read);
        REQUIRE(read.value());
        const physics::RagdollProfile& back = *read.value();
        const int head = physics::bodyNamed(back, "head");
        REQUIRE(head >= 0);
        const physics::BodyShape& got = back.bodies[head].shape;
        const physics::BodyShape& wanted = doll.profile.bodies[kHornedBody].shape;
        REQUIRE(got.more.size() == 2);
        for (std::size_t i = 0; i < 2; ++i) {
            CHECK(got.more[i].kind == wanted.more[i].kind);
            CHECK(poseDifference(got.more[i].bodyFromShape, wanted.more[i].bodyFromShape) < 1e-5F);
        }
        CHECK(got.more[0].radius == Approx(wanted.more[0].radius).margin(1e-5));
        CHECK(got.more[0].halfLength == Approx(wanted.more[0].halfLength).margin(1e-5));
        CHECK(glm::distance(got.more[1].halfExtents, wanted.more[1].halfExtents) < 1e-5F);
        CHECK(glm::distance(back.bodies[head].inertia, doll.profile.bodies[kHornedBody].inertia) < 1e-5F);
        CHECK(back.bodies[0].shape.more.empty());
    }
}

TEST_CASE("several shapes: Bullet's C++ joins them, USD places them, Blender says what it leaves out") {
    const std::string bullet = textAs(ExportFormat::bullet);
    CHECK(occurrences(bullet, "std::make_unique<btCompoundShape>()") == 1);
    CHECK(occurrences(bullet, "addPart(*doll, *shape3") == 3);
    CHECK(bullet.find("std::move(shape3)") != std::string::npos);
    const DollSource plain;
    CHECK(exportRagdoll(ExportFormat::bullet, plain.source()).value().bytes.find("addPart") == std::string::npos);

    const std::string usd = textAs(ExportFormat::usd);
    CHECK(usd.find("def Capsule \"shape2\"") != std::string::npos);
    CHECK(usd.find("def Cube \"shape3\"") != std::string::npos);
    CHECK(occurrences(usd, "[\"xformOp:translate\", \"xformOp:orient\", \"xformOp:scale\"]") == 1);

    const auto warnings = threeAs(ExportFormat::blender).warnings;
    CHECK(std::any_of(warnings.begin(), warnings.end(), [](const std::string& warning) {
        return warning.find("head") != std::string::npos && warning.find("left out") != std::string::npos;
    }));
}
