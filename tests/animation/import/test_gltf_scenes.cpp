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

TEST_CASE("cameras beside a skeleton and its effectors do not enter its height") {
    // A figure of centimetres in a file of metres, with a second hierarchy beside it, and four cameras a metre away.
    const TemporaryFolder folder;
    GltfFile file;
    const int scene = file.addNode("VisualSceneNode", -1);
    int joint = file.addNode("Hips", scene, glm::translate(mat4(1.0F), vec3(0, 0.009F, 0)));
    for (int i = 0; i < 12; ++i)
        joint = file.addNode("Spine" + std::to_string(i), joint, glm::translate(mat4(1.0F), vec3(0, 0.0007F, 0)));
    int effector = file.addNode("humanIK1", scene, glm::translate(mat4(1.0F), vec3(0, 0.001F, 0)));
    for (int i = 0; i < 6; ++i)
        effector = file.addNode("Eff" + std::to_string(i), effector, glm::translate(mat4(1.0F), vec3(0, 0.001F, 0)));
    for (const vec3& place : {vec3(0, 0.02F, 0.005F), vec3(0, 1, 0), vec3(0, 0.02F, 1), vec3(1, 0.01F, 0)})
        file.addNode("camera", scene, glm::translate(mat4(1.0F), place));
    file.saveBinary(folder / "effectors.glb");
    const Character character = imported(folder / "effectors.glb");
    CHECK(character.units.metresPerFileUnit == Approx(100.0F));
    for (const RigidTransform& frame : character.skeleton.bindModelFromJoint)
        CHECK(glm::length(frame.translation) < 3.0F);
}

TEST_CASE("a figure is found in another scene than the one that the file shows, and its joints outside of any") {
    const TemporaryFolder folder;
    const Character plain = [&] {
        makePostRig().saveBinary(folder / "plain.glb");
        return imported(folder / "plain.glb");
    }();
    const auto check = [&](const GltfFile& file, bool told) {
        file.saveBinary(folder / "scenes.glb");
        const Character character = imported(folder / "scenes.glb");
        REQUIRE(character.meshes.size() == plain.meshes.size());
        CHECK(character.meshes[0].positions == plain.meshes[0].positions);
        CHECK(warns(character, "holds no figure") == told);
    };
    const nlohmann::json figure = makePostRig().json["scenes"][0];
    GltfFile stage = makePostRig();
    const int prop = stage.addNode("Lamp", -1);
    stage.json["scenes"] = {{{"nodes", {prop}}}, figure};
    stage.json.erase("scene");
    check(stage, false);
    stage.json["scene"] = 1;
    check(stage, false);
    stage.json["scene"] = 0;
    check(stage, true);

    GltfFile library = makePostRig();
    library.json["scenes"] = {nlohmann::json::object()};
    check(library, false);

    GltfFile meshAlone = makePostRig();
    for (int node = 0; node < static_cast<int>(meshAlone.json["nodes"].size()); ++node) {
        if (meshAlone.json["nodes"][node].contains("skin")) meshAlone.json["scenes"] = {{{"nodes", {node}}}};
    }
    check(meshAlone, false);
}

TEST_CASE("a mesh that was bound in another pose than the rest is told where it bends, and not where it does not") {
    const TemporaryFolder folder;
    for (const bool bends : {false, true}) {
        INFO(bends);
        // A coat around the post, bound while the uppermost joint was turned by 60 degrees.
        GltfFile file = makePostRig();
        Post coat = makePost();
        for (std::size_t v = 0; bends && v < coat.skin.size(); ++v) {
            if (coat.skin[v].joints[0] == 2) coat.skin[v] = {{1, 2}, {0.5F, 0.5F, 0, 0}};
        }
        std::vector<mat4> inverseBinds;
        for (int i = 0; i < 3; ++i)
            inverseBinds.push_back(glm::translate(mat4(1.0F), vec3(0, -0.6F * static_cast<float>(i), 0)));
        inverseBinds[2] = glm::rotate(mat4(1.0F), glm::radians(60.0F), vec3(0, 0, 1)) * inverseBinds[2];
        const int node = file.addNode("Coat", 0);
        file.json["nodes"][node]["mesh"] = addPostMesh(file, coat);
        file.json["nodes"][node]["skin"] = addSkin(file, {1, 2, 3}, inverseBinds);
        file.json["meshes"][1]["name"] = "Coat";
        file.saveBinary(folder / "coat.glb");
        const Character character = imported(folder / "coat.glb");
        CHECK(warns(character, "bound in another pose than the rest of the figure: Coat") == bends);
    }
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

TEST_CASE("a floor and a ceiling that face each other are not inside out") {
    const TemporaryFolder folder;
    Post room;
    room.positions = {{0, 0, 0},    {1, 0, 0},    {1, 0, 1},    {0, 0, 1},
                      {0, 1.8F, 0}, {1, 1.8F, 0}, {1, 1.8F, 1}, {0, 1.8F, 1}};
    room.skin.resize(room.positions.size());
    room.indices = {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7};
    GltfFile file;
    const int node = file.addNode("Room", -1);
    file.json["nodes"][node]["mesh"] = addPostMesh(file, room, mat4(1.0F), false);
    file.saveBinary(folder / "room.glb");
    const Character character = imported(folder / "room.glb");
    CHECK_FALSE(warns(character, "point inwards"));
    REQUIRE(character.meshes.size() == 1);
    const SkinnedMesh& mesh = character.meshes[0];
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
        CHECK((mesh.positions[v].y < 0.5F ? 1.0F : -1.0F) * mesh.normals[v].y > 0.9F);
}

TEST_CASE("sheets that face each other are not inside out") {
    const TemporaryFolder folder;
    // A floor and a wall behind it, both seen from where one would stand.
    Post corner;
    corner.positions = {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}, {0, 0, 0}, {1, 0, 0}, {1, 1.8F, 0}, {0, 1.8F, 0}};
    corner.skin.resize(corner.positions.size());
    corner.indices = {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7};
    GltfFile file;
    const int node = file.addNode("Corner", -1);
    file.json["nodes"][node]["mesh"] = addPostMesh(file, corner, mat4(1.0F), false);
    file.saveBinary(folder / "corner.glb");
    const Character character = imported(folder / "corner.glb");
    CHECK_FALSE(warns(character, "point inwards"));
    REQUIRE(character.meshes.size() == 1);
    const SkinnedMesh& mesh = character.meshes[0];
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        if (mesh.positions[v].z > 0.1F) CHECK(mesh.normals[v].y > 0.9F);
    }
}

namespace {

// A skeleton as exporters of clips alone write it: no pose of the nodes, all of it in the channels. It crouches, then
// stands.
GltfFile makeRise() {
    GltfFile file;
    struct Limb {
        const char* name;
        int parent;
        vec3 place;
    };
    const std::vector<Limb> limbs{{"Hips", -1, {0, 1, 0}},
                                  {"Spine", 0, {0, 0.2F, 0}},
                                  {"Head", 1, {0, 0.4F, 0}},
                                  {"LeftUpLeg", 0, {0.1F, -0.05F, 0}},
                                  {"LeftLeg", 3, {0, -0.45F, 0}},
                                  {"LeftFoot", 4, {0, -0.42F, 0}},
                                  {"RightUpLeg", 0, {-0.1F, -0.05F, 0}},
                                  {"RightLeg", 6, {0, -0.45F, 0}},
                                  {"RightFoot", 7, {0, -0.42F, 0}},
                                  {"LeftArm", 1, {0.2F, 0.25F, 0}},
                                  {"LeftForeArm", 9, {0.28F, 0, 0}},
                                  {"LeftHand", 10, {0.25F, 0, 0}},
                                  {"RightArm", 1, {-0.2F, 0.25F, 0}},
                                  {"RightForeArm", 12, {-0.28F, 0, 0}},
                                  {"RightHand", 13, {-0.25F, 0, 0}}};
    const std::vector<float> times{0, 1};
    nlohmann::json clip = {{"name", "rise"}};
    for (const Limb& limb : limbs) {
        const int node = file.addNode(limb.name, limb.parent);
        const vec3 low = limb.place.y < -0.3F ? vec3(0, 0.1F, 0.4F) : limb.place;
        const std::vector<float> values{low.x, low.y, low.z, limb.place.x, limb.place.y, limb.place.z};
        clip["samplers"].push_back({{"input", file.addFloats(times, "SCALAR")},
                                    {"output", file.addFloats(values, "VEC3")},
                                    {"interpolation", "LINEAR"}});
        clip["channels"].push_back(
            {{"sampler", clip["samplers"].size() - 1}, {"target", {{"node", node}, {"path", "translation"}}}});
    }
    file.json["animations"].push_back(clip);
    return file;
}

void checkStands(const GltfFile& file) {
    const TemporaryFolder folder;
    file.saveBinary(folder / "rise.glb");
    const Character character = imported(folder / "rise.glb");
    CHECK(warns(character, "no figure"));
    const auto at = [&](const char* name) {
        return character.skeleton.bindModelFromJoint[findJoint(character.skeleton, name)].translation;
    };
    CHECK(glm::distance(at("LeftFoot"), vec3(0.1F, 0.08F, 0)) < 0.05F);
    CHECK(glm::distance(at("RightHand"), vec3(-0.73F, 1.45F, 0)) < 0.05F);
}

}  // namespace

TEST_CASE("joints without places of their own take those of the clip's plainest frame") {
    checkStands(makeRise());
}

TEST_CASE("a rigid face says nothing of where a bare skeleton's joints are, nor how tall it is") {
    GltfFile file = makeRise();
    // Locks of hair that make half of all joints.
    for (int lock = 0; lock < 15; ++lock)
        file.addNode("Lock" + std::to_string(lock), 2);
    constexpr float kSize = 0.1F;
    const int face = addPostMesh(file, makePost(), glm::scale(mat4(1.0F), vec3(kSize)), false);
    file.json["nodes"][2]["mesh"] = face;
    checkStands(file);
}

TEST_CASE("a figure whose materials all have alpha 0 is shown, with a word, and a single unseen part stays unseen") {
    const auto rigOf = [](const char* mode, std::initializer_list<float> alphas) {
        GltfFile file = makePostRig();
        const nlohmann::json post = file.json["meshes"][0]["primitives"][0];
        file.json["meshes"][0]["primitives"] = nlohmann::json::array();
        for (const float alpha : alphas) {
            nlohmann::json primitive = post;
            primitive["material"] = file.json["materials"].size();
            file.json["meshes"][0]["primitives"].push_back(primitive);
            file.json["materials"].push_back(
                {{"alphaMode", mode}, {"pbrMetallicRoughness", {{"baseColorFactor", {0.1, 0.2, 0.3, alpha}}}}});
        }
        const TemporaryFolder folder;
        file.saveBinary(folder / "rig.glb");
        return imported(folder / "rig.glb");
    };
    for (const char* mode : {"MASK", "BLEND"}) {
        INFO(mode);
        const Character unseen = rigOf(mode, {0.0F, 0.0F});
        CHECK(warns(unseen, "fully transparent"));
        for (const Material& material : unseen.materials) {
            CHECK(material.alphaMode == Material::AlphaMode::opaque);
            CHECK(material.baseColor == vec4(0.1F, 0.2F, 0.3F, 1.0F));
        }
        const Character glass = rigOf(mode, {0.0F, 1.0F});
        CHECK_FALSE(warns(glass, "fully transparent"));
        CHECK(glass.materials[0].baseColor.a == 0.0F);
    }
    CHECK_FALSE(warns(rigOf("OPAQUE", {0.0F, 0.0F}), "fully transparent"));
}
