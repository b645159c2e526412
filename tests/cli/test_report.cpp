#include <fstream>
#include <nlohmann/json.hpp>

#include "support/catch.hpp"
#include "support/command.hpp"
#include "support/skip.hpp"

using namespace lutka::test;
using Json = nlohmann::json;
namespace fs = std::filesystem;

namespace {

bool hasThree() {
    return fs::exists("/usr/share/javascript/three/three.min.js") || std::getenv("LUTKA_THREE_JS") != nullptr;
}

const std::string kModel = LUTKA_ASSETS_DIR "/models/mannequin.glb";

}  // namespace

TEST_CASE("report: one page holds the model's score, charts, pictures and view, and asks nothing of the network") {
    if (!hasThree()) SKIP_TEST("three.js is not installed (libjs-three)");
    const ScratchFolder folder;
    const std::string file = folder / "page.html";
    const CommandResult result = lutkaCommand("report " + kMannequinArgument + " -o " + file);
    REQUIRE(result.code == 0);
    CHECK_THAT(result.out, Catch::Contains("of 100") && Catch::Contains("wrote " + file));
    const std::string page = fileText(file);
    CHECK(page.starts_with("<!doctype html>"));
    CHECK_THAT(page, Catch::Contains("<h1>mannequin</h1>") && Catch::Contains("leftUpperArm") &&
                         Catch::Contains("SkinnedMesh"));
    for (const char* reference : {"src=\"http", "href=\"http", "@import"})
        CHECK(page.find(reference) == std::string::npos);
    CHECK(filesIn(folder.path) == 1);
}

TEST_CASE("report: the page goes to stdout alone, and --json tells the doctor's facts beside a file") {
    if (!hasThree()) SKIP_TEST("three.js is not installed (libjs-three)");
    const ScratchFolder folder;
    const CommandResult page = lutkaCommand("report --no-pictures -o - " + kMannequinArgument);
    CHECK(page.code == 0);
    CHECK(page.out.starts_with("<!doctype html>"));
    CHECK(page.out.ends_with("</html>\n"));
    const std::string same = folder / "same.html";
    const CommandResult json = lutkaCommand("report --no-pictures --json -o " + same + " " + kMannequinArgument);
    CHECK(Json::parse(json.out)["drops"].size() == 3);
    CHECK(fileText(same) == page.out);  // the same bytes each time
}

TEST_CASE("report: a missing three.js is told with what mends it, before any work") {
    const CommandResult result =
        runCommand("env LUTKA_THREE_JS=/nowhere/three.min.js '" LUTKA_BINARY "' report -o - " + kMannequinArgument);
    CHECK(result.code == 3);
    CHECK(result.out.empty());
    CHECK_THAT(result.err, Catch::Contains("/nowhere/three.min.js"));
}

TEST_CASE("report: another ending than .html, a folder with a profile and a refused model are told") {
    const ScratchFolder folder;
    CHECK(lutkaCommand("report " + kMannequinArgument + " -o " + folder / "page.pdf").code == 2);
    CHECK(lutkaCommand("report " + kMannequinArgument).code == 2);
    CHECK(lutkaCommand("report " + shellQuoted(folder.path) + " --profile x.ragdoll.json -o - ").code == 2);
    CHECK(lutkaCommand("report " + folder / "no.glb" + " -o " + folder / "page.html").code == 3);
    CHECK_FALSE(fs::exists(folder / "page.html"));
}

TEST_CASE("report: a folder gives one table and what can't be read is in it with its reason and stops nothing") {
    const ScratchFolder folder;
    fs::create_directory(folder.path / "sub");
    fs::copy_file(kModel, folder.path / "sub" / "man & <b>.glb");
    std::ofstream(folder.path / "broken.glb") << "glTF";
    std::ofstream(folder.path / "notes.txt") << "no model";
    const std::string file = folder / "library.html";
    const CommandResult result =
        lutkaCommand("report --no-pictures --json -o " + file + " " + shellQuoted(folder.path));
    REQUIRE(result.code == 0);
    const Json json = Json::parse(result.out);
    REQUIRE(json["models"].size() == 1);
    CHECK(json["models"][0]["model"] == "sub/man & <b>.glb");
    CHECK(json["models"][0]["score"] > 50);
    REQUIRE(json["refused"].size() == 1);
    CHECK(json["refused"][0]["model"] == "broken.glb");
    CHECK_FALSE(json["refused"][0]["why"].get<std::string>().empty());
    const std::string page = fileText(file);
    CHECK_THAT(page, Catch::Contains("sub/man &amp; &lt;b&gt;.glb") && Catch::Contains("broken.glb"));
    CHECK(page.find("notes.txt") == std::string::npos);
}
