#pragma once

struct ImVec4;

namespace lutka::editor {

/// Sets Dear ImGui's colours and sizes: a calm theme, dark or light, with one accent.
void applyStyle(float scale, bool light = false);

/// The accent, the same orange as the selection in the view.
[[nodiscard]] ImVec4 accentColor();
[[nodiscard]] ImVec4 mutedColor();
[[nodiscard]] ImVec4 goodColor();
[[nodiscard]] ImVec4 warningColor();
[[nodiscard]] ImVec4 errorColor();

}  // namespace lutka::editor
