#pragma once

#include <vector>

#include "animation/character.hpp"
#include "animation/humanoid/name_evidence.hpp"

namespace lutka::animation {

/// What the mapper reads off a character once, whatever the axes: the tree, bind positions, skin weights, names.
struct RigFeatures {
    struct Vertex {
        vec3 position;  ///< Model space.
        int joint;      ///< The joint with the largest weight.
    };

    std::vector<vec3> positions;  ///< Model space, bind pose.
    std::vector<int> parents;
    std::vector<std::vector<int>> children;
    std::vector<int> enter;  ///< Order of a depth-first walk; a subtree is [enter, leave).
    std::vector<int> leave;
    std::vector<int> depth;
    std::vector<float> ownWeight;  ///< Share of the whole skin, [0, 1]; that of leaf children where it has none itself.
    std::vector<float> subtreeWeight;  ///< Share of the whole skin, [0, 1].
    bool skinned = false;              ///< False: no weights at all, so that they prove nothing.
    std::vector<NameEvidence> names;   ///< Empty words everywhere when names are not to be used.
    std::vector<Vertex> vertices;      ///< At most some ten thousand, evenly thinned.

    [[nodiscard]] int count() const { return static_cast<int>(positions.size()); }
    [[nodiscard]] int subtreeSize(int joint) const { return leave[joint] - enter[joint]; }
    [[nodiscard]] bool isAncestorOrSelf(int ancestor, int joint) const {
        return enter[ancestor] <= enter[joint] && enter[joint] < leave[ancestor];
    }
    /// kNoJoint when they have no common root.
    [[nodiscard]] int commonAncestor(int a, int b) const;
};

[[nodiscard]] RigFeatures readRig(const Character& character, bool useNames);

}  // namespace lutka::animation
