// --figure on the commands that take a model, and what finds its figure again.
#include <nlohmann/json.hpp>

#include "animation/import/figure_file.hpp"
#include "support/catch.hpp"
#include "support/command.hpp"

using namespace lutka::test;
using Json = nlohmann::json;

namespace {

/// A file of two figures, the second one smaller and of more vertices.
struct PairFile {
    ScratchFolder folder;
    std::string model;

    PairFile() : model(shellQuoted(folder / "pair.glb")) { makePair().saveBinary(folder / "pair.glb"); }
    [[nodiscard]] double heightOf(const std::string& options) const {
        const std::string profile = folder / "height.ragdoll.json";
        const CommandResult built = lutkaCommand("build " + model + " " + options + " -o " + shellQuoted(profile));
        REQUIRE(built.code == 0);
        return Json::parse(fileText(profile))["heightM"];
    }
};

}  // namespace

TEST_CASE("inspect lists the figures of a file and which is taken") {
    const PairFile pair;
    const CommandResult text = lutkaCommand("inspect " + pair.model);
    REQUIRE(text.code == 0);
    CHECK_THAT(text.out, Catch::Contains("figures    2") && Catch::Contains("Anna") && Catch::Contains("--figure 1"));
    const Json json = Json::parse(lutkaCommand("inspect --json --figure 1 " + pair.model).out);
    REQUIRE(json["figures"].size() == 2);
    CHECK(json["figures"][0]["name"] == "Anna");
    CHECK(json["figures"][0]["taken"] == true);
    CHECK(json["figures"][1]["name"] == "Bert");
    CHECK(json["figures"][1]["taken"] == false);
    const CommandResult one = lutkaCommand("inspect " + kMannequinArgument);
    CHECK_THAT(one.out, !Catch::Contains("figures"));
}

TEST_CASE("every command takes --figure, and refuses one that is not there as wrong usage") {
    const PairFile pair;
    CHECK(pair.heightOf("--figure 1") == Approx(pair.heightOf("--figure 2") / 0.8).epsilon(1e-3));
    CHECK(pair.heightOf("") == pair.heightOf("--figure 2"));
    for (const char* command : {"inspect", "map", "build", "check", "simulate", "bench --steps 10"}) {
        INFO(command);
        CHECK_THAT(lutkaCommand(std::string(command) + " --help").out, Catch::Contains("--figure"));
        const CommandResult none = lutkaCommand(std::string(command) + " " + pair.model + " --figure 3");
        CHECK(none.code == 2);
        CHECK_THAT(none.err, Catch::Contains("holds 2"));
    }
}

TEST_CASE("a replay takes the figure that was recorded") {
    const PairFile pair;
    const std::string recording = shellQuoted(pair.folder / "fall.rec");
    const std::string mesh = pair.folder / "last.obj";
    const std::string record = "simulate " + pair.model + " --figure 1 --seconds 0.1 --record " + recording;
    REQUIRE(lutkaCommand(record + " --mesh-out " + shellQuoted(mesh)).code == 0);
    const std::string first = fileText(mesh);
    const std::string replay = "simulate " + pair.model + " --replay " + recording;
    REQUIRE(lutkaCommand(replay + " --mesh-out " + shellQuoted(mesh)).code == 0);
    CHECK(fileText(mesh) == first);
}
