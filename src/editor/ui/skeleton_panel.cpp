/// The left panel's tabs: the joint tree, the mapping of roles, the scene's objects.

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cctype>

#include "editor/ui/panels.hpp"
#include "editor/ui/style.hpp"
#include "editor/ui/widgets.hpp"

namespace lutka::editor {
namespace {

using animation::Role;

// ASCII letters without their case; others as they are.
bool containsText(std::string_view text, std::string_view part) {
    const auto lower = [](char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); };
    return std::search(text.begin(), text.end(), part.begin(), part.end(),
                       [&](char a, char b) { return lower(a) == lower(b); }) != text.end();
}

std::optional<Role> roleOfJoint(const animation::HumanoidMap& map, int joint) {
    for (int role = 0; role < animation::kRoleCount; ++role) {
        if (map.roles[role] && map.roles[role]->joint == joint) return animation::roleAt(role);
    }
    return std::nullopt;
}

int bodyOfJoint(const physics::Rig& rig, int joint) {
    const auto found = std::find(rig.jointOfBody.begin(), rig.jointOfBody.end(), joint);
    return found == rig.jointOfBody.end() ? -1 : static_cast<int>(found - rig.jointOfBody.begin());
}

void assignMenu(const PanelContext& context, int joint) {
    const animation::HumanoidMap& map = context.editor.document().state().map;
    ImGui::TextColored(mutedColor(), "This joint is the figure's …");
    std::optional<Role> chosen;
    for (int i = 0; i < animation::kRoleCount; ++i) {
        const Role role = animation::roleAt(i);
        const bool mine = map.jointOf(role) == joint;
        if (ImGui::MenuItem(std::string(animation::roleName(role)).c_str(), nullptr, mine) && !mine) chosen = role;
    }
    if (chosen) context.editor.edit([&](EditorDocument& document) { return document.assignRole(*chosen, joint); });
}

// What all rows of the tree share.
struct Tree {
    std::vector<std::vector<int>> children;
    std::vector<bool> leads;  // to a joint with a role, or has one itself: shown unfolded
};

Tree makeTree(const EditorDocument& document) {
    const animation::Skeleton& skeleton = document.character().skeleton;
    Tree tree{animation::childrenOf(skeleton), std::vector<bool>(skeleton.parents.size())};
    for (const auto& binding : document.state().map.roles) {
        for (int joint = binding ? binding->joint : animation::kNoJoint; joint >= 0; joint = skeleton.parents[joint])
            tree.leads[joint] = true;
    }
    return tree;
}

void roleTag(Role role, const std::string& joint) {
    const std::string name(animation::roleName(role));
    ImGui::SameLine();
    // A joint that is called like its role needs no second word.
    ImGui::TextColored(accentColor(), "%s", name == joint ? "●" : name.c_str());
    tooltip("The joint's role: " + name);
}

void drawJoint(const PanelContext& context, const Tree& tree, int joint) {
    Editor& editor = context.editor;
    const animation::Skeleton& skeleton = editor.document().character().skeleton;
    const auto active = editor.workspace().selection.active();
    const physics::Rig& rig = editor.document().asset().rig;
    const int body = bodyOfJoint(rig, joint);
    const auto role = roleOfJoint(editor.document().state().map, joint);
    const bool filtering = !context.state.jointFilter.empty();
    const bool selected = active && active->kind == Item::Kind::body && body >= 0 && active->index == body;

    ImGuiTreeNodeFlags flags =
        ImGuiTreeNodeFlags_OpenOnArrow | ImGuiTreeNodeFlags_SpanAvailWidth | ImGuiTreeNodeFlags_DefaultOpen;
    if (tree.children[joint].empty() || filtering) flags |= ImGuiTreeNodeFlags_Leaf;
    if (selected) flags |= ImGuiTreeNodeFlags_Selected;
    // Twigs of hair and fingers stay folded in the beginning.
    if (!tree.leads[joint]) flags &= ~ImGuiTreeNodeFlags_DefaultOpen;
    const int wanted = context.state.scrollToJoint;
    if (wanted >= 0 && wanted != joint && animation::isAncestorOrSelf(skeleton, joint, wanted)) {
        ImGui::SetNextItemOpen(true);
    }
    ImGui::PushID(joint);
    if (!role) ImGui::PushStyleColor(ImGuiCol_Text, mutedColor());
    const bool open = ImGui::TreeNodeEx("##joint", flags, "%s", skeleton.names[joint].c_str());
    if (!role) ImGui::PopStyleColor();
    if (context.state.scrollToJoint == joint) {
        ImGui::SetScrollHereY();
        context.state.scrollToJoint = -1;
    }
    if (ImGui::IsItemClicked() && !ImGui::IsItemToggledOpen() && body >= 0) {
        editor.select(Item{Item::Kind::body, active ? active->doll : 0, body}, ImGui::GetIO().KeyShift);
    }
    if (ImGui::BeginPopupContextItem("##assign")) {
        assignMenu(context, joint);
        ImGui::EndPopup();
    }
    if (role) roleTag(*role, skeleton.names[joint]);
    if (open) {
        if (!filtering) {
            for (const int child : tree.children[joint])
                drawJoint(context, tree, child);
        }
        ImGui::TreePop();
    }
    ImGui::PopID();
}

void followSelection(const PanelContext& context) {
    const auto active = context.editor.workspace().selection.active();
    if (active == context.state.shownItem) return;
    context.state.shownItem = active;
    if (active && active->kind == Item::Kind::body) {
        context.state.scrollToJoint = context.editor.document().asset().rig.jointOfBody[active->index];
    }
}

// A joint's name in a combo of hundreds: filtered by typing.
void jointCombo(const PanelContext& context, Role role, int joint, bool fixed) {
    Editor& editor = context.editor;
    const animation::Skeleton& skeleton = editor.document().character().skeleton;
    const std::string shown = joint >= 0 ? skeleton.names[joint] : "(none)";
    ImGui::SetNextItemWidth(-1.0F);
    if (fixed) ImGui::PushStyleColor(ImGuiCol_Text, accentColor());
    const bool open =
        ImGui::BeginCombo("##combo", shown.c_str(), ImGuiComboFlags_HeightLarge | ImGuiComboFlags_NoArrowButton);
    if (fixed) ImGui::PopStyleColor();
    if (!open) return;
    static std::string filter;  // only one combo is open at a time
    if (ImGui::IsWindowAppearing()) {
        filter.clear();
        ImGui::SetKeyboardFocusHere();
    }
    ImGui::SetNextItemWidth(-1.0F);
    ImGui::InputTextWithHint("##filter", "type to search", &filter);
    if (ImGui::Selectable("(none)", joint < 0)) {
        editor.edit([&](EditorDocument& document) { return document.unmapRole(role); });
    }
    for (int i = 0; i < skeleton.jointCount(); ++i) {
        if (!containsText(skeleton.names[i], filter)) continue;
        ImGui::PushID(i);
        if (ImGui::Selectable(skeleton.names[i].c_str(), i == joint)) {
            editor.edit([&](EditorDocument& document) { return document.assignRole(role, i); });
        }
        ImGui::PopID();
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
    ImGui::TableNextColumn();
    jointCombo(context, role, binding ? binding->joint : animation::kNoJoint, fixed.has_value());
    if (binding) {
        tooltip(fmt::format("{}{}", binding->reason, fixed ? "\nFixed by you." : ""));
    }
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

void drawSkeletonTab(const PanelContext& context) {
    followSelection(context);
    ImGui::SetNextItemWidth(-1.0F);
    ImGui::InputTextWithHint("##search", "search joints", &context.state.jointFilter);
    const animation::Skeleton& skeleton = context.editor.document().character().skeleton;
    ImGui::BeginChild("##tree", {0, 0}, true, ImGuiWindowFlags_HorizontalScrollbar);
    ImGui::PushStyleVar(ImGuiStyleVar_IndentSpacing, context.px(11));
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(context.px(6), context.px(3)));
    const Tree tree = makeTree(context.editor.document());
    for (int joint = 0; joint < skeleton.jointCount(); ++joint) {
        if (!context.state.jointFilter.empty()) {
            if (containsText(skeleton.names[joint], context.state.jointFilter)) drawJoint(context, tree, joint);
        } else if (skeleton.parents[joint] == animation::kNoJoint) {
            drawJoint(context, tree, joint);
        }
    }
    ImGui::PopStyleVar(2);
    ImGui::EndChild();
}

void drawMappingTab(const PanelContext& context) {
    Editor& editor = context.editor;
    const animation::HumanoidMap& map = editor.document().state().map;
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
    ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, ImVec2(context.px(3), context.px(1)));
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(context.px(6), context.px(2.5F)));
    if (ImGui::BeginTable("##roleTable", 3, ImGuiTableFlags_SizingFixedFit)) {
        ImGui::TableSetupColumn("role", ImGuiTableColumnFlags_WidthFixed, context.px(104));
        ImGui::TableSetupColumn("joint", ImGuiTableColumnFlags_WidthStretch);
        ImGui::TableSetupColumn("sure", ImGuiTableColumnFlags_WidthFixed, context.px(26));
        for (int role = 0; role < animation::kRoleCount; ++role)
            roleRow(context, animation::roleAt(role));
        ImGui::EndTable();
    }
    ImGui::PopStyleVar(2);
    for (const std::string& warning : map.warnings)
        mutedText(warning);
    ImGui::EndChild();
}

void drawObjectsTab(const PanelContext& context) {
    Editor& editor = context.editor;
    const std::vector<SceneObject>& objects = editor.document().state().scene.objects;
    for (const auto kind : {SceneObject::Kind::box, SceneObject::Kind::ball, SceneObject::Kind::light}) {
        if (kind != SceneObject::Kind::box) ImGui::SameLine();
        if (ImGui::Button(fmt::format("+ {}", objectKindName(kind)).c_str())) editor.beginAdd(kind);
    }
    if (objects.empty()) {
        mutedText(
            "Nothing but the dolls and the scene. Add a box, a ball or a light, then click where it shall stand.");
    }
    for (int i = 0; i < static_cast<int>(objects.size()); ++i) {
        const Item item{Item::Kind::object, 0, i};
        const std::string name = editor.workspace().nameOf(item);
        if (ImGui::Selectable(name.c_str(), editor.workspace().selection.contains(item))) {
            editor.select(item, ImGui::GetIO().KeyShift);
        }
    }
}

}  // namespace lutka::editor
