/// Open, save as and export: a path, the folder it lies in, and what can be chosen there by mouse or keyboard.

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>

#include "core/letter_case.hpp"
#include "editor/files/file_list.hpp"
#include "editor/ui/panels.hpp"
#include "editor/ui/style.hpp"
#include "editor/ui/widgets.hpp"
#include "scene/description/scene_file.hpp"

namespace lutka::editor {
namespace {

namespace fs = std::filesystem;

// The path is chosen whole, each time the dialog opens: what is typed or pasted takes its place.
constexpr ImGuiInputTextFlags kPathFlags = ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll;
constexpr ImGuiWindowFlags kFileDialog = ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings |
                                         ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize;

bool opens(Editor::Dialog dialog) {
    return dialog == Editor::Dialog::openModel || dialog == Editor::Dialog::openRecording ||
           dialog == Editor::Dialog::chooseModel || dialog == Editor::Dialog::chooseProfile ||
           dialog == Editor::Dialog::chooseSky;
}

const exporting::ExportFormatInfo& formatIn(const UiState& state) {
    return exporting::exportFormats()[static_cast<std::size_t>(state.exportFormat)];
}

fs::path suggestedPath(const PanelContext& context, Editor::Dialog dialog) {
    const EditorDocument& document = context.editor.document();
    std::error_code failed;
    switch (dialog) {
        case Editor::Dialog::saveAs:
            return fs::absolute(document.profileFile(), failed);
        case Editor::Dialog::exportBaked:
            return fs::absolute(document.profileFile().parent_path() / (document.character().name + "_fall.glb"),
                                failed);
        case Editor::Dialog::exportRagdoll:
            return fs::absolute(document.profileFile().parent_path() / (document.character().name + "_ragdoll" +
                                                                        std::string(formatIn(context.state).ending)),
                                failed);
        case Editor::Dialog::saveSceneAs:
            return fs::absolute(document.sceneDocument().file(), failed);
        case Editor::Dialog::saveRecording:
            return fs::absolute(context.editor.files().takeFile(context.editor.player().deck().currentName()), failed);
        case Editor::Dialog::openRecording:
        case Editor::Dialog::openModel:
        case Editor::Dialog::chooseModel:
        case Editor::Dialog::chooseProfile:
        case Editor::Dialog::chooseSky:
        case Editor::Dialog::none:
            break;
    }
    return fs::absolute(document.character().file, failed).parent_path() / "";
}

const char* titleOf(Editor::Dialog dialog) {
    switch (dialog) {
        case Editor::Dialog::openModel:
            return "Open a model, a profile or a scene";
        case Editor::Dialog::saveAs:
            return "Save the profile as";
        case Editor::Dialog::exportBaked:
            return "Export the fall as a baked glb";
        case Editor::Dialog::exportRagdoll:
            return "Export the ragdoll for an engine";
        case Editor::Dialog::saveSceneAs:
            return "Save the scene as";
        case Editor::Dialog::saveRecording:
            return "Save the recording as";
        case Editor::Dialog::openRecording:
            return "Open a recording";
        case Editor::Dialog::chooseModel:
            return "Choose the model";
        case Editor::Dialog::chooseProfile:
            return "Choose the profile";
        case Editor::Dialog::chooseSky:
            return "Choose a panorama for the light";
        case Editor::Dialog::none:
            break;
    }
    return "";
}

FileFilter filterOf(Editor::Dialog dialog) {
    switch (dialog) {
        case Editor::Dialog::saveAs:
        case Editor::Dialog::saveSceneAs:
        case Editor::Dialog::chooseProfile:
            return FileFilter::profiles;
        case Editor::Dialog::saveRecording:
        case Editor::Dialog::openRecording:
            return FileFilter::recordings;
        case Editor::Dialog::exportBaked:
            return FileFilter::baked;
        case Editor::Dialog::exportRagdoll:
            return FileFilter::all;
        case Editor::Dialog::chooseSky:
            return FileFilter::skies;
        case Editor::Dialog::openModel:
        case Editor::Dialog::chooseModel:
        case Editor::Dialog::none:
            break;
    }
    return FileFilter::models;
}

// The folder that is shown: the typed one, or that of the typed file.
fs::path folderOf(const std::string& typed) {
    std::error_code failed;
    fs::path path(typed);
    if (fs::is_directory(path, failed)) return path;
    return path.parent_path().empty() ? fs::path(".") : path.parent_path();
}

void goTo(UiState& state, const fs::path& folder) {
    std::error_code failed;
    const fs::path file = fs::is_directory(fs::path(state.path), failed) ? fs::path() : fs::path(state.path).filename();
    state.path = (folder.lexically_normal() / (opens(state.fileDialog) ? fs::path() : file)).string();
    state.fileIndex = -1;
}

// The folders above, each a button.
void drawCrumbs(const PanelContext& context, const fs::path& folder) {
    std::vector<fs::path> crumbs;
    for (fs::path at = folder.lexically_normal(); !at.empty(); at = at.parent_path()) {
        if (!at.filename().empty() || at == at.root_path()) crumbs.push_back(at);
        if (at == at.parent_path()) break;
    }
    std::reverse(crumbs.begin(), crumbs.end());
    constexpr std::size_t most = 5;
    const std::size_t first = crumbs.size() > most ? crumbs.size() - most : 0;
    for (std::size_t i = first; i < crumbs.size(); ++i) {
        if (i > first) ImGui::SameLine(0.0F, context.px(3));
        const std::string name = crumbs[i].filename().empty() ? "/" : crumbs[i].filename().string();
        ImGui::PushID(static_cast<int>(i));
        if (ImGui::SmallButton(name.c_str())) goTo(context.state, crumbs[i]);
        tooltip(readablePath(crumbs[i]));
        ImGui::PopID();
    }
}

// The arrows choose, without taking the keyboard from the field.
void moveByKeys(UiState& state, const std::vector<FileEntry>& entries, const fs::path& folder) {
    const int count = static_cast<int>(entries.size());
    int wanted = state.fileIndex;
    if (ImGui::IsKeyPressed(static_cast<int>(Key::down))) ++wanted;
    if (ImGui::IsKeyPressed(static_cast<int>(Key::up))) --wanted;
    if (ImGui::IsKeyPressed(static_cast<int>(Key::pageDown))) wanted += 10;
    if (ImGui::IsKeyPressed(static_cast<int>(Key::pageUp))) wanted -= 10;
    wanted = std::clamp(wanted, -1, count - 1);
    if (wanted == state.fileIndex || wanted < 0) return;
    state.fileIndex = wanted;
    state.chosen = folder / entries[wanted].name;
    state.scrollToFile = true;
}

// Whether a file was chosen for good (double click).
bool drawList(const PanelContext& context, const fs::path& folder) {
    UiState& state = context.state;
    const std::vector<FileEntry> entries = listFolder(folder, state.fileFilter);
    moveByKeys(state, entries, folder);
    bool done = false;
    ImGui::BeginChild("##folder", {context.px(520), context.px(240)}, true);
    if (entries.empty()) mutedText("Nothing of that kind is here. Choose another folder, or show all files below.");
    for (int i = 0; i < static_cast<int>(entries.size()); ++i) {
        const FileEntry& entry = entries[i];
        const std::string name = entry.name + (entry.folder ? "/" : "");
        if (ImGui::Selectable(name.c_str(), i == state.fileIndex, ImGuiSelectableFlags_AllowDoubleClick)) {
            state.chosen.clear();
            if (entry.folder) {
                goTo(state, folder / entry.name);
            } else {
                state.path = (folder / entry.name).string();
                state.fileIndex = i;
                done = ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
            }
        }
        if (i == state.fileIndex && state.scrollToFile) ImGui::SetScrollHereY();
    }
    state.scrollToFile = false;
    ImGui::EndChild();
    return done;
}

void drawNewFolder(const PanelContext& context, const fs::path& folder) {
    UiState& state = context.state;
    if (ImGui::Button("New folder")) ImGui::OpenPopup("##newFolder");
    if (!ImGui::BeginPopup("##newFolder")) return;
    if (ImGui::IsWindowAppearing()) {
        state.newFolder.clear();
        ImGui::SetKeyboardFocusHere();
    }
    const bool named =
        ImGui::InputTextWithHint("##name", "its name", &state.newFolder, ImGuiInputTextFlags_EnterReturnsTrue);
    ImGui::SameLine();
    if ((ImGui::Button("Make") || named) && !state.newFolder.empty()) {
        std::error_code failed;
        fs::create_directories(folder / state.newFolder, failed);
        if (failed) {
            context.editor.workspace().say(Toast::Kind::error,
                                           (folder / state.newFolder).string() + ": " + failed.message());
        } else {
            goTo(state, folder / state.newFolder);
        }
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
}

// Of the character whose field asked for it.
void setCharacterFile(const PanelContext& context, Editor::Dialog dialog, const fs::path& file) {
    const scene::EntityId id = std::exchange(context.state.browsing, scene::kNoEntity);
    if (context.editor.document().scene().find<scene::Ragdoll>(id) == nullptr) return;
    const bool model = dialog == Editor::Dialog::chooseModel;
    context.editor.editScene(model ? "Ragdoll: Model" : "Ragdoll: Profile", "", [&](scene::EntityScene& scene) {
        auto& ragdoll = *scene.find<scene::Ragdoll>(id);
        (model ? ragdoll.model : ragdoll.profile) = file;
    });
}

void finish(const PanelContext& context, Editor::Dialog dialog) {
    Editor& editor = context.editor;
    fs::path file(context.state.path);
    if (!file.has_extension() && dialog == Editor::Dialog::saveAs) file += ".ragdoll.json";
    if (!file.has_extension() && dialog == Editor::Dialog::exportBaked) file += ".glb";
    if (!file.has_extension() && dialog == Editor::Dialog::exportRagdoll) file += formatIn(context.state).ending;
    if (!scene::isSceneFile(file) && dialog == Editor::Dialog::saveSceneAs) file += ".scene.json";
    switch (dialog) {
        case Editor::Dialog::openModel:
            editor.open(file);
            break;
        case Editor::Dialog::saveAs:
            editor.files().requestSave(file);
            break;
        case Editor::Dialog::exportBaked:
            editor.files().requestExport(file, context.state.exportSeconds);
            break;
        case Editor::Dialog::exportRagdoll:
            editor.files().requestExport(file, formatIn(context.state).format);
            break;
        case Editor::Dialog::saveSceneAs:
            editor.files().requestSaveScene(file);
            break;
        case Editor::Dialog::saveRecording:
            editor.files().requestSaveRecording(file);
            break;
        case Editor::Dialog::openRecording:
            editor.workspace().report(editor.player().openRecording(file));
            break;
        case Editor::Dialog::chooseModel:
        case Editor::Dialog::chooseProfile:
            setCharacterFile(context, dialog, file);
            break;
        case Editor::Dialog::chooseSky:
            editor.view.sky = file;
            break;
        case Editor::Dialog::none:
            break;
    }
}

void begin(const PanelContext& context) {
    UiState& state = context.state;
    state.fileDialog = context.editor.dialog;
    state.path = suggestedPath(context, state.fileDialog).string();
    state.fileFilter = filterOf(state.fileDialog);
    state.fileIndex = -1;
    state.chosen.clear();
}

// What Enter does: a folder is entered, a file is the answer.
bool enter(UiState& state) {
    if (!state.chosen.empty()) state.path = state.chosen.string();
    state.chosen.clear();
    std::error_code failed;
    if (!fs::is_directory(fs::path(state.path), failed)) return true;
    goTo(state, state.path);
    return false;
}

// The file's ending follows the format.
void drawFormat(const PanelContext& context) {
    UiState& state = context.state;
    const auto formats = exporting::exportFormats();
    const auto line = [](const exporting::ExportFormatInfo& info) {
        return fmt::format("{} ({}): {}", info.name, info.ending, info.summary);
    };
    ImGui::SetNextItemWidth(context.px(520));
    if (!ImGui::BeginCombo("##format", line(formatIn(state)).c_str(), ImGuiComboFlags_HeightLarge)) return;
    for (std::size_t i = 0; i < formats.size(); ++i) {
        if (!ImGui::Selectable(line(formats[i]).c_str(), static_cast<int>(i) == state.exportFormat)) continue;
        fs::path file(state.path);
        if (file.has_filename() && sameButCase(file.extension().string(), formatIn(state).ending))
            state.path = file.replace_extension(formats[i].ending).string();
        state.exportFormat = static_cast<int>(i);
    }
    ImGui::EndCombo();
}

void drawFilter(UiState& state) {
    constexpr FileFilter filters[] = {FileFilter::models, FileFilter::profiles,   FileFilter::baked,
                                      FileFilter::skies,  FileFilter::recordings, FileFilter::all};
    if (!ImGui::BeginCombo("##filter", filterName(state.fileFilter))) return;
    for (const FileFilter filter : filters) {
        if (ImGui::Selectable(filterName(filter), filter == state.fileFilter)) {
            state.fileFilter = filter;
            state.fileIndex = -1;
        }
    }
    ImGui::EndCombo();
}

}  // namespace

void drawFileDialog(const PanelContext& context) {
    Editor& editor = context.editor;
    UiState& state = context.state;
    if (editor.dialog == Editor::Dialog::none) return;
    const char* title = titleOf(editor.dialog);
    if (!ImGui::IsPopupOpen(title)) {
        begin(context);
        ImGui::OpenPopup(title);
    }
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({size.x * 0.5F, size.y * 0.45F}, ImGuiCond_Always, {0.5F, 0.5F});
    if (!ImGui::BeginPopupModal(title, nullptr, kFileDialog)) return;
    const fs::path folder = folderOf(state.path);
    drawCrumbs(context, folder);
    ImGui::SetNextItemWidth(context.px(520));
    if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
    bool done = ImGui::InputText("##path", &state.path, kPathFlags) && enter(state);
    done = drawList(context, folder) || done;
    ImGui::SetNextItemWidth(context.px(220));
    drawFilter(state);
    if (!opens(editor.dialog)) {
        ImGui::SameLine();
        drawNewFolder(context, folder);
    }
    if (editor.dialog == Editor::Dialog::exportBaked) {
        ImGui::SetNextItemWidth(context.px(220));
        static_cast<void>(slider("##seconds", state.exportSeconds, 0.5F, 20.0F, "%.1f seconds"));
        mutedText("The first doll's motion from the start of the scene, as an animation of its skin.");
    }
    if (editor.dialog == Editor::Dialog::exportRagdoll) {
        drawFormat(context);
        mutedText("Bodies, joints and limits as they are edited. What the format can't hold is told in the log.");
    }
    ImGui::Spacing();
    const ImVec2 button(context.px(110), 0);
    if (ImGui::Button(opens(editor.dialog) ? "Open" : "Save", button)) done = enter(state);
    ImGui::SameLine();
    const bool escape = ImGui::IsKeyPressed(static_cast<int>(Key::escape), false) && !state.escapeTaken;
    const bool cancelled = ImGui::Button("Cancel", button) || escape;
    if (done || cancelled) {
        const Editor::Dialog dialog = std::exchange(editor.dialog, Editor::Dialog::none);
        ImGui::CloseCurrentPopup();
        if (done && !cancelled) finish(context, dialog);
    }
    ImGui::EndPopup();
}

}  // namespace lutka::editor
