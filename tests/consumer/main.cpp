// The library in one page: load a rigged model, let it fall for two seconds, take the fall away as a clip.
#include "animation/export/write_glb.hpp"
#include "scene/run/bake.hpp"
#include "scene/run/simulation.hpp"

#include <cstdio>

// [howto]
using namespace lutka;

Result<float> bakeFall(const char* model, const char* out) {
    const auto ragdoll = scene::loadRagdoll(model);  // import, map, fit
    if (!ragdoll) return ragdoll.error();
    const scene::RagdollAsset& asset = *ragdoll.value();

    auto scenario = scene::makeScenario({.name = "drop", .count = 1, .seed = 0}, asset);
    if (!scenario) return scenario.error();
    auto created = scene::Simulation::create(asset, std::move(scenario).value(), {});
    if (!created) return created.error();
    scene::Simulation& simulation = *created.value();

    scene::ClipBaker baker(0, 60.0F, "fall");
    for (int step = 0; step < 120; ++step) {
        simulation.step();  // 1/60 s; pose() and poseSkins() then give the skin's joints
        baker.sample(simulation);
    }
    const auto written = animation::writeGlb(out, asset.character, std::span(&baker.clip(), 1));
    if (!written) return written.error();
    return simulation.worldFromBody(0)[0].translation.y;  // body 0: the hips
}
// [/howto]

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fprintf(stderr, "usage: fall MODEL BAKED.glb\n");
        return 2;
    }
    const Result<float> height = bakeFall(argv[1], argv[2]);
    if (!height) {
        std::fprintf(stderr, "%s\n", height.error().text().c_str());  // what, where, and how to mend it
        return height.error().code == ErrorCode::output ? 5 : 3;
    }
    std::printf("the hips lie at %.3f m\n", static_cast<double>(height.value()));
    return 0;
}
