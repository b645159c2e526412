// What is written is read back with the importer and must be the same character.

#include <algorithm>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <sstream>

#include "animation/export/write_glb.hpp"
#include "animation/export/write_obj.hpp"
#include "animation/import/checks.hpp"
#include "animation/import/gltf_file.hpp"
#include "animation/pose.hpp"
#include "core/files.hpp"
#include "support/catch.hpp"
#include "support/rigs.hpp"
#include "support/zoo.hpp"

using namespace lutka;
using namespace lutka::animation;
using namespace lutka::test;

namespace {

std::string bytesOf(const std::filesystem::path& file) {
    const auto bytes = readFile(file);
    REQUIRE(bytes.ok());
    return {bytes.value().begin(), bytes.value().end()};
}

// The reader puts the scene's root and our wrapper before the joints; the first joint's place among the read ones.
int firstJointIn(const Character& read, const Character& written) {
    for (int joint = 0; joint + written.skeleton.jointCount() <= read.skeleton.jointCount(); ++joint) {
        if (std::equal(written.skeleton.names.begin(), written.skeleton.names.end(),
                       read.skeleton.names.begin() + joint)) {
            return joint;
        }
    }
    FAIL("the joints' names did not come back in order");
    return -1;
}

float frameDistance(const RigidTransform& a, const RigidTransform& b) {
    const float turn = 1.0F - std::abs(glm::dot(a.rotation, b.rotation));
    return std::max(glm::distance(a.translation, b.translation), std::sqrt(std::max(0.0F, turn)) * 1e-2F);
}

// The joint's weight on the vertex; equal weights may come in any order.
float weightOf(const SkinnedMesh& mesh, std::size_t vertex, int joint) {
    float weight = 0.0F;
    for (int i = 0; i < kMaxInfluences; ++i)
        weight += mesh.joints[vertex][i] == joint ? mesh.weights[vertex][i] : 0.0F;
    return weight;
}

// Skeleton, vertices and weights of both, to `tolerance` metres.
void checkSame(const Character& written, const Character& read, float tolerance) {
    const int first = firstJointIn(read, written);
    float worst = 0.0F;
    for (int joint = 0; joint < written.skeleton.jointCount(); ++joint) {
        const int parent = written.skeleton.parents[joint];
        if (parent != kNoJoint) CHECK(read.skeleton.parents[first + joint] == first + parent);
        worst = std::max(worst, frameDistance(written.skeleton.bindModelFromJoint[joint],
                                              read.skeleton.bindModelFromJoint[first + joint]));
        CHECK(read.skeleton.skinWeight[first + joint] == Approx(written.skeleton.skinWeight[joint]).margin(1e-2));
    }
    CHECK(worst < tolerance);
    REQUIRE(read.meshes.size() == written.meshes.size());
    for (std::size_t m = 0; m < written.meshes.size(); ++m) {
        const SkinnedMesh& a = written.meshes[m];
        const SkinnedMesh& b = read.meshes[m];
        REQUIRE(a.positions.size() == b.positions.size());
        REQUIRE(a.indices.size() == b.indices.size());
        CHECK(a.material == b.material);
        float apart = 0.0F;
        int otherSkin = 0;
        // Corner by corner: joints of equal weight may change places, and vertices are ordered by their joints.
        for (std::size_t corner = 0; corner < a.indices.size(); ++corner) {
            const std::uint32_t v = a.indices[corner];
            const std::uint32_t w = b.indices[corner];
            apart = std::max(apart, glm::distance(a.positions[v], b.positions[w]));
            for (int i = 0; i < kMaxInfluences; ++i) {
                const float back = weightOf(b, w, a.joints[v][i] + first);
                otherSkin += a.weights[v][i] > 0.0F && std::abs(a.weights[v][i] - back) > 1e-5F ? 1 : 0;
            }
        }
        CHECK(apart < tolerance);
        CHECK(otherSkin == 0);
    }
}

void checkSameClips(const Character& written, const Character& read, float tolerance) {
    const int first = firstJointIn(read, written);
    const std::size_t joints = written.skeleton.parents.size();
    std::vector<RigidTransform> a(joints);
    std::vector<RigidTransform> b(read.skeleton.parents.size());
    std::vector<RigidTransform> aModel(joints);
    std::vector<RigidTransform> bModel(b.size());
    for (const Clip& clip : written.clips) {
        const auto same = std::find_if(read.clips.begin(), read.clips.end(),
                                       [&](const Clip& other) { return other.name == clip.name; });
        // A clip that holds the bind pose is not written.
        if (same == read.clips.end()) continue;
        CHECK(same->seconds() <= clip.seconds() + 1e-3F);
        float worst = 0.0F;
        for (int frame = 0; frame < clip.frameCount; ++frame) {
            const float seconds = static_cast<float>(frame) / clip.framesPerSecond;
            sampleClip(clip, seconds, a);
            sampleClip(*same, seconds, b);
            localToModel(written.skeleton, a, aModel);
            localToModel(read.skeleton, b, bModel);
            for (std::size_t joint = 0; joint < joints; ++joint) {
                worst = std::max(worst, glm::distance(aModel[joint].translation,
                                                      bModel[static_cast<std::size_t>(first) + joint].translation));
            }
        }
        INFO(clip.name);
        CHECK(worst < tolerance);
    }
}

// The biped with a clip that bends the left elbow and one that lifts the hips.
Character movingBiped() {
    Character biped = makeBiped();
    const int elbow = findJoint(biped.skeleton, "leftLowerArm");
    std::vector<RigidTransform> rest(biped.skeleton.parents.size());
    modelToLocal(biped.skeleton, biped.skeleton.bindModelFromJoint, rest);
    Clip bend{"bend", 30.0F, 31, {}, {}};
    Clip lift{"lift", 60.0F, 61, {}, {}};
    for (int frame = 0; frame < bend.frameCount; ++frame) {
        std::vector<RigidTransform> pose = rest;
        pose[elbow].rotation = glm::angleAxis(0.05F * static_cast<float>(frame), vec3(0, 1, 0));
        bend.parentFromJoint.append(pose);
    }
    for (int frame = 0; frame < lift.frameCount; ++frame) {
        std::vector<RigidTransform> pose = rest;
        pose[0].translation.y += 0.3F * std::sin(0.1F * static_cast<float>(frame));
        lift.parentFromJoint.append(pose);
    }
    biped.clips = {bend, lift};
    return biped;
}

}  // namespace

TEST_CASE("a character comes back from its .glb as it was") {
    const TemporaryFolder folder;
    Character biped = movingBiped();
    Texture checker{"checker", 2, 2, {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 128, 9, 8, 7, 0}};
    biped.textures.push_back(checker);
    biped.vrmHumanoid = {{"hips", 0}, {"spine", 1}};
    Material& material = biped.materials[0];
    material = {"skin", {0.5F, 0.25F, 0.125F, 0.75F}, 0.3F, 0.6F, {0.5F, 1.0F, 4.0F}, Material::AlphaMode::mask, 0.4F,
                true};
    material.baseColorTexture = 0;
    REQUIRE(writeGlb(folder / "biped.glb", biped, biped.clips).ok());
    const Character read = imported(folder / "biped.glb");
    checkInvariants(read);
    checkSame(biped, read, 1e-5F);
    REQUIRE(read.vrmHumanoid.size() == biped.vrmHumanoid.size());
    for (const auto& [role, joint] : biped.vrmHumanoid)
        CHECK(read.skeleton.names[read.vrmHumanoid.at(role)] == biped.skeleton.names[joint]);
    REQUIRE(read.clips.size() == 2);
    checkSameClips(biped, read, 1e-5F);
    const Material& back = read.materials[0];
    CHECK(back.name == "skin");
    CHECK(glm::distance(back.baseColor, material.baseColor) < 1e-6F);
    CHECK(back.metallic == Approx(0.3F));
    CHECK(back.roughness == Approx(0.6F));
    CHECK(glm::distance(back.emissive, material.emissive) < 1e-6F);
    CHECK(back.alphaMode == Material::AlphaMode::mask);
    CHECK(back.alphaCutoff == Approx(0.4F));
    CHECK(back.doubleSided);
    REQUIRE(read.textures.size() == 1);
    CHECK(read.textures[0].rgba == checker.rgba);
}

TEST_CASE("vertex colours, and channels that jump, come back from the .glb") {
    const TemporaryFolder folder;
    Character biped = movingBiped();
    SkinnedMesh& mesh = biped.meshes[0];
    for (const vec3& position : mesh.positions)
        mesh.colors.emplace_back(std::abs(position.y) / 2.0F, 0.5F, 0.25F, 0.75F);
    const auto elbow = static_cast<std::size_t>(findJoint(biped.skeleton, "leftLowerArm"));
    biped.clips[0].steppedRotations.assign(biped.skeleton.parents.size(), false);
    biped.clips[0].steppedRotations[elbow] = true;
    REQUIRE(writeGlb(folder / "biped.glb", biped, biped.clips).ok());
    const Character read = imported(folder / "biped.glb");
    checkSame(biped, read, 1e-5F);
    REQUIRE(read.meshes[0].colors.size() == read.meshes[0].positions.size());
    for (std::size_t corner = 0; corner < mesh.indices.size(); ++corner) {
        const vec4 written = mesh.colors[mesh.indices[corner]];
        CHECK(glm::distance(read.meshes[0].colors[read.meshes[0].indices[corner]], written) < 1e-6F);
    }
    const auto clip =
        std::find_if(read.clips.begin(), read.clips.end(), [](const Clip& c) { return c.name == "bend"; });
    REQUIRE(clip != read.clips.end());
    const std::size_t first = static_cast<std::size_t>(firstJointIn(read, biped));
    REQUIRE(clip->steppedRotations.size() > first + elbow);
    CHECK(clip->steppedRotations[first + elbow]);
    CHECK(clip->steppedTranslations.empty());
}

TEST_CASE("the same character gives the same bytes") {
    const TemporaryFolder folder;
    const Character biped = movingBiped();
    REQUIRE(writeGlb(folder / "a.glb", biped, biped.clips).ok());
    REQUIRE(writeGlb(folder / "b.glb", biped, biped.clips).ok());
    CHECK(bytesOf(folder / "a.glb") == bytesOf(folder / "b.glb"));
}

TEST_CASE("the wrapper node carries the character into the world") {
    const TemporaryFolder folder;
    const Character biped = makeBiped();
    const RigidTransform worldFromModel{glm::angleAxis(0.7F, vec3(0, 1, 0)), {1, 0, -2}};
    REQUIRE(writeGlb(folder / "biped.glb", biped, {}, worldFromModel).ok());
    const Character read = imported(folder / "biped.glb");
    const int first = firstJointIn(read, biped);
    const std::vector<RigidTransform> pose = nodePose(read.skeleton);
    for (int joint = 0; joint < biped.skeleton.jointCount(); ++joint) {
        const RigidTransform expected = worldFromModel * biped.skeleton.bindModelFromJoint[joint];
        CHECK(frameDistance(pose[first + joint], expected) < 1e-5F);
    }
}

TEST_CASE("names that are not UTF-8 are written all the same") {
    const TemporaryFolder folder;
    Character biped = makeBiped();
    biped.skeleton.names[1] = "B\xfcste \xe2\x82 \xe5\xb7\xa6\xe8\x85\x95";
    REQUIRE(writeGlb(folder / "biped.glb", biped, {}).ok());
    const Character read = imported(folder / "biped.glb");
    CHECK(findJoint(read.skeleton, "B?ste ?? \xe5\xb7\xa6\xe8\x85\x95") != kNoJoint);
}

TEST_CASE("what can't be written is an output error and leaves nothing behind") {
    const Character biped = makeBiped();
    const std::vector<SkinMatrix> palette(biped.skeleton.parents.size());
    const Result<void> glb = writeGlb("/dev/null/biped.glb", biped, {});
    REQUIRE_FALSE(glb.ok());
    CHECK(glb.error().code == ErrorCode::output);
    const Result<void> obj = writeObj("/dev/null/biped.obj", biped, palette);
    REQUIRE_FALSE(obj.ok());
    CHECK(obj.error().code == ErrorCode::output);
}

TEST_CASE("the .obj holds the skinned vertices in the character's order") {
    const TemporaryFolder folder;
    const Character biped = movingBiped();
    std::vector<RigidTransform> local(biped.skeleton.parents.size());
    std::vector<RigidTransform> model(local.size());
    std::vector<SkinMatrix> palette(local.size());
    sampleClip(biped.clips[0], 1.0F, local);
    localToModel(biped.skeleton, local, model);
    skinMatrices(biped.skeleton.bindModelFromJoint, model, palette);
    const RigidTransform worldFromModel{glm::angleAxis(0.3F, vec3(0, 1, 0)), {0, 1, 0}};
    REQUIRE(writeObj(folder / "posed.obj", biped, palette, worldFromModel).ok());

    const SkinnedMesh& mesh = biped.meshes[0];
    std::vector<vec3> posed(mesh.positions.size());
    skinVertices(mesh, palette, posed, {});
    std::ifstream in(folder / "posed.obj");
    std::string line;
    std::size_t vertices = 0;
    std::size_t normals = 0;
    std::size_t faces = 0;
    float worst = 0.0F;
    while (std::getline(in, line)) {
        std::istringstream words(line);
        std::string kind;
        words >> kind;
        if (kind == "v") {
            vec3 p;
            words >> p.x >> p.y >> p.z;
            REQUIRE(vertices < posed.size());
            worst = std::max(worst, glm::distance(p, worldFromModel * posed[vertices++]));
        }
        normals += kind == "vn" ? 1 : 0;
        faces += kind == "f" ? 1 : 0;
    }
    CHECK(vertices == posed.size());
    CHECK(normals == posed.size());
    CHECK(faces == mesh.indices.size() / 3);
    CHECK(worst < 1e-6F);
    checkInvariants(imported(folder / "posed.obj"));
}

TEST_CASE("zoo models come back from their .glb as they were") {
    NEEDS_ZOO();
    const TemporaryFolder folder;
    for (const char* model :
         {"cesium_man_glb/CesiumMan.glb", "kaykit_rogue/Rogue_Hooded.glb", "lumberjack_rigify/lumberjack.glb",
          "rocketbox_male/Male_Adult_17.fbx", "quaternius_man_fbx/Male_Casual.fbx", "sl_male_bento/male_bento.dae",
          "godot_mannequiny/mannequiny.glb", "raylib_robot/robot.glb", "vrm_addon_example/Example.glb"}) {
        INFO(model);
        const Character written = imported(zooFile(model));
        REQUIRE(writeGlb(folder / "copy.glb", written, written.clips).ok());
        const Character read = imported(folder / "copy.glb");
        checkInvariants(read);
        CHECK(read.units.unitSource == "glTF");
        checkSame(written, read, 2e-5F);
        checkSameClips(written, read, 2e-5F);
    }
}
