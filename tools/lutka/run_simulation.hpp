#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "options.hpp"
#include "scene/run/recording.hpp"
#include "scene/run/run_inputs.hpp"
#include "scene/run/scene_cast.hpp"
#include "scene/run/simulation.hpp"

namespace lutka::cli {

/// The scene's characters with their simulation at the start.
struct Run {
    scene::SceneCast cast;
    std::unique_ptr<scene::Simulation> simulation;
    int steps = 0;                           ///< What --seconds, the scene or the recording asks for.
    std::optional<scene::Recording> replay;  ///< Set: shown instead of simulating.
    std::optional<scene::RunInputs> inputs;  ///< Set: simulated again, and held against what came of it then.
};

/// Loads the characters and sets the scene up. Leaves on errors, first of all when an output has the wrong extension,
/// can't be written, or would destroy an input or another output. `picture` is one more output, of `render`. A scene
/// file in place of MODEL is taken for --scene.
[[nodiscard]] Run prepare(SimulateOptions& options, const std::filesystem::path& picture = {});

/// Steps (or replays) to the end, calls `afterStep` after every step, and writes what the options ask for: baked clip,
/// mesh, report and recording. Leaves on errors.
void execute(const SimulateOptions& options, Run& run, const std::function<void(scene::Simulation&)>& afterStep = {});

}  // namespace lutka::cli
