#include "animation/import/scene_blob.hpp"

#include <utility>

#include "animation/import/blob_archive.hpp"

namespace lutka::animation::rig_import {
namespace {

constexpr std::uint32_t kMagic = 0x53'54'55'4C;  // LUTS
constexpr std::uint32_t kVersion = 3;

// What each struct consists of, for both directions: `Scene` is const for the writer. A new member is added here once.
constexpr auto kNodeParts = [](auto& archive, auto& node) {
    archive.text(node.name);
    archive.value(node.parent);
    archive.value(node.parentFromNode);
    archive.maybe(node.trs);
    archive.choice(node.isHelper, true);
};

constexpr auto kMeshParts = [](auto& archive, auto& mesh) {
    archive.text(mesh.name);
    archive.array(mesh.positions);
    archive.array(mesh.normals);
    archive.array(mesh.tangents);
    archive.array(mesh.uvs);
    archive.array(mesh.colors);
    archive.array(mesh.indices);
    archive.value(mesh.material);
    archive.array(mesh.influenceStart);
    archive.array(mesh.influences);
};

constexpr auto kSkinParts = [](auto& archive, auto& skin) {
    archive.list(skin.joints, [](auto& inner, auto& joint) {
        inner.value(joint.node);
        inner.value(joint.jointFromMesh);
    });
    archive.maybe(skin.sceneFromMesh);
    archive.choice(skin.verticesAreInJoints, true);
};

constexpr auto kInstanceParts = [](auto& archive, auto& instance) {
    archive.value(instance.mesh);
    archive.value(instance.node);
    archive.value(instance.skin);
    archive.choice(instance.hidden, true);
};

constexpr auto kChannelParts = [](auto& archive, auto& channel) {
    archive.value(channel.node);
    archive.choice(channel.path, SourceChannel::Path::scale);
    archive.choice(channel.interpolation, SourceChannel::Interpolation::cubicSpline);
    archive.array(channel.times);
    archive.array(channel.values);
};

constexpr auto kClipParts = [](auto& archive, auto& clip) {
    archive.text(clip.name);
    archive.list(clip.channels, kChannelParts);
};

constexpr auto kMaterialParts = [](auto& archive, auto& material) {
    archive.text(material.name);
    archive.value(material.baseColor);
    archive.value(material.metallic);
    archive.value(material.roughness);
    archive.value(material.emissive);
    archive.choice(material.alphaMode, Material::AlphaMode::blend);
    archive.value(material.alphaCutoff);
    archive.choice(material.doubleSided, true);
    archive.value(material.baseColorTexture);
    archive.value(material.metallicRoughnessTexture);
    archive.value(material.normalTexture);
    archive.value(material.occlusionTexture);
    archive.value(material.emissiveTexture);
};

constexpr auto kTextureParts = [](auto& archive, auto& texture) {
    archive.text(texture.name);
    archive.value(texture.width);
    archive.value(texture.height);
    archive.array(texture.rgba);
};

constexpr auto kTextParts = [](auto& archive, auto& text) { archive.text(text); };

template <class Archive, class Scene>
void exchange(Archive& archive, Scene& scene) {
    archive.text(scene.format);
    archive.list(scene.nodes, kNodeParts);
    archive.list(scene.meshes, kMeshParts);
    archive.list(scene.skins, kSkinParts);
    archive.list(scene.instances, kInstanceParts);
    archive.list(scene.clips, kClipParts);
    archive.list(scene.materials, kMaterialParts);
    archive.list(scene.textures, kTextureParts);
    archive.maybe(scene.convention.metresPerUnit);
    archive.text(scene.convention.unitSource);
    archive.maybeChoice(scene.convention.up, UpAxis::negativeZ);
    archive.text(scene.convention.upSource);
    archive.choice(scene.nodesArePosed, true);
    archive.names(scene.vrmHumanoid);
    archive.list(scene.warnings, kTextParts);
}

template <class Archive, class Failure>
void exchangeError(Archive& archive, Failure& error) {
    archive.choice(error.code, ErrorCode::noDisplay);
    archive.text(error.message);
    archive.text(error.location);
    archive.text(error.mend);
}

bool isIndex(int index, std::size_t count) {
    return index >= 0 && static_cast<std::size_t>(index) < count;
}

bool isIndexOrNone(int index, std::size_t count) {
    return index == -1 || isIndex(index, count);
}

template <class T>
bool fits(const std::vector<T>& items, std::size_t vertices) {
    return items.empty() || items.size() == vertices;
}

bool influencesAreSound(const SourceMesh& mesh) {
    if (mesh.influenceStart.empty()) return mesh.influences.empty();
    if (mesh.influenceStart.size() != mesh.positions.size() + 1) return false;
    if (mesh.influenceStart.front() != 0 || mesh.influenceStart.back() != mesh.influences.size()) return false;
    for (std::size_t v = 1; v < mesh.influenceStart.size(); ++v) {
        if (mesh.influenceStart[v] < mesh.influenceStart[v - 1]) return false;
    }
    for (const SourceMesh::Influence& influence : mesh.influences) {
        if (!std::isfinite(influence.weight)) return false;
    }
    return true;
}

bool isSound(const SourceMesh& mesh, const SourceScene& scene) {
    const std::size_t vertices = mesh.positions.size();
    if (!fits(mesh.normals, vertices) || !fits(mesh.tangents, vertices) || !fits(mesh.uvs, vertices) ||
        !fits(mesh.colors, vertices) || mesh.indices.size() % 3 != 0) {
        return false;
    }
    for (const std::uint32_t index : mesh.indices) {
        if (index >= vertices) return false;
    }
    return isIndexOrNone(mesh.material, scene.materials.size()) && influencesAreSound(mesh);
}

bool isSound(const SourceInstance& instance, const SourceScene& scene) {
    if (!isIndex(instance.mesh, scene.meshes.size()) || !isIndex(instance.node, scene.nodes.size()) ||
        !isIndexOrNone(instance.skin, scene.skins.size())) {
        return false;
    }
    if (instance.skin < 0) return true;
    const std::size_t joints = scene.skins[static_cast<std::size_t>(instance.skin)].joints.size();
    for (const auto& influence : scene.meshes[static_cast<std::size_t>(instance.mesh)].influences) {
        if (influence.slot >= joints) return false;
    }
    return true;
}

bool isSound(const SourceChannel& channel, std::size_t nodes) {
    const std::size_t width = channel.path == SourceChannel::Path::rotation ? 4 : 3;
    const std::size_t parts = channel.interpolation == SourceChannel::Interpolation::cubicSpline ? 3 : 1;
    for (std::size_t key = 1; key < channel.times.size(); ++key) {
        if (channel.times[key] < channel.times[key - 1]) return false;
    }
    return isIndex(channel.node, nodes) && channel.values.size() == channel.times.size() * width * parts;
}

bool isSound(const Material& material, std::size_t textures) {
    return isIndexOrNone(material.baseColorTexture, textures) &&
           isIndexOrNone(material.metallicRoughnessTexture, textures) &&
           isIndexOrNone(material.normalTexture, textures) && isIndexOrNone(material.occlusionTexture, textures) &&
           isIndexOrNone(material.emissiveTexture, textures);
}

bool isSound(const Texture& texture) {
    constexpr int mostSide = 1 << 15;
    if (texture.width < 0 || texture.height < 0 || texture.width > mostSide || texture.height > mostSide) return false;
    return texture.rgba.size() ==
           std::size_t{4} * static_cast<std::size_t>(texture.width) * static_cast<std::size_t>(texture.height);
}

}  // namespace

std::string problemOf(const SourceScene& scene) {
    const std::size_t nodes = scene.nodes.size();
    for (std::size_t node = 0; node < nodes; ++node) {
        if (scene.nodes[node].parent < -1 || scene.nodes[node].parent >= static_cast<int>(node))
            return "a node comes before its parent";
    }
    for (const SourceSkin& skin : scene.skins) {
        for (const SourceSkin::Joint& joint : skin.joints) {
            if (!isIndex(joint.node, nodes)) return "a skin has a joint that is no node";
        }
    }
    for (const SourceMesh& mesh : scene.meshes) {
        if (!isSound(mesh, scene)) return "a mesh does not fit together";
    }
    for (const SourceInstance& instance : scene.instances) {
        if (!isSound(instance, scene)) return "an instance of a mesh points nowhere";
    }
    for (const SourceClip& clip : scene.clips) {
        for (const SourceChannel& channel : clip.channels) {
            if (!isSound(channel, nodes)) return "a clip does not fit together";
        }
    }
    for (const Material& material : scene.materials) {
        if (!isSound(material, scene.textures.size())) return "a material names a texture that isn't there";
    }
    for (const Texture& texture : scene.textures) {
        if (!isSound(texture)) return "a texture's size does not fit its pixels";
    }
    for (const auto& [role, node] : scene.vrmHumanoid) {
        if (!isIndex(node, nodes)) return "a VRM role names a node that isn't there";
    }
    if (scene.convention.metresPerUnit && !(*scene.convention.metresPerUnit > 0.0)) return "the unit has no length";
    return {};
}

std::string packScene(const Result<SourceScene>& scene) {
    BlobWriter archive;
    archive.value(kMagic);
    archive.value(kVersion);
    archive.choice(scene.ok(), true);
    if (scene) {
        exchange(archive, scene.value());
    } else {
        exchangeError(archive, scene.error());
    }
    archive.value(kMagic);
    return archive.take();
}

Result<SourceScene> unpackScene(std::string_view bytes, std::string_view file) {
    const auto refuse = [&](const std::string& why) {
        return Error{ErrorCode::input, "the importing process gave no sound scene: " + why, std::string(file),
                     "the file is damaged or hostile; export it again"};
    };
    BlobReader archive(bytes);
    std::uint32_t magic = 0;
    std::uint32_t version = 0;
    bool isScene = false;
    archive.value(magic);
    archive.value(version);
    archive.choice(isScene, true);
    if (!archive.ok() || magic != kMagic || version != kVersion) return refuse("its bytes are not a scene's");
    SourceScene scene;
    Error error;
    isScene ? exchange(archive, scene) : exchangeError(archive, error);
    archive.value(magic);
    if (!archive.ok() || !archive.atEnd() || magic != kMagic) return refuse("its bytes are cut off or damaged");
    if (!isScene) return error;
    if (const std::string problem = problemOf(scene); !problem.empty()) return refuse(problem);
    return scene;
}

}  // namespace lutka::animation::rig_import
