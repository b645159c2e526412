#include "report/library_report.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

#include "support/catch.hpp"
#include "support/command.hpp"

using namespace lutka;
using namespace lutka::reporting;
namespace fs = std::filesystem;

namespace {

LibraryRow rowOf(const std::string& model, float score) {
    LibraryRow row;
    row.model = model;
    row.checkup.score = score;
    row.humanoid = true;
    row.mappingSure = 0.9F;
    row.checkup.drops.resize(3);
    for (physics::Quality& drop : row.checkup.drops)
        drop.settleSeconds = 1.5F;
    return row;
}

}  // namespace

TEST_CASE("models are found below a folder, in the order of their paths, and hidden ones are left alone") {
    const test::ScratchFolder folder;
    for (const char* made : {"b", "a/deep", ".hidden"})
        fs::create_directories(folder.path / made);
    for (const char* file : {"z.glb", "b/man.FBX", "a/deep/x.bvh", "a/readme.txt", ".hidden/no.glb", ".no.glb"})
        std::ofstream(folder.path / file) << "x";
    const auto found = modelsBelow(folder.path);
    REQUIRE(found);
    std::vector<std::string> names;
    for (const fs::path& file : found.value())
        names.push_back(file.lexically_relative(folder.path).string());
    CHECK(names == std::vector<std::string>{"a/deep/x.bvh", "b/man.FBX", "z.glb"});
    CHECK(modelsBelow(folder.path / "nowhere").error().code == ErrorCode::input);
}

TEST_CASE("the best score comes first, equal ones by name, refused ones by name") {
    Library library;
    library.rows = {rowOf("c", 50), rowOf("b", 90), rowOf("a", 50)};
    library.refused = {{"z", {}}, {"y", {}}};
    sortLibrary(library);
    CHECK(library.rows[0].model == "b");
    CHECK(library.rows[1].model == "a");
    CHECK(library.rows[2].model == "c");
    CHECK(library.refused[0].model == "y");
}

TEST_CASE("the library's page and its JSON tell every model, and why one was refused") {
    Library library;
    library.folder = "<folder>";
    library.rows = {rowOf("good<b>.glb", 91)};
    library.rows[0].checkup.diagnosis.findings = {{physics::Severity::warning, "mass-ratio", "a", "b", "c", false, {}}};
    library.rows[0].checkup.drops[1].settleSeconds.reset();
    library.refused = {{"tree.glb", {ErrorCode::input, "not a <humanoid>", "tree.glb", "try --rig any"}}};
    const auto parts = loadPageParts(PageKind::library);
    REQUIRE(parts);
    const std::string page = libraryReportHtml(library, parts.value(), "0.0.1");
    CHECK_THAT(page, Catch::Contains("good&lt;b&gt;.glb") && Catch::Contains("mass-ratio") && Catch::Contains("never"));
    CHECK_THAT(page, Catch::Contains("not a &lt;humanoid&gt;") && Catch::Contains("try --rig any"));
    CHECK(page.find("{{") == std::string::npos);
    const auto json = nlohmann::json::parse(libraryReportJson(library));
    CHECK(json["models"][0]["warnings"] == 1);
    CHECK(json["models"][0]["worst"]["settleSeconds"].is_null());
    CHECK(json["refused"][0]["why"] == "not a <humanoid>");
}

TEST_CASE("a library without a single ragdoll is still a page") {
    const auto parts = loadPageParts(PageKind::library);
    REQUIRE(parts);
    CHECK_THAT(libraryReportHtml({}, parts.value(), "0.0.1"), Catch::Contains("No model became a ragdoll"));
}
