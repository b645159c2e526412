// A doll that walks with its muscles, is hit, and is knocked out.
#include <cstdio>

#include "scene/run/simulation.hpp"

using namespace lutka;

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    const auto ragdoll = scene::loadRagdoll(argv[1]);
    if (!ragdoll) {
        std::fprintf(stderr, "%s\n", ragdoll.error().text().c_str());
        return 3;
    }
    const scene::RagdollAsset& asset = *ragdoll.value();
    // [howto]
    scene::Scenario ground;
    ground.statics.push_back({});  // the plane y = 0
    ground.dolls.push_back({});

    scene::SimulationOptions options;
    options.puppet.emplace();
    options.puppet->start.clip = "walk";
    options.puppet->puppet.muscles = physics::musclesOf(physics::MusclePreset::powered);
    options.puppet->hits = {{"leftLowerArm", 1.0F, {0, 0, 8}}};  // N s, after a second
    auto simulation = scene::Simulation::create(asset, std::move(ground), options);
    if (!simulation) {
        std::fprintf(stderr, "%s\n", simulation.error().text().c_str());
        return 2;
    }
    physics::Puppet& puppet = simulation.value()->puppets()->puppet(0);
    puppet.onChange([](physics::PuppetState, physics::PuppetState after) {
        std::printf("%s\n", std::string(physics::puppetStateName(after)).c_str());
    });
    for (int step = 0; step < 150; ++step)
        simulation.value()->step();  // reacting at 1 s, animated again 0.4 s later
    const scene::PuppetFigures figures = simulation.value()->puppets()->figures();
    puppet.goLimp();
    for (int step = 0; step < 90; ++step)
        simulation.value()->step();
    // [/howto]
    const float hips = simulation.value()->worldFromBody(0)[0].translation.y;
    std::printf("%.2f degrees RMS behind the clip, then the hips lie at %.2f m\n", static_cast<double>(figures.rmsDeg),
                static_cast<double>(hips));
    return figures.rmsDeg < 10.0F && hips < 0.6F ? 0 : 1;
}
