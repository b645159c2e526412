/// The Physics tab's muscles: what the characters follow, how strongly, and what is shown of it.

#include <imgui.h>

#include <algorithm>
#include <optional>
#include <string>

#include "editor/ui/clip_list.hpp"
#include "editor/ui/panels.hpp"
#include "editor/ui/style.hpp"
#include "editor/ui/widgets.hpp"

namespace lutka::editor {
namespace {

using scene::ScenePuppets;

template <class Change>
void changePuppets(Editor& editor, const char* label, const char* group, const Change& change) {
    editor.editScene(label, group, [&](scene::EntityScene& scene) {
        if (scene.simulation.puppets) change(*scene.simulation.puppets);
    });
}

// Of the file, and what the scene has where that is none of them: the mannequin's clips are borrowed.
void drawClip(const PanelContext& context, const ScenePuppets& puppets) {
    Editor& editor = context.editor;
    std::optional<std::string> chosen;
    labelled("Follow", context.px(92));
    const char* held = "the start pose";
    const auto& clips = editor.document().character().clips;
    const std::string shown = puppets.clip.empty() ? held : shownClip(clips, puppets.clip);
    if (beginClipCombo("##follow", shown)) {
        if (ImGui::Selectable(held, puppets.clip.empty())) chosen = "";
        if (const auto clip = chooseListedClip(clips, puppets.clip)) chosen = clip;
        ImGui::EndCombo();
    }
    if (!chosen) return;
    changePuppets(editor, "Follow a clip", "", [&](ScenePuppets& next) { next.clip = *chosen; });
}

void drawStrengths(const PanelContext& context, const ScenePuppets& puppets) {
    Editor& editor = context.editor;
    labelled("Muscles", context.px(92));
    int chosen = puppets.muscles ? 1 + static_cast<int>(*puppets.muscles) : 0;
    if (ImGui::Combo("##muscles", &chosen, "the profile's own\0limp\0weak\0powered\0stiff\0")) {
        changePuppets(editor, "Muscles", "", [&](ScenePuppets& next) {
            next.muscles = chosen > 0 ? std::optional(static_cast<physics::MusclePreset>(chosen - 1)) : std::nullopt;
        });
    }
    labelled("Strength", context.px(92));
    float strength = puppets.strength;
    if (slider("##strength", strength, 0.01F, 10.0F, "%.2f times", true)) {
        changePuppets(editor, "Strength", "strength",
                      [&](ScenePuppets& next) { next.strength = std::max(strength, 0.0F); });
    }
    labelled("Pin", context.px(92));
    const physics::RagdollProfile& profile = editor.document().profile();
    const int hips = std::max(physics::bodyOf(profile, animation::Role::hips), 0);
    const std::optional<float> own = profile.bodies.empty() ? std::nullopt : profile.bodies[hips].pinForceN;
    float pin = puppets.pinForceN.value_or(own.value_or(physics::PuppetSettings{}.pinForceN));
    if (slider("##pin", pin, 0.0F, 10000.0F, "%.0f N")) {
        changePuppets(editor, "Pin", "pin", [&](ScenePuppets& next) { next.pinForceN = std::max(pin, 0.0F); });
    }
    tooltip("Holds the hips to the clip with at most so much; 0: it stands by its muscles, or falls");
    bool getUp = puppets.getUp;
    if (ImGui::Checkbox("Gets up after a fall", &getUp))
        changePuppets(editor, "Getting up", "", [&](ScenePuppets& next) { next.getUp = getUp; });
}

}  // namespace

void drawMuscles(const PanelContext& context) {
    Editor& editor = context.editor;
    const std::optional<ScenePuppets> puppets = editor.document().scene().simulation.puppets;
    bool on = puppets.has_value();
    if (ImGui::Checkbox("Characters have muscles", &on))
        editor.setPuppets(on ? std::optional<ScenePuppets>(editor.firstMuscles()) : std::nullopt);
    tooltip("They follow a clip, react to hits and go limp when one is too much; otherwise they fall");
    const float half = (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x) * 0.5F;
    ImGui::BeginDisabled(!puppets);
    if (ImGui::Button("Go limp", {half, 0})) editor.perform(Action::goLimp);
    ImGui::EndDisabled();
    ImGui::SameLine();
    if (ImGui::Button("Get up", {half, 0})) editor.perform(Action::getUp);
    tooltip("Who lies at rest gets up, and follows the clip that is shown, or stands");
    if (!puppets) return;
    drawClip(context, *puppets);
    drawStrengths(context, *puppets);
    ImGui::Checkbox("Target", &editor.view.ghost);
    tooltip("The pose that they follow, by how far they are from it");
    ImGui::SameLine(context.px(150));
    ImGui::Checkbox("Strength as a colour", &editor.view.strength);
    tooltip("What is left of each joint's strength");
    if (editor.view.ghost) drawLegend(targetLegend());
    if (editor.view.strength) drawLegend(strengthLegend());
}

}  // namespace lutka::editor
