#include "scene/run/run_inputs.hpp"

#include <filesystem>
#include <fstream>

#include "support/catch.hpp"
#include "support/command.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using namespace lutka::scene;

namespace {

struct Dropped {
    std::unique_ptr<RagdollAsset> asset = std::move(makeRagdoll(test::makeBiped())).value();

    [[nodiscard]] std::unique_ptr<Simulation> begin(int threads = 1) const {
        auto scenario = makeScenario({.name = "balls", .count = 1, .seed = 3}, *asset);
        REQUIRE(scenario.ok());
        SimulationOptions options;
        options.world.threads = threads;
        auto made = Simulation::create(*asset, std::move(scenario).value(), options);
        REQUIRE(made.ok());
        return std::move(made).value();
    }
};

RunInputs eventful() {
    RunInputs inputs;
    inputs.hits.push_back({10, 0, 2, {0, 20, 40}, {0, 0.05F, 0}});
    inputs.pulls.push_back({20, 80, 0, 6, {0, 0, 0}, {0.5F, 2, 0}, 900.0F});
    return inputs;
}

// Runs for 150 steps with the pushes and pulls of `inputs`, and notes what comes of it.
RunInputs recorded(const Dropped& dropped, const RunInputs& inputs) {
    const auto simulation = dropped.begin();
    RunInputs noted = beginInputs(*simulation, "test");
    noted.hits = inputs.hits;
    noted.pulls = inputs.pulls;
    InputPlayer player(inputs, *simulation);
    for (int step = 0; step < 150; ++step) {
        player.beforeStep();
        simulation->step();
        noteStep(*simulation, step == 149, noted);
    }
    return noted;
}

std::optional<InputDifference> replayed(Simulation& simulation, const RunInputs& inputs) {
    InputPlayer player(inputs, simulation);
    for (auto found = differenceFrom(simulation, inputs);; found = differenceFrom(simulation, inputs)) {
        if (found || simulation.steps() == inputs.steps) return found;
        player.beforeStep();
        simulation.step();
    }
}

}  // namespace

TEST_CASE("a run from the same inputs passes all of their checks, at any number of threads") {
    const Dropped dropped;
    const RunInputs inputs = recorded(dropped, eventful());
    CHECK(inputs.steps == 150);
    REQUIRE(inputs.checks.size() == 4);
    CHECK(inputs.checks[0].step == 0);
    CHECK(inputs.checks[2].step == 120);
    CHECK(inputs.checks[3].step == 150);
    for (const int threads : {1, 3}) {
        const auto again = dropped.begin(threads);
        CHECK_FALSE(replayed(*again, inputs).has_value());
        CHECK(again->world().drags().empty());
    }
}

TEST_CASE("pushes and pulls of the inputs move the doll, and the first difference is told with its step and body") {
    const Dropped dropped;
    RunInputs inputs = recorded(dropped, eventful());
    SECTION("a push that was not there") {
        inputs.hits.clear();
        const auto again = dropped.begin();
        const auto difference = replayed(*again, inputs);
        REQUIRE(difference.has_value());
        CHECK(difference->step == 60);
        CHECK(difference->doll == 0);
    }
    SECTION("a pull that was not there") {
        inputs.pulls.clear();
        const auto again = dropped.begin();
        CHECK(replayed(*again, inputs).has_value());
    }
    SECTION("one body") {
        inputs.checks[2].bodies[5] ^= 1U;
        const auto again = dropped.begin();
        const auto difference = replayed(*again, inputs);
        REQUIRE(difference.has_value());
        CHECK(difference->step == 120);
        CHECK(difference->doll == 0);
        CHECK(difference->body == 5);
        CHECK(difference->differing == 1);
    }
    SECTION("a prop") {
        inputs.checks[0].bodies.back() ^= 1U;
        const auto again = dropped.begin();
        const auto difference = replayed(*again, inputs);
        REQUIRE(difference.has_value());
        CHECK(difference->step == 0);
        CHECK(difference->doll == -1);
    }
    SECTION("another number of bodies") {
        inputs.checks[0].bodies.pop_back();
        const auto again = dropped.begin();
        CHECK(replayed(*again, inputs).has_value());
    }
}

TEST_CASE("inputs that name a doll or body that is not there are left out") {
    const Dropped dropped;
    RunInputs inputs;
    inputs.hits = {{0, 7, 0, {0, 1, 0}, {0, 0, 0}}, {0, 0, 99, {0, 1, 0}, {0, 0, 0}}};
    inputs.pulls = {{0, 5, 3, 0, {0, 0, 0}, {0, 1, 0}, 100.0F}, {4, 4, 0, 0, {0, 0, 0}, {0, 1, 0}, 100.0F}};
    CHECK(recorded(dropped, inputs).checks == recorded(dropped, {}).checks);
}

TEST_CASE("inputs come back from their file as they were") {
    const Dropped dropped;
    RunInputs inputs = recorded(dropped, eventful());
    inputs.settings = {{"scene", "balls"}, {"seed", "3"}};
    const auto read = inputsFromJson(inputsToJson(inputs), "test");
    REQUIRE(read.ok());
    CHECK(read.value() == inputs);
    CHECK(isInputsFile("a/fall.inputs.json"));
    CHECK_FALSE(isInputsFile("a/fall.json"));
}

TEST_CASE("faults of an inputs file are told with their pointers") {
    const Dropped dropped;
    const std::string good = inputsToJson(recorded(dropped, eventful()));
    const auto refused = [&](const std::string& what, const std::string& with) {
        std::string text = good;
        const std::size_t at = text.find(what);
        REQUIRE(at != std::string::npos);
        text.replace(at, what.size(), with);
        const auto read = inputsFromJson(text, "test");
        REQUIRE_FALSE(read.ok());
        CHECK(read.error().code == ErrorCode::input);
        return read.error().text();
    };
    CHECK_THAT(refused("lutka.inputs", "lutka.other"), Catch::Contains("format"));
    CHECK_THAT(refused("\"steps\": 150", "\"steps\": 1.5"), Catch::Contains("/steps"));
    CHECK_THAT(refused("\"until\": 80", "\"until\": -1"), Catch::Contains("/pulls/0/until"));
    CHECK_THAT(refused("\"maxForceN\": 900", "\"maxForceN\": 1e999"), Catch::Contains("/pulls/0/maxForceN"));
    CHECK_THAT(refused("\"bodies\": \"", "\"bodies\": \"xyzw"), Catch::Contains("/checks/0/bodies"));
    CHECK_THAT(refused("\"settings\": {}", "\"settings\": 3"), Catch::Contains("/settings"));
    CHECK_THAT(refused("\"profile\": \"", "\"profile\": \"g"), Catch::Contains("/profile"));
}

TEST_CASE("a huge inputs file is refused by its size, before it is read") {
    const test::ScratchFolder folder;
    const std::filesystem::path file = folder / "huge.inputs.json";
    std::ofstream(file) << "{";
    std::filesystem::resize_file(file, std::uintmax_t{2} << 30U);
    const auto read = loadInputs(file);
    REQUIRE_FALSE(read.ok());
    CHECK(read.error().code == ErrorCode::input);
    CHECK_THAT(read.error().message, Catch::Contains("is larger than 67108864 bytes"));
}
