#include "animation/import/bare_skeleton.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "animation/import/clip_sampling.hpp"

namespace lutka::animation::rig_import {
namespace {

// The share of all bones' length that points one way, or along one axis, above which a pose is no figure. A figure that
// stands with its arms down has about 0.7 and 0.85.
constexpr double kMostOneWay = 0.82;
constexpr double kMostOneAxis = 0.93;
constexpr std::size_t kFewestNodes = 8;
constexpr std::size_t kFewestNodesAMesh = 8;  // above it the meshes are a face or a weapon, not a figure of rigid parts
constexpr int kFramesToChooseFrom = 60;       // of each clip
constexpr std::size_t kClipsLookedAt = 8;

// The first node that several limbs hang on: what is above it only leads to the figure. Cameras and lights are no
// limbs.
std::size_t firstFork(std::span<const int> parents) {
    constexpr int kFewestOfLimb = 3;
    std::vector<int> size(parents.size(), 1);
    std::vector<int> limbs(parents.size(), 0);
    for (std::size_t node = parents.size(); node-- > 1;) {
        if (parents[node] < 0) continue;
        const auto parent = static_cast<std::size_t>(parents[node]);
        size[parent] += size[node];
        if (size[node] >= kFewestOfLimb) ++limbs[parent];
    }
    const auto fork = std::find_if(limbs.begin(), limbs.end(), [](int count) { return count > 1; });
    return fork == limbs.end() ? 0 : static_cast<std::size_t>(fork - limbs.begin());
}

int indexOfAxis(std::optional<UpAxis> up) {
    if (up == UpAxis::positiveX || up == UpAxis::negativeX) return 0;
    return up == UpAxis::positiveZ || up == UpAxis::negativeZ ? 2 : 1;
}

// Whether no mesh tells where the figure's joints are: a skin would, and so would the parts of a robot.
bool isBare(const SourceScene& scene) {
    std::set<int> carriers;
    for (const SourceInstance& instance : scene.instances) {
        if (instance.skin >= 0) return false;
        carriers.insert(instance.node);
    }
    return carriers.size() * kFewestNodesAMesh <= scene.nodes.size();
}

struct Frame {
    const SourceClip* clip = nullptr;
    double time = 0.0;  // seconds
};

// The frame that shows the figure most plainly; without a clip where none shows any.
Frame plainestFrame(const SourceScene& scene, std::span<const int> parents) {
    Frame chosen;
    double best = 0.0;
    for (std::size_t index = 0; index < std::min(scene.clips.size(), kClipsLookedAt); ++index) {
        const SourceClip& clip = scene.clips[index];
        const auto [first, last] = spanOf(clip);
        for (int step = 0; step < kFramesToChooseFrom; ++step) {
            const double time = first + (last - first) * step / (kFramesToChooseFrom - 1);
            const std::vector<dmat4> pose = sceneFromNodes(parents, parentFromNodes(scene, clip, time));
            if (!spreadsOut(parents, pose)) continue;
            const double score = plainness(parents, pose, indexOfAxis(scene.convention.up));
            if (chosen.clip != nullptr && score < kClearlyPlainer * best) continue;
            chosen = {&clip, time};
            best = score;
        }
    }
    return chosen;
}

}  // namespace

bool spreadsOut(std::span<const int> parents, std::span<const dmat4> scene) {
    dvec3 positive(0);
    dvec3 negative(0);
    double total = 0.0;
    for (std::size_t i = firstFork(parents) + 1; i < scene.size(); ++i) {
        if (parents[i] < 0) continue;
        const dvec3 bone = dvec3(scene[i][3]) - dvec3(scene[static_cast<std::size_t>(parents[i])][3]);
        total += glm::length(bone);
        positive += glm::max(bone, dvec3(0));
        negative += glm::max(-bone, dvec3(0));
    }
    if (!(total > 0.0)) return false;
    for (int axis = 0; axis < 3; ++axis) {
        const double oneWay = std::max(positive[axis], negative[axis]);
        if (oneWay > kMostOneWay * total || positive[axis] + negative[axis] > kMostOneAxis * total) return false;
    }
    return true;
}

double plainness(std::span<const int> parents, std::span<const dmat4> scene, int up) {
    const std::size_t fork = firstFork(parents);
    const dvec3 hips(scene[fork][3]);
    std::vector<double> way(scene.size(), 0.0);
    std::vector<bool> isTip(scene.size(), true);
    double longest = 1e-12;
    double low = hips[up];
    for (std::size_t i = fork + 1; i < scene.size(); ++i) {
        if (parents[i] < static_cast<int>(fork)) break;  // another hierarchy
        const auto parent = static_cast<std::size_t>(parents[i]);
        way[i] = way[parent] + glm::distance(dvec3(scene[i][3]), dvec3(scene[parent][3]));
        isTip[parent] = false;
        longest = std::max(longest, way[i]);
        low = std::min(low, scene[i][3][up]);
    }
    double straight = 0.0;
    double tips = 0.0;
    for (std::size_t i = fork + 1; i < scene.size(); ++i) {
        if (!isTip[i] || !(way[i] > 0.0)) continue;
        straight += glm::distance(dvec3(scene[i][3]), hips) / way[i];
        tips += 1.0;
    }
    return (hips[up] - low) / longest + straight / std::max(tips, 1.0);
}

double stretch(std::span<const int> parents, std::span<const dmat4> scene) {
    constexpr double kLong = 0.6;  // of the longest way: from a head to an ankle, though toes and hands are farther
    const std::size_t fork = firstFork(parents);
    std::vector<double> way(scene.size(), 0.0);  // from the fork
    std::size_t end = fork + 1;
    double longest = 0.0;
    double second = 0.0;
    for (; end < scene.size() && parents[end] >= static_cast<int>(fork); ++end) {
        const auto parent = static_cast<std::size_t>(parents[end]);
        way[end] = way[parent] + glm::distance(dvec3(scene[end][3]), dvec3(scene[parent][3]));
        second = std::max(second, std::min(longest, way[end]));
        longest = std::max(longest, way[end]);
    }
    double most = 0.0;
    for (std::size_t a = fork + 1; a < end; ++a) {
        for (std::size_t b = fork + 1; b < a; ++b) {
            const double both = way[a] + way[b];
            if (!(both > kLong * (longest + second))) continue;
            most = std::max(most, glm::distance(dvec3(scene[a][3]), dvec3(scene[b][3])) / both);
        }
    }
    return most;
}

void poseBareSkeleton(SourceScene& scene) {
    if (!isBare(scene) || scene.clips.empty() || scene.nodes.size() < kFewestNodes) return;
    std::vector<int> parents;
    std::vector<dmat4> own;
    for (const SourceNode& node : scene.nodes) {
        parents.push_back(node.parent);
        own.push_back(node.parentFromNode);
    }
    if (spreadsOut(parents, sceneFromNodes(parents, own))) return;
    const Frame chosen = plainestFrame(scene, parents);
    if (chosen.clip == nullptr) return;
    const std::vector<dmat4> pose = parentFromNodes(scene, *chosen.clip, chosen.time);
    scene.warnings.push_back(
        fmt::format("the nodes' own pose is no figure; that of clip '{}' at {:.2f} s is taken in "
                    "its place",
                    chosen.clip->name, chosen.time));
    for (std::size_t node = 0; node < scene.nodes.size(); ++node) {
        scene.nodes[node].parentFromNode = pose[node];
        scene.nodes[node].trs.reset();
    }
}

}  // namespace lutka::animation::rig_import
