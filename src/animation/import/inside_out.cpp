#include "animation/import/inside_out.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>
#include <utility>

#include "animation/import/affine.hpp"
#include "animation/import/vertex_bounds.hpp"

namespace lutka::animation::rig_import {
namespace {

constexpr double kLeastVolume = 0.01;  // of the box around the figure: less is no figure's, but a sheet's

struct Enclosed {
    double volume = 0.0;  // signed: positive where the triangles face outwards
    dvec3 size{0.0};      // of the box
    double box = 0.0;
};

Enclosed enclosedBy(const std::vector<SkinnedMesh>& meshes) {
    const AabbOf<dvec3> bounds = vertexBounds(meshes);
    Enclosed out;
    if (bounds.empty()) return out;
    out.size = bounds.size();
    out.box = out.size.x * out.size.y * out.size.z;
    // Holes count for least when volumes are taken about the middle.
    const dvec3 middle = bounds.middle();
    for (const SkinnedMesh& mesh : meshes) {
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            const dvec3 a = dvec3(mesh.positions[mesh.indices[i]]) - middle;
            const dvec3 b = dvec3(mesh.positions[mesh.indices[i + 1]]) - middle;
            const dvec3 c = dvec3(mesh.positions[mesh.indices[i + 2]]) - middle;
            out.volume += glm::dot(a, glm::cross(b, c)) / 6.0;
        }
    }
    return out;
}

// Pieces whose triangles hang together, over all meshes: vertices at one place are one.
class WeldedPieces {
  public:
    WeldedPieces(const std::vector<SkinnedMesh>& meshes, double grain) {
        struct Vertex {
            std::array<std::int64_t, 3> cell;
            std::size_t index;
        };
        std::vector<Vertex> vertices;
        for (const SkinnedMesh& mesh : meshes) {
            for (const vec3& p : mesh.positions) {
                const dvec3 cell = dvec3(p) / grain;
                vertices.push_back(
                    {{std::llround(cell.x), std::llround(cell.y), std::llround(cell.z)}, vertices.size()});
            }
        }
        above_.resize(vertices.size());
        std::iota(above_.begin(), above_.end(), std::size_t{0});
        std::sort(vertices.begin(), vertices.end(), [](const Vertex& a, const Vertex& b) { return a.cell < b.cell; });
        for (std::size_t i = 1; i < vertices.size(); ++i)
            if (vertices[i].cell == vertices[i - 1].cell) join(vertices[i - 1].index, vertices[i].index);
        std::size_t first = 0;
        for (const SkinnedMesh& mesh : meshes) {
            for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
                join(first + mesh.indices[i], first + mesh.indices[i + 1]);
                join(first + mesh.indices[i], first + mesh.indices[i + 2]);
            }
            first += mesh.positions.size();
        }
    }

    // The number of a vertex's piece; vertices count on from mesh to mesh.
    std::size_t of(std::size_t vertex) {
        while (above_[vertex] != vertex)
            vertex = above_[vertex] = above_[above_[vertex]];
        return vertex;
    }
    [[nodiscard]] std::size_t vertices() const { return above_.size(); }

  private:
    void join(std::size_t a, std::size_t b) { above_[of(b)] = of(a); }

    std::vector<std::size_t> above_;
};

// How much of the volume depends on the point that it is taken about: 0 where no piece has a hole. Of each piece by
// itself: sheets that face each other are open, though their areas cancel out.
double openVolume(const std::vector<SkinnedMesh>& meshes, const dvec3& size) {
    constexpr double kGrain = 1e-5;  // of the size
    WeldedPieces pieces(meshes, kGrain * std::max({size.x, size.y, size.z}));
    std::vector<dvec3> areas(pieces.vertices(), dvec3(0.0));  // as vectors, which a closed surface has none of
    std::size_t first = 0;
    for (const SkinnedMesh& mesh : meshes) {
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            const dvec3 a(mesh.positions[mesh.indices[i]]);
            const dvec3 b(mesh.positions[mesh.indices[i + 1]]);
            const dvec3 c(mesh.positions[mesh.indices[i + 2]]);
            areas[pieces.of(first + mesh.indices[i])] += 0.5 * glm::cross(b - a, c - a);
        }
        first += mesh.positions.size();
    }
    double open = 0.0;
    for (const dvec3& area : areas)
        open += glm::dot(glm::abs(area), 0.5 * size) / 3.0;
    return open;
}

void turn(SkinnedMesh& mesh) {
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
        std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
    for (vec3& normal : mesh.normals)
        normal = -normal;
    // The bitangent is sign · (normal × tangent), and stays where the picture puts it.
    for (vec4& tangent : mesh.tangents)
        tangent.w = -tangent.w;
}

}  // namespace

void turnOutwards(std::vector<SkinnedMesh>& meshes, std::vector<std::string>& warnings) {
    const Enclosed enclosed = enclosedBy(meshes);
    const double least = -kLeastVolume * enclosed.box;
    if (enclosed.volume >= least || !(enclosed.box > 0.0)) return;
    // A sheet (ground, a wall, a cape) faces away from some points and towards others.
    if (enclosed.volume + openVolume(meshes, enclosed.size) >= least) return;
    for (SkinnedMesh& mesh : meshes)
        turn(mesh);
    warnings.emplace_back("the figure's triangles and normals point inwards: they were turned");
}

}  // namespace lutka::animation::rig_import
