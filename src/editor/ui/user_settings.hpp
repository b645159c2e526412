#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "editor/ui/side_panels.hpp"

namespace lutka::editor {

/// What the editor remembers between runs.
struct UserSettings {
    static constexpr std::size_t kMaxRecent = 24;
    std::vector<std::filesystem::path> recent;  ///< Models and scenes, the last one first.
    float uiScale = 0.0F;                       ///< Of the panels; 0: the monitor's.
    float leftWidth = 0.0F;                     ///< Of the side panels, in 96 dpi pixels; 0: their own.
    float rightWidth = 0.0F;
    float bottomHeight = 0.0F;
    std::map<std::string, PanelSide> tabSides;  ///< Of tabs that were moved, by their names.
    bool allowOutside = false;                  ///< animation::ImportOptions::allowOutside.

    /// Puts a file in front.
    void remember(const std::filesystem::path& file);
};

/// $XDG_CONFIG_HOME/lutka/editor.json, or the same in ~/.config; empty when neither variable is set.
[[nodiscard]] std::filesystem::path userSettingsFile();

/// What the file has; defaults where it is missing or not understood: settings are never worth an error.
[[nodiscard]] UserSettings loadUserSettings(const std::filesystem::path& file);
void saveUserSettings(const std::filesystem::path& file, const UserSettings& settings);

}  // namespace lutka::editor
