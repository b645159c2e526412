/// The left panel's Scene tab: the hierarchy of entities, and below it the inspector of the selected one.

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <functional>
#include <set>
#include <unordered_map>

#include "editor/ui/panels.hpp"
#include "editor/ui/style.hpp"
#include "editor/ui/widgets.hpp"

namespace lutka::editor {
namespace {

using scene::Entity;
using scene::EntityId;
using scene::EntityKind;
using scene::EntityScene;

constexpr const char* kEntityPayload = "lutka-entity";

/// A line of the list: an entity, how deep it hangs, and whether something hangs on it.
struct EntityRow {
    const Entity* entity = nullptr;
    int depth = 0;
    bool parent = false;
};

// What a user sees first in an entity.
const char* kindOf(const EntityScene& scene, EntityId id) {
    if (scene.find<scene::Ragdoll>(id) != nullptr) return "character";
    if (const auto* collider = scene.find<scene::Collider>(id)) {
        constexpr const char* names[] = {"floor", "box", "sphere", "capsule", "ramp", "stairs"};
        return names[static_cast<std::size_t>(collider->kind)];
    }
    if (const auto* light = scene.find<scene::Light>(id)) {
        constexpr const char* names[] = {"sun", "point light", "spot light"};
        return names[static_cast<std::size_t>(light->kind)];
    }
    return scene.find<scene::Camera>(id) != nullptr ? "camera" : "";
}

std::vector<EntityRow> rowsOf(const EntityScene& scene, const std::set<EntityId>& closed) {
    std::unordered_map<EntityId, std::vector<const Entity*>> children;
    for (const Entity& entity : scene.entities)
        children[entity.parent].push_back(&entity);
    std::vector<EntityRow> rows;
    const std::function<void(EntityId, int)> add = [&](EntityId parent, int depth) {
        const auto all = children.find(parent);
        if (all == children.end()) return;
        for (const Entity* entity : all->second) {
            rows.push_back({entity, depth, children.contains(entity->id)});
            if (!closed.contains(entity->id)) add(entity->id, depth + 1);
        }
    };
    add(scene::kNoEntity, 0);
    return rows;
}

Item itemOf(EntityId id) {
    return {Item::Kind::object, 0, static_cast<int>(id)};
}

void remove(Editor& editor, EntityId id) {
    editor.editScene("Delete " + scene::findEntity(editor.document().scene(), id)->name, "",
                     [&](EntityScene& scene) { scene::removeEntity(scene, id); });
}

void duplicate(Editor& editor, EntityId id) {
    EntityId copy = scene::kNoEntity;
    const bool done = editor.editScene("Duplicate " + scene::findEntity(editor.document().scene(), id)->name, "",
                                       [&](EntityScene& scene) { copy = scene::duplicateEntity(scene, id); });
    if (done) editor.select(itemOf(copy));
}

void drawContextMenu(const PanelContext& context, const Entity& entity) {
    if (!ImGui::BeginPopupContextItem("##entity")) return;
    const EntityId id = entity.id;
    if (ImGui::MenuItem("Rename")) {
        context.state.renaming = id;
        context.state.newName = entity.name;
    }
    const bool hangs = entity.parent != scene::kNoEntity;
    const bool unhang = ImGui::MenuItem("Hang on nothing", nullptr, false, hangs);
    const bool copy = ImGui::MenuItem("Duplicate");
    const bool gone = ImGui::MenuItem("Delete");
    ImGui::EndPopup();
    if (unhang) {
        context.editor.editScene("Reparent", "",
                                 [&](EntityScene& scene) { scene::reparentEntity(scene, id, scene::kNoEntity); });
    }
    if (copy) duplicate(context.editor, id);
    if (gone) remove(context.editor, id);
}

// An entity is hung on another one by dragging its line there.
void dragAndDrop(const PanelContext& context, const Entity& entity) {
    if (ImGui::BeginDragDropSource()) {
        ImGui::SetDragDropPayload(kEntityPayload, &entity.id, sizeof entity.id);
        ImGui::TextUnformatted(entity.name.c_str());
        ImGui::EndDragDropSource();
    }
    if (!ImGui::BeginDragDropTarget()) return;
    if (const ImGuiPayload* payload = ImGui::AcceptDragDropPayload(kEntityPayload)) {
        const EntityId child = *static_cast<const EntityId*>(payload->Data);
        const EntityId parent = entity.id;
        context.editor.editScene("Reparent", "",
                                 [&](EntityScene& scene) { scene::reparentEntity(scene, child, parent); });
    }
    ImGui::EndDragDropTarget();
}

void drawNameField(const PanelContext& context, EntityId id) {
    ImGui::SetNextItemWidth(-1.0F);
    ImGui::SetKeyboardFocusHere();
    const bool entered = ImGui::InputText("##rename", &context.state.newName, ImGuiInputTextFlags_EnterReturnsTrue);
    const bool left = ImGui::IsItemDeactivated();
    if (!entered && !left) return;
    const std::string name = context.state.newName;
    context.state.renaming = scene::kNoEntity;
    if (ImGui::IsKeyPressed(static_cast<int>(Key::escape), false)) return;
    context.editor.editScene("Rename", "", [&](EntityScene& scene) { scene::findEntity(scene, id)->name = name; });
}

void drawRow(const PanelContext& context, const EntityRow& row) {
    Editor& editor = context.editor;
    const Entity entity = *row.entity;  // an edit takes the list away from under it
    ImGui::PushID(static_cast<int>(entity.id));
    const float indent = static_cast<float>(row.depth) * context.px(14);
    if (indent > 0.0F) ImGui::Indent(indent);
    if (row.parent) {
        std::set<EntityId>& closed = context.state.closedEntities;
        const bool isClosed = closed.contains(entity.id);
        if (ImGui::ArrowButton("##fold", isClosed ? ImGuiDir_Right : ImGuiDir_Down)) {
            isClosed ? static_cast<void>(closed.erase(entity.id)) : static_cast<void>(closed.insert(entity.id));
        }
        ImGui::SameLine();
    }
    if (context.state.renaming == entity.id) {
        drawNameField(context, entity.id);
    } else {
        const bool selected = editor.workspace().selection.contains(itemOf(entity.id));
        const float width = ImGui::GetContentRegionAvail().x;
        const char* kind = kindOf(editor.document().scene(), entity.id);
        const float kindWidth = ImGui::CalcTextSize(kind).x;
        const std::string shown = nameWithin(entity.name, width - kindWidth - ImGui::GetStyle().ItemSpacing.x);
        const std::string label = shown + "###entity";
        if (ImGui::Selectable(label.c_str(), selected, ImGuiSelectableFlags_AllowDoubleClick, {width, 0})) {
            editor.select(itemOf(entity.id), ImGui::GetIO().KeyShift);
            if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
                context.state.renaming = entity.id;
                context.state.newName = entity.name;
            }
        }
        if (shown != entity.name) tooltip(entity.name);
        dragAndDrop(context, entity);
        ImGui::SameLine(indent + width - kindWidth);
        ImGui::TextColored(mutedColor(), "%s", kind);
        drawContextMenu(context, entity);
    }
    if (indent > 0.0F) ImGui::Unindent(indent);
    ImGui::PopID();
}

void drawToolbar(const PanelContext& context) {
    Editor& editor = context.editor;
    if (ImGui::Button("+ Add")) ImGui::OpenPopup("##add");
    tooltip("Shift+A: then click where it shall stand");
    if (ImGui::BeginPopup("##add")) {
        for (int kind = 0; kind < scene::kEntityKindCount; ++kind) {
            const auto one = static_cast<EntityKind>(kind);
            if (ImGui::MenuItem(std::string(scene::entityKindName(one)).c_str())) editor.beginAdd(one);
        }
        ImGui::EndPopup();
    }
    const auto active = editor.workspace().selection.active();
    const bool entity = active && active->kind == Item::Kind::object;
    const auto id = entity ? static_cast<EntityId>(active->index) : scene::kNoEntity;
    ImGui::BeginDisabled(!entity);
    ImGui::SameLine();
    if (ImGui::Button("Duplicate") && entity) duplicate(editor, id);
    ImGui::SameLine();
    if (ImGui::Button("Delete") && entity) remove(editor, id);
    ImGui::EndDisabled();
}

void drawSceneName(const PanelContext& context) {
    Editor& editor = context.editor;
    std::string name = editor.document().scene().name;
    labelled("Scene", context.px(52));
    if (textLine("##sceneName", name)) {
        editor.editScene("Rename the scene", "", [&](EntityScene& scene) { scene.name = name; });
    }
    tooltip(editor.document().sceneDocument().unsaved()
                ? "Unsaved changes; Ctrl+Alt+S saves " + editor.document().sceneDocument().file().string()
                : editor.document().sceneDocument().file().string());
}

}  // namespace

void drawEntityTab(const PanelContext& context) {
    const EntityScene& scene = context.editor.document().scene();
    drawSceneName(context);
    drawToolbar(context);
    const std::vector<EntityRow> rows = rowsOf(scene, context.state.closedEntities);
    const float height = ImGui::GetContentRegionAvail().y;
    ImGui::BeginChild("##entities", {0, height * 0.42F}, true);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(0, 0));
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(rows.size()));
    const std::uint64_t shown = context.editor.document().revision();
    const auto edited = [&] { return context.editor.document().revision() != shown; };
    while (!edited() && clipper.Step()) {
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd && !edited(); ++i)
            drawRow(context, rows[static_cast<std::size_t>(i)]);  // an edit takes away what the rows point to
    }
    ImGui::PopStyleVar();
    ImGui::EndChild();
    ImGui::BeginChild("##inspector");
    drawInspector(context);
    ImGui::EndChild();
}

}  // namespace lutka::editor
