#include <fmt/format.h>
#include <cmath>

#include <algorithm>
#include <limits>

#include "animation/import/build_character.hpp"
#include "animation/import/source_limits.hpp"

namespace lutka::animation::rig_import {
namespace {

using Problem = std::optional<std::string>;

bool isIndex(int index, std::size_t size) {
    return index >= 0 && static_cast<std::size_t>(index) < size;
}

bool allFinite(const glm::dmat4& matrix) {
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            if (!std::isfinite(matrix[column][row])) return false;
        }
    }
    return true;
}

Problem problemOfNodes(const SourceScene& scene) {
    if (scene.nodes.empty()) return "the scene has no nodes";
    if (scene.nodes.front().isHelper && scene.nodes.size() == 1) return "the scene has no nodes";
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const SourceNode& node = scene.nodes[i];
        if (node.parent >= static_cast<int>(i) || node.parent < -1)
            return fmt::format("node {} stands before its parent", i);
        if (!allFinite(node.parentFromNode)) return fmt::format("node {} has a transform that is not finite", i);
    }
    return std::nullopt;
}

Problem problemOfMesh(const SourceMesh& mesh, std::size_t materials) {
    const std::size_t count = mesh.positions.size();
    for (const std::size_t size : {mesh.normals.size(), mesh.tangents.size(), mesh.uvs.size(), mesh.colors.size()}) {
        if (size != 0 && size != count) return "its vertex arrays differ in size";
    }
    if (mesh.indices.size() % 3 != 0) return "its indices are no triangles";
    if (std::any_of(mesh.indices.begin(), mesh.indices.end(), [&](std::uint32_t i) { return i >= count; }))
        return "a triangle names a vertex that is not there";
    if (mesh.material >= 0 && materials > 0 && !isIndex(mesh.material, materials)) return "its material is not there";
    if (mesh.influenceStart.empty()) return mesh.influences.empty() ? Problem() : "its influences belong to no vertex";
    if (mesh.influenceStart.size() != count + 1 || mesh.influenceStart.front() != 0 ||
        mesh.influenceStart.back() != mesh.influences.size() ||
        !std::is_sorted(mesh.influenceStart.begin(), mesh.influenceStart.end()))
        return "its influences are not those of its vertices";
    return std::nullopt;
}

Problem problemOfInstance(const SourceScene& scene, const SourceInstance& instance) {
    if (!isIndex(instance.mesh, scene.meshes.size()) || !isIndex(instance.node, scene.nodes.size()))
        return "it names a mesh or node that is not there";
    if (instance.skin < 0) return std::nullopt;
    if (!isIndex(instance.skin, scene.skins.size())) return "it names a skin that is not there";
    const std::size_t slots = scene.skins[instance.skin].joints.size();
    const SourceMesh& mesh = scene.meshes[instance.mesh];
    const bool outside = std::any_of(mesh.influences.begin(), mesh.influences.end(),
                                     [&](const SourceMesh::Influence& influence) { return influence.slot >= slots; });
    return outside ? Problem("a vertex names a joint that its skin does not have") : std::nullopt;
}

Problem problemOfMeshes(const SourceScene& scene) {
    std::size_t vertices = 0;
    if (scene.meshes.size() > kMaxMeshes) return fmt::format("more than {} meshes", kMaxMeshes);
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        vertices += scene.meshes[i].positions.size();
        if (const Problem problem = problemOfMesh(scene.meshes[i], scene.materials.size()))
            return fmt::format("mesh '{}': {}", scene.meshes[i].name, *problem);
    }
    for (const SourceSkin& skin : scene.skins) {
        for (const SourceSkin::Joint& joint : skin.joints) {
            if (!isIndex(joint.node, scene.nodes.size())) return "a skin names a node that is not there";
        }
    }
    std::size_t placed = 0;
    for (const SourceInstance& instance : scene.instances) {
        if (const Problem problem = problemOfInstance(scene, instance)) return "a placed mesh: " + *problem;
        placed += scene.meshes[instance.mesh].positions.size();
    }
    if (std::max(vertices, placed) > kMaxVertices) return fmt::format("more than {} vertices", kMaxVertices);
    return std::nullopt;
}

Problem problemOfClips(const SourceScene& scene) {
    for (const SourceClip& clip : scene.clips) {
        for (const SourceChannel& channel : clip.channels) {
            const std::size_t width = channel.path == SourceChannel::Path::rotation ? 4 : 3;
            const std::size_t parts = channel.interpolation == SourceChannel::Interpolation::cubicSpline ? 3 : 1;
            const bool sorted = std::is_sorted(channel.times.begin(), channel.times.end());
            const bool finite =
                std::all_of(channel.times.begin(), channel.times.end(), [](double t) { return std::isfinite(t); });
            if (!isIndex(channel.node, scene.nodes.size()) || channel.times.empty() || !sorted || !finite ||
                channel.values.size() != channel.times.size() * width * parts)
                return fmt::format("clip '{}' has a channel whose keys are damaged", clip.name);
        }
    }
    return std::nullopt;
}

Problem problemOfPictures(const SourceScene& scene) {
    for (const Texture& texture : scene.textures) {
        const std::size_t bytes =
            std::size_t{4} * static_cast<std::size_t>(std::max(texture.width, 0)) * std::max(texture.height, 0);
        if (texture.width <= 0 || texture.height <= 0 || texture.rgba.size() != bytes)
            return fmt::format("picture '{}' has another size than it says", texture.name);
    }
    const auto there = [&](int texture) {
        return texture == Material::kNoTexture || isIndex(texture, scene.textures.size());
    };
    for (const Material& m : scene.materials) {
        if (!there(m.baseColorTexture) || !there(m.metallicRoughnessTexture) || !there(m.normalTexture) ||
            !there(m.occlusionTexture) || !there(m.emissiveTexture))
            return fmt::format("material '{}' names a picture that is not there", m.name);
    }
    for (const auto& [role, node] : scene.vrmHumanoid) {
        if (!isIndex(node, scene.nodes.size()))
            return fmt::format("the role '{}' names a node that is not there", role);
    }
    return std::nullopt;
}

}  // namespace

std::optional<Error> validate(const SourceScene& scene, const std::string& location) {
    if (scene.nodes.size() > kMaxNodes) return tooManyNodes(location);
    for (const auto& find : {problemOfNodes, problemOfMeshes, problemOfClips, problemOfPictures}) {
        if (const Problem problem = find(scene))
            return Error{ErrorCode::input, *problem, location, "check that the file is whole, or export it again"};
    }
    return std::nullopt;
}

}  // namespace lutka::animation::rig_import
