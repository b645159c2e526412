#include "report/library_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "animation/import/model_ending.hpp"
#include "core/base64.hpp"
#include "core/markup_text.hpp"
#include "report/html_text.hpp"
#include "report/model_tables.hpp"

namespace lutka::reporting {
namespace {

namespace fs = std::filesystem;
using physics::Severity;
using Json = nlohmann::ordered_json;

constexpr std::size_t kMostModels = 100'000;

int findingsOf(const LibraryRow& row, Severity severity) {
    return static_cast<int>(std::count_if(row.checkup.diagnosis.findings.begin(), row.checkup.diagnosis.findings.end(),
                                          [&](const auto& finding) { return finding.severity == severity; }));
}

float worstOf(const LibraryRow& row, float (*of)(const physics::Quality&)) {
    float worst = 0;
    for (const physics::Quality& drop : row.checkup.drops)
        worst = std::max(worst, of(drop));
    return worst;
}

float separationMm(const physics::Quality& q) {
    return q.jointSeparationM.max * 1e3F;
}
float lastingDeg(const physics::Quality& q) {
    return q.limitViolationDeg.lasting;
}

// Seconds of the slowest drop; unset: one never came to rest, or there were none.
std::optional<float> settleOf(const LibraryRow& row) {
    std::optional<float> slowest;
    for (const physics::Quality& drop : row.checkup.drops) {
        if (!drop.settleSeconds) return std::nullopt;
        slowest = std::max(slowest.value_or(0.0F), *drop.settleSeconds);
    }
    return slowest;
}

// A cell of numbers with the value that sorts it.
std::string cell(double sortsBy, const std::string& text) {
    return fmt::format("<td class=\"number\" data-value=\"{:g}\">{}</td>", sortsBy, text);
}

std::string measuredCells(const LibraryRow& row) {
    constexpr double kLast = 1e9;  // what was not measured comes after all that was
    if (row.checkup.drops.empty()) return cell(kLast, "–") + cell(kLast, "–") + cell(kLast, "–");
    const float separation = worstOf(row, separationMm);
    const float lasting = worstOf(row, lastingDeg);
    const auto settle = settleOf(row);
    return cell(separation, fmt::format("{:.1f}", separation)) + cell(lasting, fmt::format("{:.1f}", lasting)) +
           (settle ? cell(*settle, fmt::format("{:.1f}", *settle)) : cell(kLast / 2, "never"));
}

std::string countBadge(int count, const char* kind) {
    return count == 0 ? "<span class=\"none\">0</span>"
                      : fmt::format("<span class=\"badge {}\">{}</span>", kind, count);
}

std::string nameCell(const LibraryRow& row) {
    const std::string name = markupEscaped(row.model);
    const auto& findings = row.checkup.diagnosis.findings;
    std::string picture =
        row.thumbnail.empty()
            ? ""
            : fmt::format("<img alt=\"\" loading=\"lazy\" src=\"data:image/png;base64,{}\">", base64(row.thumbnail));
    const std::string told = findings.empty()
                                 ? fmt::format("<span class=\"model\">{}</span>", name)
                                 : fmt::format("<details><summary class=\"model\">{}</summary>{}</details>", name,
                                               findingsHtml(row.checkup.diagnosis));
    return fmt::format("<td data-value=\"{}\"><div class=\"who\">{}{}</div></td>", name, picture, told);
}

std::string rowHtml(const LibraryRow& row) {
    const int errors = findingsOf(row, Severity::error);
    const int warnings = findingsOf(row, Severity::warning);
    std::string out = "<tr>" + nameCell(row);
    out += fmt::format("<td class=\"number\" data-value=\"{0:g}\"><b class=\"score {1}\">{0:.0f}</b></td>",
                       row.checkup.score, scoreClass(row.checkup.score));
    out += row.humanoid ? cell(row.mappingSure, fmt::format("{:.0f} %", row.mappingSure * 100)) : cell(-1, "any rig");
    out += cell(static_cast<double>(row.bodies), fmt::format("{}", row.bodies));
    out += cell(row.heightM, fmt::format("{:.2f}", row.heightM)) + cell(row.massKg, fmt::format("{:.1f}", row.massKg));
    out += measuredCells(row);
    return out + cell(errors, countBadge(errors, "error")) + cell(warnings, countBadge(warnings, "warning")) +
           "</tr>\n";
}

std::string tableHtml(const Library& library) {
    if (library.rows.empty()) return "<p class=\"empty\">No model became a ragdoll.</p>\n";
    std::string out =
        "<table id=\"models\"><thead><tr><th>Model</th><th class=\"number\">Score</th><th class=\"number\">Mapping</th>"
        "<th class=\"number\">Bodies</th><th class=\"number\">Height, m</th><th class=\"number\">Mass, kg</th>"
        "<th class=\"number\">Separation, mm</th><th class=\"number\">Past limit, deg</th>"
        "<th class=\"number\">Rest, s</th><th class=\"number\">Errors</th><th class=\"number\">Warnings</th>"
        "</tr></thead><tbody>\n";
    for (const LibraryRow& row : library.rows)
        out += rowHtml(row);
    return out + "</tbody></table>\n";
}

std::string refusedHtml(const Library& library) {
    if (library.refused.empty()) return "";
    std::string out =
        "<section><h2>Refused</h2>\n<div class=\"scroll\"><table><thead><tr><th>Model</th><th>Why</th><th>What mends "
        "it</th></tr></thead><tbody>\n";
    for (const RefusedModel& refused : library.refused) {
        out += fmt::format("<tr><td class=\"model\">{}</td><td>{}</td><td>{}</td></tr>\n", markupEscaped(refused.model),
                           htmlOfMessage(refused.error.message), htmlOfMessage(refused.error.mend));
    }
    return out + "</tbody></table></div></section>\n";
}

std::string summaryHtml(const Library& library) {
    const auto sound = std::count_if(library.rows.begin(), library.rows.end(),
                                     [](const LibraryRow& row) { return !row.checkup.diagnosis.hasErrors(); });
    const auto fact = [](std::string_view term, const std::string& value) {
        return fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", term, value);
    };
    std::string out = fact("Models", fmt::format("{}", library.rows.size() + library.refused.size()));
    out += fact("Sound", fmt::format("{}", sound));
    out += fact("With errors", fmt::format("{}", static_cast<std::ptrdiff_t>(library.rows.size()) - sound));
    out += fact("Refused", fmt::format("{}", library.refused.size()));
    if (!library.rows.empty()) {
        std::vector<float> scores;
        for (const LibraryRow& row : library.rows)
            scores.push_back(row.checkup.score);
        std::sort(scores.begin(), scores.end());
        out += fact("Median score", fmt::format("{:.0f}", scores[scores.size() / 2]));
    }
    return "<dl class=\"facts\">\n" + out + "</dl>\n";
}

}  // namespace

Result<std::vector<fs::path>> modelsBelow(const fs::path& folder) {
    std::error_code failed;
    fs::recursive_directory_iterator at(folder, fs::directory_options::skip_permission_denied, failed);
    if (failed)
        return Error{ErrorCode::input, "the folder can't be read: " + failed.message(), folder.string(),
                     "check the path and its permissions"};
    std::vector<fs::path> models;
    for (; !failed && at != fs::recursive_directory_iterator(); at.increment(failed)) {
        std::error_code ignored;
        const bool hidden = at->path().filename().string().starts_with('.');
        if (hidden && at->is_directory(ignored)) at.disable_recursion_pending();
        if (hidden || !animation::hasModelEnding(at->path()) || !at->is_regular_file(ignored)) continue;
        if (models.size() == kMostModels)
            return Error{ErrorCode::input, fmt::format("there are more than {} models", kMostModels), folder.string(),
                         "report on its folders one by one"};
        models.push_back(at->path());
    }
    std::sort(models.begin(), models.end());
    return models;
}

LibraryRow libraryRow(const std::string& model, const scene::RagdollAsset& asset, scene::Checkup checkup) {
    return {model,
            std::move(checkup),
            asset.map.humanoid,
            asset.map.confidence,
            asset.profile.bodies.size(),
            asset.profile.heightM,
            asset.profile.totalMassKg,
            ""};
}

void sortLibrary(Library& library) {
    std::sort(library.rows.begin(), library.rows.end(), [](const LibraryRow& a, const LibraryRow& b) {
        return a.checkup.score != b.checkup.score ? a.checkup.score > b.checkup.score : a.model < b.model;
    });
    std::sort(library.refused.begin(), library.refused.end(),
              [](const RefusedModel& a, const RefusedModel& b) { return a.model < b.model; });
}

std::string libraryReportHtml(const Library& library, const PageParts& parts, std::string_view version) {
    return filled(parts.library, {{"folder", markupEscaped(library.folder)},
                                  {"version", markupEscaped(version)},
                                  {"style", parts.style},
                                  {"summary", summaryHtml(library)},
                                  {"table", tableHtml(library)},
                                  {"refused", refusedHtml(library)},
                                  {"view", scriptSource(parts.libraryView)}});
}

std::string libraryReportJson(const Library& library) {
    Json models = Json::array();
    for (const LibraryRow& row : library.rows) {
        Json measured;
        if (!row.checkup.drops.empty()) {
            const auto settle = settleOf(row);
            measured = {{"jointSeparationMm", worstOf(row, separationMm)},
                        {"lastingViolationDeg", worstOf(row, lastingDeg)},
                        {"settleSeconds", settle ? Json(*settle) : Json()}};
        }
        models.push_back({{"model", row.model},
                          {"score", row.checkup.score},
                          {"humanoid", row.humanoid},
                          {"confidence", row.mappingSure},
                          {"bodies", row.bodies},
                          {"heightM", row.heightM},
                          {"massKg", row.massKg},
                          {"worst", std::move(measured)},
                          {"errors", findingsOf(row, Severity::error)},
                          {"warnings", findingsOf(row, Severity::warning)}});
    }
    Json refused = Json::array();
    for (const RefusedModel& model : library.refused)
        refused.push_back({{"model", model.model}, {"why", model.error.message}, {"mend", model.error.mend}});
    const Json json = {{"folder", library.folder}, {"models", std::move(models)}, {"refused", std::move(refused)}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace lutka::reporting
