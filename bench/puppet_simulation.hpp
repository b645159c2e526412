#pragma once

#include <fmt/format.h>

#include <memory>
#include <string>
#include <utility>

#include "scene/run/simulation.hpp"

/// The value, or null where there is an error, which is printed.
template <class T>
[[nodiscard]] std::unique_ptr<T> orTell(lutka::Result<std::unique_ptr<T>> result) {
    if (result) return std::move(result).value();
    fmt::print(stderr, "{}\n", result.error().text());
    return nullptr;
}

/// Dolls as puppets, by the solver of that name and without its quality being measured; null where that can't be, which
/// is printed. The asset must outlive it.
[[nodiscard]] inline std::unique_ptr<lutka::scene::Simulation> simulatePuppets(const lutka::scene::RagdollAsset& asset,
                                                                               lutka::scene::Scenario scenario,
                                                                               lutka::scene::PuppetPlay play,
                                                                               const std::string& solver) {
    lutka::scene::SimulationOptions options;
    options.world.solver = lutka::physics::solverNamed(solver).value_or(options.world.solver);
    options.measure = false;
    options.puppet = std::move(play);
    return orTell(lutka::scene::Simulation::create(asset, std::move(scenario), options));
}
