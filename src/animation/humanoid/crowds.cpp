#include "animation/humanoid/crowds.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <utility>

#include "animation/carrying_joints.hpp"
#include "animation/humanoid/name_evidence.hpp"

namespace lutka::animation {
namespace {

constexpr int kMostOfPart = 4;            // joints of a small part: no figure has fewer than five
constexpr int kFewestOfCrowd = 256;       // parts side by side
constexpr int kFewestOfMultitude = 2048;  // … of which names tell nothing any more
constexpr std::size_t kHugeScene = 4096;  // joints: here groups of parts hang on groups, and …
constexpr int kHugeScale = 16;            // … so many times fewer are a crowd
constexpr std::size_t kFewestInScene = 2 * std::size_t{kFewestOfCrowd};
constexpr int kLeastChain = 3;    // nodes, one below the other: as a limb has
constexpr int kMostOfBody = 256;  // parts of a crowd that are taken for a body's by one sign: more are a crowd, too

bool speaksOfBody(const NameEvidence& evidence) {
    return std::any_of(evidence.parts.values.begin(), evidence.parts.values.end(),
                       [](float score) { return score > 0.0F; });
}

// Signs that a part is a body's, each of which may be many a part's in a scene.
enum Sign : unsigned { kNoSign = 0, kChain = 1, kLimb = 2, kSidedLimb = 4 };
constexpr std::array<Sign, 3> kSigns{kChain, kLimb, kSidedLimb};

unsigned signsOfName(const NameEvidence& evidence) {
    const PartScores& parts = evidence.parts;
    constexpr std::array<Part, 8> kLimbs{Part::clavicle, Part::upperArm, Part::lowerArm, Part::hand,
                                         Part::upperLeg, Part::lowerLeg, Part::foot,     Part::toes};
    const bool limb =
        std::any_of(kLimbs.begin(), kLimbs.end(), [&](Part part) { return parts[part] >= kTellsPartOfLimb; });
    if (limb && evidence.side != Side::center) return kLimb | kSidedLimb;
    return limb || parts[Part::head] >= kTellsTrunkEnd || parts[Part::hips] >= kTellsTrunkEnd ? kLimb : kNoSign;
}

// What is left of a scene while crowds are taken from it, one entry a joint.
struct Nodes {
    std::vector<int> original;  // index in the whole skeleton
    std::vector<int> parents;   // kNoJoint of roots
    std::vector<bool> stays;    // it moves skin, or the caller keeps it
    std::vector<bool> named;    // its name is of a part of a body
    std::vector<unsigned> signs;

    [[nodiscard]] std::size_t count() const { return parents.size(); }
};

Nodes readNodes(const Character& character, const std::vector<int>& kept, bool useNames) {
    const Skeleton& skeleton = character.skeleton;
    const std::size_t count = skeleton.names.size();
    Nodes nodes{std::vector<int>(count), skeleton.parents, carryingJoints(character).skin,
                std::vector<bool>(count, false), std::vector<unsigned>(count, kNoSign)};
    std::iota(nodes.original.begin(), nodes.original.end(), 0);
    for (const int joint : kept)
        nodes.stays[static_cast<std::size_t>(joint)] = true;
    for (std::size_t joint = 0; useNames && joint < count; ++joint) {
        const NameEvidence evidence = nameEvidence(skeleton.names[joint]);
        nodes.named[joint] = speaksOfBody(evidence);
        nodes.signs[joint] = signsOfName(evidence);
    }
    return nodes;
}

void takeOut(const std::vector<bool>& gone, Nodes& nodes) {
    Nodes left;
    std::vector<int> fresh(gone.size(), kNoJoint);
    for (std::size_t joint = 0; joint < gone.size(); ++joint) {
        if (gone[joint]) continue;
        const int parent = nodes.parents[joint];
        fresh[joint] = static_cast<int>(left.count());
        left.original.push_back(nodes.original[joint]);
        left.parents.push_back(parent == kNoJoint ? kNoJoint : fresh[static_cast<std::size_t>(parent)]);
        left.stays.push_back(nodes.stays[joint]);
        left.named.push_back(nodes.named[joint]);
        left.signs.push_back(nodes.signs[joint]);
    }
    nodes = std::move(left);
}

// Small parts below each joint: the tops of what has no skin and few joints, and whether a name there is of a body.
struct Parts {
    std::vector<bool> small;      // per joint: it and all below it are few, and move no skin
    std::vector<bool> named;      // per joint: it or one below it is named as a part of a body
    std::vector<unsigned> signs;  // per joint: of it and of those below it
};

Parts findParts(const Nodes& nodes) {
    const std::size_t count = nodes.count();
    Parts parts{std::vector<bool>(count, true), nodes.named, nodes.signs};
    std::vector<int> size(count, 1);
    std::vector<int> height(count, 1);
    for (std::size_t joint = count; joint-- > 0;) {
        if (nodes.stays[joint] || size[joint] > kMostOfPart) parts.small[joint] = false;
        if (height[joint] >= kLeastChain) parts.signs[joint] |= kChain;
        if (nodes.parents[joint] == kNoJoint) continue;
        const auto parent = static_cast<std::size_t>(nodes.parents[joint]);
        size[parent] += size[joint];
        if (!parts.small[joint]) parts.small[parent] = false;
        if (parts.named[joint]) parts.named[parent] = true;
        parts.signs[parent] |= parts.signs[joint];
        height[parent] = std::max(height[parent], height[joint] + 1);
    }
    return parts;
}

// Limbs of rigid parts may hang beside a crowd. A sign that a whole crowd bears is none.
void keepBodies(const Parts& parts, std::vector<bool>& gone) {
    unsigned telling = kNoSign;
    for (const Sign sign : kSigns) {
        int bearers = 0;
        for (std::size_t joint = 0; joint < gone.size(); ++joint)
            bearers += gone[joint] && (parts.signs[joint] & sign) != 0 ? 1 : 0;
        if (bearers <= kMostOfBody) telling |= sign;
    }
    for (std::size_t joint = 0; joint < gone.size(); ++joint)
        gone[joint] = gone[joint] && (parts.signs[joint] & telling) == 0;
}

std::vector<bool> findCrowds(const Nodes& nodes) {
    const Parts parts = findParts(nodes);
    const std::size_t count = nodes.count();
    std::vector<int> beside(count + 1, 0);   // per parent: small parts on it; the last is of those on none
    std::vector<int> unnamed(count + 1, 0);  // … whose names say nothing
    const auto parentOf = [&](std::size_t joint) {
        return nodes.parents[joint] == kNoJoint ? count : static_cast<std::size_t>(nodes.parents[joint]);
    };
    for (std::size_t joint = 0; joint < count; ++joint) {
        if (!parts.small[joint]) continue;
        ++beside[parentOf(joint)];
        if (!parts.named[joint]) ++unnamed[parentOf(joint)];
    }
    const int scale = count > kHugeScene ? kHugeScale : 1;
    std::vector<bool> gone(count, false);
    for (std::size_t joint = 0; joint < count; ++joint) {
        const std::size_t parent = parentOf(joint);
        gone[joint] = parts.small[joint] && (beside[parent] >= kFewestOfMultitude / scale ||
                                             (!parts.named[joint] && unnamed[parent] >= kFewestOfCrowd / scale));
    }
    keepBodies(parts, gone);
    for (std::size_t joint = 0; joint < count; ++joint) {
        const std::size_t parent = parentOf(joint);
        gone[joint] = gone[joint] || (parent < count && gone[parent]);
    }
    return gone;
}

}  // namespace

int WithoutCrowds::placeOf(int joint) const {
    const auto place = std::lower_bound(original.begin(), original.end(), joint);
    return place != original.end() && *place == joint ? static_cast<int>(place - original.begin()) : kNoJoint;
}

std::optional<WithoutCrowds> leaveOutCrowds(const Character& character, const std::vector<int>& kept, bool useNames) {
    const Skeleton& skeleton = character.skeleton;
    const std::size_t count = skeleton.names.size();
    if (count < kFewestInScene) return std::nullopt;
    Nodes nodes = readNodes(character, kept, useNames);
    // What a crowd hung on may be one of a crowd without it.
    while (nodes.count() >= kFewestInScene) {
        const std::vector<bool> crowds = findCrowds(nodes);
        if (std::find(crowds.begin(), crowds.end(), true) == crowds.end()) break;
        takeOut(crowds, nodes);
    }
    if (nodes.count() == count) return std::nullopt;
    std::vector<bool> gone(count, true);
    for (const int joint : nodes.original)
        gone[static_cast<std::size_t>(joint)] = false;
    WithoutCrowds left;
    Skeleton& few = left.character.skeleton;
    std::vector<int> fresh(gone.size(), kNoJoint);
    for (std::size_t joint = 0; joint < gone.size(); ++joint) {
        if (gone[joint]) continue;
        const int parent = skeleton.parents[joint];
        fresh[joint] = static_cast<int>(left.original.size());
        left.original.push_back(static_cast<int>(joint));
        few.names.push_back(skeleton.names[joint]);
        few.parents.push_back(parent == kNoJoint ? kNoJoint : fresh[static_cast<std::size_t>(parent)]);
        few.bindModelFromJoint.push_back(skeleton.bindModelFromJoint[joint]);
        few.nodeParentFromJoint.push_back(skeleton.nodeParentFromJoint[joint]);
        few.skinWeight.push_back(skeleton.skinWeight[joint]);
    }
    const auto freshOf = [&](std::uint16_t joint) {
        return joint < fresh.size() && fresh[joint] != kNoJoint ? static_cast<std::uint16_t>(fresh[joint])
                                                                : std::uint16_t{0};
    };
    for (const SkinnedMesh& mesh : character.meshes) {
        const bool ofCrowd =
            mesh.rigid && !mesh.joints.empty() && mesh.joints[0][0] < gone.size() && gone[mesh.joints[0][0]];
        if (ofCrowd) continue;
        left.character.meshes.push_back(mesh);
        for (auto& joints : left.character.meshes.back().joints)
            std::transform(joints.begin(), joints.end(), joints.begin(), freshOf);
    }
    for (const auto& [bone, joint] : character.vrmHumanoid) {
        if (joint >= 0 && joint < skeleton.jointCount() && fresh[static_cast<std::size_t>(joint)] != kNoJoint)
            left.character.vrmHumanoid[bone] = fresh[static_cast<std::size_t>(joint)];
    }
    return left;
}

}  // namespace lutka::animation
