#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "commands.hpp"
#include "console.hpp"
#include "core/files.hpp"
#include "interrupt.hpp"
#include "options.hpp"
#include "scene/batch/batch.hpp"

namespace lutka::cli {
namespace {

struct BatchCommandOptions {
    std::filesystem::path list;
    std::filesystem::path out;
    std::string shard;
    ModelOptions model;
    bool json = false;
};

struct Tally {
    std::size_t before = 0;  // done by an earlier run
    std::size_t now = 0;
    std::vector<std::pair<std::size_t, std::string>> failed;  // row and reason
};

std::string nameOf(const scene::BatchPlan& plan, std::size_t row) {
    const scene::BatchRow& what = plan.rows[row];
    return fmt::format("row {}: {}, {}, seed {}", row, plan.models[what.model].name, plan.scenes[what.scene].name,
                       what.seed);
}

Tally runRows(scene::Batch& batch, const std::vector<std::size_t>& rows) {
    Tally tally;
    Progress progress("batch", static_cast<int>(rows.size()));
    int done = 0;
    for (const std::size_t row : rows) {
        leaveIfInterrupted();
        progress.at(done++);
        if (batch.outcome(row).state == scene::RowState::done) {
            ++tally.before;
            continue;
        }
        const scene::RowOutcome outcome = orLeave(batch.run(row));
        if (outcome.state == scene::RowState::done)
            ++tally.now;
        else
            tally.failed.emplace_back(row, outcome.reason);
    }
    return tally;
}

void print(const BatchCommandOptions& options, const scene::BatchPlan& plan, std::size_t rows, const Tally& tally) {
    for (const auto& [row, reason] : tally.failed)
        spdlog::error("{}: {}", nameOf(plan, row), reason);
    if (!options.json) {
        tell("{} of {} rows: {} done before, {} now, {} failed\n", rows, plan.rows.size(), tally.before, tally.now,
             tally.failed.size());
        return;
    }
    nlohmann::ordered_json failed = nlohmann::ordered_json::array();
    for (const auto& [row, reason] : tally.failed)
        failed.push_back({{"row", row}, {"reason", reason}});
    const nlohmann::ordered_json json{{"rows", rows},
                                      {"of", plan.rows.size()},
                                      {"doneBefore", tally.before},
                                      {"doneNow", tally.now},
                                      {"failed", std::move(failed)}};
    fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

void runBatch(const BatchCommandOptions& options) {
    const scene::BatchShard shard =
        options.shard.empty() ? scene::BatchShard{} : orLeave(scene::parseBatchShard(options.shard));
    scene::Batch::Settings settings;
    settings.out = options.out;
    settings.maker = "lutka " LUTKA_VERSION;
    settings.load.import = options.model.import();
    settings.afterStep = leaveIfInterrupted;
    scene::BatchPlan plan = orLeave(scene::loadBatch(options.list));
    settings.load.import.loadTextures = plan.bake;
    scene::Batch batch(std::move(plan), settings);
    std::vector<std::size_t> rows;
    for (std::size_t row = 0; row < batch.plan().rows.size(); ++row)
        if (shard.has(row)) rows.push_back(row);
    const Tally tally = runRows(batch, rows);
    // Of parts that run side by side none knows when the others are done.
    if (options.shard.empty()) orLeave(writeFileAtomically(options.out / "summary.csv", batch.summary()));
    print(options, batch.plan(), rows.size(), tally);
    if (!tally.failed.empty()) throw Exit{static_cast<int>(ErrorCode::input)};
}

}  // namespace

void addBatch(const Command& app) {
    auto options = std::make_shared<BatchCommandOptions>();
    const Command command = app.add(
        "batch", "Run models x scenes x seeds of a list, resumable; without --shard a summary is written at the end");
    command.option("LIST", options->list, "the list (*.json, see docs/howto.md)").required();
    command.option("--out", options->out, "folder for the rows and summary.csv; what is there already is kept")
        .required();
    command.option("--shard", options->shard, "run a part of the rows alone: NUMBER/OF, as 3/8; writes no summary");
    command.option("--import-memory", options->model.importMemoryMiB, "MiB that reading a model may take")
        .range(64, 1 << 20)
        .showDefault();
    command.flag("--json", options->json, "print the tally as JSON on stdout");
    command.onRun([options] { runBatch(*options); });
}

}  // namespace lutka::cli
