#pragma once

#include "editor/ui/imgui_host.hpp"

namespace lutka::editor {

/// Loads DejaVu Sans (package fonts-dejavu-core) with accents, Greek and Cyrillic, and merges the first Japanese font
/// of fonts-noto-cjk, fonts-ipafont-gothic, fonts-vlgothic or fonts-droid-fallback that is there. Without any of them
/// Dear ImGui's built-in font stands in. `scale` as in ImguiHost.
[[nodiscard]] UiFonts loadFonts(float scale);

}  // namespace lutka::editor
