// soak [SECONDS] [SOLVER]: a hundred dolls thrown about for an hour of simulated time, 100,000 added and removed on the
// way (docs/reliability.md). Prints what came of it; exit code 1 when an id was lost, a number was not finite, memory
// grew by more than 1 MB after warming up, or steps became more than a tenth slower.
#include <fmt/format.h>

#include <cstdlib>

#include "support/soak.hpp"

int main(int argc, char** argv) {
    using namespace lutka;
    test::SoakOptions options;
    options.seconds = argc > 1 ? std::atof(argv[1]) : 3600.0;
    options.warmUpSeconds = options.seconds / 20.0;
    if (argc > 2) options.solver = physics::solverNamed(argv[2]).value_or(options.solver);
    const test::SoakResult result = test::soak(options);
    fmt::print("solver,steps,added,caught,memory growth MB,step ms early,step ms late,wrong\n");
    fmt::print("{},{},{},{},{:.3f},{:.3f},{:.3f},{}\n", physics::solverName(options.solver), result.steps, result.added,
               result.caught, result.residentGrowthMb, result.stepMsEarly, result.stepMsLate, result.wrong);
    const bool slower = result.stepMsLate > 1.1 * result.stepMsEarly;
    return !result.wrong.empty() || result.residentGrowthMb > 1.0 || slower ? 1 : 0;
}
