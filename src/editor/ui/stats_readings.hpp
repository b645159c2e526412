#pragma once

#include <functional>
#include <vector>

#include "editor/ui/frame_history.hpp"
#include "physics/world/step_times.hpp"

namespace lutka::editor {

/// What the Stats tab tells of the machine that it runs on; all else in it follows from the scene.
struct StatsReadings {
    FrameHistory history;
    std::vector<float> stepMs;  ///< Of the last steps.
    physics::StepTimes parts;   ///< Of the last step; its islands are the scene's own.
    double poseMs = 0.0;
    double residentBytes = 0.0;
};
/// Changes them before they are shown: whoever compares pictures gives its own.
using AmendStats = std::function<void(StatsReadings&)>;

}  // namespace lutka::editor
