#include "animation/import/assimp/mesh_instances.hpp"

#include <fmt/format.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <set>
#include <tuple>

#include "animation/import/assimp/convert.hpp"
#include "animation/import/name_list.hpp"
#include "animation/import/srgb.hpp"

namespace lutka::animation::rig_import {
namespace {

bool isBoneName(const std::set<std::string>& names, const aiNode* node) {
    return node != nullptr && names.count(node->mName.C_Str()) > 0;
}

int skinnedNeighbours(const std::set<std::string>& names, const aiNode& node) {
    int count = isBoneName(names, node.mParent) ? 1 : 0;
    for (unsigned child = 0; child < node.mNumChildren; ++child)
        count += isBoneName(names, node.mChildren[child]) ? 1 : 0;
    return count;
}

// Nodes may share a name (a mesh node often has that of the joint it follows). The joint is the one without meshes,
// with skinned neighbours, whose node stands nearest to where the skin says.
int resolveBone(const SceneNodes& nodes, const aiBone& bone, const dmat4& sceneFromMesh,
                const std::set<std::string>& boneNames, const std::set<int>& taken) {
    const dvec3 expected(sceneFromMesh * glm::inverse(fromAssimp(bone.mOffsetMatrix))[3]);
    std::tuple<bool, bool, int, double> best{true, true, 0, 0.0};
    int found = -1;
    for (const int candidate : nodes.named(bone.mName.C_Str())) {
        const aiNode& source = *nodes.sources[candidate];
        const std::tuple<bool, bool, int, double> rank{
            taken.count(candidate) > 0, source.mNumMeshes > 0, -skinnedNeighbours(boneNames, source),
            glm::distance(expected, dvec3(nodes.sceneFromNode[candidate][3]))};
        if (found < 0 || rank < best) {
            best = rank;
            found = candidate;
        }
    }
    return found;
}

struct VertexBone {
    std::uint32_t slot;
    float weight;
};

// The skin of a mesh, and which slot moves which vertex how much.
SourceSkin readSkin(const aiMesh& mesh, const SceneNodes& nodes, int node, const std::set<std::string>& boneNames,
                    std::vector<std::vector<VertexBone>>& vertices, std::vector<std::string>& lost) {
    SourceSkin skin;
    std::set<int> taken;
    for (unsigned i = 0; i < mesh.mNumBones; ++i) {
        const aiBone* bone = mesh.mBones[i];
        if (bone == nullptr || bone->mNumWeights == 0) continue;
        const int joint = resolveBone(nodes, *bone, nodes.sceneFromNode[node], boneNames, taken);
        if (joint < 0) {
            lost.push_back(fmt::format("{} of {}", bone->mName.C_Str(), mesh.mName.C_Str()));
            continue;
        }
        taken.insert(joint);
        const auto slot = static_cast<std::uint32_t>(skin.joints.size());
        skin.joints.push_back({joint, fromAssimp(bone->mOffsetMatrix)});
        for (unsigned w = 0; w < bone->mNumWeights; ++w) {
            const aiVertexWeight& entry = bone->mWeights[w];
            if (entry.mVertexId < vertices.size()) vertices[entry.mVertexId].push_back({slot, entry.mWeight});
        }
    }
    return skin;
}

void copyAttributes(const aiMesh& source, SourceMesh& mesh) {
    const bool tangents = source.HasTangentsAndBitangents() && source.HasNormals() && source.HasTextureCoords(0);
    for (unsigned v = 0; v < source.mNumVertices; ++v) {
        mesh.positions.emplace_back(fromAssimp(source.mVertices[v]));
        if (source.HasNormals()) mesh.normals.emplace_back(fromAssimp(source.mNormals[v]));
        // Assimp's pictures start at the lower left.
        if (source.HasTextureCoords(0))
            mesh.uvs.emplace_back(source.mTextureCoords[0][v].x, 1.0F - source.mTextureCoords[0][v].y);
        if (tangents) {
            const dvec3 n = fromAssimp(source.mNormals[v]);
            const dvec3 t = fromAssimp(source.mTangents[v]);
            const bool mirrored = glm::dot(glm::cross(n, t), fromAssimp(source.mBitangents[v])) < 0.0;
            mesh.tangents.emplace_back(vec3(t), mirrored ? -1.0F : 1.0F);
        }
        if (source.HasVertexColors(0)) {
            const aiColor4D& c = source.mColors[0][v];
            mesh.colors.push_back(linearFromSrgb(vec4(c.r, c.g, c.b, c.a)));
        }
    }
    for (unsigned f = 0; f < source.mNumFaces; ++f) {
        const aiFace& face = source.mFaces[f];
        if (face.mNumIndices != 3) continue;
        const unsigned* const at = face.mIndices;
        if (at[0] < source.mNumVertices && at[1] < source.mNumVertices && at[2] < source.mNumVertices)
            mesh.indices.insert(mesh.indices.end(), {at[0], at[1], at[2]});
    }
}

SourceMesh meshOf(const aiMesh& source, const std::vector<std::vector<VertexBone>>& vertices, bool skinned) {
    SourceMesh mesh;
    mesh.name = source.mName.C_Str();
    mesh.material = static_cast<int>(source.mMaterialIndex);
    copyAttributes(source, mesh);
    if (!skinned) return mesh;
    mesh.influenceStart.push_back(0);
    for (const std::vector<VertexBone>& vertex : vertices) {
        for (const VertexBone& bone : vertex)
            mesh.influences.push_back({bone.slot, bone.weight});
        mesh.influenceStart.push_back(static_cast<std::uint32_t>(mesh.influences.size()));
    }
    return mesh;
}

std::set<std::string> namesOfBones(const aiScene& scene) {
    std::set<std::string> names;
    for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
        for (unsigned i = 0; i < scene.mMeshes[m]->mNumBones; ++i)
            names.insert(scene.mMeshes[m]->mBones[i]->mName.C_Str());
    }
    return names;
}

}  // namespace

void addMeshes(const aiScene& scene, const SceneNodes& nodes, SourceScene& out) {
    const std::set<std::string> boneNames = namesOfBones(scene);
    std::vector<int> meshOfSource(scene.mNumMeshes, -1);
    std::set<unsigned> skinnedDone;
    std::vector<std::string> lost;  // joints
    for (int node = 0; node < static_cast<int>(out.nodes.size()); ++node) {
        const aiNode& source = *nodes.sources[node];
        for (unsigned i = 0; i < source.mNumMeshes; ++i) {
            const unsigned index = source.mMeshes[i];
            if (index >= scene.mNumMeshes || skinnedDone.count(index) > 0) continue;
            const aiMesh& mesh = *scene.mMeshes[index];
            if ((mesh.mPrimitiveTypes & aiPrimitiveType_TRIANGLE) == 0U || mesh.mNumVertices == 0) continue;
            std::vector<std::vector<VertexBone>> vertices(mesh.mNumVertices);
            SourceSkin skin = readSkin(mesh, nodes, node, boneNames, vertices, lost);
            SourceInstance instance;
            instance.node = node;
            if (!skin.joints.empty()) {
                skinnedDone.insert(index);
                instance.skin = static_cast<int>(out.skins.size());
                out.skins.push_back(std::move(skin));
            }
            if (meshOfSource[index] < 0) {
                meshOfSource[index] = static_cast<int>(out.meshes.size());
                out.meshes.push_back(meshOf(mesh, vertices, instance.skin >= 0));
            }
            instance.mesh = meshOfSource[index];
            out.instances.push_back(instance);
        }
    }
    if (!lost.empty()) {
        out.warnings.push_back(fmt::format(
            "joints that are no nodes of the scene move no skin, and their weights were left out: {}", firstOf(lost)));
    }
}

}  // namespace lutka::animation::rig_import
