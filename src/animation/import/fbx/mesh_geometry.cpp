#include "animation/import/fbx/mesh_geometry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <map>

#include "animation/import/affine.hpp"
#include "animation/import/fbx/blend_shapes.hpp"
#include "animation/import/fbx/layer_element.hpp"
#include "animation/import/fbx/triangulate.hpp"
#include "animation/import/source_limits.hpp"
#include "animation/import/srgb.hpp"

namespace lutka::animation::rig_import::fbx {
namespace {

constexpr int kMaxSlot = 4096;

// The layer elements of a geometry that a mesh is made of.
struct Layers {
    LayerElement normals;
    LayerElement colors;
    LayerElement materials;
    std::vector<std::pair<std::string, LayerElement>> uvs;
};

Layers layersOf(const Record& geometry) {
    Layers out;
    for (const Record& record : geometry.children) {
        if (record.name == "LayerElementNormal" && out.normals.empty()) {
            // Older exporters write the index under either name.
            const char* index = record.child("NormalsIndex") != nullptr ? "NormalsIndex" : "NormalIndex";
            out.normals = LayerElement(record, "Normals", index, 3);
        } else if (record.name == "LayerElementColor" && out.colors.empty()) {
            out.colors = LayerElement(record, "Colors", "ColorIndex", 4);
        } else if (record.name == "LayerElementMaterial" && out.materials.empty()) {
            // Its "index" array is what the materials are: the second index into the node's list is always direct.
            out.materials = LayerElement(record, "Materials", "", 1);
        } else if (record.name == "LayerElementUV") {
            const Record* name = record.child("Name");
            out.uvs.emplace_back(name != nullptr ? name->text(0) : "", LayerElement(record, "UV", "UVIndex", 2));
        }
    }
    return out;
}

const LayerElement* uvSet(const Layers& layers, const std::string& name) {
    for (const auto& [known, element] : layers.uvs) {
        if (known == name && !element.empty()) return &element;
    }
    for (const auto& [known, element] : layers.uvs) {
        if (!element.empty()) return &element;
    }
    return nullptr;
}

struct Attributes {
    std::array<float, 3> normal{};
    std::array<float, 2> uv{};
    std::array<float, 4> color{};
    bool operator==(const Attributes&) const = default;
};

// Gathers the polygons of one material. Corners that are the same in everything become one vertex.
class PartBuilder {
  public:
    PartBuilder(const Layers& layers, const LayerElement* uvs) : layers_(layers), uvs_(uvs) {}

    void add(std::span<const Corner> polygon, std::span<const dvec3> points, const dmat4& meshFromGeometry) {
        corners_.clear();
        places_.clear();
        for (const Corner& corner : polygon) {
            const std::uint32_t vertex = vertexOf(corner, points, meshFromGeometry);
            places_.push_back(vertex);
            corners_.push_back(part.mesh.positions[vertex]);
        }
        triangles_.clear();
        triangulate(corners_, triangles_);
        for (const std::uint32_t corner : triangles_)
            part.mesh.indices.push_back(places_[corner]);
    }

    MeshPart part;

  private:
    std::uint32_t vertexOf(const Corner& corner, std::span<const dvec3> points, const dmat4& meshFromGeometry) {
        Attributes attributes;
        if (!layers_.normals.empty()) attributes.normal = layers_.normals.at<3>(corner);
        if (uvs_ != nullptr) attributes.uv = uvs_->at<2>(corner);
        if (!layers_.colors.empty()) attributes.color = layers_.colors.at<4>(corner);
        const auto [first, isNew] = firstOf_.try_emplace(corner.controlPoint, next_.size());
        std::size_t at = first->second;
        if (!isNew) {
            while (attributes_[at] != attributes && next_[at] != kNone)
                at = next_[at];
            if (attributes_[at] == attributes) return static_cast<std::uint32_t>(at);
            next_[at] = next_.size();
        }
        next_.push_back(kNone);
        attributes_.push_back(attributes);
        push(corner, attributes, points[corner.controlPoint], meshFromGeometry);
        return static_cast<std::uint32_t>(next_.size() - 1);
    }

    void push(const Corner& corner, const Attributes& attributes, const dvec3& point, const dmat4& meshFromGeometry) {
        SourceMesh& mesh = part.mesh;
        part.controlPoints.push_back(corner.controlPoint);
        mesh.positions.emplace_back(meshFromGeometry * glm::dvec4(point, 1.0));
        if (!layers_.normals.empty()) mesh.normals.push_back(normalOf(attributes.normal, meshFromGeometry));
        if (uvs_ != nullptr) mesh.uvs.emplace_back(attributes.uv[0], 1.0F - attributes.uv[1]);
        const auto& c = attributes.color;
        if (!layers_.colors.empty()) mesh.colors.push_back(linearFromSrgb(vec4(c[0], c[1], c[2], c[3])));
    }

    static vec3 normalOf(const std::array<float, 3>& n, const dmat4& meshFromGeometry) {
        const dmat3 turn(meshFromGeometry);
        const dmat3 cofactor(glm::cross(turn[1], turn[2]), glm::cross(turn[2], turn[0]), glm::cross(turn[0], turn[1]));
        const dvec3 out = (glm::determinant(turn) < 0.0 ? -1.0 : 1.0) * (cofactor * dvec3(n[0], n[1], n[2]));
        const double length = glm::length(out);
        return length > 0.0 && std::isfinite(length) ? vec3(out / length) : vec3(0);
    }

    static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
    const Layers& layers_;
    const LayerElement* uvs_;
    std::unordered_map<std::uint32_t, std::size_t> firstOf_;  // control point → its first vertex
    std::vector<std::size_t> next_;                           // vertex → the next of the same control point
    std::vector<Attributes> attributes_;
    std::vector<vec3> corners_;
    std::vector<std::uint32_t> places_;
    std::vector<std::uint32_t> triangles_;
};

void flip(std::vector<std::uint32_t>& indices) {
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
        std::swap(indices[i + 1], indices[i + 2]);
}

}  // namespace

std::vector<std::string> GeometryRepairs::sentences() const {
    std::vector<std::string> out;
    if (brokenPolygons > 0) {
        out.push_back(fmt::format("{} polygons name corners that are not there or have fewer than three; left out",
                                  brokenPolygons));
    }
    if (tooManyVertices) out.push_back(fmt::format("meshes beyond {} corners of polygons were left out", kMaxCorners));
    return out;
}

std::vector<dvec3> GeometryReader::controlPoints(int geometry) const {
    const std::vector<double> numbers = objects_[geometry].record->numbersOf("Vertices");
    std::vector<dvec3> points;
    points.reserve(numbers.size() / 3);
    for (std::size_t i = 0; i + 2 < numbers.size(); i += 3)
        points.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
    return points;
}

std::vector<MeshPart> GeometryReader::read(int geometry, const dmat4& meshFromGeometry,
                                           std::span<const std::string> uvSets) {
    const Record& record = *objects_[geometry].record;
    std::vector<dvec3> points = controlPoints(geometry);
    addBlendShapes(objects_, geometry, points);
    const std::vector<double> ends = record.numbersOf("PolygonVertexIndex");
    const Layers layers = layersOf(record);
    std::map<int, PartBuilder> parts;
    std::vector<Corner> polygon;
    std::size_t polygons = 0;
    bool whole = true;
    if (repairs_.tooManyVertices || (corners_ += ends.size()) > kMaxCorners) {
        repairs_.tooManyVertices = true;
        return {};
    }
    for (std::size_t i = 0; i < ends.size(); ++i) {
        const bool last = ends[i] < 0.0;
        const double point = last ? -ends[i] - 1.0 : ends[i];
        whole = whole && point < static_cast<double>(points.size());
        polygon.push_back({i, whole ? static_cast<std::uint32_t>(point) : 0, polygons});
        if (!last) continue;
        if (whole && polygon.size() >= 3) {
            const float named = layers.materials.empty() ? 0.0F : layers.materials.at<1>(polygon.front())[0];
            // A file may hold what is no number.
            const int slot = named >= 0.0F ? static_cast<int>(std::min(named, static_cast<float>(kMaxSlot))) : 0;
            auto part = parts.find(slot);
            if (part == parts.end()) {
                const auto place = static_cast<std::size_t>(slot);
                const std::string set = place < uvSets.size() ? uvSets[place] : std::string{};
                part = parts.emplace(slot, PartBuilder(layers, uvSet(layers, set))).first;
            }
            part->second.add(polygon, points, meshFromGeometry);
        } else if (polygon.size() != 2) {  // two corners: a line, nothing lost
            ++repairs_.brokenPolygons;
        }
        polygon.clear();
        ++polygons;
        whole = true;
    }
    std::vector<MeshPart> out;
    for (auto& [slot, builder] : parts) {
        if (glm::determinant(dmat3(meshFromGeometry)) < 0.0) flip(builder.part.mesh.indices);
        builder.part.slot = slot;
        out.push_back(std::move(builder.part));
    }
    return out;
}

}  // namespace lutka::animation::rig_import::fbx
