#pragma once

#include <limits>
#include <map>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "physics/rig/lod_profile.hpp"
#include "physics/world/world.hpp"

namespace lutka::scene {

/// What is spared on dolls far from the eye. Each measure is off until its distance is set: metres from the eye to the
/// doll's root from which on it is taken. They add up.
struct ShedSettings {
    static constexpr float kOff = std::numeric_limits<float>::infinity();
    float lodFrom = kOff;  ///< Merged bodies (physics::LodProfile), switched without a jump in the drawn pose.
    physics::LodLevel lodLevel = physics::LodLevel::limbs;
    float apartFrom = kOff;    ///< Dolls pass through each other, not through anything else: no doll-doll contacts.
    float slowFrom = kOff;     ///< One step in `slowEvery`, over as much time; drawn in between. Collides with the
                               ///< geometry and others that are slow, not with props or dolls that are not.
    int slowEvery = 2;         ///< >= 2. More: cheaper, softer joints, deeper contacts.
    float frozenFrom = kOff;   ///< Stands still and collides with nothing until it is near again; then goes on with the
                               ///< velocities that it had.
    float hysteresis = 0.15F;  ///< [0, 1): the share of a distance by which a doll must come nearer than it before the
                               ///< measure ends. More: fewer switches back and forth.

    [[nodiscard]] bool any() const {
        return lodFrom < kOff || apartFrom < kOff || slowFrom < kOff || frozenFrom < kOff;
    }
};

/// "lod@10,apart@15,slow@20,frozen@40", in metres; `lod7@10` merges into 7 bodies, `slow3@20` takes one step in three.
/// Fails with ErrorCode::usage on anything else.
[[nodiscard]] Result<ShedSettings> parseShedSettings(std::string_view list);

/// The dolls of a world, with what is far from the eye made cheaper. Dolls that sleep or are dragged stay as they are:
/// the former cost nothing, the latter are looked at.
class LoadShedder {
  public:
    /// What is being spared on a doll.
    struct Measures {
        bool lod = false;
        bool apart = false;
        bool slow = false;
        bool frozen = false;
        bool operator==(const Measures&) const = default;
    };

    /// A rig with the profile that it binds.
    struct Kind {
        const physics::RagdollProfile* profile = nullptr;
        const physics::Rig* rig = nullptr;
    };

    /// `world`, made with `worldSettings`, holds `statics` and its dolls, one a kind of `kinds` in order, each of that
    /// profile. They belong to the shedder from now on, and their ids there change. World, profiles and rigs must
    /// outlive it.
    LoadShedder(std::span<const Kind> kinds, physics::World& world, std::span<const physics::StaticShape> statics,
                const physics::WorldSettings& worldSettings, const ShedSettings& settings);

    /// One step of dt: first every doll is given the measures for its distance from `eye`, then the world is stepped.
    void step(float dt, const vec3& eye);

    /// The bodies of a doll of the full profile as they are to be drawn.
    void getBodies(int doll, std::span<RigidTransform> worldFromBody) const;
    /// With velocities, at the last step that was taken of it: a slow doll is ahead of what is drawn.
    void getStates(int doll, std::span<physics::BodyState> bodies) const;
    [[nodiscard]] const Measures& measuresOf(int doll) const { return dolls_[doll].measures; }
    /// Whether nothing of it can change until it wakes or the eye moves.
    [[nodiscard]] bool still(int doll) const;
    /// What `world` calls a doll now; unset while it is not there.
    [[nodiscard]] physics::DollId idIn(const physics::World& world, int doll) const;
    /// How many dolls each measure is taken on.
    struct Counts {
        int lod = 0, apart = 0, slow = 0, frozen = 0;
    };
    [[nodiscard]] Counts counts() const;
    /// Switches so far, of all dolls.
    [[nodiscard]] int switches() const { return switches_; }

  private:
    struct Doll {
        const physics::RagdollProfile* profile = nullptr;
        const physics::LodProfile* lod = nullptr;
        Measures measures;
        physics::DollId id;                       // in its world; unset while frozen
        std::vector<quat> lodFromMember;          // while merged
        std::vector<physics::BodyState> stopped;  // while frozen, of the full profile
        std::vector<RigidTransform> before;       // slow: what was shown before the last step …
        std::vector<RigidTransform> after;        // … and what will be after its time
    };
    [[nodiscard]] Measures wanted(const Doll& doll, float distance) const;
    [[nodiscard]] physics::World& worldOf(const Doll& doll) const;
    [[nodiscard]] bool mayChange(const Doll& doll) const;
    void change(int doll, const Measures& to);
    void takeOut(int doll);
    void putIn(int doll, std::span<const physics::BodyState> bodies);
    void stepSlow(float dt);

    physics::World& near_;
    std::unique_ptr<physics::World> slow_;
    ShedSettings settings_;
    std::map<const physics::RagdollProfile*, physics::LodProfile> lods_;
    std::vector<Doll> dolls_;
    std::vector<int> slowOnes_;  // dolls in slow_
    int phase_ = 0;              // steps since the slow ones' last
    int switches_ = 0;
    std::vector<RigidTransform> shown_;  // the doll at hand
    mutable std::vector<physics::BodyState> full_;
    mutable std::vector<physics::BodyState> merged_;
};

}  // namespace lutka::scene
