#include "animation/segments/segment_tree.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <string>

#include "core/aabb.hpp"

namespace lutka::animation {
namespace {

constexpr float kLeastSegmentSkin = 0.001F;  // of the whole skin, like the next two
constexpr float kLeastHubSkin = 0.005F;
constexpr float kLeastRootSkin = 0.02F;
constexpr float kMostOfSkin = 0.6F;

// The joint under which all skin hangs; the first root where trees stand side by side. Of rigid parts the first one, or
// where the tree parts above it.
int skinRoot(const RigFeatures& rig) {
    int root = kNoJoint;
    for (int joint = 0; joint < rig.count(); ++joint) {
        if (rig.skinned && rig.directWeight[joint] <= 0.0F) continue;
        if (root == kNoJoint) root = joint;
        const int common = rig.commonAncestor(root, joint);
        if (common != kNoJoint) root = common;
    }
    root = std::max(root, 0);
    const bool ofParts =
        !rig.skinned && std::any_of(rig.rigidPart.begin(), rig.rigidPart.end(), [](bool part) { return part; });
    while (ofParts && !rig.rigidPart[root] && rig.children[root].size() == 1)
        root = rig.children[root].front();
    return root;
}

// Where several branches meet in a control, it gives its place to the heaviest of them: where it moves hardly any skin
// itself, or little and that branch has most of all. The other branches are orphans then. A joint without skin above
// most of it is a control on the way (from a file's root, below which IK feet hang beside it): its body would stand in
// the air.
int rootJoint(const RigFeatures& rig) {
    int root = skinRoot(rig);
    while (rig.skinned && rig.directWeight[root] < kLeastRootSkin) {
        int heaviest = kNoJoint;
        int branches = 0;
        for (const int child : rig.children[root]) {
            if (!rig.carriesSkin(child)) continue;
            ++branches;
            if (heaviest == kNoJoint || rig.subtreeWeight[child] > rig.subtreeWeight[heaviest]) heaviest = child;
        }
        if (heaviest == kNoJoint) return root;
        const bool above = rig.directWeight[root] <= 0.0F && rig.directWeight[heaviest] >= kLeastSegmentSkin &&
                           rig.subtreeWeight[heaviest] >= kMostOfSkin;
        if (branches < 2 && !above) return root;
        const bool hub = rig.directWeight[root] < kLeastHubSkin || rig.subtreeWeight[heaviest] >= kMostOfSkin;
        if (!hub) return root;
        root = heaviest;
    }
    return root;
}

bool isLeaf(const RigFeatures& rig, int joint) {
    return std::none_of(rig.children[joint].begin(), rig.children[joint].end(),
                        [&](int child) { return rig.carriesSkin(child); });
}

bool isOnWay(const RigFeatures& rig, int joint, int from, int to) {
    constexpr float kAside = 0.06F;  // of the way's length
    const vec3 way = rig.positions[to] - rig.positions[from];
    const float square = glm::dot(way, way);
    if (square <= 0.0F) return false;
    const vec3 offset = rig.positions[joint] - rig.positions[from];
    const float along = glm::dot(offset, way) / square;
    return along > -0.05F && along < 0.98F && glm::length(offset - along * way) < kAside * std::sqrt(square);
}

// A leaf on the way from its parent to one of the parent's other children only turns with the limb. So does one that is
// called a twist on the way from its parent to its only child.
bool isTwist(const RigFeatures& rig, int joint) {
    const int parent = rig.parents[joint];
    if (parent == kNoJoint) return false;
    if (!isLeaf(rig, joint)) {
        const bool named = rig.names[joint].helper && !rig.names[joint].control;
        const auto& children = rig.children[joint];
        return named && children.size() == 1 && isOnWay(rig, joint, parent, children.front());
    }
    return std::any_of(rig.children[parent].begin(), rig.children[parent].end(), [&](int other) {
        return other != joint && !isLeaf(rig, other) && isOnWay(rig, joint, parent, other);
    });
}

// Eyes, lips and brows move skin but are no body; a jaw is one.
bool isFace(const RigFeatures& rig, int joint) {
    const std::vector<std::string>& words = rig.names[joint].words;
    const bool jaw = std::any_of(words.begin(), words.end(), [](const std::string& word) {
        return word == "jaw" || word == "chin" || word == "mouth" || word == "ear" || word == "ears";
    });
    return rig.names[joint].face && !jaw;
}

// Grows segments down a tree of joints.
class TreeBuilder {
  public:
    TreeBuilder(const RigFeatures& rig, const RigMeasures& measures, const std::vector<std::string>& names,
                float shortest)
        : rig_(rig), measures_(measures), names_(names), shortest_(shortest) {}

    void growWhole() {
        const int root = rootJoint(rig_);
        start(root, -1);
        grow(0, root);
        for (const int top : orphansOf(root)) {
            const int parent = adopterOf(top, root);
            if (measures_.reach[top] < shortest_ || !hasSkin(top)) {
                segmentOf_[top] = parent;
                grow(parent, top);
            } else {
                growBranch(top, parent);
            }
        }
    }

    void growBranch(int top, int parent) {
        const int segment = start(top, parent);
        grow(segment, top);
    }

    [[nodiscard]] std::vector<Segment> take() {
        for (std::size_t i = 0; i < segments_.size(); ++i)
            segments_[i].end = endOf(static_cast<int>(i));
        return std::move(segments_);
    }

  private:
    [[nodiscard]] bool carries(int joint) const { return rig_.carriesSkin(joint); }
    [[nodiscard]] bool hasSkin(int joint) const {
        return !rig_.skinned || rig_.directWeight[joint] >= kLeastSegmentSkin;
    }

    // Branches beside the root, which the file hangs on a control or on nothing, those near the root first.
    [[nodiscard]] std::vector<int> orphansOf(int root) const {
        std::vector<int> tops;
        for (int joint = 0; joint < rig_.count(); ++joint) {
            const int parent = rig_.parents[joint];
            const bool free = parent == kNoJoint || rig_.isAncestorOrSelf(parent, root);
            if (free && parent != root && carries(joint) && !rig_.isAncestorOrSelf(joint, root)) tops.push_back(joint);
        }
        const auto away = [&](int joint) { return glm::distance(rig_.positions[joint], rig_.positions[root]); };
        std::stable_sort(tops.begin(), tops.end(), [&](int a, int b) { return away(a) < away(b); });
        return tops;
    }

    // The segment that an orphan belongs on: that of a joint in its place (a foot that follows an IK root lies on the
    // end of its leg), else of a near joint on its way to the root.
    [[nodiscard]] int adopterOf(int top, int root) const {
        constexpr float kSamePlace = 0.015F;  // of the size
        constexpr float kDetour = 6.0F;       // a metre of detour counts as so many of distance
        const vec3 from = rig_.positions[top];
        const float toRoot = glm::distance(from, rig_.positions[root]);
        int nearest = segmentOf_[root];
        float least = toRoot;
        for (int joint = 0; joint < rig_.count(); ++joint) {
            const int segment = segmentAbove(joint);
            if (segment < 0 || rig_.isAncestorOrSelf(top, joint)) continue;
            const float away = glm::distance(from, rig_.positions[joint]);
            const float progress = toRoot - glm::distance(rig_.positions[joint], rig_.positions[root]);
            const float cost = away > kSamePlace * measures_.size ? away + kDetour * (away - progress) : away;
            if (cost >= least) continue;
            least = cost;
            nearest = segment;
        }
        return nearest;
    }

    // That of the joint or, for ends without skin, of what they hang on; -1: none yet.
    [[nodiscard]] int segmentAbove(int joint) const {
        for (int at = joint; at != kNoJoint; at = rig_.parents[at])
            if (segmentOf_[at] >= 0) return segmentOf_[at];
        return -1;
    }

    int start(int joint, int parent) {
        if (segmentOf_.empty()) segmentOf_.assign(static_cast<std::size_t>(rig_.count()), -1);
        Segment segment;
        segment.name = freeName(names_[joint]);
        segment.joint = joint;
        segment.parent = parent;
        segments_.push_back(segment);
        segmentOf_[joint] = static_cast<int>(segments_.size()) - 1;
        return segmentOf_[joint];
    }

    void grow(int segment, int joint) {
        for (const int child : rig_.children[joint]) {
            if (!carries(child)) continue;
            if (startsOwn(segment, child)) {
                growBranch(child, segment);
            } else {
                segmentOf_[child] = segment;
                grow(segment, child);
            }
        }
    }

    [[nodiscard]] bool startsOwn(int segment, int joint) const {
        constexpr float kLongBranch = 2.0F;
        const float reach = measures_.reach[joint];
        if (reach < shortest_ || isTwist(rig_, joint) || isFace(rig_, joint)) return false;
        if (!hasSkin(joint) || (rig_.shadow[joint] && isLeaf(rig_, joint))) return false;
        const float away = glm::distance(rig_.positions[joint], rig_.positions[segments_[segment].joint]);
        if (away >= shortest_) return true;
        // Limbs leave hips and chest close to their joints; a chain of short links goes on as one.
        return longBranches(rig_.parents[joint]) > 1 && reach >= kLongBranch * shortest_;
    }

    [[nodiscard]] int longBranches(int joint) const {
        const auto& children = rig_.children[joint];
        return static_cast<int>(std::count_if(children.begin(), children.end(), [&](int child) {
            return carries(child) && measures_.reach[child] >= shortest_ && !isTwist(rig_, child);
        }));
    }

    // The next segment's joint along the way that reaches furthest; where it is the last, its furthest joint.
    [[nodiscard]] int endOf(int segment) const {
        int end = kNoJoint;
        float furthest = 0.0F;
        const vec3 from = rig_.positions[segments_[segment].joint];
        for (const Segment& below : segments_) {
            const float away = glm::distance(rig_.positions[below.joint], from);
            if (below.parent != segment || away < shortest_) continue;
            const float far = away + measures_.reach[below.joint];
            if (far <= furthest) continue;
            furthest = far;
            end = below.joint;
        }
        if (end != kNoJoint || rig_.skinned) return end;
        for (int joint = 0; joint < rig_.count(); ++joint) {
            const float away = glm::distance(rig_.positions[joint], from);
            if (segmentOf_[joint] != segment || away <= furthest) continue;
            furthest = away;
            end = joint;
        }
        return end;
    }

    [[nodiscard]] std::string freeName(const std::string& wanted) const {
        constexpr std::size_t kLongest = 200;
        const std::string base = wanted.empty() ? "joint" : wanted.substr(0, kLongest);
        std::string name = base;
        const auto taken = [&] {
            return roleFromName(name) || std::any_of(segments_.begin(), segments_.end(),
                                                     [&](const Segment& segment) { return segment.name == name; });
        };
        for (int number = 2; taken(); ++number)
            name = base + " " + std::to_string(number);
        return name;
    }

    const RigFeatures& rig_;
    const RigMeasures& measures_;
    const std::vector<std::string>& names_;
    float shortest_;
    std::vector<Segment> segments_;
    std::vector<int> segmentOf_;  // one a joint; -1: none yet
};

}  // namespace

RigMeasures measureRig(const RigFeatures& rig) {
    RigMeasures measures;
    measures.reach.assign(static_cast<std::size_t>(rig.count()), 0.0F);
    Aabb box;
    const auto take = [&](const vec3& point, int joint) {
        box.add(point);
        for (int at = joint; at != kNoJoint; at = rig.parents[at])
            measures.reach[at] = std::max(measures.reach[at], glm::distance(point, rig.positions[at]));
    };
    for (const RigFeatures::Vertex& vertex : rig.vertices)
        take(vertex.position, vertex.joint);
    if (rig.vertices.empty() || !rig.skinned) {
        for (int joint = 0; joint < rig.count(); ++joint)
            take(rig.positions[joint], joint);
    }
    const vec3 size = box.size();
    measures.size = std::max({size.x, size.y, size.z, 1e-3F});
    return measures;
}

std::vector<Segment> segmentTree(const RigFeatures& rig, const RigMeasures& measures,
                                 const std::vector<std::string>& names, float shortest) {
    TreeBuilder builder(rig, measures, names, shortest);
    builder.growWhole();
    return builder.take();
}

std::vector<Segment> segmentBranch(const RigFeatures& rig, const RigMeasures& measures,
                                   const std::vector<std::string>& names, int top, float shortest) {
    TreeBuilder builder(rig, measures, names, shortest);
    builder.growBranch(top, -1);
    return builder.take();
}

}  // namespace lutka::animation
