/// The collision filter as a matrix: bodies by bodies, a click toggles a pair.

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cctype>

#include "editor/ui/panels.hpp"
#include "editor/ui/style.hpp"
#include "editor/ui/widgets.hpp"

namespace lutka::editor {
namespace {

// leftUpperArm: LUA. Columns are narrow.
std::string initials(const std::string& name) {
    std::string text(1, static_cast<char>(std::toupper(static_cast<unsigned char>(name.front()))));
    for (const char c : std::string_view(name).substr(1)) {
        if (std::isupper(static_cast<unsigned char>(c)) != 0) text += c;
    }
    if (text.size() == 1 && name.size() > 1) text += name[1];
    return text;
}

void drawCell(const PanelContext& context, int row, int column) {
    Editor& editor = context.editor;
    const EditorDocument& document = editor.document();
    const auto& bodies = document.profile().bodies;
    const float size = ImGui::GetFrameHeight() * 0.86F;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::PushID(row * static_cast<int>(bodies.size()) + column);
    const bool fixed = row == column || document.linked(row, column);
    const bool collide = document.collides(row, column);
    const bool clicked = ImGui::InvisibleButton("##cell", {size, size}) && !fixed;
    const bool hovered = ImGui::IsItemHovered();
    ImDrawList* list = ImGui::GetWindowDrawList();
    const ImVec2 low(at.x + 2, at.y + 2);
    const ImVec2 high(at.x + size - 2, at.y + size - 2);
    if (collide) {
        list->AddRectFilled(low, high, ImGui::GetColorU32(goodColor()), 2.0F);
    } else if (fixed) {
        const ImVec2 middle((low.x + high.x) * 0.5F, (low.y + high.y) * 0.5F);
        list->AddCircleFilled(middle, size * 0.1F, ImGui::GetColorU32(mutedColor()));
    } else {
        list->AddRectFilled(low, high, ImGui::GetColorU32(ImGuiCol_FrameBg), 2.0F);
    }
    if (hovered && !fixed) list->AddRect(low, high, ImGui::GetColorU32(accentColor()), 2.0F, 0, 2.0F);
    const char* what = row == column ? "the same body"
                       : fixed       ? "linked by a joint: never collide"
                       : collide     ? "collide; a click lets them pass through each other"
                                     : "pass through each other; a click lets them collide";
    tooltip(fmt::format("{} and {}\n{}", bodies[row].name, bodies[column].name, what));
    ImGui::PopID();
    if (clicked) editor.edit([&](EditorDocument& one) { return one.setCollision(row, column, !collide); });
}

}  // namespace

void drawCollisions(const PanelContext& context) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const auto [left, right] = viewSpan(context);
    ImGui::SetNextWindowPos({(left + right) * 0.5F, size.y * 0.5F}, ImGuiCond_Appearing, {0.5F, 0.5F});
    ImGui::SetNextWindowSizeConstraints({0, 0}, {size.x * 0.95F, size.y * 0.9F});
    bool open = true;
    if (ImGui::Begin("Collisions between bodies", &open,
                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings |
                         ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_HorizontalScrollbar)) {
        const int count = static_cast<int>(context.editor.document().profile().bodies.size());
        ImGui::TextColored(mutedColor(),
                           "Green pairs collide, grey ones pass through each other. A dot: never, they are linked.");
        ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, ImVec2(1, 1));
        if (ImGui::BeginTable("##collisions", count + 1, ImGuiTableFlags_SizingFixedFit)) {
            ImGui::TableSetupColumn("body", ImGuiTableColumnFlags_WidthFixed, context.px(106));
            for (int column = 0; column < count; ++column)
                ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, context.px(27));
            ImGui::TableNextRow();
            for (int column = 0; column < count; ++column) {
                ImGui::TableSetColumnIndex(column + 1);
                const std::string& name = context.editor.document().profile().bodies[column].name;
                ImGui::TextUnformatted(initials(name).c_str());
                tooltip(name);
            }
            for (int row = 0; row < count; ++row) {
                ImGui::TableNextRow();
                ImGui::TableSetColumnIndex(0);
                const std::string& name = context.editor.document().profile().bodies[row].name;
                ImGui::AlignTextToFramePadding();
                ImGui::TextUnformatted(name.c_str());
                for (int column = 0; column < count; ++column) {
                    ImGui::TableSetColumnIndex(column + 1);
                    drawCell(context, row, column);
                }
            }
            ImGui::EndTable();
        }
        ImGui::PopStyleVar();
    }
    ImGui::End();
    context.state.showCollisions = open;
}

}  // namespace lutka::editor
