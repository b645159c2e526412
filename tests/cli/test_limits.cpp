#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "support/catch.hpp"
#include "support/command.hpp"

using namespace lutka::test;
using Json = nlohmann::json;

// Runs at the limits that the options and docs/scene.md name, and one beyond each.
namespace {

const std::string kProgram = "'" LUTKA_BINARY "' ";

// A field of boxes that stand still, `count` of them.
Json fieldOfBoxes(int count) {
    Json entities = Json::array();
    for (int i = 0; i < count; ++i) {
        entities.push_back({{"id", i + 1},
                            {"name", "box " + std::to_string(i)},
                            {"transform", {{"translation", {i % 200, 0.5, i / 200}}}},
                            {"collider", {{"kind", "box"}, {"halfExtents", {0.2, 0.2, 0.2}}}}});
    }
    return {{"format", "lutka.scene"}, {"version", 1}, {"entities", entities}};
}

}  // namespace

TEST_CASE("as many dolls as --count allows fall and stay finite, one more is wrong usage") {
    const CommandResult most =
        runCommand(kProgram + "simulate " + kMannequinArgument + " --scene spread --count 10000 --seconds 0.05 --json");
    REQUIRE(most.code == 0);
    const Json report = Json::parse(most.out);
    CHECK(report["count"] == 10000);
    CHECK(report["quality"]["nonFinite"] == 0);
    CHECK(report["quality"]["jointSeparationM"]["max"].get<double>() < 1e-3);
    const CommandResult more =
        runCommand(kProgram + "simulate " + kMannequinArgument + " --scene spread --count 10001");
    CHECK(more.code == 2);
    CHECK_THAT(more.err, Catch::Contains("--count") && Catch::Contains("10000"));
}

TEST_CASE("a scene of as many entities as a file may have is checked and run, one more is refused by number") {
    const ScratchFolder folder;
    const auto file = folder / "field.scene.json";
    std::ofstream(file) << fieldOfBoxes(20000).dump();
    const CommandResult most = runCommand(kProgram + "scene '" + file + "' --json");
    CHECK(most.code == 0);
    CHECK(Json::parse(most.out)["entities"].size() == 20000);
    std::ofstream(file) << fieldOfBoxes(20001).dump();
    const CommandResult more = runCommand(kProgram + "scene '" + file + "'");
    CHECK(more.code == 3);
    CHECK_THAT(more.err, Catch::Contains("20000"));
}

TEST_CASE("a file that we may not read is told as that, whatever reads it") {
    const ScratchFolder folder;
    // root reads everything, unless it lays that down.
    const std::string plain = ::geteuid() == 0 ? "setpriv --bounding-set -dac_override,-dac_read_search " : "";
    const std::vector<std::pair<std::string, std::string>> uses = {
        {"figure.glb", "check "},
        {"figure.fbx", "check "},
        {"figure.dae", "check "},
        {"figure.glb", "check --in-process "},
        {"doll.ragdoll.json", "check " + kMannequinArgument + " --profile "},
        {"place.scene.json", "scene "}};
    for (const auto& [name, command] : uses) {
        INFO(command << name);
        const std::string file = folder / name;
        std::ofstream(file) << "kept from others";
        std::filesystem::permissions(file, std::filesystem::perms::none);
        const CommandResult result = runCommand(plain + kProgram + command + shellQuoted(file));
        CHECK(result.code == 3);
        CHECK_THAT(result.err, Catch::Contains(name) && Catch::Contains("Permission denied") &&
                                   Catch::Contains("permissions of the file"));
        std::filesystem::remove(file);
    }
}
