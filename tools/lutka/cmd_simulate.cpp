#include <fmt/format.h>

#include <memory>

#include "commands.hpp"
#include "run_simulation.hpp"
#include "scene/report.hpp"

namespace lutka::cli {
namespace {

void runSimulate(SimulateOptions& options) {
    Run run = prepare(options);
    execute(options, run);
    if (run.replay) {
        fmt::print("replayed {} steps of {}\n", run.steps, run.replay->model);
        return;
    }
    if (run.inputs) {
        fmt::print("{} steps: the same as recorded at all {} checks\n", run.steps, run.inputs->checks.size());
        return;
    }
    fmt::print("{}", options.json ? scene::reportJson(*run.simulation) : scene::reportText(*run.simulation));
    if (run.simulation->quality().nonFinite > 0) {
        leave({ErrorCode::internal, "the simulation gave numbers that are not finite",
               run.simulation->asset().character.file.string(), "please report the model and the options"});
    }
}

}  // namespace

void addSimulate(const Command& app) {
    auto options = std::make_shared<SimulateOptions>();
    const Command command = app.add("simulate", "Let the character fall without a window and measure it");
    options->addTo(command);
    command.onRun([options] { runSimulate(*options); });
}

}  // namespace lutka::cli
