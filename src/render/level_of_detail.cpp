#include "render/level_of_detail.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <tuple>

#include "core/assert.hpp"

namespace lutka::render {
namespace {

struct Cluster {
    vec3 sum{0, 0, 0};
    int count = 0;
    std::uint32_t nearest = 0;  // the vertex that stands for all
    float away = -1.0F;         // its squared distance from the mean; negative: none yet
};

}  // namespace

std::vector<std::uint32_t> clusteredIndices(const animation::SkinnedMesh& mesh, float cell) {
    LUTKA_ASSERT(cell > 0.0F);
    std::map<std::tuple<int, int, int, int>, std::size_t> known;
    std::vector<Cluster> clusters;
    std::vector<std::size_t> clusterOf(mesh.positions.size());
    for (std::size_t vertex = 0; vertex < mesh.positions.size(); ++vertex) {
        const vec3 at = mesh.positions[vertex] / cell;
        const std::tuple<int, int, int, int> key(static_cast<int>(std::floor(at.x)), static_cast<int>(std::floor(at.y)),
                                                 static_cast<int>(std::floor(at.z)), mesh.joints[vertex][0]);
        const auto [place, isNew] = known.emplace(key, clusters.size());
        if (isNew) clusters.emplace_back();
        clusterOf[vertex] = place->second;
        clusters[place->second].sum += mesh.positions[vertex];
        ++clusters[place->second].count;
    }
    for (std::size_t vertex = 0; vertex < mesh.positions.size(); ++vertex) {
        Cluster& cluster = clusters[clusterOf[vertex]];
        const vec3 offset = mesh.positions[vertex] - cluster.sum / static_cast<float>(cluster.count);
        const float away = glm::dot(offset, offset);
        if (cluster.away >= 0.0F && away >= cluster.away) continue;
        cluster.away = away;
        cluster.nearest = static_cast<std::uint32_t>(vertex);
    }
    std::vector<std::uint32_t> indices;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const std::size_t a = clusterOf[mesh.indices[i]];
        const std::size_t b = clusterOf[mesh.indices[i + 1]];
        const std::size_t c = clusterOf[mesh.indices[i + 2]];
        if (a == b || b == c || c == a) continue;
        indices.insert(indices.end(), {clusters[a].nearest, clusters[b].nearest, clusters[c].nearest});
    }
    return indices;
}

}  // namespace lutka::render
