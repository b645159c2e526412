#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "support/catch.hpp"
#include "support/command.hpp"

using namespace lutka::test;
using Json = nlohmann::json;

namespace {

const std::string kLutkaBinary = "'" LUTKA_BINARY "' ";

std::string writeList(const ScratchFolder& folder, int seeds, bool broken = false) {
    Json list{{"format", "lutka.batch"},
              {"version", 1},
              {"models", {LUTKA_ASSETS_DIR "/models/mannequin.glb"}},
              {"scenes", {"drop", "stairs"}},
              {"seeds", {{"from", 0}, {"count", seeds}}},
              {"seconds", 0.5}};
    if (broken) list["models"].push_back("broken.glb");
    const std::string file = folder / "list.json";
    std::ofstream(file) << list.dump();
    return file;
}

}  // namespace

TEST_CASE("a batch that is killed by force goes on and gives the summary of one that was not") {
    const ScratchFolder folder;
    const std::string list = writeList(folder, 8);
    REQUIRE(lutkaCommand("batch " + list + " --out " + (folder / "one")).code == 0);
    const std::string wanted = fileText(folder / "one/summary.csv");
    // Killed once some rows are there, twice; what was half written has no name that counts.
    runCommand("sh -c \"for shard in 1 2; do " + kLutkaBinary + "batch " + list + " --out " + (folder / "two") +
               " --shard \\$shard/2 & child=\\$!; for i in \\$(seq 100); do sleep 0.05; "
               "[ \\$(ls " +
               (folder / "two/rows/000") +
               " | wc -l) -ge \\$((shard * 2)) ] && break; done; kill -KILL \\$child; done\"");
    const CommandResult first = lutkaCommand("batch " + list + " --out " + (folder / "two") + " --shard 1/2 --json");
    REQUIRE(first.code == 0);
    CHECK_FALSE(std::filesystem::exists(folder / "two/summary.csv"));
    CHECK(Json::parse(first.out)["rows"] == 8);
    const CommandResult rest = lutkaCommand("batch " + list + " --out " + (folder / "two") + " --json");
    REQUIRE(rest.code == 0);
    const Json tally = Json::parse(rest.out);
    CHECK(tally["doneBefore"].get<int>() >= 8);
    CHECK(tally["doneBefore"].get<int>() + tally["doneNow"].get<int>() == 16);
    CHECK(fileText(folder / "two/summary.csv") == wanted);
    CHECK(lutkaCommand("batch " + list + " --out " + (folder / "two")).out ==
          "16 of 16 rows: 16 done before, 0 now, 0 failed\n");
}

TEST_CASE("a batch with rows that fail names them, ends with 3 and keeps the others") {
    const ScratchFolder folder;
    const std::string list = writeList(folder, 1, true);
    for (int run = 0; run < 2; ++run) {
        const CommandResult result = lutkaCommand("batch " + list + " --out " + (folder / "out"));
        CHECK(result.code == 3);
        CHECK_THAT(result.err, Catch::Contains("row 2: broken.glb, drop, seed 0: ") && Catch::Contains("row 3: "));
        CHECK_THAT(result.out, Catch::Contains("2 failed"));
    }
    const std::string summary = fileText(folder / "out/summary.csv");
    CHECK_THAT(summary, Catch::Contains("2,broken.glb,,humanoid,drop,0,1,failed,") && Catch::Contains(",done,"));
}

TEST_CASE("a model of gigabytes fails its row without being taken into memory") {
    const ScratchFolder folder;
    const std::string list = folder / "list.json";
    std::ofstream(list)
        << R"({"format":"lutka.batch","version":1,"models":["huge.glb"],"scenes":["drop"],"seeds":[1]})";
    std::ofstream(folder / "huge.glb") << "glTF";
    std::filesystem::resize_file(folder / "huge.glb", std::uintmax_t{7} << 29U);
    const CommandResult result = runCommand("sh -c 'ulimit -v 2000000; exec \"$@\"' sh " + kLutkaBinary + "batch " +
                                            list + " --out " + (folder / "out"));
    CHECK(result.code == 3);
    CHECK_THAT(result.err, Catch::Contains("row 0: huge.glb"));
}

TEST_CASE("wrong lists and shards are refused by name") {
    const ScratchFolder folder;
    const std::string list = writeList(folder, 1);
    CHECK(lutkaCommand("batch " + list + " --out " + (folder / "out") + " --shard 3/2").code == 2);
    CHECK(lutkaCommand("batch " + list).code == 2);
    std::ofstream(list) << "{}";
    const CommandResult result = lutkaCommand("batch " + list + " --out " + (folder / "out"));
    CHECK(result.code == 3);
    CHECK_THAT(result.err, Catch::Contains("format"));
    CHECK(lutkaCommand("batch nowhere.json --out " + (folder / "out")).code == 3);
}

TEST_CASE("a sweep of frames measures each case in a process of its own and writes a CSV") {
    const ScratchFolder folder;
    const std::string csv = folder / "sweep.csv";
    const CommandResult result = lutkaCommand(
        "bench --mode headless --count 1,3 --scene spread --threads 1,2 --vsync off,on --steps 10 --warm-up 2 --size "
        "64x64 --json --csv " +
        csv + " " + kMannequinArgument);
    NEEDS_DISPLAY_OF(result);
    REQUIRE(result.code == 0);
    const Json cases = Json::parse(result.out)["cases"];
    REQUIRE(cases.size() == 4);  // without a window there is no VSync
    for (const Json& one : cases) {
        CHECK(one["frames"] == 10);
        CHECK(one["fps"].get<double>() > 0.0);
        const double parts = one["simulate_ms"].get<double>() + one["pose_ms"].get<double>() +
                             one["draw_ms"].get<double>() + one["show_ms"].get<double>();
        CHECK(parts == Approx(one["frame_ms"].get<double>()).epsilon(0.01));
        CHECK(one["error"] == "");
    }
    CHECK((cases[1]["count"] == 3 && cases[2]["threads"] == 2));
    const std::string text = fileText(csv);
    CHECK(std::count(text.begin(), text.end(), '\n') == 5);
}

TEST_CASE("a sweep tells what can't be measured") {
    const CommandResult window = lutkaCommand("bench --mode window --count 1 --steps 10");
    CHECK(window.code == 6);  // no display
    const CommandResult nothing = lutkaCommand("bench --mode headless --vsync on --count 1");
    CHECK(nothing.code == 2);
    CHECK_THAT(nothing.err, Catch::Contains("--vsync"));
    CHECK(lutkaCommand("bench --mode compare,headless --count 1").code == 2);
}
