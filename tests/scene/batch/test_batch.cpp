#include "scene/batch/batch.hpp"

#include <filesystem>
#include <fstream>

#include "scene/description/scenario.hpp"
#include "scene/description/scene_file.hpp"
#include "support/catch.hpp"
#include "support/command.hpp"

using namespace lutka;
using namespace lutka::scene;

namespace {

const std::string kDoll = LUTKA_ASSETS_DIR "/models/mannequin.glb";

std::string listOf(const std::string& members) {
    return R"({"format": "lutka.batch", "version": 1, )" + members + "}";
}

BatchPlan planOf(const std::string& members) {
    auto plan = batchFromJson(listOf(members), "list", "/");
    REQUIRE(plan);
    return std::move(plan).value();
}

Batch::Settings into(const test::ScratchFolder& folder) {
    Batch::Settings settings;
    settings.out = folder.path;
    settings.maker = "test";
    return settings;
}

void runAll(Batch& batch, const BatchShard& shard = {}) {
    for (std::size_t row = 0; row < batch.plan().rows.size(); ++row)
        if (shard.has(row) && batch.outcome(row).state != RowState::done) REQUIRE(batch.run(row));
}

const std::string kSmall =
    R"("models": [")" + kDoll + R"("], "scenes": ["drop", "ramp"], "seeds": [0, 5], "seconds": 0.2)";

}  // namespace

TEST_CASE("a batch has a row for every model and scene and seed in this order, and a scene file is one row a model") {
    const BatchPlan plan = planOf(R"("models": ["a.glb", {"model": "b.fbx", "profile": "b.json", "rig": "any"}],
        "scenes": ["drop", "hall.scene.json"], "seeds": {"from": 7, "count": 3}, "count": 2, "bake": true)");
    REQUIRE(plan.rows.size() == 8);
    CHECK(plan.models[1].profile == std::filesystem::path("/b.json"));
    CHECK(plan.models[1].rig == physics::RigKind::any);
    CHECK(plan.scenes[1].file == std::filesystem::path("/hall.scene.json"));
    CHECK((plan.rows[2].model == 0 && plan.rows[2].scene == 0 && plan.rows[2].seed == 9));
    CHECK((plan.rows[3].scene == 1 && plan.rows[4].model == 1 && plan.rows[4].seed == 7));
    CHECK((plan.count == 2 && plan.bake && !plan.seconds));
}

TEST_CASE("all that is wrong with a list is told at once, with its place") {
    const auto plan = batchFromJson(listOf(R"("models": [], "scenes": ["moon", 3], "seeds": [-1], "count": 0,
        "solver": "magic", "colour": "red")"),
                                    "list.json");
    REQUIRE_FALSE(plan);
    CHECK(plan.error().code == ErrorCode::input);
    for (const char* place : {"/models", "/scenes/0", "/scenes/1", "/seeds/0", "/count", "/solver", "colour"})
        CHECK_THAT(plan.error().message, Catch::Contains(place));
    CHECK_FALSE(batchFromJson("{", "list"));
    CHECK_FALSE(batchFromJson(R"({"format": "lutka.batch", "version": 2})", "list"));
    // More rows than a batch may have are refused before they are made.
    CHECK_FALSE(
        batchFromJson(listOf(R"("models": ["a", "b"], "scenes": ["drop", "pile", "ramp", "hang", "throw", "balls"],
        "seeds": {"from": 0, "count": 100000})"),
                      "list"));
}

TEST_CASE("shards part the rows, and nothing else is a shard") {
    for (std::size_t row = 0; row < 20; ++row) {
        int takers = 0;
        for (int number = 1; number <= 3; ++number)
            takers += BatchShard{number, 3}.has(row) ? 1 : 0;
        CHECK(takers == 1);
    }
    CHECK(parseBatchShard("3/8").value().number == 3);
    for (const char* text : {"", "3", "0/8", "9/8", "-1/8", "3/0", "3/8x", "a/b", "3/", "/8", "1/1000000"})
        CHECK_FALSE(parseBatchShard(text));
}

TEST_CASE("shards of a batch give the summary of one run, bit for bit, and done rows are not run again") {
    const test::ScratchFolder one;
    Batch whole(planOf(kSmall), into(one));
    CHECK(whole.outcome(0).state == RowState::missing);
    CHECK_THAT(whole.summary(), Catch::Contains(",missing,"));
    runAll(whole);
    const test::ScratchFolder parts;
    for (const int number : {2, 1}) {
        Batch shard(planOf(kSmall), into(parts));
        runAll(shard, {number, 2});
    }
    Batch again(planOf(kSmall), into(parts));
    for (std::size_t row = 0; row < 4; ++row)
        CHECK(again.outcome(row).state == RowState::done);
    CHECK(again.summary() == whole.summary());
    CHECK_THAT(whole.summary(), !Catch::Contains("missing"));
}

TEST_CASE("a row is run again when its inputs, its maker or its file have changed") {
    const test::ScratchFolder folder;
    Batch first(planOf(kSmall), into(folder));
    REQUIRE(first.run(0));
    CHECK(Batch(planOf(kSmall), into(folder)).outcome(0).state == RowState::done);
    std::string longer = kSmall;
    longer.replace(longer.find("0.2"), 3, "0.3");
    CHECK(Batch(planOf(longer), into(folder)).outcome(0).state == RowState::missing);
    Batch::Settings newer = into(folder);
    newer.maker = "another";
    CHECK(Batch(planOf(kSmall), newer).outcome(0).state == RowState::missing);
    const std::string file = folder / "rows/000/000000.json";
    for (const char* spoilt : {"", "{", "[]", "3", R"({"fingerprint": 3})", R"({"done": "yes", "line": "x"})"}) {
        std::ofstream(file) << spoilt;
        Batch reader(planOf(kSmall), into(folder));
        CHECK(reader.outcome(0).state == RowState::missing);
        CHECK_THAT(reader.summary(), Catch::Contains("missing"));
    }
}

TEST_CASE("a row that fails has its reason in the summary and is tried again when its model is mended") {
    const test::ScratchFolder folder;
    const std::string model = folder / "doll.glb";
    std::ofstream(model) << "no model";
    const std::string members =
        R"("models": [")" + model + R"(", ")" + kDoll + R"("], "scenes": ["drop"], "seconds": 0.1)";
    Batch batch(planOf(members), into(folder));
    const auto failed = batch.run(0);
    REQUIRE(failed);
    CHECK(failed.value().state == RowState::failed);
    CHECK_FALSE(failed.value().reason.empty());
    REQUIRE(batch.run(1));
    CHECK_THAT(batch.summary(), Catch::Contains(",failed,") && Catch::Contains(",done,"));
    std::filesystem::copy_file(kDoll, model, std::filesystem::copy_options::overwrite_existing);
    Batch mended(planOf(members), into(folder));
    CHECK(mended.outcome(0).state == RowState::missing);
    CHECK(mended.outcome(1).state == RowState::done);
    CHECK(mended.run(0).value().state == RowState::done);
}

TEST_CASE("scene files, clips and odd names") {
    const test::ScratchFolder folder;
    const std::string model = folder / "a \"doll\", of ours.glb";
    std::filesystem::copy_file(kDoll, model);
    auto scene = makeScene("stairs", 1, 0, {});
    REQUIRE(scene);
    REQUIRE(saveScene(folder / "own.scene.json", scene.value()));
    std::string name = model;
    for (std::size_t at = 0; (at = name.find('"', at)) != std::string::npos; at += 2)
        name.insert(at, "\\");
    Batch batch(planOf(R"("models": [")" + name + R"("], "scenes": [")" + (folder / "own.scene.json") +
                       R"("], "seeds": [1, 2, 3], "seconds": 0.1, "bake": true, "solver": "bullet")"),
                into(folder));
    REQUIRE(batch.plan().rows.size() == 1);
    REQUIRE(batch.run(0));
    CHECK(batch.outcome(0).state == RowState::done);
    CHECK(std::filesystem::file_size(folder / "clips/000/000000.glb") > 100'000);
    CHECK_THAT(batch.summary(), Catch::Contains("a \"\"doll\"\", of ours.glb\""));
}

TEST_CASE("a folder that can't be written ends a batch instead of marking rows as failed") {
    const test::ScratchFolder folder;
    std::ofstream(folder / "rows") << "in the way";
    Batch batch(planOf(kSmall), into(folder));
    const auto written = batch.run(0);
    REQUIRE_FALSE(written);
    CHECK(written.error().code == ErrorCode::output);
}
