#include "animation/skinning.hpp"

#include <glm/geometric.hpp>

#include "support/catch.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using namespace lutka::animation;

TEST_CASE("the bind pose leaves every vertex where it is") {
    const Character biped = test::makeBiped();
    std::vector<SkinMatrix> palette(biped.skeleton.parents.size());
    skinMatrices(biped.skeleton.bindModelFromJoint, biped.skeleton.bindModelFromJoint, palette);
    const SkinnedMesh& mesh = biped.meshes[0];
    std::vector<vec3> positions(mesh.positions.size());
    std::vector<vec3> normals(mesh.normals.size());
    skinVertices(mesh, palette, positions, normals);
    float worst = 0;
    for (std::size_t v = 0; v < positions.size(); ++v) {
        worst = std::max(
            {worst, glm::distance(positions[v], mesh.positions[v]), glm::distance(normals[v], mesh.normals[v])});
    }
    CHECK(worst < 1e-5F);
}

TEST_CASE("a vertex between two joints moves by the blend of both") {
    SkinnedMesh mesh;
    mesh.positions = {{1, 0, 0}};
    mesh.normals = {{0, 1, 0}};
    mesh.joints = {{0, 1, 0, 0}};
    mesh.weights = {{0.75F, 0.25F, 0, 0}};
    const std::vector<RigidTransform> bind(2);
    std::vector<RigidTransform> pose(2);
    pose[1].translation = {0, 4, 0};
    pose[0].rotation = glm::angleAxis(kPi / 2, vec3(0, 0, 1));
    std::vector<SkinMatrix> palette(2);
    skinMatrices(bind, pose, palette);
    std::vector<vec3> position(1);
    std::vector<vec3> normal(1);
    skinVertices(mesh, palette, position, normal);
    // 0.75 (0, 1, 0) + 0.25 (1, 4, 0)
    CHECK(glm::distance(position[0], vec3(0.25F, 1.75F, 0)) < 1e-6F);
    CHECK(glm::length(normal[0]) == Approx(1.0F));
}
