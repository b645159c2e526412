#include "animation/humanoid/completed_rig.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "animation/humanoid/framed_rig.hpp"

namespace lutka::animation {
namespace {

constexpr float kAside = 0.04F;       // of the spread: nearer joints are the trunk's
constexpr float kLeastReach = 0.35F;  // of the spread, from a limb's first joint to its farthest
constexpr std::size_t kMostLoneLimbs = 2;

class Completer {
  public:
    Completer(const RigFeatures& rig, const MirrorPlane& plane) : rig_(rig), plane_(plane) {
        vec3 up(0, 1, 0);
        if (std::abs(glm::dot(plane.normal, up)) > 0.7F) up = vec3(0, 0, 1);
        up = glm::normalize(up - glm::dot(up, plane.normal) * plane.normal);
        framed_ = frameRig(rig, {plane, up});
    }

    // False where fewer limbs are missing, or more than an arm and a leg.
    [[nodiscard]] bool complete(std::size_t fewest, CompletedRig& completed) const {
        const std::vector<int> limbs = loneLimbs();
        if (limbs.size() < fewest || limbs.size() > kMostLoneLimbs) return false;
        completed.rig = rig_;
        completed.originalOf.assign(rig_.parents.size(), kNoJoint);
        for (const int limb : limbs)
            addImage(limb, completed);
        walkTree(completed.rig);
        return true;
    }

  private:
    [[nodiscard]] bool isAside(int joint) const {
        return std::abs(framed_.positions[joint].x) > kAside * framed_.spread;
    }

    // Of a joint's subtree: the largest distance from the joint, skinned joints and skin alike.
    [[nodiscard]] float reach(int top) const {
        float farthest = 0.0F;
        for (int joint = top; joint < rig_.count(); ++joint) {
            if (rig_.isAncestorOrSelf(top, joint) && rig_.carriesSkin(joint))
                farthest = std::max(farthest, glm::distance(rig_.positions[joint], rig_.positions[top]));
        }
        for (const RigFeatures::Vertex& vertex : rig_.vertices) {
            if (rig_.isAncestorOrSelf(top, vertex.joint))
                farthest = std::max(farthest, glm::distance(vertex.position, rig_.positions[top]));
        }
        return farthest;
    }

    // kNoJoint without one. A joint of the trunk is no partner of one aside, however alike they hang, and so is nothing
    // that hangs on those two.
    [[nodiscard]] int partnerOf(int joint) const {
        if (framed_.pairOf[joint] < 0) return kNoJoint;
        const auto& joints = framed_.pairs[framed_.pairOf[joint]].joints;
        const int partner = joints[0] == joint ? joints[1] : joints[0];
        const int parent = rig_.parents[joint];
        const int other = rig_.parents[partner];
        const bool hangOnPair = parent != kNoJoint && other != kNoJoint && parent != other &&
                                framed_.pairOf[parent] >= 0 && framed_.pairOf[parent] == framed_.pairOf[other];
        const bool honest = isAside(joint) == isAside(partner) && (!hangOnPair || partnerOf(parent) == other);
        return honest ? partner : kNoJoint;
    }

    // What the image hangs on: the trunk's joint itself, or the partner of a paired one that ends there.
    [[nodiscard]] int parentOfImage(int limb) const {
        const int parent = rig_.parents[limb];
        const int partner = partnerOf(parent);
        return partner == kNoJoint ? parent : partner;
    }

    static bool isNoLimb(const NameEvidence& name) {
        const auto said = [&](Part part) { return name.parts[part] >= kTellsTrunkEnd; };
        return name.helper || name.creature || name.tail || said(Part::hips) || said(Part::trunk) ||
               said(Part::chest) || said(Part::neck) || said(Part::head);
    }

    // Whether a joint that moves skin has the same name on the other side: then the limb is there, in whatever pose.
    [[nodiscard]] bool isNamedOnBothSides(int joint) const {
        const NameEvidence& name = rig_.names[joint];
        if (name.side == Side::center || !name.meaningful) return false;
        for (int other = 0; other < rig_.count(); ++other) {
            const NameEvidence& said = rig_.names[other];
            if (said.side == otherSide(name.side) && said.words == name.words && said.numbers == name.numbers &&
                rig_.carriesSkin(other))
                return true;
        }
        return false;
    }

    // Joints without a partner, aside from the trunk, that start a limb: the topmost of their chains.
    [[nodiscard]] std::vector<int> loneLimbs() const {
        std::vector<int> limbs;
        for (int joint = 0; joint < rig_.count(); ++joint) {
            const int parent = rig_.parents[joint];
            if (partnerOf(joint) != kNoJoint || !isAside(joint) || !rig_.carriesSkin(joint)) continue;
            if (parent == kNoJoint || isNoLimb(rig_.names[joint]) || isNamedOnBothSides(joint)) continue;
            // Below another lone joint it comes with that one.
            if (partnerOf(parent) == kNoJoint && isAside(parent)) continue;
            if (parentOfImage(joint) != parent && !rig_.children[parentOfImage(joint)].empty()) continue;
            if (reach(joint) >= kLeastReach * framed_.spread) limbs.push_back(joint);
        }
        return limbs;
    }

    [[nodiscard]] vec3 mirrored(const vec3& point) const {
        return point - 2.0F * (glm::dot(point, plane_.normal) - plane_.offset) * plane_.normal;
    }

    // The stump of the limb: a joint without a partner where the image of `joint` would be. kNoJoint without one.
    [[nodiscard]] int stumpAt(int joint, int parentOfImage) const {
        constexpr float kSamePlace = 0.05F;  // of the spread
        for (const int other : rig_.children[parentOfImage]) {
            const float away = glm::distance(mirrored(rig_.positions[joint]), rig_.positions[other]);
            if (partnerOf(other) == kNoJoint && other != joint && away < kSamePlace * framed_.spread) return other;
        }
        return kNoJoint;
    }

    void addImage(int limb, CompletedRig& completed) const {
        std::vector<int> imageOf(static_cast<std::size_t>(rig_.count()), kNoJoint);
        for (int joint = limb; joint < rig_.count(); ++joint) {
            if (!rig_.isAncestorOrSelf(limb, joint)) continue;
            const int parent = joint == limb ? parentOfImage(limb) : imageOf[rig_.parents[joint]];
            const int stump = parent < rig_.count() ? stumpAt(joint, parent) : kNoJoint;
            imageOf[joint] = stump != kNoJoint ? stump : addJoint(joint, parent, completed);
        }
        for (const RigFeatures::Vertex& vertex : rig_.vertices) {
            const int image = imageOf[vertex.joint];
            if (image >= rig_.count()) completed.rig.vertices.push_back({mirrored(vertex.position), image});
        }
    }

    // The image of one joint. Returns its index.
    [[nodiscard]] int addJoint(int joint, int parent, CompletedRig& completed) const {
        RigFeatures& rig = completed.rig;
        const int image = rig.count();
        completed.originalOf.push_back(joint);
        rig.positions.push_back(mirrored(rig_.positions[joint]));
        rig.parents.push_back(parent);
        rig.children.emplace_back();
        rig.children[parent].push_back(image);
        rig.directWeight.push_back(rig_.directWeight[joint]);
        rig.ownWeight.push_back(rig_.ownWeight[joint]);
        rig.subtreeWeight.push_back(0.0F);
        for (int above = image; above != kNoJoint; above = rig.parents[above])
            rig.subtreeWeight[above] += rig_.directWeight[joint];
        rig.shadow.push_back(rig_.shadow[joint]);
        rig.rigidPart.push_back(rig_.rigidPart[joint]);
        rig.names.push_back(rig_.names[joint]);
        rig.names.back().side = otherSide(rig_.names[joint].side);
        return image;
    }

    const RigFeatures& rig_;
    MirrorPlane plane_;
    FramedRig framed_;
};

// Through the topmost joint on which two parts hang that move skin: the hips, or a root on its way there.
MirrorPlane planeThroughTrunk(const RigFeatures& rig, const vec3& across) {
    for (int joint = 0; joint < rig.count(); ++joint) {
        const auto moves = [&](int child) { return rig.carriesSkin(child); };
        if (std::count_if(rig.children[joint].begin(), rig.children[joint].end(), moves) < 2) continue;
        return {across, glm::dot(rig.positions[joint], across), rig.positions[joint], 0.0F};
    }
    return {across, 0.0F, vec3(0), 0.0F};
}

}  // namespace

std::vector<CompletedRig> completeRig(const RigFeatures& rig) {
    std::vector<CompletedRig> all;
    const auto complete = [&](const MirrorPlane& plane, std::size_t fewest) {
        CompletedRig completed;
        if (Completer(rig, plane).complete(fewest, completed)) all.push_back(std::move(completed));
    };
    for (const MirrorPlane& plane : findMirrorPlanes(rig))
        complete(plane, 1);
    for (const vec3& across : {vec3(1, 0, 0), vec3(0, 0, 1)})
        complete(planeThroughTrunk(rig, across), kMostLoneLimbs);
    return all;
}

}  // namespace lutka::animation
