#include "support/catch.hpp"
#include "support/command.hpp"

using namespace lutka::test;

namespace {

const std::string kExported = shellQuoted(LUTKA_ASSETS_DIR "/models/mannequin.glb");

}  // namespace

TEST_CASE("export: the ending or --format chooses the format, and what is lost is told") {
    const ScratchFolder folder;
    const CommandResult byEnding = lutkaCommand("export " + kExported + " -o " + folder / "doll.xml");
    CHECK(byEnding.code == 0);
    CHECK_THAT(byEnding.err, Catch::Contains("leftUpperArm: the elliptic cone is an octagon"));
    const CommandResult byName = lutkaCommand("export " + kExported + " -o - --format mjcf");
    CHECK(byName.code == 0);
    CHECK(byName.out == fileText(folder / "doll.xml"));
}

TEST_CASE("export: an ending that names no format, an unknown format and a folder that is no folder are refused") {
    const ScratchFolder folder;
    const CommandResult unknown = lutkaCommand("export " + kExported + " -o " + folder / "doll.txt");
    CHECK(unknown.code == 2);
    CHECK_THAT(unknown.err, Catch::Contains("--format"));
    CHECK(lutkaCommand("export " + kExported + " -o - --format nothing").code == 2);
    CHECK(lutkaCommand("export " + kExported).code == 2);
    CHECK(lutkaCommand("export " + kExported + " -o /dev/null/doll.xml").code == 5);
}
