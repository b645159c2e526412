#pragma once

#include <string>

#include "physics/world/world_settings.hpp"

namespace lutka::test {

struct SoakOptions {
    physics::SolverKind solver = physics::SolverKind::crowd;
    int dolls = 100;
    double seconds = 30.0;        ///< Simulated.
    double addedASecond = 27.8;   ///< Each takes the place of the oldest: 100,000 in an hour.
    double warmUpSeconds = 10.0;  ///< After which nothing may grow.
};

struct SoakResult {
    long long steps = 0;
    long long added = 0;
    long long caught = 0;           ///< Dolls whose motion made no sense.
    std::string wrong;              ///< The first thing that must not be: a lost id, a number that is not finite …
    double residentGrowthMb = 0.0;  ///< Of the last quarter's most over the first after warming up.
    double stepMsEarly = 0.0;       ///< Medians of the first and of the last quarter after warming up.
    double stepMsLate = 0.0;
};

/// Dolls of two profiles in a box with a floor, thrown about without end, the oldest replaced all along; every id that
/// was given is checked, living and gone.
[[nodiscard]] SoakResult soak(const SoakOptions& options);

}  // namespace lutka::test
