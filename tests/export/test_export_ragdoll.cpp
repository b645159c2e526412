#include "export/export_ragdoll.hpp"

#include <nlohmann/json.hpp>
#include <set>

#include "export/doll_source.hpp"
#include "physics/collision/friction.hpp"
#include "support/catch.hpp"
#include "support/command.hpp"

using namespace lutka;
using namespace lutka::exporting;
using namespace lutka::test;

TEST_CASE("a format is known by its name and by the ending of the file, in any case of letters") {
    std::set<std::string_view> names;
    for (const ExportFormatInfo& info : exportFormats()) {
        CHECK(names.insert(info.name).second);
        CHECK(exportFormatNamed(info.name) == info.format);
        CHECK(exportFormatOf("a folder/doll" + std::string(info.ending)).has_value());
    }
    CHECK(exportFormatOf("DOLL.XML") == ExportFormat::mjcf);
    CHECK_FALSE(exportFormatOf("doll.txt"));
    CHECK_FALSE(exportFormatOf(".xml"));
    CHECK_FALSE(exportFormatNamed("xml"));
}

TEST_CASE("every format writes the hand-made doll, and has a section in docs/export.md") {
    const DollSource doll;
    const std::string page = fileText(LUTKA_TESTS_DIR "/../docs/export.md");
    for (const ExportFormatInfo& info : exportFormats()) {
        INFO(info.name);
        const auto exported = exportRagdoll(info.format, doll.source());
        REQUIRE(exported);
        CHECK(exported.value().bytes.size() > 1000);
        CHECK(exported.value().bytes.find("nan") == std::string::npos);
        CHECK(page.find("`" + std::string(info.name) + "`") != std::string::npos);
    }
}

// How rough a doll is on the ground by an engine's own rule for the two sides of a contact: docs/engines.md,
// "Friction".
TEST_CASE("every format that says how rough a doll is means the friction that it has here") {
    const DollSource doll;
    const std::size_t bodies = doll.profile.bodies.size();
    const auto linesOf = [&](ExportFormat format, const std::string& line) {
        return static_cast<std::size_t>(occurrences(exportedAs(format, doll).bytes, line));
    };
    STATIC_REQUIRE(physics::kBodyFriction * physics::kStaticFriction == 0.4F);
    CHECK(linesOf(ExportFormat::godot4, "\nfriction = 0.4\n") == bodies);  // the less of both
    CHECK(linesOf(ExportFormat::godot3, "\nfriction = 0.4\n") == bodies);
    CHECK(linesOf(ExportFormat::mjcf, "priority=\"1\" friction=\"0.4 ") == 1);      // that of the higher priority
    CHECK(linesOf(ExportFormat::bullet, "m_friction = 0.5f;") == 1);                // the product
    CHECK(linesOf(ExportFormat::blender, "body.rigid_body.friction = 0.5 ") == 1);  // likewise
    CHECK(linesOf(ExportFormat::blender, "floor.rigid_body.friction = 0.8\n") == 1);
    const auto material = nlohmann::json::parse(exportedAs(ExportFormat::gltf, doll).bytes)
                              .at("extensions")
                              .at("KHR_physics_rigid_bodies")
                              .at("physicsMaterials")
                              .at(0);
    CHECK(material.at("dynamicFriction") == 0.5);
    CHECK(material.at("staticFriction") == 0.5);
    CHECK(material.at("frictionCombine") == "multiply");
}
