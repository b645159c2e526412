// Real models: all that import promises, on each of them.

#include "support/zoo.hpp"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "animation/import/checks.hpp"
#include "animation/import/scene_oracle.hpp"
#include "animation/pose.hpp"
#include "animation/skinning.hpp"
#include "support/catch.hpp"

using namespace lutka;
using namespace lutka::animation;
using namespace lutka::test;

namespace {

struct Model {
    std::string folder;
    std::filesystem::path file;
    bool humanoid = false;
    bool refused = false;     // its bytes are damaged
    bool oracleKnows = true;  // false where Assimp's own tree is flat
};

std::vector<Model> models() {
    std::vector<Model> out;
    for (const auto& folder : std::filesystem::directory_iterator(LUTKA_ZOO_DIR)) {
        std::ifstream in(folder.path() / "truth.json");
        const nlohmann::json truth = nlohmann::json::parse(in, nullptr, false);
        if (!truth.is_object()) continue;
        Model model{folder.path().filename().string(), folder.path() / truth.value("file", "")};
        model.humanoid = truth["humanoid"] == true;
        model.refused = model.folder == "irrlicht_ninja_b3d";
        model.oracleKnows = model.folder != "hl1_man";
        out.push_back(model);
    }
    std::sort(out.begin(), out.end(), [](const Model& a, const Model& b) { return a.folder < b.folder; });
    return out;
}

// Height of vertices, or of the joints where there are none.
float heightOfSkin(const Character& character) {
    float low = 1e9F;
    float high = -1e9F;
    const auto add = [&](const vec3& p) {
        low = std::min(low, p.y);
        high = std::max(high, p.y);
    };
    for (const vec3& p : bindVertices(character))
        add(p);
    if (character.meshes.empty()) {
        for (const RigidTransform& frame : character.skeleton.bindModelFromJoint)
            add(frame.translation);
    }
    return high - low;
}

// The file's units and axes to model space, as `lutka inspect` states them.
vec3 toModel(const UnitInfo& units, const vec3& p) {
    const vec3 scaled = units.metresPerFileUnit * p;
    if (units.upAxis == "+Z") return {scaled.x, scaled.z, -scaled.y};
    CHECK(units.upAxis == "+Y");
    return scaled;
}

// Largest distance between the skin in the nodes' pose and the oracle's.
float nodePoseError(const Character& character, const std::filesystem::path& file) {
    const std::vector<OracleTriangle> expected = oracleTriangles(file);
    const std::vector<RigidTransform> pose = nodePose(character.skeleton);
    std::vector<SkinMatrix> palette(pose.size());
    skinMatrices(character.skeleton.bindModelFromJoint, pose, palette);
    std::size_t triangle = 0;
    float worst = 0.0F;
    for (const SkinnedMesh& mesh : character.meshes) {
        std::vector<vec3> posed(mesh.positions.size());
        skinVertices(mesh, palette, posed, {});
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3, ++triangle) {
            REQUIRE(triangle < expected.size());
            if (!expected[triangle].comparable) continue;
            // The corners' order may have been turned.
            for (const vec3& corner : expected[triangle].corners) {
                const vec3 goal = toModel(character.units, corner);
                float nearest = 1e9F;
                for (std::size_t k = 0; k < 3; ++k)
                    nearest = std::min(nearest, glm::distance(goal, posed[mesh.indices[i + k]]));
                worst = std::max(worst, nearest);
            }
        }
    }
    CHECK(triangle == expected.size());
    return worst;
}

// How far linear blending in double precision is from what skinVertices() gives: metres, and for directions radians.
// Directions that the blend nearly cancels have none and are left out.
struct SkinError {
    double position = 0;
    double direction = 0;
};
SkinError skinError(const SkinnedMesh& mesh, std::span<const SkinMatrix> palette) {
    const std::size_t count = mesh.positions.size();
    std::vector<vec3> positions(count);
    std::vector<vec3> normals(count);
    std::vector<vec4> tangents(mesh.tangents.size());
    skinVertices(mesh, palette, positions, normals, tangents);
    const auto blend = [&](std::size_t vertex, const vec4& v) {
        glm::dvec3 sum(0);
        for (std::size_t slot = 0; slot < 4; ++slot) {
            const glm::dvec4 wide(v);
            const auto& rows = palette[mesh.joints[vertex][slot]].rows;
            sum += static_cast<double>(mesh.weights[vertex][slot]) * glm::dvec3(glm::dot(glm::dvec4(rows[0]), wide),
                                                                                glm::dot(glm::dvec4(rows[1]), wide),
                                                                                glm::dot(glm::dvec4(rows[2]), wide));
        }
        return sum;
    };
    SkinError worst;
    const auto compareDirection = [&](const glm::dvec3& expected, const vec3& got) {
        if (glm::length(expected) < 0.05) return;
        worst.direction = std::max(worst.direction, glm::distance(glm::normalize(expected), glm::dvec3(got)));
    };
    for (std::size_t v = 0; v < count; ++v) {
        worst.position =
            std::max(worst.position, glm::distance(blend(v, vec4(mesh.positions[v], 1.0F)), glm::dvec3(positions[v])));
        compareDirection(blend(v, vec4(mesh.normals[v], 0.0F)), normals[v]);
        if (tangents.empty()) continue;
        compareDirection(blend(v, vec4(vec3(mesh.tangents[v]), 0.0F)), vec3(tangents[v]));
        CHECK(tangents[v].w == mesh.tangents[v].w);
    }
    return worst;
}

// Whether every instruction set gives the bits of the plain loop.
bool sameBitsOnAllSets(const SkinnedMesh& mesh, std::span<const SkinMatrix> palette) {
    const std::size_t count = mesh.positions.size();
    std::vector<vec3> positions[2] = {std::vector<vec3>(count), std::vector<vec3>(count)};
    std::vector<vec3> normals[2] = {std::vector<vec3>(count), std::vector<vec3>(count)};
    std::vector<vec4> tangents[2] = {std::vector<vec4>(mesh.tangents.size()), std::vector<vec4>(mesh.tangents.size())};
    skinVerticesByScalars(InstructionSet::baseline, mesh, palette, positions[0], normals[0], tangents[0]);
    bool same = true;
    for (const InstructionSet set : {InstructionSet::baseline, InstructionSet::avx2}) {
        if (!hasInstructionSet(set)) continue;
        skinVertices(set, mesh, palette, positions[1], normals[1], tangents[1]);
        same = same && positions[0] == positions[1] && normals[0] == normals[1] && tangents[0] == tangents[1];
    }
    return same;
}

}  // namespace

TEST_CASE("every model of the zoo loads, or is refused for its known damage") {
    NEEDS_ZOO();
    for (const Model& model : models()) {
        INFO(model.folder);
        const Result<Character> result = importCharacter(model.file);
        CHECK(result.ok() == !model.refused);
        if (!result.ok()) {
            CHECK(result.error().code == ErrorCode::input);
            continue;
        }
        checkInvariants(result.value());
        if (model.humanoid) {
            CHECK(heightOfSkin(result.value()) > 0.5F);
            CHECK(heightOfSkin(result.value()) < 3.0F);
        }
    }
}

TEST_CASE("the node pose of every zoo model shows what the file shows") {
    NEEDS_ZOO();
    for (const Model& model : models()) {
        INFO(model.folder);
        // Assimp cuts polygons of FBX otherwise than our reader, and loses some of its transforms; of IQM it loses the
        // joints, and the axis with them.
        const auto ending = model.file.extension();
        if (model.refused || !model.oracleKnows || ending == ".fbx" || ending == ".iqm") continue;
        const Character character = imported(model.file);
        const float error = nodePoseError(character, model.file) / heightOfSkin(character);
        std::printf("%-32s node pose against the formula: %.2e of the height\n", model.folder.c_str(), error);
        if (!warns(character, "nodes' pose scales joints")) CHECK(error < 1e-3F);
    }
}

TEST_CASE("wide skinning of every zoo model is the plain loop's, and both are the sum of the joints' motions") {
    NEEDS_ZOO();
    ImportOptions options;
    options.loadTextures = false;
    for (const Model& model : models()) {
        INFO(model.folder);
        const Result<Character> character = importCharacter(model.file, options);
        if (!character.ok()) continue;
        const Skeleton& skeleton = character.value().skeleton;
        std::vector<RigidTransform> pose = skeleton.nodeParentFromJoint;
        for (std::size_t joint = 0; joint < pose.size(); ++joint)
            pose[joint].rotation =
                pose[joint].rotation * glm::angleAxis(0.1F * static_cast<float>(joint % 7), vec3(0.6F, 0, 0.8F));
        localToModel(skeleton, pose, pose);
        std::vector<SkinMatrix> palette(pose.size());
        skinMatrices(skeleton.bindModelFromJoint, pose, palette);
        for (const SkinnedMesh& mesh : character.value().meshes) {
            const SkinError error = skinError(mesh, palette);
            CHECK(error.position < 1e-5);
            CHECK(error.direction < 1e-4);
            CHECK(sameBitsOnAllSets(mesh, palette));
        }
    }
}

TEST_CASE("a .vrm of the zoo is the same character as its .glb") {
    NEEDS_ZOO();
    const Character vrm = imported(zooFile("vrm_addon_example/Example.vrm"));
    const Character glb = imported(zooFile("vrm_addon_example/Example.glb"));
    CHECK(vrm.skeleton.names == glb.skeleton.names);
    CHECK(bindVertices(vrm) == bindVertices(glb));
    REQUIRE(vrm.vrmHumanoid.count("leftUpperArm") == 1);
    CHECK(vrm.skeleton.names[vrm.vrmHumanoid.at("leftUpperArm")] == "upper_arm.L");
    CHECK(vrm.vrmHumanoid == glb.vrmHumanoid);
}

TEST_CASE("a clip of an FBX with pivots that holds still holds the node pose") {
    NEEDS_ZOO();
    const Character character = imported(zooFile("rocketbox_male/Male_Adult_17.fbx"));
    REQUIRE(character.clips.size() == 1);
    std::vector<RigidTransform> pose(character.skeleton.parents.size());
    sampleClip(character.clips[0], 0.0F, pose);
    localToModel(character.skeleton, pose, pose);
    const std::vector<RigidTransform> expected = nodePose(character.skeleton);
    float worst = 0.0F;
    for (std::size_t joint = 0; joint < pose.size(); ++joint)
        worst = std::max(worst, glm::distance(pose[joint].translation, expected[joint].translation));
    CHECK(worst < 1e-3F);
}

TEST_CASE("a Half-Life model gets the hierarchy back that Assimp drops") {
    NEEDS_ZOO();
    const Character character = imported(zooFile("hl1_man/man.mdl"));
    const Skeleton& skeleton = character.skeleton;
    const std::string bones = "<MDL_root>/<MDL_bones>/";
    for (const char* path : {"Root/Pelvis/RightLeg", "Root/Pelvis/LeftLeg", "Root/Pelvis/Spine",
                             "Root/Pelvis/Spine/RightArm", "Root/Pelvis/Spine/LeftArm", "Root/Pelvis/Spine/Neck"}) {
        INFO(path);
        CHECK(findJoint(skeleton, bones + path) != kNoJoint);
    }
    CHECK(largestError(character, nodePose(skeleton), bindVertices(character)) < 1e-3F);
    REQUIRE_FALSE(character.clips.empty());
    CHECK(character.clips.front().name == "reference");
}
