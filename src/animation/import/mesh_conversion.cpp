#include "animation/import/mesh_conversion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <optional>
#include <string_view>
#include <unordered_set>
#include <utility>

#include "animation/import/mesh_repair.hpp"
#include "animation/import/name_list.hpp"
#include "animation/import/vertex_bounds.hpp"
#include "animation/import/vertex_weights.hpp"

namespace lutka::animation::rig_import {
namespace {

// Where the vertices of each joint of the skin go: bind frame times offset. All equal unless meshes contradict each
// other about the bind pose of a joint that they share; then each vertex follows its own joints.
void placeJoints(const MeshInstance& instance, std::span<const dmat4> bind, std::span<dmat4> sceneFromMesh) {
    for (const SkinJoint& joint : instance.joints)
        sceneFromMesh[joint.joint] = bind[joint.joint] * joint.jointFromMesh;
}

// Meshes that were bound in another pose than the rest of the figure: a joint has one bind pose, so that what hangs on
// several joints bends a little otherwise there.
class OtherPoses {
  public:
    // Of a mesh that is placed: how far the single joints take its vertices from where all of them together do.
    void add(const SkinnedMesh& mesh, const SourceMesh& source, std::span<const VertexSkin> skins,
             std::span<const dmat4> sceneFromMesh) {
        double farthest = 0.0;
        for (std::size_t v = 0; v < skins.size(); ++v) {
            if (skins[v].weights[1] <= 0.0F) continue;
            const dvec4 point(dvec3(source.positions[v]), 1.0);
            double off = 0.0;
            for (int i = 0; i < kMaxInfluences && skins[v].weights[i] > 0.0F; ++i) {
                const dvec3 alone(sceneFromMesh[skins[v].joints[i]] * point);
                off += static_cast<double>(skins[v].weights[i]) * glm::distance(alone, dvec3(mesh.positions[v]));
            }
            if (std::isfinite(off)) farthest = std::max(farthest, off);
        }
        if (farthest > 0.0) found_.emplace_back(mesh.name, farthest);
    }

    // Whether the joints of a skin place its mesh differently.
    [[nodiscard]] static bool disagree(const MeshInstance& instance, std::span<const dmat4> sceneFromMesh) {
        constexpr double kRounding = 1e-5;
        const dmat4& first = sceneFromMesh[instance.joints.front().joint];
        return std::any_of(instance.joints.begin(), instance.joints.end(), [&](const SkinJoint& joint) {
            const dmat4& other = sceneFromMesh[joint.joint];
            for (int column = 0; column < 4; ++column) {
                const double size = glm::length(first[column]) + glm::length(other[column]);
                if (glm::length(other[column] - first[column]) > kRounding * std::max(size, 1.0)) return true;
            }
            return false;
        });
    }

    [[nodiscard]] std::optional<std::string> sentence(std::span<const SkinnedMesh> meshes) const {
        constexpr double kVisible = 0.002;
        const dvec3 extent = vertexBounds(meshes).size();
        const double size = std::max({extent.x, extent.y, extent.z});
        std::vector<std::string> names;
        std::unordered_set<std::string_view> known;
        double farthest = 0.0;
        for (const auto& [name, off] : found_) {
            if (!(off > kVisible * size)) continue;
            farthest = std::max(farthest, off / size);
            if (known.insert(name).second) names.push_back(name);
        }
        if (names.empty()) return std::nullopt;
        return fmt::format(
            "bound in another pose than the rest of the figure: {}; bends of it may be off by up to "
            "{:.1f} % of the figure's size",
            firstOf(names), 100.0 * farthest);
    }

  private:
    std::vector<std::pair<std::string, double>> found_;  // mesh, distance in the scene
};

// The deforming joint that stray vertices follow: the nearest above the mesh node, else the topmost of the skin.
int fallbackJointOf(const NodeTree& tree, const MeshInstance& instance) {
    std::vector<int> skinned;
    for (const SkinJoint& joint : instance.joints)
        skinned.push_back(joint.joint);
    std::sort(skinned.begin(), skinned.end());
    for (int joint = tree.nodes[instance.node].joint; joint >= 0; joint = tree.jointParents[joint]) {
        if (std::binary_search(skinned.begin(), skinned.end(), joint)) return joint;
    }
    return skinned.front();
}

vec3 unitOrUp(const dvec3& v) {
    const double length = glm::length(v);
    return std::isfinite(length) && length > 1e-20 ? vec3(v / length) : vec3(0, 1, 0);
}

void copyTriangles(const SourceMesh& source, bool mirrored, SkinnedMesh& mesh) {
    mesh.indices = source.indices;
    for (std::size_t i = 0; mirrored && i + 2 < mesh.indices.size(); i += 3)
        std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
}

void copyVertices(const SourceMesh& source, std::span<const VertexSkin> skins, std::span<const dmat4> sceneFromMesh,
                  SkinnedMesh& mesh) {
    const bool hasTangents = !source.tangents.empty() && !source.normals.empty() && !source.uvs.empty();
    const std::size_t count = source.positions.size();
    mesh.positions.reserve(count);
    mesh.normals.reserve(source.normals.size());
    mesh.uvs.reserve(source.uvs.size());
    mesh.tangents.reserve(hasTangents ? count : 0);
    mesh.joints.reserve(count);
    mesh.weights.reserve(count);
    for (std::size_t v = 0; v < count; ++v) {
        const VertexSkin& skin = skins[v];
        dmat4 place(0.0);
        // Strongest first.
        for (int i = 0; i < kMaxInfluences && skin.weights[i] > 0.0F; ++i)
            place += static_cast<double>(skin.weights[i]) * sceneFromMesh[skin.joints[i]];
        mesh.positions.emplace_back(place * dvec4(dvec3(source.positions[v]), 1.0));
        const dmat3 turn(place);
        // The cofactor matrix: the inverse transpose without the division, which a flat frame would not survive.
        const dmat3 normalTurn(glm::cross(turn[1], turn[2]), glm::cross(turn[2], turn[0]),
                               glm::cross(turn[0], turn[1]));
        const double side = glm::determinant(turn) < 0.0 ? -1.0 : 1.0;
        if (!source.normals.empty()) mesh.normals.push_back(unitOrUp(side * (normalTurn * dvec3(source.normals[v]))));
        if (!source.uvs.empty()) {
            const vec2 uv = source.uvs[v];
            mesh.uvs.emplace_back(std::isfinite(uv.x) ? uv.x : 0.0F, std::isfinite(uv.y) ? uv.y : 0.0F);
        }
        if (hasTangents) {
            const vec4& tangent = source.tangents[v];
            const double hand = tangent.w < 0.0F ? -1.0 : 1.0;
            mesh.tangents.emplace_back(unitOrUp(turn * dvec3(tangent)), static_cast<float>(hand * side));
        }
        mesh.joints.push_back(skin.joints);
        mesh.weights.push_back(skin.weights);
    }
}

// White changes nothing.
void copyColors(const SourceMesh& source, SkinnedMesh& mesh) {
    const auto isColor = [](const vec4& color) { return color != vec4(1.0F); };
    if (std::none_of(source.colors.begin(), source.colors.end(), isColor)) return;
    mesh.colors.reserve(source.colors.size());
    for (const vec4& color : source.colors)
        mesh.colors.push_back(glm::clamp(color, 0.0F, 1.0F));
}

// `sceneFromMesh` is scratch, one a joint: only those of the instance are set and used, or thousands of small meshes
// below thousands of joints would take minutes.
SkinnedMesh convertMesh(const NodeTree& tree, const MeshInstance& instance, std::span<const dmat4> bind,
                        std::span<dmat4> sceneFromMesh, WeightRepairs& repairs, OtherPoses& otherPoses) {
    SkinnedMesh mesh;
    mesh.name = instance.mesh->name.empty() ? tree.jointNames[tree.nodes[instance.node].joint] : instance.mesh->name;
    mesh.material = instance.mesh->material;
    mesh.rigid = instance.joints.empty();
    std::vector<VertexSkin> skins;
    int guide = 0;
    if (mesh.rigid) {
        const NodeTree::Node& node = tree.nodes[instance.node];
        guide = node.joint;
        skins.assign(instance.mesh->positions.size(), VertexSkin{{static_cast<std::uint16_t>(guide)}, {1.0F}});
        // A helper below the joint (FBX geometry offsets) adds its own way to the joint's.
        const dmat4& joint = tree.sceneFromJoint(guide);
        const dmat4 way = isInvertible(joint) ? glm::inverse(joint) * node.sceneFromNode : dmat4(1.0);
        sceneFromMesh[guide] = bind[guide] * way;
    } else {
        guide = fallbackJointOf(tree, instance);
        skins = readWeights(instance, guide, repairs);
        placeJoints(instance, bind, sceneFromMesh);
    }
    copyVertices(*instance.mesh, skins, sceneFromMesh, mesh);
    if (!mesh.rigid && OtherPoses::disagree(instance, sceneFromMesh))
        otherPoses.add(mesh, *instance.mesh, skins, sceneFromMesh);
    copyColors(*instance.mesh, mesh);
    copyTriangles(*instance.mesh, glm::determinant(dmat3(sceneFromMesh[guide])) < 0.0, mesh);
    return mesh;
}

}  // namespace

std::vector<SkinnedMesh> convertMeshes(const NodeTree& tree, std::span<const MeshInstance> instances,
                                       std::span<const dmat4> bindSceneFromJoint, std::span<float> skinWeight,
                                       std::vector<std::string>& warnings) {
    std::vector<SkinnedMesh> meshes;
    WeightRepairs repairs;
    MeshRepairs meshRepairs;
    OtherPoses otherPoses;
    std::vector<dmat4> sceneFromMesh(bindSceneFromJoint.size(), dmat4(0.0));
    for (const MeshInstance& instance : instances) {
        SkinnedMesh mesh = convertMesh(tree, instance, bindSceneFromJoint, sceneFromMesh, repairs, otherPoses);
        repairMesh(mesh, meshRepairs);
        if (mesh.indices.empty()) continue;
        for (std::size_t v = 0; v < mesh.joints.size(); ++v) {
            for (int i = 0; i < kMaxInfluences; ++i)
                skinWeight[mesh.joints[v][i]] += mesh.weights[v][i];
        }
        meshes.push_back(std::move(mesh));
    }
    for (std::string& sentence : repairs.sentences())
        warnings.push_back(std::move(sentence));
    for (std::string& sentence : meshRepairs.sentences())
        warnings.push_back(std::move(sentence));
    if (std::optional<std::string> sentence = otherPoses.sentence(meshes)) warnings.push_back(*std::move(sentence));
    return meshes;
}

}  // namespace lutka::animation::rig_import
