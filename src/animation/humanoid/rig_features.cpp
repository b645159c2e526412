#include "animation/humanoid/rig_features.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <string_view>

#include "animation/carrying_joints.hpp"
#include "animation/counted_vertices.hpp"
#include "animation/humanoid/name_prefix.hpp"
#include "animation/humanoid/names_in_tree.hpp"
#include "animation/humanoid/names_of_trunk.hpp"
#include "core/aabb.hpp"

namespace lutka::animation {
namespace {

constexpr std::size_t kMaxVertices = 12000;

void readWeights(const Character& character, RigFeatures& rig) {
    const Skeleton& skeleton = character.skeleton;
    const int count = rig.count();
    rig.ownWeight = skeleton.skinWeight;
    const std::vector<std::size_t> counted = countedVertices(character);
    for (std::size_t i = 0; i < character.meshes.size(); ++i) {
        const SkinnedMesh& mesh = character.meshes[i];
        if (mesh.joints.empty() || counted[i] == mesh.positions.size()) continue;
        float& weight = rig.ownWeight[mesh.joints[0][0]];
        weight = std::max(weight - static_cast<float>(mesh.positions.size() - counted[i]), 0.0F);
    }
    rig.subtreeWeight = rig.ownWeight;
    float total = 0.0F;
    for (int joint = count - 1; joint >= 0; --joint) {
        total += rig.ownWeight[joint];
        if (rig.parents[joint] != kNoJoint) rig.subtreeWeight[rig.parents[joint]] += rig.subtreeWeight[joint];
    }
    rig.skinned = total > 0.0F;
    const float scale = rig.skinned ? 1.0F / total : 0.0F;
    for (int joint = 0; joint < count; ++joint) {
        rig.ownWeight[joint] *= scale;
        rig.subtreeWeight[joint] *= scale;
    }
    rig.directWeight = rig.ownWeight;
}

// Where all parts are rigid, which joints carry one proves nothing: limbs may hang from joints that carry none.
void readRigidParts(const Character& character, RigFeatures& rig) {
    rig.rigidPart = carryingJoints(character).rigid;
    const bool onlyRigid = std::all_of(character.meshes.begin(), character.meshes.end(),
                                       [](const SkinnedMesh& mesh) { return mesh.rigid; });
    if (onlyRigid && !character.meshes.empty()) rig.skinned = false;
}

// A rigid part's node may lie anywhere: at the origin of the file, or on the other side, where the part was mirrored in
// the modelling program. Its place is then that of its meshes. So it is where several parts share one place, as near as
// that may be: a modelling program has made their transforms nothing. Pivots that lie at their part are left alone.
void placeParts(const Character& character, RigFeatures& rig) {
    constexpr float kBeside = 0.5F;     // of the part's extent, beyond its box
    constexpr float kOnePlace = 1e-3F;  // of the part's extent
    constexpr int kSharing = 3;         // parts in one place
    std::map<std::size_t, Aabb> parts;  // by their node, which may carry several meshes
    for (const SkinnedMesh& mesh : character.meshes) {
        if (!mesh.rigid || mesh.joints.empty() || mesh.positions.empty()) continue;
        const std::size_t node = mesh.joints[0][0];
        if (node >= rig.positions.size() || !rig.children[node].empty()) continue;
        Aabb& part = parts[node];
        for (const vec3& position : mesh.positions)
            part.add(position);
    }
    const std::vector<vec3> nodes = rig.positions;
    const auto isShared = [&](const vec3& place) {
        return std::count_if(parts.begin(), parts.end(), [&](const auto& other) {
                   return glm::distance(nodes[other.first], place) <= kOnePlace * other.second.diagonal();
               }) >= kSharing;
    };
    for (const auto& [node, part] : parts) {
        const vec3 margin(kBeside * part.diagonal());
        vec3& place = rig.positions[node];
        if (isShared(place)) {
            place = part.middle();
            continue;
        }
        const bool away =
            glm::any(glm::lessThan(place, part.low - margin)) || glm::any(glm::greaterThan(place, part.high + margin));
        if (away) place = part.middle();
    }
}

void readVertices(const Character& character, RigFeatures& rig) {
    const std::vector<std::size_t> counted = countedVertices(character);
    const std::size_t total = std::accumulate(counted.begin(), counted.end(), std::size_t{0});
    const std::size_t most = total / kMaxVertices + 1;
    for (std::size_t part = 0; part < character.meshes.size(); ++part) {
        const SkinnedMesh& mesh = character.meshes[part];
        const std::size_t share = mesh.positions.size() / std::max<std::size_t>(counted[part], 1);
        const std::size_t stride = most * std::max<std::size_t>(share, 1);
        for (std::size_t place = 0; place < mesh.positions.size(); place += stride) {
            const std::size_t i = mesh.fileOrder.empty() ? place : mesh.fileOrder[place];
            if (i < mesh.joints.size() && mesh.joints[i][0] < rig.positions.size()) {
                rig.vertices.push_back({mesh.positions[i], mesh.joints[i][0]});
            }
        }
    }
}

void findShadows(RigFeatures& rig) {
    constexpr float kCoincident = 0.004F;  // of the spread
    constexpr float kOwnPart = 0.04F;      // of the skin
    const float tolerance = kCoincident * spreadOf(rig);
    rig.shadow.assign(rig.positions.size(), false);
    for (int joint = 0; joint < rig.count(); ++joint) {
        for (int other = 0; other < rig.count() && !rig.shadow[joint]; ++other) {
            if (other == joint || glm::distance(rig.positions[joint], rig.positions[other]) > tolerance) continue;
            const bool otherSkinned = rig.directWeight[other] > 0.0F && !rig.rigidPart[other];
            const bool partOfOther = rig.rigidPart[joint] && !rig.rigidPart[other];
            // A leaf that moves much of the skin is a part of its own: a head that starts where the clavicles do.
            const bool leafOfMore = rig.children[joint].empty() && !rig.children[other].empty() &&
                                    (!rig.skinned || rig.rigidPart[joint] || rig.directWeight[joint] < kOwnPart);
            // Nor is a joint, but a control, the shadow of a leaf that moves its skin for it.
            const bool movesForIt =
                !rig.names[joint].helper && rig.parents[other] == joint && rig.children[other].empty();
            rig.shadow[joint] = (otherSkinned && !movesForIt && rig.directWeight[joint] <= 0.0F) ||
                                (leafOfMore && (otherSkinned || partOfOther || !rig.skinned));
        }
    }
}

// A root by its name and nothing else.
bool isBareRoot(const NameEvidence& name) {
    return name.parts[Part::hips] > 0.0F && name.parts[Part::hips] < 1.0F && !name.helper &&
           std::find(name.words.begin(), name.words.end(), "root") != name.words.end();
}

// "c_spine_01.x" beside "spine_01.x": the first drives the second, and so does whatever else bears that prefix.
// The root that has a control of its own and moves skin is the hips, not the file's.
void readDrivingPrefix(const std::vector<std::string>& names, RigFeatures& rig) {
    constexpr std::string_view kPrefix = "c_";
    constexpr int kFewest = 3;
    const std::set<std::string_view> all(names.begin(), names.end());
    const auto driven = std::count_if(names.begin(), names.end(), [&](std::string_view name) {
        return name.starts_with(kPrefix) && all.count(name.substr(kPrefix.size())) > 0;
    });
    if (driven < kFewest) return;
    for (int joint = 0; joint < rig.count(); ++joint) {
        if (names[joint].starts_with(kPrefix)) {
            rig.names[joint] = nameEvidence("ctrl_" + names[joint].substr(kPrefix.size()));
        } else if (rig.directWeight[joint] > 0.0F && isBareRoot(rig.names[joint]) &&
                   all.count(std::string(kPrefix) + names[joint]) > 0) {
            rig.names[joint].parts[Part::hips] = kTellsSurely;
        }
    }
}

// A rig of Rigify calls the joints that deform the skin DEF-…, and those of the machinery behind them MCH-…. All joints
// but the first are then controls. Without a skin one is as good as the other.
void readDeformingPrefix(const std::vector<std::string>& names, RigFeatures& rig) {
    constexpr int kFewest = 12;
    const auto count = [&](std::string_view prefix) {
        return std::count_if(names.begin(), names.end(),
                             [&](std::string_view name) { return name.starts_with(prefix); });
    };
    if (!rig.skinned || count("DEF-") < kFewest || count("MCH-") < kFewest) return;
    for (int joint = 0; joint < rig.count(); ++joint) {
        if (!names[joint].starts_with("DEF-")) rig.names[joint] = nameEvidence("ctrl_" + names[joint]);
    }
}

// What moves skin of its own is no control, whatever its name says: feet that are their own IK targets.
void believeSkinnedControls(RigFeatures& rig) {
    constexpr float kLeastSkin = 0.002F;
    if (!rig.skinned) return;
    for (int joint = 0; joint < rig.count(); ++joint) {
        NameEvidence& name = rig.names[joint];
        if (!name.control || rig.directWeight[joint] < kLeastSkin) continue;
        name.parts = name.partsIfSkinned;
        name.helper = false;
    }
}

// A leaf without skin that is named as a limb's lower part, where the upper one goes on in skin elsewhere: what the
// limb's control points at ("knee" before the knee).
bool isPole(const RigFeatures& rig, int joint, Part part) {
    if (!rig.children[joint].empty() || rig.subtreeWeight[joint] > 0.0F) return false;
    const Part upper = part == Part::lowerLeg ? Part::upperLeg : Part::upperArm;
    if (part == upper) return false;
    for (int above = 0; above < rig.count(); ++above) {
        const NameEvidence& name = rig.names[above];
        if (name.side != rig.names[joint].side || name.parts[upper] < kTellsPartOfLimb) continue;
        if (rig.isAncestorOrSelf(above, joint)) continue;
        const auto goesOn = [&](int child) { return rig.subtreeWeight[child] > 0.0F; };
        if (std::any_of(rig.children[above].begin(), rig.children[above].end(), goesOn)) return true;
    }
    return false;
}

// A file may hold the skin of a part alone (a face, trousers, an avatar's hands), and joints for the whole figure.
// Where names tell all joints of arms and legs and many of those carry none, the skin proves nothing about the limbs.
void doubtPartialSkin(RigFeatures& rig) {
    constexpr std::array<Part, 4> kLimbs{Part::upperArm, Part::lowerArm, Part::upperLeg, Part::lowerLeg};
    if (!rig.skinned) return;
    bool partly = false;
    for (const Part part : kLimbs) {
        int bare = 0;
        for (const Side side : {Side::left, Side::right}) {
            bool named = false;
            bool carries = false;
            for (int joint = 0; joint < rig.count(); ++joint) {
                const NameEvidence& name = rig.names[joint];
                if (name.side != side || name.helper || name.parts[part] < kTellsPartOfLimb) continue;
                if (isPole(rig, joint, part)) continue;
                named = true;
                carries = carries || rig.subtreeWeight[joint] > 0.0F;
            }
            if (!named) return;
            bare += carries ? 0 : 1;
        }
        // On both sides: of a garment, of what a player sees of himself, of a figure that was cut in two.
        partly = partly || bare == 2;
    }
    rig.partlySkinned = partly;
    if (rig.partlySkinned) rig.skinned = false;
}

// Rigid parts and collision volumes hang on their joint as leaves and carry its weight. A hand below a forearm, each
// called so, carries its own.
void readOwnWeights(RigFeatures& rig) {
    const auto isOtherPart = [&](int joint, int child) {
        const PartScores& above = rig.names[joint].parts;
        const PartScores& below = rig.names[child].parts;
        const auto tells = [](const PartScores& parts, const PartScores& others) {
            for (std::size_t part = 0; part < parts.values.size(); ++part)
                if (parts.values[part] >= kTellsSurely && others.values[part] < 0.0F) return true;
            return false;
        };
        return !rig.rigidPart[child] && tells(above, below) && tells(below, above);
    };
    for (int joint = 0; joint < rig.count(); ++joint) {
        if (rig.ownWeight[joint] > 0.0F) continue;
        for (const int child : rig.children[joint]) {
            if (rig.children[child].empty() && !isOtherPart(joint, child))
                rig.ownWeight[joint] += rig.directWeight[child];
        }
    }
}

vec3 middleOf(const RigFeatures& rig) {
    vec3 sum(0);
    float count = 0.0F;
    for (int joint = 0; joint < rig.count(); ++joint) {
        if (!rig.carriesSkin(joint)) continue;
        sum += rig.positions[joint];
        count += 1.0F;
    }
    return count > 0.0F ? sum / count : sum;
}

}  // namespace

float spreadOf(const RigFeatures& rig) {
    const vec3 mean = middleOf(rig);
    float count = 0.0F;
    float square = 0.0F;
    for (int joint = 0; joint < rig.count(); ++joint) {
        if (!rig.carriesSkin(joint)) continue;
        const vec3 away = rig.positions[joint] - mean;
        square += glm::dot(away, away);
        count += 1.0F;
    }
    return count > 0.0F ? 2.0F * std::sqrt(square / count) : 0.0F;
}

bool RigFeatures::isOneOfFingers(int joint) const {
    constexpr float kApart = 0.2F;  // of the way from the joint above
    const int parent = parents[joint];
    if (parent == kNoJoint) return false;
    const float least = kApart * glm::distance(positions[parent], positions[joint]);
    if (isOneOfChains(joint, least)) return true;
    if (!names[joint].finger) return false;
    return std::any_of(children[parent].begin(), children[parent].end(), [&](int other) {
        return names[other].finger && glm::distance(positions[other], positions[joint]) > least;
    });
}

// Three chains or more without names that hang side by side: what they hang on is the hand or the foot.
bool RigFeatures::isOneOfChains(int joint, float apart) const {
    constexpr int kFewest = 3;
    constexpr int kMostJoints = 5;  // of a finger
    const auto isChain = [&](int top) {
        return !names[top].meaningful && !children[top].empty() && carriesSkin(top) && subtreeSize(top) <= kMostJoints;
    };
    const std::vector<int>& beside = children[parents[joint]];
    return isChain(joint) && std::count_if(beside.begin(), beside.end(), [&](int other) {
                                 const bool here = other == joint;
                                 return isChain(other) &&
                                        (here || glm::distance(positions[other], positions[joint]) > apart);
                             }) >= kFewest;
}

int RigFeatures::namedJoint(Part part, Side side, float least) const {
    int best = kNoJoint;
    const auto rank = [&](int of) { return names[of].parts[part] + (carriesSkin(of) ? 1.0F : 0.0F); };
    for (int joint = 0; joint < count(); ++joint) {
        const NameEvidence& name = names[joint];
        if (name.side != side || name.helper || name.parts[part] < least) continue;
        const bool better =
            best == kNoJoint || rank(joint) > rank(best) || (rank(joint) == rank(best) && depth[joint] < depth[best]);
        if (better) best = joint;
    }
    return best;
}

int RigFeatures::commonAncestor(int a, int b) const {
    while (a != kNoJoint && !isAncestorOrSelf(a, b))
        a = parents[a];
    return a;
}

void walkTree(RigFeatures& rig) {
    const int count = rig.count();
    std::vector<int> size(count, 1);
    rig.depth.assign(count, 0);
    for (int joint = count - 1; joint >= 0; --joint) {
        if (rig.parents[joint] != kNoJoint) size[rig.parents[joint]] += size[joint];
    }
    rig.enter.assign(count, 0);
    rig.leave.assign(count, 0);
    std::vector<int> next(count, 0);
    int nextRoot = 0;
    for (int joint = 0; joint < count; ++joint) {
        const int parent = rig.parents[joint];
        int& slot = parent == kNoJoint ? nextRoot : next[parent];
        rig.enter[joint] = slot;
        rig.leave[joint] = slot + size[joint];
        slot += size[joint];
        next[joint] = rig.enter[joint] + 1;
        if (parent != kNoJoint) rig.depth[joint] = rig.depth[parent] + 1;
    }
}

RigFeatures readRig(const Character& character, bool useNames) {
    const Skeleton& skeleton = character.skeleton;
    RigFeatures rig;
    rig.parents = skeleton.parents;
    rig.children = childrenOf(skeleton);
    rig.positions.reserve(skeleton.bindModelFromJoint.size());
    for (const RigidTransform& frame : skeleton.bindModelFromJoint)
        rig.positions.push_back(frame.translation);
    walkTree(rig);
    readWeights(character, rig);
    readRigidParts(character, rig);
    placeParts(character, rig);
    readVertices(character, rig);
    rig.names.resize(rig.positions.size());
    if (useNames) {
        const std::string figure = figureName(skeleton.names);
        std::transform(skeleton.names.begin(), skeleton.names.end(), rig.names.begin(), [&](std::string_view name) {
            return nameEvidence(name.starts_with(figure) ? name.substr(figure.size()) : name);
        });
        readDrivingPrefix(skeleton.names, rig);
        readDeformingPrefix(skeleton.names, rig);
    }
    believeSkinnedControls(rig);
    readNamesInTree(rig);
    readNamesOfTrunk(rig);
    readOwnWeights(rig);
    doubtPartialSkin(rig);
    findShadows(rig);
    return rig;
}

}  // namespace lutka::animation
