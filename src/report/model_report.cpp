#include "report/model_report.hpp"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

#include "core/base64.hpp"
#include "core/markup_text.hpp"
#include "report/doll_view.hpp"
#include "report/drop_charts.hpp"
#include "report/html_text.hpp"
#include "report/model_tables.hpp"

namespace lutka::reporting {
namespace {

// Of the first drop: in the air, at the first touch, going down, lying.
constexpr std::array<int, 5> kMoments = {20, 32, 48, 72, 360};  // steps

std::string picturesHtml(const std::vector<Picture>& pictures) {
    std::string out;
    for (const Picture& picture : pictures) {
        out += fmt::format(
            "<figure><img alt=\"{0}\" src=\"data:image/png;base64,{1}\"><figcaption>{0}</figcaption></figure>\n",
            markupEscaped(picture.caption), base64(picture.png));
    }
    return out.empty() ? "" : "<section class=\"pictures\">\n<h2>Pictures</h2>\n<div>\n" + out + "</div></section>\n";
}

// The view's data, with when each drop touched the floor and came to rest.
std::string viewData(const scene::RagdollAsset& asset, const ModelFacts& facts) {
    const bool dropped = !facts.drops.empty();
    const std::vector<DropTrace> standing = dropped ? std::vector<DropTrace>{} : std::vector{standingTrace(asset)};
    const std::vector<DropTrace>& shown = dropped ? facts.drops : standing;
    nlohmann::ordered_json json = dollViewJson(asset, shown);
    for (std::size_t i = 0; i < shown.size(); ++i) {
        nlohmann::ordered_json& drop = json["drops"][i];
        drop["contact"] = nullptr;
        drop["settle"] = nullptr;
        if (!shown[i].firstContactS || i >= facts.checkup.drops.size()) continue;
        drop["contact"] = *shown[i].firstContactS;
        if (const auto& settle = facts.checkup.drops[i].settleSeconds)
            drop["settle"] = *shown[i].firstContactS + *settle;
    }
    return scriptJson(json);
}

}  // namespace

ModelFacts gatherFacts(const scene::RagdollAsset& asset, Photographer* photographer) {
    ModelFacts facts;
    if (photographer != nullptr) facts.pictures = photographer->standing(asset);
    std::vector<DropRecorder> recorders;
    const auto observe = [&](int drop, scene::Simulation& simulation) {
        if (static_cast<std::size_t>(drop) == recorders.size()) recorders.emplace_back();
        recorders[static_cast<std::size_t>(drop)].sample(simulation);
        if (photographer == nullptr || drop != 0) return;
        for (const int moment : kMoments) {
            if (simulation.steps() != moment) continue;
            std::string png = photographer->moment(simulation);
            if (!png.empty())
                facts.pictures.push_back(
                    {fmt::format("The first drop, {:.2f} s", simulation.seconds()), std::move(png)});
        }
    };
    facts.checkup = scene::examine(asset, observe);
    for (const DropRecorder& recorder : recorders)
        facts.drops.push_back(recorder.trace());
    return facts;
}

std::string modelReportHtml(const scene::RagdollAsset& asset, const ModelFacts& facts, const PageParts& parts,
                            std::string_view version) {
    const std::string name = markupEscaped(asset.character.name);
    const std::string notes = notesHtml(asset);
    return filled(parts.model,
                  {{"name", name},
                   {"file", markupEscaped(asset.character.file.string())},
                   {"version", markupEscaped(version)},
                   {"style", parts.style},
                   {"ring", scoreRing(facts.checkup.score)},
                   {"verdict", verdictOf(facts.checkup)},
                   {"facts", factsHtml(asset, facts.checkup)},
                   {"parts", scorePartsHtml(facts.checkup)},
                   {"pictures", picturesHtml(facts.pictures)},
                   {"bounds", boundsTable(facts.checkup)},
                   {"charts", dropChartsHtml(facts.checkup, facts.drops)},
                   {"findings", findingsHtml(facts.checkup.diagnosis)},
                   {"mapping", mappingTable(asset)},
                   {"bodies", bodiesTable(asset.profile)},
                   {"notes", notes.empty() ? "" : "<section><h2>Told while reading</h2>\n" + notes + "</section>\n"},
                   {"data", viewData(asset, facts)},
                   {"three", scriptSource(parts.three)},
                   {"view", scriptSource(parts.modelView)}});
}

}  // namespace lutka::reporting
