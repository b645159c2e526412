#include "physics/bullet/debug_draw.hpp"

#include <cmath>

#include "physics/bullet/convert.hpp"
#include "physics/bullet/drag_constraint.hpp"
#include "physics/bullet/ragdoll_joint.hpp"

namespace lutka::physics {
namespace {

constexpr float kNormalLength = 0.08F;  // metres, of a contact's normal

/// Bullet's drawer on our lines. Bullet hands over everything as lines but contacts, texts and warnings.
class DebugDraw final : public btIDebugDraw {
  public:
    explicit DebugDraw(const World::DebugLineSink& line) : line_(line) {}

    void drawLine(const btVector3& from, const btVector3& to, const btVector3& color) override {
        line_(fromBullet(from), fromBullet(to), fromBullet(color));
    }
    void drawContactPoint(const btVector3& point, const btVector3& normal, btScalar /*distance*/, int /*lifeTime*/,
                          const btVector3& color) override {
        drawLine(point, point + normal * kNormalLength, color);
    }
    void reportErrorWarning(const char* /*warning*/) override {}
    void draw3dText(const btVector3& /*location*/, const char* /*text*/) override {}
    [[nodiscard]] int getDebugMode() const override { return mode_; }
    void setDebugMode(int mode) override { mode_ = mode; }

  private:
    const World::DebugLineSink& line_;
    int mode_ = DBG_DrawWireframe | DBG_DrawAabb | DBG_DrawContactPoints;
};

constexpr float kFrameSize = 0.06F;    // metres
const btVector3 kLimitColor(0, 0, 0);  // as Bullet's own constraints have it
const btVector3 kPullColor(1, 0, 1);

void drawLimits(const RagdollJoint& joint, const btTransform& parentFrame, DebugDraw& drawer) {
    const ConstraintProfile& profile = joint.profile();
    const btVector3 center = parentFrame.getOrigin();
    const btMatrix3x3& axes = parentFrame.getBasis();
    if (profile.kind == ConstraintProfile::Kind::hinge) {
        drawer.drawArc(center, axes.getColumn(2), axes.getColumn(0), kFrameSize, kFrameSize, profile.hinge.lower,
                       profile.hinge.upper, kLimitColor, true);
        return;
    }
    constexpr int kSegments = 24;
    btVector3 last(0, 0, 0);
    for (int i = 0; i <= kSegments; ++i) {
        const float around = 2.0F * kPi * static_cast<float>(i) / kSegments;
        const btVector3 swing(0, profile.cone.swingY * std::cos(around), profile.cone.swingZ * std::sin(around));
        const float angle = swing.length();
        const btVector3 axis = angle > SIMD_EPSILON ? swing / angle : btVector3(0, 1, 0);
        const btVector3 rim = parentFrame * (quatRotate(btQuaternion(axis, angle), btVector3(kFrameSize, 0, 0)));
        if (i > 0) drawer.drawLine(last, rim, kLimitColor);
        if (i % 6 == 0) drawer.drawLine(center, rim, kLimitColor);
        last = rim;
    }
}

void drawJoint(const RagdollJoint& joint, DebugDraw& drawer) {
    const btTransform parent =
        joint.getRigidBodyA().getCenterOfMassTransform() * toBullet(joint.profile().parentFromFrame);
    const btTransform child =
        joint.getRigidBodyB().getCenterOfMassTransform() * toBullet(joint.profile().childFromFrame);
    drawer.drawTransform(parent, kFrameSize);
    drawer.drawTransform(child, kFrameSize);
    drawLimits(joint, parent, drawer);
}

void drawPull(const DragConstraint& pull, DebugDraw& drawer) {
    const btVector3 from = pull.getRigidBodyA().getCenterOfMassTransform() * toBullet(pull.drag().bodyPoint);
    drawer.drawLine(from, toBullet(pull.drag().worldTarget), kPullColor);
}

// Bullet's own drawing casts by the constraint's type, which only its own classes may rely on.
void drawConstraint(btTypedConstraint& constraint, btDiscreteDynamicsWorld& world, DebugDraw& drawer) {
    if (const auto* joint = dynamic_cast<const RagdollJoint*>(&constraint)) {
        drawJoint(*joint, drawer);
    } else if (const auto* pull = dynamic_cast<const DragConstraint*>(&constraint)) {
        drawPull(*pull, drawer);
    } else if (dynamic_cast<const btHingeConstraint*>(&constraint) != nullptr ||
               dynamic_cast<const btConeTwistConstraint*>(&constraint) != nullptr) {
        constraint.setDbgDrawSize(kFrameSize);
        world.debugDrawConstraint(&constraint);
    }
}

}  // namespace

void drawBulletDebug(btDiscreteDynamicsWorld& world, const World::DebugLineSink& line) {
    DebugDraw drawer(line);
    btIDebugDraw* const before = world.getDebugDrawer();
    world.setDebugDrawer(&drawer);
    world.debugDrawWorld();
    drawer.setDebugMode(drawer.getDebugMode() | btIDebugDraw::DBG_DrawConstraints |
                        btIDebugDraw::DBG_DrawConstraintLimits);
    for (int i = 0; i < world.getNumConstraints(); ++i)
        drawConstraint(*world.getConstraint(i), world, drawer);
    world.setDebugDrawer(before);
}

}  // namespace lutka::physics
