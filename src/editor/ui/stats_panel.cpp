/// The tab Stats: where the time of a frame goes, what is simulated and drawn, memory, and the figures of quality.

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "core/memory_use.hpp"
#include "editor/ui/panels.hpp"
#include "editor/ui/style.hpp"
#include "editor/ui/widgets.hpp"
#include "scene/measure/report.hpp"

namespace lutka::editor {
namespace {

void plot(const PanelContext& context, const char* id, std::span<const float> values, const char* overlay) {
    const float most = std::max(percentilesOf(values).p99 * 1.4F, 1.0F);
    ImGui::PlotLines(id, values.data(), static_cast<int>(values.size()), 0, overlay, 0.0F, most,
                     {ImGui::GetContentRegionAvail().x, context.px(48)});
}

void row(const char* name, const std::string& value) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextColored(mutedColor(), "%s", name);
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(value.c_str());
}

bool beginRows(const PanelContext& context, const char* id) {
    if (!ImGui::BeginTable(id, 2, ImGuiTableFlags_RowBg)) return false;
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthFixed, context.px(124));
    ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch);
    return true;
}

std::string megabytes(double bytes) {
    return fmt::format("{:.1f} MB", bytes / (1024.0 * 1024.0));
}

StatsReadings readStats(const PanelContext& context) {
    const scene::Simulation& simulation = context.editor.player().simulation();
    const auto steps = simulation.stepMs();
    const auto last = steps.last(std::min(steps.size(), FrameHistory::kLength));
    StatsReadings readings{context.history, std::vector<float>(last.begin(), last.end()),
                           simulation.world().stepTimes(), context.editor.poseMs(),
                           static_cast<double>(residentBytes())};
    if (context.state.amendStats) context.state.amendStats(readings);
    return readings;
}

void drawFrames(const PanelContext& context, const FrameHistory& history) {
    const auto frames = history.frameMs();
    const Percentiles ms = percentilesOf(frames);
    caption("FRAME");
    plot(context, "##frames", frames, "ms");
    mutedText(fmt::format("p50 {:.1f} ms, p95 {:.1f}, p99 {:.1f}", ms.p50, ms.p95, ms.p99));
    const std::vector<float> fps = history.framesPerSecond();
    const Percentiles rate = percentilesOf(fps);
    plot(context, "##fps", fps, "fps");
    // The worst frames are those of few a second: the share that is told is of frames that were slower.
    mutedText(fmt::format("{:.0f} fps; p50 {:.0f}, slowest 5 % below {:.0f}, slowest 1 % below {:.0f}", history.fps(),
                          rate.p50, percentilesOf(fps, true).p95, percentilesOf(fps, true).p99));
    ImGui::Checkbox("VSync", &context.editor.view.vsync);
    tooltip("Waits for the monitor. Off: as many frames as the machine can draw");
}

void drawParts(const PanelContext& context, const StatsReadings& readings) {
    const physics::StepTimes& times = readings.parts;
    const render::FrameStats& stats = readings.history.stats;
    caption("WHERE THE TIME GOES");
    if (!beginRows(context, "##parts")) return;
    const auto ms = [](double value) { return fmt::format("{:.3f} ms", value); };
    row("Broadphase", ms(times.broadphaseMs));
    row("Narrowphase", ms(times.narrowphaseMs));
    row("Solver", ms(times.solverMs));
    row("Pose", ms(readings.poseMs));
    row("Upload, culling", ms(stats.cpu[render::RenderPass::prepare]));
    row("Draw, processor", ms(stats.cpuMs));
    row("Draw, GPU", stats.gpu.known ? ms(stats.gpu.total()) : "not measured yet");
    for (std::size_t pass = 0; stats.gpu.known && pass < render::kRenderPassCount; ++pass) {
        const auto which = static_cast<render::RenderPass>(pass);
        if (stats.gpu[which] <= 0.0) continue;
        row("", fmt::format("{} {:.3f} ms", render::renderPassName(which), stats.gpu[which]));
    }
    ImGui::EndTable();
}

void drawCounts(const PanelContext& context, const StatsReadings& readings) {
    const scene::Simulation& simulation = context.editor.player().simulation();
    const physics::WorldView& world = simulation.world();
    const render::FrameStats& stats = readings.history.stats;
    const auto bodies = static_cast<int>(simulation.asset().profile.bodies.size());
    const auto constraints = static_cast<int>(simulation.asset().profile.constraints.size());
    int asleep = 0;
    for (const physics::DollId doll : world.dolls())
        asleep += world.isAsleep(doll) ? 1 : 0;
    std::vector<physics::ContactPoint> contacts;
    world.getContacts(contacts);
    caption("WHAT IS THERE");
    if (!beginRows(context, "##counts")) return;
    row("Dolls", fmt::format("{}, {} asleep", simulation.dollCount(), asleep));
    row("Bodies", fmt::format("{} and {} props", bodies * simulation.dollCount(), world.props().size()));
    row("Constraints", fmt::format("{}", constraints * simulation.dollCount()));
    row("Contacts", fmt::format("{}", contacts.size()));
    row("Islands awake", fmt::format("{}", readings.parts.islands));
    row("Draw calls", fmt::format("{} ({} skinned)", stats.drawCalls, stats.characterDrawCalls));
    row("Triangles", fmt::format("{}", stats.triangles));
    row("Uploaded", fmt::format("{} kB a frame", stats.uploadedBytes / 1024));
    row("Memory", megabytes(readings.residentBytes));
    row("GPU memory", megabytes(static_cast<double>(stats.memory.total())));
    row("", fmt::format("meshes {}, textures {}", megabytes(static_cast<double>(stats.memory.meshes)),
                        megabytes(static_cast<double>(stats.memory.textures))));
    row("", fmt::format("targets {}, streams {}", megabytes(static_cast<double>(stats.memory.targets)),
                        megabytes(static_cast<double>(stats.memory.streams))));
    ImGui::EndTable();
}

void drawQuality(const PanelContext& context) {
    const physics::Quality quality = context.editor.player().simulation().quality();
    caption("QUALITY OF THE FALL");
    if (!beginRows(context, "##quality")) return;
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
    ImGui::EndTable();
}

}  // namespace

void drawStatsTab(const PanelContext& context) {
    const StatsReadings readings = readStats(context);
    drawFrames(context, readings.history);
    caption("SIMULATION STEP");
    plot(context, "##steps", readings.stepMs, "ms");
    const Percentiles ms = percentilesOf(readings.stepMs);
    mutedText(fmt::format("p50 {:.2f} ms, p95 {:.2f}, p99 {:.2f}", ms.p50, ms.p95, ms.p99));
    drawParts(context, readings);
    drawCounts(context, readings);
    drawQuality(context);
}

}  // namespace lutka::editor
