// What every command has: --quiet, --verbose, documents on stdout, colours on a terminal alone.
#include <nlohmann/json.hpp>

#include "support/catch.hpp"
#include "support/command.hpp"
#include "support/skip.hpp"

using namespace lutka::test;
using Json = nlohmann::json;

namespace {

const std::string kMissing = "'/nowhere/model.glb'";

bool coloured(const std::string& text) {
    return text.find("\x1B[") != std::string::npos;
}

}  // namespace

TEST_CASE("the option --quiet leaves the exit code, the files and the errors, before and after the command") {
    const ScratchFolder folder;
    for (const std::string& command :
         {"inspect " + kMannequinArgument, "map " + kMannequinArgument, "build " + kMannequinArgument,
          "check " + kMannequinArgument, std::string("scene stairs"),
          "export " + kMannequinArgument + " -o " + folder / "d.xml", "simulate --seconds 0.1 " + kMannequinArgument}) {
        INFO(command);
        for (const std::string& line : {"--quiet " + command, command + " -q"}) {
            const CommandResult result = lutkaCommand(line);
            CHECK(result.code == 0);
            CHECK(result.out.empty());
            CHECK(result.err.empty());
        }
    }
    CHECK_FALSE(fileText(folder / "d.xml").empty());
    const CommandResult failed = lutkaCommand("--quiet inspect " + kMissing);
    CHECK(failed.code == 3);
    CHECK_THAT(failed.err, Catch::Contains("/nowhere/model.glb"));
}

TEST_CASE("the option --quiet keeps what --json and -o - ask for") {
    CHECK(Json::parse(lutkaCommand("-q map --json " + kMannequinArgument).out)["humanoid"] == true);
    CHECK(Json::parse(lutkaCommand("-q build -o - " + kMannequinArgument).out)["format"] == "lutka-ragdoll");
}

TEST_CASE("the option --verbose tells on stderr what takes how long, and goes not with --quiet") {
    const CommandResult result = lutkaCommand("check --verbose " + kMannequinArgument);
    CHECK(result.code == 0);
    CHECK_THAT(result.err,
               Catch::Contains("reading and fitting") && Catch::Contains("examining") && Catch::Contains(" s\n"));
    CHECK(lutkaCommand("check " + kMannequinArgument).out == result.out);
    CHECK(lutkaCommand("-q -v scene stairs").code == 2);
}

TEST_CASE("every command that prints facts prints them as JSON") {
    const ScratchFolder folder;
    const std::string model = kMannequinArgument;
    for (const std::string& command :
         {"inspect " + model, "map " + model, "build " + model, "check " + model, std::string("scene stairs"),
          "simulate --seconds 0.1 " + model, "export -o " + folder / "d.xml" + " " + model,
          "bench --count 1 --scene spread --steps 10 " + model}) {
        INFO(command);
        const CommandResult result = lutkaCommand(command + " --json");
        CHECK(result.code == 0);
        CHECK_FALSE(Json::parse(result.out).empty());
    }
    const Json exported = Json::parse(lutkaCommand("export --json -o " + folder / "d.xml" + " " + model).out);
    CHECK(exported["format"] == "mjcf");
    CHECK(exported["bytes"] == fileText(folder / "d.xml").size());
    CHECK(exported["warnings"].size() > 3);
}

TEST_CASE("a document on stdout stands there alone, whichever output it is") {
    const std::string run = "simulate --seconds 0.1 " + kMannequinArgument;
    CHECK(Json::parse(lutkaCommand(run + " --report -").out)["steps"] == 6);
    CHECK(lutkaCommand(run + " --out -").out.starts_with("glTF"));
    CHECK(lutkaCommand(run + " --mesh-out -").out.starts_with("# Lutka"));
    CHECK(Json::parse(lutkaCommand("check --fix - " + kMannequinArgument).out)["format"] == "lutka-ragdoll");
    const CommandResult csv = lutkaCommand("bench --count 1 --scene spread --steps 10 --csv - " + kMannequinArgument);
    CHECK(csv.out.starts_with("scene,"));
    CHECK(lutkaCommand(run + " --report - --out -").code == 2);  // two documents
}

TEST_CASE("colours are for terminals, and NO_COLOR forbids them there") {
    CHECK_FALSE(coloured(lutkaCommand("inspect " + kMissing).err));
    NEEDS_PROGRAM("script");
    const auto onTerminal = [](const std::string& environment) {
        return runCommand("env " + environment + " TERM=xterm script -qec \"'" LUTKA_BINARY "' inspect " + kMissing +
                          "\" /dev/null")
            .out;
    };
    CHECK(coloured(onTerminal("-u NO_COLOR")));
    CHECK_FALSE(coloured(onTerminal("NO_COLOR=1")));
}

TEST_CASE("the option --licenses names every part with an SPDX identifier") {
    const CommandResult result = lutkaCommand("--licenses");
    CHECK(result.code == 0);
    for (const char* part : {"Bullet Physics", "Assimp", "three.js", "Zlib", "BSD-3-Clause", "MIT"})
        CHECK_THAT(result.out, Catch::Contains(part));
}

TEST_CASE("a misspelled command or option is named, with the one that was likely meant") {
    const auto wrong = [](const std::string& line) {
        const CommandResult result = lutkaCommand(line);
        CHECK(result.code == 2);
        CHECK(result.out.empty());
        return result.err;
    };
    using Catch::Contains;
    CHECK_THAT(wrong("bulid " + kMannequinArgument), Contains("There is no command 'bulid' (did you mean build?)"));
    CHECK_THAT(wrong("Simulate " + kMannequinArgument), Contains("did you mean simulate?"));
    CHECK_THAT(wrong("--quiet " + kMannequinArgument), Contains("There is no command") && !Contains("did you mean"));
    CHECK_THAT(wrong("build --presett loose " + kMannequinArgument),
               Contains("lutka build has no option --presett (did you mean --preset?)"));
    CHECK_THAT(wrong("simulate --secnods=1 " + kMannequinArgument), Contains("did you mean --seconds?"));
    CHECK_THAT(wrong("simulate --secs 1 " + kMannequinArgument), Contains("did you mean --seconds?"));
    CHECK_THAT(wrong("simulate --mass-t winter " + kMannequinArgument), Contains("did you mean --mass-table?"));
    CHECK_THAT(wrong("build --verbsoe " + kMannequinArgument), Contains("did you mean --verbose?"));
    CHECK_THAT(wrong("build --xylophone " + kMannequinArgument),
               Contains("has no option --xylophone") && !Contains("did you mean"));
    CHECK_THAT(wrong("build " + kMannequinArgument + " second.glb"), Contains("lutka build takes no 'second.glb'"));
    CHECK_THAT(wrong("build --preset losse " + kMannequinArgument), Contains("losse not in"));
    CHECK_THAT(wrong(""), Contains("A subcommand is required"));
}

TEST_CASE("an option that is missing because it is misspelled is named as it was written") {
    const auto wrong = [](const std::string& line) {
        const CommandResult result = lutkaCommand(line);
        CHECK(result.code == 2);
        return result.err;
    };
    using Catch::Contains;
    CHECK_THAT(wrong("export --ouput x.xml " + kMannequinArgument),
               Contains("lutka export has no option --ouput (did you mean --output?)"));
    CHECK_THAT(wrong("build --keep-shapes --profle=p.json " + kMannequinArgument),
               Contains("has no option --profle (did you mean --profile?)"));
    CHECK_THAT(wrong("export " + kMannequinArgument), Contains("--output is required"));
    CHECK_THAT(wrong("export second.glb " + kMannequinArgument), Contains("--output is required"));
}

TEST_CASE("two dashes are no option, and what follows them are words") {
    const auto wrong = [](const std::string& line) {
        const CommandResult result = lutkaCommand(line);
        CHECK(result.code == 2);
        CHECK_THAT(result.err, !Catch::Contains("has no option"));
        return result.err;
    };
    using Catch::Contains;
    CHECK_THAT(wrong("export -- " + kMannequinArgument), Contains("--output is required"));
    CHECK_THAT(wrong("build " + kMannequinArgument + " -- -second.glb"),
               Contains("lutka build takes no '-second.glb'"));
    CHECK_THAT(wrong("build -- " + kMannequinArgument + " -second.glb"),
               Contains("lutka build takes no '-second.glb'"));
    CHECK_THAT(wrong("-- bulid"), Contains("There is no command 'bulid' (did you mean build?)"));
}
