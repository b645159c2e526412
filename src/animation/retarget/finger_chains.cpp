#include "animation/retarget/finger_chains.hpp"

#include <algorithm>
#include <optional>
#include <string_view>

#include "animation/humanoid/name_tokens.hpp"

namespace lutka::animation {
namespace {

constexpr std::size_t kMostJoints = 3;

std::optional<Finger> fingerNamed(const std::string& name) {
    constexpr std::array<std::array<std::string_view, 3>, kFingerCount> kWords{{{"thumb", "thumbs", "daumen"},
                                                                                {"index", "indexfinger", "indice"},
                                                                                {"middle", "mid", "middlefinger"},
                                                                                {"ring", "ringfinger", "anular"},
                                                                                {"little", "pinky", "pinkie"}}};
    for (const std::string& word : tokenise(name).words) {
        for (int finger = 0; finger < kFingerCount; ++finger) {
            const auto& words = kWords[finger];
            if (std::find(words.begin(), words.end(), word) != words.end()) return static_cast<Finger>(finger);
        }
    }
    return std::nullopt;
}

// Down from a joint while the names go on telling of the same finger.
std::vector<int> chainFrom(const Skeleton& skeleton, const std::vector<std::vector<int>>& children, int joint,
                           Finger finger) {
    std::vector<int> chain{joint};
    for (;;) {
        const auto& below = children[chain.back()];
        const auto next = std::find_if(below.begin(), below.end(),
                                       [&](int child) { return fingerNamed(skeleton.names[child]) == finger; });
        if (next == below.end()) return chain;
        chain.push_back(*next);
    }
}

}  // namespace

FingerChains fingersOf(const Skeleton& skeleton, int hand) {
    FingerChains chains;
    const auto children = childrenOf(skeleton);
    for (int joint = hand + 1; joint < skeleton.jointCount(); ++joint) {
        if (!isAncestorOrSelf(skeleton, hand, joint)) continue;
        const auto finger = fingerNamed(skeleton.names[joint]);
        if (!finger) continue;
        std::vector<int>& chain = chains[static_cast<std::size_t>(*finger)];
        if (!chain.empty()) continue;
        chain = chainFrom(skeleton, children, joint, *finger);
        if (chain.size() > kMostJoints) chain.pop_back();
        if (chain.size() > kMostJoints) chain.erase(chain.begin(), chain.end() - kMostJoints);
    }
    return chains;
}

}  // namespace lutka::animation
