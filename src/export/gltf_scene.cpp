#include "export/gltf_scene.hpp"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <map>

namespace lutka::exporting {
namespace {

using nlohmann::json;

constexpr std::size_t kMostNodes = 65535;  // as importing has it
constexpr int kDeepest = 1000;

struct LocalFrame {
    RigidTransform frame;
    float scale = 1.0F;
};

LocalFrame localFrame(const json& node) {
    if (const std::vector<float> m = numbersIn(node, "matrix", 16); !m.empty()) {
        mat3 axes;
        for (int c = 0; c < 3; ++c)
            axes[c] = vec3(m[4 * c], m[4 * c + 1], m[4 * c + 2]);
        const vec3 lengths(glm::length(axes[0]), glm::length(axes[1]), glm::length(axes[2]));
        if (lengths.x < 1e-9F || lengths.y < 1e-9F || lengths.z < 1e-9F) return {};
        for (int c = 0; c < 3; ++c)
            axes[c] /= lengths[c];
        return {{glm::normalize(glm::quat_cast(axes)), vec3(m[12], m[13], m[14])},
                (lengths.x + lengths.y + lengths.z) / 3.0F};
    }
    LocalFrame local;
    if (const auto q = numbersIn(node, "rotation", 4); !q.empty()) {
        const quat rotation(q[3], q[0], q[1], q[2]);
        if (glm::length(rotation) > 1e-6F) local.frame.rotation = glm::normalize(rotation);
    }
    if (const auto t = numbersIn(node, "translation", 3); !t.empty()) local.frame.translation = vec3(t[0], t[1], t[2]);
    if (const auto s = numbersIn(node, "scale", 3); !s.empty())
        local.scale = (std::abs(s[0]) + std::abs(s[1]) + std::abs(s[2])) / 3.0F;
    return local;
}

}  // namespace

const json* memberOf(const json& object, const char* key) {
    if (!object.is_object()) return nullptr;
    const auto found = object.find(key);
    return found == object.end() ? nullptr : &*found;
}

const json* itemOf(const json& object, const char* array, std::optional<int> index) {
    const json* items = memberOf(object, array);
    if (items == nullptr || !items->is_array() || !index || *index < 0) return nullptr;
    return static_cast<std::size_t>(*index) < items->size() ? &(*items)[static_cast<std::size_t>(*index)] : nullptr;
}

std::optional<int> indexIn(const json& object, const char* key) {
    const json* value = memberOf(object, key);
    if (value == nullptr || !value->is_number_unsigned() || value->get<std::uint64_t>() > kMostNodes)
        return std::nullopt;
    return value->get<int>();
}

std::optional<float> numberIn(const json& object, const char* key) {
    const json* value = memberOf(object, key);
    if (value == nullptr || !value->is_number()) return std::nullopt;
    const auto number = value->get<float>();
    return std::isfinite(number) ? std::optional<float>(number) : std::nullopt;
}

std::vector<float> numbersIn(const json& object, const char* key, std::size_t count) {
    const json* array = memberOf(object, key);
    if (array == nullptr || !array->is_array() || array->size() != count) return {};
    std::vector<float> numbers;
    for (const json& item : *array) {
        if (!item.is_number() || !std::isfinite(item.get<float>())) return {};
        numbers.push_back(item.get<float>());
    }
    return numbers;
}

GltfScene::GltfScene(const json& document) : document_(document) {
    const json* nodes = memberOf(document, "nodes");
    if (nodes == nullptr || !nodes->is_array() || nodes->size() > kMostNodes)
        throw Unusable{"the file has no nodes, or too many"};
    nodes_.resize(nodes->size());
    placed_.assign(nodes->size(), false);
    setParents();
    for (std::size_t i = 0; i < nodes_.size(); ++i)
        place(i, 0);
}

void GltfScene::setParents() {
    const json& nodes = document_["nodes"];
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        const json* name = memberOf(nodes[i], "name");
        nodes_[i].name = name != nullptr && name->is_string() ? name->get<std::string>() : "";
        if (nodes_[i].name.empty()) nodes_[i].name = fmt::format("nodes[{}]", i);
    }
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        const json* children = memberOf(nodes[i], "children");
        if (children == nullptr || !children->is_array()) continue;
        std::map<std::string, int> namesakes;
        for (const json& child : *children) {
            const std::size_t at = child.is_number_unsigned() ? child.get<std::size_t>() : nodes_.size();
            if (at >= nodes_.size() || nodes_[at].parent >= 0) throw Unusable{"the nodes do not make a tree"};
            nodes_[at].parent = static_cast<int>(i);
            const int count = ++namesakes[nodes_[at].name];
            nodes_[at].step = count > 1 ? fmt::format("{}#{}", nodes_[at].name, count) : nodes_[at].name;
        }
    }
}

void GltfScene::place(std::size_t index, int depth) {
    if (placed_[index]) return;
    if (depth > kDeepest) throw Unusable{"the nodes do not make a tree"};
    Node& node = nodes_[index];
    const LocalFrame local = localFrame(document_["nodes"][index]);
    if (node.parent < 0) {
        node.sceneFromNode = local.frame;
        node.scale = local.scale;
        node.step = node.name;
    } else {
        place(static_cast<std::size_t>(node.parent), depth + 1);
        const Node& parent = nodes_[node.parent];
        node.sceneFromNode =
            parent.sceneFromNode * RigidTransform{local.frame.rotation, local.frame.translation * parent.scale};
        node.sceneFromNode.rotation = glm::normalize(node.sceneFromNode.rotation);
        node.scale = parent.scale * local.scale;
    }
    placed_[index] = true;
}

std::string GltfScene::pathOf(std::size_t node) const {
    std::string path = nodes_[node].step;
    for (int above = nodes_[node].parent; above >= 0; above = nodes_[above].parent)
        path.insert(0, nodes_[above].step + "/");
    return path;
}

const json* GltfScene::extension(std::size_t node, const char* name) const {
    const json* extensions = memberOf(document_["nodes"][node], "extensions");
    return extensions == nullptr ? nullptr : memberOf(*extensions, name);
}

}  // namespace lutka::exporting
