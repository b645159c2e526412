#pragma once

#include <array>
#include <vector>

#include "animation/humanoid/limb_candidates.hpp"

namespace lutka::animation {

/// Which pairs may follow each other in a limb, and what that costs: by the tree, the skin and the names.
class LimbLinks {
  public:
    LimbLinks(const FramedRig& framed, LimbKind kind);

    /// In log-odds; limb_costs::kImpossible and less where `lower` can't follow `upper`.
    [[nodiscard]] float link(int upper, int lower) const {
        return links_[static_cast<std::size_t>(upper) * framed_.pairs.size() + static_cast<std::size_t>(lower)];
    }
    /// The pairs that may follow `upper`.
    [[nodiscard]] const std::vector<int>& next(int upper) const { return next_[upper]; }
    /// The pairs above `lower` in the tree.
    [[nodiscard]] const std::vector<int>& above(int lower) const { return above_[lower]; }
    /// Whether no pair below this one goes on with the limb.
    [[nodiscard]] bool endsThere(int pair) const { return endsThere_[pair]; }

    /// What the joints with skin between two placed ones cost: twist joints and second segments lie on the straight
    /// line between them, an elbow or a knee does not (where `straight` asks for that).
    [[nodiscard]] float skipped(int upper, int lower, bool straight = true) const;
    /// Whether `lower` may follow `upper` though it hangs elsewhere: rigs with feet under a control root, flat trees.
    [[nodiscard]] bool mayContinueDetached(int upper, int lower) const;
    /// Whether the name says that the pair is this part of the limb: an index into partsOf().
    [[nodiscard]] bool isNamed(int pair, int slot) const;
    /// … and no other part.
    [[nodiscard]] bool isSurelyNamed(int pair, int slot) const;

  private:
    void findAbove();
    void findEnds();
    void findLinks();
    [[nodiscard]] float mainBranchTerm(int upper, int lower) const;
    [[nodiscard]] float linkTerm(int upper, int lower) const;
    [[nodiscard]] bool saysLimb(int pair) const { return isNamed(pair, 0) || isNamed(pair, 1) || isNamed(pair, 2); }
    [[nodiscard]] bool saysOtherLimb(int pair) const;
    [[nodiscard]] bool areNamedInOrder(int upper, int lower) const;
    [[nodiscard]] const JointPair& at(int pair) const { return framed_.pairs[pair]; }

    const FramedRig& framed_;
    LimbKind kind_;
    std::array<Part, 4> parts_;
    std::vector<std::vector<int>> above_;
    std::vector<float> links_;  // of every two pairs
    std::vector<std::vector<int>> next_;
    std::vector<bool> endsThere_;
};

}  // namespace lutka::animation
