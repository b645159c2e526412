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
    std::vector<float> directWeight;   ///< Share of the whole skin that the joint itself moves, [0, 1].
    std::vector<float> ownWeight;      ///< As directWeight, but that of leaf children where it is 0.
    std::vector<float> subtreeWeight;  ///< Share of the whole skin, [0, 1].
    /// Control or part that coincides with the joint it belongs to: without skin at the place of a joint that has some,
    /// or a leaf (a rigid part's node, a twist joint) at the place of a joint that has children.
    std::vector<bool> shadow;
    std::vector<bool> rigidPart;      ///< Carries a mesh that has no skin: the node of a part.
    bool skinned = false;             ///< False: no weights at all or only rigid parts, so that they prove nothing.
    bool partlySkinned = false;       ///< Not `skinned` because only a part of the figure has skin: a garment.
    std::vector<NameEvidence> names;  ///< Empty words everywhere when names are not to be used.
    std::vector<Vertex> vertices;     ///< At most some ten thousand, evenly thinned.

    [[nodiscard]] int count() const { return static_cast<int>(positions.size()); }
    [[nodiscard]] int subtreeSize(int joint) const { return leave[joint] - enter[joint]; }
    [[nodiscard]] bool isAncestorOrSelf(int ancestor, int joint) const {
        return enter[ancestor] <= enter[joint] && enter[joint] < leave[ancestor];
    }
    /// Whether the joint or one below it moves skin; true of all where there is no skin.
    [[nodiscard]] bool carriesSkin(int joint) const { return !skinned || subtreeWeight[joint] > 0.0F; }
    /// Whether it carries a mesh without a skin on a joint that moves skin: as a rule something held or worn.
    [[nodiscard]] bool hangsRigidlyOnSkin(int joint) const {
        const int parent = parents[joint];
        return skinned && rigidPart[joint] && parent != kNoJoint && directWeight[parent] > 0.0F;
    }
    /// Whether other fingers hang beside this one and start elsewhere: none of them is the hand. One that starts where
    /// all do may be.
    [[nodiscard]] bool isOneOfFingers(int joint) const;
    [[nodiscard]] bool isOneOfChains(int joint, float apart) const;
    /// The joint whose name says that part most clearly, from that score on, and is no helper's; of equals the one
    /// nearest to the root. kNoJoint without one.
    [[nodiscard]] int namedJoint(Part part, Side side, float least) const;
    /// kNoJoint when they have no common root.
    [[nodiscard]] int commonAncestor(int a, int b) const;
};

/// Root mean square distance of the joints (those with skin, if any have) from their mean, times two.
[[nodiscard]] float spreadOf(const RigFeatures& rig);

/// Fills enter, leave and depth from the parents. A parent comes before its children.
void walkTree(RigFeatures& rig);

[[nodiscard]] RigFeatures readRig(const Character& character, bool useNames);

}  // namespace lutka::animation
