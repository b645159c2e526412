#include <fmt/format.h>

#include "scene/measure/checkup.hpp"
#include "scene/measure/puppet_report.hpp"
#include "scene/measure/quality_json.hpp"

namespace lutka::scene {
namespace {

using Json = nlohmann::ordered_json;

Json findingJson(const physics::Finding& finding) {
    return {{"severity", physics::severityName(finding.severity)},
            {"code", finding.code},
            {"place", finding.place},
            {"bodies", finding.bodies},
            {"measure", finding.measure},
            {"mend", finding.mend},
            {"mendable", finding.mendable}};
}

Json walkJson(const WalkCheck& walk) {
    return {{"trackingErrorDeg", trackingJson(walk.figures)},
            {"rootErrorM", walk.figures.rootM},
            {"footSlideM", walk.figures.footSlideM},
            {"motorWorkJ", walk.motorWorkJ},
            {"pinWorkJ", walk.pinWorkJ},
            {"pinImpulseNs", walk.pinImpulseNs},
            {"recoverySeconds", secondsJson(walk.recoverySeconds)}};
}

std::string walkText(const WalkCheck& walk) {
    const PuppetFigures& figures = walk.figures;
    std::string text =
        fmt::format("  walks      {:.2f} deg RMS off the clip, {:.1f} at most ({}), hips within {:.1f} cm",
                    figures.rmsDeg, figures.maxDeg, figures.worstJoint, figures.rootM * 1e2F);
    text += fmt::format(", feet slide {:.1f} cm", figures.footSlideM * 1e2F);
    if (walk.recoverySeconds >= 0.0F) text += fmt::format(", itself {:.2f} s after a hit", walk.recoverySeconds);
    return text + "\n";
}

}  // namespace

std::string checkupJson(const RagdollAsset& asset, const Checkup& checkup) {
    Json json;
    json["model"] = asset.character.file.string();
    json["score"] = checkup.score;
    json["errors"] = checkup.diagnosis.hasErrors();
    json["findings"] = Json::array();
    for (const auto& finding : checkup.diagnosis.findings)
        json["findings"].push_back(findingJson(finding));
    json["fit"] = fitJson(checkup.diagnosis.fit);
    json["parts"] = Json::array();
    for (const auto& part : checkup.diagnosis.parts) {
        json["parts"].push_back({{"name", part.name}, {"points", part.points}, {"of", part.of}});
    }
    json["measured"] = Json::array();
    for (const MeasuredBound& bound : checkup.bounds) {
        json["measured"].push_back(
            {{"name", bound.name}, {"unit", bound.unit}, {"worst", bound.worst}, {"bound", bound.bound}});
    }
    json["drops"] = Json::array();
    for (const physics::Quality& drop : checkup.drops)
        json["drops"].push_back(qualityJson(drop));
    json["walk"] = checkup.walk ? walkJson(*checkup.walk) : Json();
    if (!checkup.noWalk.empty()) json["noWalk"] = checkup.noWalk;
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string checkupText(const RagdollAsset& asset, const Checkup& checkup) {
    std::string text = fmt::format("{}: {:.0f} of 100\n", asset.character.name, checkup.score);
    const physics::FitMeasures& fit = checkup.diagnosis.fit;
    if (fit.vertices > 0) {
        text += fmt::format("  fit        {:.0f} % of {} skin vertices within 2 % of the height of their body",
                            fit.skinNear * 100, fit.vertices);
        if (fit.volumeCovered) text += fmt::format(", {:.0f} % of the volume covered", *fit.volumeCovered * 100);
        text += fmt::format(", overlap {:.1f} mm\n", fit.overlapM * 1e3F);
    }
    for (const auto& part : checkup.diagnosis.parts) {
        text += fmt::format("  score      {:<28} {:5.1f} of {:.0f}\n", part.name, part.points, part.of);
    }
    for (const MeasuredBound& bound : checkup.bounds) {
        text += fmt::format("  measured   {:<28} {:8.2f} {} ({} allowed)\n", bound.name, bound.worst, bound.unit,
                            bound.bound);
    }
    if (checkup.walk) text += walkText(*checkup.walk);
    if (!checkup.noWalk.empty()) text += fmt::format("  walks      not: {}\n", checkup.noWalk);
    if (checkup.drops.empty()) text += "  measured   nothing: there are errors\n";
    for (const auto& finding : checkup.diagnosis.findings) {
        text += fmt::format("  {:<10} {}{}: {}", physics::severityName(finding.severity), finding.code,
                            finding.place.empty() ? "" : " at " + finding.place, finding.measure);
        if (!finding.mend.empty())
            text += fmt::format(" -> {}{}", finding.mend, finding.mendable ? " (--fix does it)" : "");
        text += "\n";
    }
    return text;
}

}  // namespace lutka::scene
