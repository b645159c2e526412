#include <fmt/format.h>

#include <algorithm>

#include "animation/import/build_character.hpp"
#include "animation/import/scene_blob.hpp"
#include "animation/import/source_limits.hpp"

namespace lutka::animation::rig_import {
namespace {

// Counts beyond what a character can have; empty when there are none.
std::string excessOf(const SourceScene& scene) {
    std::size_t vertices = 0;
    for (const SourceMesh& mesh : scene.meshes)
        vertices += mesh.positions.size();
    std::size_t placed = 0;
    std::size_t indices = 0;
    std::size_t slots = 0;
    for (const SourceInstance& instance : scene.instances) {
        const SourceMesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
        placed += mesh.positions.size();
        indices += mesh.indices.size();
        if (instance.skin >= 0) slots += scene.skins[static_cast<std::size_t>(instance.skin)].joints.size();
    }
    struct Limit {
        std::size_t count, most;
        const char* what;
    };
    for (const Limit& limit :
         {Limit{scene.meshes.size(), kMaxMeshes, "meshes"},
          Limit{scene.instances.size(), kMaxPlacedMeshes, "places of meshes"},
          Limit{std::max(vertices, placed), kMaxVertices, "vertices (each place of a mesh counts)"},
          Limit{indices / 3, kMaxPlacedIndices / 3, "triangles (each place of a mesh counts)"},
          Limit{slots, kMaxPlacedSlots, "joints of skins (each place of a mesh counts)"}}) {
        if (limit.count > limit.most) return fmt::format("has more than {} {}", limit.most, limit.what);
    }
    return {};
}

}  // namespace

std::optional<Error> validate(const SourceScene& scene, const std::string& location) {
    if (scene.nodes.size() > kMaxNodes) return tooManyNodes(location);
    if (scene.nodes.empty()) return Error{ErrorCode::input, "the scene has no nodes", location, ""};
    if (std::string problem = problemOf(scene); !problem.empty())
        return Error{ErrorCode::input, std::move(problem), location,
                     "check that the file is whole, or export it again"};
    if (std::string excess = excessOf(scene); !excess.empty())
        return Error{ErrorCode::input, std::move(excess), location,
                     "export the character without the rest of the scene"};
    return std::nullopt;
}

}  // namespace lutka::animation::rig_import
