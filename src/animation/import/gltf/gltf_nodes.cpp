#include <fmt/format.h>

#include <glm/gtc/matrix_transform.hpp>

#include "animation/import/gltf/gltf_parts.hpp"
#include "animation/import/source_limits.hpp"

namespace lutka::animation::rig_import::gltf {
namespace {

using nlohmann::json;

// So many numbers of a node; what is something else is told.
std::optional<std::vector<double>> partOf(GltfFile& file, const json& node, const char* key, std::size_t count) {
    std::optional<std::vector<double>> numbers = numbersOf(node, key, count);
    if (!numbers && member(node, key) != nullptr)
        file.leaveOut(fmt::format("the {} of nodes that have no {} finite numbers there", key, count));
    return numbers;
}

glm::dvec3 vectorOf(GltfFile& file, const json& node, const char* key, const glm::dvec3& otherwise) {
    const std::optional<std::vector<double>> numbers = partOf(file, node, key, 3);
    return numbers ? glm::dvec3((*numbers)[0], (*numbers)[1], (*numbers)[2]) : otherwise;
}

SourceTrs partsOf(GltfFile& file, const json& node) {
    SourceTrs parts;
    parts.translation = vectorOf(file, node, "translation", glm::dvec3(0.0));
    parts.scale = vectorOf(file, node, "scale", glm::dvec3(1.0));
    if (const std::optional<std::vector<double>> q = partOf(file, node, "rotation", 4)) {
        const glm::dquat rotation((*q)[3], (*q)[0], (*q)[1], (*q)[2]);
        const bool turns = glm::length(rotation) > 1e-9;
        if (turns) parts.rotation = glm::normalize(rotation);
        if (!turns) file.leaveOut("the rotation of nodes that have four zeros there");
    }
    return parts;
}

glm::dmat4 matrixOf(const SourceTrs& parts) {
    return glm::translate(glm::dmat4(1.0), parts.translation) * glm::mat4_cast(parts.rotation) *
           glm::scale(glm::dmat4(1.0), parts.scale);
}

SourceNode nodeOf(GltfFile& file, const json& source, int index, int parent) {
    SourceNode node;
    node.name = textOf(source, "name");
    if (node.name.empty()) node.name = fmt::format("nodes[{}]", index);
    node.parent = parent;
    if (const std::optional<std::vector<double>> m = partOf(file, source, "matrix", 16)) {
        for (const char* part : {"translation", "rotation", "scale"}) {
            if (member(source, part) != nullptr)
                file.leaveOut("translation, rotation and scale of nodes that have a matrix, too");
        }
        for (int i = 0; i < 16; ++i)
            node.parentFromNode[i / 4][i % 4] = (*m)[static_cast<std::size_t>(i)];
    } else {
        node.trs = partsOf(file, source);
        node.parentFromNode = matrixOf(*node.trs);
    }
    return node;
}

// The node's part of KHR_physics_rigid_bodies; an empty object where it has none.
json physicsOf(const json& node) {
    const auto extensions = node.find("extensions");
    if (extensions == node.end() || !extensions->is_object()) return json::object();
    const auto physics = extensions->find("KHR_physics_rigid_bodies");
    return physics != extensions->end() && physics->is_object() ? *physics : json::object();
}

// The frames and colliders of KHR_physics_rigid_bodies: leaves that say where a shape or a joint of a body is, not
// what moves the skin. As joints they would look like fingers.
std::vector<bool> physicsFrames(const GltfFile& file) {
    std::vector<bool> frames(file.count("nodes"), false);
    const int count = static_cast<int>(frames.size());
    for (int i = 0; i < count; ++i) {
        const json physics = physicsOf(file.element("nodes", i));
        if (physics.contains("collider") || physics.contains("joint")) frames[i] = true;
        const json joint = physics.value("joint", json());
        const json other = joint.is_object() ? joint.value("connectedNode", json()) : json();
        if (other.is_number_unsigned() && other.get<std::size_t>() < frames.size())
            frames[other.get<std::size_t>()] = true;
    }
    for (int i = 0; i < count; ++i) {
        const json& node = file.element("nodes", i);
        const bool moves = physicsOf(node).contains("motion");
        if (moves || node.contains("mesh") || node.contains("children") || node.contains("camera")) frames[i] = false;
    }
    for (int skin = 0; skin < static_cast<int>(file.count("skins")); ++skin) {
        const auto joints =
            within("skins", skin, [&] { return indicesOf(file.element("skins", skin), "joints", frames.size()); });
        for (const int joint : joints)
            frames[joint] = false;
    }
    return frames;
}

[[noreturn]] void refuse(const Error& error) {
    throw Damage{error.message, error.mend};
}

}  // namespace

NodeMap addNodes(GltfFile& file, SourceScene& out) {
    struct Pending {
        int node;
        int parent;
        int depth;
    };
    const std::size_t count = file.count("nodes");
    const std::vector<int> roots = rootsOf(file, out.warnings);
    const std::vector<bool> leftOut = physicsFrames(file);
    NodeMap map(count, -1);
    std::vector<Pending> pending;
    int parent = -1;
    if (roots.size() != 1) {  // a skeleton has one root
        SourceNode root;
        root.name = "ROOT";
        out.nodes.push_back(root);
        parent = 0;
    }
    for (auto root = roots.rbegin(); root != roots.rend(); ++root)
        pending.push_back({*root, parent, 0});
    while (!pending.empty()) {
        const Pending next = pending.back();
        pending.pop_back();
        if (map[next.node] >= 0) {
            throw Damage{
                fmt::format("node {} hangs below two parents (or below itself); glTF 2.0 allows one", next.node),
                "export it again with a node of its own for each place"};
        }
        if (out.nodes.size() >= kMaxNodes) refuse(tooManyNodes(""));
        if (next.depth > kMaxDepth) refuse(nestedTooDeep(""));
        const json& source = file.element("nodes", next.node);
        map[next.node] = static_cast<int>(out.nodes.size());
        out.nodes.push_back(nodeOf(file, source, next.node, next.parent));
        const std::vector<int> children = childrenOf(file, next.node);
        for (auto child = children.rbegin(); child != children.rend(); ++child) {
            if (!leftOut[*child]) pending.push_back({*child, map[next.node], next.depth + 1});
        }
    }
    return map;
}

}  // namespace lutka::animation::rig_import::gltf
