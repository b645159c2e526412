#include "animation/import/inside_out.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "animation/import/affine.hpp"
#include "animation/import/vertex_bounds.hpp"
#include "core/union_find.hpp"

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

// Pieces whose triangles hang together, over all meshes: vertices at one place are one. Vertices count on from mesh to
// mesh.
UnionFind weldedPieces(const std::vector<SkinnedMesh>& meshes, double grain) {
    struct Vertex {
        std::array<std::int64_t, 3> cell;
        int index;
    };
    std::vector<Vertex> vertices;
    for (const SkinnedMesh& mesh : meshes) {
        for (const vec3& p : mesh.positions) {
            const dvec3 cell = dvec3(p) / grain;
            vertices.push_back({{std::llround(cell.x), std::llround(cell.y), std::llround(cell.z)},
                                static_cast<int>(vertices.size())});
        }
    }
    UnionFind pieces;
    pieces.reset(vertices.size());
    std::sort(vertices.begin(), vertices.end(), [](const Vertex& a, const Vertex& b) { return a.cell < b.cell; });
    for (std::size_t i = 1; i < vertices.size(); ++i)
        if (vertices[i].cell == vertices[i - 1].cell) pieces.join(vertices[i - 1].index, vertices[i].index);
    int first = 0;
    for (const SkinnedMesh& mesh : meshes) {
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            const auto vertex = [&](std::size_t corner) { return first + static_cast<int>(mesh.indices[i + corner]); };
            pieces.join(vertex(0), vertex(1));
            pieces.join(vertex(0), vertex(2));
        }
        first += static_cast<int>(mesh.positions.size());
    }
    return pieces;
}

// How much of the volume depends on the point that it is taken about: 0 where no piece has a hole. Of each piece by
// itself: sheets that face each other are open, though their areas cancel out.
double openVolume(const std::vector<SkinnedMesh>& meshes, const dvec3& size) {
    constexpr double kGrain = 1e-5;  // of the size
    UnionFind pieces = weldedPieces(meshes, kGrain * std::max({size.x, size.y, size.z}));
    std::size_t count = 0;
    for (const SkinnedMesh& mesh : meshes)
        count += mesh.positions.size();
    std::vector<dvec3> areas(count, dvec3(0.0));  // of each piece, as vectors, which a closed surface has none of
    int first = 0;
    for (const SkinnedMesh& mesh : meshes) {
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            const dvec3 a(mesh.positions[mesh.indices[i]]);
            const dvec3 b(mesh.positions[mesh.indices[i + 1]]);
            const dvec3 c(mesh.positions[mesh.indices[i + 2]]);
            const int piece = pieces.find(first + static_cast<int>(mesh.indices[i]));
            areas[static_cast<std::size_t>(piece)] += 0.5 * glm::cross(b - a, c - a);
        }
        first += static_cast<int>(mesh.positions.size());
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
