// A game as host: it has folders of the library's names, asks for C++17 and takes warnings for errors. It changes a
// profile, saves and loads it, pushes a doll, steps two worlds at once and is told what it does wrong.
#include <cstdio>
#include <cstdlib>
#include <lutka/core/version.hpp>
#include <lutka/physics/profile/profile_io.hpp>
#include <lutka/scene/run/simulation.hpp>
#include <thread>

#include "core/result.hpp"

using namespace lutka;

namespace {

void must(bool holds, const char* what) {
    if (holds) return;
    std::fprintf(stderr, "%s\n", what);
    std::exit(1);
}

template <class T>
T valueOf(Result<T> result) {
    must(result.ok(), result ? "" : result.error().text().c_str());
    return std::move(result).value();
}

std::unique_ptr<scene::Simulation> dropped(const scene::RagdollAsset& asset) {
    scene::SimulationOptions options;
    options.measure = false;
    return valueOf(scene::Simulation::create(asset, valueOf(scene::makeScenario({.name = "drop"}, asset)), options));
}

}  // namespace

int main(int argc, char** argv) {
    must(argc == 3, "usage: host MODEL PROFILE.ragdoll.json");
    must(OwnResult{}.code == 0 && !kVersion.empty(), "its own header and the library's");
    const auto fitted = valueOf(scene::loadRagdoll(argv[1]));

    physics::RagdollProfile profile = fitted->profile;
    profile.bodies[0].massKg += 1.0F;
    profile.totalMassKg += 1.0F;
    must(physics::saveProfile(argv[2], profile).ok(), "a profile is saved");
    scene::LoadOptions ours;
    ours.profile = argv[2];
    const auto edited = valueOf(scene::loadRagdoll(argv[1], ours));
    must(edited->profile.bodies[0].massKg == profile.bodies[0].massKg, "and loaded as it was");

    const auto first = dropped(*edited);
    const auto second = dropped(*edited);
    const auto run = [](scene::Simulation& simulation) {
        for (int step = 0; step < 120; ++step) {
            if (step == 30) simulation.world().applyImpulse(simulation.dollId(0), 0, {0, 50, 0}, {0, 1, 0});
            simulation.step();
            must(!simulation.poseSkins(1.0F).palette(0).empty(), "a palette");
        }
    };
    std::thread other([&] { run(*second); });
    run(*first);
    other.join();
    must(first->stateHash() == second->stateHash(), "two simulations side by side give the same bits");

    must(!scene::loadRagdoll("no.glb"), "a file that is not there is an error");
    scene::SimulationOptions wrong;
    wrong.dt = 0.0F;
    must(!scene::Simulation::create(*edited, scene::Scenario{}, wrong), "a step of no time is an error");
    int refused = 0;
    first->world().setRefusalSink([&](std::string_view) { ++refused; });
    first->world().applyImpulse({}, 0, {0, 1, 0}, {0, 0, 0});
    must(refused == 1, "a doll that is not there is refused");
    return 0;
}
