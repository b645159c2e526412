#include "editor/ui/style.hpp"

#include <imgui.h>

#include <cmath>

#include "support/catch.hpp"

using namespace lutka::editor;

namespace {

float linear(float channel) {
    return channel <= 0.04045F ? channel / 12.92F : std::pow((channel + 0.055F) / 1.055F, 2.4F);
}

float luminance(const ImVec4& color) {
    return 0.2126F * linear(color.x) + 0.7152F * linear(color.y) + 0.0722F * linear(color.z);
}

ImVec4 over(const ImVec4& below, const ImVec4& above) {
    const auto mix = [&](float a, float b) { return a + (b - a) * above.w; };
    return {mix(below.x, above.x), mix(below.y, above.y), mix(below.z, above.z), 1.0F};
}

// The contrast ratio of WCAG 2.1, from 1 to 21.
float contrast(const ImVec4& a, const ImVec4& b) {
    const float high = std::max(luminance(a), luminance(b)) + 0.05F;
    const float low = std::min(luminance(a), luminance(b)) + 0.05F;
    return high / low;
}

}  // namespace

TEST_CASE("text and signal colours are readable on what they stand on, in the dark theme and in the light one") {
    ImGuiContext* context = ImGui::CreateContext();
    for (const bool light : {false, true}) {
        INFO((light ? "light" : "dark"));
        applyStyle(1.0F, light);
        const ImVec4* colors = ImGui::GetStyle().Colors;
        for (const int place : {ImGuiCol_WindowBg, ImGuiCol_ChildBg, ImGuiCol_PopupBg, ImGuiCol_MenuBarBg}) {
            const ImVec4 panel = over(colors[ImGuiCol_WindowBg], colors[place]);
            INFO(ImGui::GetStyleColorName(place));
            CHECK(contrast(colors[ImGuiCol_Text], panel) > 7.0F);
            CHECK(contrast(mutedColor(), panel) > 4.0F);
            CHECK(contrast(accentColor(), panel) > 4.5F);
            CHECK(contrast(goodColor(), panel) > 4.0F);
            CHECK(contrast(warningColor(), panel) > 3.8F);
            CHECK(contrast(errorColor(), panel) > 4.0F);
            // The state in the status bar, and a selected line.
            const ImVec4 soft = over(panel, colors[ImGuiCol_Header]);
            CHECK(contrast(accentColor(), soft) > 3.8F);
            CHECK(contrast(colors[ImGuiCol_Text], soft) > 5.0F);
        }
        for (const int field : {ImGuiCol_FrameBg, ImGuiCol_Button, ImGuiCol_ButtonHovered})
            CHECK(contrast(colors[ImGuiCol_Text], colors[field]) > 6.5F);
    }
    ImGui::DestroyContext(context);
}
