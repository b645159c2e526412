#include "animation/import/scene_oracle.hpp"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

namespace lutka::test {
namespace {

aiMatrix4x4 globalOf(const aiNode* node) {
    aiMatrix4x4 global;
    for (; node != nullptr; node = node->mParent)
        global = node->mTransformation * global;
    return global;
}

// Of nodes with that name the first without meshes, else the first.
const aiNode* findJointNode(const aiNode* node, const aiString& name) {
    const aiNode* fallback = nullptr;
    if (node->mName == name) {
        if (node->mNumMeshes == 0) return node;
        fallback = node;
    }
    for (unsigned i = 0; i < node->mNumChildren; ++i) {
        const aiNode* found = findJointNode(node->mChildren[i], name);
        if (found != nullptr && found->mNumMeshes == 0) return found;
        if (fallback == nullptr) fallback = found;
    }
    return fallback;
}

struct Weighted {
    double weight;
    aiVector3D position;
};

struct Posed {
    vec3 position;
    bool weighted;
};

Posed blend(std::vector<Weighted>& parts) {
    std::stable_sort(parts.begin(), parts.end(),
                     [](const Weighted& a, const Weighted& b) { return a.weight > b.weight; });
    if (parts.size() > 4) parts.resize(4);
    double sum = 0.0;
    glm::dvec3 position(0);
    for (const Weighted& part : parts) {
        sum += part.weight;
        position += part.weight * glm::dvec3(part.position.x, part.position.y, part.position.z);
    }
    return {vec3(position / (sum > 0.0 ? sum : 1.0)), sum > 0.0};
}

std::vector<Posed> poseMesh(const aiScene& scene, const aiMesh& mesh, const aiNode& node) {
    std::vector<std::vector<Weighted>> parts(mesh.mNumVertices);
    for (unsigned b = 0; b < mesh.mNumBones; ++b) {
        const aiBone& bone = *mesh.mBones[b];
        const aiNode* joint = findJointNode(scene.mRootNode, bone.mName);
        if (joint == nullptr) continue;
        const aiMatrix4x4 move = globalOf(joint) * bone.mOffsetMatrix;
        for (unsigned i = 0; i < bone.mNumWeights; ++i) {
            const aiVertexWeight& entry = bone.mWeights[i];
            if (entry.mWeight > 0.0F) {
                parts[entry.mVertexId].push_back({entry.mWeight, move * mesh.mVertices[entry.mVertexId]});
            }
        }
    }
    const aiMatrix4x4 rigid = globalOf(&node);
    std::vector<Posed> posed;
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
        if (mesh.mNumBones == 0) parts[v].push_back({1.0, rigid * mesh.mVertices[v]});
        posed.push_back(blend(parts[v]));
    }
    return posed;
}

void visit(const aiScene& scene, const aiNode& node, std::set<unsigned>& skinnedDone,
           std::vector<OracleTriangle>& out) {
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
        const aiMesh& mesh = *scene.mMeshes[node.mMeshes[i]];
        if (mesh.mNumBones > 0 && !skinnedDone.insert(node.mMeshes[i]).second) continue;
        const std::vector<Posed> posed = poseMesh(scene, mesh, node);
        for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
            if (mesh.mFaces[f].mNumIndices != 3) continue;
            OracleTriangle triangle;
            for (unsigned corner = 0; corner < 3; ++corner) {
                const Posed& vertex = posed[mesh.mFaces[f].mIndices[corner]];
                triangle.corners[corner] = vertex.position;
                triangle.comparable = triangle.comparable && vertex.weighted;
            }
            out.push_back(triangle);
        }
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i)
        visit(scene, *node.mChildren[i], skinnedDone, out);
}

}  // namespace

std::vector<OracleTriangle> oracleTriangles(const std::filesystem::path& file) {
    Assimp::Importer importer;
    importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
    constexpr unsigned kSteps = aiProcess_Triangulate | aiProcess_SortByPType;
    std::vector<OracleTriangle> out;
    const aiScene* scene = nullptr;
    if (file.extension() == ".vrm") {
        std::ifstream in(file, std::ios::binary);
        const std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
        scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(), kSteps, "glb");
    } else {
        scene = importer.ReadFile(file.string(), kSteps);
    }
    if (scene == nullptr) return out;
    std::set<unsigned> skinnedDone;
    visit(*scene, *scene->mRootNode, skinnedDone, out);
    return out;
}

}  // namespace lutka::test
