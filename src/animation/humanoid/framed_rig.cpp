#include "animation/humanoid/framed_rig.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <string>
#include <utility>

namespace lutka::animation {
namespace {

constexpr float kHeldAway = 0.5F;           // of the spread
constexpr float kMaxCost = 1.8F;            // of a pair found by position
constexpr float kMaxError = 0.10F;          // of the mirrored position, of the spread
constexpr float kMinSeparation = 0.012F;    // of the spread; nearer joints lie in the plane
constexpr float kOnlyChildLengths = 0.9F;   // … where each parent has no other child: one arm is longer
constexpr float kMostLengthCost = 1.0F;     // of unequal lengths, where only children or names make the pair
constexpr float kRounding = 1e-3F;          // of the spread: what lies in the middle
constexpr float kTreeDistance = 0.01F;      // decides between a limb and its copy in another skeleton
constexpr float kChildLengths = 0.18F;      // log ratio of bone lengths of a pair found by structure
constexpr float kAlikeBelowLengths = 0.4F;  // … where what is below them is as long
constexpr float kLimbReach = 0.1F;          // of the spread: that of a limb

vec3 mirrored(vec3 point) {
    point.x = -point.x;
    return point;
}

float nameCost(const NameEvidence& a, const NameEvidence& b) {
    const bool sided = a.side != Side::center && b.side != Side::center;
    if (sided && a.side == b.side) return 1.5F;
    if (!a.meaningful && !b.meaningful) return 0.0F;
    const bool numbers = !a.numbers.empty() && !b.numbers.empty() && a.numbers.front() != b.numbers.front();
    if (a.words == b.words) return (sided ? -0.8F : 0.3F) + (numbers ? 0.25F : 0.0F);
    return 0.6F;
}

class PairFinder {
  public:
    explicit PairFinder(FramedRig& framed) : framed_(framed), rig_(*framed.rig) {
        framed_.pairOf.assign(framed_.positions.size(), -1);
        centroids_.assign(framed_.positions.size(), vec3(0));
        sizes_.assign(framed_.positions.size(), 0.0F);
        for (int joint = rig_.count() - 1; joint >= 0; --joint) {
            const int parent = rig_.parents[joint];
            centroids_[joint] += framed_.positions[joint];
            sizes_[joint] += 1.0F;
            if (parent == kNoJoint) continue;
            // Held or worn on one side, as a rule.
            if (rig_.hangsRigidlyOnSkin(joint) && !rig_.rigidPart[parent]) continue;
            // So are chains without skin that reach far from a joint with skin: a sword whose mesh is no part of the
            // figure. The mark of a bone's end is none.
            if (!rig_.carriesSkin(joint) && rig_.directWeight[parent] > 0.0F && !rig_.children[joint].empty() &&
                glm::distance(framed_.positions[joint], framed_.positions[parent]) > kHeldAway * framed_.spread)
                continue;
            centroids_[parent] += centroids_[joint];
            sizes_[parent] += sizes_[joint];
        }
        for (int joint = 0; joint < rig_.count(); ++joint)
            centroids_[joint] /= sizes_[joint];
    }

    void find() {
        readNamePartners();
        if (framed_.stance.byNames) pairByNames();
        pairByPosition();
        pairByStructure();
        keepToSides();
        std::sort(framed_.pairs.begin(), framed_.pairs.end(), [this](const JointPair& a, const JointPair& b) {
            return rig_.enter[a.joints[0]] < rig_.enter[b.joints[0]];
        });
        for (std::size_t i = 0; i < framed_.pairs.size(); ++i) {
            for (const int joint : framed_.pairs[i].joints)
                framed_.pairOf[joint] = static_cast<int>(i);
        }
    }

  private:
    struct Candidate {
        int a;
        int b;
        float cost;
    };

    [[nodiscard]] bool parentsLinked(int a, int b) const {
        const int parentA = rig_.parents[a];
        const int parentB = rig_.parents[b];
        if (parentA == parentB) return true;
        if (parentA == kNoJoint || parentB == kNoJoint || rig_.depth[a] != rig_.depth[b]) return false;
        const vec3 error = mirrored(framed_.positions[parentA]) - framed_.positions[parentB];
        return glm::length(error) < 0.05F * framed_.spread;
    }

    [[nodiscard]] float ownSeparation(int a, int b) const {
        return std::abs(framed_.positions[a].x - framed_.positions[b].x);
    }

    // Limbs may start in the middle: then what is below them tells.
    [[nodiscard]] float separation(int a, int b) const {
        return std::max(ownSeparation(a, b), std::abs(centroids_[a].x - centroids_[b].x));
    }

    // Named as a part of the trunk.
    [[nodiscard]] bool isTrunk(int joint) const {
        constexpr float kNamed = 1.0F;
        constexpr std::array<Part, 5> kTrunk{Part::hips, Part::trunk, Part::chest, Part::neck, Part::head};
        const NameEvidence& said = rig_.names[joint];
        const auto tells = [&](Part part) { return said.parts[part] >= kNamed; };
        return said.side == Side::center && std::any_of(kTrunk.begin(), kTrunk.end(), tells);
    }

    // What lies in one place with a part of the trunk is its copy or its control (of a control rig), no limb.
    [[nodiscard]] bool isTrunkAndCopy(int a, int b) const {
        return (isTrunk(a) || isTrunk(b)) && ownSeparation(a, b) < kMinSeparation * framed_.spread;
    }

    // How many joints lie on the way from one to the other; two hierarchies count as children of one joint.
    [[nodiscard]] int treeDistance(int a, int b) const {
        const int common = rig_.commonAncestor(a, b);
        return rig_.depth[a] + rig_.depth[b] - (common == kNoJoint ? -2 : 2 * rig_.depth[common]);
    }

    [[nodiscard]] float structureCost(int a, int b) const {
        const float sizes = std::log(sizes_[a] / sizes_[b]);
        const float depths = static_cast<float>(std::abs(rig_.depth[a] - rig_.depth[b]));
        const float weights = std::log((rig_.subtreeWeight[a] + 0.002F) / (rig_.subtreeWeight[b] + 0.002F));
        return 0.6F * std::abs(sizes) + 0.25F * depths + 0.25F * std::min(std::abs(weights), 3.0F) +
               nameCost(rig_.names[a], rig_.names[b]) + kTreeDistance * static_cast<float>(treeDistance(a, b));
    }

    // Where joints start well apart, whatever hangs on them: legs may be crossed at the knees.
    void add(int a, int b) {
        constexpr float kApart = 0.05F;
        const float own = framed_.positions[a].x - framed_.positions[b].x;
        const float below = centroids_[a].x - centroids_[b].x;
        float order = std::abs(own) > kApart * framed_.spread ? own : own + below;
        if (std::abs(order) < kRounding * framed_.spread) order = skinApart(a, b);
        if (order < 0.0F) std::swap(a, b);
        addInOrder(a, b);
    }

    // Legs that turn about one point in the middle: which half the one's skin lies in.
    [[nodiscard]] float skinApart(int a, int b) const {
        return framed_.subtreeSkin[a].mean().x - framed_.subtreeSkin[b].mean().x;
    }

    // `a` is the joint of the +x half.
    void addInOrder(int a, int b) {
        JointPair pair;
        pair.joints = {a, b};
        pair.position = 0.5F * (framed_.positions[a] + mirrored(framed_.positions[b]));
        for (int part = 0; part < kPartCount; ++part) {
            pair.names.values[part] = 0.5F * (rig_.names[a].parts.values[part] + rig_.names[b].parts.values[part]);
        }
        pair.ownWeight = rig_.ownWeight[a] + rig_.ownWeight[b];
        pair.subtreeWeight = rig_.subtreeWeight[a] + rig_.subtreeWeight[b];
        pair.shadow = rig_.shadow[a] && rig_.shadow[b];
        pair.helper = rig_.names[a].helper || rig_.names[b].helper;
        framed_.pairOf[a] = framed_.pairOf[b] = static_cast<int>(framed_.pairs.size());
        framed_.pairs.push_back(pair);
    }

    void addCheapest(std::vector<Candidate>& candidates) {
        std::stable_sort(candidates.begin(), candidates.end(),
                         [](const Candidate& x, const Candidate& y) { return x.cost < y.cost; });
        for (const Candidate& candidate : candidates) {
            if (framed_.pairOf[candidate.a] < 0 && framed_.pairOf[candidate.b] < 0) add(candidate.a, candidate.b);
        }
    }

    // Joints whose names differ in the side alone, where no other joint has such a name.
    void readNamePartners() {
        namePartner_.assign(framed_.positions.size(), kNoJoint);
        std::map<std::pair<std::vector<std::string>, std::vector<int>>, std::array<std::vector<int>, 2>> alike;
        for (int joint = 0; joint < rig_.count(); ++joint) {
            const NameEvidence& name = rig_.names[joint];
            if (name.side == Side::center || !name.meaningful) continue;
            alike[{name.words, name.numbers}][name.side == Side::left ? 0 : 1].push_back(joint);
        }
        for (const auto& [name, sides] : alike) {
            if (sides[0].size() != 1 || sides[1].size() != 1) continue;
            namePartner_[sides[0][0]] = sides[1][0];
            namePartner_[sides[1][0]] = sides[0][0];
        }
    }

    // Legs may be crossed.
    void pairByNames() {
        for (int joint = 0; joint < rig_.count(); ++joint) {
            if (namePartner_[joint] != kNoJoint && rig_.names[joint].side == Side::left)
                addInOrder(joint, namePartner_[joint]);
        }
    }

    // Each has a partner by name, and that is another one: a hand that lies where the other side has its twist joint.
    [[nodiscard]] bool areOthersByName(int a, int b) const {
        return namePartner_[a] != kNoJoint && namePartner_[b] != kNoJoint && namePartner_[a] != b;
    }

    void pairByPosition() {
        std::vector<Candidate> candidates;
        for (int a = 0; a < rig_.count(); ++a) {
            for (int b = a + 1; b < rig_.count(); ++b) {
                if (framed_.pairOf[a] >= 0 || framed_.pairOf[b] >= 0) continue;
                const float error =
                    glm::distance(mirrored(framed_.positions[a]), framed_.positions[b]) / framed_.spread;
                if (error > kMaxError || separation(a, b) < kMinSeparation * framed_.spread) continue;
                // What starts in the middle goes on to one side each: not a head and what it wears in its place.
                if (ownSeparation(a, b) < kMinSeparation * framed_.spread && !areOnBothSides(a, b)) continue;
                if (isTrunkAndCopy(a, b) || areOthersByName(a, b)) continue;
                const bool above = rig_.isAncestorOrSelf(a, b) || rig_.isAncestorOrSelf(b, a);
                if (above && nameCost(rig_.names[a], rig_.names[b]) >= 0.0F) continue;
                const float below = glm::distance(mirrored(centroids_[a]), centroids_[b]) / framed_.spread;
                const float cost =
                    12.0F * error + 5.0F * below + structureCost(a, b) + (parentsLinked(a, b) ? 0.0F : 0.5F);
                if (cost < kMaxCost) candidates.push_back({a, b, cost});
            }
        }
        addCheapest(candidates);
    }

    // A pose that is not symmetric: joints that hang alike, by bone length, from a pair or on both sides of one joint.
    void pairByStructure() {
        for (int joint = 0; joint < rig_.count(); ++joint)
            pairChildren(joint, joint);
        for (std::size_t i = 0; i < framed_.pairs.size(); ++i)
            pairChildren(framed_.pairs[i].joints[0], framed_.pairs[i].joints[1]);
    }

    void pairChildren(int parentA, int parentB) {
        std::vector<Candidate> candidates;
        for (const int a : rig_.children[parentA]) {
            for (const int b : rig_.children[parentB]) {
                if (a == b || (parentA == parentB && a > b)) continue;
                if (framed_.pairOf[a] >= 0 || framed_.pairOf[b] >= 0 || isTrunkAndCopy(a, b)) continue;
                const float lengthA = glm::distance(framed_.positions[a], framed_.positions[parentA]);
                const float lengthB = glm::distance(framed_.positions[b], framed_.positions[parentB]);
                const float floor = 0.01F * framed_.spread;
                const float lengths = std::abs(std::log((lengthA + floor) / (lengthB + floor)));
                const bool apart = separation(a, b) > 0.05F * framed_.spread && areOnBothSides(a, b);
                const bool named = nameCost(rig_.names[a], rig_.names[b]) < 0.0F;
                const bool onlyTwo = parentA != parentB && isOnlyChild(parentA) && isOnlyChild(parentB);
                if (parentA == parentB && !apart && !named) continue;
                const bool close = lengths <= (onlyTwo ? kOnlyChildLengths : kChildLengths);
                // Last, as it takes the longest.
                if (!close && !named && (onlyTwo || lengths > kAlikeBelowLengths || !goOnAlike(a, b))) continue;
                const float cost =
                    std::min(4.0F * lengths, onlyTwo || named ? kMostLengthCost : kMaxCost) + structureCost(a, b);
                if (cost < kMaxCost) candidates.push_back({a, b, cost});
            }
        }
        addCheapest(candidates);
    }

    // Limbs that start unevenly, but are one as long as the other from there.
    [[nodiscard]] bool goOnAlike(int a, int b) {
        if (rig_.children[a].empty() || rig_.subtreeSize(a) != rig_.subtreeSize(b)) return false;
        const float first = reachOf(a);
        const float second = reachOf(b);
        return std::min(first, second) > kLimbReach * framed_.spread &&
               std::abs(std::log(first / second)) < kChildLengths;
    }

    // How far from a joint the farthest one below it lies. Joints side by side ask for it with each of the others.
    [[nodiscard]] float reachOf(int top) {
        if (reaches_.empty()) reaches_.assign(framed_.positions.size(), -1.0F);
        float& reach = reaches_[top];
        if (reach >= 0.0F) return reach;
        reach = 0.0F;
        for (int joint = 0; joint < rig_.count(); ++joint) {
            if (rig_.isAncestorOrSelf(top, joint))
                reach = std::max(reach, glm::distance(framed_.positions[top], framed_.positions[joint]));
        }
        return reach;
    }

    // The pair that a joint hangs on, -1 without, and which of its two joints that is.
    [[nodiscard]] std::pair<int, int> pairAbove(int joint) const {
        for (int above = rig_.parents[joint]; above != kNoJoint; above = rig_.parents[above]) {
            const int pair = framed_.pairOf[above];
            if (pair >= 0) return {pair, framed_.pairs[pair].joints[0] == above ? 0 : 1};
        }
        return {-1, 0};
    }

    // Feet that cross belong to the sides of their legs, whichever half they stand in.
    void keepToSides() {
        std::vector<int> order(framed_.pairs.size());
        std::iota(order.begin(), order.end(), 0);
        std::stable_sort(order.begin(), order.end(), [this](int a, int b) {
            return rig_.depth[framed_.pairs[a].joints[0]] < rig_.depth[framed_.pairs[b].joints[0]];
        });
        for (const int index : order) {
            JointPair& pair = framed_.pairs[index];
            const auto [first, sideOfFirst] = pairAbove(pair.joints[0]);
            const auto [second, sideOfSecond] = pairAbove(pair.joints[1]);
            if (first < 0 || first != second || sideOfFirst != 1 || sideOfSecond != 0) continue;
            std::swap(pair.joints[0], pair.joints[1]);
            pair.position = 0.5F * (framed_.positions[pair.joints[0]] + mirrored(framed_.positions[pair.joints[1]]));
        }
    }

    // What lies in the middle but for rounding is on no side.
    [[nodiscard]] bool areOnBothSides(int a, int b) const {
        const float least = kRounding * framed_.spread;
        const float x = centroids_[a].x;
        const float other = centroids_[b].x;
        return x * other < 0.0F && std::min(std::abs(x), std::abs(other)) > least;
    }

    [[nodiscard]] bool isOnlyChild(int parent) const { return rig_.children[parent].size() == 1; }

    FramedRig& framed_;
    const RigFeatures& rig_;
    std::vector<int> namePartner_;  // by joint; kNoJoint: none, or not the only one
    std::vector<vec3> centroids_;   // of what hangs on a joint, with itself; nothing that is held
    std::vector<float> sizes_;      // in joints, likewise
    std::vector<float> reaches_;    // of reachOf(); below 0 where it was not asked for yet
};

void readSkin(FramedRig& framed) {
    const RigFeatures& rig = *framed.rig;
    const auto intoStance = [&](const vec3& p) {
        return vec3(glm::dot(p, framed.stance.across()) - framed.stance.plane.offset, glm::dot(p, framed.stance.up),
                    glm::dot(p, framed.stance.through()));
    };
    framed.positions.reserve(rig.positions.size());
    for (const vec3& position : rig.positions)
        framed.positions.push_back(intoStance(position));
    framed.ownSkin.resize(rig.positions.size());
    framed.subtreeJoints.resize(rig.positions.size());
    std::vector<float> heights;
    for (const RigFeatures::Vertex& vertex : rig.vertices) {
        const vec3 position = intoStance(vertex.position);
        framed.ownSkin[vertex.joint].add(position);
        heights.push_back(position.y);
    }
    framed.subtreeSkin = framed.ownSkin;
    for (int joint = rig.count() - 1; joint >= 0; --joint) {
        const bool counts = rig.carriesSkin(joint);
        if (counts) framed.subtreeJoints[joint].add(framed.positions[joint]);
        if (counts && heights.empty()) heights.push_back(framed.positions[joint].y);
        if (rig.parents[joint] == kNoJoint || rig.names[joint].held) continue;
        framed.subtreeSkin[rig.parents[joint]].add(framed.subtreeSkin[joint]);
        framed.subtreeJoints[rig.parents[joint]].add(framed.subtreeJoints[joint]);
    }
    if (rig.vertices.empty()) {
        heights.clear();
        for (int joint = 0; joint < rig.count(); ++joint) {
            if (rig.carriesSkin(joint)) heights.push_back(framed.positions[joint].y);
        }
    }
    if (heights.empty()) return;
    const auto hundredth = static_cast<std::ptrdiff_t>(heights.size() / 100);
    std::nth_element(heights.begin(), heights.begin() + hundredth, heights.end());
    framed.floor = heights[static_cast<std::size_t>(hundredth)];
    // The skin of a part ends where that part does: the rest of the figure may reach further down.
    if (!rig.partlySkinned) return;
    for (const vec3& position : framed.positions)
        framed.floor = std::min(framed.floor, position.y);
}

}  // namespace

vec3 Stance::through() const {
    return glm::cross(plane.normal, up);
}

void Box::add(const vec3& point) {
    low = glm::min(low, point);
    high = glm::max(high, point);
    sum += point;
    ++count;
}

void Box::add(const Box& other) {
    low = glm::min(low, other.low);
    high = glm::max(high, other.high);
    sum += other.sum;
    count += other.count;
}

bool FramedRig::isAbove(int upper, int lower) const {
    const JointPair& a = pairs[upper];
    const JointPair& b = pairs[lower];
    return upper != lower && rig->isAncestorOrSelf(a.joints[0], b.joints[0]) &&
           rig->isAncestorOrSelf(a.joints[1], b.joints[1]);
}

bool FramedRig::isTip(const JointPair& pair) const {
    constexpr float kBeyond = 0.08F;  // of the way from the joint above
    if (rig->vertices.empty()) return false;
    return std::all_of(pair.joints.begin(), pair.joints.end(), [&](int joint) {
        const int parent = rig->parents[joint];
        const Box& skin = subtreeSkin[joint];
        if (parent == kNoJoint) return false;
        if (skin.count == 0) return true;  // the joint above moves these corners as much
        const vec3 way = positions[joint] - positions[parent];
        const vec3 most = glm::max((skin.low - positions[joint]) * way, (skin.high - positions[joint]) * way);
        return most.x + most.y + most.z < kBeyond * glm::dot(way, way);
    });
}

float FramedRig::segment(int pairA, int pairB) const {
    const auto& a = pairs[pairA].joints;
    const auto& b = pairs[pairB].joints;
    return 0.5F * (glm::distance(positions[a[0]], positions[b[0]]) + glm::distance(positions[a[1]], positions[b[1]]));
}

FramedRig frameRig(const RigFeatures& rig, const Stance& stance) {
    FramedRig framed;
    framed.rig = &rig;
    framed.stance = stance;
    framed.spread = spreadOf(rig);
    readSkin(framed);
    PairFinder(framed).find();
    return framed;
}

}  // namespace lutka::animation
