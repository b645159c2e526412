// A world of your own, without scenes: floor, a prop, a doll, and a motor in each joint that holds its pose.
#include <cstdio>

#include "physics/crowd/crowd_world.hpp"
#include "scene/asset/ragdoll_asset.hpp"

using namespace lutka;

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    const auto ragdoll = scene::loadRagdoll(argv[1]);
    if (!ragdoll) {
        std::fprintf(stderr, "%s\n", ragdoll.error().text().c_str());
        return 3;
    }
    const scene::RagdollAsset& asset = *ragdoll.value();
    // [howto]
    const std::unique_ptr<physics::World> world = physics::createCrowdWorld({});
    world->addStatic({});  // the plane y = 0

    physics::DynamicProp ball;
    ball.shape.kind = physics::BodyShape::Kind::sphere;
    ball.shape.radius = 0.15F;
    ball.massKg = 4.0F;
    ball.state.worldFromBody.translation = {3, 1, 0};
    ball.state.linearVelocity = {-6, 2, 0};
    world->addProp(ball);

    // The bind pose turned upright, half a metre above the floor.
    const RigidTransform worldFromModel{asset.profile.standardFromModel, vec3(0, 0.5F, 0)};
    std::vector<physics::BodyState> bodies(asset.profile.bodies.size());
    physics::bodiesFromPose(asset.rig, asset.character.skeleton.bindModelFromJoint, worldFromModel, bodies);
    const physics::DollId doll = world->addDoll(asset.profile, bodies);

    physics::JointMotor stiff;  // towards the neutral pose, the middle of each joint's range
    stiff.stiffness = 200.0F;   // N m / rad
    stiff.damping = 10.0F;      // N m s / rad
    for (int constraint = 0; constraint < static_cast<int>(asset.profile.constraints.size()); ++constraint)
        world->setMotor(doll, constraint, stiff);

    for (int step = 0; step < 120; ++step)
        world->step(1.0F / 60.0F);
    world->getBodies(doll, bodies);
    // [/howto]
    const float height = bodies[0].worldFromBody.translation.y;
    std::printf("the hips are at %.3f m\n", static_cast<double>(height));
    return height > 0.0F && height < 1.5F ? 0 : 1;
}
