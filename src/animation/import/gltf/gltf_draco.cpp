#include <draco/compression/decode.h>
#include <fmt/format.h>

#include <array>

#include "animation/import/gltf/gltf_parts.hpp"

namespace lutka::animation::rig_import::gltf {
namespace {

using nlohmann::json;

// The values of one attribute, `width` a vertex; draco's quantisation is undone by it, normalised integers are
// fractions.
template <class T>
std::vector<T> valuesOf(const draco::Mesh& mesh, const json& ids, const char* name, int width) {
    std::vector<T> values;
    const json* id = member(ids, name);
    if (id == nullptr || !id->is_number_unsigned()) return values;
    const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(id->get<std::uint32_t>());
    if (attribute == nullptr || attribute->num_components() > 4)
        throw Damage{fmt::format("compressed {} are damaged", name)};
    values.reserve(static_cast<std::size_t>(mesh.num_points()) * static_cast<std::size_t>(width));
    std::array<T, 4> value{};
    for (draco::PointIndex point(0); point < mesh.num_points(); ++point) {
        value = {};
        if (!attribute->ConvertValue<T>(attribute->mapped_index(point), static_cast<std::int8_t>(width), value.data()))
            throw Damage{fmt::format("compressed {} are damaged", name)};
        values.insert(values.end(), value.begin(), value.begin() + width);
    }
    return values;
}

}  // namespace

void readDraco(GltfFile& file, const json& block, SourceMesh& mesh, std::vector<std::uint32_t>& joints,
               std::vector<float>& weights) {
    const std::optional<int> view = indexOf(block, "bufferView", file.count("bufferViews"));
    const json* ids = member(block, "attributes");
    if (!view || ids == nullptr) throw Damage{"a compressed mesh has no data"};
    const std::span<const std::uint8_t> bytes = file.viewBytes(*view);
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    draco::Decoder decoder;
    const auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok())
        throw Damage{fmt::format("a compressed mesh is damaged: {}", decoded.status().error_msg_string())};
    const draco::Mesh& source = *decoded.value();
    const auto points = static_cast<std::size_t>(source.num_points());
    const std::vector<float> positions = valuesOf<float>(source, *ids, "POSITION", 3);
    const std::vector<float> normals = valuesOf<float>(source, *ids, "NORMAL", 3);
    const UvUse use = mesh.material >= 0 ? uvUseOf(file, mesh.material) : UvUse{};
    const std::vector<float> uvs = valuesOf<float>(source, *ids, fmt::format("TEXCOORD_{}", use.set).c_str(), 2);
    const std::vector<float> colors = valuesOf<float>(source, *ids, "COLOR_0", 4);
    for (std::size_t v = 0; v < points && !positions.empty(); ++v) {
        mesh.positions.emplace_back(positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]);
        if (!normals.empty()) mesh.normals.emplace_back(normals[3 * v], normals[3 * v + 1], normals[3 * v + 2]);
        if (!uvs.empty()) mesh.uvs.emplace_back(use.transform * vec3(uvs[2 * v], uvs[2 * v + 1], 1));
        if (!colors.empty())
            mesh.colors.emplace_back(colors[4 * v], colors[4 * v + 1], colors[4 * v + 2], colors[4 * v + 3]);
    }
    for (draco::FaceIndex face(0); face < source.num_faces(); ++face) {
        for (const draco::PointIndex& corner : source.face(face))
            mesh.indices.push_back(corner.value());
    }
    if (mesh.positions.empty()) mesh.indices.clear();
    joints = valuesOf<std::uint32_t>(source, *ids, "JOINTS_0", 4);
    weights = valuesOf<float>(source, *ids, "WEIGHTS_0", 4);
    if (joints.size() != weights.size() || joints.size() != 4 * mesh.positions.size()) joints.clear();
}

}  // namespace lutka::animation::rig_import::gltf
