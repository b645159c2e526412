/// The window of recent models, each with its picture.

#include "editor/ui/gallery.hpp"

#include <imgui.h>

#include <algorithm>
#include <cstdint>

#include "editor/files/file_list.hpp"
#include "editor/files/model_pictures.hpp"
#include "editor/ui/panels.hpp"
#include "editor/ui/style.hpp"
#include "editor/ui/widgets.hpp"

namespace lutka::editor {
namespace {

// Whether it was chosen.
bool modelCard(const PanelContext& context, const std::filesystem::path& model, const ImVec2& size) {
    std::error_code failed;
    const bool there = std::filesystem::exists(model, failed);
    const std::filesystem::path file = modelPictureFile(context.state.pictureFolder, model);
    const render::ShownPicture* picture = context.state.pictures.find(file);
    ImGui::BeginGroup();
    ImGui::BeginDisabled(!there);
    bool chosen = false;
    if (picture != nullptr) {
        const auto texture = static_cast<std::uintptr_t>(picture->texture());
        // NOLINTNEXTLINE(performance-no-int-to-ptr): Dear ImGui's own convention
        chosen = ImGui::ImageButton(reinterpret_cast<ImTextureID>(texture), size, {0, 0}, {1, 1}, 2);
    } else {
        chosen = ImGui::Button(there ? "no picture yet" : "not there any more", {size.x + 4, size.y + 4});
    }
    ImGui::EndDisabled();
    tooltip(readablePath(model));
    const std::string name = nameAmong(context.state.recent, model);
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + size.x);
    ImGui::TextUnformatted(name.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndGroup();
    return chosen;
}

}  // namespace

const render::ShownPicture* PictureShelf::find(const std::filesystem::path& file) {
    const auto known = pictures_.find(file);
    if (known != pictures_.end()) return known->second ? &*known->second : nullptr;
    const auto image = render::loadPng(file);
    auto& picture = pictures_[file];
    if (image) picture.emplace(image.value());
    return picture ? &*picture : nullptr;
}

void drawGallery(const PanelContext& context) {
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    const auto [left, right] = viewSpan(context);
    const ImVec2 card(context.px(160), context.px(100));
    const float room = std::max(right - left, context.px(400)) * 0.9F;
    ImGui::SetNextWindowPos({(left + right) * 0.5F, window.y * 0.45F}, ImGuiCond_Always, {0.5F, 0.5F});
    ImGui::SetNextWindowSize({std::min(room, context.px(720)), window.y * 0.7F});
    bool open = !ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false);
    std::optional<std::filesystem::path> chosen;
    if (ImGui::Begin("Recent files", &open,
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                         ImGuiWindowFlags_NoCollapse)) {
        const float width = card.x + context.px(18);
        const int columns = std::max(static_cast<int>(ImGui::GetContentRegionAvail().x / width), 1);
        int index = 0;
        for (const std::filesystem::path& model : context.state.recent) {
            if (index++ % columns != 0) ImGui::SameLine();
            ImGui::PushID(index);
            if (modelCard(context, model, card)) chosen = model;
            ImGui::PopID();
        }
        if (context.state.recent.empty()) mutedText("Models and scenes that you open are listed here.");
    }
    ImGui::End();
    context.editor.view.gallery = open && !chosen;
    if (chosen) context.editor.open(*chosen);
}

}  // namespace lutka::editor
