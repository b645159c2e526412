#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <thread>

#include "scene/measure/benchmark.hpp"
#include "scene/measure/quality_json.hpp"

namespace lutka::scene {
namespace {

using Json = nlohmann::ordered_json;

// "model name of the processor, N threads", as far as the system tells.
std::string machineName() {
    std::ifstream info("/proc/cpuinfo");
    std::string line;
    while (std::getline(info, line)) {
        const std::size_t colon = line.find(": ");
        if (line.starts_with("model name") && colon != std::string::npos) {
            return fmt::format("{}, {} threads", line.substr(colon + 2), std::thread::hardware_concurrency());
        }
    }
    return fmt::format("unknown processor, {} threads", std::thread::hardware_concurrency());
}

Json timesJson(const StepSummary& times) {
    return {{"mean", times.mean}, {"p50", times.p50}, {"p99", times.p99}};
}

Json caseJson(const BenchResult& result) {
    Json json;
    json["scene"] = result.what.scene;
    json["count"] = result.what.count;
    json["threads"] = result.what.threads;
    json["solver"] = physics::solverName(result.what.solver);
    json["sleeping"] = result.what.sleeping;
    json["msPerStep"] = timesJson(result.ours);
    json["stockMsPerStep"] = timesJson(result.stock);
    json["speedup"] = result.speedup;
    json["dollStepsPerSecond"] = result.dollStepsPerSecond();
    json["realTimeDollsPerCore"] = result.realTimeDollsPerCore();
    json["quality"] = qualityJson(result.quality);
    json["stockQuality"] = qualityJson(result.stockQuality);
    json["contacts"] = result.contacts;
    json["memoryBytes"] = result.memoryBytes;
    return json;
}

}  // namespace

double BenchResult::dollStepsPerSecond() const {
    const auto mean = static_cast<double>(ours.mean);
    return mean > 0.0 ? 1e3 * what.count / mean : 0.0;
}

double BenchResult::realTimeDollsPerCore() const {
    constexpr double kStepsPerSecond = 60.0;
    return dollStepsPerSecond() / kStepsPerSecond / std::max(what.threads, 1);
}

std::string benchmarkJson(std::span<const BenchResult> results) {
    Json json;
    json["machine"] = machineName();
    json["cases"] = Json::array();
    for (const BenchResult& result : results)
        json["cases"].push_back(caseJson(result));
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string benchmarkCsv(std::span<const BenchResult> results) {
    std::string csv =
        "scene,count,threads,solver,sleeping,ms_p50,ms_p99,stock_ms_p50,stock_ms_p99,speedup,separation_max_m,"
        "stock_separation_max_m,penetration_max_m,stock_penetration_max_m,doll_penetration_max_m,"
        "doll_penetration_p99_m,stock_doll_penetration_max_m,stock_doll_penetration_p99_m,residual_mps,stock_residual_"
        "mps,contacts,"
        "memory_bytes\n";
    for (const BenchResult& r : results) {
        csv += fmt::format(
            "{},{},{},{},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.3f},{:.5f},{:.5f},{:.5f},{:.5f},{:.5f},{:.5f},{:.5f},{:.5f},"
            "{:.5f},{:.5f},{},{}\n",
            r.what.scene, r.what.count, r.what.threads, physics::solverName(r.what.solver), r.what.sleeping, r.ours.p50,
            r.ours.p99, r.stock.p50, r.stock.p99, r.speedup, r.quality.jointSeparationM.max,
            r.stockQuality.jointSeparationM.max, r.quality.floorPenetrationM, r.stockQuality.floorPenetrationM,
            r.quality.dollPenetrationM.max, r.quality.dollPenetrationM.p99, r.stockQuality.dollPenetrationM.max,
            r.stockQuality.dollPenetrationM.p99, r.quality.residualSpeedMps, r.stockQuality.residualSpeedMps,
            r.contacts, r.memoryBytes);
    }
    return csv;
}

}  // namespace lutka::scene
