#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "animation/humanoid/map_humanoid.hpp"

namespace lutka::test {

/// What a person found the roles of a model to be (truth.json of the folder of test models).
struct Truth {
    std::string model;  ///< Name of its folder.
    std::filesystem::path file;
    bool humanoid = false;
    /// Names that are right for each role; nothing: not asked. An empty string stands for "the rig has none".
    std::array<std::optional<std::vector<std::string>>, animation::kRoleCount> roles;
    std::vector<std::string> spine;
    std::vector<std::string> chest;
};

/// The joints of a model as its folder's bones.txt lists them, in the pose that its nodes have, with the number of
/// vertices of each; no joints where there is no list.
[[nodiscard]] animation::Character readBones(const Truth& truth);

[[nodiscard]] std::vector<Truth> readTruths(const std::filesystem::path& folder);

struct Score {
    int right = 0;
    int of = 0;
    int optionalRight = 0;
    int optionalOf = 0;
    std::string faults;

    Score& operator+=(const Score& other);
};

/// Counts right roles by the rules of the folder's own scorer: required and optional ones apart, the topmost trunk role
/// must be the chest and the others joints of the spine. `names` are the file's joint names.
[[nodiscard]] Score scoreMap(const Truth& truth, const animation::HumanoidMap& map,
                             const std::vector<std::string>& names);

/// The same truth for the mirror image: left and right exchanged.
[[nodiscard]] Truth mirrorTruth(Truth truth);

}  // namespace lutka::test
