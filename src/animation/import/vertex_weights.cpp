#include "animation/import/vertex_weights.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lutka::animation::rig_import {
namespace {

struct Influence {
    int joint;
    double weight;
};

// A joint may be listed twice; its weights add up.
void add(std::vector<Influence>& influences, int joint, double weight) {
    for (Influence& known : influences) {
        if (known.joint == joint) {
            known.weight += weight;
            return;
        }
    }
    influences.push_back({joint, weight});
}

// Those of the same weight stay in their order.
void sortByWeight(std::vector<Influence>& influences) {
    constexpr std::size_t kFew = 16;  // so many are in place before a sort has got its memory
    const auto heavier = [](const Influence& a, const Influence& b) { return a.weight > b.weight; };
    if (influences.size() > kFew) {
        std::stable_sort(influences.begin(), influences.end(), heavier);
        return;
    }
    for (auto next = influences.begin(); next != influences.end(); ++next)
        std::rotate(std::upper_bound(influences.begin(), next, *next, heavier), next, next + 1);
}

VertexSkin strongest(std::vector<Influence>& influences, WeightRepairs& repairs) {
    sortByWeight(influences);
    double all = 0.0;
    for (const Influence& influence : influences)
        all += influence.weight;
    const std::size_t kept = std::min<std::size_t>(influences.size(), kMaxInfluences);
    double sum = 0.0;
    for (std::size_t i = 0; i < kept; ++i)
        sum += influences[i].weight;
    if (std::abs(all - 1.0) > 0.01) {
        ++repairs.unnormalised;
        repairs.largestSumError = std::max(repairs.largestSumError, std::abs(all - 1.0));
    }
    if (influences.size() > kMaxInfluences) {
        ++repairs.dropped;
        repairs.mostInfluences = std::max(repairs.mostInfluences, static_cast<int>(influences.size()));
        repairs.largestDropped = std::max(repairs.largestDropped, 1.0 - sum / all);
    }
    VertexSkin skin;
    for (std::size_t i = 0; i < kept; ++i) {
        const auto weight = static_cast<float>(influences[i].weight / sum);
        // Nobody sees it, and arithmetic on such numbers is slow.
        if (weight < std::numeric_limits<float>::min()) break;
        skin.joints[i] = static_cast<std::uint16_t>(influences[i].joint);
        skin.weights[i] = weight;
    }
    return skin;
}

}  // namespace

std::vector<std::string> WeightRepairs::sentences() const {
    std::vector<std::string> out;
    if (dropped > 0) {
        out.push_back(
            fmt::format("{} of {} vertices had more than {} influences (up to {}); the weakest were dropped, "
                        "at most {:.2g} % of a vertex's weight",
                        dropped, vertices, kMaxInfluences, mostInfluences, 100.0 * largestDropped));
    }
    if (unweighted > 0) {
        out.push_back(
            fmt::format("{} of {} vertices of skinned meshes had no weight and were bound to the nearest "
                        "deforming joint above them",
                        unweighted, vertices));
    }
    if (invalid > 0) out.push_back(fmt::format("{} invalid skin weights were dropped", invalid));
    if (unnormalised > 0) {
        out.push_back(
            fmt::format("the weights of {} of {} vertices did not sum to 1 (off by up to {:.3g}) and were "
                        "normalised",
                        unnormalised, vertices, largestSumError));
    }
    return out;
}

std::vector<VertexSkin> readWeights(const MeshInstance& instance, int fallbackJoint, WeightRepairs& repairs) {
    const SourceMesh& mesh = *instance.mesh;
    const std::size_t count = mesh.positions.size();
    std::vector<VertexSkin> skins;
    skins.reserve(count);
    repairs.vertices += static_cast<int>(count);
    std::vector<Influence> influences;
    for (std::size_t v = 0; v < count; ++v) {
        influences.clear();
        const std::uint32_t end = mesh.influenceStart.empty() ? 0 : mesh.influenceStart[v + 1];
        for (std::uint32_t i = mesh.influenceStart.empty() ? 0 : mesh.influenceStart[v]; i < end; ++i) {
            const double weight = mesh.influences[i].weight;
            const int joint = instance.jointOfSlot[mesh.influences[i].slot];
            if (!std::isfinite(weight) || weight < 0.0) {
                ++repairs.invalid;
            } else if (weight > 0.0 && joint >= 0) {
                add(influences, joint, weight);
            }
        }
        if (influences.empty()) {
            ++repairs.unweighted;
            skins.push_back({{static_cast<std::uint16_t>(fallbackJoint)}, {1.0F}});
        } else {
            skins.push_back(strongest(influences, repairs));
        }
    }
    return skins;
}

}  // namespace lutka::animation::rig_import
