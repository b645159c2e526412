#include "animation/import/figure_choice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include "core/aabb.hpp"
#include "core/math.hpp"

#include "animation/import/name_list.hpp"

namespace lutka::animation::rig_import {
namespace {

// Fewer joints are an accessory's, not a character's.
constexpr std::size_t kFewestJoints = 8;
constexpr std::size_t kWholeSkeleton = 15;
constexpr std::size_t kFewestEnds = 4;  // of a whole skeleton's joints that carry no other: a tail has one
constexpr double kSameNames = 0.7;      // of the smaller armature's joints
// Of the size of the character's skin: a prop with a joint of its own is larger, or farther away.
constexpr double kLargestAccessory = 1.5;
constexpr double kFarthestAccessory = 0.15;

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
        if (weights[skin] == 0 || scene.skins[skin].joints.empty()) continue;
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

using SceneBounds = AabbOf<glm::dvec3>;  // in the scene's axes

SceneBounds boundsOf(const std::vector<glm::dmat4>& sceneFromNode, const Armature& armature) {
    SceneBounds box;
    for (const int joint : armature.joints)
        box.add(glm::dvec3(sceneFromNode[joint][3]));
    return box;
}

bool apart(const SceneBounds& a, const SceneBounds& b) {
    for (int axis = 0; axis < 3; ++axis) {
        if (a.high[axis] < b.low[axis] || b.high[axis] < a.low[axis]) return true;
    }
    return false;
}

std::size_t endsOf(const SourceScene& scene, const Armature& armature) {
    std::set<int> carriers;
    for (const int joint : armature.joints)
        carriers.insert(scene.nodes[joint].parent);
    return static_cast<std::size_t>(std::count_if(armature.joints.begin(), armature.joints.end(),
                                                  [&](int joint) { return carriers.count(joint) == 0; }));
}

// A whole skeleton beside the first one: apart from it, or with its middle outside of it, as of two people who stand
// so near that their arms cross.
bool standsBeside(const SourceScene& scene, const Armature& other, const SceneBounds& place, const SceneBounds& first) {
    if (other.joints.size() < kWholeSkeleton) return false;
    return apart(first, place) || (endsOf(scene, other) >= kFewestEnds && first.distanceTo(place.middle()) > 0.0);
}

std::vector<glm::dmat4> posed(const SourceScene& scene) {
    std::vector<glm::dmat4> sceneFromNode;
    for (const SourceNode& node : scene.nodes) {
        sceneFromNode.push_back(node.parent < 0 ? node.parentFromNode
                                                : sceneFromNode[node.parent] * node.parentFromNode);
    }
    return sceneFromNode;
}

// The armatures that are a character each: the one with most vertices, twins of it (another of its names) and whole
// skeletons that stand apart. In the order of their nodes. Others are accessories.
std::vector<const Armature*> charactersAmong(const SourceScene& scene, const std::vector<Armature>& armatures,
                                             const std::vector<SceneBounds>& bounds) {
    const auto heavier = [](const Armature& a, const Armature& b) { return a.weight < b.weight; };
    // The end where there is none.
    const auto first = std::max_element(armatures.begin(), armatures.end(), heavier);
    std::vector<const Armature*> characters;
    for (auto other = armatures.begin(); other != armatures.end(); ++other) {
        if (other != first) {
            if (std::min(other->joints.size(), first->joints.size()) < kFewestJoints) continue;
            const bool twin = sharedNames(scene, *first, *other) >= kSameNames;
            const bool another =
                standsBeside(scene, *other, bounds[other - armatures.begin()], bounds[first - armatures.begin()]);
            if (!twin && !another) continue;
        }
        characters.push_back(&*other);
    }
    std::sort(characters.begin(), characters.end(),
              [](const Armature* a, const Armature* b) { return *a->joints.begin() < *b->joints.begin(); });
    return characters;
}

// A hat on joints of its own goes with the character that it is nearest to.
std::size_t nearestCharacter(const std::vector<SceneBounds>& characters, const SceneBounds& accessory) {
    const glm::dvec3 middle = accessory.middle();
    const auto nearer = [&](const SceneBounds& a, const SceneBounds& b) {
        return a.distanceTo(middle) < b.distanceTo(middle);
    };
    return static_cast<std::size_t>(std::min_element(characters.begin(), characters.end(), nearer) -
                                    characters.begin());
}

// Where the meshes of some skins are in the nodes' pose, each vertex with the joint that moves it most.
SceneBounds skinOf(const SourceScene& scene, const std::vector<glm::dmat4>& sceneFromNode,
                   const std::vector<int>& skins) {
    SceneBounds box;
    for (const SourceInstance& instance : scene.instances) {
        if (std::find(skins.begin(), skins.end(), instance.skin) == skins.end()) continue;
        const SourceMesh& mesh = scene.meshes[instance.mesh];
        const std::vector<SourceSkin::Joint>& joints = scene.skins[instance.skin].joints;
        for (std::size_t v = 0; v + 1 < mesh.influenceStart.size(); ++v) {
            const auto from = mesh.influences.begin() + mesh.influenceStart[v];
            const auto to = mesh.influences.begin() + mesh.influenceStart[v + 1];
            const auto most =
                std::max_element(from, to, [](const auto& a, const auto& b) { return a.weight < b.weight; });
            if (most == to || most->slot >= joints.size()) continue;
            const SourceSkin::Joint& joint = joints[most->slot];
            const glm::dvec4 place(glm::dvec3(mesh.positions[v]), 1.0);
            const glm::dvec3 point(sceneFromNode[joint.node] * joint.jointFromMesh * place);
            box.add(point);
        }
    }
    return box;
}

// A ground or a crate that hangs on a joint of its own, as exporters give one to every mesh: larger than the character,
// or away from it.
bool isThing(const SceneBounds& skin, const SceneBounds& character) {
    if (skin.empty() || character.empty() || character.diagonal() <= 0.0) return false;
    const double reach = character.diagonal();
    const glm::dvec3 size = skin.size();
    const glm::dvec3 gap = glm::max(glm::max(skin.low - character.high, character.low - skin.high), glm::dvec3(0.0));
    return glm::length(size) > kLargestAccessory * reach || glm::length(gap) > kFarthestAccessory * reach;
}

// In a file without skins its own humanoid block tells what the figure is.
FigureChoice figureOfHumanoid(const SourceScene& scene) {
    FigureChoice choice;
    SourceFigure figure;
    for (const auto& [role, node] : scene.vrmHumanoid)
        figure.joints.insert(node);
    if (figure.joints.size() < kFewestJoints) return choice;
    const int top = *figure.joints.begin();
    figure.name = scene.nodes[scene.nodes[top].parent < 0 ? top : scene.nodes[top].parent].name;
    choice.figures.push_back(std::move(figure));
    return choice;
}

FigureChoice figuresOf(const SourceScene& scene) {
    const std::vector<Armature> armatures = armaturesOf(scene);
    const std::vector<glm::dmat4> sceneFromNode = posed(scene);
    std::vector<SceneBounds> bounds;
    bounds.reserve(armatures.size());
    for (const Armature& armature : armatures)
        bounds.push_back(boundsOf(sceneFromNode, armature));
    FigureChoice choice;
    std::vector<SceneBounds> places;
    std::set<const Armature*> isCharacter;
    for (const Armature* armature : charactersAmong(scene, armatures, bounds)) {
        const int top = *armature->joints.begin();
        const int above = scene.nodes[top].parent;
        choice.figures.push_back(
            {scene.nodes[above < 0 ? top : above].name, armature->skins, armature->joints, armature->weight});
        places.push_back(bounds[armature - armatures.data()]);
        isCharacter.insert(armature);
    }
    // Of the characters alone: what was added to one does not say how large the next thing may be.
    std::vector<SceneBounds> ownSkins;
    for (const SourceFigure& figure : choice.figures)
        ownSkins.push_back(scene.nodesArePosed ? skinOf(scene, sceneFromNode, figure.skins) : SceneBounds{});
    for (std::size_t i = 0; i < armatures.size(); ++i) {
        if (isCharacter.count(&armatures[i]) > 0) continue;
        const std::size_t nearest = nearestCharacter(places, bounds[i]);
        const bool few = armatures[i].joints.size() < kFewestJoints && scene.nodesArePosed;
        if (few && isThing(skinOf(scene, sceneFromNode, armatures[i].skins), ownSkins[nearest])) continue;
        SourceFigure& owner = choice.figures[nearest];
        owner.skins.insert(owner.skins.end(), armatures[i].skins.begin(), armatures[i].skins.end());
        owner.joints.insert(armatures[i].joints.begin(), armatures[i].joints.end());
        owner.vertices += armatures[i].weight;
    }
    return choice;
}

// The meshes that are the figure's; what hangs on no figure at all is added to `things`.
std::vector<SourceInstance> instancesOf(const SourceScene& scene, const FigureChoice& choice,
                                        std::vector<std::string>& things) {
    const SourceFigure& figure = choice.figures[choice.taken];
    const std::set<int> skins(figure.skins.begin(), figure.skins.end());
    std::set<int> ofAnybody;
    for (const SourceFigure& one : choice.figures)
        ofAnybody.insert(one.skins.begin(), one.skins.end());
    std::vector<SourceInstance> kept;
    for (const SourceInstance& instance : scene.instances) {
        if (instance.skin >= 0 && !scene.skins[instance.skin].joints.empty()) {
            if (skins.count(instance.skin) > 0) kept.push_back(instance);
            if (ofAnybody.count(instance.skin) == 0) things.push_back(scene.nodes[instance.node].name);
            continue;
        }
        const auto carries = [&](const SourceFigure& one) { return hangsBelow(scene, instance.node, one.joints); };
        if (carries(figure)) {
            kept.push_back(instance);
        } else if (std::none_of(choice.figures.begin(), choice.figures.end(), carries)) {
            things.push_back(scene.nodes[instance.node].name);
        }
    }
    return kept;
}

void tellOfOthers(const FigureChoice& choice, std::vector<std::string>& warnings) {
    if (choice.figures.size() < 2) return;
    std::vector<std::string> others;
    for (std::size_t i = 0; i < choice.figures.size(); ++i) {
        if (i != choice.taken) others.push_back(fmt::format("{} (--figure {})", choice.figures[i].name, i + 1));
    }
    warnings.push_back(fmt::format("the file holds {} more character(s), which were left out: {}", others.size(),
                                   fmt::join(others, ", ")));
}

}  // namespace

Result<FigureChoice> chooseFigure(SourceScene& scene, std::optional<int> wanted) {
    const auto weighs = [](const SourceFigure& a, const SourceFigure& b) { return a.vertices < b.vertices; };
    FigureChoice choice = figuresOf(scene);
    if (choice.figures.empty()) choice = figureOfHumanoid(scene);
    const auto count = static_cast<int>(std::max<std::size_t>(choice.figures.size(), 1));
    if (wanted && (*wanted < 1 || *wanted > count)) {
        return Error{ErrorCode::usage, fmt::format("there is no figure {}: the file holds {}", *wanted, count), "",
                     "`lutka inspect` lists the figures of a file"};
    }
    if (choice.figures.empty()) return choice;
    choice.taken =
        wanted ? static_cast<std::size_t>(*wanted - 1)
               : static_cast<std::size_t>(std::max_element(choice.figures.begin(), choice.figures.end(), weighs) -
                                          choice.figures.begin());
    std::vector<std::string> things;
    scene.instances = instancesOf(scene, choice, things);
    tellOfOthers(choice, scene.warnings);
    if (!things.empty()) {
        scene.warnings.push_back(fmt::format("{} on no joint of the figure and {} left out: {}",
                                             countOf(things.size(), "mesh hangs", "meshes hang"),
                                             things.size() == 1 ? "was" : "were", firstOf(things)));
    }
    return choice;
}

}  // namespace lutka::animation::rig_import
