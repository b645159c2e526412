#include "animation/skeleton.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/gtc/quaternion.hpp>

namespace lutka::animation {
namespace {

// 1 for the first sibling of a name, 2 for the second …
int ordinalAmongSiblings(const Skeleton& skeleton, int joint) {
    int ordinal = 1;
    for (int other = 0; other < joint; ++other) {
        if (skeleton.parents[other] == skeleton.parents[joint] && skeleton.names[other] == skeleton.names[joint]) {
            ++ordinal;
        }
    }
    return ordinal;
}

bool isUsable(const RigidTransform& frame) {
    return isFinite(frame) && std::abs(glm::dot(frame.rotation, frame.rotation) - 1.0F) < 1e-3F;
}

}  // namespace

std::string jointPath(const Skeleton& skeleton, int joint) {
    std::string path;
    for (int at = joint; at != kNoJoint; at = skeleton.parents[at]) {
        std::string step = skeleton.names[at];
        if (const int ordinal = ordinalAmongSiblings(skeleton, at); ordinal > 1) step += fmt::format("#{}", ordinal);
        path = path.empty() ? std::move(step) : fmt::format("{}/{}", step, path);
    }
    return path;
}

int findJoint(const Skeleton& skeleton, std::string_view pathOrName) {
    int found = kNoJoint;
    int matches = 0;
    for (int joint = 0; joint < skeleton.jointCount(); ++joint) {
        if (skeleton.names[joint] == pathOrName) {
            found = joint;
            ++matches;
        }
    }
    if (matches == 1) return found;
    for (int joint = 0; joint < skeleton.jointCount(); ++joint) {
        if (jointPath(skeleton, joint) == pathOrName) return joint;
    }
    return kNoJoint;
}

std::vector<std::vector<int>> childrenOf(const Skeleton& skeleton) {
    std::vector<std::vector<int>> children(skeleton.parents.size());
    for (int joint = 0; joint < skeleton.jointCount(); ++joint) {
        if (skeleton.parents[joint] != kNoJoint) children[skeleton.parents[joint]].push_back(joint);
    }
    return children;
}

bool isAncestorOrSelf(const Skeleton& skeleton, int ancestor, int joint) {
    while (joint > ancestor)
        joint = skeleton.parents[joint];
    return joint == ancestor;
}

std::vector<std::string> validate(const Skeleton& skeleton) {
    std::vector<std::string> problems;
    const std::size_t count = skeleton.parents.size();
    if (skeleton.names.size() != count || skeleton.bindModelFromJoint.size() != count ||
        skeleton.nodeParentFromJoint.size() != count || skeleton.skinWeight.size() != count) {
        problems.push_back(fmt::format("arrays of different sizes beside {} parents", count));
        return problems;
    }
    for (int joint = 0; joint < skeleton.jointCount(); ++joint) {
        const int parent = skeleton.parents[joint];
        if (parent >= joint || parent < kNoJoint) {
            problems.push_back(fmt::format("joint {} has parent {}, which does not come before it", joint, parent));
        }
        if (!isUsable(skeleton.bindModelFromJoint[joint])) {
            problems.push_back(fmt::format("joint {} has a bind frame that is not finite and rigid", joint));
        }
        if (!isUsable(skeleton.nodeParentFromJoint[joint])) {
            problems.push_back(fmt::format("joint {} has a node frame that is not finite and rigid", joint));
        }
        if (!(skeleton.skinWeight[joint] >= 0.0F)) {
            problems.push_back(fmt::format("joint {} has skin weight {}", joint, skeleton.skinWeight[joint]));
        }
    }
    return problems;
}

}  // namespace lutka::animation
