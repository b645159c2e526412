#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "editor/ui/panels.hpp"
#include "editor/ui/style.hpp"
#include "editor/ui/widgets.hpp"

namespace lutka::editor {
namespace {

constexpr ImGuiWindowFlags kDialog = ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings |
                                     ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize;

void placeInMiddle() {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({size.x * 0.5F, size.y * 0.45F}, ImGuiCond_Always, {0.5F, 0.5F});
}

std::filesystem::path suggestedPath(const PanelContext& context, Editor::Dialog dialog) {
    const EditorDocument& document = context.editor.document();
    switch (dialog) {
        case Editor::Dialog::saveAs:
            return document.profileFile();
        case Editor::Dialog::exportBaked:
            return std::filesystem::path(document.character().name + "_fall.glb");
        case Editor::Dialog::openModel:
        case Editor::Dialog::none:
            break;
    }
    return document.character().file;
}

const char* titleOf(Editor::Dialog dialog) {
    switch (dialog) {
        case Editor::Dialog::openModel:
            return "Open a model or a profile";
        case Editor::Dialog::saveAs:
            return "Save the profile as";
        case Editor::Dialog::exportBaked:
            return "Export the fall as a baked glb";
        case Editor::Dialog::none:
            break;
    }
    return "";
}

// Folders and files that could be meant, under the field; a click takes one.
void listFolder(const PanelContext& context) {
    constexpr std::size_t most = 200;
    namespace fs = std::filesystem;
    const fs::path typed(context.state.path);
    std::error_code failed;
    const fs::path folder = fs::is_directory(typed, failed) ? typed : typed.parent_path();
    std::vector<fs::directory_entry> entries;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder.empty() ? "." : folder, failed)) {
        if (entry.path().filename().string().front() != '.' && entries.size() < most) entries.push_back(entry);
    }
    std::sort(entries.begin(), entries.end(), [&](const auto& a, const auto& b) {
        std::error_code ignored;
        const bool aFolder = a.is_directory(ignored);
        const bool bFolder = b.is_directory(ignored);
        return aFolder != bFolder ? aFolder : a.path() < b.path();
    });
    ImGui::BeginChild("##folder", {0, context.px(220)}, true);
    if (ImGui::Selectable("../")) context.state.path = (folder / "..").lexically_normal().string();
    for (const fs::directory_entry& entry : entries) {
        std::error_code ignored;
        const bool isFolder = entry.is_directory(ignored);
        const std::string name = entry.path().filename().string() + (isFolder ? "/" : "");
        if (ImGui::Selectable(name.c_str(), entry.path() == typed)) {
            context.state.path = entry.path().string() + (isFolder ? "/" : "");
        }
    }
    ImGui::EndChild();
}

void finishFileDialog(const PanelContext& context, Editor::Dialog dialog) {
    Editor& editor = context.editor;
    const std::filesystem::path file(context.state.path);
    switch (dialog) {
        case Editor::Dialog::openModel:
            editor.open(file);
            break;
        case Editor::Dialog::saveAs:
            editor.workspace().report(editor.save(file));
            break;
        case Editor::Dialog::exportBaked:
            editor.workspace().report(editor.exportBaked(file, context.state.exportSeconds));
            break;
        case Editor::Dialog::none:
            break;
    }
}

void drawFileDialog(const PanelContext& context) {
    Editor& editor = context.editor;
    if (editor.dialog == Editor::Dialog::none) return;
    const char* title = titleOf(editor.dialog);
    if (!ImGui::IsPopupOpen(title)) {
        context.state.path = suggestedPath(context, editor.dialog).string();
        ImGui::OpenPopup(title);
    }
    placeInMiddle();
    if (!ImGui::BeginPopupModal(title, nullptr, kDialog)) return;
    ImGui::SetNextItemWidth(context.px(520));
    if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
    bool done = ImGui::InputText("##path", &context.state.path, ImGuiInputTextFlags_EnterReturnsTrue);
    if (editor.dialog == Editor::Dialog::openModel) listFolder(context);
    if (editor.dialog == Editor::Dialog::exportBaked) {
        ImGui::SetNextItemWidth(context.px(200));
        ImGui::SliderFloat("seconds", &context.state.exportSeconds, 0.5F, 20.0F, "%.1f");
        mutedText("The first doll's motion from the start of the scene, as an animation of its skin.");
    }
    ImGui::Spacing();
    const ImVec2 button(context.px(110), 0);
    done = ImGui::Button(editor.dialog == Editor::Dialog::openModel ? "Open" : "Save", button) || done;
    ImGui::SameLine();
    const bool cancelled = ImGui::Button("Cancel", button) || ImGui::IsKeyPressed(static_cast<int>(Key::escape), false);
    if (done || cancelled) {
        const Editor::Dialog dialog = std::exchange(editor.dialog, Editor::Dialog::none);
        ImGui::CloseCurrentPopup();
        if (done && !cancelled) finishFileDialog(context, dialog);
    }
    ImGui::EndPopup();
}

void drawQuestion(const PanelContext& context) {
    constexpr const char* title = "Unsaved changes";
    Editor& editor = context.editor;
    if (editor.asking() && !ImGui::IsPopupOpen(title)) ImGui::OpenPopup(title);
    placeInMiddle();
    if (!ImGui::BeginPopupModal(title, nullptr, kDialog)) return;
    ImGui::Text("The ragdoll of %s has changes that are not saved.", editor.document().character().name.c_str());
    mutedText("Save writes " + editor.document().profileFile().string());
    ImGui::Spacing();
    const ImVec2 button(context.px(110), 0);
    std::optional<Editor::Answer> answer;
    if (ImGui::Button("Save", button)) answer = Editor::Answer::save;
    ImGui::SameLine();
    if (ImGui::Button("Discard", button)) answer = Editor::Answer::discard;
    ImGui::SameLine();
    if (ImGui::Button("Cancel", button) || ImGui::IsKeyPressed(static_cast<int>(Key::escape), false)) {
        answer = Editor::Answer::cancel;
    }
    if (answer) {
        ImGui::CloseCurrentPopup();
        editor.answer(*answer);
    }
    ImGui::EndPopup();
}

void helpRow(const std::string& keys, std::string_view what) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextColored(accentColor(), "%s", keys.c_str());
    ImGui::TableNextColumn();
    ImGui::PushTextWrapPos(0.0F);
    ImGui::TextUnformatted(what.data(), what.data() + what.size());
    ImGui::PopTextWrapPos();
}

// Keys take what they need, the explanation the rest.
bool beginHelpTable(const PanelContext& context, const char* id, float keyWidth) {
    if (!ImGui::BeginTable(id, 2)) return false;
    ImGui::TableSetupColumn("keys", ImGuiTableColumnFlags_WidthFixed, context.px(keyWidth));
    ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthStretch);
    return true;
}

}  // namespace

void drawDialogs(const PanelContext& context) {
    drawFileDialog(context);
    drawQuestion(context);
}

void drawHelp(const PanelContext& context) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    placeInMiddle();
    ImGui::SetNextWindowSize({std::min(context.px(900), size.x - 20), 0});
    bool open = true;
    if (ImGui::Begin("Keys", &open, (kDialog & ~ImGuiWindowFlags_AlwaysAutoResize) | ImGuiWindowFlags_NoCollapse)) {
        if (ImGui::BeginTable("##help", 2, ImGuiTableFlags_SizingStretchSame)) {
            ImGui::TableNextColumn();
            if (beginHelpTable(context, "##actions", 100)) {
                for (const Binding& binding : keyBindings())
                    helpRow(shortcutText(binding), actionName(binding.action));
                ImGui::EndTable();
            }
            ImGui::TableNextColumn();
            if (beginHelpTable(context, "##mouse", 160)) {
                for (const HelpLine& line : mouseHelp())
                    helpRow(std::string(line.keys), line.what);
                ImGui::EndTable();
            }
            ImGui::EndTable();
        }
    }
    ImGui::End();
    context.editor.view.help = open;
}

void drawToasts(const PanelContext& context) {
    Editor& editor = context.editor;
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const float left = editor.view.panels ? context.px(kLeftPanelWidth) : 0.0F;
    const float right = editor.view.panels ? context.px(kRightPanelWidth) : 0.0F;
    const float middle = left + (size.x - left - right) * 0.5F;
    float bottom = size.y - ImGui::GetFrameHeight() - context.px(16);
    std::optional<std::size_t> closed;
    const std::vector<Toast>& toasts = editor.workspace().toasts;
    for (std::size_t i = 0; i < toasts.size(); ++i) {
        const Toast& toast = toasts[i];
        ImGui::SetNextWindowPos({middle, bottom}, ImGuiCond_Always, {0.5F, 1.0F});
        ImGui::SetNextWindowBgAlpha(0.94F);
        const ImVec4 color = toast.kind == Toast::Kind::error     ? errorColor()
                             : toast.kind == Toast::Kind::warning ? warningColor()
                                                                  : goodColor();
        ImGui::PushStyleColor(ImGuiCol_Border, color);
        ImGui::Begin(fmt::format("##toast{}", i).c_str(), nullptr,
                     kDialog | ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoFocusOnAppearing);
        ImGui::PushTextWrapPos(std::min(context.px(460), (size.x - left - right) * 0.9F));
        ImGui::TextUnformatted(toast.text.c_str());
        ImGui::PopTextWrapPos();
        if (ImGui::IsWindowHovered() && ImGui::IsMouseClicked(ImGuiMouseButton_Left)) closed = i;
        bottom -= ImGui::GetWindowHeight() + context.px(6);
        ImGui::End();
        ImGui::PopStyleColor();
    }
    if (closed) editor.workspace().toasts.erase(toasts.begin() + static_cast<std::ptrdiff_t>(*closed));
}

}  // namespace lutka::editor
