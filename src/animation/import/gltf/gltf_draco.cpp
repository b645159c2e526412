#include "animation/import/gltf/gltf_draco.hpp"

#include <draco/compression/decode.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

namespace lutka::animation::rig_import::gltf {
namespace {

using nlohmann::json;

// The attribute's components, vertex after vertex.
template <class T>
std::vector<T> valuesOf(const draco::Mesh& mesh, const draco::PointAttribute& attribute) {
    const int width = attribute.num_components();
    std::vector<T> values;
    values.reserve(static_cast<std::size_t>(mesh.num_points()) * static_cast<std::size_t>(width));
    std::array<T, 4> value{};
    for (draco::PointIndex point(0); point < mesh.num_points(); ++point) {
        if (!attribute.ConvertValue<T>(attribute.mapped_index(point), static_cast<std::int8_t>(width), value.data()))
            throw Damage{"compressed attributes are damaged"};
        values.insert(values.end(), value.begin(), value.begin() + width);
    }
    return values;
}

template <class T>
std::vector<float> fractionsOf(const draco::Mesh& mesh, const draco::PointAttribute& attribute) {
    const std::vector<T> integers = valuesOf<T>(mesh, attribute);
    std::vector<float> fractions(integers.size());
    std::transform(integers.begin(), integers.end(), fractions.begin(), fraction<T>);
    return fractions;
}

// `asFractions`: integers are fractions, which draco itself says of few.
std::vector<float> floatsOf(const draco::Mesh& mesh, const draco::PointAttribute& attribute, bool asFractions) {
    if (!asFractions || attribute.normalized()) return valuesOf<float>(mesh, attribute);
    switch (attribute.data_type()) {
        case draco::DT_INT8:
            return fractionsOf<std::int8_t>(mesh, attribute);
        case draco::DT_UINT8:
            return fractionsOf<std::uint8_t>(mesh, attribute);
        case draco::DT_INT16:
            return fractionsOf<std::int16_t>(mesh, attribute);
        case draco::DT_UINT16:
            return fractionsOf<std::uint16_t>(mesh, attribute);
        default:
            return valuesOf<float>(mesh, attribute);
    }
}

}  // namespace

DracoPrimitive::DracoPrimitive(GltfFile& file, const json& block) {
    const std::optional<int> view = indexOf(block, "bufferView", file.count("bufferViews"));
    const json* ids = member(block, "attributes");
    if (!view || ids == nullptr) throw Damage{"a compressed mesh has no data"};
    ids_ = *ids;
    const std::span<const std::uint8_t> bytes = file.viewBytes(*view);
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok())
        throw Damage{fmt::format("a compressed mesh is damaged: {}", decoded.status().error_msg_string())};
    mesh_ = std::move(decoded).value();
}

DracoPrimitive::DracoPrimitive(DracoPrimitive&&) noexcept = default;
DracoPrimitive::~DracoPrimitive() = default;

const draco::PointAttribute* DracoPrimitive::find(const std::string& attribute) const {
    const json* id = member(ids_, attribute.c_str());
    if (id == nullptr || !id->is_number_unsigned()) return nullptr;
    const draco::PointAttribute* found = mesh_->GetAttributeByUniqueId(id->get<std::uint32_t>());
    if (found == nullptr || found->num_components() < 1 || found->num_components() > 4)
        throw Damage{fmt::format("compressed {} are damaged", attribute)};
    return found;
}

std::optional<Numbers> DracoPrimitive::numbers(const std::string& attribute, bool normalised) const {
    const draco::PointAttribute* source = find(attribute);
    if (source == nullptr) return std::nullopt;
    Numbers numbers;
    numbers.values = floatsOf(*mesh_, *source, normalised);
    numbers.count = mesh_->num_points();
    numbers.width = static_cast<std::size_t>(source->num_components());
    return numbers;
}

std::optional<std::vector<std::uint32_t>> DracoPrimitive::integers(const std::string& attribute) const {
    const draco::PointAttribute* source = find(attribute);
    if (source == nullptr) return std::nullopt;
    return valuesOf<std::uint32_t>(*mesh_, *source);
}

std::vector<std::uint32_t> DracoPrimitive::triangles() const {
    std::vector<std::uint32_t> triangles;
    triangles.reserve(3 * static_cast<std::size_t>(mesh_->num_faces()));
    for (draco::FaceIndex face(0); face < mesh_->num_faces(); ++face) {
        for (const draco::PointIndex& corner : mesh_->face(face))
            triangles.push_back(corner.value());
    }
    return triangles;
}

}  // namespace lutka::animation::rig_import::gltf
