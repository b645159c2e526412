#include "scene/asset/ragdoll_asset.hpp"

#include <glm/geometric.hpp>

#include "animation/import/figure_file.hpp"
#include "physics/profile/profile_io.hpp"
#include "support/catch.hpp"
#include "support/command.hpp"
#include "support/ragdolls.hpp"

using namespace lutka;
using namespace lutka::scene;

namespace {

// The biped with every joint renamed and all of it larger by `scale`.
animation::Character otherBiped(float scale, const std::string& prefix) {
    animation::Character other = test::makeBiped();
    for (std::string& name : other.skeleton.names)
        name = prefix + name;
    for (auto* frames : {&other.skeleton.bindModelFromJoint, &other.skeleton.nodeParentFromJoint}) {
        for (RigidTransform& frame : *frames)
            frame.translation *= scale;
    }
    for (vec3& position : other.meshes[0].positions)
        position *= scale;
    return other;
}

LoadOptions withProfile(const std::string& file) {
    LoadOptions options;
    options.profile = file;
    return options;
}

}  // namespace

TEST_CASE("a character whose skeleton's arrays do not agree is refused") {
    animation::Character character = test::makeBiped();
    character.skeleton.skinWeight.pop_back();
    const auto asset = makeRagdoll(std::move(character));
    REQUIRE_FALSE(asset.ok());
    CHECK(asset.error().code == ErrorCode::usage);
    CHECK_THAT(asset.error().message, Catch::Contains("different sizes"));
}

TEST_CASE("a profile read for its own rig is taken as it is") {
    const test::ScratchFolder folder;
    auto asset = test::bipedRagdoll();
    asset->profile.bodies[3].shape.radius *= 1.1F;  // edited by hand
    REQUIRE(physics::saveProfile(folder / "own.ragdoll.json", asset->profile));
    const auto again = makeRagdoll(test::makeBiped(), withProfile(folder / "own.ragdoll.json"));
    REQUIRE(again);
    CHECK_FALSE(again.value()->rebound);
    CHECK(again.value()->profile.bodies[3].shape.radius == asset->profile.bodies[3].shape.radius);
}

TEST_CASE("a profile made for another rig is bound by role, with shapes of this one") {
    const test::ScratchFolder folder;
    const auto asset = test::bipedRagdoll();
    REQUIRE(physics::saveProfile(folder / "biped.ragdoll.json", asset->profile));
    for (const std::string prefix : {"", "rig_"}) {  // the same names with other proportions are another rig too
        INFO(prefix);
        const auto other = makeRagdoll(otherBiped(1.2F, prefix), withProfile(folder / "biped.ragdoll.json"));
        REQUIRE(other);
        CHECK(other.value()->rebound);
        const physics::RagdollProfile& profile = other.value()->profile;
        REQUIRE(profile.bodies.size() == asset->profile.bodies.size());
        for (std::size_t i = 0; i < profile.bodies.size(); ++i) {
            CHECK(profile.bodies[i].massKg == Approx(asset->profile.bodies[i].massKg));
            CHECK(profile.bodies[i].shape.radius == Approx(1.2F * asset->profile.bodies[i].shape.radius).epsilon(0.1));
        }
    }
}

TEST_CASE("a profile made of one of a file's figures finds that figure again") {
    const test::ScratchFolder folder;
    test::makePair().saveBinary(folder / "pair.glb");
    for (const int figure : {1, 2}) {
        LoadOptions made;
        made.import.figure = figure;
        const auto asset = loadRagdoll(folder / "pair.glb", made);
        REQUIRE(asset);
        CHECK(asset.value()->character.figure == figure - 1);
        REQUIRE(physics::saveProfile(folder / "own.ragdoll.json", asset.value()->profile));
        const auto again = loadRagdoll(folder / "pair.glb", withProfile(folder / "own.ragdoll.json"));
        REQUIRE(again);
        CHECK(again.value()->character.figure == figure - 1);
        CHECK_FALSE(again.value()->rebound);
        // Who asks for another figure gets it, with the profile bound by role.
        LoadOptions other = withProfile(folder / "own.ragdoll.json");
        other.import.figure = 3 - figure;
        const auto bound = loadRagdoll(folder / "pair.glb", other);
        REQUIRE(bound);
        CHECK(bound.value()->character.figure == 2 - figure);
        CHECK(bound.value()->rebound);
    }
}
