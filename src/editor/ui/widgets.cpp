#include "editor/ui/widgets.hpp"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cctype>

#include "editor/ui/style.hpp"

namespace lutka::editor {

void caption(const char* text) {
    ImGui::Spacing();
    ImGui::TextColored(mutedColor(), "%s", text);
}

void mutedText(const std::string& text) {
    ImGui::PushStyleColor(ImGuiCol_Text, mutedColor());
    ImGui::PushTextWrapPos(0.0F);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
}

void labelled(const char* label, float labelWidth) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(label);
    ImGui::SameLine(labelWidth);
    ImGui::SetNextItemWidth(-1.0F);
}

void tooltip(const std::string& text) {
    if (!ImGui::IsItemHovered() || ImGui::IsMouseDown(ImGuiMouseButton_Left)) return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 24.0F);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

// ASCII letters without their case; others as they are.
bool containsText(std::string_view text, std::string_view part) {
    const auto lower = [](char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); };
    return std::search(text.begin(), text.end(), part.begin(), part.end(),
                       [&](char a, char b) { return lower(a) == lower(b); }) != text.end();
}

void chip(const std::string& text, unsigned int color) {
    const ImVec2 padding(ImGui::GetStyle().FramePadding.x, 1.0F);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const ImVec2 end(at.x + size.x + 2 * padding.x, at.y + size.y + 2 * padding.y);
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->AddRectFilled(at, end, (color & 0x00FFFFFFU) | 0x38000000U, ImGui::GetStyle().FrameRounding);
    list->AddText({at.x + padding.x, at.y + padding.y}, color, text.c_str());
    ImGui::Dummy({end.x - at.x, end.y - at.y});
}

// Dear ImGui types on a click with Ctrl.
bool slider(const char* id, float& value, float low, float high, const char* format, bool logarithmic) {
    ImGuiIO& io = ImGui::GetIO();
    const bool control = io.KeyCtrl;
    io.KeyCtrl = control || ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
    const bool changed = ImGui::SliderFloat(id, &value, low, high, format,
                                            logarithmic ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None);
    io.KeyCtrl = control;
    return changed;
}

bool textLine(const char* id, std::string& value) {
    const std::string before = value;
    const bool entered = ImGui::InputText(id, &value, ImGuiInputTextFlags_EnterReturnsTrue);
    return (entered || ImGui::IsItemDeactivatedAfterEdit()) && value != before;
}

}  // namespace lutka::editor
