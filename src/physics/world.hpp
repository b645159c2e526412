#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "physics/profile.hpp"
#include "physics/rig.hpp"

namespace lutka::physics {

/// Static geometry of a scene. Boxes and planes have analytic distances, which the quality metrics use.
struct StaticShape {
    enum class Kind { plane, box };
    Kind kind = Kind::plane;
    RigidTransform worldFromShape;  ///< A plane is the shape's y = 0, solid below; a box is centred.
    vec3 halfExtents{1, 1, 1};      ///< Box, metres.
    float friction = 0.8F;
};

/// Free rigid props (the scene `balls`).
struct DynamicProp {
    BodyShape shape;
    float massKg = 1.0F;
    BodyState state;
};

enum class SolverKind { stock, bullet, crowd };

/// The name on the command line and in reports.
[[nodiscard]] constexpr std::string_view solverName(SolverKind solver) {
    if (solver == SolverKind::crowd) return "crowd";
    return solver == SolverKind::stock ? "stock" : "bullet";
}

struct WorldSettings {
    SolverKind solver = SolverKind::bullet;
    vec3 gravity{0, -9.81F, 0};  ///< m/s²
    int threads = 1;
    bool sleeping = true;
};

/// One substep's contact between two bodies, for debug draw and reports.
struct ContactPoint {
    vec3 position{0, 0, 0};  ///< World, on the second body.
    vec3 normal{0, 1, 0};    ///< Unit, from the second body towards the first.
    float distance = 0.0F;   ///< Metres; negative: penetration.
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

    virtual void addStatic(const StaticShape& shape) = 0;
    virtual int addProp(const DynamicProp& prop) = 0;
    /// `bodies` holds one state a body of the profile; the profile must outlive the world. Returns the doll's index.
    virtual int addDoll(const RagdollProfile& profile, std::span<const BodyState> bodies) = 0;

    /// One frame of `dt` seconds in `substepsPerStep()` equal substeps; `afterSubstep`, when set, is called after each.
    virtual void step(float dt, const std::function<void()>& afterSubstep = {}) = 0;
    [[nodiscard]] virtual int substepsPerStep() const = 0;

    [[nodiscard]] virtual int dollCount() const = 0;
    [[nodiscard]] virtual const RagdollProfile& profileOf(int doll) const = 0;
    /// Principal moments that the solver gives a body, kg m²; not below the profile's (docs/physics.md, conditioning).
    [[nodiscard]] virtual vec3 inertiaOf(int doll, int body) const = 0;
    virtual void getBodies(int doll, std::span<BodyState> bodies) const = 0;
    /// Places a doll anew (reset, scrubbing); wakes it.
    virtual void setBodies(int doll, std::span<const BodyState> bodies) = 0;
    [[nodiscard]] virtual bool isAsleep(int doll) const = 0;
    [[nodiscard]] virtual int propCount() const = 0;
    /// What the prop was made as; its state is that of the start.
    [[nodiscard]] virtual const DynamicProp& propOf(int prop) const = 0;
    [[nodiscard]] virtual BodyState propState(int prop) const = 0;

    /// Impulse in N s at a world point of a body; wakes the doll.
    virtual void applyImpulse(int doll, int body, const vec3& impulse, const vec3& worldPoint) = 0;

    [[nodiscard]] virtual std::optional<RayHit> rayTest(const vec3& from, const vec3& to) const = 0;

    /// At most one drag an id; the same id moves its target. Removing an unknown id does nothing.
    virtual void setDrag(int id, const Drag& drag) = 0;
    virtual void removeDrag(int id) = 0;
    /// Work done by drags since the world was made, joules.
    [[nodiscard]] virtual double dragWork() const = 0;

    /// The contacts of the last substep, appended to `contacts`.
    virtual void getContacts(std::vector<ContactPoint>& contacts) const = 0;

  protected:
    World() = default;
};

}  // namespace lutka::physics
