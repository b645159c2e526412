#include "animation/import/iqm/read_iqm.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "animation/import/iqm/iqm_document.hpp"
#include "animation/import/source_limits.hpp"
#include "animation/import/srgb.hpp"
#include "animation/import/texture_loader.hpp"
#include "core/files.hpp"
#include "core/letter_case.hpp"

namespace lutka::animation::rig_import {
namespace {

using glm::dmat4;
using iqm::IqmDocument;
using iqm::Placement;

constexpr std::array<const char*, 5> kPictureEndings = {".png", ".jpg", ".jpeg", ".tga", ".bmp"};

dmat4 matrixOf(const Placement& placement) {
    return glm::translate(dmat4(1.0), placement.translation) * glm::mat4_cast(placement.rotation) *
           glm::scale(dmat4(1.0), placement.scale);
}

// The picture that a material's name means: the name itself where it ends like a picture, else a picture of that name
// beside the model, as in the engines of Quake's family. Nothing where it is just a name.
std::optional<std::string> pictureOf(const std::string& material, const ModelFolder& folder) {
    const std::string ending = lowerCased(std::filesystem::path(material).extension().string());
    static const std::set<std::string> kKnown = {".png", ".jpg", ".jpeg", ".tga", ".bmp",
                                                 ".dds", ".gif", ".psd",  ".pcx", ".webp"};
    if (kKnown.contains(ending)) return material;
    for (const char* added : kPictureEndings) {
        if (folder.find(material + added).place == ModelFolder::Place::inside) return material + added;
    }
    return std::nullopt;
}

// Builds the scene of one document, part by part.
class SceneBuilder {
  public:
    SceneBuilder(const IqmDocument& document, TextureLoader& pictures, const ModelFolder& folder)
        : document_(document), pictures_(pictures), folder_(folder) {}

    SourceScene build() {
        scene_.format = "IQM " + std::to_string(document_.version);
        scene_.warnings = document_.warnings;
        // Its exporters write Blender's axes as they are. One that writes others is found out by the figure.
        scene_.convention.up = UpAxis::positiveZ;
        scene_.convention.upSource = "the custom of IQM";
        addJoints();
        for (const iqm::Mesh& mesh : document_.meshes)
            addMesh(mesh);
        for (const iqm::Animation& animation : document_.animations)
            addClip(animation);
        return std::move(scene_);
    }

  private:
    void addJoints() {
        SourceSkin skin;
        std::vector<dmat4> sceneFromJoint;
        for (std::size_t i = 0; i < document_.joints.size(); ++i) {
            const iqm::Joint& joint = document_.joints[i];
            SourceNode node;
            node.name = joint.name;
            node.parent = joint.parent;
            node.parentFromNode = matrixOf(joint.bind);
            node.trs = SourceTrs{joint.bind.translation, joint.bind.rotation, joint.bind.scale};
            sceneFromJoint.push_back(joint.parent < 0 ? node.parentFromNode
                                                      : sceneFromJoint[static_cast<std::size_t>(joint.parent)] *
                                                            node.parentFromNode);
            skin.joints.push_back({static_cast<int>(i), glm::inverse(sceneFromJoint.back())});
            scene_.nodes.push_back(std::move(node));
        }
        if (!document_.joints.empty() && !document_.blendIndices.empty()) scene_.skins.push_back(std::move(skin));
    }

    // What moves a vertex: without weights the first of its joints has all.
    void addInfluences(std::size_t vertex, SourceMesh& mesh) const {
        const std::span<const float> joints = document_.blendIndices.at(vertex);
        for (std::size_t k = 0; k < joints.size(); ++k) {
            const bool weighs = !document_.blendWeights.empty();
            if (weighs && k >= static_cast<std::size_t>(document_.blendWeights.components)) break;
            const float weight =
                weighs ? document_.blendWeights.at(vertex)[k] / document_.blendWeights.most : (k == 0 ? 1.0F : 0.0F);
            const bool isJoint = joints[k] >= 0.0F && joints[k] < static_cast<float>(document_.joints.size());
            if (weight > 0.0F && isJoint) mesh.influences.push_back({static_cast<std::uint32_t>(joints[k]), weight});
        }
        mesh.influenceStart.push_back(static_cast<std::uint32_t>(mesh.influences.size()));
    }

    void addVertex(std::size_t vertex, SourceMesh& mesh) const {
        const auto vectorAt = [&](const iqm::VertexArray& array) {
            const std::span<const float> v = array.at(vertex);
            return vec3(v[0], v[1], v[2]);
        };
        mesh.positions.push_back(vectorAt(document_.positions));
        if (!document_.normals.empty()) mesh.normals.push_back(vectorAt(document_.normals) / document_.normals.most);
        if (!document_.uvs.empty()) {
            const std::span<const float> uv = document_.uvs.at(vertex);
            mesh.uvs.push_back(vec2(uv[0], uv[1]) / document_.uvs.most);
        }
        if (!document_.colors.empty()) {
            const vec3 color = vectorAt(document_.colors) / document_.colors.most;
            const bool hasAlpha = document_.colors.components == 4;
            mesh.colors.push_back(
                linearFromSrgb(vec4(color, hasAlpha ? document_.colors.at(vertex)[3] / document_.colors.most : 1.0F)));
        }
        if (!scene_.skins.empty()) addInfluences(vertex, mesh);
    }

    void addMesh(const iqm::Mesh& given) {
        SourceMesh mesh;
        mesh.name = given.name;
        mesh.material = materialOf(given.material);
        if (!scene_.skins.empty()) mesh.influenceStart.push_back(0);
        for (std::size_t i = 0; i < given.vertexCount; ++i)
            addVertex(given.firstVertex + i, mesh);
        for (std::size_t i = given.firstTriangle; i < given.firstTriangle + given.triangleCount; ++i) {
            const std::uint32_t* corner = &document_.corners[3 * i];
            const auto isOwn = [&](std::uint32_t index) {
                return index >= given.firstVertex && index - given.firstVertex < given.vertexCount;
            };
            if (!std::all_of(corner, corner + 3, isOwn)) continue;  // of another mesh
            for (const int k : {0, 2, 1})
                mesh.indices.push_back(corner[k] - static_cast<std::uint32_t>(given.firstVertex));
        }
        SourceNode node;
        node.name = given.name;
        SourceInstance instance;
        instance.mesh = static_cast<int>(scene_.meshes.size());
        instance.node = static_cast<int>(scene_.nodes.size());
        instance.skin = scene_.skins.empty() ? -1 : 0;
        scene_.nodes.push_back(std::move(node));
        scene_.meshes.push_back(std::move(mesh));
        scene_.instances.push_back(instance);
    }

    int materialOf(const std::string& name) {
        const auto [known, isNew] = materials_.try_emplace(name, static_cast<int>(scene_.materials.size()));
        if (isNew) {
            Material material;
            material.name = name;
            if (const std::optional<std::string> picture = pictureOf(name, folder_)) {
                material.baseColorTexture = pictures_.load(*picture);
                if (material.baseColorTexture != Material::kNoTexture) material.baseColor = vec4(1.0F);
            }
            scene_.materials.push_back(std::move(material));
        }
        return known->second;
    }

    void addClip(const iqm::Animation& animation) {
        SourceClip clip;
        clip.name = animation.name;
        for (std::size_t joint = 0; joint < document_.joints.size(); ++joint) {
            SourceChannel places, rotations, scales;
            places.path = SourceChannel::Path::translation;
            rotations.path = SourceChannel::Path::rotation;
            scales.path = SourceChannel::Path::scale;
            glm::dquat last(1, 0, 0, 0);
            for (std::size_t frame = 0; frame < animation.frameCount; ++frame) {
                const Placement& at =
                    document_.frames[(animation.firstFrame + frame) * document_.joints.size() + joint];
                const glm::dquat rotation = glm::dot(last, at.rotation) < 0.0 ? -at.rotation : at.rotation;
                last = rotation;
                const double time = static_cast<double>(frame) / animation.frameRate;
                for (SourceChannel* channel : {&places, &rotations, &scales})
                    channel->times.push_back(time);
                for (int axis = 0; axis < 3; ++axis) {
                    places.values.push_back(static_cast<float>(at.translation[axis]));
                    scales.values.push_back(static_cast<float>(at.scale[axis]));
                }
                for (const double part : {rotation.x, rotation.y, rotation.z, rotation.w})
                    rotations.values.push_back(static_cast<float>(part));
            }
            for (SourceChannel* channel : {&places, &rotations, &scales}) {
                channel->node = static_cast<int>(joint);
                clip.channels.push_back(std::move(*channel));
            }
        }
        scene_.clips.push_back(std::move(clip));
    }

    const IqmDocument& document_;
    TextureLoader& pictures_;
    const ModelFolder& folder_;
    SourceScene scene_;
    std::map<std::string, int> materials_;
};

}  // namespace

Result<SourceScene> readIqm(const std::filesystem::path& file, const ImportOptions& options) {
    const Result<std::vector<unsigned char>> bytes = readFile(file, kMaxFileBytes);
    if (!bytes) return bytes.error();
    const Result<IqmDocument> document = iqm::parseIqm(bytes.value(), file.string());
    if (!document) return document.error();
    const ModelFolder folder(file, options.allowOutside);
    TextureLoader pictures([](const std::string&, PictureDecoder&) { return std::nullopt; }, folder,
                           options.loadTextures);
    SourceScene scene = SceneBuilder(document.value(), pictures, folder).build();
    for (std::string& sentence : pictures.sentences())
        scene.warnings.push_back(std::move(sentence));
    scene.textures = pictures.takeTextures();
    return scene;
}

}  // namespace lutka::animation::rig_import
