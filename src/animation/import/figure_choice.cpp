#include "animation/import/figure_choice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include "core/math.hpp"

namespace lutka::animation::rig_import {
namespace {

// Fewer joints are an accessory's, not a character's.
constexpr std::size_t kFewestJoints = 8;
constexpr std::size_t kWholeSkeleton = 15;
constexpr double kSameNames = 0.7;  // of the smaller armature's joints

// Skins that share joints, or whose joints hang below each other's, are of one armature.
struct Armature {
    std::vector<int> skins;
    std::set<int> joints;
    std::size_t weight = 0;  // vertices that it moves
};

bool hangsBelow(const SourceScene& scene, int node, const std::set<int>& joints) {
    for (; node >= 0; node = scene.nodes[node].parent) {
        if (joints.count(node) > 0) return true;
    }
    return false;
}

bool belongTogether(const SourceScene& scene, const std::set<int>& a, const std::set<int>& b) {
    const auto anyBelow = [&](const std::set<int>& low, const std::set<int>& high) {
        return std::any_of(low.begin(), low.end(), [&](int joint) { return hangsBelow(scene, joint, high); });
    };
    return anyBelow(a, b) || anyBelow(b, a);
}

std::vector<Armature> armaturesOf(const SourceScene& scene) {
    std::vector<std::size_t> weights(scene.skins.size(), 0);
    for (const SourceInstance& instance : scene.instances) {
        if (instance.skin >= 0) weights[instance.skin] += scene.meshes[instance.mesh].positions.size();
    }
    std::vector<Armature> armatures;
    for (int skin = 0; skin < static_cast<int>(scene.skins.size()); ++skin) {
        if (weights[skin] == 0) continue;
        Armature own;
        own.skins = {skin};
        own.weight = weights[skin];
        for (const SourceSkin::Joint& joint : scene.skins[skin].joints)
            own.joints.insert(joint.node);
        // It may join several that were apart so far.
        for (auto other = armatures.begin(); other != armatures.end();) {
            if (!belongTogether(scene, own.joints, other->joints)) {
                ++other;
                continue;
            }
            own.skins.insert(own.skins.begin(), other->skins.begin(), other->skins.end());
            own.joints.insert(other->joints.begin(), other->joints.end());
            own.weight += other->weight;
            other = armatures.erase(other);
        }
        armatures.push_back(std::move(own));
    }
    return armatures;
}

double sharedNames(const SourceScene& scene, const Armature& a, const Armature& b) {
    std::set<std::string> names;
    for (const int joint : a.joints)
        names.insert(scene.nodes[joint].name);
    const auto shared = std::count_if(b.joints.begin(), b.joints.end(),
                                      [&](int joint) { return names.count(scene.nodes[joint].name) > 0; });
    return static_cast<double>(shared) / static_cast<double>(std::min(a.joints.size(), b.joints.size()));
}

struct JointBounds {
    glm::dvec3 low{1e300};
    glm::dvec3 high{-1e300};
};

JointBounds boundsOf(const std::vector<glm::dmat4>& sceneFromNode, const Armature& armature) {
    JointBounds box;
    for (const int joint : armature.joints) {
        box.low = glm::min(box.low, glm::dvec3(sceneFromNode[joint][3]));
        box.high = glm::max(box.high, glm::dvec3(sceneFromNode[joint][3]));
    }
    return box;
}

bool apart(const JointBounds& a, const JointBounds& b) {
    for (int axis = 0; axis < 3; ++axis) {
        if (a.high[axis] < b.low[axis] || b.high[axis] < a.low[axis]) return true;
    }
    return false;
}

std::vector<glm::dmat4> posed(const SourceScene& scene) {
    std::vector<glm::dmat4> sceneFromNode;
    for (const SourceNode& node : scene.nodes) {
        sceneFromNode.push_back(node.parent < 0 ? node.parentFromNode
                                                : sceneFromNode[node.parent] * node.parentFromNode);
    }
    return sceneFromNode;
}

// The skins of other characters than the one with most vertices; their names are added to `told`.
std::set<int> skinsOfOthers(const SourceScene& scene, std::vector<std::string>& told) {
    std::vector<Armature> armatures = armaturesOf(scene);
    std::set<int> others;
    if (armatures.size() < 2) return others;
    const auto heavier = [](const Armature& a, const Armature& b) { return a.weight < b.weight; };
    const Armature& first = *std::max_element(armatures.begin(), armatures.end(), heavier);
    const std::vector<glm::dmat4> sceneFromNode = posed(scene);
    for (const Armature& other : armatures) {
        if (&other == &first || other.joints.size() < kFewestJoints || first.joints.size() < kFewestJoints) continue;
        const bool twin = sharedNames(scene, first, other) >= kSameNames;
        const bool another = other.joints.size() >= kWholeSkeleton &&
                             apart(boundsOf(sceneFromNode, first), boundsOf(sceneFromNode, other));
        if (!twin && !another) continue;
        others.insert(other.skins.begin(), other.skins.end());
        const int top = *other.joints.begin();
        told.push_back(scene.nodes[scene.nodes[top].parent < 0 ? top : scene.nodes[top].parent].name);
    }
    return others;
}

}  // namespace

void chooseFigure(SourceScene& scene) {
    std::set<int> jointsOfSkins;
    for (const SourceInstance& instance : scene.instances) {
        if (instance.skin < 0) continue;
        for (const SourceSkin::Joint& joint : scene.skins[instance.skin].joints)
            jointsOfSkins.insert(joint.node);
    }
    if (jointsOfSkins.empty()) return;
    std::vector<std::string> characters;
    const std::set<int> others = skinsOfOthers(scene, characters);
    std::set<int> jointsOfOthers;
    for (const int skin : others) {
        for (const SourceSkin::Joint& joint : scene.skins[skin].joints)
            jointsOfOthers.insert(joint.node);
    }
    std::vector<std::string> things;
    std::vector<SourceInstance> kept;
    for (const SourceInstance& instance : scene.instances) {
        const bool rigid = instance.skin < 0;
        if (rigid ? hangsBelow(scene, instance.node, jointsOfOthers) : others.count(instance.skin) > 0) continue;
        if (rigid && !hangsBelow(scene, instance.node, jointsOfSkins)) {
            things.push_back(scene.nodes[instance.node].name);
            continue;
        }
        kept.push_back(instance);
    }
    scene.instances = std::move(kept);
    if (!characters.empty()) {
        scene.warnings.push_back(fmt::format("the file holds {} more character(s), which were left out: {}",
                                             characters.size(), fmt::join(characters, ", ")));
    }
    if (!things.empty()) {
        constexpr std::size_t most = 8;
        const std::size_t count = things.size();
        if (count > most) things.resize(most);
        scene.warnings.push_back(fmt::format("{} mesh(es) hang on no joint of the figure and were left out: {}{}",
                                             count, fmt::join(things, ", "), count > most ? " …" : ""));
    }
}

}  // namespace lutka::animation::rig_import
