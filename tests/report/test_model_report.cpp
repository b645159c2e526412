#include "report/model_report.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "report/model_tables.hpp"
#include "support/catch.hpp"
#include "support/ragdolls.hpp"

using namespace lutka;
using namespace lutka::reporting;

namespace {

// The real templates, and nothing in place of three.js.
PageParts partsWithoutThree() {
    auto parts = loadPageParts(PageKind::library);
    REQUIRE(parts);
    return std::move(parts).value();
}

std::string dataOf(const std::string& page) {
    const std::string start = "id=\"data\">";
    const std::size_t from = page.find(start) + start.size();
    return page.substr(from, page.find("</script>", from) - from);
}

}  // namespace

TEST_CASE("a model's page has its score, every body, role and finding, four charts and the view's data") {
    const auto asset = test::bipedRagdoll();
    const ModelFacts facts = gatherFacts(*asset);
    REQUIRE(facts.drops.size() == 3);
    const std::string page = modelReportHtml(*asset, facts, partsWithoutThree(), "0.0.1");
    for (const physics::BodyProfile& body : asset->profile.bodies)
        CHECK_THAT(page, Catch::Contains("<td>" + body.name + "</td>"));
    for (const physics::Finding& finding : facts.checkup.diagnosis.findings)
        CHECK_THAT(page, Catch::Contains("<b>" + finding.code + "</b>"));
    for (const char* title :
         {"<h3>Energy</h3>", "<h3>Joint separation</h3>", "<h3>Limit violation</h3>", "<h3>Time to rest</h3>"})
        CHECK_THAT(page, Catch::Contains(title));
    const auto data = nlohmann::json::parse(dataOf(page));
    REQUIRE(data["drops"].size() == 3);
    CHECK(data["drops"][0]["poses"] == 181);
    CHECK(data["drops"][0]["settle"] > data["drops"][0]["contact"]);
    CHECK(page.find("{{") == std::string::npos);
    CHECK(page == modelReportHtml(*asset, gatherFacts(*asset), partsWithoutThree(), "0.0.1"));
}

TEST_CASE("a page refers to nothing outside itself") {
    const auto asset = test::bipedRagdoll();
    const std::string page = modelReportHtml(*asset, gatherFacts(*asset), partsWithoutThree(), "0.0.1");
    for (const char* reference : {"src=\"http", "href=\"http", "url(http", "@import", "src=\"/", "src=\"//"})
        CHECK(page.find(reference) == std::string::npos);
    CHECK_THAT(page, Catch::Contains("default-src 'none'"));
}

TEST_CASE("names out of files stay text wherever a page shows them") {
    const std::string evil = "</script><script>alert(1)</script>\"'<img src=x onerror=alert(2)>";
    auto asset = test::bipedRagdoll();
    asset->character.name = evil;
    asset->character.file = evil;
    asset->character.warnings.push_back(evil);
    asset->character.meshes.front().name = evil;
    for (auto& name : asset->character.skeleton.names)
        name += evil;
    for (auto& body : asset->profile.bodies) {
        body.name += evil;
        body.mirror += body.mirror.empty() ? "" : evil;
    }
    ModelFacts facts;  // the profile is no longer valid; what matters is what is written
    facts.checkup.diagnosis.findings.push_back({physics::Severity::warning, evil, evil, evil, evil, true, {evil}});
    facts.checkup.diagnosis.parts.push_back({evil, 1, 2});
    facts.checkup.bounds.push_back({evil, evil, 1, 2});
    facts.pictures.push_back({evil, "png"});
    const std::string page = modelReportHtml(*asset, facts, partsWithoutThree(), evil);
    CHECK(page.find("<script>alert") == std::string::npos);
    CHECK(page.find("<img src=x") == std::string::npos);
    // Our own three script elements, and no other.
    std::size_t scripts = 0;
    for (std::size_t at = page.find("<script"); at != std::string::npos; at = page.find("<script", at + 1))
        ++scripts;
    CHECK(scripts == 3);
    CHECK(nlohmann::json::parse(dataOf(page))["meshes"][0]["name"] == evil);
}

TEST_CASE("the verdict counts errors before warnings") {
    scene::Checkup checkup;
    CHECK(verdictOf(checkup) == "Sound");
    checkup.diagnosis.findings.push_back({physics::Severity::warning, "", "", "", "", false, {}});
    CHECK(verdictOf(checkup) == "Sound, with 1 warning");
    checkup.diagnosis.findings.push_back({physics::Severity::error, "", "", "", "", false, {}});
    checkup.diagnosis.findings.push_back({physics::Severity::error, "", "", "", "", false, {}});
    CHECK(verdictOf(checkup) == "Not sound: 2 errors");
}

TEST_CASE("without drops the page says so and shows the figure standing") {
    const auto asset = test::bipedRagdoll();
    const std::string page = modelReportHtml(*asset, {}, partsWithoutThree(), "0.0.1");
    CHECK_THAT(page, Catch::Contains("a ragdoll with errors is not simulated"));
    CHECK(nlohmann::json::parse(dataOf(page))["drops"][0]["poses"] == 1);
}
