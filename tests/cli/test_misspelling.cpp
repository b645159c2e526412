#include "lutka/misspelling.hpp"

#include <vector>

#include "support/catch.hpp"

using lutka::cli::likelyMeant;

namespace {

const std::vector<std::string> kCommands = {"inspect", "map",      "build",    "check", "report", "export", "scene",
                                            "render",  "simulate", "retarget", "edit",  "bench",  "batch"};
const std::vector<std::string> kOptions = {"--max-bodies", "--seconds", "--seed", "--mass", "--mass-table", "--output"};

}  // namespace

TEST_CASE("a single change finds the word, in words of two letters too, capitals aside") {
    CHECK(likelyMeant("bulid", kCommands) == "build");
    CHECK(likelyMeant("exprt", kCommands) == "export");
    CHECK(likelyMeant("mp", kCommands) == "map");
    CHECK(likelyMeant("MA", kCommands) == "map");
    CHECK(likelyMeant("bULid", kCommands) == "build");
    CHECK(likelyMeant("BULID", kCommands) == "build");
    CHECK(likelyMeant("--SECNODS", kOptions) == "--seconds");
}

TEST_CASE("a word that is shortened begins as it does, with three letters at least") {
    CHECK(likelyMeant("sim", kCommands) == "simulate");
    CHECK(likelyMeant("--secs", kOptions) == "--seconds");
    CHECK(likelyMeant("--mass-t", kOptions) == "--mass-table");
    CHECK(likelyMeant("--out", kOptions) == "--output");
    CHECK(likelyMeant("--bodies", kOptions).empty());
}

TEST_CASE("nothing is guessed from a letter or two") {
    for (const char* given : {"-x", "-m", "--d", "--st", "x", "-", "--"}) {
        INFO(given);
        CHECK(likelyMeant(given, kOptions).empty());
    }
    CHECK(likelyMeant("x", kCommands).empty());
    CHECK(likelyMeant("xq", kCommands).empty());
}
