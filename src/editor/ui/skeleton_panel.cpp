/// The left panel's first tab: the joint tree.

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>

#include "editor/document/body_shape.hpp"
#include "editor/ui/panels.hpp"
#include "editor/ui/role_drag.hpp"
#include "editor/ui/style.hpp"
#include "editor/ui/widgets.hpp"

namespace lutka::editor {
namespace {

using animation::Role;

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

// Another shape for the body, or one less.
void shapeMenu(const PanelContext& context, int body) {
    Editor& editor = context.editor;
    const std::size_t more = editor.document().profile().bodies[body].shape.more.size();
    const auto change = [&](const char* what, const std::function<Result<void>(physics::BodyShape&)>& edit) {
        editor.select(Item{Item::Kind::body, 0, body});
        editor.edit([&](EditorDocument& document) {
            return document.changeParts(std::span(&body, 1), what, "",
                                        [&](EditorDocument::Part& part) { return edit(part.body.shape); });
        });
    };
    if (ImGui::MenuItem("Add a shape to it", nullptr, false, more < physics::BodyShape::kMostAdded))
        change("Add a shape", [](auto& shape) { return addShape(shape, physics::PrimitiveShape::Kind::sphere); });
    if (ImGui::MenuItem("Remove its last shape", nullptr, false, more > 0)) {
        change("Remove a shape", [](auto& shape) -> Result<void> {
            removeShape(shape, shape.more.size() - 1);
            return {};
        });
    }
}

// What bodies the joint has or could have.
void bodyMenu(const PanelContext& context, int joint, int body) {
    Editor& editor = context.editor;
    const auto onBody = [&](const char* name, Action action) {
        if (!ImGui::MenuItem(name, shortcutText(action).c_str(), false, body > 0 || action == Action::splitBodies))
            return;
        editor.select(Item{Item::Kind::body, 0, body});
        editor.perform(action);
    };
    if (body < 0) {
        if (ImGui::MenuItem("Add a body here")) editor.addBody(joint);
    } else {
        onBody("Split its body", Action::splitBodies);
        onBody("Merge its body into the one above", Action::mergeBodies);
        onBody("Remove its body", Action::removeBodies);
        shapeMenu(context, body);
    }
    ImGui::Separator();
}

void assignMenu(const PanelContext& context, int joint) {
    const animation::HumanoidMap& map = context.editor.document().state().map;
    // A menu of its own: beside what is done to bodies a slip of the mouse would map the joint.
    if (!ImGui::BeginMenu("This joint is the figure's …")) return;
    std::optional<Role> chosen;
    for (int i = 0; i < animation::kRoleCount; ++i) {
        const Role role = animation::roleAt(i);
        const bool mine = map.jointOf(role) == joint;
        if (ImGui::MenuItem(std::string(animation::roleName(role)).c_str(), nullptr, mine) && !mine) chosen = role;
    }
    ImGui::EndMenu();
    if (chosen) context.editor.edit([&](EditorDocument& document) { return document.assignRole(*chosen, joint); });
}

// What all rows of the tree share.
struct Tree {
    std::vector<std::vector<int>> children;
    std::vector<bool> leads;  // to a joint with a role or a body, or has one itself: shown unfolded
    int depth = 1;            // of what is shown unfolded
};

Tree makeTree(const EditorDocument& document) {
    const animation::Skeleton& skeleton = document.character().skeleton;
    Tree tree{animation::childrenOf(skeleton), std::vector<bool>(skeleton.parents.size())};
    const auto leadTo = [&](int wanted) {
        for (int joint = wanted; joint >= 0; joint = skeleton.parents[joint])
            tree.leads[joint] = true;
    };
    for (const auto& binding : document.state().map.roles) {
        if (binding) leadTo(binding->joint);
    }
    for (const physics::BodyProfile& body : document.profile().bodies)
        leadTo(animation::findJoint(skeleton, body.jointPath));
    // Who makes a ragdoll of a creature by hand looks for joints.
    if (!physics::hasRoles(document.profile())) tree.leads.assign(tree.leads.size(), true);
    std::vector<int> depths(skeleton.parents.size(), 1);  // parents come first
    for (int joint = 0; joint < skeleton.jointCount(); ++joint) {
        if (skeleton.parents[joint] >= 0) depths[joint] = depths[skeleton.parents[joint]] + 1;
        if (tree.leads[joint]) tree.depth = std::max(tree.depth, depths[joint]);
    }
    return tree;
}

// A joint that is called like its role needs no second word.
std::string roleWord(Role role, const std::string& joint) {
    const std::string name(animation::roleName(role));
    return name == joint ? "●" : name;
}

constexpr const char* kBodyMark = "○";
constexpr float kGap = 6.0F;  // between what stands in a line

// What stands behind a joint's name, window units.
float marksWidth(const PanelContext& context, int joint) {
    const EditorDocument& document = context.editor.document();
    const auto role = roleOfJoint(document.state().map, joint);
    const int body = bodyOfJoint(document.asset().rig, joint);
    const auto wide = [&](const std::string& text) { return context.px(kGap) + ImGui::CalcTextSize(text.c_str()).x; };
    float width = 0.0F;
    if (role) {
        width = wide(roleWord(*role, document.character().skeleton.names[joint]));
    } else if (body >= 0) {
        width = wide(kBodyMark);
    }
    if (body >= 0 && !document.profile().bodies[body].shape.more.empty())
        width += wide(fmt::format("×{}", 1 + document.profile().bodies[body].shape.more.size()));
    return width;
}

// From where a line of the tree begins to its name.
float arrowWidth() {
    return ImGui::GetFontSize() + 2.0F * ImGui::GetStyle().FramePadding.x;
}

void roleTag(Role role, const std::string& joint) {
    const std::string name(animation::roleName(role));
    ImGui::SameLine();
    ImGui::TextColored(accentColor(), "%s", roleWord(role, joint).c_str());
    tooltip("The joint's role: " + name + ". Drag it onto another joint to move it there.");
    dragRole(role);
}

// What stands behind a joint's name: its role, else that it has a body, and how many shapes that has.
void drawMarks(const PanelContext& context, int joint) {
    const EditorDocument& document = context.editor.document();
    const auto role = roleOfJoint(document.state().map, joint);
    const int body = bodyOfJoint(document.asset().rig, joint);
    if (role) {
        roleTag(*role, document.character().skeleton.names[joint]);
    } else if (body >= 0) {
        ImGui::SameLine();
        ImGui::TextColored(accentColor(), "%s", kBodyMark);
        tooltip("It has a body of its own");
    }
    const std::size_t shapes = body < 0 ? 1 : 1 + document.profile().bodies[body].shape.more.size();
    if (shapes > 1) {
        ImGui::SameLine();
        ImGui::TextColored(mutedColor(), "×%d", static_cast<int>(shapes));
        tooltip(fmt::format("Its body has {} shapes", shapes));
    }
}

bool isSelected(const Editor& editor, int body) {
    const std::vector<Item>& items = editor.workspace().selection.items();
    return body >= 0 && std::any_of(items.begin(), items.end(), [&](const Item& item) {
               return item.kind == Item::Kind::body && item.index == body;
           });
}

// The joint's line, with its name as far as there is room. Whether its children are shown.
bool drawLine(const PanelContext& context, const Tree& tree, int joint) {
    const EditorDocument& document = context.editor.document();
    const std::string& name = document.character().skeleton.names[joint];
    const int body = bodyOfJoint(document.asset().rig, joint);
    ImGuiTreeNodeFlags flags =
        ImGuiTreeNodeFlags_OpenOnArrow | ImGuiTreeNodeFlags_SpanAvailWidth | ImGuiTreeNodeFlags_DefaultOpen;
    if (tree.children[joint].empty() || !context.state.jointFilter.empty()) flags |= ImGuiTreeNodeFlags_Leaf;
    if (isSelected(context.editor, body)) flags |= ImGuiTreeNodeFlags_Selected;
    // Twigs of hair and fingers stay folded in the beginning.
    if (!tree.leads[joint]) flags &= ~ImGuiTreeNodeFlags_DefaultOpen;
    const bool plain = body < 0 && !roleOfJoint(document.state().map, joint);
    if (plain) ImGui::PushStyleColor(ImGuiCol_Text, mutedColor());
    // What a deep line has no room for even so is reached by scrolling.
    const float room = ImGui::GetContentRegionAvail().x - arrowWidth() - marksWidth(context, joint);
    constexpr float least = 6.0F;  // letters
    const std::string shown = nameWithin(name, std::max(room, least * ImGui::GetFontSize()));
    const bool open = ImGui::TreeNodeEx("##joint", flags, "%s", shown.c_str());
    if (plain) ImGui::PopStyleColor();
    if (shown != name) tooltip(name);
    return open;
}

// Scrolls to the line that was drawn last. One that is seen stays under the mouse that clicked it.
void scrollToLine() {
    const float top = ImGui::GetWindowPos().y;
    const float bottom = top + ImGui::GetWindowHeight() - ImGui::GetStyle().ScrollbarSize;
    const bool seen = ImGui::GetItemRectMin().y >= top && ImGui::GetItemRectMax().y <= bottom;
    if (!seen) ImGui::SetScrollHereY();
}

// What is done to a joint on the line that was drawn last: selecting, dropping a role, the menu.
void takeInput(const PanelContext& context, int joint) {
    Editor& editor = context.editor;
    const int body = bodyOfJoint(editor.document().asset().rig, joint);
    if (ImGui::IsItemClicked() && !ImGui::IsItemToggledOpen() && body >= 0) {
        const auto active = editor.workspace().selection.active();
        editor.select(Item{Item::Kind::body, active ? active->doll : 0, body}, ImGui::GetIO().KeyShift);
    }
    if (const auto dropped = droppedRole()) {
        editor.edit([&](EditorDocument& document) { return document.assignRole(*dropped, joint); });
    }
    if (ImGui::BeginPopupContextItem("##assign")) {
        bodyMenu(context, joint, body);
        if (physics::hasRoles(editor.document().profile())) assignMenu(context, joint);
        ImGui::EndPopup();
    }
}

void drawJoint(const PanelContext& context, const Tree& tree, int joint) {
    const int wanted = context.state.scrollToJoint;
    const animation::Skeleton& skeleton = context.editor.document().character().skeleton;
    if (wanted >= 0 && wanted != joint && animation::isAncestorOrSelf(skeleton, joint, wanted)) {
        ImGui::SetNextItemOpen(true);
    }
    ImGui::PushID(joint);
    const bool open = drawLine(context, tree, joint);
    if (wanted == joint) {
        scrollToLine();
        context.state.scrollToJoint = -1;
    }
    takeInput(context, joint);
    drawMarks(context, joint);
    if (open) {
        if (context.state.jointFilter.empty()) {
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

// Roles that a ragdoll needs and no joint has, to be dragged to one.
void drawMissingRoles(const PanelContext& context) {
    const animation::HumanoidMap& map = context.editor.document().state().map;
    if (map.missing.empty()) return;
    ImGui::TextColored(warningColor(), "Without a joint (drag to one):");
    bool first = true;
    for (const Role role : map.missing) {
        const std::string name(animation::roleName(role));
        const ImGuiStyle& style = ImGui::GetStyle();
        const float width = ImGui::CalcTextSize(name.c_str()).x + 2.0F * style.FramePadding.x;
        const float end = ImGui::GetItemRectMax().x + style.ItemSpacing.x + width;
        if (!first && end < ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x) ImGui::SameLine();
        first = false;
        ImGui::SmallButton(name.c_str());
        dragRole(role);
    }
}

// What the names of the joints that are shown in the beginning need: less indent in a deep tree and one of long names,
// and a wider panel where that does not help.
UiState::NameRoom measureNames(const PanelContext& context) {
    constexpr float usual = 11.0F;
    constexpr float narrow = 8.0F;
    constexpr float least = 4.0F;
    constexpr float room = 12.0F * usual;
    const animation::Skeleton& skeleton = context.editor.document().character().skeleton;
    const Tree tree = makeTree(context.editor.document());
    const ImGuiStyle& style = ImGui::GetStyle();
    const float around = 4.0F * style.WindowPadding.x + style.ScrollbarSize + 4.0F * style.WindowBorderSize;
    const float most = std::clamp(room / static_cast<float>(tree.depth), least, usual);
    float indent = most;
    float width = mappingTabWidth(context);
    std::vector<float> levels(skeleton.parents.size(), 0.0F);  // parents come first
    std::vector<bool> shown(skeleton.parents.size(), true);
    std::vector<float> words(skeleton.parents.size(), 0.0F);
    for (int joint = 0; joint < skeleton.jointCount(); ++joint) {
        if (const int parent = skeleton.parents[joint]; parent >= 0) {
            levels[joint] = levels[parent] + 1.0F;
            shown[joint] = shown[parent] && tree.leads[parent];
        }
        if (!shown[joint]) continue;
        words[joint] =
            around + arrowWidth() + ImGui::CalcTextSize(skeleton.names[joint].c_str()).x + marksWidth(context, joint);
        const float fits = (context.px(kLeftWidth) - words[joint]) / std::max(levels[joint], 1.0F) / context.scale;
        indent = std::min(indent, std::max(fits, std::min(narrow, most)));
    }
    for (int joint = 0; joint < skeleton.jointCount(); ++joint) {
        if (shown[joint]) width = std::max(width, words[joint] + levels[joint] * context.px(indent));
    }
    // Half a pixel of rounding makes no panel wider.
    return {context.editor.characterRevision(), context.scale, context.px(indent), std::ceil(width - 0.5F)};
}

const UiState::NameRoom& nameRoom(const PanelContext& context) {
    UiState::NameRoom& known = context.state.nameRoom;
    if (known.characterRevision != context.editor.characterRevision() || known.scale != context.scale)
        known = measureNames(context);
    return known;
}

}  // namespace

float widthForNames(const PanelContext& context) {
    return nameRoom(context).width;
}

void drawSkeletonTab(const PanelContext& context) {
    followSelection(context);
    ImGui::SetNextItemWidth(-1.0F);
    ImGui::InputTextWithHint("##search", "search joints", &context.state.jointFilter);
    const animation::Skeleton& skeleton = context.editor.document().character().skeleton;
    drawMissingRoles(context);
    ImGui::PushID(
        context.editor.characterRevision());  // what is folded, and how far it is scrolled, is another model's affair
    ImGui::BeginChild("##tree", {0, 0}, true, ImGuiWindowFlags_HorizontalScrollbar);
    const Tree tree = makeTree(context.editor.document());
    ImGui::PushStyleVar(ImGuiStyleVar_IndentSpacing, nameRoom(context).indent);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(context.px(kGap), context.px(3)));
    bool found = context.state.jointFilter.empty();
    for (int joint = 0; joint < skeleton.jointCount(); ++joint) {
        if (!context.state.jointFilter.empty()) {
            if (!containsText(skeleton.names[joint], context.state.jointFilter)) continue;
            drawJoint(context, tree, joint);
            found = true;
        } else if (skeleton.parents[joint] == animation::kNoJoint) {
            drawJoint(context, tree, joint);
        }
    }
    ImGui::PopStyleVar(2);
    if (!found) mutedText("No joint's name has that in it. Empty the field to see all.");
    ImGui::EndChild();
    ImGui::PopID();
}

}  // namespace lutka::editor
