/// The tab of the ragdoll doctor: the score, and every finding with what shows it and what mends it.

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "editor/ui/panels.hpp"
#include "editor/ui/style.hpp"
#include "editor/ui/widgets.hpp"

namespace lutka::editor {
namespace {

using physics::Finding;
using physics::Severity;

ImVec4 colorOf(Severity severity) {
    switch (severity) {
        case Severity::error:
            return errorColor();
        case Severity::warning:
            return warningColor();
        case Severity::info:
            break;
    }
    return mutedColor();
}

void show(Editor& editor, const Finding& finding) {
    bool first = true;
    for (const std::string& name : finding.bodies) {
        const int body = physics::bodyNamed(editor.document().profile(), name);
        if (body < 0) continue;
        editor.select(Item{Item::Kind::body, 0, body}, !first);
        first = false;
    }
}

// Whether the user asked to mend it.
bool drawFinding(const PanelContext& context, const Finding& finding) {
    ImGui::TextColored(colorOf(finding.severity), "%s", finding.code.c_str());
    ImGui::SameLine();
    ImGui::TextUnformatted(finding.place.c_str());
    mutedText(finding.measure);
    if (!finding.mend.empty()) mutedText("Mend: " + finding.mend);
    const bool mendable = context.editor.document().canMend(finding);
    bool mend = false;
    if (mendable) mend = ImGui::SmallButton("Fix");
    const physics::RagdollProfile& profile = context.editor.document().profile();
    const bool seen = std::any_of(finding.bodies.begin(), finding.bodies.end(),
                                  [&](const std::string& name) { return physics::bodyNamed(profile, name) >= 0; });
    if (seen) {
        if (mendable) ImGui::SameLine();
        if (ImGui::SmallButton("Show")) show(context.editor, finding);
    }
    ImGui::Separator();
    return mend;
}

void drawScore(const PanelContext& context, const physics::Diagnosis& diagnosis) {
    ImGui::PushFont(context.fonts.heading);
    ImGui::Text("Score %.0f of 100", static_cast<double>(diagnosis.score));
    ImGui::PopFont();
    if (ImGui::IsItemHovered()) {
        std::string parts;
        for (const physics::ScorePart& part : diagnosis.parts)
            parts += fmt::format("{}{}: {:.0f} of {:.0f}", parts.empty() ? "" : "\n", part.name, part.points, part.of);
        tooltip(parts);
    }
}

}  // namespace

void drawDoctorTab(const PanelContext& context) {
    Editor& editor = context.editor;
    const physics::Diagnosis diagnosis = editor.document().diagnosis();  // a copy: a fix replaces it
    drawScore(context, diagnosis);
    const auto mendable = std::count_if(diagnosis.findings.begin(), diagnosis.findings.end(),
                                        [&](const Finding& finding) { return editor.document().canMend(finding); });
    if (diagnosis.findings.empty()) mutedText("Nothing to complain about.");
    if (mendable > 1 && ImGui::Button(fmt::format("Fix all {}", mendable).c_str())) {
        editor.edit([&](EditorDocument& document) { return document.mend(diagnosis.findings); });
    }
    ImGui::Separator();
    for (std::size_t i = 0; i < diagnosis.findings.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        if (drawFinding(context, diagnosis.findings[i])) {
            editor.edit([&](EditorDocument& document) { return document.mend(std::span(&diagnosis.findings[i], 1)); });
        }
        ImGui::PopID();
    }
}

}  // namespace lutka::editor
