#include <fmt/format.h>

#include <charconv>
#include <memory>
#include <vector>

#include "commands.hpp"
#include "core/files.hpp"
#include "options.hpp"
#include "scene/benchmark.hpp"

namespace lutka::cli {
namespace {

struct Options {
    RagdollOptions ragdoll;
    std::vector<int> counts{1, 10, 100};
    std::vector<std::string> scenes{"spread", "pile"};
    int threads = 1;
    int steps = 300;
    std::string solver = "bullet";
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

void run(Options& options) {
    if (options.ragdoll.model.model.empty()) {
        options.ragdoll.model.model = orLeave(findAsset("models/mannequin.glb"));
    }
    const auto asset = orLeave(scene::loadRagdoll(options.ragdoll.model.model, options.ragdoll.load()));
    if (!options.json) {
        fmt::print("{} beside stock Bullet; median ms a step, {} thread(s), sleeping {}\n", options.solver,
                   options.threads, options.sleeping ? "on" : "off");
        fmt::print("{:<8} {:>6} {:>10} {:>10} {:>8} {:>9} {:>9} {:>9} {:>9} {:>8}\n", "SCENE", "DOLLS", "OURS", "STOCK",
                   "RATIO", "SEP mm", "(stock)", "PEN mm", "(stock)", "CONTACTS");
    }
    std::vector<scene::BenchResult> results;
    for (const std::string& name : options.scenes) {
        for (const int count : options.counts) {
            const scene::BenchCase what{
                name, count, options.threads, solverFromName(options.solver), options.sleeping, options.steps};
            results.push_back(orLeave(scene::runBenchmark(*asset, what)));
            if (!options.json) printRow(results.back());
        }
    }
    if (options.json) fmt::print("{}", scene::benchmarkJson(results));
    if (!options.csv.empty()) orLeave(writeFileAtomically(options.csv, scene::benchmarkCsv(results)));
}

}  // namespace

void addBench(CLI::App& app) {
    auto options = std::make_shared<Options>();
    CLI::App* command =
        app.add_subcommand("bench", "Time our solver beside stock Bullet, interleaved, with the quality");
    options->ragdoll.addTo(*command, false);
    command->add_option("--count", options->counts, "numbers of dolls, comma separated")
        ->delimiter(',')
        ->check(CLI::Range(1, 10000))
        ->capture_default_str();
    command->add_option("--scene", options->scenes, "scenes, comma separated")->delimiter(',')->capture_default_str();
    command->add_option("--threads", options->threads, "threads to step with")
        ->check(CLI::Range(1, 256))
        ->capture_default_str();
    command->add_option("--steps", options->steps, "steps of 1/60 s a case")
        ->check(CLI::Range(10, 100000))
        ->capture_default_str();
    addSolverOption(*command, options->solver);
    command->add_flag("--sleeping", options->sleeping, "let dolls at rest sleep");
    command->add_option("--csv", options->csv, "write the figures as CSV");
    command->add_flag("--json", options->json, "print the figures as JSON on stdout");
    command->callback([options] { run(*options); });
}

}  // namespace lutka::cli
