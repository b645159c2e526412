#pragma once

#include <BulletDynamics/ConstraintSolver/btTypedConstraint.h>

#include <array>
#include <cstddef>
#include <span>

#include "physics/bullet/warm_started.hpp"
#include "physics/profile/profile.hpp"

namespace lutka::physics {

/// How firmly a joint is held; the same for all joints of a world.
struct JointTuning {
    float erp = 0.1F;            ///< Part of a position error mended in a substep, (0, 1]. More: tighter.
    float limitErp = 0.1F;       ///< The same for angles past a limit.
    float maxMendSpeed = 3.0F;   ///< m/s: bound on the speed that mending a gap may give.
    float maxMendTurn = 6.0F;    ///< rad/s: the same for a hinge's axes,
    float maxLimitTurn = 25.0F;  ///< and for angles past a limit.
    float limitMargin = 0.25F;   ///< Radians before a limit from where its row is active (it only bounds the speed).
};

/// A hinge or cone-twist of a profile as rows for Bullet's solvers (docs/physics.md): three rows close the anchors, a
/// hinge has two more that align the axes; limits are one-sided rows that are active before they are reached, with the
/// speed that would just reach them as the bound, so that nothing runs past; dry friction is a motor of speed 0.
///
/// Unlike btConeTwistConstraint, the swing ellipse is fixed in the parent's frame, whatever the twist, and the rows are
/// the exact gradients of swing and twist.
class RagdollJoint final : public btTypedConstraint, public WarmStarted {
  public:
    static constexpr int kMaxRows = 10;
    static constexpr int kSlots = 15;  ///< Places of impulses that are kept.

    /// Body A is the parent, body B the child. `tuning` must outlive the joint.
    RagdollJoint(const ConstraintProfile& profile, btRigidBody& parent, btRigidBody& child, const JointTuning& tuning);

    [[nodiscard]] const ConstraintProfile& profile() const { return profile_; }

    void getInfo1(btConstraintInfo1* info) override;
    void getInfo2(btConstraintInfo2* info) override;
    void setParam(int num, btScalar value, int axis) override;
    [[nodiscard]] btScalar getParam(int num, int axis) const override;

    [[nodiscard]] bool startsWithPoint() const override { return true; }
    [[nodiscard]] RowDuty dutyOf(int row) const override;
    [[nodiscard]] float storedImpulse(int row) const override { return impulses_[slots_[row]]; }
    void storeImpulse(int row, float impulse) override { newImpulses_[slots_[row]] = impulse; }
    void finishStoring() override;
    void forgetImpulses();

    /// One angular row; linear rows need only the anchors.
    struct AngularRow {
        int slot = 0;
        vec3 axis{0, 0, 0};  ///< World; the row's speed is axis · (child's - parent's angular velocity).
        float error = 0;     ///< Radians that remain (one-sided: before the limit) or are wrong (two-sided).
        enum class Kind { align, friction, limit } kind = Kind::align;
    };
    /// The speed that an angular row asks for, rad/s, and the bounds on its impulse, N m s.
    struct AngularTarget {
        float speed = 0;
        float low = 0;
        float high = 0;
    };
    /// Straight access for SubstepSolver, without Bullet's protocol. prepare() comes first; `rate` is 1 / substep, 1/s.
    void prepare();
    [[nodiscard]] const vec3& parentArm() const { return parentArm_; }
    [[nodiscard]] const vec3& childArm() const { return childArm_; }
    /// The speed of the parent's anchor against the child's that mends the gap, m/s.
    [[nodiscard]] vec3 mendVelocity(float rate) const;
    [[nodiscard]] std::span<const AngularRow> angularRows() const { return {rows_.data(), std::size_t(rowCount_)}; }
    [[nodiscard]] AngularTarget targetOf(const AngularRow& row, float rate) const;
    /// How many rows at the start of angularRows() are the friction of a cone-twist, about all axes: 0 or 3.
    [[nodiscard]] int frictionRows() const {
        return profile_.kind == ConstraintProfile::Kind::coneTwist && profile_.frictionNm > 0.0F ? 3 : 0;
    }
    /// What getUserConstraintType() says of joints of this class.
    static constexpr int kUserType = 0x4C75;

  private:
    void prepareHinge(const mat3& parentAxes, const mat3& childAxes);
    void prepareCone(const mat3& parentAxes, const quat& parentFromChild);
    void addSwingRows(const mat3& parentAxes, const vec3& swing, const vec3& u, float bounded);
    void addRow(const AngularRow& row);

    const ConstraintProfile& profile_;
    const JointTuning& tuning_;
    std::array<AngularRow, kMaxRows> rows_;
    int rowCount_ = 0;
    vec3 parentArm_{0, 0, 0};
    vec3 childArm_{0, 0, 0};
    vec3 gap_{0, 0, 0};  // from the parent's anchor to the child's, world

    std::array<int, kMaxRows> slots_{};
    std::array<float, kSlots> impulses_{};
    std::array<float, kSlots> newImpulses_{};
};

}  // namespace lutka::physics
