#include "scene/run/make_world.hpp"

#include "physics/bullet/bullet_world.hpp"
#include "physics/crowd/crowd_world.hpp"

namespace lutka::scene {

std::unique_ptr<physics::World> makeWorld(const physics::WorldSettings& settings, int stepsInOne) {
    if (settings.solver != physics::SolverKind::crowd) return physics::createBulletWorld(settings);
    physics::crowd::CrowdTuning tuning;
    tuning.rate /= static_cast<float>(stepsInOne);
    return physics::createCrowdWorld(settings, tuning);
}

}  // namespace lutka::scene
