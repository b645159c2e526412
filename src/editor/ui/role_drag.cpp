#include "editor/ui/role_drag.hpp"

#include <imgui.h>

namespace lutka::editor {
namespace {

constexpr const char* kRolePayload = "role";

std::optional<animation::Role> roleIn(const ImGuiPayload* payload) {
    if (payload == nullptr || !payload->IsDataType(kRolePayload)) return std::nullopt;
    return animation::roleAt(*static_cast<const int*>(payload->Data));
}

}  // namespace

void dragRole(animation::Role role) {
    if (!ImGui::BeginDragDropSource(ImGuiDragDropFlags_SourceAllowNullID)) return;
    const int index = animation::indexOf(role);
    ImGui::SetDragDropPayload(kRolePayload, &index, sizeof index);
    ImGui::TextUnformatted(std::string(animation::roleName(role)).c_str());
    ImGui::EndDragDropSource();
}

std::optional<animation::Role> droppedRole() {
    if (!ImGui::BeginDragDropTarget()) return std::nullopt;
    const auto role = roleIn(ImGui::AcceptDragDropPayload(kRolePayload));
    ImGui::EndDragDropTarget();
    return role;
}

void dragRoleOverView(const PanelContext& context) {
    Editor& editor = context.editor;
    const auto role = roleIn(ImGui::GetDragDropPayload());
    if (!role) {
        context.state.draggingOverView = false;
        return;
    }
    const bool overView =
        !ImGui::IsWindowHovered(ImGuiHoveredFlags_AnyWindow | ImGuiHoveredFlags_AllowWhenBlockedByActiveItem);
    if (overView && !context.state.draggingOverView) editor.beginPickJoint(*role);
    if (!overView && context.state.draggingOverView) editor.endPickJoint(false);
    if (overView && ImGui::IsMouseReleased(ImGuiMouseButton_Left)) editor.endPickJoint(true);
    context.state.draggingOverView = overView;
}

}  // namespace lutka::editor
