#include "animation/export/write_glb.hpp"

#include <exception>
#include <sstream>

#include "animation/export/glb_parts.hpp"
#include "animation/pose.hpp"
#include "core/files.hpp"

namespace lutka::animation {
namespace {

// A .glb states its length in 32 bits.
constexpr std::size_t kMaxBytes = 0xFFFF'0000ULL;

tinygltf::Node wrapperNode(const Character& character, const RigidTransform& worldFromModel) {
    tinygltf::Node node;
    node.name = glb::utf8(character.name.empty() ? "character" : character.name);
    const glm::dquat q = glm::normalize(glm::dquat(worldFromModel.rotation));
    const vec3& t = worldFromModel.translation;
    node.rotation = {q.x, q.y, q.z, q.w};
    node.translation = {t.x, t.y, t.z};
    return node;
}

tinygltf::Model buildModel(const Character& character, std::span<const Clip> clips,
                           const RigidTransform& worldFromModel) {
    constexpr int kWrapper = 0;
    constexpr int kFirstJoint = 1;
    tinygltf::Model model;
    model.asset.version = "2.0";
    model.asset.generator = "Lutka";
    glb::BufferBuilder buffer(model);
    model.nodes.push_back(wrapperNode(character, worldFromModel));
    const Skeleton& skeleton = character.skeleton;
    std::vector<RigidTransform> parentFromJoint(skeleton.parents.size());
    modelToLocal(skeleton, skeleton.bindModelFromJoint, parentFromJoint);
    tinygltf::Scene scene;
    scene.nodes.push_back(kWrapper);
    const int skin =
        skeleton.jointCount() > 0 ? glb::addSkeleton(skeleton, parentFromJoint, kWrapper, buffer, model) : -1;
    for (const SkinnedMesh& mesh : character.meshes) {
        tinygltf::Node node;
        node.name = glb::utf8(mesh.name);
        node.skin = skin;
        node.mesh = glb::addMesh(mesh, skeleton.jointCount(), buffer, model);
        // A skinned mesh follows its joints only; at the root nothing else can seem to move it.
        scene.nodes.push_back(static_cast<int>(model.nodes.size()));
        model.nodes.push_back(std::move(node));
    }
    glb::addMaterials(character, buffer, model);
    for (const Clip& clip : clips)
        glb::addAnimation(clip, parentFromJoint, kFirstJoint, buffer, model);
    model.scenes.push_back(std::move(scene));
    model.defaultScene = 0;
    if (buffer.size() == 0) model.buffers.clear();
    return model;
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

}  // namespace

Result<std::string> glbBytes(const std::filesystem::path& name, const Character& character, std::span<const Clip> clips,
                             const RigidTransform& worldFromModel) {
    tinygltf::Model model = buildModel(character, clips, worldFromModel);
    if (!model.buffers.empty() && model.buffers[0].data.size() > kMaxBytes) {
        return Error{ErrorCode::output, "a .glb file can't hold more than 4 GiB", name.string(),
                     "write fewer or shorter clips"};
    }
    return serialise(model);
}

Result<void> writeGlb(const std::filesystem::path& file, const Character& character, std::span<const Clip> clips,
                      const RigidTransform& worldFromModel) {
    const Result<std::string> bytes = glbBytes(file, character, clips, worldFromModel);
    if (!bytes) return bytes.error();
    return writeFileAtomically(file, bytes.value());
}

}  // namespace lutka::animation
