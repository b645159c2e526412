#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "core/result.hpp"
#include "editor/editor.hpp"
#include "editor/input/input_script.hpp"
#include "editor/ui/stats_readings.hpp"
#include "render/gl/renderer_options.hpp"

namespace lutka::editor {

struct ApplicationOptions {
    EditorOptions editor;
    bool headless = false;             ///< Without a window, on an EGL context.
    std::optional<InputScript> input;  ///< Its events in place of the user's, a frame every 1/60 s.
    std::filesystem::path recordInput;
    struct Screenshot {
        int frame = 0;
        std::filesystem::path file;
    };
    std::vector<Screenshot> screenshots;
    std::optional<int> frames;  ///< Ends after so many; headless needs this, an input or a screenshot to end.
    float uiScale = 0.0F;       ///< 0: the monitor's.
    /// The window is larger by the scale of the panels, as far as the monitor has room.
    bool windowFollowsScale = false;
    bool vsync = true;
    /// Without a window every picture is `best`: only those that are kept are drawn at all.
    render::RenderQuality quality = render::RenderQuality::automatic;
    /// Asked every frame: whether the process shall end. The editor then ends without a question.
    std::function<bool()> interrupted;
    std::filesystem::path recovery;  ///< As EditorOptions::recovery.
    AmendStats amendStats;           ///< As UiState has it.
    bool settings = true;  ///< Whether recent files are read from and kept in the user's configuration folder.
};

/// Runs the editor until it is closed. Fails with ErrorCode::noDisplay without a display or GL, and with whatever
/// loading, reading a script or writing a screenshot fails.
[[nodiscard]] Result<void> runApplication(const ApplicationOptions& options);

}  // namespace lutka::editor
