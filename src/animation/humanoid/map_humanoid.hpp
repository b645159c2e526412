#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "animation/character.hpp"
#include "animation/humanoid/roles.hpp"

namespace lutka::animation {

/// One role's joint, with how sure the mapper is and why, in words.
struct RoleBinding {
    int joint = kNoJoint;
    float confidence = 0.0F;  ///< [0, 1]
    std::string reason;
};

/// Which joint plays which role, and how the character stands in its own model space.
struct HumanoidMap {
    bool humanoid = false;    ///< False: refused; `warnings` says why and the rest is empty.
    float confidence = 0.0F;  ///< [0, 1], of the whole assignment.
    /// Each joint has one role at most, but for blocky figures whose trunk is one joint: it is hips and spine in one.
    std::array<std::optional<RoleBinding>, kRoleCount> roles;
    std::vector<Role> missing;  ///< Required roles without a joint.
    std::vector<std::string> warnings;

    /// Rotation into the standard stance: +Y up, facing +Z, the character's left at +X. The importer settles the up
    /// axis where the file says it; this holds whatever is left, and the way the figure faces.
    quat standardFromModel{1, 0, 0, 0};

    [[nodiscard]] const std::optional<RoleBinding>& operator[](Role role) const { return roles[indexOf(role)]; }
    [[nodiscard]] int jointOf(Role role) const { return roles[indexOf(role)] ? roles[indexOf(role)]->joint : kNoJoint; }
};

struct MapOptions {
    bool useNames = true;         ///< False: topology, geometry and weights alone.
    bool useFileHumanoid = true;  ///< False: ignore the file's own VRM humanoid block.
    /// Bindings that the user fixed; kept as they are, the rest is assigned around them.
    std::array<std::optional<int>, kRoleCount> fixed{};
};

/// Binds joints to roles by names, topology, bind-pose geometry and skin weights, as one globally best assignment.
/// Never fails: what is not a humanoid comes back with humanoid = false and the reason.
[[nodiscard]] HumanoidMap mapHumanoid(const Character& character, const MapOptions& options = {});

}  // namespace lutka::animation
