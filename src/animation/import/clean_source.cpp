#include "animation/import/clean_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "animation/import/affine.hpp"
#include "core/math.hpp"
#include "core/utf8.hpp"

namespace lutka::animation::rig_import {
namespace {

template <class Vector>
bool allFinite(const Vector& v) {
    for (int i = 0; i < Vector::length(); ++i) {
        if (!std::isfinite(v[i])) return false;
    }
    return true;
}

template <class Vector>
void zeroStrays(std::vector<Vector>& values) {
    for (Vector& value : values) {
        if (!allFinite(value)) value = Vector(0.0F);
    }
}

// Returns how many vertices were not finite; their triangles are gone.
int dropBadVertices(SourceMesh& mesh) {
    std::vector<bool> bad(mesh.positions.size(), false);
    int count = 0;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        if (isFinite(mesh.positions[v])) continue;
        bad[v] = true;
        mesh.positions[v] = vec3(0);
        ++count;
    }
    if (count == 0) return 0;
    std::vector<std::uint32_t> kept;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const std::uint32_t* corner = &mesh.indices[i];
        if (!bad[corner[0]] && !bad[corner[1]] && !bad[corner[2]]) kept.insert(kept.end(), corner, corner + 3);
    }
    mesh.indices = std::move(kept);
    return count;
}

int dropBadWeights(SourceMesh& mesh) {
    int count = 0;
    for (SourceMesh::Influence& influence : mesh.influences) {
        if (std::isfinite(influence.weight) && influence.weight >= 0.0F) continue;
        influence.weight = 0.0F;
        ++count;
    }
    return count;
}

// A key that is not finite holds the one before it.
void mendKeys(SourceChannel& channel) {
    const std::size_t width = channel.times.empty() ? 1 : channel.values.size() / channel.times.size();
    for (std::size_t i = 0; i < channel.values.size(); ++i) {
        if (!std::isfinite(channel.values[i])) channel.values[i] = i >= width ? channel.values[i - width] : 0.0F;
    }
}

}  // namespace

void cleanNumbers(SourceScene& scene) {
    int vertices = 0;
    int weights = 0;
    for (SourceMesh& mesh : scene.meshes) {
        vertices += dropBadVertices(mesh);
        weights += dropBadWeights(mesh);
        zeroStrays(mesh.normals);
        zeroStrays(mesh.tangents);
        zeroStrays(mesh.uvs);
        zeroStrays(mesh.colors);
    }
    for (SourceNode& node : scene.nodes) {
        if (allFinite(node.parentFromNode)) continue;
        node.parentFromNode = glm::dmat4(1.0);
        node.trs.reset();
    }
    for (SourceSkin& skin : scene.skins) {
        for (SourceSkin::Joint& joint : skin.joints) {
            if (!allFinite(joint.jointFromMesh)) joint.jointFromMesh = glm::dmat4(0.0);  // unusable: told later
        }
        if (skin.sceneFromMesh && !allFinite(*skin.sceneFromMesh)) skin.sceneFromMesh.reset();
    }
    for (SourceClip& clip : scene.clips) {
        for (SourceChannel& channel : clip.channels)
            mendKeys(channel);
    }
    if (vertices > 0) {
        scene.warnings.push_back(
            fmt::format("{} vertices have no finite position; their triangles were dropped", vertices));
    }
    if (weights > 0) scene.warnings.push_back(fmt::format("{} invalid skin weights were dropped", weights));
}

void cleanNames(SourceScene& scene) {
    const auto clean = [](auto& named) {
        for (auto& one : named)
            one.name = withoutControls(one.name, '_');
    };
    clean(scene.nodes);
    clean(scene.meshes);
    clean(scene.clips);
    clean(scene.materials);
    clean(scene.textures);
    for (std::string& warning : scene.warnings)
        warning = withoutControls(warning, ' ');
}

}  // namespace lutka::animation::rig_import
