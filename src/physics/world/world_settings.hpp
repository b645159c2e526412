#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "core/math.hpp"

namespace lutka::physics {

enum class SolverKind { stock, bullet, crowd };

/// A solver as users meet it.
struct SolverEntry {
    SolverKind kind;
    const char* name;   ///< In options, scene files and reports.
    const char* title;  ///< On the editor's panels.
};

/// Every solver there is.
inline constexpr std::array<SolverEntry, 3> kSolvers{{
    {SolverKind::stock, "stock", "Stock Bullet"},
    {SolverKind::bullet, "bullet", "Tuned for ragdolls"},
    {SolverKind::crowd, "crowd", "Crowd"},
}};

/// The name on the command line, in scene files and in reports.
[[nodiscard]] constexpr std::string_view solverName(SolverKind solver) {
    for (const SolverEntry& entry : kSolvers)
        if (entry.kind == solver) return entry.name;
    return {};
}

/// The solver of that name; unset when there is none.
[[nodiscard]] constexpr std::optional<SolverKind> solverNamed(std::string_view name) {
    for (const SolverEntry& entry : kSolvers)
        if (name == entry.name) return entry.kind;
    return std::nullopt;
}

struct WorldSettings {
    SolverKind solver = SolverKind::crowd;
    vec3 gravity{0, -9.81F, 0};   ///< m/s²
    int threads = 1;              ///< Of a step, the calling one included; 0: one a processor. At most 256 are taken.
    bool sleeping = true;         ///< Whether what lies still is left out of the steps until something wakes it.
    bool contactReports = false;  ///< Whether steps gather what contactReports() tells; costs a little.
    // Unset: the solver's own value. `stock` keeps Bullet's whatever is set here.
    std::optional<int> substeps;          ///< Equal parts a step, [1, 64]. More: stiffer joints, cost in proportion.
    std::optional<int> iterations;        ///< Passes over the constraints a substep at most, [1, 1000]. More: tighter.
    std::optional<float> linearDamping;   ///< Share of the speed that is lost in a second, [0, 1). More: thicker air.
    std::optional<float> angularDamping;  ///< The same for turning.

    friend bool operator==(const WorldSettings&, const WorldSettings&) = default;
};

}  // namespace lutka::physics
