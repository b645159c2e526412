#include "animation/import/inside_out.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "animation/import/affine.hpp"

namespace lutka::animation::rig_import {
namespace {

constexpr double kLeastVolume = 0.01;  // of the box around the figure: less is no figure's, but a sheet's

struct Enclosed {
    double volume = 0.0;  // signed: positive where the triangles face outwards
    double open = 0.0;    // how much of it depends on the point that it is taken about: 0 where no mesh has a hole
    double box = 0.0;
};

Enclosed enclosedBy(const std::vector<SkinnedMesh>& meshes) {
    dvec3 low(1e30);
    dvec3 high(-1e30);
    for (const SkinnedMesh& mesh : meshes) {
        for (const vec3& p : mesh.positions) {
            low = glm::min(low, dvec3(p));
            high = glm::max(high, dvec3(p));
        }
    }
    Enclosed out;
    if (low.x > high.x) return out;
    const dvec3 size = high - low;
    out.box = size.x * size.y * size.z;
    // Holes count for least when volumes are taken about the middle.
    const dvec3 middle = 0.5 * (low + high);
    dvec3 area(0.0);  // as a vector, which a closed surface has none of
    for (const SkinnedMesh& mesh : meshes) {
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            const dvec3 a = dvec3(mesh.positions[mesh.indices[i]]) - middle;
            const dvec3 b = dvec3(mesh.positions[mesh.indices[i + 1]]) - middle;
            const dvec3 c = dvec3(mesh.positions[mesh.indices[i + 2]]) - middle;
            out.volume += glm::dot(a, glm::cross(b, c)) / 6.0;
            area += 0.5 * glm::cross(b - a, c - a);
        }
    }
    out.open = glm::dot(glm::abs(area), 0.5 * size) / 3.0;
    return out;
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
    // A sheet (ground, a wall, a cape) faces away from some points and towards others.
    if (enclosed.volume + enclosed.open >= -kLeastVolume * enclosed.box || !(enclosed.box > 0.0)) return;
    for (SkinnedMesh& mesh : meshes)
        turn(mesh);
    warnings.emplace_back("the figure's triangles and normals point inwards: they were turned");
}

}  // namespace lutka::animation::rig_import
