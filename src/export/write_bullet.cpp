#include "export/write_bullet.hpp"

#include "export/doll_layout.hpp"
#include "export/text_builder.hpp"

namespace lutka::exporting {
namespace {

using physics::BodyProfile;
using physics::BodyShape;
using physics::ConstraintProfile;
using physics::RagdollProfile;

constexpr std::string_view kHead = R"(#include <btBulletDynamicsCommon.h>

#include <memory>
#include <vector>

// What addRagdoll() made. Take constraints and bodies out of the world before this is destroyed.
struct Ragdoll {
    std::vector<std::unique_ptr<btCollisionShape>> shapes;
    std::vector<std::unique_ptr<btMotionState>> motions;
    std::vector<std::unique_ptr<btRigidBody>> bodies;
    std::vector<std::unique_ptr<btTypedConstraint>> constraints;
};

namespace {

btTransform frame(btScalar x, btScalar y, btScalar z, btScalar qx, btScalar qy, btScalar qz, btScalar qw) {
    return btTransform(btQuaternion(qx, qy, qz, qw), btVector3(x, y, z));
}

void addBody(Ragdoll& doll, btDynamicsWorld& world, std::unique_ptr<btCollisionShape> shape, btScalar mass,
             const btVector3& inertia, const btTransform& worldFromBody) {
    doll.motions.push_back(std::make_unique<btDefaultMotionState>(worldFromBody));
    btRigidBody::btRigidBodyConstructionInfo info(mass, doll.motions.back().get(), shape.get(), inertia);
    info.m_friction = 0.8f;
    doll.bodies.push_back(std::make_unique<btRigidBody>(info));
    doll.shapes.push_back(std::move(shape));
    world.addRigidBody(doll.bodies.back().get());
}

// The last argument of the constructor: the child's angle is told in the parent's frame.
void addHinge(Ragdoll& doll, btDynamicsWorld& world, int parent, int child, const btTransform& parentFromFrame,
              const btTransform& childFromFrame, btScalar lower, btScalar upper, btScalar friction) {
    auto hinge = std::make_unique<btHingeConstraint>(*doll.bodies[parent], *doll.bodies[child], parentFromFrame,
                                                     childFromFrame, true);
    hinge->setLimit(lower, upper);
    // The largest impulse of a step of 1/240 s; a motor of speed 0 is dry friction.
    hinge->enableAngularMotor(friction > 0, 0, friction / 240);
    world.addConstraint(hinge.get(), true);
    doll.constraints.push_back(std::move(hinge));
}

void addCone(Ragdoll& doll, btDynamicsWorld& world, int parent, int child, const btTransform& parentFromFrame,
             const btTransform& childFromFrame, btScalar swingY, btScalar swingZ, btScalar twist) {
    auto cone = std::make_unique<btConeTwistConstraint>(*doll.bodies[parent], *doll.bodies[child], parentFromFrame,
                                                        childFromFrame);
    cone->setLimit(swingZ, swingY, twist);
    world.addConstraint(cone.get(), true);
    doll.constraints.push_back(std::move(cone));
}

}  // namespace

)";

std::string transformText(const RigidTransform& t) {
    return fmt::format("frame({}, {})", vectorText(t.translation, ", "), quaternionTextXyzw(t.rotation, ", "));
}

std::string bulletShape(const BodyShape& shape) {
    switch (shape.kind) {
        case BodyShape::Kind::capsule:
            return fmt::format("std::make_unique<btCapsuleShape>({}, {})", numberText(shape.radius),
                               numberText(2.0F * shape.halfLength));
        case BodyShape::Kind::sphere:
            return fmt::format("std::make_unique<btSphereShape>({})", numberText(shape.radius));
        case BodyShape::Kind::box:
            break;
    }
    return fmt::format("std::make_unique<btBoxShape>(btVector3({}))", vectorText(shape.halfExtents, ", "));
}

}  // namespace

Exported writeBullet(const ExportSource& source) {
    const RagdollProfile& profile = source.profile;
    TextBuilder text;
    text.line("// {}: a ragdoll of {} bodies for Bullet, written by Lutka. Metres, kilograms, radians, Y up.",
              quotedText(profile.name), profile.bodies.size());
    text.block(kHead);
    text.line("// Adds the figure in its bind pose: upright, facing +Z, its soles at the origin of `worldFromDoll`.");
    text.line("// Step at 1/240 s: what is linked stays together then.");
    text.line("std::unique_ptr<Ragdoll> addRagdoll(btDynamicsWorld& world, const btTransform& worldFromDoll) {{");
    text.indent();
    text.indent();
    text.line("auto doll = std::make_unique<Ragdoll>();");
    for (std::size_t i = 0; i < profile.bodies.size(); ++i) {
        const BodyProfile& body = profile.bodies[i];
        text.line("// {}: {}", i, bodyName(profile, static_cast<int>(i)));
        text.line("addBody(*doll, world, {}, {}, btVector3({}), worldFromDoll * {});", bulletShape(body.shape),
                  numberText(body.massKg), vectorText(body.inertia, ", "),
                  transformText(standingFromModel(source) * source.rig.bindModelFromBody[i]));
    }
    for (const ConstraintProfile& c : profile.constraints) {
        const bool hinge = c.kind == ConstraintProfile::Kind::hinge;
        const std::string limits = hinge ? fmt::format("{}, {}, {}", numberText(c.hinge.lower),
                                                       numberText(c.hinge.upper), numberText(c.frictionNm))
                                         : vectorText({c.cone.swingY, c.cone.swingZ, c.cone.twist}, ", ");
        text.line("{}(*doll, world, {}, {}, {}, {}, {});", hinge ? "addHinge" : "addCone", c.parent, c.child,
                  transformText(c.parentFromFrame), transformText(c.childFromFrame), limits);
    }
    for (const auto& [first, second] : profile.filteredPairs)
        text.line("doll->bodies[{0}]->setIgnoreCollisionCheck(doll->bodies[{1}].get(), true);", first, second);
    text.line("return doll;");
    text.outdent();
    text.outdent();
    text.line("}}");
    return {text.take(), {"Bullet's cone-twist joint has no dry friction: only hinges carry it"}};
}

}  // namespace lutka::exporting
