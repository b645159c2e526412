#include "animation/export/write_glb.hpp"

#include <algorithm>
#include <exception>
#include <map>
#include <sstream>

#include "animation/export/glb_parts.hpp"
#include "animation/humanoid/roles.hpp"
#include "animation/pose.hpp"
#include "core/files.hpp"

namespace lutka::animation {
namespace {

// A .glb states its length in 32 bits.
constexpr std::size_t kMaxBytes = 0xFFFF'0000ULL;

/// Builds the file: what figures of one character share is in it once.
class GlbBuilder {
  public:
    GlbBuilder() : buffer_(model_) {
        model_.asset.version = "2.0";
        model_.asset.generator = "Lutka";
    }

    /// Adds a figure in its bind pose and returns the node of its first joint.
    int addFigure(const Character& character, const RigidTransform& worldFromModel);
    /// Adds one animation of figures, given by the nodes of their first joints; the clips belong to `characters`.
    void addAnimation(const std::string& name, std::span<const GlbFigure> figures, std::span<const int> firstJoints,
                      const std::optional<KeyTolerance>& tolerance);
    tinygltf::Model take();

  private:
    struct Shared {
        std::vector<int> meshes;
        int inverseBinds = -1;
        std::vector<RigidTransform> parentFromJoint;  // of the bind pose
        std::vector<float> skinReach;
        float sizeM = 0.0F;  // of the skin
    };
    const Shared& sharedOf(const Character& character);

    tinygltf::Model model_;
    glb::BufferBuilder buffer_;
    tinygltf::Scene scene_;
    std::map<const Character*, Shared> shared_;
};

tinygltf::Node wrapperNode(const Character& character, const RigidTransform& worldFromModel) {
    tinygltf::Node node;
    node.name = glb::utf8(character.name.empty() ? "character" : character.name);
    const glm::dquat q = glm::normalize(glm::dquat(worldFromModel.rotation));
    const vec3& t = worldFromModel.translation;
    node.rotation = {q.x, q.y, q.z, q.w};
    node.translation = {t.x, t.y, t.z};
    return node;
}

// The longest side of the skin's box: a figure may lie.
float sizeOfSkin(const Character& character) {
    vec3 low(0);
    vec3 high(0);
    bool first = true;
    for (const SkinnedMesh& mesh : character.meshes) {
        for (const vec3& position : mesh.positions) {
            low = first ? position : glm::min(low, position);
            high = first ? position : glm::max(high, position);
            first = false;
        }
    }
    const vec3 size = high - low;
    return std::max({size.x, size.y, size.z});
}

// Of small figures a tenth of a millimetre is much: nothing is off by more than a share of the size.
KeyTolerance toSize(KeyTolerance tolerance, float sizeM) {
    constexpr float kShare = 1e-4F;
    if (sizeM > 0.0F) tolerance.metres = std::min(tolerance.metres, kShare * sizeM);
    return tolerance;
}

const GlbBuilder::Shared& GlbBuilder::sharedOf(const Character& character) {
    const auto known = shared_.find(&character);
    if (known != shared_.end()) return known->second;
    const Skeleton& skeleton = character.skeleton;
    Shared& shared = shared_[&character];
    shared.parentFromJoint.resize(skeleton.parents.size());
    modelToLocal(skeleton, skeleton.bindModelFromJoint, shared.parentFromJoint);
    shared.skinReach = skinReach(character);
    shared.sizeM = sizeOfSkin(character);
    if (skeleton.jointCount() > 0) shared.inverseBinds = glb::addInverseBinds(skeleton, buffer_);
    const int firstMaterial = static_cast<int>(model_.materials.size());
    for (const SkinnedMesh& mesh : character.meshes)
        shared.meshes.push_back(glb::addMesh(mesh, firstMaterial, skeleton.jointCount(), buffer_, model_));
    glb::addMaterials(character, buffer_, model_);
    return shared;
}

int GlbBuilder::addFigure(const Character& character, const RigidTransform& worldFromModel) {
    const Shared& shared = sharedOf(character);
    const Skeleton& skeleton = character.skeleton;
    const int wrapper = static_cast<int>(model_.nodes.size());
    model_.nodes.push_back(wrapperNode(character, worldFromModel));
    scene_.nodes.push_back(wrapper);
    const int skin = skeleton.jointCount() > 0
                         ? glb::addSkeleton(skeleton, shared.parentFromJoint, wrapper, shared.inverseBinds, model_)
                         : -1;
    // What VRM's own block told; without it a figure of odd proportions would not be known again.
    for (const auto& [role, joint] : character.vrmHumanoid)
        model_.nodes[wrapper + 1 + joint].extras =
            tinygltf::Value(tinygltf::Value::Object{{kRoleExtra, tinygltf::Value(glb::utf8(role))}});
    for (std::size_t i = 0; i < shared.meshes.size(); ++i) {
        tinygltf::Node node;
        node.name = glb::utf8(character.meshes[i].name);
        node.skin = skin;
        node.mesh = shared.meshes[i];
        // A skinned mesh follows its joints only; at the root nothing else can seem to move it.
        scene_.nodes.push_back(static_cast<int>(model_.nodes.size()));
        model_.nodes.push_back(std::move(node));
    }
    return wrapper + 1;
}

void GlbBuilder::addAnimation(const std::string& name, std::span<const GlbFigure> figures,
                              std::span<const int> firstJoints, const std::optional<KeyTolerance>& tolerance) {
    glb::AnimationBuilder animation(name, buffer_, model_);
    for (std::size_t i = 0; i < figures.size(); ++i) {
        const Skeleton& skeleton = figures[i].character->skeleton;
        const Clip& clip = *figures[i].clip;
        const Shared& shared = sharedOf(*figures[i].character);
        animation.add(clip,
                      tolerance ? reduceKeys(skeleton, clip, toSize(*tolerance, shared.sizeM), shared.skinReach)
                                : allKeys(skeleton, clip),
                      shared.parentFromJoint, firstJoints[i]);
    }
    animation.finish();
}

tinygltf::Model GlbBuilder::take() {
    model_.scenes.push_back(std::move(scene_));
    model_.defaultScene = 0;
    if (buffer_.size() == 0) model_.buffers.clear();
    return std::move(model_);
}

Result<std::string> serialise(tinygltf::Model& model) {
    try {
        std::ostringstream out(std::ios::binary);
        tinygltf::TinyGLTF writer;
        if (!writer.WriteGltfSceneToStream(&model, out, false, true))
            return Error{ErrorCode::internal, "the glTF could not be written", "", ""};
        return std::move(out).str();
    } catch (const std::exception& e) {
        return Error{ErrorCode::internal, std::string("the glTF could not be written: ") + e.what(), "", ""};
    }
}

Result<std::string> bytesOf(const std::filesystem::path& name, tinygltf::Model model) {
    if (!model.buffers.empty() && model.buffers[0].data.size() > kMaxBytes) {
        return Error{ErrorCode::output, "a .glb file can't hold more than 4 GiB", name.string(),
                     "write fewer or shorter clips"};
    }
    return serialise(model);
}

}  // namespace

Result<std::string> glbBytes(const std::filesystem::path& name, const Character& character, std::span<const Clip> clips,
                             const RigidTransform& worldFromModel, const std::optional<KeyTolerance>& tolerance) {
    GlbBuilder builder;
    const int firstJoint = builder.addFigure(character, worldFromModel);
    for (const Clip& clip : clips) {
        const GlbFigure figure{&character, &clip, worldFromModel};
        builder.addAnimation(clip.name, std::span(&figure, 1), std::span(&firstJoint, 1), tolerance);
    }
    return bytesOf(name, builder.take());
}

Result<void> writeGlb(const std::filesystem::path& file, const Character& character, std::span<const Clip> clips,
                      const RigidTransform& worldFromModel, const std::optional<KeyTolerance>& tolerance) {
    const Result<std::string> bytes = glbBytes(file, character, clips, worldFromModel, tolerance);
    if (!bytes) return bytes.error();
    return writeFileAtomically(file, bytes.value());
}

Result<void> writeGlbCrowd(const std::filesystem::path& file, const std::string& clipName,
                           std::span<const GlbFigure> figures, const std::optional<KeyTolerance>& tolerance) {
    GlbBuilder builder;
    std::vector<int> firstJoints;
    for (const GlbFigure& figure : figures)
        firstJoints.push_back(builder.addFigure(*figure.character, figure.worldFromModel));
    builder.addAnimation(clipName, figures, firstJoints, tolerance);
    const Result<std::string> bytes = bytesOf(file, builder.take());
    if (!bytes) return bytes.error();
    return writeFileAtomically(file, bytes.value());
}

}  // namespace lutka::animation
