#pragma once

namespace lutka::physics {

/// What the parts of a world's last step took and what it was about; all substeps together.
struct StepTimes {
    double broadphaseMs = 0.0;   ///< Bounds and pairs that may touch.
    double narrowphaseMs = 0.0;  ///< Contacts of those pairs.
    double solverMs = 0.0;       ///< Constraints, contacts, motion, sleep.
    int islands = 0;             ///< Groups of bodies that touch or are linked, and were awake.

    [[nodiscard]] double totalMs() const { return broadphaseMs + narrowphaseMs + solverMs; }
};

}  // namespace lutka::physics
