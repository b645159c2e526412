#include <algorithm>
#include <array>
#include <limits>

#include "animation/export/glb_parts.hpp"

namespace lutka::animation::glb {
namespace {

template <class T>
std::span<const T> view(const std::vector<T>& values) {
    return values;
}

// Joint indices as bytes where they fit: half the size.
int addJoints(const SkinnedMesh& mesh, int jointCount, BufferBuilder& buffer) {
    if (jointCount > std::numeric_limits<std::uint8_t>::max() + 1) {
        return buffer.add(view(mesh.joints), TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_VEC4,
                          TINYGLTF_TARGET_ARRAY_BUFFER);
    }
    std::vector<std::array<std::uint8_t, kMaxInfluences>> bytes(mesh.joints.size());
    for (std::size_t v = 0; v < bytes.size(); ++v) {
        for (std::size_t i = 0; i < kMaxInfluences; ++i)
            bytes[v][i] = static_cast<std::uint8_t>(mesh.joints[v][i]);
    }
    return buffer.add(view(bytes), TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE, TINYGLTF_TYPE_VEC4,
                      TINYGLTF_TARGET_ARRAY_BUFFER);
}

}  // namespace

int addMesh(const SkinnedMesh& mesh, int firstMaterial, int jointCount, BufferBuilder& buffer, tinygltf::Model& model) {
    const auto floats = [&](auto values, int type) {
        return buffer.add(values, TINYGLTF_COMPONENT_TYPE_FLOAT, type, TINYGLTF_TARGET_ARRAY_BUFFER);
    };
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = firstMaterial + mesh.material;
    primitive.attributes["POSITION"] =
        buffer.addBounded(view(mesh.positions), TINYGLTF_TYPE_VEC3, TINYGLTF_TARGET_ARRAY_BUFFER);
    if (!mesh.normals.empty()) primitive.attributes["NORMAL"] = floats(view(mesh.normals), TINYGLTF_TYPE_VEC3);
    if (!mesh.tangents.empty()) primitive.attributes["TANGENT"] = floats(view(mesh.tangents), TINYGLTF_TYPE_VEC4);
    if (!mesh.uvs.empty()) primitive.attributes["TEXCOORD_0"] = floats(view(mesh.uvs), TINYGLTF_TYPE_VEC2);
    if (!mesh.colors.empty()) primitive.attributes["COLOR_0"] = floats(view(mesh.colors), TINYGLTF_TYPE_VEC4);
    primitive.attributes["JOINTS_0"] = addJoints(mesh, jointCount, buffer);
    primitive.attributes["WEIGHTS_0"] = floats(view(mesh.weights), TINYGLTF_TYPE_VEC4);
    primitive.indices = buffer.add(view(mesh.indices), TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR,
                                   TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    tinygltf::Mesh out;
    out.name = utf8(mesh.name);
    out.primitives.push_back(std::move(primitive));
    model.meshes.push_back(std::move(out));
    return static_cast<int>(model.meshes.size()) - 1;
}

}  // namespace lutka::animation::glb
