#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "scene/asset/ragdoll_asset.hpp"
#include "scene/batch/batch_plan.hpp"
#include "scene/run/simulation.hpp"

namespace lutka::scene {

/// How a row of a batch stands.
enum class RowState {
    missing,  ///< Was never finished, or with other inputs.
    done,
    failed,  ///< Has a file that says why; tried again by the next run.
};

struct RowOutcome {
    RowState state = RowState::missing;
    std::string reason;  ///< Of a failed one.
};

/// Runs the rows of a batch one by one and keeps each one's outcome in a file of its own under `out`
/// (rows/NNN/NNNNNNNNN.json, clips/NNN/NNNNNNNNN.glb), written whole or not at all: whoever ends the process at any
/// moment loses the row at work and no other. A row is known by its inputs, bytes of files included, and by `maker`;
/// one that is there already is not run again.
class Batch {
  public:
    struct Settings {
        std::filesystem::path out;
        std::string maker;                        ///< The program and its version.
        LoadOptions load;                         ///< How models are read; profile and rig are each model's own.
        std::function<void()> afterStep = [] {};  ///< Called between steps; may throw to give up.
    };
    Batch(BatchPlan plan, Settings settings);
    ~Batch();
    Batch(const Batch&) = delete;
    Batch& operator=(const Batch&) = delete;

    [[nodiscard]] const BatchPlan& plan() const { return plan_; }
    /// What an earlier run left of it; reads the row's file, and its inputs the first time.
    [[nodiscard]] RowOutcome outcome(std::size_t row);
    /// Runs it, whatever is there, and writes its files. A row that fails is an outcome; fails with ErrorCode::output
    /// when it can't be written.
    [[nodiscard]] Result<RowOutcome> run(std::size_t row);
    /// All rows as CSV in the batch's order (columns: docs/cli.md). The same rows give the same bytes, whoever ran
    /// them.
    [[nodiscard]] std::string summary();

  private:
    struct Cast;
    struct RowFile {
        bool done = false;
        std::string error;
        std::string line;  // of the summary
    };
    [[nodiscard]] std::string fingerprint(const BatchRow& row);
    [[nodiscard]] const std::string& bytesHash(const std::filesystem::path& file);
    [[nodiscard]] std::filesystem::path fileOf(const char* kind, std::size_t row, const char* ending) const;
    [[nodiscard]] Result<Cast> load(const BatchRow& row) const;
    [[nodiscard]] Result<const Cast*> castOf(const BatchRow& row);
    [[nodiscard]] Result<std::unique_ptr<Simulation>> begin(const BatchRow& row);
    [[nodiscard]] Result<std::string> fall(std::size_t row);
    [[nodiscard]] std::optional<RowFile> read(std::size_t row);
    [[nodiscard]] std::string lineOf(std::size_t row, RowState state, const std::string& figures,
                                     const std::string& reason) const;

    BatchPlan plan_;
    Settings settings_;
    std::map<std::filesystem::path, std::string> hashes_;
    std::unique_ptr<Result<Cast>> cast_;
    std::optional<BatchRow> castOf_;  // the row that cast_ was loaded for
};

}  // namespace lutka::scene
