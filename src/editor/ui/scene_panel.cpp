/// The right panel's other tabs: scene and simulation, view, statistics, log.

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "editor/ui/panels.hpp"
#include "editor/ui/style.hpp"
#include "editor/ui/widgets.hpp"
#include "scene/report.hpp"

namespace lutka::editor {
namespace {

float labelWidth(const PanelContext& context) {
    return context.px(92);
}

}  // namespace

void drawFit(const PanelContext& context) {
    Editor& editor = context.editor;
    physics::FitOptions fit = editor.document().state().fit;
    bool changed = false;
    labelled("Preset", labelWidth(context));
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
    labelled("Total mass", labelWidth(context));
    ImGui::InputFloat("##total", &fit.totalMassKg, 0.0F, 0.0F, "%.1f kg");
    changed |= ImGui::IsItemDeactivatedAfterEdit() && fit.totalMassKg > 0.0F;
    labelled("Masses", labelWidth(context));
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

float percentile(std::vector<float> values, float share) {
    if (values.empty()) return 0.0F;
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(share * static_cast<float>(values.size() - 1))];
}

void plot(const PanelContext& context, const char* id, std::span<const float> values) {
    const float most = std::max(percentile({values.begin(), values.end()}, 0.99F) * 1.4F, 1.0F);
    ImGui::PlotLines(id, values.data(), static_cast<int>(values.size()), 0, nullptr, 0.0F, most,
                     {ImGui::GetContentRegionAvail().x, context.px(54)});
}

void row(const char* name, const std::string& value) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextColored(mutedColor(), "%s", name);
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(value.c_str());
}

void drawQuality(const scene::Simulation& simulation) {
    const physics::Quality quality = simulation.quality();
    row("Joint separation", fmt::format("{:.1f} mm max, {:.1f} p99", quality.jointSeparationM.max * 1e3F,
                                        quality.jointSeparationM.p99 * 1e3F));
    row("Past limits",
        fmt::format("{:.1f}° max, {:.1f}° p99", quality.limitViolationDeg.max, quality.limitViolationDeg.p99));
    row("Into the floor", fmt::format("{:.1f} mm", quality.floorPenetrationM * 1e3F));
    row("Into itself", fmt::format("{:.1f} mm", quality.selfPenetrationM * 1e3F));
    row("Energy growth", fmt::format("{:.2f} J", quality.energyGrowthJ));
    row("Settled after", quality.settleSeconds ? fmt::format("{:.2f} s", *quality.settleSeconds) : "not yet");
    row("Speed now", fmt::format("{:.3f} m/s", quality.residualSpeedMps));
    row("Not finite", fmt::format("{}", quality.nonFinite));
}

// What a layer's colours mean, a line each.
void drawLegend(const scene::DebugLayerInfo& layer) {
    ImGui::Indent();
    for (const render::LegendEntry& entry : layer.legend) {
        const ImVec4 color(static_cast<float>(entry.color.r) / 255.0F, static_cast<float>(entry.color.g) / 255.0F,
                           static_cast<float>(entry.color.b) / 255.0F, 1.0F);
        const float side = ImGui::GetTextLineHeight();
        ImGui::ColorButton(entry.text.data(), color, ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoDragDrop,
                           {side, side});
        ImGui::SameLine();
        mutedText(std::string(entry.text));
    }
    ImGui::Unindent();
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
        if (view.debug && layers.*layer.member) drawLegend(layer);
    }
    ImGui::Unindent();
    ImGui::EndDisabled();
    caption("PICTURE");
    labelled("Skin", labelWidth(context));
    ImGui::SliderFloat("##skin", &view.skinOpacity, 0.0F, 1.0F, "opacity %.2f");
    ImGui::Checkbox("Dual quaternion skin", &view.dualQuaternions);
    tooltip("Keeps the volume of twisted limbs; bends bulge a little");
    labelled("Lens", labelWidth(context));
    render::Camera& camera = context.editor.workspace().camera;
    float lens = degrees(camera.fieldOfView);
    if (ImGui::SliderFloat("##lens", &lens, 15.0F, 90.0F, "%.0f°")) camera.fieldOfView = radians(lens);
    ImGui::Checkbox("Parallel projection", &camera.orthographic);
}

void drawStatsTab(const PanelContext& context) {
    const scene::Simulation& simulation = context.editor.player().simulation();
    const auto frames = context.history.frameMs();
    caption("FRAME TIME");
    plot(context, "##frames", frames);
    const std::vector<float> all(frames.begin(), frames.end());
    mutedText(fmt::format("p50 {:.1f} ms, p99 {:.1f} ms, {:.0f} fps", percentile(all, 0.5F), percentile(all, 0.99F),
                          context.history.fps()));
    caption("SIMULATION STEP");
    const auto steps = simulation.stepMs();
    plot(context, "##steps", steps.last(std::min(steps.size(), FrameHistory::kLength)));
    const scene::StepTimes times = scene::summarise(steps);
    mutedText(fmt::format("mean {:.2f} ms, p50 {:.2f}, p99 {:.2f}", times.mean, times.p50, times.p99));
    if (!ImGui::BeginTable("##stats", 2, ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_RowBg)) return;
    const render::FrameStats& stats = context.history.stats;
    row("Draw calls", fmt::format("{} ({} skinned)", stats.drawCalls, stats.characterDrawCalls));
    row("Triangles", fmt::format("{}", stats.triangles));
    row("Uploaded", fmt::format("{} kB a frame", stats.uploadedBytes / 1024));
    row("Dolls", fmt::format("{}, {} bodies each", simulation.dollCount(), simulation.asset().profile.bodies.size()));
    drawQuality(simulation);
    ImGui::EndTable();
}

}  // namespace lutka::editor
