#include "editor/ui/clip_list.hpp"

#include <imgui.h>

#include "animation/clip_reference.hpp"
#include "editor/ui/widgets.hpp"

namespace lutka::editor {

bool beginClipCombo(const char* id, const std::string& preview) {
    const float room = ImGui::CalcItemWidth() - ImGui::GetFrameHeight() - 2.0F * ImGui::GetStyle().FramePadding.x;
    const std::string shown = nameWithin(preview, room);
    const bool open = ImGui::BeginCombo(id, shown.c_str(), ImGuiComboFlags_HeightLarge);
    if (!open && shown != preview) tooltip(preview);
    return open;
}

std::optional<std::string> chooseListedClip(std::span<const animation::Clip> clips, const std::string& present,
                                            const char* before) {
    std::optional<std::string> chosen;
    const int meant = animation::clipMeant(clips, present);
    for (std::size_t i = 0; i < clips.size(); ++i) {
        const std::string reference = animation::clipReference(clips, i);
        const std::string line = before + animation::clipLabel(clips, i) + "##" + reference;
        if (ImGui::Selectable(line.c_str(), static_cast<int>(i) == meant)) chosen = reference;
    }
    return chosen;
}

std::string shownClip(std::span<const animation::Clip> clips, const std::string& present) {
    const int meant = animation::clipMeant(clips, present);
    return meant >= 0 ? animation::clipLabel(clips, static_cast<std::size_t>(meant)) : present;
}

}  // namespace lutka::editor
