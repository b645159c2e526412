#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "physics/collision/collision_filter.hpp"
#include "physics/collision/static_shape.hpp"
#include "physics/profile/body_state.hpp"
#include "physics/profile/profile.hpp"
#include "physics/world/id_table.hpp"
#include "physics/world/ids.hpp"
#include "physics/world/step_times.hpp"

namespace lutka::physics {

/// Free rigid props (the scene `balls`).
struct DynamicProp {
    BodyShape shape;
    float massKg = 1.0F;
    BodyState state;
    CollisionFilter filter;
};

/// What keeps a world from taking it, in a few words; empty: nothing.
[[nodiscard]] std::string_view faultOf(const StaticShape& shape);
[[nodiscard]] std::string_view faultOf(const DynamicProp& prop);

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
        DollId doll;     ///< Set for Kind::doll,
        PropId prop;     ///< for Kind::prop,
        StaticId fixed;  ///< and for Kind::fixed.
        int body = 0;    ///< Of the doll; 0 for others.
        bool operator==(const Side&) const = default;
    };
    Side a, b;
    vec3 position{0, 0, 0};  ///< World, on B, where the two touched last.
    vec3 normal{0, 1, 0};    ///< Unit, from B towards A.
    float impulse = 0.0F;    ///< N s along the normal, summed over the step; > 0.
};

/// What a ray meets.
struct RayHit {
    DollId doll;    ///< Unset: static geometry or a prop.
    int body = -1;  ///< Body of the doll.
    vec3 position{0, 0, 0};
    vec3 normal{0, 1, 0};
    float fraction = 1.0F;  ///< Of the ray's length.
};

/// A world to be looked at: what measuring and drawing need of it. All positions in metres, world space.
///
/// A call that makes no sense (an id of nothing or of something removed, a number out of range or not finite) is
/// refused in every build: nothing changes, what is returned is empty, and the refusal's sink gets a line that says
/// what was wrong. Solvers are only ever handed calls that passed.
class WorldView {
  public:
    virtual ~WorldView() = default;
    WorldView(const WorldView&) = delete;
    WorldView& operator=(const WorldView&) = delete;

    /// What there is, in the order of adding.
    [[nodiscard]] std::span<const DollId> dolls() const { return dollIds_.ids(); }
    [[nodiscard]] std::span<const PropId> props() const { return propIds_.ids(); }
    [[nodiscard]] std::span<const StaticId> statics() const { return staticIds_.ids(); }
    [[nodiscard]] bool has(DollId doll) const { return dollIds_.placeOf(doll) >= 0; }
    [[nodiscard]] bool has(PropId prop) const { return propIds_.placeOf(prop) >= 0; }
    [[nodiscard]] bool has(StaticId fixed) const { return staticIds_.placeOf(fixed) >= 0; }

    [[nodiscard]] const RagdollProfile& profileOf(DollId doll) const;
    /// Principal moments that the solver gives a body, kg m²; not below the profile's (docs/physics.md, conditioning).
    [[nodiscard]] vec3 inertiaOf(DollId doll, int body) const;
    /// `bodies` holds one state a body of the profile.
    void getBodies(DollId doll, std::span<BodyState> bodies) const;
    [[nodiscard]] bool isAsleep(DollId doll) const;
    /// What the prop was made as; its state is that of the start.
    [[nodiscard]] const DynamicProp& propOf(PropId prop) const;
    [[nodiscard]] BodyState propState(PropId prop) const;

    /// The nearest thing that the segment enters and that is in one of `layers`; what it starts in is not met, nor is a
    /// mesh from behind. Positions are those of the last step or placing.
    [[nodiscard]] std::optional<RayHit> rayTest(const vec3& from, const vec3& to,
                                                std::uint32_t layers = CollisionFilter::kAll) const;

    [[nodiscard]] virtual int substepsPerStep() const = 0;
    /// How many a step of `dt` seconds usually has: substepsPerStep() unless the solver takes more in a longer one.
    [[nodiscard]] virtual int usualSubsteps(float /*dt*/) const { return substepsPerStep(); }
    /// Work done by drags since the world was made, joules.
    [[nodiscard]] virtual double dragWork() const { return 0.0; }
    /// What drags have given their bodies since the world was made, N s: of each body the length of the sum of its
    /// drags' impulses in a substep, added up. Without what leads bodies to frames.
    [[nodiscard]] virtual double dragImpulse() const { return 0.0; }
    /// Work done by motors and applied forces since the world was made, joules.
    [[nodiscard]] virtual double motorWork() const { return 0.0; }
    /// Work done by impulses (World::applyImpulse) since the world was made, joules.
    [[nodiscard]] virtual double impulseWork() const { return 0.0; }
    /// The contacts of the last substep, appended to `contacts`.
    virtual void getContacts(std::vector<ContactPoint>& /*contacts*/) const {}
    /// What pushed what in the last step, in an order that the same calls repeat; empty without
    /// WorldSettings::contactReports. What is removed takes the reports with it.
    [[nodiscard]] virtual std::span<const ContactReport> contactReports() const { return {}; }
    /// What the parts of the last step took; zeros before the first one and where a world does not measure.
    [[nodiscard]] virtual StepTimes stepTimes() const { return {}; }

    /// Takes a line of debug drawing: two points in world space and its colour, components in [0, 1].
    using DebugLineSink = std::function<void(const vec3& from, const vec3& to, const vec3& color)>;
    /// What the engine's own debug drawer shows of this world (shapes, constraints with limits, contacts, boxes), as
    /// lines; nothing where the engine has none.
    virtual void drawDebug(const DebugLineSink& /*line*/) const {}

    /// Takes the line that says why a call was refused.
    using RefusalSink = std::function<void(std::string_view message)>;
    /// Empty: the default again, which prints the line to stderr.
    void setRefusalSink(RefusalSink sink) { refusalSink_ = std::move(sink); }
    /// How many calls were refused so far.
    [[nodiscard]] int refusals() const { return refusals_; }

  protected:
    WorldView() = default;

    [[nodiscard]] int placeOf(DollId doll) const { return dollIds_.placeOf(doll); }
    /// Places of what the call names; -1, and the call is refused, when it isn't there.
    [[nodiscard]] int checked(std::string_view call, DollId doll) const;
    [[nodiscard]] int checked(std::string_view call, PropId prop) const;
    [[nodiscard]] int checked(std::string_view call, StaticId fixed) const;
    void refuse(std::string_view call, std::string_view why) const;

    IdTable<DollId> dollIds_;
    IdTable<PropId> propIds_;
    IdTable<StaticId> staticIds_;

    // What a solver does, with arguments that were checked. Dolls and props by their places among those there are, in
    // the order of adding.
    [[nodiscard]] virtual const RagdollProfile& profileAt(int doll) const = 0;
    [[nodiscard]] virtual vec3 inertiaAt(int doll, int body) const = 0;
    virtual void getBodiesAt(int doll, std::span<BodyState> bodies) const = 0;
    [[nodiscard]] virtual bool isAsleepAt(int doll) const = 0;
    [[nodiscard]] virtual const DynamicProp& propAt(int prop) const = 0;
    [[nodiscard]] virtual BodyState propStateAt(int prop) const = 0;
    [[nodiscard]] virtual std::optional<RayHit> castRay(const vec3& /*from*/, const vec3& /*to*/,
                                                        std::uint32_t /*layers*/) const {
        return std::nullopt;
    }

  private:
    RefusalSink refusalSink_;
    mutable int refusals_ = 0;
};

}  // namespace lutka::physics
