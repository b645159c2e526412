#include <fmt/format.h>

#include <memory>

#include "clip_output.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "run_simulation.hpp"
#include "scene/measure/report.hpp"

namespace lutka::cli {
namespace {

void runSimulate(SimulateOptions& options) {
    // A skin that is written has its pictures with it.
    options.ragdoll.model.textures = !options.bakedOut.empty() && !isMotionAlone(options.bakedOut);
    Run run = prepare(options);
    execute(options, run);
    if (run.replay) {
        tell("replayed {} steps of {}\n", run.steps, run.replay->model);
        return;
    }
    if (run.inputs) {
        tell("{} steps: the same as recorded at all {} checks\n", run.steps, run.inputs->checks.size());
        return;
    }
    const bool printed = options.fillsStandardOutput();
    if (options.json && !printed) fmt::print("{}", scene::reportJson(*run.simulation));
    if (!options.json && !printed) tell("{}", scene::reportText(*run.simulation));
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
    command
        .option("--fps", options->bakeFps,
                "frames a second of --out and --mesh-sequence: 24, 30 or 60; default: the steps'")
        .oneOf({"24", "30", "60"});
    command.onRun([options] { runSimulate(*options); });
}

}  // namespace lutka::cli
