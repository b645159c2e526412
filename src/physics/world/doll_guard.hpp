#pragma once

#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "physics/profile/body_state.hpp"
#include "physics/profile/profile.hpp"
#include "physics/world/ids.hpp"

namespace lutka::physics {

/// A doll that was stopped because its motion made no sense.
struct CaughtDoll {
    enum class Why { notFinite, tooFast, energy };
    DollId doll;
    Why why = Why::notFinite;  ///< The first time.
    double seconds = 0.0;      ///< Simulated time at the end of the step in which it was caught first.
    int times = 0;             ///< Steps in which it was caught.
};

/// "a number that is not finite" and so on.
[[nodiscard]] std::string_view textOf(CaughtDoll::Why why);

/// Remembers for each doll of a world how it last moved in a sound way, and tells when it no longer does. Places are
/// those of WorldView::dolls(). Allocates when dolls are added, not in a step.
class DollGuard {
  public:
    static constexpr float kMostSpeed = 500.0F;  ///< m/s, of any body's centre.
    /// A doll may gain as much kinetic energy in a step as it has at this speed, m/s; more is a solver's doing. A body
    /// of its mass that comes as fast and gives it all stays below.
    static constexpr float kMostGain = 100.0F;

    void add(DollId id, const RagdollProfile& profile, std::span<const BodyState> bodies);
    void remove(int doll);
    /// What moves a doll from outside (placing, impulses) makes its energy unknown until the next step begins.
    void touch(int doll) { entries_[doll].known = false; }
    /// Before a step: what was touched is taken as it is now.
    [[nodiscard]] bool knows(int doll) const { return entries_[doll].known; }
    void begin(int doll, std::span<const BodyState> bodies);
    /// Room for a doll's bodies.
    [[nodiscard]] std::span<BodyState> scratch(int doll);

    /// After a step of `dt` seconds that ends at `seconds`: false when the doll has to be put back to goodState(),
    /// which is noted; else its bodies are the good state from now on.
    [[nodiscard]] bool judge(int doll, std::span<const BodyState> bodies, double seconds);
    [[nodiscard]] std::span<const BodyState> goodState(int doll) const { return entries_[doll].good; }
    /// Every doll that was ever caught, in the order of being caught.
    [[nodiscard]] std::span<const CaughtDoll> caught() const { return caught_; }

  private:
    struct Entry {
        DollId id;
        const RagdollProfile* profile;
        std::vector<BodyState> good;
        float energy = 0.0F;    // kinetic, of `good`, joules, at most: as if all turned about their most inert axes
        float mostGain = 0.0F;  // joules
        bool known = true;
    };
    void note(const Entry& entry, CaughtDoll::Why why, double seconds);

    std::vector<Entry> entries_;
    std::vector<BodyState> scratch_;
    std::vector<CaughtDoll> caught_;
};

}  // namespace lutka::physics
