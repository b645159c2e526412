/// The tab Mapping: the joint of each role, how sure the mapper is and why.

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "editor/ui/panels.hpp"
#include "editor/ui/role_drag.hpp"
#include "editor/ui/style.hpp"
#include "editor/ui/widgets.hpp"

namespace lutka::editor {
namespace {

using animation::Role;

constexpr float kRoleWidth = 104.0F;
constexpr float kSureWidth = 26.0F;
constexpr float kPickWidth = 28.0F;  // of the ring behind the joint
constexpr float kCellPadding = 3.0F;
constexpr float kFramePadding = 6.0F;

// A joint's name in a combo of hundreds: filtered by typing.
void jointCombo(const PanelContext& context, Role role, int joint, bool fixed) {
    Editor& editor = context.editor;
    const animation::Skeleton& skeleton = editor.document().character().skeleton;
    const std::string shown = joint >= 0 ? skeleton.names[joint] : "(none)";
    const float width = ImGui::GetContentRegionAvail().x - context.px(kPickWidth);
    ImGui::SetNextItemWidth(width);
    const std::string inside = nameWithin(shown, width - 2.0F * ImGui::GetStyle().FramePadding.x);
    if (fixed) ImGui::PushStyleColor(ImGuiCol_Text, accentColor());
    const bool open =
        ImGui::BeginCombo("##combo", inside.c_str(), ImGuiComboFlags_HeightLargest | ImGuiComboFlags_NoArrowButton);
    if (fixed) ImGui::PopStyleColor();
    if (!open) return;
    static std::string filter;  // only one combo is open at a time
    if (ImGui::IsWindowAppearing()) {
        filter.clear();
        ImGui::SetKeyboardFocusHere();
    }
    ImGui::SetNextItemWidth(-1.0F);
    // Enter takes the first one found, where something was searched for.
    const bool entered =
        ImGui::InputTextWithHint("##filter", "type to search", &filter, ImGuiInputTextFlags_EnterReturnsTrue);
    bool takesFirst = entered && !filter.empty();
    // The list scrolls below the search, and begins where the joint is now.
    const float line = ImGui::GetTextLineHeightWithSpacing();
    constexpr float lines = 20.0F;
    const float below = ImGui::GetIO().DisplaySize.y - ImGui::GetCursorScreenPos().y - context.px(16);
    const float height = std::min(lines, static_cast<float>(skeleton.jointCount() + 1)) * line;
    ImGui::PushStyleColor(ImGuiCol_ChildBg, 0U);
    ImGui::BeginChild("##joints", {context.px(280), std::max(std::min(height, below), 4.0F * line)});
    ImGui::PopStyleColor();
    std::optional<int> chosen;
    // Without a joint for such a role there is no ragdoll.
    if (!animation::isRequired(role) && ImGui::Selectable("(none)", joint < 0)) chosen = animation::kNoJoint;
    for (int i = 0; i < skeleton.jointCount(); ++i) {
        if (!containsText(skeleton.names[i], filter)) continue;
        ImGui::PushID(i);
        if (ImGui::Selectable(skeleton.names[i].c_str(), i == joint) || takesFirst) chosen = i;
        takesFirst = false;
        if (i == joint && ImGui::IsWindowAppearing()) ImGui::SetScrollHereY();
        ImGui::PopID();
    }
    ImGui::EndChild();
    if (chosen) {
        ImGui::CloseCurrentPopup();
        editor.edit([&](EditorDocument& document) {
            return *chosen == animation::kNoJoint ? document.unmapRole(role) : document.assignRole(role, *chosen);
        });
    }
    ImGui::EndCombo();
}

void roleRow(const PanelContext& context, Role role) {
    const DocumentState& state = context.editor.document().state();
    const auto& binding = state.map[role];
    const auto& fixed = state.fixed[animation::indexOf(role)];
    ImGui::PushID(animation::indexOf(role));
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    const bool lacking = !binding && animation::isRequired(role);
    ImGui::TextColored(
        lacking ? errorColor() : ImGui::GetStyleColorVec4(binding ? ImGuiCol_Text : ImGuiCol_TextDisabled), "%s",
        std::string(animation::roleName(role)).c_str());
    tooltip("Drag it onto a joint, in the tree or in the view");
    dragRole(role);
    ImGui::TableNextColumn();
    jointCombo(context, role, binding ? binding->joint : animation::kNoJoint, fixed.has_value());
    if (binding) {
        const std::string& name = context.editor.document().character().skeleton.names[binding->joint];
        tooltip(fmt::format("{}: {}{}", name, binding->reason, fixed ? "\nFixed by you." : ""));
    }
    ImGui::SameLine(0.0F, context.px(3));
    const bool asking = context.editor.workspace().pickRole == role;
    if (asking) ImGui::PushStyleColor(ImGuiCol_Text, accentColor());
    if (ImGui::SmallButton("◎")) context.editor.beginPickJoint(role);
    if (asking) ImGui::PopStyleColor();
    tooltip("Pick its joint in the view");
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    if (binding) {
        const ImVec4 color = binding->confidence > 0.8F   ? goodColor()
                             : binding->confidence > 0.5F ? warningColor()
                                                          : errorColor();
        ImGui::TextColored(color, "%.0f", static_cast<double>(binding->confidence * 100.0F));
        tooltip("How sure the mapper is, of 100: " + binding->reason);
    }
    ImGui::PopID();
}

}  // namespace

float mappingTabWidth(const PanelContext& context) {
    const EditorDocument& document = context.editor.document();
    float widest = 0.0F;
    for (const auto& binding : document.state().map.roles) {
        if (!binding) continue;
        const std::string& name = document.character().skeleton.names[binding->joint];
        widest = std::max(widest, ImGui::CalcTextSize(name.c_str()).x);
    }
    constexpr float cells = kRoleWidth + kSureWidth + kPickWidth + 6.0F * kCellPadding + 2.0F * kFramePadding;
    return std::ceil(widest + context.px(cells + 4.0F) + 2.0F * ImGui::GetStyle().WindowPadding.x);
}

void drawMappingTab(const PanelContext& context) {
    Editor& editor = context.editor;
    const animation::HumanoidMap& map = editor.document().state().map;
    if (editor.document().state().fit.rig == physics::RigKind::any) {
        mutedText("A ragdoll of any skeleton has no roles: its bodies go by the joints and the skin.");
        return;
    }
    if (ImGui::Button("Map again")) editor.edit([](EditorDocument& document) { return document.mapAgain(false); });
    tooltip("Assigns all roles anew around those that you fixed");
    ImGui::SameLine();
    if (ImGui::Button("L → R")) {
        editor.edit([](EditorDocument& document) { return document.mirrorRoles(animation::Side::left); });
    }
    tooltip("Mirrors the left side's joints to the right");
    ImGui::SameLine();
    if (ImGui::Button("R → L")) {
        editor.edit([](EditorDocument& document) { return document.mirrorRoles(animation::Side::right); });
    }
    tooltip("Mirrors the right side's joints to the left");
    ImGui::SameLine();
    if (ImGui::Button("Forget")) editor.edit([](EditorDocument& document) { return document.mapAgain(true); });
    tooltip("Forgets what you fixed and maps from scratch");
    mutedText(fmt::format("Confidence {:.0f} of 100. Choose a joint to fix a role (shown in orange).",
                          map.confidence * 100.0F));
    ImGui::PushStyleColor(ImGuiCol_ChildBg, 0U);
    ImGui::BeginChild("##roles");
    ImGui::PopStyleColor();
    ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, ImVec2(context.px(kCellPadding), context.px(1)));
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(context.px(kFramePadding), context.px(2.5F)));
    if (ImGui::BeginTable("##roleTable", 3, ImGuiTableFlags_SizingFixedFit)) {
        ImGui::TableSetupColumn("role", ImGuiTableColumnFlags_WidthFixed, context.px(kRoleWidth));
        ImGui::TableSetupColumn("joint", ImGuiTableColumnFlags_WidthStretch);
        ImGui::TableSetupColumn("sure", ImGuiTableColumnFlags_WidthFixed, context.px(kSureWidth));
        for (int role = 0; role < animation::kRoleCount; ++role)
            roleRow(context, animation::roleAt(role));
        ImGui::EndTable();
    }
    ImGui::PopStyleVar(2);
    for (const std::string& warning : map.warnings)
        mutedText(warning);
    ImGui::EndChild();
}

}  // namespace lutka::editor
