// data_path MODEL: the cost of every arrow of the data path on one model, in turn, as CSV; and the ratio of import +
// map + fit to Assimp's own reading of the file, which is the floor of any import that uses it.
//
// Medians over interleaved rounds, so that a noisy machine treats all alike.
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <chrono>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "animation/pose.hpp"
#include "animation/skinning.hpp"
#include "scene/ragdoll_asset.hpp"

namespace {

using namespace lutka;

struct Case {
    std::string name;
    std::string unit;  // what `count` counts
    double count = 1;
    std::function<void()> run;
    std::vector<double> ms;
};

double medianOf(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

double timeOf(const std::function<void()>& run) {
    const auto before = std::chrono::steady_clock::now();
    run();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - before).count();
}

// As a program would read a rigged model with Assimp alone.
void readWithAssimp(const std::string& file) {
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFile(file, aiProcess_Triangulate | aiProcess_SortByPType |
                                                       aiProcess_CalcTangentSpace | aiProcess_GenSmoothNormals |
                                                       aiProcess_LimitBoneWeights | aiProcess_JoinIdenticalVertices);
    if (scene == nullptr) fmt::print(stderr, "{}\n", importer.GetErrorString());
}

constexpr int kInstances = 1000;

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        fmt::print(stderr, "usage: data_path MODEL\n");
        return 2;
    }
    const std::string file = argv[1];
    scene::LoadOptions options;
    options.import.loadTextures = false;
    const auto loaded = scene::loadRagdoll(file, options);
    if (!loaded) {
        fmt::print(stderr, "{}\n", loaded.error().text());
        return 3;
    }
    const scene::RagdollAsset& asset = *loaded.value();
    const animation::Skeleton& skeleton = asset.character.skeleton;
    const std::size_t joints = skeleton.parents.size();
    std::vector<physics::BodyState> bodies(asset.profile.bodies.size());
    physics::bodiesFromPose(asset.rig, skeleton.bindModelFromJoint, {}, bodies);
    std::vector<RigidTransform> worldFromBody;
    for (const physics::BodyState& body : bodies)
        worldFromBody.push_back(body.worldFromBody);
    // One array for all instances, so that they leave the cache as a crowd's do.
    std::vector<RigidTransform> poses(joints * kInstances);
    std::vector<RigidTransform> locals(joints * kInstances);
    std::vector<animation::SkinMatrix> palettes(joints * kInstances);
    std::vector<animation::SkinMatrix> copies(joints * kInstances);
    for (std::size_t i = 0; i < kInstances; ++i) {
        std::copy(skeleton.nodeParentFromJoint.begin(), skeleton.nodeParentFromJoint.end(),
                  locals.begin() + static_cast<std::ptrdiff_t>(i * joints));
    }
    std::size_t vertices = 0;
    for (const animation::SkinnedMesh& mesh : asset.character.meshes)
        vertices += mesh.positions.size();
    std::vector<vec3> positions(vertices);
    std::vector<vec3> normals(vertices);
    std::vector<vec3> vertexCopies(vertices);
    const auto each = [&](auto&& body) {
        for (std::size_t i = 0; i < kInstances; ++i)
            body(i * joints);
    };
    const double jointCount = static_cast<double>(joints) * kInstances;
    std::vector<Case> cases;
    cases.push_back({"assimp reads", "file", 1, [&] { readWithAssimp(file); }, {}});
    cases.push_back({"importCharacter",
                     "file",
                     1,
                     [&] { static_cast<void>(animation::importCharacter(file, options.import)); },
                     {}});
    cases.push_back(
        {"mapHumanoid", "character", 1, [&] { static_cast<void>(animation::mapHumanoid(asset.character)); }, {}});
    cases.push_back({"fitRagdoll",
                     "character",
                     1,
                     [&] { static_cast<void>(physics::fitRagdoll(asset.character, asset.map)); },
                     {}});
    cases.push_back({"localToModel",
                     "joint",
                     jointCount,
                     [&] {
                         each([&](std::size_t at) {
                             animation::localToModel(skeleton, std::span(locals).subspan(at, joints),
                                                     std::span(poses).subspan(at, joints));
                         });
                     },
                     {}});
    cases.push_back({"poseFromBodies",
                     "joint",
                     jointCount,
                     [&] {
                         each([&](std::size_t at) {
                             physics::poseFromBodies(asset.rig, skeleton, worldFromBody, {},
                                                     std::span(poses).subspan(at, joints));
                         });
                     },
                     {}});
    cases.push_back({"skinMatrices",
                     "joint",
                     jointCount,
                     [&] {
                         each([&](std::size_t at) {
                             animation::skinMatrices(skeleton.bindModelFromJoint, std::span(poses).subspan(at, joints),
                                                     std::span(palettes).subspan(at, joints));
                         });
                     },
                     {}});
    cases.push_back(
        {"copy of the palettes",
         "joint",
         jointCount,
         [&] { std::memcpy(static_cast<void*>(copies.data()), palettes.data(), palettes.size() * sizeof palettes[0]); },
         {}});
    cases.push_back({"skinVertices",
                     "vertex",
                     static_cast<double>(vertices),
                     [&] {
                         std::size_t at = 0;
                         for (const animation::SkinnedMesh& mesh : asset.character.meshes) {
                             const std::size_t count = mesh.positions.size();
                             animation::skinVertices(mesh, std::span(palettes).first(joints),
                                                     std::span(positions).subspan(at, count),
                                                     std::span(normals).subspan(at, count));
                             at += count;
                         }
                     },
                     {}});
    cases.push_back({"copy of the vertices",
                     "vertex",
                     static_cast<double>(vertices),
                     [&] {
                         std::memcpy(static_cast<void*>(vertexCopies.data()), positions.data(),
                                     positions.size() * sizeof positions[0]);
                     },
                     {}});
    constexpr int rounds = 15;
    for (int round = 0; round < rounds; ++round) {
        for (Case& one : cases)
            one.ms.push_back(timeOf(one.run));
    }
    fmt::print("case,unit,count,ms,ns_per_unit\n");
    for (const Case& one : cases) {
        const double ms = medianOf(one.ms);
        fmt::print("{},{},{:.0f},{:.4f},{:.2f}\n", one.name, one.unit, one.count, ms, ms * 1e6 / one.count);
    }
    std::vector<double> ratios;
    for (int round = 0; round < rounds; ++round) {
        const auto at = static_cast<std::size_t>(round);
        ratios.push_back((cases[1].ms[at] + cases[2].ms[at] + cases[3].ms[at]) / cases[0].ms[at]);
    }
    fmt::print("# (import + map + fit) / assimp alone: {:.2f}\n", medianOf(ratios));
    return 0;
}
