// Whether real models come to rest in the `bullet` world.
#include "scene/simulation.hpp"
#include "support/catch.hpp"
#include "support/zoo.hpp"

using namespace lutka;

namespace {

bool comesToRest(const scene::RagdollAsset& asset, std::string_view scene) {
    auto scenario = scene::makeScenario(scene, 1, 0, scene::figureBounds(asset.profile, asset.rig),
                                        asset.profile.standardFromModel);
    REQUIRE(scenario.ok());
    auto simulation = scene::Simulation::create(asset, std::move(scenario).value(), {});
    REQUIRE(simulation.ok());
    while (simulation.value()->seconds() < 8.0)
        simulation.value()->step();
    const auto settled = simulation.value()->quality().settleSeconds;
    return settled && *settled <= 6.0F;
}

}  // namespace

TEST_CASE("real models come to rest within six seconds of the first contact, on edges and limits as well") {
    if (!test::zooIsThere()) return;
    // The first three rocked on the limits of their spines, or crept, before.
    for (const char* file :
         {"ozz_pab_skeleton_zup_dae/skeleton_zup.dae", "quaternius_man_fbx/Male_Casual.fbx",
          "godot_mannequiny/mannequiny.glb", "cesium_man_glb/CesiumMan.glb", "rocketbox_male/Male_Adult_17.fbx"}) {
        scene::LoadOptions options;
        options.import.loadTextures = false;
        const auto asset = scene::loadRagdoll(test::zooFile(file), options);
        REQUIRE(asset.ok());
        for (const char* scene : {"drop", "stairs", "throw"}) {
            INFO(file << ", " << scene);
            CHECK(comesToRest(*asset.value(), scene));
        }
    }
}
