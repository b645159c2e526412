// Times the `bullet` world against stock Bullet on the same scene, stepped in turn: at equal substeps and iterations
// (one substep of 10 sweeps, as stock has by default; 6 keep, 4 mend), and at its own defaults. Prints CSV: medians of
// the steps' times (of the stepping thread's processor) and of the steps' ratios.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <ctime>

#include "trial.hpp"

namespace {

using namespace lutka;
using bench::Trial;
using bench::TrialSettings;

struct Case {
    std::string scene;
    int count;
};

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

double processorMs() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

double stepMs(Trial& trial) {
    const double before = processorMs();
    trial.step();
    return processorMs() - before;
}

TrialSettings settingsOf(const Case& wanted, physics::SolverKind solver, bool sleeping, bool equal) {
    TrialSettings settings;
    settings.scene = wanted.scene;
    settings.count = wanted.count;
    settings.seed = 1;
    settings.measure = false;
    settings.world.solver = solver;
    settings.world.sleeping = sleeping;
    if (equal) {
        settings.tuning.substeps = 1;
        settings.tuning.sweeps = settings.tuning.leastSweeps = 6;
        settings.tuning.mendSweeps = 4;
    }
    return settings;
}

void compare(const scene::RagdollAsset& asset, const Case& wanted, int steps, bool sleeping, bool equal) {
    Trial stock(asset, settingsOf(wanted, physics::SolverKind::stock, sleeping, equal));
    Trial ours(asset, settingsOf(wanted, physics::SolverKind::bullet, sleeping, equal));
    std::vector<double> stockMs;
    std::vector<double> oursMs;
    std::vector<double> ratio;
    for (int i = 0; i < steps; ++i) {
        stockMs.push_back(stepMs(stock));
        oursMs.push_back(stepMs(ours));
        ratio.push_back(stockMs.back() / oursMs.back());
    }
    fmt::print("{},{},{},{},{:.3f},{:.3f},{:.2f}\n", wanted.scene, wanted.count, equal ? "equal" : "default",
               sleeping ? "on" : "off", median(stockMs), median(oursMs), median(ratio));
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
    std::string scene = "spread";
    std::vector<int> counts{100};
    int steps = 300;
    bool sleeping = false;
    bool defaults = false;
    bool equal = false;
    std::string alone;
    CLI::App app{"The bullet world's time beside stock Bullet's, as CSV"};
    app.add_option("--scene", scene);
    app.add_option("--counts", counts, "dolls")->delimiter(',');
    app.add_option("--steps", steps)->check(CLI::Range(1, 100000));
    app.add_flag("--sleeping", sleeping, "with sleeping on");
    app.add_flag("--equal", equal, "only at equal substeps and iterations");
    app.add_flag("--defaults", defaults, "only at the defaults");
    app.add_option("--alone", alone, "only steps this solver, for profilers: stock or bullet");
    CLI11_PARSE(app, argc, argv);
    const auto asset = bench::handMadeDoll();
    fmt::print("scene,count,settings,sleeping,stockMs,oursMs,ratio\n");
    for (const int count : counts) {
        if (!alone.empty()) {
            const auto solver = alone == "stock" ? physics::SolverKind::stock : physics::SolverKind::bullet;
            Trial trial(*asset, settingsOf({scene, count}, solver, sleeping, !defaults));
            for (int i = 0; i < steps; ++i)
                trial.step();
            continue;
        }
        if (!defaults) compare(*asset, {scene, count}, steps, sleeping, true);
        if (!equal) compare(*asset, {scene, count}, steps, sleeping, false);
    }
    return 0;
}
