#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "physics/doctor/doctor.hpp"
#include "physics/world/quality.hpp"
#include "scene/asset/ragdoll_asset.hpp"
#include "scene/puppet/puppet_cast.hpp"

namespace lutka::scene {

class Simulation;

/// What a bound of the measured section says, and where a drop stood to it.
struct MeasuredBound {
    std::string name;  ///< "joint separation" …
    std::string unit;  ///< "mm", "deg", "% of the energy", "s", "m/s"
    float worst = 0;   ///< Of all drops, in that unit.
    float bound = 0;   ///< Above it there is a finding.
};

/// How the doll follows its clip `walk`, or our mannequin's, for three seconds with its profile's muscles (`powered`
/// where it has none), its hips held to the clip.
struct WalkCheck {
    PuppetFigures figures;
    double motorWorkJ = 0.0;
    double pinWorkJ = 0.0;
    double pinImpulseNs = 0.0;
    float recoverySeconds =
        -1.0F;  ///< After a hit of 10 N s on the chest of a doll of 75 kg, in proportion; -1: never.
};

/// The doctor's whole word on a ragdoll: the profile at rest, and how it falls.
struct Checkup {
    physics::Diagnosis diagnosis;         ///< The static findings, then those of the drops.
    std::vector<physics::Quality> drops;  ///< One a drop, seeds 0, 1 and 2.
    std::vector<MeasuredBound> bounds;
    std::optional<WalkCheck> walk;  ///< Has no part in the score. Unset for what is no humanoid, or as `noWalk` says.
    std::string noWalk;             ///< Why it can't take the walk.
    float score = 0;                ///< [0, 100]: four fifths the diagnosis', one fifth the drops'.
};

/// Called at the start of a drop (0, 1, 2) and after each of its steps.
using DropObserver = std::function<void(int drop, Simulation& simulation)>;

/// Diagnoses the profile, lets it fall three times for six seconds in the scene `drop`, and walk. When the static
/// findings hold errors there is neither: a profile that isn't sound isn't simulated.
[[nodiscard]] Checkup examine(const RagdollAsset& asset, const DropObserver& observe = {});
/// The same without the walk, which has no part in the score.
[[nodiscard]] Checkup examineFalls(const RagdollAsset& asset, const DropObserver& observe = {});

[[nodiscard]] std::string checkupJson(const RagdollAsset& asset, const Checkup& checkup);
[[nodiscard]] std::string checkupText(const RagdollAsset& asset, const Checkup& checkup);

}  // namespace lutka::scene
