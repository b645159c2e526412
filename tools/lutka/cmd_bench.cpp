#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <memory>
#include <vector>

#include "commands.hpp"
#include "core/files.hpp"
#include "options.hpp"
#include "scene/benchmark.hpp"
#include "scene/scene_file.hpp"

namespace lutka::cli {
namespace {

struct Options {
    RagdollOptions ragdoll;
    std::vector<int> counts{1, 10, 100};
    std::vector<std::string> scenes{"spread", "pile"};
    int threads = 1;
    int steps = 300;
    std::string solver = "crowd";
    bool sleeping = false;
    std::filesystem::path csv;
    bool json = false;
};

void printRow(const scene::BenchResult& r) {
    fmt::print("{:<8} {:>6} {:>10.3f} {:>10.3f} {:>8.2f} {:>9.1f} {:>9.1f} {:>9.1f} {:>9.1f} {:>8}\n", r.what.scene,
               r.what.count, r.ours.p50, r.stock.p50, r.speedup, r.quality.jointSeparationM.max * 1e3F,
               r.stockQuality.jointSeparationM.max * 1e3F, r.quality.floorPenetrationM * 1e3F,
               r.stockQuality.floorPenetrationM * 1e3F, r.contacts);
    std::fflush(stdout);
}

void printHeader(const Options& options) {
    fmt::print("{} beside stock Bullet; median ms a step, {} thread(s), sleeping {}\n", options.solver, options.threads,
               options.sleeping ? "on" : "off");
    fmt::print("{:<8} {:>6} {:>10} {:>10} {:>8} {:>9} {:>9} {:>9} {:>9} {:>8}\n", "SCENE", "DOLLS", "OURS", "STOCK",
               "RATIO", "SEP mm", "(stock)", "PEN mm", "(stock)", "CONTACTS");
}

/// Runs the cases of the scenes, the named ones with the model, and takes their results.
class Bench {
  public:
    explicit Bench(const Options& options) : options_(options) {}

    void run(const std::string& name) { scene::isSceneFile(name) ? runFile(name) : runNamed(name); }
    std::vector<scene::BenchResult> results;

  private:
    void runNamed(const std::string& name) {
        // Loaded when it is needed: a scene file may bring all characters along.
        if (asset_ == nullptr) {
            std::filesystem::path model = options_.ragdoll.model.model;
            if (model.empty()) model = orLeave(findAsset("models/mannequin.glb"));
            asset_ = orLeave(scene::loadRagdoll(model, options_.ragdoll.load()));
        }
        for (const int count : options_.counts)
            add(orLeave(scene::runBenchmark(*asset_, caseOf(name, count))));
    }

    void runFile(const std::string& name) {
        const auto entities = orLeave(scene::loadScene(name));
        const auto& dolls = entities.all<scene::Ragdoll>();
        const bool needsModel =
            std::any_of(dolls.begin(), dolls.end(), [](const auto& doll) { return doll.model.empty(); });
        std::filesystem::path model;
        if (needsModel) model = options_.ragdoll.model.model;
        if (needsModel && model.empty()) model = orLeave(findAsset("models/mannequin.glb"));
        const auto cast = orLeave(scene::loadCast(entities, model, options_.ragdoll.load()));
        add(orLeave(scene::runBenchmark(entities, cast, caseOf(entities.name, static_cast<int>(dolls.size())))));
    }

    [[nodiscard]] scene::BenchCase caseOf(const std::string& name, int count) const {
        return {name, count, options_.threads, solverFromName(options_.solver), options_.sleeping, options_.steps};
    }

    void add(scene::BenchResult result) {
        results.push_back(std::move(result));
        if (!options_.json) printRow(results.back());
    }

    const Options& options_;
    std::unique_ptr<scene::RagdollAsset> asset_;
};

void run(const Options& options) {
    if (!options.json) printHeader(options);
    Bench bench(options);
    for (const std::string& name : options.scenes)
        bench.run(name);
    if (options.json) fmt::print("{}", scene::benchmarkJson(bench.results));
    if (!options.csv.empty()) orLeave(writeFileAtomically(options.csv, scene::benchmarkCsv(bench.results)));
}

}  // namespace

void addBench(const Command& app) {
    auto options = std::make_shared<Options>();
    const Command command = app.add("bench", "Time our solver beside stock Bullet, interleaved, with the quality");
    options->ragdoll.addTo(command, false);
    command.option("--count", options->counts, "numbers of dolls, comma separated")
        .commaSeparated()
        .range(1, 10000)
        .showDefault();
    command.option("--scene", options->scenes, "scenes or files *.scene.json, comma separated")
        .commaSeparated()
        .showDefault();
    command.option("--threads", options->threads, "threads to step with").range(1, 256).showDefault();
    command.option("--steps", options->steps, "steps of 1/60 s a case").range(10, 100000).showDefault();
    addSolverOption(command, options->solver);
    command.flag("--sleeping", options->sleeping, "let dolls at rest sleep");
    command.option("--csv", options->csv, "write the figures as CSV");
    command.flag("--json", options->json, "print the figures as JSON on stdout");
    command.onRun([options] { run(*options); });
}

}  // namespace lutka::cli
