#include "editor/ui/editor_ui.hpp"

#include <imgui.h>

#include "editor/ui/panels.hpp"
#include "editor/ui/role_drag.hpp"

namespace lutka::editor {

void EditorUi::build(Editor& editor, const FrameHistory& history) {
    const PanelContext context{editor, state, history, host_.fonts(), host_.scale()};
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
