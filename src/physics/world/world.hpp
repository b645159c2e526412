#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "physics/collision/collision_filter.hpp"
#include "physics/collision/static_shape.hpp"
#include "physics/profile/body_state.hpp"
#include "physics/profile/profile.hpp"
#include "physics/world/step_times.hpp"

namespace lutka::physics {

/// Free rigid props (the scene `balls`).
struct DynamicProp {
    BodyShape shape;
    float massKg = 1.0F;
    BodyState state;
    CollisionFilter filter;
};

enum class SolverKind { stock, bullet, crowd };

/// The name on the command line and in reports.
[[nodiscard]] constexpr std::string_view solverName(SolverKind solver) {
    if (solver == SolverKind::crowd) return "crowd";
    return solver == SolverKind::stock ? "stock" : "bullet";
}

struct WorldSettings {
    SolverKind solver = SolverKind::crowd;
    vec3 gravity{0, -9.81F, 0};  ///< m/s²
    int threads = 1;
    bool sleeping = true;
    bool contactReports = false;  ///< Whether steps gather what contactReports() tells; costs a little.
    // Unset: the solver's own value. `stock` keeps Bullet's whatever is set here.
    std::optional<int> substeps;          ///< Equal parts a step, [1, 64]. More: stiffer joints, cost in proportion.
    std::optional<int> iterations;        ///< Passes over the constraints a substep at most, [1, 1000]. More: tighter.
    std::optional<float> linearDamping;   ///< Share of the speed that is lost in a second, [0, 1). More: thicker air.
    std::optional<float> angularDamping;  ///< The same for turning.

    friend bool operator==(const WorldSettings&, const WorldSettings&) = default;
};

/// One substep's contact between two bodies, for debug draw and reports.
struct ContactPoint {
    vec3 position{0, 0, 0};  ///< World, on the second body.
    vec3 normal{0, 1, 0};    ///< Unit, from the second body towards the first.
    float distance = 0.0F;   ///< Metres; negative: penetration.
};

/// What touched what during the last step, and how hard.
struct ContactReport {
    struct Side {
        enum class Kind { fixed, doll, prop };
        Kind kind = Kind::fixed;
        int index = -1;  ///< Of the static shape, doll or prop, as World counts them.
        int body = 0;    ///< Of the doll; 0 for others.
        bool operator==(const Side&) const = default;
    };
    Side a, b;
    vec3 position{0, 0, 0};  ///< World, on B, where the two touched last.
    vec3 normal{0, 1, 0};    ///< Unit, from B towards A.
    float impulse = 0.0F;    ///< N s along the normal, summed over the step; > 0.
};

/// A spring with a damper and a bound in a joint, solved implicitly, so that no stiffness is too much for it. It pulls
/// towards a pose ("hold this", powered ragdolls); without stiffness it only brakes. Limits stay what they are.
struct JointMotor {
    quat target{1, 0, 0, 0};     ///< Cone-twist: the rotation of the child's frame in the parent's.
    float angle = 0.0F;          ///< Hinge: radians about frame z.
    float stiffness = 0.0F;      ///< N m / rad, >= 0.
    float damping = 0.0F;        ///< N m s / rad, >= 0.
    float maxTorqueNm = 100.0F;  ///< >= 0, about each axis.
};

/// All that a doll takes along when it is placed anew or moves to another world, but for its drags.
struct DollState {
    std::vector<BodyState> bodies;  ///< One a body.
    CollisionFilter filter;
    std::vector<std::optional<JointMotor>> motors;  ///< One a constraint.
    float restSeconds = 0.0F;                       ///< For how long it has been slow enough to fall asleep.
    bool asleep = false;
};

/// What a ray meets.
struct RayHit {
    int doll = -1;  ///< -1: static geometry or a prop.
    int body = -1;  ///< Body of the doll.
    vec3 position{0, 0, 0};
    vec3 normal{0, 1, 0};
    float fraction = 1.0F;  ///< Of the ray's length.
};

/// A pull on one body towards a point of the world: a soft point-to-point constraint with a force limit.
struct Drag {
    int doll = -1;
    int body = -1;
    vec3 bodyPoint{0, 0, 0};  ///< In body space.
    vec3 worldTarget{0, 0, 0};
    float maxForceN = 1500.0F;
};

/// A world of ragdolls. Instances are handles (doll indices in the order of adding). All positions in metres, world
/// space. Deterministic: the same calls give the same bits.
class World {
  public:
    virtual ~World() = default;
    World(const World&) = delete;
    World& operator=(const World&) = delete;

    /// Returns the shape's index; wakes what may lie there.
    virtual int addStatic(const StaticShape& shape) = 0;
    virtual int addProp(const DynamicProp& prop) = 0;
    /// `bodies` holds one state a body of the profile; the profile must outlive the world. Returns the doll's index.
    virtual int addDoll(const RagdollProfile& profile, std::span<const BodyState> bodies) = 0;

    /// Takes something out of the world and wakes what touched it; a doll's drags go with it. The indices of those
    /// added later go down by one.
    virtual void removeStatic(int index) = 0;
    virtual void removeProp(int prop) = 0;
    virtual void removeDoll(int doll) = 0;

    /// One frame of `dt` seconds in `substepsPerStep()` equal substeps; `afterSubstep`, when set, is called after each.
    virtual void step(float dt, const std::function<void()>& afterSubstep = {}) = 0;
    [[nodiscard]] virtual int substepsPerStep() const = 0;
    /// From the next step on, >= 1. Fewer than the solver's own: cheaper in proportion, softer joints, deeper contacts.
    /// The stock world keeps its one.
    virtual void setSubsteps(int substeps) = 0;

    [[nodiscard]] virtual int dollCount() const = 0;
    [[nodiscard]] virtual const RagdollProfile& profileOf(int doll) const = 0;
    /// Principal moments that the solver gives a body, kg m²; not below the profile's (docs/physics.md, conditioning).
    [[nodiscard]] virtual vec3 inertiaOf(int doll, int body) const = 0;
    virtual void getBodies(int doll, std::span<BodyState> bodies) const = 0;
    /// Places a doll anew (reset, scrubbing); wakes it.
    virtual void setBodies(int doll, std::span<const BodyState> bodies) = 0;
    [[nodiscard]] virtual bool isAsleep(int doll) const = 0;
    /// Wakes a doll, and with it those that it touches.
    virtual void wake(int doll) = 0;
    [[nodiscard]] virtual DollState dollState(int doll) const = 0;
    /// Like setBodies(), with everything else; a doll may be put in asleep (where sleeping is on).
    virtual void setDollState(int doll, const DollState& state) = 0;
    [[nodiscard]] virtual int propCount() const = 0;
    /// What the prop was made as; its state is that of the start.
    [[nodiscard]] virtual const DynamicProp& propOf(int prop) const = 0;
    [[nodiscard]] virtual BodyState propState(int prop) const = 0;

    /// Impulse in N s at a world point of a body; wakes the doll.
    virtual void applyImpulse(int doll, int body, const vec3& impulse, const vec3& worldPoint) = 0;

    /// Force in N at a world point of a body, which acts throughout the next step and moves with the body; wakes the
    /// doll.
    virtual void applyForce(int doll, int body, const vec3& force, const vec3& worldPoint) = 0;

    /// Turns a motor in a joint on, changes it or, unset, turns it off; wakes the doll. Off by default.
    virtual void setMotor(int doll, int constraint, const std::optional<JointMotor>& motor) = 0;
    /// Work done by motors and applied forces since the world was made, joules.
    [[nodiscard]] virtual double motorWork() const = 0;

    /// The nearest thing that the segment enters and that is in one of `layers`; what it starts in is not met, nor is a
    /// mesh from behind. Positions are those of the last step or placing.
    [[nodiscard]] virtual std::optional<RayHit> rayTest(const vec3& from, const vec3& to,
                                                        std::uint32_t layers = CollisionFilter::kAll) const = 0;

    /// What a doll or prop collides with from the next step on; it is woken. Statics and new props bring their own, new
    /// dolls start with the default, which collides with everything.
    virtual void setDollFilter(int doll, const CollisionFilter& filter) = 0;
    [[nodiscard]] virtual CollisionFilter dollFilter(int doll) const = 0;
    virtual void setPropFilter(int prop, const CollisionFilter& filter) = 0;

    /// At most one drag an id; the same id moves its target. Removing an unknown id does nothing.
    virtual void setDrag(int id, const Drag& drag) = 0;
    virtual void removeDrag(int id) = 0;
    /// Work done by drags since the world was made, joules.
    [[nodiscard]] virtual double dragWork() const = 0;
    /// The drags on a doll, with their ids.
    [[nodiscard]] virtual std::vector<std::pair<int, Drag>> dragsOf(int doll) const = 0;

    /// The contacts of the last substep, appended to `contacts`.
    virtual void getContacts(std::vector<ContactPoint>& contacts) const = 0;

    /// What pushed what in the last step, in an order that the same calls repeat; empty without
    /// WorldSettings::contactReports.
    [[nodiscard]] virtual std::span<const ContactReport> contactReports() const = 0;

    /// What the parts of the last step took; zeros before the first one and where a world does not measure.
    [[nodiscard]] virtual StepTimes stepTimes() const { return {}; }

    /// Takes a line of debug drawing: two points in world space and its colour, components in [0, 1].
    using DebugLineSink = std::function<void(const vec3& from, const vec3& to, const vec3& color)>;
    /// What the engine's own debug drawer shows of this world (shapes, constraints with limits, contacts, boxes), as
    /// lines; nothing where the engine has none.
    virtual void drawDebug(const DebugLineSink& /*line*/) {}

  protected:
    World() = default;
};

}  // namespace lutka::physics
