#include "export/write_bullet.hpp"

#include <algorithm>

#include "export/doll_layout.hpp"
#include "export/text_builder.hpp"

namespace lutka::exporting {
namespace {

using physics::BodyProfile;
using physics::ConstraintProfile;
using physics::PrimitiveShape;
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
    info.m_friction = 0.5f;  // times the ground's: 0.8 there makes it what it is in Lutka
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

// Written where some body has a hull.
constexpr std::string_view kHull = R"(namespace {

std::unique_ptr<btCollisionShape> hull(std::initializer_list<btVector3> corners) {
    auto shape = std::make_unique<btConvexHullShape>();
    for (const btVector3& corner : corners)
        shape->addPoint(corner, false);
    shape->setMargin(0.001f);  // which Bullet adds around it
    shape->recalcLocalAabb();
    return shape;
}

}  // namespace

)";

// Written where some body has several shapes.
constexpr std::string_view kCompound = R"(namespace {

void addPart(Ragdoll& doll, btCompoundShape& whole, std::unique_ptr<btCollisionShape> part,
             const btTransform& bodyFromPart) {
    whole.addChildShape(bodyFromPart, part.get());
    doll.shapes.push_back(std::move(part));
}

}  // namespace

)";

std::string transformText(const RigidTransform& t) {
    return fmt::format("frame({}, {})", vectorText(t.translation, ", "), quaternionTextXyzw(t.rotation, ", "));
}

std::string bulletShape(const PrimitiveShape& shape) {
    switch (shape.kind) {
        case PrimitiveShape::Kind::capsule:
            return fmt::format("std::make_unique<btCapsuleShape>({}, {})", numberText(shape.radius),
                               numberText(2.0F * shape.halfLength));
        case PrimitiveShape::Kind::sphere:
            return fmt::format("std::make_unique<btSphereShape>({})", numberText(shape.radius));
        case PrimitiveShape::Kind::hull: {
            std::string corners;
            for (const vec3& point : shape.hull->points())
                corners += fmt::format("{}btVector3({})", corners.empty() ? "" : ", ", vectorText(point, ", "));
            return fmt::format("hull({{{}}})", corners);
        }
        case PrimitiveShape::Kind::box:
            break;
    }
    return fmt::format("std::make_unique<btBoxShape>(btVector3({}))", vectorText(shape.halfExtents, ", "));
}

// The shape of a body as an argument; one of several is built in lines before.
std::string shapeArgument(TextBuilder& text, std::size_t index, const physics::BodyShape& shape) {
    if (shape.more.empty()) return bulletShape(shape);
    text.line("auto shape{} = std::make_unique<btCompoundShape>();", index);
    visitShapes(shape, [&](const PrimitiveShape& part, const RigidTransform& bodyFromShape) {
        text.line("addPart(*doll, *shape{}, {}, {});", index, bulletShape(part), transformText(bodyFromShape));
    });
    return fmt::format("std::move(shape{})", index);
}

bool hasHull(const BodyProfile& body) {
    bool any = false;
    visitShapes(body.shape, [&](const PrimitiveShape& shape, const RigidTransform&) {
        any = any || shape.kind == PrimitiveShape::Kind::hull;
    });
    return any;
}

}  // namespace

Exported writeBullet(const ExportSource& source) {
    const RagdollProfile& profile = source.profile;
    TextBuilder text;
    text.line("// {}: a ragdoll of {} bodies for Bullet, written by Lutka. Metres, kilograms, radians, Y up.",
              quotedText(profile.name), profile.bodies.size());
    text.block(kHead);
    const bool anyAdded = std::any_of(profile.bodies.begin(), profile.bodies.end(),
                                      [](const BodyProfile& body) { return !body.shape.more.empty(); });
    if (anyAdded) text.block(kCompound);
    const bool anyHull = std::any_of(profile.bodies.begin(), profile.bodies.end(), hasHull);
    if (anyHull) text.block(kHull);
    text.line("// Adds the figure in its bind pose: upright, facing +Z, its soles at the origin of `worldFromDoll`.");
    text.line("// Step at 1/240 s: what is linked stays together then.");
    text.line("std::unique_ptr<Ragdoll> addRagdoll(btDynamicsWorld& world, const btTransform& worldFromDoll) {{");
    text.indent();
    text.indent();
    text.line("auto doll = std::make_unique<Ragdoll>();");
    for (std::size_t i = 0; i < profile.bodies.size(); ++i) {
        const BodyProfile& body = profile.bodies[i];
        text.line("// {}: {}", i, bodyName(profile, static_cast<int>(i)));
        const std::string shape = shapeArgument(text, i, body.shape);
        text.line("addBody(*doll, world, {}, {}, btVector3({}), worldFromDoll * {});", shape, numberText(body.massKg),
                  vectorText(body.inertia, ", "),
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
