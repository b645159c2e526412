#include "support/catch.hpp"
#include "support/command.hpp"

using namespace lutka::test;

namespace {}  // namespace

TEST_CASE("export: the ending or --format chooses the format, and what is lost is told") {
    const ScratchFolder folder;
    const CommandResult byEnding = lutkaCommand("export " + kMannequinArgument + " -o " + folder / "doll.xml");
    CHECK(byEnding.code == 0);
    CHECK_THAT(byEnding.err, Catch::Contains("leftUpperArm: the elliptic cone is an octagon"));
    const CommandResult byName = lutkaCommand("export " + kMannequinArgument + " -o - --format mjcf");
    CHECK(byName.code == 0);
    CHECK(byName.out == fileText(folder / "doll.xml"));
}

TEST_CASE("export: an ending that names no format, an unknown format and a folder that is no folder are refused") {
    const ScratchFolder folder;
    const CommandResult unknown = lutkaCommand("export " + kMannequinArgument + " -o " + folder / "doll.txt");
    CHECK(unknown.code == 2);
    CHECK_THAT(unknown.err,
               Catch::Contains("--format") && Catch::Contains(".xml, .glb, .gltf, .tscn, .py, .urdf, .cpp, .usda"));
    CHECK(lutkaCommand("export " + kMannequinArgument + " -o - --format nothing").code == 2);
    CHECK(lutkaCommand("export " + kMannequinArgument).code == 2);
    CHECK(lutkaCommand("export " + kMannequinArgument + " -o /dev/null/doll.xml").code == 5);
}

TEST_CASE("a glTF file's own ragdoll is taken and told, and --refit fits a new one") {
    const ScratchFolder folder;
    const std::string model = folder / "doll.glb";
    const std::string profile = folder / "doll.ragdoll.json";
    REQUIRE(lutkaCommand("export " + kMannequinArgument + " -o " + model + " --mass 90").code == 0);
    const CommandResult own = lutkaCommand("build " + model + " -o " + profile);
    CHECK(own.code == 0);
    CHECK_THAT(own.err, Catch::Contains("the ragdoll is the file's own"));
    CHECK_THAT(own.out, Catch::Contains("90.0 kg, 16 bodies"));
    const CommandResult refit = lutkaCommand("build --refit " + model);
    CHECK(refit.err.find("own") == std::string::npos);
    CHECK_THAT(refit.out, Catch::Contains("75.0 kg, 16 bodies"));
    // It holds together as any other.
    CHECK(lutkaCommand("simulate --seconds 1 " + model).code == 0);
}
