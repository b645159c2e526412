// What `lutka export --format bullet` writes, compiled and dropped on a plane: bodies stay finite and together, and the
// doll comes to rest on the floor. The generated file is named by RAGDOLL_SOURCE.
#include RAGDOLL_SOURCE

#include <cmath>
#include <cstdio>

int main() {
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher(&configuration);
    btDbvtBroadphase broadphase;
    btSequentialImpulseConstraintSolver solver;
    btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
    world.setGravity(btVector3(0, -9.81F, 0));
    btStaticPlaneShape plane(btVector3(0, 1, 0), 0);
    btRigidBody floor(btRigidBody::btRigidBodyConstructionInfo(0, nullptr, &plane));
    floor.setFriction(0.8F);
    world.addRigidBody(&floor);
    const auto doll = addRagdoll(world, btTransform(btQuaternion::getIdentity(), btVector3(0, 1, 0)));

    float widest = 0;
    for (int step = 0; step < 6 * 240; ++step) {
        world.stepSimulation(1.0F / 240, 0);
        for (const auto& constraint : doll->constraints) {
            const auto frameOf = [&](bool a) {
                if (auto* hinge = dynamic_cast<btHingeConstraint*>(constraint.get()))
                    return a ? hinge->getRigidBodyA().getWorldTransform() * hinge->getAFrame()
                             : hinge->getRigidBodyB().getWorldTransform() * hinge->getBFrame();
                auto* cone = dynamic_cast<btConeTwistConstraint*>(constraint.get());
                return a ? cone->getRigidBodyA().getWorldTransform() * cone->getAFrame()
                         : cone->getRigidBodyB().getWorldTransform() * cone->getBFrame();
            };
            widest = std::max(widest, frameOf(true).getOrigin().distance(frameOf(false).getOrigin()));
        }
    }
    float mass = 0;
    float moment = 0;
    bool finite = true;
    for (const auto& body : doll->bodies) {
        const float height = body->getWorldTransform().getOrigin().y();
        finite = finite && std::isfinite(height);
        mass += 1 / body->getInvMass();
        moment += height / body->getInvMass();
    }
    std::printf("%zu bodies, %.3f kg, centre of mass at %.3f m, joints %.1f mm apart at most\n", doll->bodies.size(),
                static_cast<double>(mass), static_cast<double>(moment / mass), 1e3 * static_cast<double>(widest));
    const bool sound = finite && doll->bodies.size() == 16 && std::abs(mass - 75) < 0.01F && moment / mass > 0.03F &&
                       moment / mass < 0.5F && widest < 0.06F;
    for (const auto& constraint : doll->constraints)
        world.removeConstraint(constraint.get());
    for (const auto& body : doll->bodies)
        world.removeRigidBody(body.get());
    world.removeRigidBody(&floor);
    return sound ? 0 : 1;
}
