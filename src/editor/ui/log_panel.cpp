/// The tab Log: everything that was told, newest last, with a filter.

#include <imgui.h>
#include <imgui_stdlib.h>

#include "editor/ui/panels.hpp"
#include "editor/ui/style.hpp"
#include "editor/ui/widgets.hpp"

namespace lutka::editor {

void drawLogTab(const PanelContext& context) {
    UiState& state = context.state;
    const std::vector<LogLine>& log = context.editor.workspace().log;
    ImGui::SetNextItemWidth(-context.px(130));
    ImGui::InputTextWithHint("##logFilter", "filter", &state.logFilter);
    ImGui::SameLine();
    ImGui::Checkbox("no news", &state.logWarningsOnly);
    tooltip("Only warnings and errors");
    if (log.empty()) mutedText("Nothing has happened yet.");
    int shown = 0;
    std::string all;
    ImGui::BeginChild("##log", {0, -ImGui::GetFrameHeightWithSpacing()}, true);
    ImGui::PushTextWrapPos(0.0F);
    for (const LogLine& line : log) {
        if (state.logWarningsOnly && line.kind == Toast::Kind::info) continue;
        if (!containsText(line.text, state.logFilter)) continue;
        const ImVec4 color = line.kind == Toast::Kind::error     ? errorColor()
                             : line.kind == Toast::Kind::warning ? warningColor()
                                                                 : ImGui::GetStyleColorVec4(ImGuiCol_Text);
        ImGui::PushStyleColor(ImGuiCol_Text, color);
        ImGui::TextUnformatted(line.text.c_str());
        ImGui::PopStyleColor();
        all += line.text + '\n';
        ++shown;
    }
    ImGui::PopTextWrapPos();
    if (!log.empty() && shown == 0) mutedText("No line has that in it. Empty the filter to see all.");
    if (ImGui::GetScrollY() >= ImGui::GetScrollMaxY()) ImGui::SetScrollHereY(1.0F);
    ImGui::EndChild();
    if (ImGui::Button("Copy")) ImGui::SetClipboardText(all.c_str());
    tooltip("Copies the lines that are shown");
}

}  // namespace lutka::editor
