#include "animation/import/assimp/collada_bind_shape.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "animation/import/affine.hpp"
#include "animation/import/assimp/collada_text.hpp"

namespace lutka::animation::rig_import {
namespace {

bool isByBlender(std::string_view document) {
    constexpr std::string_view kTool = "<authoring_tool>";
    const std::size_t tool = document.find(kTool);
    return tool != std::string_view::npos && document.substr(tool + kTool.size()).starts_with("Blender");
}

// Without the topmost node, which Assimp gives the document's axis and unit.
dmat4 sceneFromParent(const SourceScene& scene, int node) {
    dmat4 place(1.0);
    for (int at = scene.nodes[node].parent; at >= 0 && scene.nodes[at].parent >= 0; at = scene.nodes[at].parent)
        place = scene.nodes[at].parentFromNode * place;
    return place;
}

// Nothing where the text is no sixteen numbers.
std::optional<dmat4> matrixIn(std::string_view text) {
    constexpr std::string_view kBlanks = " \t\r\n";
    dmat4 matrix(1.0);
    for (int place = 0; place < 16; ++place) {
        text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
        if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);  // which from_chars refuses
        double number = 0.0;
        const auto [next, error] = std::from_chars(text.data(), text.data() + text.size(), number);
        if (error != std::errc()) return std::nullopt;
        text.remove_prefix(static_cast<std::size_t>(next - text.data()));
        matrix[place % 4][place / 4] = number;
    }
    return matrix;
}

// The bind shape matrices of the skins by the nodes that show them. A node's own matrix is no such thing: from 2.8 on
// Blender writes none for what hangs on an armature. Where an id is missing, nothing is linked.
std::map<std::string, dmat4> bindShapesByNode(const ColladaDocument& document) {
    std::map<std::string, dmat4> ofController;
    std::string controller;
    for (const ColladaTag& tag : document.tags) {
        if (tag.opens("controller")) controller = colladaAttribute(tag.text, "id");
        if (!tag.opens("bind_shape_matrix") || controller.empty()) continue;
        const std::string_view text = document.text;
        const std::size_t end = std::min(text.find('<', tag.end), text.size());
        if (const auto matrix = matrixIn(text.substr(tag.end, end - tag.end))) ofController[controller] = *matrix;
    }
    std::map<std::string, dmat4> ofNode;
    std::vector<std::string> nodes;
    for (const ColladaTag& tag : document.tags) {
        if (tag.opens("node") && !tag.isEmpty()) nodes.emplace_back(colladaAttribute(tag.text, "id"));
        if (tag.closes("node") && !nodes.empty()) nodes.pop_back();
        if (!tag.opens("instance_controller") || nodes.empty() || nodes.back().empty()) continue;
        const auto found = ofController.find(tag.target("url"));
        if (found != ofController.end()) ofNode.emplace(nodes.back(), found->second);
    }
    return ofNode;
}

// How far vertices lie from the joints that move them where the mesh stands at `sceneFromMesh` when bound: a sum, in
// the mesh's own unit.
double distanceToJoints(const SourceMesh& mesh, const SourceSkin& skin, const dmat4& sceneFromMesh) {
    constexpr std::size_t kVertices = 2000;
    double sum = 0.0;
    const std::size_t stride = mesh.positions.size() / kVertices + 1;
    for (std::size_t vertex = 0; vertex < mesh.positions.size(); vertex += stride) {
        const dvec3 place(sceneFromMesh * dvec4(dvec3(mesh.positions[vertex]), 1.0));
        for (std::size_t i = mesh.influenceStart[vertex]; i < mesh.influenceStart[vertex + 1]; ++i) {
            const dmat4 sceneFromJoint = glm::inverse(skin.joints[mesh.influences[i].slot].jointFromMesh);
            sum += static_cast<double>(mesh.influences[i].weight) * glm::distance(place, dvec3(sceneFromJoint[3]));
        }
    }
    return sum / meanScale(sceneFromMesh);
}

}  // namespace

void completeBindShapes(const ColladaDocument& document, SourceScene& scene) {
    constexpr double kFarther = 1.25;  // old versions wrote what Collada asks: there it would be far off
    if (!isByBlender(document.text)) return;
    const std::map<std::string, dmat4> bindShapes = bindShapesByNode(document);
    for (const SourceInstance& instance : scene.instances) {
        if (instance.skin < 0) continue;
        const SourceMesh& mesh = scene.meshes[instance.mesh];
        SourceSkin& skin = scene.skins[instance.skin];
        const dmat4 parent = sceneFromParent(scene, instance.node);
        const auto shape = bindShapes.find(scene.nodes[instance.node].name);
        const dmat4& written = shape != bindShapes.end() ? shape->second : scene.nodes[instance.node].parentFromNode;
        const bool solvable = isInvertible(parent) && isInvertible(written) &&
                              std::all_of(skin.joints.begin(), skin.joints.end(), [](const SourceSkin::Joint& joint) {
                                  return isInvertible(joint.jointFromMesh);
                              });
        if (!solvable || mesh.influenceStart.empty()) continue;
        // The inverse bind matrices hold the written matrix already; the mesh lies in the space before it.
        const dmat4 meant = glm::inverse(written) * parent * written;
        if (distanceToJoints(mesh, skin, meant) > kFarther * distanceToJoints(mesh, skin, dmat4(1.0))) continue;
        for (SourceSkin::Joint& joint : skin.joints)
            joint.jointFromMesh = joint.jointFromMesh * meant;
    }
}

}  // namespace lutka::animation::rig_import
