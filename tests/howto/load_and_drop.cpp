// Load a rigged model, let it fall for two seconds, say where it lies.
#include <cstdio>

#include "scene/run/simulation.hpp"

using namespace lutka;

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    // [howto]
    const auto ragdoll = scene::loadRagdoll(argv[1]);  // import, map, fit
    if (!ragdoll) {
        std::fprintf(stderr, "%s\n", ragdoll.error().text().c_str());
        return 3;
    }
    const scene::RagdollAsset& asset = *ragdoll.value();
    auto scenario = scene::makeScenario({.name = "drop"}, asset);
    if (!scenario) {
        std::fprintf(stderr, "%s\n", scenario.error().text().c_str());
        return 2;
    }
    auto simulation = scene::Simulation::create(asset, std::move(scenario).value(), {});
    if (!simulation) {
        std::fprintf(stderr, "%s\n", simulation.error().text().c_str());
        return 2;
    }
    while (simulation.value()->seconds() < 2.0)
        simulation.value()->step();  // 1/60 s
    const vec3 hips = simulation.value()->worldFromBody(0)[0].translation;
    std::printf("the hips lie at %.3f m\n", static_cast<double>(hips.y));
    // [/howto]
    return hips.y < 0.9F ? 0 : 1;
}
