#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "physics/collision/static_shape.hpp"
#include "physics/world/doll_guard.hpp"
#include "physics/world/world_settings.hpp"
#include "physics/world/world_view.hpp"

namespace lutka::physics {

/// A spring with a damper and a bound in a joint, solved implicitly, so that no stiffness is too much for it. It pulls
/// towards a pose ("hold this", powered ragdolls); without stiffness it only brakes. Limits stay what they are. A
/// target that moves has a rate: spring and damper act on the differences from both, so that a pose in motion is
/// followed without lag.
struct JointMotor {
    quat target{1, 0, 0, 0};     ///< Cone-twist: the rotation of the child's frame in the parent's, at the step's end.
    float angle = 0.0F;          ///< Hinge: radians about frame z, at the step's end.
    float stiffness = 0.0F;      ///< N m / rad, >= 0.
    float damping = 0.0F;        ///< N m s / rad, >= 0.
    float maxTorqueNm = 100.0F;  ///< >= 0, about each axis.
    vec3 rate{0, 0, 0};          ///< rad/s, in the parent's frame: how the target turns in the step. Hinge: z alone.
};

/// A frame in motion that a body of a doll is led to.
///
/// With weight 1 the body is kinematic: it follows the frame exactly, whatever acts on it, and others feel an infinite
/// mass. It does not touch static geometry, two kinematic bodies do not push each other, and the joint between two has
/// no limits. With less it is simulated, and drawn to the frame by a critically damped spring that its own mass feels
/// with frequencyOf(weight); solved implicitly, so that every weight is stable. Let go of, it goes on as it moves.
struct BodyTarget {
    RigidTransform worldFromBody;   ///< At the step's end.
    vec3 linearVelocity{0, 0, 0};   ///< m/s: how the frame moves in the step, so that it is followed without lag.
    vec3 angularVelocity{0, 0, 0};  ///< rad/s
    float weight = 1.0F;            ///< (0, 1]
};
/// Hz of the spring of a BodyTarget, weight in (0, 1): 4 at 0.5, growing without bound towards 1.
[[nodiscard]] constexpr float frequencyOf(float weight) {
    return 4.0F * weight / (1.0F - weight);
}

/// All that a doll takes along when it is placed anew or moves to another world, but for its drags and targets.
struct DollState {
    std::vector<BodyState> bodies;  ///< One a body.
    CollisionFilter filter;
    std::vector<std::optional<JointMotor>> motors;  ///< One a constraint.
    float restSeconds = 0.0F;                       ///< For how long it has been slow enough to fall asleep.
    bool asleep = false;
};

/// A pull on one body towards a point of the world: a soft point-to-point constraint with a force limit.
struct Drag {
    DollId doll;
    int body = -1;
    vec3 bodyPoint{0, 0, 0};      ///< In body space.
    vec3 worldTarget{0, 0, 0};    ///< At the step's end.
    float maxForceN = 1500.0F;    ///< >= 0.
    vec3 worldVelocity{0, 0, 0};  ///< m/s: how the target moves in the step, so that a moving one is met without lag.
    friend bool operator==(const Drag&, const Drag&) = default;
};

/// A world of ragdolls. Deterministic: the same calls give the same bits. Calls are checked as WorldView says; one that
/// adds returns an id of nothing when it is refused.
class World : public WorldView {
  public:
    /// Wakes what may lie there.
    StaticId addStatic(const StaticShape& shape);
    PropId addProp(const DynamicProp& prop);
    /// `bodies` holds one state a body of the profile; the profile must outlive the world.
    DollId addDoll(const RagdollProfile& profile, std::span<const BodyState> bodies);

    /// Takes something out of the world and wakes what touched it; a doll's drags go with it.
    void removeStatic(StaticId fixed);
    void removeProp(PropId prop);
    void removeDoll(DollId doll);

    /// One frame of `dt` seconds in `substepsPerStep()` equal substeps; `afterSubstep`, when set, is called after each.
    /// The crowd may take fewer, longer ones where nothing moves fast; what it has not moved yet is then where it was.
    /// In a step of more than 1/60 s, or where something is very fast, it may take several for one of those.
    void step(float dt, const std::function<void()>& afterSubstep = {});
    /// Dolls whose motion stopped making sense at the end of a step: not finite, faster than DollGuard::kMostSpeed, or
    /// with more energy than DollGuard::kMostGain allows. Each was put back to where it was before that step and to
    /// sleep (without sleeping: to rest), and forgot what its joints carried; others do not feel it.
    [[nodiscard]] std::span<const CaughtDoll> caught() const { return guard_.caught(); }
    /// From the next step on, >= 1: sets substepsPerStep(). Fewer than the solver's own: cheaper in proportion, softer
    /// joints, deeper contacts. The stock world keeps its one. Holds for dolls that come later, too, also for small
    /// ones, which ask for more. Unlike WorldSettings::substeps it is no bound: long steps and fast dolls have more, as
    /// ever.
    void setSubsteps(int substeps);

    /// Places a doll anew (reset, scrubbing); wakes it.
    void setBodies(DollId doll, std::span<const BodyState> bodies);
    /// Wakes a doll, and with it those that it touches.
    void wake(DollId doll);
    [[nodiscard]] DollState dollState(DollId doll) const;
    /// Like setBodies(), with everything else; a doll may be put in asleep (where sleeping is on).
    void setDollState(DollId doll, const DollState& state);

    /// Impulse in N s at a world point of a body; wakes the doll. Its work is in impulseWork().
    void applyImpulse(DollId doll, int body, const vec3& impulse, const vec3& worldPoint);
    /// Force in N at a world point of a body, which acts throughout the next step and moves with the body; wakes the
    /// doll.
    void applyForce(DollId doll, int body, const vec3& force, const vec3& worldPoint);
    /// Turns a motor in a joint on, changes it or, unset, turns it off; wakes the doll. Off by default. A joint with a
    /// spring (ConstraintProfile::spring) has that for its motor where none is set; dollState() tells it as one.
    void setMotor(DollId doll, int constraint, const std::optional<JointMotor>& motor);

    /// Leads a body to a frame, or, unset, lets go of it; wakes the doll. Holds until it is set again: a frame in
    /// motion is set before every step. Its work is in dragWork(). The stock world has none and refuses.
    void setBodyTarget(DollId doll, int body, const std::optional<BodyTarget>& target);

    /// What a doll or prop collides with from the next step on; it is woken. Statics and new props bring their own, new
    /// dolls start with the default, which collides with everything.
    void setDollFilter(DollId doll, const CollisionFilter& filter);
    [[nodiscard]] CollisionFilter dollFilter(DollId doll) const;
    void setPropFilter(PropId prop, const CollisionFilter& filter);

    /// Begins a pull, which lasts until it or its doll is removed; wakes the doll.
    DragId addDrag(const Drag& drag);
    /// Changes a pull, its target above all; wakes the doll.
    void setDrag(DragId id, const Drag& drag);
    void removeDrag(DragId id);
    [[nodiscard]] bool has(DragId drag) const { return dragIds_.placeOf(drag) >= 0; }
    using WorldView::has;
    /// In the order of adding; of all dolls, or of one.
    [[nodiscard]] std::span<const DragId> drags() const { return dragIds_.ids(); }
    [[nodiscard]] std::vector<DragId> dragsOf(DollId doll) const;
    [[nodiscard]] bool isDragged(DollId doll) const;
    [[nodiscard]] Drag dragOf(DragId id) const;
    [[nodiscard]] double impulseWork() const override { return impulseWork_; }

  protected:
    World() = default;

  private:
    // What a solver does, with arguments that were checked. Places as in WorldView; a new one's place is the last.
    virtual void addStaticAs(StaticId id, const StaticShape& shape) = 0;
    virtual void addPropAs(PropId id, const DynamicProp& prop) = 0;
    virtual void addDollAs(DollId id, const RagdollProfile& profile, std::span<const BodyState> bodies) = 0;
    virtual void removeStaticAt(int fixed) = 0;
    virtual void removePropAt(int prop) = 0;
    virtual void removeDollAt(int doll) = 0;  // its drags are gone already
    virtual void advance(float dt, const std::function<void()>& afterSubstep) = 0;
    virtual void useSubsteps(int substeps) = 0;
    virtual void setBodiesAt(int doll, std::span<const BodyState> bodies) = 0;
    virtual void wakeAt(int doll) = 0;
    [[nodiscard]] virtual DollState dollStateAt(int doll) const = 0;
    virtual void setDollStateAt(int doll, const DollState& state) = 0;
    virtual void applyImpulseAt(int doll, int body, const vec3& impulse, const vec3& worldPoint) = 0;
    virtual void applyForceAt(int doll, int body, const vec3& force, const vec3& worldPoint) = 0;
    virtual void setMotorAt(int doll, int constraint, const std::optional<JointMotor>& motor) = 0;
    virtual void setBodyTargetAt(int doll, int body, const std::optional<BodyTarget>& target) = 0;
    virtual void setDollFilterAt(int doll, const CollisionFilter& filter) = 0;
    [[nodiscard]] virtual CollisionFilter dollFilterAt(int doll) const = 0;
    virtual void setPropFilterAt(int prop, const CollisionFilter& filter) = 0;
    virtual void addDragTo(int doll, const Drag& drag) = 0;
    virtual void setDragAt(int place, int doll, const Drag& drag) = 0;
    virtual void removeDragAt(int place) = 0;

    [[nodiscard]] bool hasBody(std::string_view call, int doll, int body) const;
    [[nodiscard]] bool areSound(std::string_view call, const RagdollProfile& profile,
                                std::span<const BodyState> bodies) const;
    [[nodiscard]] bool isSound(std::string_view call, const std::optional<JointMotor>& motor) const;
    [[nodiscard]] int checkedDoll(std::string_view call, const Drag& drag) const;
    [[nodiscard]] int checkedDrag(std::string_view call, DragId id) const;

    void putBack(int doll);
    [[nodiscard]] double workOfImpulse(int doll, int body, const vec3& impulse, const vec3& worldPoint);

    DollGuard guard_;
    double seconds_ = 0.0;  // of all steps so far
    IdTable<DragId> dragIds_;
    std::vector<Drag> drags_;  // by their places
    double impulseWork_ = 0.0;
    std::vector<BodyState> hit_;  // scratch
};

}  // namespace lutka::physics
