/// The right panel's other tabs: scene and simulation, view.

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "editor/ui/panels.hpp"
#include "editor/ui/style.hpp"
#include "editor/ui/widgets.hpp"

namespace lutka::editor {
namespace {

float sceneLabelWidth(const PanelContext& context) {
    return context.px(92);
}

}  // namespace

void drawFit(const PanelContext& context) {
    Editor& editor = context.editor;
    physics::FitOptions fit = editor.document().state().fit;
    bool changed = false;
    labelled("Preset", sceneLabelWidth(context));
    if (ImGui::BeginCombo("##ragdollPreset", std::string(physics::infoOf(fit.preset).name).c_str())) {
        for (const physics::PresetInfo& info : physics::presetInfos()) {
            if (ImGui::Selectable(std::string(info.name).c_str(), info.preset == fit.preset)) {
                fit.preset = info.preset;
                changed = true;
            }
            tooltip(std::string(info.summary));
        }
        ImGui::EndCombo();
    }
    tooltip(std::string(physics::infoOf(fit.preset).summary));
    labelled("Total mass", sceneLabelWidth(context));
    ImGui::InputFloat("##total", &fit.totalMassKg, 0.0F, 0.0F, "%.1f kg");
    if (ImGui::IsItemDeactivatedAfterEdit() && fit.totalMassKg > 0.0F) {
        fit.weighByVolume = false;
        changed = true;
    }
    labelled("Masses", sceneLabelWidth(context));
    int preset = static_cast<int>(fit.massPreset);
    if (ImGui::Combo("##preset", &preset, "Anatomical\0Balanced\0Uniform\0By volume\0")) {
        fit.massPreset = static_cast<physics::MassPreset>(preset);
        changed = true;
    }
    changed |= ImGui::Checkbox("Clavicles", &fit.shoulderBodies);
    ImGui::SameLine(context.px(150));
    changed |= ImGui::Checkbox("Neck", &fit.neckBody);
    changed |= ImGui::Checkbox("Toes", &fit.toeBodies);
    ImGui::SameLine(context.px(150));
    changed |= ImGui::Checkbox("Whole trunk", &fit.allTrunkBodies);
    if (changed) editor.edit([&](EditorDocument& document) { return document.setFit(fit); });
}

namespace {

// The plain sky, or a panorama that gives the light.
void drawSky(const PanelContext& context) {
    ViewSettings& view = context.editor.view;
    caption("LIGHT");
    labelled("Sky", sceneLabelWidth(context));
    std::string file = view.sky.string();
    bool browse = false;
    if (pathLine("##sky", file, browse)) view.sky = file;
    if (file.empty()) tooltip("A panorama (*.hdr) that lights the scene; none: the plain sky");
    if (browse) context.editor.dialog = Editor::Dialog::chooseSky;
    ImGui::BeginDisabled(view.sky.empty());
    ImGui::Checkbox("Show it behind the scene", &view.skyBackground);
    ImGui::SameLine();
    if (ImGui::SmallButton("Plain sky")) view.sky.clear();
    ImGui::EndDisabled();
}

}  // namespace

void drawViewTab(const PanelContext& context) {
    ViewSettings& view = context.editor.view;
    scene::DebugLayers& layers = view.layers;
    ImGui::Checkbox("Debug draw (F3)", &view.debug);
    ImGui::BeginDisabled(!view.debug);
    ImGui::Indent();
    for (const scene::DebugLayerInfo& layer : scene::debugLayerInfos()) {
        ImGui::Checkbox(layer.title.data(), &(layers.*layer.member));
        tooltip(layer.what.data());
        if (view.debug && layers.*layer.member) drawLegend(layer.legend);
    }
    ImGui::Unindent();
    ImGui::EndDisabled();
    caption("PICTURE");
    labelled("Skin", sceneLabelWidth(context));
    static_cast<void>(slider("##skin", view.skinOpacity, 0.0F, 1.0F, "opacity %.2f"));
    ImGui::Checkbox("Dual quaternion skin", &view.dualQuaternions);
    tooltip("Keeps the volume of twisted limbs; bends bulge a little");
    labelled("Lens", sceneLabelWidth(context));
    render::Camera& camera = context.editor.workspace().camera;
    float lens = degrees(camera.fieldOfView);
    if (slider("##lens", lens, 15.0F, 90.0F, "%.0f°")) camera.fieldOfView = radians(lens);
    ImGui::Checkbox("Parallel projection", &camera.orthographic);
    drawSky(context);
}

}  // namespace lutka::editor
