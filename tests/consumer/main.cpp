// The library in one page: load a rigged model, let it fall for two seconds, take the fall away as a clip.
#include <cstdio>

#include "animation/export/write_glb.hpp"
#include "scene/bake.hpp"
#include "scene/simulation.hpp"

int main(int argc, char** argv) {
    using namespace lutka;
    if (argc != 3) {
        std::fprintf(stderr, "usage: fall MODEL BAKED.glb\n");
        return 2;
    }
    const auto ragdoll = scene::loadRagdoll(argv[1]);  // import, map, fit
    if (!ragdoll) {
        std::fprintf(stderr, "%s\n", ragdoll.error().text().c_str());
        return 3;
    }
    const scene::RagdollAsset& asset = *ragdoll.value();
    auto scenario = scene::makeScenario("drop", 1, 0, scene::figureBounds(asset.profile, asset.rig),
                                        asset.profile.standardFromModel);
    auto simulation = scene::Simulation::create(asset, std::move(scenario).value(), {});

    scene::ClipBaker baker(0, 60.0F, "fall");
    for (int step = 0; step < 120; ++step) {
        simulation.value()->step();
        baker.sample(*simulation.value());
    }
    const auto written = animation::writeGlb(argv[2], asset.character, std::span(&baker.clip(), 1));
    if (!written) {
        std::fprintf(stderr, "%s\n", written.error().text().c_str());
        return 5;
    }
    std::printf("%zu bodies fell; the hips lie at %.3f m\n", asset.profile.bodies.size(),
                static_cast<double>(simulation.value()->worldFromBody(0)[0].translation.y));
    return 0;
}
