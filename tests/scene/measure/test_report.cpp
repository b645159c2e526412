#include "scene/measure/report.hpp"

#include <nlohmann/json.hpp>
#include <vector>

#include "scene/measure/checkup.hpp"
#include "support/catch.hpp"
#include "support/ragdolls.hpp"

using namespace lutka;
using namespace lutka::scene;

TEST_CASE("step times are summarised by mean, median and 99th percentile") {
    std::vector<float> ms(101);
    for (std::size_t i = 0; i < ms.size(); ++i)
        ms[i] = static_cast<float>(100 - i);
    const StepSummary times = summarise(ms);
    CHECK(times.mean == Approx(50));
    CHECK(times.p50 == Approx(50));
    CHECK(times.p99 == Approx(99));
    CHECK(summarise({}).mean == 0.0F);
}

TEST_CASE("the report is one JSON document with every key of the contract") {
    const auto asset = test::bipedRagdoll();
    auto scenario = makeScenario({.name = "drop", .count = 2, .seed = 1}, *asset);
    REQUIRE(scenario);
    const auto simulation = Simulation::create(*asset, std::move(scenario).value(), {});
    REQUIRE(simulation);
    for (int step = 0; step < 30; ++step)
        simulation.value()->step();
    const auto json = nlohmann::json::parse(reportJson(*simulation.value()));
    for (const char* key : {"model", "scene", "count", "seconds", "dt", "substeps", "threads", "steps", "stateHash",
                            "wallMsPerStep", "quality", "fit", "seed", "bodies", "constraints"}) {
        INFO(key);
        CHECK(json.contains(key));
    }
    for (const char* key : {"jointSeparationM", "limitViolationDeg", "floorPenetrationM", "selfPenetrationM",
                            "energyGrowthJ", "settleSeconds", "residualSpeedMps", "nonFinite"}) {
        INFO(key);
        CHECK(json["quality"].contains(key));
    }
    CHECK(json["count"] == 2);
    CHECK(json["steps"] == 30);
    CHECK(json["bodies"] == 2 * asset->profile.bodies.size());
    CHECK(json["quality"]["settleSeconds"].is_null());
    CHECK(json["stateHash"].get<std::string>().size() == 16);
}

TEST_CASE("the report tells the substeps that steps of its length have") {
    const auto asset = test::bipedRagdoll();
    const auto substepsOf = [&](float dt, std::optional<int> told) {
        SimulationOptions options;
        options.dt = dt;
        options.world.substeps = told;
        auto scenario = makeScenario({.name = "drop"}, *asset);
        REQUIRE(scenario);
        const auto simulation = Simulation::create(*asset, std::move(scenario).value(), options);
        REQUIRE(simulation);
        simulation.value()->step();
        return nlohmann::json::parse(reportJson(*simulation.value()))["substeps"].get<int>();
    };
    CHECK(substepsOf(1.0F / 60.0F, {}) == 6);
    CHECK(substepsOf(0.05F, {}) == 18);
    CHECK(substepsOf(1.0F / 240.0F, {}) == 2);
    CHECK(substepsOf(0.05F, 4) == 4);
}

TEST_CASE("the text's figures have their points below each other, also that of a doll that is not at rest") {
    const auto asset = test::bipedRagdoll();
    auto scenario = makeScenario({.name = "drop", .count = 1}, *asset);
    REQUIRE(scenario);
    const auto simulation = Simulation::create(*asset, std::move(scenario).value(), {});
    REQUIRE(simulation);
    for (int step = 0; step < 10; ++step)
        simulation.value()->step();
    const std::string text = reportText(*simulation.value());
    const auto pointOf = [&](const char* what) {
        const std::size_t line = text.find(what);
        REQUIRE(line != std::string::npos);
        return text.find('.', line) - line;
    };
    CHECK(pointOf("not at rest") == pointOf("energy growth"));
}

TEST_CASE("a finding about the whole ragdoll names no place") {
    const auto asset = test::bipedRagdoll();
    Checkup checkup;
    checkup.diagnosis.findings = {{physics::Severity::info, "not-humanoid", "", "no body has a role", "", false, {}}};
    CHECK(checkupText(*asset, checkup).find("not-humanoid: no body has a role") != std::string::npos);
}
