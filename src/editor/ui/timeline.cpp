/// The strip below the view with the file's clips: which one, playing, scrubbing, looping, and falling from there.

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "animation/clip_reference.hpp"
#include "editor/ui/clip_list.hpp"
#include "editor/ui/panels.hpp"
#include "editor/ui/side_panels.hpp"
#include "editor/ui/style.hpp"
#include "editor/ui/widgets.hpp"

namespace lutka::editor {
namespace {

void chooseClip(const PanelContext& context) {
    Editor& editor = context.editor;
    const ClipStage* shown = editor.player().clip();
    std::string chosen;
    const auto& clips = editor.document().character().clips;
    const std::string preview = shown != nullptr ? shownClip(clips, shown->clip()) : "choose a clip";
    ImGui::SetNextItemWidth(context.px(170));
    if (!beginClipCombo("##clip", preview)) return;
    for (std::size_t i = 0; i < clips.size(); ++i) {
        const std::string reference = animation::clipReference(clips, i);
        const std::string line =
            fmt::format("{}  {:.1f} s##{}", animation::clipLabel(clips, i), clips[i].seconds(), reference);
        if (ImGui::Selectable(line.c_str(), shown != nullptr && shown->clip() == reference)) chosen = reference;
    }
    ImGui::EndCombo();
    if (!chosen.empty()) editor.showClip(chosen);
}

void scrub(const PanelContext& context, const ClipStage& shown, float width) {
    Player& player = context.editor.player();
    float seconds = shown.seconds();
    ImGui::SetNextItemWidth(width);
    const std::string format = fmt::format("%.2f of {:.2f} s", shown.length());
    if (slider("##seconds", seconds, 0.0F, std::max(shown.length(), 0.01F), format.c_str())) {
        player.setPlaying(false);
        player.seekClip(seconds);
    }
    tooltip("Space plays it, the right arrow shows it step by step");
}

void drawPlay(const PanelContext& context) {
    Editor& editor = context.editor;
    ImGui::SameLine();
    if (ImGui::Button(editor.player().playing() ? "Pause" : "Play", {context.px(56), 0}))
        editor.perform(Action::togglePlay);
    tooltip("Space");
    ImGui::SameLine();
    bool loop = editor.player().clip()->loop;
    if (ImGui::Checkbox("Loop", &loop)) editor.player().setClipLoop(loop);
}

// The rest of the line but for so much.
void drawScrub(const PanelContext& context, float room) {
    Editor& editor = context.editor;
    const float fall = context.px(112);
    const float space = ImGui::GetStyle().ItemSpacing.x;
    scrub(context, *editor.player().clip(), ImGui::GetContentRegionAvail().x - fall - space - room);
    ImGui::SameLine();
    if (ImGui::Button("Fall from here", {fall, 0})) editor.perform(Action::fallFromClip);
    tooltip(
        "Physics goes on from this pose, with the velocities that the clip has here. A drag on the doll does the same");
}

}  // namespace

void drawTimeline(const PanelContext& context) {
    Editor& editor = context.editor;
    const auto [left, right] = viewSpan(context);
    const float most = context.px(760);
    const float width = std::min(right - left - context.px(16), most);
    if (width < context.px(290)) return;
    const bool narrow = width < context.px(520);
    const float bottom = ImGui::GetIO().DisplaySize.y - statusHeight() - panelBelowHeight(context) - context.px(8);
    ImGui::SetNextWindowPos({(left + right) * 0.5F, bottom}, ImGuiCond_Always, {0.5F, 1.0F});
    ImGui::SetNextWindowSize({width, 0.0F});
    ImGui::SetNextWindowBgAlpha(0.92F);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(context.px(6), context.px(5)));
    ImGui::Begin("##timeline", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoFocusOnAppearing);
    if (editor.document().character().clips.empty()) {
        ImGui::AlignTextToFramePadding();
        ImGui::TextColored(mutedColor(), "This file has no clips");
        ImGui::SameLine(width - context.px(32));
    } else {
        chooseClip(context);
        if (editor.player().clip() != nullptr) drawPlay(context);
        if (editor.player().clip() != nullptr && !narrow) {
            ImGui::SameLine();
            drawScrub(context, context.px(26) + ImGui::GetStyle().ItemSpacing.x);
        }
        ImGui::SameLine(width - context.px(32));
    }
    if (ImGui::Button("×", {context.px(26), 0})) editor.perform(Action::toggleClips);
    tooltip("F4: away with the clips; the doll goes back to where it was");
    if (editor.view.clips && editor.player().clip() != nullptr && narrow) drawScrub(context, 0.0F);
    context.state.timelineTop = ImGui::GetWindowPos().y;
    ImGui::End();
    ImGui::PopStyleVar();
}

}  // namespace lutka::editor
