// Take a fall away as an animation clip of the character (glTF).
#include <cstdio>

#include "animation/export/write_glb.hpp"
#include "scene/run/bake.hpp"
#include "scene/run/simulation.hpp"

using namespace lutka;

int main(int argc, char** argv) {
    if (argc != 3) return 2;
    const auto ragdoll = scene::loadRagdoll(argv[1]);
    if (!ragdoll) {
        std::fprintf(stderr, "%s\n", ragdoll.error().text().c_str());
        return 3;
    }
    const scene::RagdollAsset& asset = *ragdoll.value();
    auto scenario = scene::makeScenario({.name = "stairs", .seed = 1}, asset);
    if (!scenario) return 2;
    auto created = scene::Simulation::create(asset, std::move(scenario).value(), {});
    if (!created) return 2;
    // [howto]
    scene::Simulation& simulation = *created.value();
    scene::ClipBaker baker(0, 60.0F, "fall");  // doll 0, one sample a step
    baker.sample(simulation);                  // the start
    for (int step = 0; step < 180; ++step) {
        simulation.step();
        baker.sample(simulation);
    }
    const auto written =
        animation::writeGlb(argv[2], asset.character, std::span(&baker.clip(), 1), simulation.worldFromModel(0));
    if (!written) {
        std::fprintf(stderr, "%s\n", written.error().text().c_str());
        return 5;
    }
    // [/howto]
    return baker.clip().frameCount == 181 ? 0 : 1;
}
