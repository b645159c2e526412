#include "editor/ui/style.hpp"

#include <imgui.h>

#include <utility>

namespace lutka::editor {
namespace {

// sRGB bytes, as in a picture.
ImVec4 rgb(int r, int g, int b, float alpha = 1.0F) {
    return {static_cast<float>(r) / 255.0F, static_cast<float>(g) / 255.0F, static_cast<float>(b) / 255.0F, alpha};
}

// What a theme sets; everything else follows.
struct Palette {
    ImVec4 panel, inset, bar, popup, border, text, muted;
    ImVec4 field, button, hovered, active;
    ImVec4 plot, accentSoft, accent;
};

Palette darkPalette() {
    return {rgb(34, 36, 41),    rgb(28, 30, 34),    rgb(28, 30, 34),          rgb(40, 43, 49, 0.98F), rgb(58, 62, 70),
            rgb(224, 226, 230), rgb(150, 154, 163), rgb(48, 51, 58),          rgb(56, 60, 68),        rgb(68, 73, 83),
            rgb(82, 88, 100),   rgb(140, 196, 240), rgb(255, 150, 46, 0.28F), rgb(255, 150, 46)};
}

Palette lightPalette() {
    return {rgb(240, 241, 243),       rgb(250, 250, 251), rgb(228, 230, 233), rgb(252, 252, 253, 0.98F),
            rgb(196, 200, 206),       rgb(32, 34, 38),    rgb(100, 105, 114), rgb(222, 225, 229),
            rgb(212, 216, 221),       rgb(200, 205, 212), rgb(186, 192, 201), rgb(38, 110, 180),
            rgb(255, 150, 46, 0.28F), rgb(158, 70, 0)};
}

// Which palette the present style has.
bool isLight() {
    return ImGui::GetStyle().Colors[ImGuiCol_Text].x < 0.5F;
}

void setColors(ImVec4* colors, const Palette& p) {
    const ImVec4& accent = p.accent;
    const ImVec4 none = rgb(0, 0, 0, 0.0F);
    const std::pair<ImGuiCol_, ImVec4> all[] = {
        {ImGuiCol_Text, p.text},
        {ImGuiCol_TextDisabled, p.muted},
        {ImGuiCol_WindowBg, p.panel},
        {ImGuiCol_ChildBg, p.inset},
        {ImGuiCol_PopupBg, p.popup},
        {ImGuiCol_Border, p.border},
        {ImGuiCol_FrameBg, p.field},
        {ImGuiCol_FrameBgHovered, p.hovered},
        {ImGuiCol_FrameBgActive, p.active},
        {ImGuiCol_TitleBg, p.bar},
        {ImGuiCol_TitleBgActive, p.bar},
        {ImGuiCol_MenuBarBg, p.bar},
        {ImGuiCol_ScrollbarBg, none},
        {ImGuiCol_ScrollbarGrab, p.hovered},
        {ImGuiCol_ScrollbarGrabHovered, p.active},
        {ImGuiCol_ScrollbarGrabActive, p.muted},
        {ImGuiCol_CheckMark, accent},
        // Digits are read through it.
        {ImGuiCol_SliderGrab, rgb(214, 132, 50, 0.55F)},
        {ImGuiCol_SliderGrabActive, rgb(255, 150, 46, 0.7F)},
        {ImGuiCol_Button, p.button},
        {ImGuiCol_ButtonHovered, p.hovered},
        {ImGuiCol_ButtonActive, p.active},
        {ImGuiCol_Header, p.accentSoft},
        {ImGuiCol_HeaderHovered, p.hovered},
        {ImGuiCol_HeaderActive, p.active},
        {ImGuiCol_Separator, p.border},
        {ImGuiCol_Tab, p.panel},
        {ImGuiCol_TabHovered, p.hovered},
        {ImGuiCol_TabActive, p.button},
        {ImGuiCol_TabUnfocused, p.panel},
        {ImGuiCol_TabUnfocusedActive, p.button},
        {ImGuiCol_PlotLines, p.plot},
        {ImGuiCol_PlotHistogram, accent},
        {ImGuiCol_TableHeaderBg, p.bar},
        {ImGuiCol_TableBorderLight, p.border},
        {ImGuiCol_TableRowBgAlt, rgb(128, 128, 128, 0.06F)},
        {ImGuiCol_TextSelectedBg, p.accentSoft},
        {ImGuiCol_DragDropTarget, accent},
        {ImGuiCol_NavHighlight, accent},
        {ImGuiCol_ModalWindowDimBg, rgb(12, 13, 15, 0.5F)},
    };
    for (const auto& [index, color] : all)
        colors[index] = color;
}

}  // namespace

// On light panels the signal colours are darker, to stay readable.
ImVec4 accentColor() {
    return ImGui::GetStyle().Colors[ImGuiCol_CheckMark];
}
ImVec4 mutedColor() {
    return ImGui::GetStyle().Colors[ImGuiCol_TextDisabled];
}
ImVec4 goodColor() {
    return isLight() ? rgb(40, 124, 40) : rgb(126, 200, 120);
}
ImVec4 warningColor() {
    return isLight() ? rgb(150, 104, 0) : rgb(240, 196, 84);
}
ImVec4 errorColor() {
    return isLight() ? rgb(190, 40, 30) : rgb(240, 110, 98);
}

void applyStyle(float scale, bool light) {
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
    style.GrabMinSize = 6.0F;
    style.WindowPadding = {10.0F, 9.0F};
    style.FramePadding = {7.0F, 4.0F};
    style.ItemSpacing = {7.0F, 5.0F};
    style.ItemInnerSpacing = {6.0F, 4.0F};
    style.IndentSpacing = 14.0F;
    style.CellPadding = {5.0F, 3.0F};
    style.WindowBorderSize = 1.0F;
    style.PopupBorderSize = 1.0F;
    style.FrameBorderSize = light ? 1.0F : 0.0F;  // an empty box is nearly as light as the panel
    style.WindowTitleAlign = {0.0F, 0.5F};
    setColors(style.Colors, light ? lightPalette() : darkPalette());
    style.ScaleAllSizes(scale);
}

}  // namespace lutka::editor
