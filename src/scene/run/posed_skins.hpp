#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "physics/rig/doll_poser.hpp"
#include "scene/asset/ragdoll_asset.hpp"
#include "scene/description/scenario.hpp"

namespace lutka::scene {

/// Poses and palettes of all dolls of a scene, many at a time (physics::DollPoser). A doll whose bodies are where they
/// were keeps what it has, so that a crowd at rest costs nothing.
class PosedSkins {
  public:
    /// How a doll's bodies go on, as update() needs to know it.
    struct Motion {
        std::uint32_t revision = 0;  ///< Another number whenever a bit of its bodies, before or after, has changed.
        bool moves = true;           ///< Whether its bodies differ between `previous` and `present`.
    };
    struct Bodies {
        std::span<const RigidTransform> previous;  ///< World; doll after doll in the scenario's order.
        std::span<const RigidTransform> present;   ///< Likewise; both may be longer than the dolls' bodies.
        std::span<const Motion> motions;           ///< One a doll.
    };

    /// `assets` as the scenario's placements count them; they must outlive the skins and stay as they are. `threads` as
    /// for TaskPool.
    PosedSkins(std::span<const RagdollAsset* const> assets, const Scenario& scenario, int threads);
    PosedSkins(const PosedSkins&) = delete;
    PosedSkins& operator=(const PosedSkins&) = delete;

    /// Poses what has changed since the last call `alpha` of the way from `previous` to `present`, in [0, 1]; a doll
    /// that rests is posed once, at `present`. Allocates nothing with one thread.
    void update(const Bodies& bodies, float alpha);

    /// Shows a doll in a pose that its bodies do not give, until its next update(). `modelFromJoint` holds a frame a
    /// joint of `skeleton`, which is the doll's.
    void show(int doll, const animation::Skeleton& skeleton, std::span<const RigidTransform> modelFromJoint);

    /// In model space, one a joint of the doll's asset. Valid and in place as long as the skins live.
    [[nodiscard]] std::span<const RigidTransform> modelFromJoint(int doll) const { return ofDoll(poses_, doll); }
    [[nodiscard]] std::span<const animation::SkinMatrix> palette(int doll) const { return ofDoll(palettes_, doll); }
    /// How many dolls the last update() posed.
    [[nodiscard]] int posed() const { return posed_; }

  private:
    // The dolls of one asset.
    struct Kind {
        physics::DollPoser poser;
        std::vector<int> dolls;
    };
    // What a doll's skin was made from.
    struct Made {
        bool ever = false;
        bool between = false;  // two states, `alpha` of the way
        float alpha = 1.0F;
        std::uint32_t revision = 0;
    };
    template <class T>
    [[nodiscard]] std::span<const T> ofDoll(const std::vector<T>& all, int doll) const {
        const auto first = static_cast<std::size_t>(firstJoint_[doll]);
        return std::span(all).subspan(first, static_cast<std::size_t>(firstJoint_[doll + 1]) - first);
    }

    TaskPool pool_;
    std::vector<Kind> kinds_;
    std::vector<RigidTransform> worldFromModel_;
    std::vector<long> firstBody_;   // one a doll
    std::vector<long> firstJoint_;  // one a doll in poses_ and palettes_; then the number of all
    std::vector<Made> made_;
    std::vector<int> between_;  // dolls of one kind that are to be posed
    std::vector<int> resting_;
    std::vector<RigidTransform> poses_;
    std::vector<animation::SkinMatrix> palettes_;
    int posed_ = 0;
};

}  // namespace lutka::scene
