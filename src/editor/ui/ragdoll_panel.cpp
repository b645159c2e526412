/// The tab of the selected bodies: what they are, their shape and joint; a table of all when none is selected, or the
/// values of an object.

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "editor/ui/panels.hpp"
#include "editor/ui/part_fields.hpp"
#include "editor/ui/style.hpp"
#include "editor/ui/widgets.hpp"

namespace lutka::editor {
namespace {

using physics::ConstraintProfile;

// Buttons that break the line when the panel is full. What can't be done now stays where it is, without its colour.
bool wrappedButton(const char* name, const std::string& what, bool enabled = true) {
    const float width = ImGui::CalcTextSize(name).x + 2.0F * ImGui::GetStyle().FramePadding.x;
    const float end = ImGui::GetItemRectMax().x + ImGui::GetStyle().ItemSpacing.x + width;
    if (end < ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x) ImGui::SameLine();
    ImGui::BeginDisabled(!enabled);
    const bool clicked = ImGui::Button(name);
    ImGui::EndDisabled();
    tooltip(what);
    return clicked;
}

void drawValueButtons(const PanelContext& context, const PartFields& fields) {
    Editor& editor = context.editor;
    const std::string& name = fields.profile().name;
    const bool pinned = editor.workspace().pulls.findPin(fields.doll, name) != editor.workspace().pulls.pins.end();
    const float pin = ImGui::CalcTextSize("Unpin").x + 2.0F * ImGui::GetStyle().FramePadding.x;
    if (ImGui::Button(pinned ? "Unpin###pin" : "Pin###pin", {pin, 0})) editor.perform(Action::pin);
    tooltip("P: holds the body where it is");
    if (wrappedButton("Focus", "F: brings it into the middle of the view")) editor.perform(Action::focus);
    const bool sided = physics::counterpartOf(editor.document().profile(), fields.body()) >= 0;
    if (wrappedButton("Mirror", "Ctrl+M: gives the other side these values", sided))
        editor.perform(Action::mirrorParts);
    if (wrappedButton("Copy", "Ctrl+C: takes shape, mass, limits and friction")) editor.perform(Action::copyPart);
    if (wrappedButton("Paste", "Ctrl+V: gives what was copied to all selected bodies",
                      editor.workspace().clipboard.has_value())) {
        editor.perform(Action::pastePart);
    }
    if (wrappedButton("Refit", "Fits the shapes of the selected bodies to the skin again; limits and masses stay",
                      fields.edits().shape || fields.edits().jointFromBody)) {
        fields.change("Refit", [&](EditorDocument::Part& part) -> Result<void> {
            const bool isHull = part.body.shape.kind == physics::BodyShape::Kind::hull;
            if (isHull && fields.fittedOf(part).shape.kind != physics::BodyShape::Kind::hull)
                return takeHullOfSkin(fields, part);
            part.body.shape = fields.fittedOf(part).shape;
            part.body.jointFromBody = fields.fittedOf(part).jointFromBody;
            return {};
        });
    }
    if (wrappedButton("As fitted", "Forgets your changes of these bodies and their joints", fields.edits().any()))
        editor.edit([&](EditorDocument& document) { return document.resetParts(fields.bodies); });
}

// Which bodies there are.
void drawSetButtons(const PanelContext& context, const PartFields& fields) {
    Editor& editor = context.editor;
    const bool root = fields.body() == 0;
    if (wrappedButton("Split", "Ctrl+K: parts it at the joint nearest to its middle")) {
        editor.perform(Action::splitBodies);
    } else if (wrappedButton("Merge up", "Ctrl+J: makes one body of it and the one it hangs on", !root)) {
        editor.perform(Action::mergeBodies);
    } else if (wrappedButton("Remove", "X: takes the body away; its part follows the one above", !root)) {
        editor.perform(Action::removeBodies);
    }
}

// Lines closer together where the panel is low, so that a joint with all its limits is seen whole.
void pushLineSpacing(const PanelContext& context) {
    const bool low = ImGui::GetWindowHeight() < context.px(720);
    const ImVec2 spacing = ImGui::GetStyle().ItemSpacing;
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(spacing.x, low ? context.px(3) : spacing.y));
}

void drawBody(const PanelContext& context, const Item& item) {
    const PartFields fields{context, context.editor.workspace().selectedBodies(), item.doll};
    const physics::BodyProfile& body = fields.profile();
    ImGui::PushFont(context.fonts.heading);
    const float room = ImGui::GetContentRegionAvail().x;
    const std::string heading = nameWithin(body.name, room);
    ImGui::TextUnformatted(heading.c_str());
    ImGui::PopFont();
    if (heading != body.name) tooltip(body.name);
    // One line whatever is selected, so that nothing below moves.
    const auto count = static_cast<int>(fields.bodies.size());
    const bool both = context.editor.document().symmetric();
    if (count > 1) {
        ImGui::TextColored(accentColor(), "Changes go to all %d selected bodies", count);
    } else if (both) {
        ImGui::TextColored(accentColor(), "Changes go to both sides (Shift+M)");
    } else {
        ImGui::TextColored(mutedColor(), "%s", nameWithin("joint " + body.joint, room).c_str());
    }
    tooltip(body.jointPath);
    // Two lines of them, also beside a scroll bar.
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(context.px(3), ImGui::GetStyle().FramePadding.y));
    drawValueButtons(context, fields);
    const std::uint64_t shown = context.editor.document().revision();
    drawSetButtons(context, fields);
    ImGui::PopStyleVar();
    if (context.editor.document().revision() != shown) return;  // other bodies: what is told below may be gone
    caption("BODY");
    drawShapeFields(fields);
    drawPlaceFields(fields);
    if (item.index > 0) {
        drawJointFields(fields);
    } else {
        mutedText("The root of the ragdoll: it hangs on nothing.");
    }
    drawAddedShapeFields(fields);
}

void drawTable(const PanelContext& context) {
    Editor& editor = context.editor;
    const physics::RagdollProfile& profile = editor.document().profile();
    mutedText(fmt::format("{:.2f} m, {:.1f} kg, {} {}. Click one to edit it.", profile.heightM, profile.totalMassKg,
                          profile.bodies.size(), profile.bodies.size() == 1 ? "body" : "bodies"));
    if (ImGui::Button("Collisions …")) context.state.showCollisions = true;
    tooltip("Which bodies collide with which");
    if (!ImGui::BeginTable("##bodies", 3, ImGuiTableFlags_RowBg)) return;
    // Names get what figures leave, and in a narrow panel enough to tell them apart.
    constexpr float least = 0.41F;
    const float all = ImGui::GetContentRegionAvail().x;
    const float figures = ImGui::CalcTextSize("10.00 kg").x + ImGui::CalcTextSize("±85  ±85  ±75°").x +
                          4.0F * ImGui::GetStyle().CellPadding.x;
    ImGui::TableSetupColumn("Body", ImGuiTableColumnFlags_WidthFixed, std::max(all - figures, least * all));
    ImGui::TableSetupColumn("Mass", ImGuiTableColumnFlags_WidthFixed);
    ImGui::TableSetupColumn("Flex, side, twist", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableHeadersRow();
    for (int i = 0; i < static_cast<int>(profile.bodies.size()); ++i) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        const std::string& name = profile.bodies[i].name;
        const std::string shown = nameWithin(name, ImGui::GetContentRegionAvail().x);
        ImGui::PushID(i);
        if (ImGui::Selectable((shown + "###body").c_str(), false, ImGuiSelectableFlags_SpanAllColumns)) {
            editor.select(Item{Item::Kind::body, 0, i}, ImGui::GetIO().KeyShift);
        }
        ImGui::PopID();
        if (shown != name) tooltip(name);
        ImGui::TableNextColumn();
        // As many digits as the column has room for.
        const float mass = profile.bodies[i].massKg;
        ImGui::TextUnformatted(fmt::format("{:.{}f} kg", mass, mass < 100.0F ? 2 : mass < 1000.0F ? 1 : 0).c_str());
        ImGui::TableNextColumn();
        if (i == 0) continue;
        const ConstraintProfile& c = profile.constraints[i - 1];
        const auto& bind = editor.document().asset().rig.bindModelFromBody;
        const physics::JointRange range = physics::jointRange(c, {bind[c.parent], bind[c.child]});
        const bool isHinge = c.kind == ConstraintProfile::Kind::hinge;
        const std::string limits =
            isHinge ? fmt::format("{:.0f}° to {:.0f}°", degrees(range.flexion.low), degrees(range.flexion.high))
                    : fmt::format("±{:.0f}  ±{:.0f}  ±{:.0f}°", degrees(c.cone.swingZ), degrees(c.cone.swingY),
                                  degrees(c.cone.twist));
        const std::string first = isHinge ? fmt::format("{:.0f}° …", degrees(range.flexion.low))
                                          : fmt::format("±{:.0f}° …", degrees(c.cone.swingZ));
        const std::string seen = firstThatFits({limits, first, "…"}, ImGui::GetContentRegionAvail().x);
        ImGui::TextColored(mutedColor(), "%s", seen.c_str());
        if (seen != limits) tooltip(limits);
    }
    ImGui::EndTable();
}

}  // namespace

void drawRagdollTab(const PanelContext& context) {
    const auto active = context.editor.workspace().selection.active();
    if (!active) {
        drawTable(context);
    } else if (active->kind == Item::Kind::body) {
        pushLineSpacing(context);
        drawBody(context, *active);
        ImGui::PopStyleVar();
    } else {
        mutedText(context.editor.workspace().nameOf(*active) + ": its components are under Scene, on the left.");
        drawTable(context);
    }
}

}  // namespace lutka::editor
