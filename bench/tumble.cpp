// What two seconds of free flight cost figures of angular momentum and energy, which nothing there can change: a line a
// figure and kind with the worst of all turns, and one with the worst of all.

#include "support/tumbling.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <glm/geometric.hpp>

#include "support/falls.hpp"

namespace {

using namespace lutka;

struct Kind {
    const char* name;
    physics::RagdollProfile (*change)(physics::RagdollProfile);
    test::Loss worst;
};

void take(test::Loss& to, const test::Loss& by) {
    to.angularMomentum = std::max(to.angularMomentum, by.angularMomentum);
    to.momentum = std::max(to.momentum, by.momentum);
    to.energy = std::max(to.energy, std::abs(by.energy));
    to.growth = std::max(to.growth, by.growth);
}

void print(const std::string& model, const char* kind, const test::Loss& loss) {
    fmt::print("{},{},{:.3f},{:.3f},{:.3f},{:.3f}\n", model, kind, 100.0 * loss.angularMomentum, 1e3 * loss.momentum,
               100.0 * loss.energy, 100.0 * loss.growth);
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
    std::vector<std::string> models;
    std::vector<float> rates{2.0F, 7.0F, 15.0F};
    std::string solverName = "crowd";
    CLI::App app("Lets figures tumble in empty space and tells what they lose of it");
    app.add_option("model", models, "rigged models")->required();
    app.add_option("--rates", rates, "rad/s")->delimiter(',');
    app.add_option("--solver", solverName, "stock, bullet or crowd");
    CLI11_PARSE(app, argc, argv);
    const physics::SolverKind solver = physics::solverNamed(solverName).value_or(physics::SolverKind::crowd);

    fmt::print("model,kind,angularMomentumPercent,driftMmps,energyPercent,growthPercent\n");
    Kind kinds[]{{"whole", [](physics::RagdollProfile profile) { return profile; }, {}},
                 {"without contacts", &test::withoutContacts, {}},
                 {"without losses", &test::withoutLosses, {}}};
    for (const std::string& model : models) {
        const auto loaded = test::loadFigure(model);
        if (!loaded) {
            fmt::print(stderr, "{}: {}\n", model, loaded.error().text());
            continue;
        }
        const scene::RagdollAsset& asset = *loaded.value();
        for (Kind& kind : kinds) {
            const physics::RagdollProfile profile = kind.change(asset.profile);
            test::Loss worst;
            for (const float rate : rates) {
                for (const vec3& axis : {vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1), vec3(1, 1, 1), vec3(1, -2, 0.5F)})
                    take(worst, test::tumble(asset, profile, *test::emptySpace(solver), rate * glm::normalize(axis)));
            }
            print(std::filesystem::path(model).string(), kind.name, worst);
            take(kind.worst, worst);
        }
    }
    for (const Kind& kind : kinds)
        print("all", kind.name, kind.worst);
    return 0;
}
