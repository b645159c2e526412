#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "animation/import/gltf/accessor.hpp"
#include "animation/import/gltf/gltf_draco.hpp"
#include "animation/import/gltf/gltf_parts.hpp"
#include "animation/import/source_limits.hpp"

namespace lutka::animation::rig_import::gltf {
namespace {

using nlohmann::json;

constexpr std::size_t kMaxInfluenceSets = 4;  // JOINTS_0 … JOINTS_3

enum Mode { kTriangles = 4, kTriangleStrip = 5, kTriangleFan = 6 };

// One set of slots and weights of every vertex. There are four a vertex by the specification; Unity's exporter of skins
// with two writes two.
struct VertexSkins {
    std::size_t width = 4;
    std::vector<std::uint32_t> joints;  // `width` a vertex
    std::vector<float> weights;
};

// A primitive's attributes, in accessors or compressed.
class Attributes {
  public:
    Attributes(GltfFile& file, const json& primitive) : file_(file), primitive_(primitive) {
        const json* block = extensionOf(primitive, "KHR_draco_mesh_compression");
        if (block != nullptr) packed_.emplace(file, *block);
    }

    [[nodiscard]] const std::optional<DracoPrimitive>& packed() const { return packed_; }
    [[nodiscard]] bool has(const std::string& name) const { return accessorOf(name).has_value(); }

    // Nothing where the primitive has no such attribute.
    [[nodiscard]] std::optional<Numbers> numbers(const std::string& name) const {
        const std::optional<int> accessor = accessorOf(name);
        if (!accessor) return std::nullopt;
        const bool normalised = truthOf(file_.element("accessors", *accessor), "normalized", false);
        std::optional<Numbers> compressed = packed_ ? packed_->numbers(name, normalised) : std::nullopt;
        return compressed ? *std::move(compressed) : readNumbers(file_, *accessor);
    }

    // The same, which must have that many components.
    [[nodiscard]] std::optional<Numbers> numbers(const std::string& name, std::size_t width) const {
        std::optional<Numbers> found = numbers(name);
        if (found && found->width != width)
            throw Damage{fmt::format("{} have {} components instead of {}", name, found->width, width)};
        return found;
    }

    [[nodiscard]] std::vector<std::uint32_t> integers(const std::string& name, std::size_t width) const {
        std::optional<std::vector<std::uint32_t>> compressed = packed_ ? packed_->integers(name) : std::nullopt;
        return compressed ? *std::move(compressed) : readIntegers(file_, *accessorOf(name), width, name.c_str());
    }

  private:
    [[nodiscard]] std::optional<int> accessorOf(const std::string& name) const {
        const json* attributes = member(primitive_, "attributes");
        return attributes == nullptr ? std::nullopt : indexOf(*attributes, name.c_str(), file_.count("accessors"));
    }

    GltfFile& file_;
    const json& primitive_;
    std::optional<DracoPrimitive> packed_;
};

std::vector<std::uint32_t> trianglesOf(const std::vector<std::uint32_t>& corners, std::size_t mode) {
    if (mode == kTriangles) return {corners.begin(), corners.end() - static_cast<std::ptrdiff_t>(corners.size() % 3)};
    std::vector<std::uint32_t> triangles;
    for (std::size_t i = 2; i < corners.size(); ++i) {
        const std::uint32_t first = mode == kTriangleFan ? corners[0] : corners[i - 2];
        const std::uint32_t second = corners[i - 1];
        // Every other triangle of a strip runs the other way round.
        const bool turned = mode == kTriangleStrip && i % 2 == 1;
        triangles.insert(triangles.end(), {turned ? second : first, turned ? first : second, corners[i]});
    }
    return triangles;
}

// The largest number of an index's type ends a strip or fan: glTF 2.0 forbids it, but graphics libraries have it so.
std::uint32_t restartOf(const json& accessor) {
    constexpr std::size_t kByte = 5121;
    constexpr std::size_t kShort = 5123;
    const std::size_t component = sizeOf(accessor, "componentType", 0);
    return component == kByte ? 0xFFU : component == kShort ? 0xFFFFU : 0xFFFFFFFFU;
}

std::vector<std::uint32_t> trianglesOfRuns(const std::vector<std::uint32_t>& corners, std::size_t mode,
                                           std::size_t vertices, std::uint32_t restart) {
    const auto isRestart = [&](std::uint32_t index) { return index == restart && index >= vertices; };
    std::vector<std::uint32_t> triangles;
    for (auto start = corners.begin(); start != corners.end();) {
        const auto end = std::find_if(start, corners.end(), isRestart);
        const std::vector<std::uint32_t> run = trianglesOf({start, end}, mode);
        triangles.insert(triangles.end(), run.begin(), run.end());
        start = end == corners.end() ? end : end + 1;
    }
    return triangles;
}

void readIndices(GltfFile& file, const json& primitive, std::size_t mode, SourceMesh& mesh) {
    std::vector<std::uint32_t> corners;
    std::uint32_t restart = 0xFFFFFFFFU;
    if (const std::optional<int> indices = indexOf(primitive, "indices", file.count("accessors"))) {
        corners = readIntegers(file, *indices, 1, "indices");
        restart = restartOf(file.element("accessors", *indices));
    } else {
        corners.resize(mesh.positions.size());
        for (std::size_t i = 0; i < corners.size(); ++i)
            corners[i] = static_cast<std::uint32_t>(i);
    }
    if (mode == kTriangles && corners.size() % 3 != 0) file.leaveOut("corners beyond the last triangle of a mesh");
    const std::size_t vertices = mesh.positions.size();
    mesh.indices = mode == kTriangles ? trianglesOf(corners, mode) : trianglesOfRuns(corners, mode, vertices, restart);
    if (std::any_of(mesh.indices.begin(), mesh.indices.end(), [&](std::uint32_t i) { return i >= vertices; }))
        throw Damage{fmt::format("mesh '{}': a triangle names a vertex that is not there", mesh.name)};
}

template <class T, class Make>
void readPerVertex(const Attributes& attributes, const std::string& name, std::size_t width, std::size_t count,
                   std::vector<T>& out, const Make& make) {
    const std::optional<Numbers> numbers = attributes.numbers(name, width);
    if (!numbers) return;
    if (numbers->count != count) throw Damage{fmt::format("{} has another count than POSITION", name)};
    out.reserve(count);
    for (std::size_t v = 0; v < count; ++v)
        out.push_back(make(*numbers, v));
}

void readColors(const Attributes& attributes, SourceMesh& mesh) {
    const std::optional<Numbers> numbers = attributes.numbers("COLOR_0");
    if (!numbers || numbers->count != mesh.positions.size() || numbers->width < 3) return;
    for (std::size_t v = 0; v < numbers->count; ++v)
        mesh.colors.emplace_back(numbers->vector3(v), numbers->width == 4 ? numbers->at(v, 3) : 1.0F);
}

void readUvs(GltfFile& file, const Attributes& attributes, SourceMesh& mesh) {
    UvUse use;
    if (mesh.material >= 0) use = uvUseOf(file, mesh.material);
    if (!attributes.has(fmt::format("TEXCOORD_{}", use.set))) use.set = 0;
    readPerVertex(
        attributes, fmt::format("TEXCOORD_{}", use.set), 2, mesh.positions.size(), mesh.uvs,
        [&](const Numbers& n, std::size_t v) { return vec2(use.transform * vec3(n.at(v, 0), n.at(v, 1), 1)); });
    constexpr float kBeyond = 0.05F;  // less is the bleeding of an edge
    const auto isBeyond = [](const vec2& uv) {
        return std::min(uv.x, uv.y) < -kBeyond || std::max(uv.x, uv.y) > 1.0F + kBeyond;
    };
    if (!use.repeats && std::any_of(mesh.uvs.begin(), mesh.uvs.end(), isBeyond))
        file.leaveOut("mirroring of pictures and holding them at their edges (beyond it they repeat)");
}

std::vector<VertexSkins> readSets(const Attributes& attributes, std::size_t vertices) {
    std::vector<VertexSkins> sets;
    for (std::size_t set = 0; set < kMaxInfluenceSets; ++set) {
        const std::string joints = fmt::format("JOINTS_{}", set);
        const std::string weights = fmt::format("WEIGHTS_{}", set);
        if (!attributes.has(joints) || !attributes.has(weights)) break;
        VertexSkins skins;
        Numbers numbers = *attributes.numbers(weights);
        skins.width = std::min<std::size_t>(numbers.width, 4);
        skins.weights = std::move(numbers.values);
        skins.joints = attributes.integers(joints, numbers.width);
        if (numbers.width > 4 || numbers.count != vertices || skins.joints.size() != skins.weights.size())
            throw Damage{"JOINTS or WEIGHTS have another count than POSITION"};
        sets.push_back(std::move(skins));
    }
    return sets;
}

void takeInfluences(const std::vector<VertexSkins>& sets, SourceMesh& mesh) {
    if (sets.empty()) return;
    mesh.influenceStart.reserve(mesh.positions.size() + 1);
    mesh.influenceStart.push_back(0);
    mesh.influences.reserve(4 * mesh.positions.size());
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        for (const VertexSkins& set : sets) {
            for (std::size_t i = set.width * v; i < set.width * (v + 1); ++i) {
                if (set.weights[i] != 0.0F) mesh.influences.push_back({set.joints[i], set.weights[i]});
            }
        }
        mesh.influenceStart.push_back(static_cast<std::uint32_t>(mesh.influences.size()));
    }
}

// Moves the vertices by the morph targets that are on from the start.
void applyMorphs(GltfFile& file, const json& primitive, const std::vector<double>& weights, SourceMesh& mesh) {
    const json* targets = arrayOf(primitive, "targets");
    if (targets == nullptr) return;
    for (std::size_t t = 0; t < targets->size() && t < weights.size(); ++t) {
        const auto weight = static_cast<float>(weights[t]);
        if (weight == 0.0F) continue;
        for (const char* name : {"POSITION", "NORMAL"}) {
            const std::optional<int> accessor = indexOf((*targets)[t], name, file.count("accessors"));
            std::vector<vec3>& moved = name[0] == 'P' ? mesh.positions : mesh.normals;
            if (!accessor || moved.empty()) continue;
            const Numbers offsets = readNumbers(file, *accessor, 3, "morph targets");
            if (offsets.count != moved.size()) throw Damage{"a morph target has another count than its mesh"};
            for (std::size_t v = 0; v < moved.size(); ++v)
                moved[v] += weight * offsets.vector3(v);
        }
    }
}

std::vector<double> weightsOf(const json& object) {
    std::vector<double> weights;
    const json* array = member(object, "weights");
    if (array == nullptr || !array->is_array()) return weights;
    for (const json& weight : *array)
        weights.push_back(weight.is_number() && std::isfinite(weight.get<double>()) ? weight.get<double>() : 0.0);
    return weights;
}

std::optional<SourceMesh> readPrimitive(GltfFile& file, const json& primitive, const std::string& name,
                                        const std::vector<double>& morphs) {
    const std::size_t mode = sizeOf(primitive, "mode", kTriangles);
    if (mode != kTriangles && mode != kTriangleStrip && mode != kTriangleFan) {
        file.leaveOut(mode < kTriangles ? "points and lines" : "meshes of a mode that glTF does not know");
        return std::nullopt;
    }
    SourceMesh mesh;
    mesh.name = name;
    mesh.material = indexOf(primitive, "material", file.count("materials")).value_or(-1);
    const Attributes attributes(file, primitive);
    const std::optional<Numbers> positions = attributes.numbers("POSITION", 3);
    if (!positions) {
        file.leaveOut("meshes without positions");
        return std::nullopt;
    }
    const std::size_t count = positions->count;
    const auto three = [](const Numbers& n, std::size_t v) { return n.vector3(v); };
    mesh.positions.reserve(count);
    for (std::size_t v = 0; v < count; ++v)
        mesh.positions.push_back(positions->vector3(v));
    readPerVertex(attributes, "NORMAL", 3, count, mesh.normals, three);
    readPerVertex(attributes, "TANGENT", 4, count, mesh.tangents,
                  [](const Numbers& n, std::size_t v) { return vec4(n.vector3(v), n.at(v, 3)); });
    readUvs(file, attributes, mesh);
    readColors(attributes, mesh);
    const std::vector<VertexSkins> sets = readSets(attributes, count);
    if (attributes.packed()) {
        mesh.indices = attributes.packed()->triangles();
    } else {
        readIndices(file, primitive, mode, mesh);
    }
    applyMorphs(file, primitive, morphs, mesh);
    takeInfluences(sets, mesh);
    if (mesh.normals.empty()) mesh.tangents.clear();
    return mesh;
}

glm::dmat4 matrixAt(const Numbers& numbers, std::size_t element) {
    glm::dmat4 matrix(1.0);
    for (int i = 0; i < 16; ++i)
        matrix[i / 4][i % 4] = static_cast<double>(numbers.at(element, static_cast<std::size_t>(i)));
    return matrix;
}

glm::dmat4 sceneFromNode(const SourceScene& scene, int node) {
    glm::dmat4 frame(1.0);
    for (int at = node; at >= 0; at = scene.nodes[at].parent)
        frame = scene.nodes[at].parentFromNode * frame;
    return frame;
}

SourceSkin readSkin(GltfFile& file, const json& source, const NodeMap& nodes, SourceScene& out) {
    SourceSkin skin;
    const json* joints = arrayOf(source, "joints");
    if (joints == nullptr) throw Damage{"a skin has no joints"};
    Numbers matrices;
    const std::optional<int> accessor = indexOf(source, "inverseBindMatrices", file.count("accessors"));
    if (accessor) matrices = readNumbers(file, *accessor, 16, "inverse bind matrices");
    if (accessor && matrices.count < joints->size())
        out.warnings.push_back(
            fmt::format("a skin has {} joints and {} inverse bind matrices: the last joints are bound where they stand",
                        joints->size(), matrices.count));
    skin.verticesAreInJoints = !accessor;
    for (std::size_t i = 0; i < joints->size(); ++i) {
        const json& joint = (*joints)[i];
        if (!joint.is_number_unsigned() || joint.get<std::size_t>() >= nodes.size())
            throw Damage{fmt::format("a skin names node {}, of which there are {}", joint.dump(), nodes.size())};
        const int node = nodes[joint.get<std::size_t>()];
        if (node < 0) throw Damage{fmt::format("a skin names node {}, which is not in the scene", joint.dump())};
        if (accessor && i >= matrices.count) {
            skin.joints.push_back({node, glm::inverse(sceneFromNode(out, node))});
        } else {
            skin.joints.push_back({node, accessor ? matrixAt(matrices, i) : glm::dmat4(1.0)});
        }
    }
    return skin;
}

// The mesh without the influences that name no joint of a skin; nothing where all do. A copy: another skin may have
// those joints.
std::optional<SourceMesh> withoutStrayInfluences(std::size_t slots, const SourceMesh& mesh, GltfFile& file) {
    const auto isStray = [&](const SourceMesh::Influence& influence) { return influence.slot >= slots; };
    if (std::none_of(mesh.influences.begin(), mesh.influences.end(), isStray)) return std::nullopt;
    file.leaveOut(fmt::format("weights of mesh '{}' for joints that its skin does not have", mesh.name));
    SourceMesh kept = mesh;
    for (SourceMesh::Influence& influence : kept.influences)
        if (isStray(influence)) influence = {0, 0.0F};
    return kept;
}

// Whether the file hides a scene's nodes, each by itself or by one above it, and no clip shows them.
std::vector<bool> hiddenNodes(const GltfFile& file, const NodeMap& nodes, const std::vector<int>& order,
                              const SourceScene& scene) {
    std::vector<bool> hidden(scene.nodes.size(), false);
    const std::vector<bool> switched = nodesOfPointers(file, "extensions/KHR_node_visibility/visible");
    for (const int index : order) {
        const auto node = static_cast<std::size_t>(nodes[index]);
        const json* block = extensionOf(file.element("nodes", index), "KHR_node_visibility");
        const int above = scene.nodes[node].parent;
        hidden[node] = (block != nullptr && !switched[index] && !truthOf(*block, "visible", true)) ||
                       (above >= 0 && hidden[static_cast<std::size_t>(above)]);
    }
    return hidden;
}

std::vector<int> inSceneOrder(const NodeMap& nodes) {
    std::vector<int> order;
    for (int index = 0; index < static_cast<int>(nodes.size()); ++index) {
        if (nodes[index] >= 0) order.push_back(index);
    }
    std::sort(order.begin(), order.end(), [&](int a, int b) { return nodes[a] < nodes[b]; });
    return order;
}

}  // namespace

void addMeshes(GltfFile& file, const NodeMap& nodes, SourceScene& out) {
    const std::size_t skinCount = file.count("skins");
    std::map<int, int> skinOf;
    // The primitives of a mesh with the morphs of a node; nodes mostly share them.
    std::map<std::pair<int, std::vector<double>>, std::vector<int>> known;
    std::size_t vertices = 0;
    const auto add = [&](SourceMesh mesh) {
        vertices += mesh.positions.size();
        if (vertices > kMaxVertices || out.meshes.size() >= kMaxMeshes)
            throw Damage{fmt::format("has more than {} vertices or {} meshes", kMaxVertices, kMaxMeshes),
                         "export only the character"};
        out.meshes.push_back(std::move(mesh));
        return static_cast<int>(out.meshes.size()) - 1;
    };
    const std::vector<int> order = inSceneOrder(nodes);
    const std::vector<bool> hidden = hiddenNodes(file, nodes, order, out);
    for (const int index : order) {
        const json& node = file.element("nodes", index);
        const auto named = [&](const char* key, std::size_t count) {
            return within("nodes", index, [&] { return indexOf(node, key, count); });
        };
        const std::optional<int> meshIndex = named("mesh", file.count("meshes"));
        if (!meshIndex) continue;
        std::optional<int> skin = named("skin", skinCount);
        if (skin && countOf(file.element("skins", *skin), "joints") == 0) {
            file.leaveOut("skins without joints");
            skin.reset();
        }
        if (skin && skinOf.count(*skin) == 0) {
            skinOf[*skin] = static_cast<int>(out.skins.size());
            out.skins.push_back(
                within("skins", *skin, [&] { return readSkin(file, file.element("skins", *skin), nodes, out); }));
        }
        const json& source = file.element("meshes", *meshIndex);
        std::vector<double> morphs = weightsOf(node);
        if (morphs.empty()) morphs = weightsOf(source);
        const auto [found, isNew] = known.try_emplace({*meshIndex, morphs});
        const json* primitives = arrayOf(source, "primitives");
        for (std::size_t i = 0; isNew && primitives != nullptr && i < primitives->size(); ++i) {
            std::optional<SourceMesh> mesh = within("meshes", *meshIndex, [&] {
                return readPrimitive(file, (*primitives)[i], textOf(source, "name"), morphs);
            });
            if (!mesh) continue;
            found->second.push_back(add(*std::move(mesh)));
        }
        for (const int mesh : found->second) {
            const bool bound = skin && !out.meshes[mesh].influences.empty();
            int placed = mesh;
            if (skin && !bound)
                file.leaveOut(fmt::format("the skin of mesh '{}', for its vertices have no joints and weights",
                                          out.meshes[mesh].name));
            if (bound) {
                const std::size_t slots = out.skins[skinOf[*skin]].joints.size();
                std::optional<SourceMesh> kept = withoutStrayInfluences(slots, out.meshes[mesh], file);
                if (kept) placed = add(*std::move(kept));
            }
            out.instances.push_back({placed, nodes[index], bound ? skinOf[*skin] : -1, hidden[nodes[index]]});
        }
    }
}

}  // namespace lutka::animation::rig_import::gltf
