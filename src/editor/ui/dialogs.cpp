#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <functional>

#include "editor/ui/panels.hpp"
#include "editor/ui/style.hpp"
#include "editor/ui/widgets.hpp"

namespace lutka::editor {
namespace {

constexpr ImGuiWindowFlags kDialog = ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings |
                                     ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize;

constexpr float kMiddle = 0.45F;  // of the window's height

void placeInMiddle() {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({size.x * 0.5F, size.y * kMiddle}, ImGuiCond_Always, {0.5F, 0.5F});
}

// Whether a key answers the question whose window is drawn now. The key that brought the question up is none for it.
bool answersBy(Key key) {
    return ImGui::IsKeyPressed(static_cast<int>(key), false) && !ImGui::IsWindowAppearing();
}

void drawQuestion(const PanelContext& context) {
    constexpr const char* title = "Unsaved changes";
    Editor& editor = context.editor;
    if (editor.files().askingUnsaved() && !ImGui::IsPopupOpen(title)) ImGui::OpenPopup(title);
    placeInMiddle();
    if (!ImGui::BeginPopupModal(title, nullptr, kDialog)) return;
    const EditorDocument& document = editor.document();
    if (document.unsaved()) {
        ImGui::Text("The ragdoll of %s has changes that are not saved.", document.character().name.c_str());
        mutedText("Save writes " + document.profileFile().string());
    }
    if (document.sceneDocument().unsaved()) {
        ImGui::Text("The scene %s has changes that are not saved.", document.scene().name.c_str());
        mutedText("Save writes " + document.sceneDocument().file().string());
    }
    if (editor.files().askingTakes()) {
        for (const Take& take : editor.player().deck().takes()) {
            if (!take.saved) ImGui::Text("%s (%.1f s) is in no file.", take.name.c_str(), take.seconds());
        }
        mutedText("Save writes such takes beside the model.");
    }
    ImGui::Spacing();
    const ImVec2 button(context.px(110), 0);
    std::optional<FileFlow::Answer> answer;
    if (ImGui::Button("Save", button) || answersBy(Key::enter)) answer = FileFlow::Answer::save;
    ImGui::SameLine();
    if (ImGui::Button("Discard", button)) answer = FileFlow::Answer::discard;
    ImGui::SameLine();
    if (ImGui::Button("Cancel", button) || answersBy(Key::escape)) answer = FileFlow::Answer::cancel;
    if (answer) {
        ImGui::CloseCurrentPopup();
        editor.files().answer(*answer);
    }
    ImGui::EndPopup();
}

void drawReplaceQuestion(const PanelContext& context) {
    constexpr const char* title = "Replace the file?";
    Editor& editor = context.editor;
    const std::filesystem::path file = editor.files().replacedFile();
    if (!file.empty() && !ImGui::IsPopupOpen(title)) ImGui::OpenPopup(title);
    placeInMiddle();
    if (!ImGui::BeginPopupModal(title, nullptr, kDialog)) return;
    ImGui::Text("%s is there already.", file.filename().string().c_str());
    mutedText("In " + file.parent_path().string() + ". It was neither opened nor saved in this session.");
    ImGui::Spacing();
    const ImVec2 button(context.px(110), 0);
    std::optional<bool> replace;
    if (ImGui::Button("Replace", button)) replace = true;
    ImGui::SameLine();
    if (ImGui::Button("Cancel", button) || answersBy(Key::escape)) replace = false;
    ImGui::SameLine();
    if (ImGui::Button("Save as ...", button)) {
        replace = false;
        editor.dialog = Editor::Dialog::saveAs;
    }
    if (replace) {
        ImGui::CloseCurrentPopup();
        editor.files().answerReplace(*replace);
    }
    ImGui::EndPopup();
}

// How many lines it showed.
int helpRow(const std::string& filter, const std::string& keys, std::string_view what) {
    if (!containsText(what, filter) && !containsText(keys, filter)) return 0;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextColored(accentColor(), "%s", keys.c_str());
    ImGui::TableNextColumn();
    ImGui::PushTextWrapPos(0.0F);
    ImGui::TextUnformatted(what.data(), what.data() + what.size());
    ImGui::PopTextWrapPos();
    return 1;
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
    drawReplaceQuestion(context);
}

namespace {

// Work of a session that ended by force. Before it is answered nothing else is asked.
void drawRecoveryOffer(const PanelContext& context) {
    Editor& editor = context.editor;
    const RecoveryCopy copy = *editor.recovery().offered();
    const auto [left, right] = viewSpan(context);
    const float top = ImGui::GetFrameHeight() + context.px(56);
    ImGui::SetNextWindowPos({(left + right) * 0.5F, top}, ImGuiCond_Always, {0.5F, 0.0F});
    ImGui::SetNextWindowBgAlpha(0.94F);
    ImGui::PushStyleColor(ImGuiCol_Border, warningColor());
    ImGui::Begin("##recovery", nullptr, kDialog | ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::PushTextWrapPos((right - left) * 0.9F);
    ImGui::Text("Unsaved work of %s was found:", copy.when.c_str());
    ImGui::TextUnformatted((copy.contents() + ".").c_str());
    mutedText("That session ended without saving it. " + copy.model.string());
    ImGui::PopTextWrapPos();
    std::optional<RecoveryDesk::Answer> answer;
    if (ImGui::Button("Restore it")) answer = RecoveryDesk::Answer::restore;
    ImGui::SameLine();
    if (ImGui::Button("Later")) answer = RecoveryDesk::Answer::later;
    tooltip("It is offered again at the next start");
    ImGui::SameLine();
    if (ImGui::Button("Throw it away")) answer = RecoveryDesk::Answer::remove;
    ImGui::End();
    ImGui::PopStyleColor();
    if (answer) editor.answerRecovery(*answer);
}

// The scene was saved and the ragdoll has changes, or the other way round.
void drawSaveOffer(const PanelContext& context) {
    FileFlow& files = context.editor.files();
    const EditorDocument& document = context.editor.document();
    const bool profile = files.offeredSave() == FileFlow::OfferedSave::profile;
    if (profile ? !document.unsaved() : !document.sceneDocument().unsaved()) return files.answerOfferedSave(false);
    const auto [left, right] = viewSpan(context);
    const float top = ImGui::GetFrameHeight() + context.px(56);
    ImGui::SetNextWindowPos({(left + right) * 0.5F, top}, ImGuiCond_Always, {0.5F, 0.0F});
    ImGui::SetNextWindowBgAlpha(0.94F);
    ImGui::PushStyleColor(ImGuiCol_Border, accentColor());
    ImGui::Begin("##saveOffer", nullptr, kDialog | ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::TextUnformatted(profile ? "The ragdoll of the scene has unsaved changes."
                                   : "The scene does not name what was saved yet.");
    mutedText((profile ? document.profileFile() : document.sceneDocument().file()).filename().string());
    std::optional<bool> save;
    if (ImGui::Button(profile ? "Save the ragdoll too" : "Save the scene too")) save = true;
    ImGui::SameLine();
    if (ImGui::Button("Not now")) save = false;
    ImGui::End();
    ImGui::PopStyleColor();
    if (save) files.answerOfferedSave(*save);
}

}  // namespace

void drawOffer(const PanelContext& context) {
    Editor& editor = context.editor;
    if (editor.recovery().offered() != nullptr) return drawRecoveryOffer(context);
    if (editor.files().offeredSave() != FileFlow::OfferedSave::none) return drawSaveOffer(context);
    const std::filesystem::path file = editor.files().offeredProfile();
    if (file.empty()) return;
    const auto [left, right] = viewSpan(context);
    const float top = ImGui::GetFrameHeight() + context.px(56);
    ImGui::SetNextWindowPos({(left + right) * 0.5F, top}, ImGuiCond_Always, {0.5F, 0.0F});
    ImGui::SetNextWindowBgAlpha(0.94F);
    ImGui::PushStyleColor(ImGuiCol_Border, accentColor());
    ImGui::Begin("##offer", nullptr, kDialog | ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::PushTextWrapPos((right - left) * 0.9F);
    ImGui::Text("A profile lies beside the model: %s", file.filename().string().c_str());
    ImGui::PopTextWrapPos();
    std::optional<bool> take;
    if (ImGui::Button("Open it")) take = true;
    ImGui::SameLine();
    if (ImGui::Button("Keep the new fit")) take = false;
    ImGui::End();
    ImGui::PopStyleColor();
    if (take) editor.answerOffer(*take);
}

// Its keys are the view's (Editor::handle()): it is no popup, and the view goes on below it.
void drawAnyRigOffer(const PanelContext& context) {
    Editor& editor = context.editor;
    context.state.offerBottom = 0.0F;
    const FileFlow::AnyRigOffer& offer = editor.files().offeredAnyRig();
    if (offer.model.empty()) return;
    placeInMiddle();
    std::optional<Editor::AnyRig> answer;
    if (ImGui::Begin("Not a human figure", nullptr, kDialog | ImGuiWindowFlags_NoCollapse)) {
        ImGui::PushTextWrapPos(std::min(context.px(440), ImGui::GetIO().DisplaySize.x * 0.9F));
        const std::string file = offer.model.filename().string();
        const std::string verb = offer.reason.starts_with("not a humanoid") ? " is " : ": ";
        ImGui::TextUnformatted((file + verb + offer.reason + ".").c_str());
        ImGui::Spacing();
        ImGui::TextUnformatted("Its bodies can be made from the joints and the skin alone, whatever it is.");
        if (!offer.profile.empty())
            ImGui::TextUnformatted(
                (offer.profile.filename().string() + " is a human figure's and is left out.").c_str());
        ImGui::PopTextWrapPos();
        ImGui::Spacing();
        if (ImGui::Button("Ragdoll of any skeleton")) answer = Editor::AnyRig::whole;
        tooltip("Enter");
        ImGui::SameLine();
        if (ImGui::Button("By hand")) answer = Editor::AnyRig::byHand;
        tooltip("Begins with one body for all; you add the others");
        ImGui::SameLine();
        if (ImGui::Button("Leave it")) answer = Editor::AnyRig::leave;
        tooltip("Esc");
        context.state.offerBottom = ImGui::GetWindowPos().y + ImGui::GetWindowHeight();
    }
    ImGui::End();
    if (answer) editor.answerAnyRig(*answer);
}

void drawHelp(const PanelContext& context) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    placeInMiddle();
    const float width = std::min(context.px(900), size.x - 20);
    // Below the menu bar, about the middle that dialogs have.
    const float height = 2.0F * (size.y * kMiddle - ImGui::GetFrameHeight() - context.px(4));
    ImGui::SetNextWindowSizeConstraints({width, 0}, {width, height});
    bool open = true;
    std::string& filter = context.state.helpFilter;
    if (ImGui::Begin("Keys", &open, kDialog | ImGuiWindowFlags_NoCollapse)) {
        ImGui::SetNextItemWidth(-1.0F);
        if (ImGui::IsWindowAppearing()) filter.clear();
        ImGui::InputTextWithHint("##search", "search: undo, camera, limits …", &filter);
        int found = 0;
        if (ImGui::BeginTable("##help", width > context.px(640) ? 2 : 1, ImGuiTableFlags_SizingStretchSame)) {
            ImGui::TableNextColumn();
            if (beginHelpTable(context, "##actions", 100)) {
                for (const Binding& binding : keyBindings())
                    found += helpRow(filter, shortcutText(binding), actionName(binding.action));
                ImGui::EndTable();
            }
            ImGui::TableNextColumn();
            if (beginHelpTable(context, "##mouse", 160)) {
                for (const HelpLine& line : mouseHelp())
                    found += helpRow(filter, std::string(line.keys), line.what);
                ImGui::EndTable();
            }
            ImGui::EndTable();
        }
        if (found == 0) mutedText("Nothing is called that. Try another word, or empty the field to see all.");
    }
    ImGui::End();
    context.editor.view.help = open;
}

namespace {

float toastHeight(const std::string& text, float width) {
    return ImGui::CalcTextSize(text.c_str(), nullptr, false, width).y + 2.0F * ImGui::GetStyle().WindowPadding.y;
}

// As much of it as has room in a few lines, with a word on where the rest is.
std::string toastText(const std::string& text, float width) {
    constexpr float most = 6.0F;  // lines
    const auto isShort = [&](const std::string& shown) {
        return ImGui::CalcTextSize(shown.c_str(), nullptr, false, width).y <= most * ImGui::GetTextLineHeight() + 0.5F;
    };
    if (isShort(text)) return text;
    constexpr const char* rest = " … (all of it in the tab Log)";
    std::size_t end = text.size();
    do {
        end = text.find_last_of(' ', end - 1);
    } while (end != std::string::npos && end > 0 && !isShort(text.substr(0, end) + rest));
    return end == std::string::npos ? text : text.substr(0, end) + rest;
}

// The first of the toasts that are shown: older ones give way where there is no room below an offer for all.
std::size_t firstToast(const PanelContext& context, const std::vector<Toast>& toasts, float width, float bottom) {
    const float gap = context.px(6);
    const float top = std::max(context.state.offerBottom, context.state.transportBottom) + gap;
    std::size_t first = toasts.size();
    for (float used = 0.0F; first > 0; --first) {
        used += toastHeight(toastText(toasts[first - 1].text, width), width) + gap;
        // The latest is told in any case.
        if (first < toasts.size() && bottom - used < top) break;
    }
    return first;
}

}  // namespace

void drawToasts(const PanelContext& context) {
    Editor& editor = context.editor;
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const auto [left, right] = viewSpan(context);
    const float middle = (left + right) * 0.5F;
    const float width = std::min(context.px(460), (right - left) * 0.9F);
    // Over neither the panel below the view nor the timeline.
    const float below = size.y - ImGui::GetFrameHeight() - panelBelowHeight(context) - context.px(16);
    float bottom = context.state.timelineTop > 0.0F ? context.state.timelineTop - context.px(6) : below;
    std::optional<std::size_t> closed;
    const std::vector<Toast>& toasts = editor.workspace().toasts;
    for (std::size_t i = firstToast(context, toasts, width, bottom); i < toasts.size(); ++i) {
        const Toast& toast = toasts[i];
        ImGui::SetNextWindowPos({middle, bottom}, ImGuiCond_Always, {0.5F, 1.0F});
        ImGui::SetNextWindowBgAlpha(0.94F);
        const ImVec4 color = toast.kind == Toast::Kind::error     ? errorColor()
                             : toast.kind == Toast::Kind::warning ? warningColor()
                                                                  : goodColor();
        ImGui::PushStyleColor(ImGuiCol_Border, color);
        // A window of its own for each text, or it would have the size of the one before.
        ImGui::Begin(fmt::format("##toast{}", std::hash<std::string>{}(toast.text)).c_str(), nullptr,
                     kDialog | ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoFocusOnAppearing);
        ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + width);
        ImGui::TextUnformatted(toastText(toast.text, width).c_str());
        ImGui::PopTextWrapPos();
        if (ImGui::IsWindowHovered() && ImGui::IsMouseClicked(ImGuiMouseButton_Left)) closed = i;
        bottom -= ImGui::GetWindowHeight() + context.px(6);
        ImGui::End();
        ImGui::PopStyleColor();
    }
    if (closed) editor.workspace().toasts.erase(toasts.begin() + static_cast<std::ptrdiff_t>(*closed));
}

}  // namespace lutka::editor
