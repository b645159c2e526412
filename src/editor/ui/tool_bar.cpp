/// The column of tools at the view's left edge, and the box that selects.

#include <imgui.h>

#include "editor/ui/panels.hpp"
#include "editor/ui/style.hpp"
#include "editor/ui/widgets.hpp"

namespace lutka::editor {
namespace {

// Whether it was pressed; the chosen one stands out.
bool toolButton(const PanelContext& context, const char* name, bool chosen, const char* what) {
    // Under the mouse too: else a tool would seem to be let go of by the click that chose it.
    if (chosen) {
        ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_Header));
        ImGui::PushStyleColor(ImGuiCol_ButtonHovered, ImGui::GetStyleColorVec4(ImGuiCol_Header));
    }
    const bool pressed = ImGui::Button(name, {context.px(58), 0});
    if (chosen) ImGui::PopStyleColor(2);
    tooltip(what);
    return pressed;
}

}  // namespace

void drawTools(const PanelContext& context) {
    Editor& editor = context.editor;
    Workspace& workspace = editor.workspace();
    const auto [left, right] = viewSpan(context);
    context.state.toolsRight = 0.0F;
    if (right - left < context.px(240)) return;  // a tiny window is for looking; keys choose the tool there
    // Beside the transport where there is room, else below it.
    const bool beside = right - left > context.px(490);
    const float top = beside ? ImGui::GetFrameHeight() + context.px(8) : context.state.transportBottom + context.px(6);
    ImGui::SetNextWindowPos({left + context.px(8), top});
    ImGui::SetNextWindowBgAlpha(0.88F);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(context.px(5), context.px(5)));
    ImGui::Begin("##tools", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_AlwaysAutoResize |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus |
                     ImGuiWindowFlags_NoFocusOnAppearing);
    constexpr const char* what[] = {"A drag pulls bodies; objects have arrows. T: the next tool",
                                    "Arrows move an object, or a body's shape in its joint. G: grab at once",
                                    "Rings turn an object, or a body's shape in its joint. R: turn at once",
                                    "Arms resize an object, or a body's shape. S: at once",
                                    "A click hits the body that it points at; the wheel sets the impulse"};
    for (int index = 0; index < kToolCount; ++index) {
        const auto tool = static_cast<Tool>(index);
        if (toolButton(context, toolName(tool), workspace.tool == tool, what[index])) {
            workspace.tool = tool;
            workspace.hotGizmo.reset();
        }
    }
    ImGui::Separator();
    if (toolButton(context, workspace.localAxes ? "Own###axes" : "World###axes", workspace.localAxes,
                   "Shift+T: the tool's axes are the world's or the selection's own")) {
        editor.perform(Action::toggleLocalAxes);
    }
    if (toolButton(context, "L = R", editor.document().symmetric(),
                   "Shift+M: changes of a body go to the other side as well")) {
        editor.perform(Action::toggleSymmetric);
    }
    if (toolButton(context, "Clips", editor.view.clips, "F4: the file's clips with a timeline"))
        editor.perform(Action::toggleClips);
    if (!beside) context.state.toolsRight = ImGui::GetWindowPos().x + ImGui::GetWindowSize().x;
    ImGui::End();
    ImGui::PopStyleVar();
}

void drawSelectionBox(const PanelContext& context) {
    const auto& box = context.editor.workspace().box;
    if (!box) return;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    ImVec4 inside = accentColor();
    inside.w = 0.12F;
    list.AddRectFilled({box->low.x, box->low.y}, {box->high.x, box->high.y}, ImGui::GetColorU32(inside));
    list.AddRect({box->low.x, box->low.y}, {box->high.x, box->high.y}, ImGui::GetColorU32(accentColor()));
}

}  // namespace lutka::editor
