#include "animation/import/vertex_order.hpp"

#include <algorithm>
#include <set>

#include "core/random.hpp"
#include "support/catch.hpp"

using namespace lutka;
using namespace lutka::animation;

namespace {

// Vertices that their texture coordinates number, with one to three of four joints.
SkinnedMesh numberedMesh(std::size_t vertices) {
    Random random(2);
    SkinnedMesh mesh;
    for (std::size_t v = 0; v < vertices; ++v) {
        const auto number = static_cast<float>(v);
        mesh.positions.emplace_back(number, 1, 2);
        mesh.normals.emplace_back(0, 0, 1);
        mesh.uvs.emplace_back(number, 0);
        const int count = 1 + static_cast<int>(random.uniform(0.0F, 2.99F));
        std::array<std::uint16_t, kMaxInfluences> joints{};
        std::array<float, kMaxInfluences> weights{};
        for (int i = 0; i < count; ++i) {
            joints[i] = static_cast<std::uint16_t>(random.uniform(0.0F, 3.99F));
            weights[i] = 1.0F / static_cast<float>(count);
        }
        mesh.joints.push_back(joints);
        mesh.weights.push_back(weights);
        for (int corner = 0; corner < 3; ++corner)
            mesh.indices.push_back(static_cast<std::uint32_t>(random.uniform(0.0F, number + 0.99F)));
    }
    return mesh;
}

}  // namespace

TEST_CASE("vertices with the same joints come together in their old order, and triangles stay what they were") {
    const SkinnedMesh before = numberedMesh(300);
    SkinnedMesh mesh = before;
    rig_import::orderForSkinning(mesh);
    REQUIRE(mesh.positions.size() == 300);
    CHECK(mesh.tangents.empty());
    std::set<std::pair<int, std::array<std::uint16_t, kMaxInfluences>>> done;
    int counted = 0;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const auto from = static_cast<std::size_t>(mesh.uvs[v].x);
        CHECK(mesh.positions[v] == before.positions[from]);
        CHECK(mesh.joints[v] == before.joints[from]);
        CHECK(mesh.weights[v] == before.weights[from]);
        const int count = static_cast<int>(
            std::count_if(mesh.weights[v].begin(), mesh.weights[v].end(), [](float w) { return w > 0.0F; }));
        CHECK(count >= counted);
        const bool same = v > 0 && count == counted && mesh.joints[v] == mesh.joints[v - 1];
        counted = count;
        if (same)
            CHECK(mesh.uvs[v].x > mesh.uvs[v - 1].x);
        else
            CHECK(done.insert({count, mesh.joints[v]}).second);
    }
    REQUIRE(mesh.indices.size() == before.indices.size());
    REQUIRE(mesh.fileOrder.size() == 300);
    for (std::size_t v = 0; v < 300; ++v)
        CHECK(mesh.positions[mesh.fileOrder[v]] == before.positions[v]);
    for (std::size_t i = 0; i < mesh.indices.size(); ++i)
        CHECK(mesh.uvs[mesh.indices[i]] == before.uvs[before.indices[i]]);
}

TEST_CASE("what rounding left of a zero becomes one") {
    SkinnedMesh mesh = numberedMesh(1);
    mesh.positions[0] = {1e-40F, -1e-15F, 1e-3F};
    mesh.normals[0] = {0, -1, 1e-20F};
    mesh.tangents = {{1, 1e-39F, 0, -1}};
    rig_import::orderForSkinning(mesh);
    CHECK(mesh.positions[0] == vec3(0, 0, 1e-3F));
    CHECK(mesh.normals[0] == vec3(0, -1, 0));
    CHECK(mesh.tangents[0] == vec4(1, 0, 0, -1));
}
