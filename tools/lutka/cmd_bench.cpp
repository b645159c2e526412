#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "bench_frames.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "core/files.hpp"
#include "options.hpp"
#include "outputs.hpp"
#include "own_process.hpp"
#include "scene/description/scene_file.hpp"
#include "scene/measure/benchmark.hpp"

namespace lutka::cli {
namespace {

struct BenchCommandOptions {
    RagdollOptions ragdoll;
    std::vector<int> counts{1, 10, 100};
    std::vector<std::string> scenes{"spread", "pile"};
    std::vector<int> threads{1};
    std::vector<std::string> modes{"compare"};
    std::vector<std::string> vsync{"off"};
    std::string size = "1280x720";
    int warmUp = 60;
    float caseSeconds = 20.0F;
    int steps = 300;
    std::string solver = "crowd";
    bool sleeping = false;
    std::filesystem::path csv;
    bool json = false;
};

void printRow(const scene::BenchResult& r) {
    tell(
        "{:<8} {:>6} {:>7} {:>10.3f} {:>10.3f} {:>8.2f} {:>9.1f} {:>9.1f} {:>9.1f} {:>9.1f} {:>8} {:>10.0f} {:>9.0f}\n",
        r.what.scene, r.what.count, r.what.threads, r.ours.p50, r.stock.p50, r.speedup,
        r.quality.jointSeparationM.max * 1e3F, r.stockQuality.jointSeparationM.max * 1e3F,
        r.quality.floorPenetrationM * 1e3F, r.stockQuality.floorPenetrationM * 1e3F, r.contacts, r.dollStepsPerSecond(),
        r.realTimeDollsPerCore());
    std::fflush(stdout);
}

void printHeader(const BenchCommandOptions& options) {
    tell("{} beside stock Bullet; median ms a step, sleeping {}; RATIO is the median of blocks of steps in turn\n",
         options.solver, options.sleeping ? "on" : "off");
    tell("{:<8} {:>6} {:>7} {:>10} {:>10} {:>8} {:>9} {:>9} {:>9} {:>9} {:>8} {:>10} {:>9}\n", "SCENE", "DOLLS",
         "THREADS", "OURS", "STOCK", "RATIO", "SEP mm", "(stock)", "PEN mm", "(stock)", "CONTACTS", "DOLLSTEP/s",
         "REAL/CORE");
}

/// Runs the cases of the scenes, the named ones with the model, and takes their results.
class Bench {
  public:
    explicit Bench(const BenchCommandOptions& options) : options_(options) {}

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
            for (const int threads : options_.threads)
                add(orLeave(scene::runBenchmark(*asset_, caseOf(name, count, threads))));
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
        for (const int threads : options_.threads)
            add(orLeave(
                scene::runBenchmark(entities, cast, caseOf(entities.name, static_cast<int>(dolls.size()), threads))));
    }

    [[nodiscard]] scene::BenchCase caseOf(const std::string& name, int count, int threads) const {
        return {name, count, threads, solverFromName(options_.solver), options_.sleeping, options_.steps};
    }

    void add(scene::BenchResult result) {
        results.push_back(std::move(result));
        if (!options_.json && !isStandardOutput(options_.csv)) printRow(results.back());
    }

    const BenchCommandOptions& options_;
    std::unique_ptr<scene::RagdollAsset> asset_;
};

void compare(const BenchCommandOptions& options) {
    const bool printed = isStandardOutput(options.csv);
    if (!options.json && !printed) printHeader(options);
    Bench bench(options);
    for (const std::string& name : options.scenes)
        bench.run(name);
    if (options.json && !printed) fmt::print("{}", scene::benchmarkJson(bench.results));
    if (!options.csv.empty()) orLeave(writeFileAtomically(options.csv, scene::benchmarkCsv(bench.results)));
}

// All of them, in the order of the lists. Without a window there is no display to wait for.
std::vector<FrameCase> casesOf(const BenchCommandOptions& options) {
    FrameCase one;
    one.solver = solverFromName(options.solver);
    one.sleeping = options.sleeping;
    one.warmUp = options.warmUp;
    one.frames = options.steps;
    one.seconds = options.caseSeconds;
    one.size = parseSize(options.size);
    std::vector<FrameCase> cases;
    const auto add = [&](const std::string& vsync) {
        one.vsync = vsync == "on";
        if (!one.vsync || one.window) cases.push_back(one);
    };
    for (const std::string& mode : options.modes) {
        one.window = mode == "window";
        for (const std::string& scene : options.scenes) {
            one.scene = scene;
            for (const int threads : options.threads) {
                one.threads = threads;
                for (const int count : options.counts) {
                    one.count = count;
                    for (const std::string& vsync : options.vsync)
                        add(vsync);
                }
            }
        }
    }
    return cases;
}

// RFC 4180.
std::string csvLine(const std::vector<std::string>& cells) {
    std::string line;
    for (const std::string& cell : cells) {
        std::string quoted = cell;
        if (cell.find_first_of(",\"\n") != std::string::npos) {
            quoted = "\"";
            for (const char c : cell)
                quoted += c == '"' ? std::string("\"\"") : std::string(1, c == '\n' ? ' ' : c);
            quoted += '"';
        }
        line += (line.empty() ? "" : ",") + quoted;
    }
    return line + "\n";
}

// The cells as the process of its own gives them, one a line.
std::vector<std::string> measureApart(const BenchCommandOptions& options, const std::filesystem::path& model,
                                      const FrameCase& what) {
    const auto text = inOwnProcess([&] {
        const auto asset = scene::loadRagdoll(model, options.ragdoll.load());
        const auto figures = asset ? measureFrames(*asset.value(), what) : Result<FrameFigures>(asset.error());
        std::string lines;
        for (std::string cell : frameCells(what, figures)) {
            std::replace(cell.begin(), cell.end(), '\n', ' ');
            lines += cell + '\n';
        }
        return lines;
    });
    if (!text) return frameCells(what, text.error());
    std::vector<std::string> cells;
    std::size_t at = 0;
    for (std::size_t end = 0; (end = text.value().find('\n', at)) != std::string::npos; at = end + 1)
        cells.push_back(text.value().substr(at, end - at));
    return cells;
}

void printCells(const std::vector<std::string>& cells) {
    const auto& names = frameColumns();
    const auto cell = [&](const char* name) {
        return cells[static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin())];
    };
    tell("{:<8} {:<8} {:>6} {:>7} {:>5} {:>8} {:>9} {:>9} {:>9} {:>9}  {}\n", cell("mode"), cell("scene"),
         cell("count"), cell("threads"), cell("vsync"), cell("fps"), cell("simulate_ms"), cell("pose_ms"),
         cell("draw_ms"), cell("show_ms"), cell("error"));
    std::fflush(stdout);
}

std::string sweepJson(const std::vector<std::vector<std::string>>& rows) {
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const auto& cells : rows) {
        nlohmann::ordered_json one;
        for (std::size_t i = 0; i < cells.size(); ++i) {
            const auto number = nlohmann::ordered_json::parse(cells[i], nullptr, false);
            one[frameColumns()[i]] = number.is_number() ? number : nlohmann::ordered_json(cells[i]);
        }
        json.push_back(std::move(one));
    }
    return nlohmann::ordered_json{{"cases", std::move(json)}}.dump(2, ' ', false,
                                                                   nlohmann::ordered_json::error_handler_t::replace) +
           "\n";
}

void sweep(const BenchCommandOptions& options) {
    std::filesystem::path model = options.ragdoll.model.model;
    if (model.empty()) model = orLeave(findAsset("models/mannequin.glb"));
    const std::vector<FrameCase> cases = casesOf(options);
    if (cases.empty()) {
        leave({ErrorCode::usage, "there is no display to wait for without a window", "--vsync",
               "add --mode window, or --vsync off"});
    }
    if (!options.json) printCells(frameColumns());
    std::string csv = csvLine(frameColumns());
    std::vector<std::vector<std::string>> rows;
    for (const FrameCase& what : cases) {
        rows.push_back(measureApart(options, model, what));
        csv += csvLine(rows.back());
        if (!options.json) printCells(rows.back());
        // After each: a sweep that is ended has what it measured.
        if (!options.csv.empty()) orLeave(writeFileAtomically(options.csv, csv));
    }
    if (options.json) fmt::print("{}", sweepJson(rows));
    const auto failed = [](const auto& cells) { return !cells.back().empty(); };
    if (std::all_of(rows.begin(), rows.end(), failed))
        leave({ErrorCode::noDisplay, "no case could be measured: " + rows.front().back(), {}, {}});
}

void runBench(const BenchCommandOptions& options) {
    const bool compares = options.modes == std::vector<std::string>{"compare"};
    if (!compares && std::find(options.modes.begin(), options.modes.end(), "compare") != options.modes.end()) {
        leave({ErrorCode::usage, "compare goes with no other mode", "--mode",
               "run it by itself: its figures are others"});
    }
    std::vector<std::filesystem::path> inputs{options.ragdoll.model.model, options.ragdoll.profile.value_or("")};
    std::copy_if(options.scenes.begin(), options.scenes.end(), std::back_inserter(inputs),
                 [](const std::string& name) { return scene::isSceneFile(name); });
    keepInputs(options.csv, inputs);
    compares ? compare(options) : sweep(options);
}

}  // namespace

void addBench(const Command& app) {
    auto options = std::make_shared<BenchCommandOptions>();
    const Command command =
        app.add("bench", "Time our solver beside stock Bullet, or whole frames over numbers of dolls");
    options->ragdoll.addTo(command, false);
    command.option("--count", options->counts, "numbers of dolls, comma separated")
        .commaSeparated()
        .range(1, 10000)
        .showDefault();
    command.option("--scene", options->scenes, "scenes or files *.scene.json, comma separated")
        .commaSeparated()
        .showDefault();
    command.option("--threads", options->threads, "numbers of threads to step with, comma separated")
        .commaSeparated()
        .range(1, 256)
        .showDefault();
    command.option("--steps", options->steps, "steps of 1/60 s a case; frames of a sweep")
        .range(10, 100000)
        .showDefault();
    command
        .option(
            "--mode", options->modes,
            "compare: our solver beside stock; headless, window: a sweep of whole frames, each case in a process of "
            "its own; comma separated")
        .commaSeparated()
        .oneOf({"compare", "headless", "window"})
        .showDefault();
    command.option("--vsync", options->vsync, "on, off: whether a window waits for the display, comma separated")
        .commaSeparated()
        .oneOf({"on", "off"})
        .showDefault();
    command.option("--size", options->size, "WIDTHxHEIGHT of a sweep's pictures").showDefault();
    command.option("--warm-up", options->warmUp, "frames of a sweep's case before it is measured")
        .range(0, 100000)
        .showDefault();
    command.option("--case-seconds", options->caseSeconds, "a sweep's case ends early after so long")
        .range(0.1, 3600.0)
        .showDefault();
    addSolverOption(command, options->solver);
    command.flag("--sleeping", options->sleeping, "let dolls at rest sleep");
    command.option("--csv", options->csv, "write the figures as CSV; - for stdout");
    command.flag("--json", options->json, "print the figures as JSON on stdout");
    command.onRun([options] { runBench(*options); });
}

}  // namespace lutka::cli
