#include "support/catch.hpp"
#include "support/command.hpp"

using namespace lutka::test;

TEST_CASE("a recording is replayed to the same picture") {
    const ScratchFolder folder;
    const std::string common = "render " + kMannequinArgument + " --size 160x120 ";
    const CommandResult recorded =
        lutkaCommand(common + "--seconds 1 --record " + (folder / "run") + " -o " + (folder / "a.png"));
    NEEDS_DISPLAY_OF(recorded);
    REQUIRE(recorded.code == 0);
    REQUIRE(lutkaCommand(common + "--replay " + (folder / "run") + " -o " + (folder / "b.png")).code == 0);
    CHECK(fileText(folder / "a.png").size() > 2000);
    CHECK(fileText(folder / "a.png") == fileText(folder / "b.png"));
}

TEST_CASE("a recording of a doll of hulls is replayed to the same picture, hulls and all, and is no doll of capsules") {
    const ScratchFolder folder;
    const std::string common = "render " + kMannequinArgument + " --scene stairs --size 160x120 --debug solids ";
    const CommandResult recorded =
        lutkaCommand(common + "--hulls --seconds 1 --record " + (folder / "run") + " -o " + (folder / "a.png"));
    NEEDS_DISPLAY_OF(recorded);
    REQUIRE(recorded.code == 0);
    const std::string replay = "--replay " + (folder / "run") + " -o ";
    REQUIRE(lutkaCommand(common + "--hulls " + replay + (folder / "b.png")).code == 0);
    REQUIRE(lutkaCommand(common + replay + (folder / "c.png")).code == 0);
    CHECK(fileText(folder / "a.png").size() > 2000);
    CHECK(fileText(folder / "a.png") == fileText(folder / "b.png"));
    CHECK(fileText(folder / "a.png") != fileText(folder / "c.png"));
}

TEST_CASE("a recording brings its own scene and number of dolls, and one of other bodies is refused") {
    const ScratchFolder folder;
    const std::string recording = folder / "three";
    REQUIRE(
        lutkaCommand("simulate " + kMannequinArgument + " --seconds 0.2 --scene stairs --count 3 --record " + recording)
            .code == 0);
    CHECK(lutkaCommand("simulate " + kMannequinArgument + " --replay " + recording).code == 0);
    CHECK(lutkaCommand("simulate " + kMannequinArgument + " --scene drop --count 1 --replay " + recording).code == 0);
    const CommandResult other = lutkaCommand("simulate " + kMannequinArgument + " --bodies toes --replay " + recording);
    CHECK(other.code == 3);
    CHECK(other.err.find("16 bodies") != std::string::npos);
}
