#include "editor/ui/editor_ui.hpp"

#include <imgui.h>
#include <imgui_internal.h>

#include "editor/ui/panels.hpp"
#include "editor/ui/role_drag.hpp"

namespace lutka::editor {

namespace {

// Dear ImGui closes menus and lists by a click beside them alone, unless it has the keyboard for navigation.
void closePopupByEscape() {
    const ImGuiContext& imgui = *ImGui::GetCurrentContext();
    const int open = imgui.OpenPopupStack.Size;
    if (open == 0 || !ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false)) return;
    const ImGuiWindow* window = imgui.OpenPopupStack[open - 1].Window;
    if (window == nullptr || (window->Flags & ImGuiWindowFlags_Modal) != 0) return;  // dialogs have an answer for it
    ImGui::ClosePopupToLevel(open - 1, true);
}

}  // namespace

void EditorUi::build(Editor& editor, const FrameHistory& history) {
    const PanelContext context{editor, state, history, host_.fonts(), host_.scale()};
    closePopupByEscape();
    drawMenuBar(context);
    drawStatusBar(context);
    if (editor.view.panels) {
        drawSidePanels(context);
    }
    drawTransport(context);
    drawTools(context);
    drawSelectionBox(context);
    editor.workspace().covered = coveredBy(context);
    dragRoleOverView(context);
    if (state.showCollisions) drawCollisions(context);
    drawOffer(context);
    drawAnyRigOffer(context);
    drawToasts(context);
    drawDialogs(context);
    if (editor.view.help) drawHelp(context);
    if (editor.view.gallery) drawGallery(context);
    if (ImGui::IsMouseReleased(ImGuiMouseButton_Left) && editor.state() != State::grab &&
        editor.state() != State::rotate && editor.state() != State::scale && editor.state() != State::handle) {
        editor.document().endGroup();
    }
}

}  // namespace lutka::editor
