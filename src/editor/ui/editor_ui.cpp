#include "editor/ui/editor_ui.hpp"

#include <imgui.h>
#include <imgui_internal.h>

#include "editor/ui/panels.hpp"
#include "editor/ui/role_drag.hpp"

namespace lutka::editor {

namespace {

// Dear ImGui closes menus and lists by a click beside them alone, unless it has the keyboard for navigation. Whether
// one was closed.
bool closePopupByEscape() {
    const ImGuiContext& imgui = *ImGui::GetCurrentContext();
    const int open = imgui.OpenPopupStack.Size;
    if (open == 0 || !ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false)) return false;
    const ImGuiWindow* window = imgui.OpenPopupStack[open - 1].Window;
    if (window == nullptr || (window->Flags & ImGuiWindowFlags_Modal) != 0)
        return false;  // dialogs have an answer for it
    ImGui::ClosePopupToLevel(open - 1, true);
    return true;
}

// What a drag changes is one entry of undo. A click may be the first of two, after which a value is typed: all of that
// is one entry as well.
void endGroups(Editor& editor, UiState& state) {
    const ImGuiIO& io = ImGui::GetIO();
    const bool transforms = editor.state() == State::grab || editor.state() == State::rotate ||
                            editor.state() == State::scale || editor.state() == State::handle;
    if (ImGui::IsMouseReleased(ImGuiMouseButton_Left) && !transforms)
        state.groupEnds = ImGui::GetTime() + static_cast<double>(io.MouseDoubleClickTime);
    const bool another =
        ImGui::IsMouseClicked(ImGuiMouseButton_Left) && !ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
    const bool over = another || ImGui::GetTime() >= state.groupEnds;
    if (state.groupEnds <= 0.0 || ImGui::IsAnyItemActive() || !over)
        return;  // a field is active while it is written in
    editor.document().endGroup();
    state.groupEnds = 0.0;
}

}  // namespace

void EditorUi::build(Editor& editor, const FrameHistory& history) {
    const PanelContext context{editor, state, history, host_.fonts(), host_.scale()};
    state.escapeTaken = closePopupByEscape();
    drawMenuBar(context);
    drawStatusBar(context);
    if (editor.view.panels) {
        drawSidePanels(context);
    }
    drawTransport(context);
    drawTools(context);
    drawSelectionBox(context);
    state.timelineTop = 0.0F;
    if (editor.view.clips) drawTimeline(context);
    editor.workspace().covered = coveredBy(context);
    dragRoleOverView(context);
    if (state.showCollisions) drawCollisions(context);
    drawOffer(context);
    drawAnyRigOffer(context);
    drawToasts(context);
    drawDialogs(context);
    if (editor.view.help) drawHelp(context);
    if (editor.view.gallery) drawGallery(context);
    endGroups(editor, state);
}

}  // namespace lutka::editor
