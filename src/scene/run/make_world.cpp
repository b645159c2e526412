#include "scene/run/make_world.hpp"

#include "physics/bullet/bullet_world.hpp"
#include "physics/crowd/crowd_world.hpp"

namespace lutka::scene {

std::unique_ptr<physics::World> makeWorld(const physics::WorldSettings& settings) {
    return settings.solver == physics::SolverKind::crowd ? physics::createCrowdWorld(settings)
                                                         : physics::createBulletWorld(settings);
}

}  // namespace lutka::scene
