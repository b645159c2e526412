#include "editor/ui/style.hpp"

#include <imgui.h>

namespace lutka::editor {
namespace {

// sRGB bytes, as in a picture.
ImVec4 rgb(int r, int g, int b, float alpha = 1.0F) {
    return {static_cast<float>(r) / 255.0F, static_cast<float>(g) / 255.0F, static_cast<float>(b) / 255.0F, alpha};
}

void setColors(ImVec4* colors) {
    const ImVec4 panel = rgb(34, 36, 41);
    const ImVec4 field = rgb(48, 51, 58);
    const ImVec4 fieldHovered = rgb(60, 64, 73);
    const ImVec4 fieldActive = rgb(72, 77, 88);
    const ImVec4 accent = accentColor();
    const ImVec4 accentSoft = rgb(255, 150, 46, 0.28F);
    colors[ImGuiCol_Text] = rgb(224, 226, 230);
    colors[ImGuiCol_TextDisabled] = mutedColor();
    colors[ImGuiCol_WindowBg] = panel;
    colors[ImGuiCol_ChildBg] = rgb(28, 30, 34);
    colors[ImGuiCol_PopupBg] = rgb(40, 43, 49, 0.98F);
    colors[ImGuiCol_Border] = rgb(58, 62, 70);
    colors[ImGuiCol_FrameBg] = field;
    colors[ImGuiCol_FrameBgHovered] = fieldHovered;
    colors[ImGuiCol_FrameBgActive] = fieldActive;
    colors[ImGuiCol_TitleBg] = colors[ImGuiCol_TitleBgActive] = rgb(42, 45, 52);
    colors[ImGuiCol_MenuBarBg] = rgb(28, 30, 34);
    colors[ImGuiCol_ScrollbarBg] = rgb(0, 0, 0, 0.0F);
    colors[ImGuiCol_ScrollbarGrab] = rgb(70, 74, 84);
    colors[ImGuiCol_ScrollbarGrabHovered] = rgb(88, 93, 104);
    colors[ImGuiCol_ScrollbarGrabActive] = rgb(104, 110, 122);
    colors[ImGuiCol_CheckMark] = accent;
    colors[ImGuiCol_SliderGrab] = rgb(214, 132, 50, 0.85F);
    colors[ImGuiCol_SliderGrabActive] = accent;
    colors[ImGuiCol_Button] = rgb(56, 60, 68);
    colors[ImGuiCol_ButtonHovered] = rgb(70, 75, 85);
    colors[ImGuiCol_ButtonActive] = rgb(84, 90, 102);
    colors[ImGuiCol_Header] = accentSoft;
    colors[ImGuiCol_HeaderHovered] = rgb(64, 68, 78);
    colors[ImGuiCol_HeaderActive] = rgb(76, 81, 92);
    colors[ImGuiCol_Separator] = rgb(54, 58, 66);
    colors[ImGuiCol_Tab] = rgb(34, 36, 41);
    colors[ImGuiCol_TabHovered] = rgb(64, 68, 78);
    colors[ImGuiCol_TabActive] = rgb(58, 62, 71);
    colors[ImGuiCol_TabUnfocused] = colors[ImGuiCol_Tab];
    colors[ImGuiCol_TabUnfocusedActive] = colors[ImGuiCol_TabActive];
    colors[ImGuiCol_PlotLines] = rgb(140, 196, 240);
    colors[ImGuiCol_PlotHistogram] = accent;
    colors[ImGuiCol_TableHeaderBg] = rgb(42, 45, 52);
    colors[ImGuiCol_TableBorderLight] = rgb(46, 49, 56);
    colors[ImGuiCol_TableRowBgAlt] = rgb(255, 255, 255, 0.025F);
    colors[ImGuiCol_TextSelectedBg] = accentSoft;
    colors[ImGuiCol_DragDropTarget] = accent;
    colors[ImGuiCol_NavHighlight] = accent;
    colors[ImGuiCol_ModalWindowDimBg] = rgb(12, 13, 15, 0.55F);
}

}  // namespace

ImVec4 accentColor() {
    return rgb(255, 150, 46);
}
ImVec4 mutedColor() {
    return rgb(150, 154, 163);
}
ImVec4 goodColor() {
    return rgb(126, 200, 120);
}
ImVec4 warningColor() {
    return rgb(240, 196, 84);
}
ImVec4 errorColor() {
    return rgb(240, 110, 98);
}

void applyStyle(float scale) {
    ImGuiStyle& style = ImGui::GetStyle();
    style = ImGuiStyle();
    style.WindowRounding = 4.0F;
    style.ChildRounding = 4.0F;
    style.PopupRounding = 4.0F;
    style.FrameRounding = 3.0F;
    style.GrabRounding = 3.0F;
    style.TabRounding = 3.0F;
    style.ScrollbarRounding = 6.0F;
    style.ScrollbarSize = 11.0F;
    style.GrabMinSize = 8.0F;
    style.WindowPadding = {10.0F, 9.0F};
    style.FramePadding = {7.0F, 4.0F};
    style.ItemSpacing = {7.0F, 5.0F};
    style.ItemInnerSpacing = {6.0F, 4.0F};
    style.IndentSpacing = 14.0F;
    style.CellPadding = {5.0F, 3.0F};
    style.WindowBorderSize = 1.0F;
    style.PopupBorderSize = 1.0F;
    style.FrameBorderSize = 0.0F;
    style.WindowTitleAlign = {0.0F, 0.5F};
    setColors(style.Colors);
    style.ScaleAllSizes(scale);
}

}  // namespace lutka::editor
