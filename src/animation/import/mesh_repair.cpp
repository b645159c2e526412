#include "animation/import/mesh_repair.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstring>
#include <glm/geometric.hpp>
#include <limits>

#include "animation/import/name_list.hpp"
#include "animation/import/vertex_order.hpp"
#include "core/random.hpp"

namespace lutka::animation::rig_import {
namespace {

// By words: a hash by bytes takes longer than all else of an import.
template <class T>
std::uint64_t fold(const std::vector<T>& values, std::uint32_t v, std::uint64_t hash) {
    if (values.empty()) return hash;
    std::array<std::uint32_t, sizeof(T) / sizeof(std::uint32_t)> words{};
    static_assert(sizeof(words) == sizeof(T));
    std::memcpy(words.data(), static_cast<const void*>(&values[v]), sizeof(T));
    for (const std::uint32_t word : words) {
        hash = (hash ^ word) * 0x9E3779B97F4A7C15ULL;
        hash ^= hash >> 32U;  // what differs in the upper bits alone shall in the lower, which the table goes by
    }
    return hash;
}

template <class T>
bool same(const std::vector<T>& values, std::uint32_t a, std::uint32_t b) {
    // Bits, as the hash above: -0 and 0 may stay two vertices.
    // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison)
    return values.empty() || std::memcmp(&values[a], &values[b], sizeof(T)) == 0;
}

bool sameVertex(const SkinnedMesh& m, std::uint32_t a, std::uint32_t b) {
    return same(m.positions, a, b) && same(m.normals, a, b) && same(m.tangents, a, b) && same(m.uvs, a, b) &&
           same(m.colors, a, b) && same(m.joints, a, b) && same(m.weights, a, b);
}

std::uint64_t hashOf(const SkinnedMesh& mesh, std::uint32_t v) {
    std::uint64_t hash = fold(mesh.positions, v, kHashStart);
    hash = fold(mesh.colors, v, fold(mesh.uvs, v, fold(mesh.normals, v, hash)));
    return fold(mesh.weights, v, fold(mesh.joints, v, hash));
}

// Finds vertices by what they consist of: open addressing with a table that is at most half full, since a node for each
// vertex costs more than all else of an import.
class VertexTable {
  public:
    explicit VertexTable(const SkinnedMesh& mesh)
        : mesh_(mesh), slots_(std::bit_ceil(2 * mesh.positions.size()), kNone) {}

    /// The vertex that is the same, the first one that was asked for; the vertex itself when it is that.
    std::uint32_t firstLike(std::uint32_t v) {
        const std::size_t mask = slots_.size() - 1;
        std::size_t at = static_cast<std::size_t>(hashOf(mesh_, v)) & mask;
        while (slots_[at] != kNone && !sameVertex(mesh_, slots_[at], v))
            at = (at + 1) & mask;
        if (slots_[at] == kNone) slots_[at] = v;
        return slots_[at];
    }

  private:
    static constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();
    const SkinnedMesh& mesh_;
    std::vector<std::uint32_t> slots_;
};

// Importers give one vertex a corner; only what is used stays, in the order of first use of the vertex array.
void mergeVertices(SkinnedMesh& mesh) {
    std::vector<bool> used(mesh.positions.size(), false);
    for (const std::uint32_t v : mesh.indices)
        used[v] = true;
    VertexTable table(mesh);
    std::vector<std::uint32_t> kept;
    std::vector<std::uint32_t> newIndex(mesh.positions.size(), 0);
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
        if (!used[v]) continue;
        const std::uint32_t first = table.firstLike(v);
        newIndex[v] = first == v ? static_cast<std::uint32_t>(kept.size()) : newIndex[first];
        if (first == v) kept.push_back(v);
    }
    if (kept.size() == mesh.positions.size()) return;
    for (std::uint32_t& v : mesh.indices)
        v = newIndex[v];
    takeVertices(mesh, kept);
}

vec3 areaNormal(const SkinnedMesh& mesh, std::size_t triangle) {
    const vec3& a = mesh.positions[mesh.indices[triangle]];
    return glm::cross(mesh.positions[mesh.indices[triangle + 1]] - a, mesh.positions[mesh.indices[triangle + 2]] - a);
}

// Left-handed formats reach us with their triangles the wrong way round; the normals know.
void turnAgainstNormals(SkinnedMesh& mesh, MeshRepairs& repairs) {
    double with = 0.0;
    double against = 0.0;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const vec3 side = areaNormal(mesh, i);
        const vec3 normal =
            mesh.normals[mesh.indices[i]] + mesh.normals[mesh.indices[i + 1]] + mesh.normals[mesh.indices[i + 2]];
        const double cosine = glm::dot(side, normal);
        (cosine < 0.0 ? against : with) += std::abs(cosine);
    }
    if (against <= 3.0 * with) return;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
        std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
    ++repairs.turnedMeshes;
}

void makeNormals(SkinnedMesh& mesh) {
    std::vector<vec3> sums(mesh.positions.size(), vec3(0));
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const vec3 side = areaNormal(mesh, i);
        for (std::size_t corner = 0; corner < 3; ++corner)
            sums[mesh.indices[i + corner]] += side;
    }
    for (vec3& sum : sums) {
        const float length = glm::length(sum);
        sum = length > 0.0F && std::isfinite(length) ? sum / length : vec3(0, 1, 0);
    }
    mesh.normals = std::move(sums);
}

// Per-vertex tangents from the UVs' gradients (Lengyel 2001), made perpendicular to the normal.
void makeTangents(SkinnedMesh& mesh) {
    std::vector<vec3> along(mesh.positions.size(), vec3(0));
    std::vector<vec3> across(mesh.positions.size(), vec3(0));
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const std::uint32_t* corner = &mesh.indices[i];
        const vec3 e1 = mesh.positions[corner[1]] - mesh.positions[corner[0]];
        const vec3 e2 = mesh.positions[corner[2]] - mesh.positions[corner[0]];
        const vec2 d1 = mesh.uvs[corner[1]] - mesh.uvs[corner[0]];
        const vec2 d2 = mesh.uvs[corner[2]] - mesh.uvs[corner[0]];
        const float area = d1.x * d2.y - d2.x * d1.y;
        if (std::abs(area) < 1e-20F) continue;
        for (int k = 0; k < 3; ++k) {
            along[corner[k]] += (e1 * d2.y - e2 * d1.y) / area;
            across[corner[k]] += (e2 * d1.x - e1 * d2.x) / area;
        }
    }
    mesh.tangents.reserve(mesh.positions.size());
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const vec3& n = mesh.normals[v];
        const vec3 flat = along[v] - n * glm::dot(n, along[v]);
        const float length = glm::length(flat);
        const vec3 t = length > 1e-12F && std::isfinite(length) ? flat / length : anyPerpendicular(n);
        // glTF's v runs down the picture, the bitangent up it.
        mesh.tangents.emplace_back(t, glm::dot(glm::cross(n, t), across[v]) > 0.0F ? -1.0F : 1.0F);
    }
}

}  // namespace

std::vector<std::string> MeshRepairs::sentences() const {
    std::vector<std::string> out;
    if (turnedMeshes > 0) {
        out.push_back(fmt::format(
            "{} wound against {} normals and {} turned",
            countOf(static_cast<std::size_t>(turnedMeshes), "mesh had its triangles", "meshes had their triangles"),
            turnedMeshes == 1 ? "its" : "their", turnedMeshes == 1 ? "was" : "were"));
    }
    return out;
}

void repairMesh(SkinnedMesh& mesh, MeshRepairs& repairs) {
    mergeVertices(mesh);
    if (mesh.normals.empty()) {
        makeNormals(mesh);
    } else {
        turnAgainstNormals(mesh, repairs);
    }
    if (mesh.tangents.empty() && !mesh.uvs.empty()) makeTangents(mesh);
}

}  // namespace lutka::animation::rig_import
