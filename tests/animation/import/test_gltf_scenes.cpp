#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "checks.hpp"
#include "gltf_file.hpp"
#include "support/catch.hpp"

// What of a file is the figure: cameras and other nodes beside it, several characters in one file.
using namespace lutka;
using namespace lutka::animation;
using namespace lutka::test;

TEST_CASE("cameras and lights beside a skeleton do not enter its height") {
    const TemporaryFolder folder;
    GltfFile file;
    const int scene = file.addNode("RootNode", -1);
    int joint = file.addNode("Hips", scene, glm::translate(mat4(1.0F), vec3(0, 90, 0)));
    for (int i = 0; i < 12; ++i)
        joint = file.addNode("Spine" + std::to_string(i), joint, glm::translate(mat4(1.0F), vec3(0, 7, 0)));
    for (const vec3& place : {vec3(15000, 0, 0), vec3(-15000, 0, 0), vec3(0, 15000, 0), vec3(0, -15000, 0),
                              vec3(0, 0, 15000), vec3(300, 500, 20000)}) {
        file.addNode("Producer", scene, glm::translate(mat4(1.0F), place));
    }
    file.saveBinary(folder / "capture.glb");
    const Character character = imported(folder / "capture.glb");
    CHECK(character.units.metresPerFileUnit == Approx(0.01F));
    for (const RigidTransform& frame : character.skeleton.bindModelFromJoint)
        CHECK(glm::length(frame.translation) < 3.0F);
}

TEST_CASE("a figure that is inside out is turned, with a word") {
    const TemporaryFolder folder;
    // A post with a lid and a bottom, and the same with all triangles the other way round.
    Post closed = makePost();
    for (const int corner : {0, 3, 2, 0, 2, 1, 12, 13, 14, 12, 14, 15})
        closed.indices.push_back(static_cast<std::uint16_t>(corner));
    const auto rigOf = [&](const Post& post) {
        GltfFile file = makePostRig();
        file.json["meshes"][0]["primitives"][0]["indices"] = file.addIndices(post.indices);
        file.saveBinary(folder / "post.glb");
        return imported(folder / "post.glb");
    };
    const Character sound = rigOf(closed);
    Post turned = closed;
    for (std::size_t i = 0; i < turned.indices.size(); i += 3)
        std::swap(turned.indices[i + 1], turned.indices[i + 2]);
    const Character mended = rigOf(turned);
    CHECK_FALSE(warns(sound, "point inwards"));
    CHECK(warns(mended, "point inwards"));
    checkInvariants(mended);
    for (const SkinnedMesh& mesh : mended.meshes) {
        for (std::size_t v = 0; v < mesh.positions.size(); ++v)
            CHECK(glm::dot(mesh.normals[v], mesh.positions[v] - vec3(0, 0.9F, 0)) > 0.0F);
    }
}
