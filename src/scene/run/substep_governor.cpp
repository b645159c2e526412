#include "scene/run/substep_governor.hpp"

#include <algorithm>

#include "core/assert.hpp"

namespace lutka::scene {

SubstepGovernor::SubstepGovernor(int full, const GovernorSettings& settings)
    : settings_(settings), full_(full), substeps_(full) {
    LUTKA_ASSERT(full >= 1 && settings.easy < settings.late && settings.leastSubsteps >= 1);
}

int SubstepGovernor::update(double load) {
    const double perSubstep = load / substeps_;
    lateFor_ = load >= settings_.late ? lateFor_ + 1 : 0;
    const bool roomForOne = substeps_ < full_ && perSubstep * (substeps_ + 1) < settings_.easy;
    easyFor_ = roomForOne ? easyFor_ + 1 : 0;
    if (lateFor_ >= settings_.lateFrames) {
        // At once as many as fit, not one after the other: each try is another late second.
        const int fitting = static_cast<int>(settings_.easy / perSubstep);
        substeps_ = std::max({1, std::min(settings_.leastSubsteps, full_), std::min(fitting, substeps_ - 1)});
        lateFor_ = 0;
    } else if (easyFor_ >= settings_.easyFrames) {
        ++substeps_;
        easyFor_ = 0;
    }
    return substeps_;
}

}  // namespace lutka::scene
