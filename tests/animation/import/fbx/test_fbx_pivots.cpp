// What FBX nodes turn about.

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "animation/import/fbx/fbx_documents.hpp"
#include "support/catch.hpp"

using namespace lutka;
using namespace lutka::animation::rig_import;
using namespace lutka::test;

namespace {

// The frame of a node of scale 2 in one frame of the only clip.
dmat4 frameOf(const SourceClip& clip, std::size_t frame) {
    const auto& places = clip.channels[0].values;
    const float* q = &clip.channels[1].values[4 * frame];
    dmat4 found = glm::mat4_cast(glm::dquat(q[3], q[0], q[1], q[2])) * glm::scale(dmat4(1.0), dvec3(2));
    found[3] = glm::dvec4(places[3 * frame], places[3 * frame + 1], places[3 * frame + 2], 1.0);
    return found;
}

}  // namespace

TEST_CASE("FBX clips turn about the rotation's pivot, in the node's euler angles, between pre- and post-rotation") {
    std::vector<FbxRecord> objects{model(7, "Arm", pivotsOfAllKinds())};
    std::vector<FbxRecord> links{fbxLink(7, 0)};
    addTurn(10, 370, objects, links);
    const SourceScene scene = readAll(document(objects, links));
    REQUIRE(scene.clips.size() == 1);
    CHECK(scene.clips[0].name == "Wave");
    REQUIRE(scene.clips[0].channels.size() == 3);
    const SourceChannel& turns = scene.clips[0].channels[1];
    REQUIRE(turns.times.size() == 31);
    glm::dquat last(1, 0, 0, 0);
    for (std::size_t frame = 0; frame < turns.times.size(); ++frame) {
        // A whole turn between two keys: a reader that knew the keys' rotations only would stand still.
        const dmat4 expected = pivotsMatrix({10.0 + 360.0 * turns.times[frame], 20, 30});
        CHECK(difference(frameOf(scene.clips[0], frame), expected) < 1e-4);
        const float* q = &turns.values[4 * frame];
        const glm::dquat rotation(q[3], q[0], q[1], q[2]);
        if (frame > 0) CHECK(glm::dot(last, rotation) > 0.0);
        last = rotation;
    }
}

TEST_CASE(
    "the node of a rigid FBX mesh stands at the pivot that it turns about, and mesh and children where they were") {
    const std::vector<double> corners{-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};
    std::vector<FbxRecord> objects{model(7, "Arm", pivotsOfAllKinds()),
                                   model(6, "Hand", {{"Lcl Translation", {3, 4, 5}}}),
                                   {"Geometry",
                                    {std::int64_t{3}, std::string("Geometry::Square"), std::string("Mesh")},
                                    {row("Vertices", corners), wholes("PolygonVertexIndex", {0, 1, 2, -4})}}};
    std::vector<FbxRecord> links{fbxLink(7, 0), fbxLink(6, 7), fbxLink(3, 7)};
    addTurn(10, 50, objects, links);
    const SourceScene scene = readAll(document(objects, links));
    REQUIRE(scene.nodes.size() == 3);
    REQUIRE(scene.meshes.size() == 1);
    REQUIRE(scene.clips.size() == 1);
    const dvec3 pivot = dvec3(1, 2, 3) + dvec3(4, 5, 6) + dvec3(7, 8, 9);  // translation, offset and pivot
    const auto checkAt = [&](const dmat4& found, const dmat4& file) {
        CHECK(glm::distance(dvec3(found[3]), pivot) < 1e-4);
        const std::vector<vec3>& positions = scene.meshes[0].positions;
        REQUIRE(positions.size() == 4);
        for (std::size_t i = 0; i < 4; ++i) {
            const glm::dvec4 corner(corners[3 * i], corners[3 * i + 1], corners[3 * i + 2], 1.0);
            CHECK(glm::distance(found * glm::dvec4(positions[i], 1.0), file * corner) < 1e-4);
        }
        CHECK(difference(found * scene.nodes[2].parentFromNode, file * move({3, 4, 5})) < 1e-4);
    };
    checkAt(scene.nodes[1].parentFromNode, pivotsMatrix({10, 20, 30}));
    const std::vector<double>& times = scene.clips[0].channels[1].times;
    for (const std::size_t frame : {std::size_t{0}, times.size() / 2, times.size() - 1})
        checkAt(frameOf(scene.clips[0], frame), pivotsMatrix({10.0 + 40.0 * times[frame], 20, 30}));
}
