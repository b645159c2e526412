#include "scene/run/solver_defaults.hpp"

#include <cmath>

#include "physics/bullet/bullet_world.hpp"
#include "physics/crowd/tuning.hpp"

namespace lutka::scene {

SolverDefaults solverDefaults(physics::SolverKind solver) {
    if (solver == physics::SolverKind::crowd) {
        // Its damping is a rate: speed · exp(-rate t) = speed · (1 - share)^t.
        const auto share = [](float rate) { return -std::expm1(-rate); };
        const physics::crowd::CrowdTuning own;
        return {own.substeps, own.passes, share(own.linearDamping), share(own.angularDamping)};
    }
    const physics::BulletTuning own;
    return {own.substeps, own.sweeps, own.linearDamping, own.angularDamping};
}

}  // namespace lutka::scene
