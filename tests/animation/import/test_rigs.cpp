// Rigs made by hand, each with the oddity that its name says, and answers known from how they were made.

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "animation/import/checks.hpp"
#include "animation/import/gltf_file.hpp"
#include "animation/pose.hpp"
#include "support/catch.hpp"

using namespace lutka;
using namespace lutka::animation;
using namespace lutka::test;

namespace {

Character importedRig(const GltfFile& file) {
    const TemporaryFolder folder;
    file.saveText(folder / "rig.gltf");
    Character character = imported(folder / "rig.gltf");
    checkInvariants(character);
    return character;
}

int joint(const Character& character, const std::string& name) {
    const int found = findJoint(character.skeleton, name);
    INFO(name);
    REQUIRE(found != kNoJoint);
    return found;
}

// Largest distance between the character's bind vertices and the post's.
float distanceToPost(const Character& character, const vec3& shift = vec3(0)) {
    const Post post = makePost();
    const std::vector<vec3> vertices = bindVertices(character);
    REQUIRE(vertices.size() == post.positions.size());
    float worst = 0.0F;
    for (std::size_t v = 0; v < vertices.size(); ++v)
        worst = std::max(worst, glm::distance(vertices[v], post.positions[v] + shift));
    return worst;
}

// Share of triangles that face away from the post's axis.
float outwardShare(const SkinnedMesh& mesh) {
    int outward = 0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const vec3& a = mesh.positions[mesh.indices[i]];
        const vec3& b = mesh.positions[mesh.indices[i + 1]];
        const vec3& c = mesh.positions[mesh.indices[i + 2]];
        const vec3 out = (a + b + c) / 3.0F;
        outward += glm::dot(glm::cross(b - a, c - a), vec3(out.x, 0, out.z)) > 0.0F ? 1 : 0;
    }
    return static_cast<float>(outward) / (static_cast<float>(mesh.indices.size()) / 3.0F);
}

}  // namespace

TEST_CASE("a plain rig comes in as it was made") {
    const Character character = importedRig(makePostRig());
    CHECK(character.name == "rig");
    CHECK(distanceToPost(character) < 1e-6F);
    CHECK(character.units.metresPerFileUnit == 1.0F);
    CHECK(character.units.unitSource == "glTF");
    CHECK(character.units.upAxis == "+Y");
    const Skeleton& skeleton = character.skeleton;
    CHECK(jointPath(skeleton, joint(character, "high")) == "Armature/low/middle/high");
    CHECK(glm::distance(skeleton.bindModelFromJoint[joint(character, "high")].translation, vec3(0, 1.2F, 0)) < 1e-6F);
    CHECK(skeleton.skinWeight[joint(character, "low")] == Approx(4));
    CHECK(skeleton.skinWeight[joint(character, "high")] == Approx(8));
    CHECK(skeleton.skinWeight[joint(character, "Armature")] == 0.0F);
    CHECK(character.warnings.empty());
}

TEST_CASE("every scale of the armature is baked") {
    struct Case {
        const char* name;
        mat4 armature;
    };
    const mat4 turned = glm::rotate(mat4(1.0F), 0.5F, vec3(0, 1, 0));
    for (const Case& each :
         {Case{"hundredth", glm::scale(mat4(1.0F), vec3(0.01F))}, Case{"hundred", glm::scale(mat4(1.0F), vec3(100.0F))},
          Case{"mirrored", glm::scale(mat4(1.0F), vec3(-1, 1, 1))},
          Case{"all negative", glm::scale(mat4(1.0F), vec3(-0.01F))},
          Case{"non-uniform", glm::scale(mat4(1.0F), vec3(1, 2, 0.5F))},
          Case{"turned and non-uniform", turned * glm::scale(mat4(1.0F), vec3(0.01F, 0.02F, 0.01F))},
          Case{"moved", glm::translate(mat4(1.0F), vec3(3, 0, 1))}}) {
        INFO(each.name);
        const Character character = importedRig(makePostRig(each.armature));
        CHECK(distanceToPost(character) < 1e-5F);
        CHECK(largestError(character, nodePose(character.skeleton), bindVertices(character)) < 1e-5F);
        CHECK(outwardShare(character.meshes.front()) == 1.0F);
        const vec3 high = character.skeleton.bindModelFromJoint[joint(character, "high")].translation;
        CHECK(glm::distance(high, vec3(0, 1.2F, 0)) < 1e-5F);
    }
}

TEST_CASE("vertices in scene space stay there, though their mesh's node hangs below a turned and moved armature") {
    // Blender's exporter writes an object that was turned and moved in this way.
    const mat4 sceneFromArmature =
        glm::rotate(glm::translate(mat4(1.0F), vec3(1, 0, -2)), glm::radians(40.0F), vec3(0, 1, 0));
    GltfFile file = makePostRig();
    file.json["nodes"][0] = {{"name", "Armature"}, {"children", file.json["nodes"][0]["children"]}};
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row)
            file.json["nodes"][0]["matrix"].push_back(sceneFromArmature[column][row]);
    }
    std::vector<mat4> jointFromScene;
    for (int i = 0; i < 3; ++i)
        jointFromScene.push_back(
            glm::inverse(sceneFromArmature * glm::translate(mat4(1.0F), vec3(0, 0.6F * static_cast<float>(i), 0))));
    file.json["skins"].clear();
    addSkin(file, {1, 2, 3}, jointFromScene);
    file.json["nodes"][4]["mesh"] = addPostMesh(file, makePost(), sceneFromArmature);

    const Character character = importedRig(file);
    const Post post = makePost();
    const std::vector<vec3> vertices = bindVertices(character);
    REQUIRE(vertices.size() == post.positions.size());
    for (std::size_t v = 0; v < vertices.size(); ++v)
        CHECK(glm::distance(vertices[v], vec3(sceneFromArmature * vec4(post.positions[v], 1))) < 1e-4F);
    const vec3 high = character.skeleton.bindModelFromJoint[joint(character, "high")].translation;
    CHECK(glm::distance(high, vec3(1, 1.2F, -2)) < 1e-4F);
}

TEST_CASE("joints whose bind frames have sizes of their own do not stretch the figure") {
    // As the collision volumes of Second Life's figures: their nodes are not scaled, their inverse bind matrices are.
    Post post = makePost();
    for (std::size_t v = 0; v < post.skin.size(); ++v)
        post.skin[v].joints[0] = static_cast<std::uint8_t>(v % 9);
    GltfFile file;
    const int root = file.addNode("root", -1);
    const std::vector<vec3> places = {vec3(0, 0, 0),          vec3(0.1F, 0.6F, 0),      vec3(-0.1F, 1.2F, 0.1F),
                                      vec3(0, 1.5F, -0.1F),   vec3(0.2F, 1.1F, -0.05F), vec3(-0.2F, 0.9F, 0),
                                      vec3(0.1F, 1.4F, 0.1F), vec3(-0.1F, 0.3F, -0.1F), vec3(0, 0.8F, 0.15F)};
    const std::vector<vec3> sizes = {vec3(8, 6, 5), vec3(11, 7, 6), vec3(20, 20, 20), vec3(9, 7, 5), vec3(10, 9, 10),
                                     vec3(8, 6, 5), vec3(11, 7, 6), vec3(20, 20, 20), vec3(9, 7, 5)};
    const mat4 sceneFromMesh = glm::scale(mat4(1.0F), vec3(0.5F, 2.0F, 1.0F));
    std::vector<int> nodes;
    std::vector<mat4> jointFromMesh;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const mat4 sceneFromJoint = glm::translate(mat4(1.0F), places[i]);
        nodes.push_back(file.addNode("volume" + std::to_string(i), root, sceneFromJoint));
        jointFromMesh.push_back(glm::scale(mat4(1.0F), sizes[i]) * glm::inverse(sceneFromJoint) * sceneFromMesh);
    }
    const int bone = file.addNode("bone", nodes[1], glm::translate(mat4(1.0F), vec3(0, 0.3F, 0)));
    const int mesh = file.addNode("post", -1);
    file.json["nodes"][mesh]["mesh"] = addPostMesh(file, post, glm::inverse(sceneFromMesh));
    file.json["nodes"][mesh]["skin"] = addSkin(file, nodes, jointFromMesh);
    const Character character = importedRig(file);
    const std::vector<vec3> vertices = bindVertices(character);  // in another order than the file's
    REQUIRE(vertices.size() == post.positions.size());
    for (const vec3& position : post.positions) {
        CHECK(std::any_of(vertices.begin(), vertices.end(),
                          [&](const vec3& vertex) { return glm::distance(vertex, position) < 1e-4F; }));
    }
    const auto placeOf = [&](int node) {
        const std::string name = file.json["nodes"][node]["name"];
        return character.skeleton.bindModelFromJoint[joint(character, name)].translation;
    };
    CHECK(glm::distance(placeOf(nodes[2]), places[2]) < 1e-4F);
    CHECK(glm::distance(placeOf(bone), places[1] + vec3(0, 0.3F, 0)) < 1e-4F);
}

TEST_CASE("an animal's unit makes it as long as one, not as tall as a person") {
    // 79 units tall and 154 long, as a fox in centimetres.
    GltfFile file;
    const int node = file.addNode("fox", -1);
    file.json["nodes"][node]["mesh"] =
        addPostMesh(file, makePost(), glm::scale(mat4(1.0F), vec3(40, 43.9F, 385)), false);
    const Character character = importedRig(file);
    CHECK(character.units.metresPerFileUnit == Approx(0.01F));
}

TEST_CASE("a hand is as long as a hand, not as tall as a person") {
    const TemporaryFolder folder;
    const char* fingers[] = {"thumb", "index-finger", "middle-finger", "ring-finger", "pinky-finger"};
    for (const float unit : {1.0F, 100.0F}) {
        INFO(unit);
        GltfFile file;
        const int wrist = file.addNode("wrist", -1);
        std::vector<int> nodes{wrist};
        std::vector<mat4> jointFromMesh{mat4(1.0F)};
        for (const char* finger : fingers) {
            int parent = wrist;
            for (const char* part : {"-phalanx-proximal", "-phalanx-distal"}) {
                parent = file.addNode(std::string(finger) + part, parent);
                nodes.push_back(parent);
                jointFromMesh.emplace_back(1.0F);
            }
        }
        // The post is 1.8 m tall: here a hand of 0.18 m.
        const mat4 small = glm::scale(mat4(1.0F), vec3(0.1F * unit));
        const int node = file.addNode("mesh", -1);
        file.json["nodes"][node]["mesh"] = addPostMesh(file, makePost(), small);
        file.json["nodes"][node]["skin"] = addSkin(file, nodes, jointFromMesh);
        file.saveBinary(folder / "hand.glb");
        const Character hand = imported(folder / "hand.glb");
        float low = 1e9F;
        float high = -1e9F;
        for (const vec3& p : bindVertices(hand)) {
            low = std::min(low, p.y);
            high = std::max(high, p.y);
        }
        CHECK(high - low == Approx(0.18F).epsilon(1e-3));
        CHECK(hand.warnings.empty() == (unit == 1.0F));
    }
}

TEST_CASE("the node pose bends the skin as the file says") {
    GltfFile file = makePostRig(glm::scale(mat4(1.0F), vec3(0.01F)));
    // Turns the joint 'high' by 90 degrees about z: what is above it falls to -x.
    file.json["nodes"][3].erase("matrix");
    file.json["nodes"][3]["translation"] = {0, 60, 0};
    file.json["nodes"][3]["rotation"] = {0, 0, std::sqrt(0.5), std::sqrt(0.5)};
    const Character character = importedRig(file);
    CHECK(distanceToPost(character) < 1e-5F);
    std::vector<vec3> expected = makePost().positions;
    for (vec3& p : expected) {
        if (p.y > 1.1F) p = vec3(-(p.y - 1.2F), 1.2F + p.x, p.z);
    }
    CHECK(largestError(character, nodePose(character.skeleton), expected) < 1e-5F);
}

TEST_CASE("scale that only the node pose has is dropped with its figure") {
    GltfFile file = makePostRig();
    file.json["nodes"][3].erase("matrix");
    file.json["nodes"][3]["translation"] = {0, 0.6, 0};
    file.json["nodes"][3]["scale"] = {1.2, 1.2, 1.2};
    const Character character = importedRig(file);
    CHECK(warns(character, "20.0 %"));
    CHECK(distanceToPost(character) < 1e-5F);
}

TEST_CASE("a mesh that contradicts the size of its joints takes theirs") {
    // The mesh node says centimetres, the joints and the bind matrices say metres (glTF ignores the mesh node).
    GltfFile file = makePostRig();
    file.json["nodes"][4]["scale"] = {0.01, 0.01, 0.01};
    CHECK(distanceToPost(importedRig(file)) < 1e-5F);
}

TEST_CASE("vertices that are stretched into a box of their own come out in their shape") {
    const TemporaryFolder folder;
    makePostRig().saveBinary(folder / "plain.glb");
    const Character plain = imported(folder / "plain.glb");
    const mat4 turned = glm::rotate(mat4(1.0F), 0.5F, vec3(0, 1, 0));
    const mat4 boxes[] = {glm::scale(mat4(1.0F), vec3(2.0F, 1.0F, 0.5F)),
                          turned * glm::scale(mat4(1.0F), vec3(2.0F, 1.0F, 0.5F)),
                          glm::scale(glm::translate(mat4(1.0F), vec3(-0.3F, 0, -0.2F)),
                                     vec3(0.6F / 65535.0F, 1.8F / 65535.0F, 0.4F / 65535.0F))};
    for (const mat4& sceneFromMesh : boxes) {
        const Post post = makePost();
        GltfFile file;
        const int armature = file.addNode("Armature", -1);
        const int low = file.addNode("low", armature);
        const int middle = file.addNode("middle", low, glm::translate(mat4(1.0F), vec3(0, 0.6F, 0)));
        const int high = file.addNode("high", middle, glm::translate(mat4(1.0F), vec3(0, 0.6F, 0)));
        std::vector<mat4> jointFromMesh;
        for (const float height : {0.0F, 0.6F, 1.2F})
            jointFromMesh.push_back(glm::translate(mat4(1.0F), vec3(0, -height, 0)) * sceneFromMesh);
        const int mesh = addPostMesh(file, post, glm::inverse(sceneFromMesh));
        const int node = file.addNode("mesh", armature);
        file.json["nodes"][node]["mesh"] = mesh;
        file.json["nodes"][node]["skin"] = addSkin(file, {low, middle, high}, jointFromMesh);
        file.saveBinary(folder / "boxed.glb");
        const Character boxed = imported(folder / "boxed.glb");
        checkInvariants(boxed);
        const std::vector<vec3> got = bindVertices(boxed);
        const std::vector<vec3> wanted = bindVertices(plain);
        REQUIRE(got.size() == wanted.size());
        for (const vec3& point : got) {
            float nearest = 1e9F;
            for (const vec3& other : wanted)
                nearest = std::min(nearest, glm::distance(point, other));
            CHECK(nearest < 1e-4F);
        }
    }
}

TEST_CASE("joints that skin no vertex and joints without weights keep their place") {
    GltfFile file = makePostRig();
    file.addNode("end", 3, glm::translate(mat4(1.0F), vec3(0, 0.6F, 0)));
    const int side = file.addNode("side", 1, glm::translate(mat4(1.0F), vec3(0.5F, 0, 0)));
    const mat4 sideBind = glm::translate(mat4(1.0F), vec3(-0.5F, 0, 0));
    std::vector<mat4> binds;
    for (const float y : {0.0F, 0.6F, 1.2F})
        binds.push_back(glm::translate(mat4(1.0F), vec3(0, -y, 0)));
    binds.push_back(sideBind);
    file.json["nodes"][4]["skin"] = addSkin(file, {1, 2, 3, side}, binds);
    const Character character = importedRig(file);
    const Skeleton& skeleton = character.skeleton;
    CHECK(skeleton.skinWeight[joint(character, "end")] == 0.0F);
    CHECK(skeleton.skinWeight[joint(character, "side")] == 0.0F);
    CHECK(glm::distance(skeleton.bindModelFromJoint[joint(character, "end")].translation, vec3(0, 1.8F, 0)) < 1e-5F);
    CHECK(glm::distance(skeleton.bindModelFromJoint[joint(character, "side")].translation, vec3(0.5F, 0, 0)) < 1e-5F);
}

TEST_CASE("several roots come in side by side") {
    GltfFile file = makePostRig();
    file.json["nodes"][1]["children"].clear();
    file.json["nodes"][1].erase("children");
    file.json["scenes"][0]["nodes"].push_back(2);
    const Character character = importedRig(file);
    CHECK(distanceToPost(character) < 1e-5F);
    const Skeleton& skeleton = character.skeleton;
    CHECK(skeleton.parents[joint(character, "middle")] == skeleton.parents[joint(character, "Armature")]);
}

TEST_CASE("several meshes share the joints, and a second one has its own space") {
    GltfFile file = makePostRig();
    // The second copy is written in centimetres with bind matrices to match; its mesh node says nothing of it.
    const mat4 metresFromCentimetres = glm::scale(mat4(1.0F), vec3(0.01F));
    std::vector<mat4> binds;
    for (const float y : {0.0F, 0.6F, 1.2F})
        binds.push_back(glm::translate(mat4(1.0F), vec3(0, -y, 0)) * metresFromCentimetres);
    const int second = file.addNode("Coat", 0);
    file.json["nodes"][second]["mesh"] = addPostMesh(file, makePost(), glm::inverse(metresFromCentimetres));
    file.json["nodes"][second]["skin"] = addSkin(file, {1, 2, 3}, binds);
    const Character character = importedRig(file);
    REQUIRE(character.meshes.size() == 2);
    for (std::size_t v = 0; v < character.meshes[0].positions.size(); ++v)
        CHECK(glm::distance(character.meshes[0].positions[v], character.meshes[1].positions[v]) < 1e-5F);
    CHECK(character.skeleton.skinWeight[joint(character, "high")] == Approx(16));
}

TEST_CASE("a mesh without a skin follows the joint that it hangs on") {
    GltfFile file = makePostRig(glm::scale(mat4(1.0F), vec3(0.01F)));
    const int hat = file.addNode("Hat", 3, glm::translate(mat4(1.0F), vec3(0, 60, 0)));
    file.json["nodes"][hat]["mesh"] = addPostMesh(file, makePost(), glm::scale(mat4(1.0F), vec3(10.0F)), false);
    const Character character = importedRig(file);
    REQUIRE(character.meshes.size() == 2);
    const SkinnedMesh& rigid = character.meshes[character.meshes[0].rigid ? 0 : 1];
    CHECK(rigid.rigid);
    CHECK(character.skeleton.skinWeight[joint(character, "Hat")] == Approx(16));
    // A tenth of the post, standing on top of it.
    const Post post = makePost();
    for (std::size_t v = 0; v < rigid.positions.size(); ++v)
        CHECK(glm::distance(rigid.positions[v], 0.1F * post.positions[v] + vec3(0, 1.8F, 0)) < 1e-5F);
}

TEST_CASE("nodes that share a name are told apart") {
    SECTION("a mesh node with the name of the joint") {
        GltfFile file = makePostRig();
        file.json["nodes"][4]["name"] = "high";
        // The mesh node comes first in the tree.
        file.json["nodes"][0]["children"] = {4, 1};
        const Character character = importedRig(file);
        CHECK(distanceToPost(character) < 1e-5F);
        CHECK(character.skeleton.skinWeight[joint(character, "Armature/low/middle/high")] == Approx(8));
        CHECK(character.skeleton.skinWeight[joint(character, "Armature/high")] == 0.0F);
    }
    SECTION("two joints") {
        GltfFile file = makePostRig();
        file.json["nodes"][1]["name"] = "part";
        file.json["nodes"][3]["name"] = "part";
        const Character character = importedRig(file);
        CHECK(distanceToPost(character) < 1e-5F);
        CHECK(character.skeleton.skinWeight[joint(character, "Armature/part")] == Approx(4));
        CHECK(character.skeleton.skinWeight[joint(character, "Armature/part/middle/part")] == Approx(8));
    }
    SECTION("siblings") {
        GltfFile file = makePostRig();
        file.addNode("twin", 1);
        file.addNode("twin", 1);
        const Character character = importedRig(file);
        CHECK(joint(character, "Armature/low/twin") != joint(character, "Armature/low/twin#2"));
    }
}

TEST_CASE("more than four influences are cut to the strongest, and the loss is told") {
    GltfFile file;
    std::vector<int> nodes;
    for (int i = 0; i < 6; ++i)
        nodes.push_back(file.addNode("j" + std::to_string(i), nodes.empty() ? -1 : nodes.front()));
    const int body = file.addNode("Body", -1);
    const Post post = makePost();
    file.json["nodes"][body]["mesh"] = addPostMesh(file, post);
    file.json["nodes"][body]["skin"] = addSkin(file, nodes, std::vector<mat4>(6, mat4(1.0F)));
    // 0.05 on j5 and j0, 0.3, 0.25, 0.2 and 0.15 on the others.
    nlohmann::json& attributes = file.json["meshes"][0]["primitives"][0]["attributes"];
    std::vector<float> first;
    std::vector<float> second;
    for (std::size_t v = 0; v < post.positions.size(); ++v) {
        first.insert(first.end(), {0.05F, 0.3F, 0.25F, 0.2F});
        second.insert(second.end(), {0.15F, 0.05F, 0, 0});
    }
    const std::vector<std::array<std::uint8_t, 4>> lower(post.positions.size(), {0, 1, 2, 3});
    const std::vector<std::array<std::uint8_t, 4>> upper(post.positions.size(), {4, 5, 0, 0});
    attributes["JOINTS_0"] = file.addBytes4(lower);
    attributes["WEIGHTS_0"] = file.addFloats(first, "VEC4");
    attributes["JOINTS_1"] = file.addBytes4(upper);
    attributes["WEIGHTS_1"] = file.addFloats(second, "VEC4");
    const Character character = importedRig(file);
    CHECK(warns(character, "at most 10 %"));
    CHECK(character.meshes[0].weights[0][0] == Approx(0.3F / 0.9F));
    CHECK(character.skeleton.skinWeight[joint(character, "j5")] == 0.0F);
}

TEST_CASE("vertices without weights are bound to a deforming joint") {
    GltfFile file = makePostRig();
    Post post = makePost();
    post.skin[0].weights = {0, 0, 0, 0};
    file.json["nodes"][4]["mesh"] = addPostMesh(file, post);
    const Character character = importedRig(file);
    CHECK(warns(character, "1 of 16 vertices"));
    CHECK(character.meshes[0].joints[0][0] == joint(character, "low"));
    CHECK(distanceToPost(character) < 1e-5F);
}

TEST_CASE("weights that do not sum to one are normalised") {
    GltfFile file = makePostRig();
    Post post = makePost();
    post.skin[5] = {{1, 2, 0, 0}, {0.25F, 0.15F, 0, 0}};
    file.json["nodes"][4]["mesh"] = addPostMesh(file, post);
    const Character character = importedRig(file);
    CHECK(warns(character, "1 of 16 vertices did not sum to 1 (off by up to 0.6)"));
    int mended = 0;
    for (const auto& weights : character.meshes[0].weights) {
        if (weights[1] == 0.0F) continue;
        ++mended;
        CHECK(weights[0] == Approx(0.625F));
        CHECK(weights[1] == Approx(0.375F));
    }
    CHECK(mended == 1);
}

TEST_CASE("a clip is sampled to the known keyframes") {
    GltfFile file = makePostRig();
    file.json["nodes"][2].erase("matrix");
    file.json["nodes"][2]["translation"] = {0, 0.6, 0};
    const float half = std::sqrt(0.5F);
    const std::vector<float> times = {0.0F, 0.5F, 1.0F};
    const std::vector<float> turns = {0, 0, 0, 1, 0, 0, half, half, 0, 0, 0, 1};
    const std::vector<float> places = {0, 0.6F, 0, 0, 0.6F, 0.2F, 0, 0.6F, 0};
    const int input = file.addFloats(times, "SCALAR");
    file.json["animations"] = {{{"name", "nod"},
                                {"samplers",
                                 {{{"input", input}, {"output", file.addFloats(turns, "VEC4")}},
                                  {{"input", input}, {"output", file.addFloats(places, "VEC3")}}}},
                                {"channels",
                                 {{{"sampler", 0}, {"target", {{"node", 2}, {"path", "rotation"}}}},
                                  {{"sampler", 1}, {"target", {{"node", 2}, {"path", "translation"}}}}}}}};
    const Character character = importedRig(file);
    REQUIRE(character.clips.size() == 1);
    const Clip& clip = character.clips.front();
    CHECK(clip.name == "nod");
    CHECK(clip.seconds() == Approx(1.0F).margin(1e-4));
    CHECK(clip.framesPerSecond == Approx(30.0F));
    const int middle = joint(character, "middle");
    std::vector<RigidTransform> pose(character.skeleton.parents.size());
    sampleClip(clip, 0.5F, pose);
    CHECK(glm::distance(pose[middle].translation, vec3(0, 0.6F, 0.2F)) < 1e-5F);
    CHECK(std::abs(glm::dot(pose[middle].rotation, quat(half, 0, 0, half))) > 1.0F - 1e-5F);
    sampleClip(clip, 1.0F, pose);
    CHECK(glm::distance(pose[middle].translation, vec3(0, 0.6F, 0)) < 1e-5F);
    CHECK(std::abs(pose[middle].rotation.w) > 1.0F - 1e-5F);
}

TEST_CASE("a clip keeps the file's time, but does not wait for a far first key") {
    struct Case {
        float first;
        float seconds;
        float turnedAt;
    };
    for (const Case& each : {Case{0.5F, 1.5F, 1.0F}, Case{100.0F, 1.0F, 0.5F}}) {
        INFO(each.first);
        GltfFile file = makePostRig();
        file.json["nodes"][2].erase("matrix");
        file.json["nodes"][2]["translation"] = {0, 0.6, 0};
        const std::vector<float> times = {each.first, each.first + 0.5F, each.first + 1.0F};
        const std::vector<float> places = {0, 0.6F, 0, 0, 0.6F, 0.2F, 0, 0.6F, 0};
        file.json["animations"] = {
            {{"name", "nod"},
             {"samplers", {{{"input", file.addFloats(times, "SCALAR")}, {"output", file.addFloats(places, "VEC3")}}}},
             {"channels", {{{"sampler", 0}, {"target", {{"node", 2}, {"path", "translation"}}}}}}}};
        const Character character = importedRig(file);
        REQUIRE(character.clips.size() == 1);
        CHECK(character.clips[0].seconds() == Approx(each.seconds).margin(1e-3));
        std::vector<RigidTransform> pose(character.skeleton.parents.size());
        sampleClip(character.clips[0], each.turnedAt, pose);
        CHECK(pose[joint(character, "middle")].translation.z == Approx(0.2F).margin(1e-4));
    }
}
