// What is written is read back: the bodies as they were, the figure without joints of ours.
#include <algorithm>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "animation/import/import_character.hpp"
#include "core/files.hpp"
#include "export/doll_source.hpp"
#include "export/glb_container.hpp"
#include "export/read_gltf_physics.hpp"
#include "support/catch.hpp"
#include "support/command.hpp"
#include "support/dolls.hpp"

using namespace lutka;
using namespace lutka::exporting;
using namespace lutka::test;

namespace {

std::string written(const DollSource& doll, ExportFormat format) {
    return exportedAs(format, doll).bytes;
}

struct ReadBack {
    animation::Character character;
    Result<std::optional<physics::RagdollProfile>> physics = std::optional<physics::RagdollProfile>();
};

ReadBack readBack(const std::string& bytes, const std::string& name, const physics::RagdollProfile& base) {
    const ScratchFolder folder;
    REQUIRE(writeFileAtomically(folder / name, bytes));
    auto character = animation::importCharacter(folder / name);
    REQUIRE(character);
    ReadBack back{std::move(character).value()};
    const auto map = animation::mapHumanoid(back.character);
    back.physics = readGltfPhysics(folder / name, back.character, map, base);
    return back;
}

void checkSame(const physics::BodyProfile& got, const physics::BodyProfile& wanted) {
    CHECK(got.massKg == Approx(wanted.massKg).epsilon(1e-5));
    CHECK(glm::distance(got.inertia, wanted.inertia) < 1e-5F * glm::length(wanted.inertia));
    CHECK(got.shape.kind == wanted.shape.kind);
    CHECK(got.shape.radius == Approx(wanted.shape.radius).margin(1e-5));
    CHECK(got.shape.halfLength == Approx(wanted.shape.halfLength).margin(1e-5));
    CHECK(got.joint == wanted.joint);
    CHECK(poseDifference(got.jointFromBody, wanted.jointFromBody) < 1e-5F);
}

void checkSame(const physics::ConstraintProfile& got, const physics::ConstraintProfile& wanted) {
    CHECK(got.kind == wanted.kind);
    CHECK(poseDifference(got.parentFromFrame, wanted.parentFromFrame) < 1e-5F);
    CHECK(poseDifference(got.childFromFrame, wanted.childFromFrame) < 1e-5F);
    CHECK(got.frictionNm == Approx(wanted.frictionNm).margin(1e-5));
    if (wanted.kind == physics::ConstraintProfile::Kind::hinge) {
        CHECK(got.hinge.lower == Approx(wanted.hinge.lower).margin(1e-5));
        CHECK(got.hinge.upper == Approx(wanted.hinge.upper).margin(1e-5));
    } else {
        CHECK(got.cone.swingY == Approx(wanted.cone.swingY).margin(1e-5));
        CHECK(got.cone.swingZ == Approx(wanted.cone.swingZ).margin(1e-5));
        CHECK(got.cone.twist == Approx(wanted.cone.twist).margin(1e-5));
    }
}

// Names of pairs, whatever the bodies' order.
std::vector<std::string> pairNames(const physics::RagdollProfile& profile) {
    std::vector<std::string> names;
    for (const auto& [a, b] : profile.filteredPairs) {
        const std::string first(profile.bodies[a].name);
        const std::string second(profile.bodies[b].name);
        names.push_back(std::min(first, second) + " " + std::max(first, second));
    }
    std::sort(names.begin(), names.end());
    return names;
}

void checkSame(const physics::RagdollProfile& got, const physics::RagdollProfile& wanted) {
    REQUIRE(got.bodies.size() == wanted.bodies.size());
    CHECK(got.totalMassKg == Approx(wanted.totalMassKg).epsilon(1e-5));
    for (const physics::BodyProfile& body : wanted.bodies) {
        INFO(body.name);
        const int index = physics::bodyNamed(got, body.name);
        REQUIRE(index >= 0);
        checkSame(got.bodies[index], body);
    }
    for (const physics::ConstraintProfile& constraint : wanted.constraints) {
        const int child = physics::bodyNamed(got, wanted.bodies[constraint.child].name);
        INFO(got.bodies[child].name);
        const physics::ConstraintProfile& back = got.constraints.at(static_cast<std::size_t>(child) - 1);
        CHECK(got.bodies[back.parent].name == wanted.bodies[constraint.parent].name);
        checkSame(back, constraint);
    }
    CHECK(pairNames(got) == pairNames(wanted));
}

}  // namespace

TEST_CASE("glTF: the ragdoll comes back to 1e-5, from the binary and from the text") {
    physics::RagdollProfile profile = makeDoll();
    profile.filteredPairs = {{0, 2}, {1, 4}};
    // Both kinds of cone: one even, one not.
    profile.constraints[0].cone.swingZ = profile.constraints[0].cone.swingY;
    profile.constraints[1].cone.swingZ = 0.7F * profile.constraints[1].cone.swingY;
    const DollSource doll(profile);
    for (const auto& [format, name] :
         {std::pair(ExportFormat::glb, "doll.glb"), std::pair(ExportFormat::gltf, "doll.gltf")}) {
        INFO(name);
        const ReadBack back = readBack(written(doll, format), name, profile);
        REQUIRE(back.physics);
        REQUIRE(back.physics.value());
        checkSame(*back.physics.value(), profile);
    }
}

TEST_CASE("glTF: frames and colliders do not become joints") {
    const DollSource doll;
    const ReadBack back = readBack(written(doll, ExportFormat::glb), "doll.glb", doll.profile);
    const auto& names = back.character.skeleton.names;
    CHECK(std::none_of(names.begin(), names.end(), [](const std::string& name) {
        return name.find("collider") != std::string::npos || name.find("joint") != std::string::npos;
    }));
    CHECK(back.character.warnings.empty());
}

TEST_CASE("glTF: joints have both frames, and equal names of limits as the draft has them") {
    const DollSource doll;
    const auto json = unpackGlb(written(doll, ExportFormat::glb)).json;
    const auto& physics = json["extensions"]["KHR_physics_rigid_bodies"];
    CHECK(physics["physicsJoints"].size() == doll.profile.constraints.size());
    CHECK(json["extensions"]["KHR_implicit_shapes"]["shapes"].size() == doll.profile.bodies.size());
    for (std::size_t i = 0; i < doll.profile.constraints.size(); ++i) {
        const auto& c = doll.profile.constraints[i];
        const auto& limits = physics["physicsJoints"][i]["limits"];
        CHECK(limits[0]["linearAxes"] == nlohmann::ordered_json({0, 1, 2}));
        if (c.kind != physics::ConstraintProfile::Kind::hinge) continue;
        CHECK(limits[3]["angularAxes"] == nlohmann::ordered_json({2}));
        CHECK(limits[3]["min"].get<float>() == c.hinge.lower);
        CHECK(limits[3]["max"].get<float>() == c.hinge.upper);
    }
}

TEST_CASE("glTF: physics that is no ragdoll is refused with the reason, and a file without has none") {
    const DollSource doll;
    GlbContainer container = unpackGlb(written(doll, ExportFormat::glb));
    const auto reasonWith = [&](const auto& damage) {
        GlbContainer damaged = container;
        damage(damaged.json);
        const ReadBack back = readBack(packGlb(damaged), "doll.glb", doll.profile);
        return back.physics ? std::string("read") : back.physics.error().message;
    };
    auto physics = [](auto& json) -> auto& {
        return json["extensions"]["KHR_physics_rigid_bodies"];
    };
    CHECK(reasonWith([&](auto& json) { physics(json).erase("physicsJoints"); }) ==
          "the bodies do not hang on one root as one tree");
    CHECK(reasonWith([&](auto& json) { json["extensions"].erase("KHR_implicit_shapes"); }) ==
          "a collider is no capsule, sphere or box, and no hull that we wrote");
    CHECK(reasonWith([&](auto& json) { json.erase("extensions"); }) ==
          "a collider is no capsule, sphere or box, and no hull that we wrote");
    CHECK(reasonWith([&](auto& json) { physics(json)["physicsJoints"] = 7; }) ==
          "the bodies do not hang on one root as one tree");
    // Two bodies on one role.
    const std::string twice = reasonWith([&](auto& json) {
        for (auto& node : json["nodes"])
            if (node.contains("extensions") && node["extensions"]["KHR_physics_rigid_bodies"].contains("motion"))
                node["extensions"]["KHR_physics_rigid_bodies"]["motion"]["extras"]["lutkaRole"] = "head";
    });
    CHECK(twice != "read");
    CHECK(reasonWith([&](auto& json) {
              for (auto& node : json["nodes"])
                  node.erase("extensions");
          }) == "read");
}
