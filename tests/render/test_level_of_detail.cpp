#include "render/level_of_detail.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <set>

#include "support/catch.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using namespace lutka::render;

TEST_CASE("a coarser mesh has fewer triangles, none collapsed, over vertices of the mesh itself") {
    const animation::Character biped = test::makeBiped();
    const animation::SkinnedMesh& mesh = biped.meshes[0];
    std::size_t last = mesh.indices.size();
    for (const float cell : {0.03F, 0.08F, 0.2F}) {
        const std::vector<std::uint32_t> coarse = clusteredIndices(mesh, cell);
        REQUIRE(coarse.size() % 3 == 0);
        CHECK(coarse.size() <= last);
        CHECK_FALSE(coarse.empty());
        last = coarse.size();
        for (std::size_t i = 0; i < coarse.size(); i += 3) {
            CHECK(coarse[i] < mesh.positions.size());
            CHECK(coarse[i] != coarse[i + 1]);
            CHECK(coarse[i + 1] != coarse[i + 2]);
            CHECK(coarse[i + 2] != coarse[i]);
        }
    }
    CHECK(last < mesh.indices.size() / 3);
}

TEST_CASE("no vertex of a surface is further from its coarser one than a cube's diagonal") {
    const animation::Character biped = test::makeBiped();
    const animation::SkinnedMesh& mesh = biped.meshes[0];
    constexpr float kCell = 0.05F;
    const std::vector<std::uint32_t> coarse = clusteredIndices(mesh, kCell);
    for (const vec3& position : mesh.positions) {
        float nearest = 1e9F;
        for (const std::uint32_t vertex : coarse)
            nearest = std::min(nearest, glm::distance(position, mesh.positions[vertex]));
        CHECK(nearest <= 1.7321F * kCell);
    }
}

TEST_CASE("cubes smaller than any edge leave the mesh as it is") {
    const animation::Character biped = test::makeBiped();
    CHECK(clusteredIndices(biped.meshes[0], 1e-5F).size() == biped.meshes[0].indices.size());
}

TEST_CASE("parts that follow different joints never grow together") {
    // Two triangles in one cube, one a joint.
    animation::SkinnedMesh mesh;
    mesh.positions = {{0.1F, 0, 0},     {0.3F, 0, 0},     {0.1F, 0.9F, 0},
                      {0.1F, 0, 0.01F}, {0.3F, 0, 0.01F}, {0.1F, 0.9F, 0.01F}};
    mesh.joints = {{0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}, {1, 0, 0, 0}, {1, 0, 0, 0}, {1, 0, 0, 0}};
    mesh.weights.assign(6, {1, 0, 0, 0});
    mesh.indices = {0, 1, 2, 3, 4, 5};
    const std::vector<std::uint32_t> coarse = clusteredIndices(mesh, 0.15F);
    for (std::size_t i = 0; i + 2 < coarse.size(); i += 3) {
        CHECK(mesh.joints[coarse[i]][0] == mesh.joints[coarse[i + 1]][0]);
        CHECK(mesh.joints[coarse[i]][0] == mesh.joints[coarse[i + 2]][0]);
    }
}
