/// What frames the picture: menu bar, status bar, the transport over the view.

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "editor/files/file_list.hpp"
#include "editor/ui/panels.hpp"
#include "editor/ui/side_panels.hpp"
#include "editor/ui/style.hpp"
#include "editor/ui/widgets.hpp"

namespace lutka::editor {
namespace {

constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse |
                                    ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus;

void scaleMenu(const PanelContext& context);

void item(const PanelContext& context, Action action, bool enabled = true, bool checked = false) {
    const std::string name(actionName(action));
    if (ImGui::MenuItem(name.c_str(), shortcutText(action).c_str(), checked, enabled)) context.editor.perform(action);
}

// Of a file with several; figures are counted from 1, as in what is told of the others.
void figureMenu(const PanelContext& context) {
    const animation::Character& character = context.editor.document().character();
    if (!ImGui::BeginMenu("Figure of the file", character.figures.size() > 1)) return;
    std::optional<int> chosen;
    for (int i = 0; i < static_cast<int>(character.figures.size()); ++i) {
        const animation::FigureInfo& figure = character.figures[static_cast<std::size_t>(i)];
        const std::string line = fmt::format("{}: {}###{}", i + 1, figure.name, i);
        if (ImGui::MenuItem(line.c_str(), nullptr, i == character.figure)) chosen = i + 1;
        tooltip(fmt::format("{} joints, {} vertices", figure.joints.size(), figure.vertices));
    }
    ImGui::EndMenu();
    if (chosen) context.editor.openFigure(*chosen);
}

void fileMenu(const PanelContext& context) {
    if (!ImGui::BeginMenu("File")) return;
    item(context, Action::openModel);
    item(context, Action::nextFile);
    item(context, Action::previousFile);
    item(context, Action::reload);
    figureMenu(context);
    if (ImGui::MenuItem("Read it again whenever it changes", nullptr, context.editor.watching))
        context.editor.watching = !context.editor.watching;
    item(context, Action::openRecent, true, context.editor.view.gallery);
    if (ImGui::BeginMenu("Open recent", !context.state.recent.empty())) {
        std::optional<std::filesystem::path> chosen;
        for (const std::filesystem::path& file : context.state.recent) {
            // By its path: several files of one name are several lines.
            ImGui::PushID(file.c_str());
            if (ImGui::MenuItem(nameAmong(context.state.recent, file).c_str())) chosen = file;
            ImGui::PopID();
            tooltip(file.string());
        }
        if (chosen) context.editor.open(*chosen);
        ImGui::EndMenu();
    }
    const bool allowed = context.editor.allowsOutside();
    if (ImGui::MenuItem("Take files from outside of a model's folder", nullptr, allowed))
        context.editor.allowOutside(!allowed);
    tooltip("Pictures, buffers and material files of models that are opened from now on. For files that you trust.");
    ImGui::Separator();
    item(context, Action::saveProfile);
    item(context, Action::saveProfileAs);
    item(context, Action::saveScene);
    item(context, Action::saveSceneAs);
    item(context, Action::exportBaked);
    item(context, Action::exportRagdoll);
    ImGui::Separator();
    item(context, Action::quit);
    ImGui::EndMenu();
}

// Every change, the next to redo on top, then the present, then what can be undone; a click goes there.
void historyMenu(const PanelContext& context) {
    const EditorDocument& document = context.editor.document();
    if (!ImGui::BeginMenu("History", document.canUndo() || document.canRedo())) return;
    const std::vector<std::string> redo = document.redoLabels();
    const std::vector<std::string> undo = document.undoLabels();
    int wanted = 0;
    for (int i = static_cast<int>(redo.size()) - 1; i >= 0; --i) {
        ImGui::PushID(i + 1);
        if (ImGui::MenuItem(redo[i].c_str())) wanted = i + 1;
        ImGui::PopID();
    }
    ImGui::TextColored(accentColor(), "now");
    for (int i = 0; i < static_cast<int>(undo.size()); ++i) {
        ImGui::PushID(-i - 1);
        if (ImGui::MenuItem(undo[i].c_str())) wanted = -i - 1;
        ImGui::PopID();
    }
    ImGui::EndMenu();
    if (wanted != 0) context.editor.travel(wanted);
}

void editMenu(const PanelContext& context) {
    if (!ImGui::BeginMenu("Edit")) return;
    const EditorDocument& document = context.editor.document();
    const std::string undo = document.canUndo() ? "Undo: " + document.undoLabel() : "Undo";
    const std::string redo = document.canRedo() ? "Redo: " + document.redoLabel() : "Redo";
    if (ImGui::MenuItem(undo.c_str(), shortcutText(Action::undo).c_str(), false, document.canUndo())) {
        context.editor.perform(Action::undo);
    }
    if (ImGui::MenuItem(redo.c_str(), shortcutText(Action::redo).c_str(), false, document.canRedo())) {
        context.editor.perform(Action::redo);
    }
    historyMenu(context);
    ImGui::Separator();
    if (ImGui::BeginMenu("Add")) {
        for (int kind = 0; kind < scene::kEntityKindCount; ++kind) {
            const auto one = static_cast<scene::EntityKind>(kind);
            if (ImGui::MenuItem(std::string(scene::entityKindName(one)).c_str())) context.editor.beginAdd(one);
        }
        ImGui::EndMenu();
    }
    const bool selected = !context.editor.workspace().selection.empty();
    if (ImGui::MenuItem("Select none", "Esc", false, selected)) context.editor.perform(Action::selectNone);
    const bool body = !context.editor.workspace().selectedBodies().empty();
    item(context, Action::selectMirror, body);
    item(context, Action::selectChildren, body);
    ImGui::Separator();
    const bool anyBody = !context.editor.workspace().selectedBodies().empty();
    item(context, Action::copyPart, anyBody);
    item(context, Action::pastePart, anyBody && context.editor.workspace().clipboard.has_value());
    item(context, Action::mirrorParts, anyBody);
    item(context, Action::toggleSymmetric, true, context.editor.document().symmetric());
    item(context, Action::addBody);
    item(context, Action::splitBodies, anyBody);
    item(context, Action::mergeBodies, anyBody);
    item(context, Action::removeBodies, anyBody);
    item(context, Action::swingLimits, anyBody);
    if (ImGui::MenuItem("Collisions between bodies …")) context.state.showCollisions = true;
    ImGui::Separator();
    item(context, Action::pin, selected);
    item(context, Action::unpinAll, !context.editor.workspace().pulls.pins.empty());
    ImGui::EndMenu();
}

void viewMenu(const PanelContext& context) {
    if (!ImGui::BeginMenu("View")) return;
    item(context, Action::toggleDebug, true, context.editor.view.debug);
    item(context, Action::toggleHandles, true, context.editor.workspace().showHandles);
    item(context, Action::toggleClips, true, context.editor.view.clips);
    item(context, Action::togglePanels, true, context.editor.view.panels);
    if (ImGui::BeginMenu("Layers")) {
        for (const scene::DebugLayerInfo& layer : scene::debugLayerInfos()) {
            bool& on = context.editor.view.layers.*layer.member;
            if (!ImGui::MenuItem(layer.title.data(), nullptr, on)) continue;
            on = !on;
            context.editor.view.debug = true;
        }
        ImGui::EndMenu();
    }
    ImGui::Separator();
    item(context, Action::focus);
    item(context, Action::followDoll, true, context.editor.workspace().followed.has_value());
    item(context, Action::nextTool);
    item(context, Action::toggleLocalAxes, true, context.editor.workspace().localAxes);
    item(context, Action::viewFront);
    item(context, Action::viewRight);
    item(context, Action::viewTop);
    item(context, Action::viewBack);
    item(context, Action::viewLeft);
    item(context, Action::viewBottom);
    if (ImGui::MenuItem("Light theme", nullptr, context.state.lightTheme)) {
        context.state.lightTheme = !context.state.lightTheme;
        applyStyle(context.scale, context.state.lightTheme);
    }
    scaleMenu(context);
    item(context, Action::toggleParallel, true, context.editor.workspace().camera.orthographic);
    ImGui::EndMenu();
}

void simulateMenu(const PanelContext& context) {
    if (!ImGui::BeginMenu("Simulate")) return;
    item(context, Action::togglePlay, true, context.editor.player().playing());
    item(context, Action::stepOnce);
    item(context, Action::reset);
    item(context, Action::returnToPlay, context.editor.player().canReturnToPlay());
    item(context, Action::throwBall);
    item(context, Action::goLimp, context.editor.document().scene().simulation.puppets.has_value());
    item(context, Action::getUp);
    item(context, Action::fallFromClip, context.editor.player().clip() != nullptr);
    const bool holds = context.editor.player().held().any();
    item(context, Action::selectedOnly, holds || !context.editor.workspace().selectedBodies().empty(), holds);
    ImGui::EndMenu();
}

void scaleMenu(const PanelContext& context) {
    if (!ImGui::BeginMenu("Size of the panels")) return;
    float& chosen = context.state.uiScale;
    if (ImGui::MenuItem("The monitor's", nullptr, chosen <= 0.0F)) chosen = 0.0F;
    for (const float scale : {0.75F, 1.0F, 1.25F, 1.5F, 1.75F, 2.0F, 2.5F, 3.0F}) {
        if (ImGui::MenuItem(fmt::format("{:.0f} %", scale * 100.0F).c_str(), nullptr, chosen == scale)) chosen = scale;
    }
    ImGui::EndMenu();
}

}  // namespace

void drawMenuBar(const PanelContext& context) {
    if (!ImGui::BeginMainMenuBar()) return;
    fileMenu(context);
    editMenu(context);
    viewMenu(context);
    simulateMenu(context);
    if (ImGui::BeginMenu("Help")) {
        item(context, Action::toggleHelp, true, context.editor.view.help);
        ImGui::EndMenu();
    }
    const EditorDocument& document = context.editor.document();
    const bool unsaved = document.unsaved() || document.sceneDocument().unsaved();
    const std::string name = document.character().name + (document.unsaved() ? " ●" : "") + "  /  " +
                             document.scene().name + (document.sceneDocument().unsaved() ? " ●" : "");
    const float room = ImGui::GetWindowWidth() - ImGui::GetCursorPosX() - context.px(28);
    const std::string shown = room > context.px(40) ? nameWithin(name, room) : "";
    ImGui::SameLine(ImGui::GetWindowWidth() - ImGui::CalcTextSize(shown.c_str()).x - context.px(14));
    ImGui::TextColored(unsaved ? accentColor() : mutedColor(), "%s", shown.c_str());
    std::string what = document.character().file.string();
    if (document.unsaved()) what = "The ragdoll has unsaved changes: Ctrl+S saves " + document.profileFile().string();
    if (document.sceneDocument().unsaved()) {
        what += "\nThe scene has unsaved changes: Ctrl+Alt+S saves " + document.sceneDocument().file().string();
    }
    tooltip(what);
    ImGui::EndMainMenuBar();
}

void drawStatusBar(const PanelContext& context) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0, size.y - statusHeight()});
    ImGui::SetNextWindowSize({size.x, statusHeight()});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0F);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(context.px(10), 3.0F));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetStyleColorVec4(ImGuiCol_MenuBarBg));
    ImGui::Begin("##status", nullptr, kFixed | ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoScrollbar);
    chip(std::string(stateWords(context.editor.state())), ImGui::GetColorU32(accentColor()));
    ImGui::SameLine();
    ImGui::TextUnformatted(context.editor.workspace().hint.c_str());
    const Player& player = context.editor.player();
    const bool late = player.playing() && !player.loop().keepsUp();
    const std::string slow = late ? fmt::format("slowed to {:.0f} %   ", 100.0 * player.loop().share()) : "";
    const float share = context.history.pictureShare;
    const std::string coarse = share < 1.0F ? fmt::format("picture at {:.0f} %   ", share * 100.0F) : "";
    const int held = player.held().count();
    const std::string still = held > 0 ? fmt::format("{} bodies held   ", held) : "";
    const std::string time = fmt::format("{:.2f} s   {:.0f} fps", player.seconds(), context.history.fps());
    // In a narrow window what is under way goes first.
    const float room = size.x - ImGui::GetItemRectMax().x - context.px(28);
    const std::string right = firstThatFits({still + coarse + slow + time, slow + time, time, ""}, room);
    ImGui::SameLine(size.x - ImGui::CalcTextSize(right.c_str()).x - context.px(14));
    ImGui::TextColored(late ? warningColor() : mutedColor(), "%s", right.c_str());
    ImGui::End();
    ImGui::PopStyleColor();
    ImGui::PopStyleVar(3);
}

void drawTransport(const PanelContext& context) {
    Editor& editor = context.editor;
    const auto [left, right] = viewSpan(context);
    const float middle = (left + right) * 0.5F;
    const bool narrow = right - left < context.px(320);
    ImGui::SetNextWindowPos({middle, ImGui::GetFrameHeight() + context.px(8)}, ImGuiCond_Always, {0.5F, 0.0F});
    ImGui::SetNextWindowBgAlpha(0.88F);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(context.px(6), context.px(5)));
    ImGui::Begin("##transport", nullptr, kFixed | ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_AlwaysAutoResize);
    const ImVec2 button(context.px(narrow ? 50 : 62), 0);
    if (ImGui::Button(editor.player().playing() ? "Pause" : "Play", button)) editor.perform(Action::togglePlay);
    tooltip("Space");
    ImGui::SameLine();
    if (ImGui::Button("Step", button)) editor.perform(Action::stepOnce);
    tooltip("Right arrow: one step of 1/60 s");
    ImGui::SameLine();
    if (ImGui::Button("Reset", button)) editor.perform(Action::reset);
    tooltip("Ctrl+R: back to the scene's start");
    if (!narrow) ImGui::SameLine();
    auto speed = static_cast<float>(editor.player().speed());
    ImGui::SetNextItemWidth(narrow ? -1.0F : context.px(96));
    if (slider("##speed", speed, 0.05F, 1.0F, "speed %.2f")) editor.player().setSpeed(speed);
    tooltip("Slow motion: simulated seconds a second");
    context.state.transportBottom = ImGui::GetWindowPos().y + ImGui::GetWindowSize().y;
    ImGui::End();
    ImGui::PopStyleVar();
}

}  // namespace lutka::editor
