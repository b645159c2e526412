#include "animation/skeleton.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <utility>

#include "animation/joint_paths.hpp"

namespace lutka::animation {
namespace {

// A joint's name as a step of a path: NAME for the first sibling of the name, NAME#2 for the second …
std::vector<std::string> pathSteps(const Skeleton& skeleton) {
    std::map<std::pair<int, std::string_view>, int> siblings;  // of one parent and name, so far
    std::vector<std::string> steps;
    steps.reserve(skeleton.parents.size());
    for (int joint = 0; joint < skeleton.jointCount(); ++joint) {
        const std::string& name = skeleton.names[joint];
        const int ordinal = ++siblings[{skeleton.parents[joint], name}];
        steps.push_back(ordinal > 1 ? fmt::format("{}#{}", name, ordinal) : name);
    }
    return steps;
}

bool isUsable(const RigidTransform& frame) {
    return isFinite(frame) && isPlace(frame.translation) &&
           std::abs(glm::dot(frame.rotation, frame.rotation) - 1.0F) < 1e-3F;
}

}  // namespace

std::vector<std::string> jointPaths(const Skeleton& skeleton) {
    std::vector<std::string> paths = pathSteps(skeleton);
    for (int joint = 0; joint < skeleton.jointCount(); ++joint) {
        const int parent = skeleton.parents[joint];
        if (parent != kNoJoint) paths[joint] = paths[parent] + '/' + paths[joint];
    }
    return paths;
}

std::string jointPath(const Skeleton& skeleton, int joint) {
    const std::vector<std::string> steps = pathSteps(skeleton);
    std::vector<int> chain;
    for (int at = joint; at != kNoJoint; at = skeleton.parents[at])
        chain.push_back(at);
    std::string path;
    for (auto at = chain.rbegin(); at != chain.rend(); ++at)
        path += (path.empty() ? "" : "/") + steps[*at];
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
    const std::vector<std::string> paths = jointPaths(skeleton);
    const auto path = std::find(paths.begin(), paths.end(), pathOrName);
    return path == paths.end() ? kNoJoint : static_cast<int>(path - paths.begin());
}

std::vector<std::vector<int>> childrenOf(const Skeleton& skeleton) {
    std::vector<std::vector<int>> children(skeleton.parents.size());
    for (int joint = 0; joint < skeleton.jointCount(); ++joint) {
        if (skeleton.parents[joint] != kNoJoint) children[skeleton.parents[joint]].push_back(joint);
    }
    return children;
}

bool isAncestorOrSelf(const Skeleton& skeleton, int ancestor, int joint) {
    return isAncestorOrSelf(skeleton.parents, ancestor, joint);
}

bool isAncestorOrSelf(std::span<const int> parents, int ancestor, int joint) {
    while (joint > ancestor)
        joint = parents[static_cast<std::size_t>(joint)];
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
            problems.push_back(fmt::format("joint {} has a bind frame that is not finite, near and rigid", joint));
        }
        if (!isUsable(skeleton.nodeParentFromJoint[joint])) {
            problems.push_back(fmt::format("joint {} has a node frame that is not finite, near and rigid", joint));
        }
        if (!(skeleton.skinWeight[joint] >= 0.0F)) {
            problems.push_back(fmt::format("joint {} has skin weight {}", joint, skeleton.skinWeight[joint]));
        }
    }
    return problems;
}

}  // namespace lutka::animation
