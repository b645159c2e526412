#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "animation/character.hpp"
#include "animation/humanoid/map_humanoid.hpp"

namespace lutka::animation {

/// A limb without an elbow or knee: it turns as a whole, its middle is a joint that we added.
struct StiffLimb {
    int upper = kNoJoint;   ///< The file's joint.
    int middle = kNoJoint;  ///< Added, half way.
    int end = kNoJoint;     ///< Wrist or ankle; added where the file has none.
    bool leg = false;
};

/// A humanoid whose limbs all end in a wrist or an ankle. Figures of few joints have no hands or feet, or limbs of a
/// single joint; poses are told by where limbs point and end, so what is missing is added where the skin ends. A head
/// that is missing is added above the shoulders, where both arms are there. A figure with both arms and no leg at all
/// (a ghost, a bust, a mermaid) gets two below its hips, as long as a human's are for its trunk.
struct LimbEnds {
    /// The file's joints, then those that were added. The character's own where nothing was, which must outlive it.
    std::shared_ptr<const Skeleton> skeleton;
    std::array<int, kRoleCount> joint{};
    std::vector<StiffLimb> stiff;
    std::optional<float> ankleHeight;  ///< Over the soles, metres; where legs were added.
    std::vector<Role> missing;         ///< Required roles that are neither there nor could be added.
};

/// `map` is one of a humanoid.
[[nodiscard]] LimbEnds addLimbEnds(const Character& character, const HumanoidMap& map);

}  // namespace lutka::animation
