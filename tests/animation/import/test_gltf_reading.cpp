// What glTF's specification allows and exporters write: number formats, keys, buffers, joints by index, other figures.

#include <cmath>
#include <fstream>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "animation/import/checks.hpp"
#include "animation/import/gltf_file.hpp"
#include "animation/pose.hpp"
#include "support/catch.hpp"

using namespace lutka;
using namespace lutka::animation;
using namespace lutka::test;

namespace {

// Where a joint points its y axis at a time of the first clip.
vec3 directionAt(const Character& character, int joint, float seconds) {
    std::vector<RigidTransform> pose(character.skeleton.parents.size());
    sampleClip(character.clips.at(0), seconds, pose);
    localToModel(character.skeleton, pose, pose);
    return pose[joint].rotation * vec3(0, 1, 0);
}

int jointNamed(const Character& character, const std::string& name) {
    const int joint = findJoint(character.skeleton, name);
    REQUIRE(joint != kNoJoint);
    return joint;
}

std::vector<float> quarterTurn() {
    const float half = std::sqrt(0.5F);
    return {0, 0, 0, 1, 0, 0, half, half};
}

float largestDifference(const std::vector<vec3>& a, const std::vector<vec3>& b) {
    REQUIRE(a.size() == b.size());
    float worst = 0.0F;
    for (std::size_t i = 0; i < a.size(); ++i)
        worst = std::max(worst, glm::distance(a[i], b[i]));
    return worst;
}

}  // namespace

TEST_CASE("normalised weights and quantised positions are read as the fractions that they are") {
    const TemporaryFolder folder;
    GltfFile plain = makePostRig();
    plain.saveBinary(folder / "plain.glb");
    GltfFile file = makePostRig();
    const Post post = makePost();
    std::vector<std::int16_t> positions;
    for (const vec3& p : post.positions) {
        for (int i = 0; i < 3; ++i)
            positions.push_back(static_cast<std::int16_t>(std::lround(p[i] / 2.0F * 32767.0F)));
        positions.push_back(0);  // elements start at multiples of four bytes
    }
    std::vector<std::uint8_t> weights;
    for (const HandSkin& skin : post.skin) {
        for (const float weight : skin.weights)
            weights.push_back(static_cast<std::uint8_t>(std::lround(weight * 255.0F)));
    }
    auto& attributes = file.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["POSITION"] = file.addComponents<std::int16_t>(positions, 5122, "VEC3", post.positions.size(), true);
    const int view = file.json["accessors"][attributes["POSITION"].get<int>()]["bufferView"];
    file.json["bufferViews"][view]["byteStride"] = 8;
    attributes["WEIGHTS_0"] = file.addComponents<std::uint8_t>(weights, 5121, "VEC4", post.skin.size(), true);
    // The mesh's unit is two metres.
    const int matrices = file.json["skins"][0]["inverseBindMatrices"];
    static_cast<void>(matrices);
    std::vector<float> scaled;
    for (int joint = 0; joint < 3; ++joint) {
        const mat4 jointFromMesh = glm::translate(mat4(1.0F), vec3(0, -0.6F * static_cast<float>(joint), 0)) *
                                   glm::scale(mat4(1.0F), vec3(2.0F));
        for (int i = 0; i < 16; ++i)
            scaled.push_back(jointFromMesh[i / 4][i % 4]);
    }
    file.json["skins"][0]["inverseBindMatrices"] = file.addFloats(scaled, "MAT4");
    file.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    file.saveBinary(folder / "packed.glb");
    const Character expected = imported(folder / "plain.glb");
    const Character character = imported(folder / "packed.glb");
    checkInvariants(character);
    CHECK_FALSE(warns(character, "did not sum"));
    CHECK(largestDifference(bindVertices(character), bindVertices(expected)) < 1e-3F);
}

TEST_CASE("the bind pose stands where the joints do, though a quantised mesh has its origin elsewhere") {
    const TemporaryFolder folder;
    makePostRig().saveBinary(folder / "plain.glb");
    GltfFile file = makePostRig();
    // Fractions of a box of 2.5 m from (-0.5, -0.7, -0.4) on, unpacked by the inverse bind matrices alone.
    const vec3 corner(-0.5F, -0.7F, -0.4F);
    const float side = 2.5F;
    std::vector<std::uint16_t> positions;
    const Post post = makePost();
    for (const vec3& p : post.positions) {
        for (int i = 0; i < 3; ++i)
            positions.push_back(static_cast<std::uint16_t>(std::lround((p[i] - corner[i]) / side * 65535.0F)));
        positions.push_back(0);  // elements start at multiples of four bytes
    }
    auto& attributes = file.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["POSITION"] = file.addComponents<std::uint16_t>(positions, 5123, "VEC3", post.positions.size(), true);
    const int view = file.json["accessors"][attributes["POSITION"].get<int>()]["bufferView"];
    file.json["bufferViews"][view]["byteStride"] = 8;
    std::vector<float> matrices;
    for (int joint = 0; joint < 3; ++joint) {
        const mat4 jointFromMesh = glm::translate(mat4(1.0F), corner - vec3(0, 0.6F * static_cast<float>(joint), 0)) *
                                   glm::scale(mat4(1.0F), vec3(side));
        for (int i = 0; i < 16; ++i)
            matrices.push_back(jointFromMesh[i / 4][i % 4]);
    }
    file.json["skins"][0]["inverseBindMatrices"] = file.addFloats(matrices, "MAT4");
    file.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    file.saveBinary(folder / "packed.glb");
    const Character character = imported(folder / "packed.glb");
    checkInvariants(character);
    CHECK(largestDifference(bindVertices(character), bindVertices(imported(folder / "plain.glb"))) < 1e-4F);
}

TEST_CASE("a stride that leads out of the buffer is refused, however large") {
    // The way to the last of so many elements is 2 to the 64th, which is 0 in a size.
    const TemporaryFolder folder;
    GltfFile file = makePostRig();
    const int accessor = file.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"];
    file.json["accessors"][accessor]["count"] = (1U << 24U) + 1;
    const int view = file.json["accessors"][accessor]["bufferView"];
    for (const std::uint64_t stride : {std::uint64_t{1} << 40U, std::uint64_t{1'000'000'000'000'000}}) {
        file.json["bufferViews"][view]["byteStride"] = stride;
        file.saveBinary(folder / "rig.glb");
        const auto character = importCharacter(folder / "rig.glb");
        REQUIRE_FALSE(character);
        CHECK(character.error().message.find("ends before its accessor's 16777217 elements do") != std::string::npos);
    }
}

TEST_CASE("rotations in shorts turn as far as floats do") {
    const TemporaryFolder folder;
    GltfFile file = makePostRig();
    const std::vector<float> times = {0, 1};
    std::vector<std::int16_t> turns;
    for (const float component : quarterTurn())
        turns.push_back(static_cast<std::int16_t>(std::lround(component * 32767.0F)));
    const int values = file.addComponents<std::int16_t>(turns, 5122, "VEC4", 2, true);
    file.addTurn("turn", 2, times, values, "LINEAR");
    file.saveBinary(folder / "rig.glb");
    const Character character = imported(folder / "rig.glb");
    const std::string name = file.json["nodes"][2]["name"];
    CHECK(glm::distance(directionAt(character, jointNamed(character, name), 1.0F), vec3(-1, 0, 0)) < 1e-3F);
}

TEST_CASE("a stepped clip never shows a pose in between, and a spline follows its tangents") {
    const TemporaryFolder folder;
    const std::vector<float> times = {0, 1};
    GltfFile stepped = makePostRig();
    stepped.addTurn("turn", 2, times, stepped.addFloats(quarterTurn(), "VEC4"), "STEP");
    stepped.saveBinary(folder / "stepped.glb");
    const Character jumps = imported(folder / "stepped.glb");
    const int joint = jointNamed(jumps, stepped.json["nodes"][2]["name"]);
    CHECK(glm::distance(directionAt(jumps, joint, 0.99F), vec3(0, 1, 0)) < 1e-3F);
    CHECK(glm::distance(directionAt(jumps, joint, 1.0F), vec3(-1, 0, 0)) < 1e-3F);

    // Flat tangents ease in and out: a tenth of the way is passed later than on a straight line.
    GltfFile spline = makePostRig();
    const std::vector<float> turn = quarterTurn();
    std::vector<float> keys(24, 0.0F);
    std::copy(turn.begin(), turn.begin() + 4, keys.begin() + 4);
    std::copy(turn.begin() + 4, turn.end(), keys.begin() + 16);
    spline.addTurn("turn", 2, times, spline.addFloats(keys, "VEC4"), "CUBICSPLINE");
    spline.saveBinary(folder / "spline.glb");
    const Character eases = imported(folder / "spline.glb");
    const float t = 0.1F;
    const float eased = 3 * t * t - 2 * t * t * t;
    const quat expected = glm::normalize(quat(1 - eased + eased * turn[7], 0, 0, eased * turn[6]));
    CHECK(glm::distance(directionAt(eases, joint, t), expected * vec3(0, 1, 0)) < 2e-3F);
}

TEST_CASE("a joint may jump in one channel and move smoothly in the other") {
    const TemporaryFolder folder;
    const std::vector<float> times = {0, 1};
    const std::vector<float> moves = {0, 0.6F, 0, 0, 1.6F, 0};
    const std::vector<float> turn = quarterTurn();
    std::vector<float> flat(24, 0.0F);  // the turn with tangents of nothing: half way at half the time
    std::copy(turn.begin(), turn.begin() + 4, flat.begin() + 4);
    std::copy(turn.begin() + 4, turn.end(), flat.begin() + 16);
    const vec3 halfTurned = glm::normalize(vec3(-1, 1, 0));
    for (const char* turning : {"STEP", "LINEAR", "CUBICSPLINE"}) {
        for (const char* moving : {"STEP", "LINEAR"}) {
            INFO(turning << ' ' << moving);
            GltfFile file = makePostRig();
            const bool spline = std::string(turning) == "CUBICSPLINE";
            file.addTurn("both", 2, times, file.addFloats(spline ? flat : turn, "VEC4"), turning);
            auto& clip = file.json["animations"][0];
            clip["samplers"].push_back({{"input", file.addFloats(times, "SCALAR")},
                                        {"output", file.addFloats(moves, "VEC3")},
                                        {"interpolation", moving}});
            clip["channels"].push_back({{"sampler", 1}, {"target", {{"node", 2}, {"path", "translation"}}}});
            file.saveBinary(folder / "rig.glb");
            const Character character = imported(folder / "rig.glb");
            const int joint = jointNamed(character, "middle");
            const bool held = std::string(moving) == "STEP";
            // Between two frames of the clip, too.
            for (const float seconds : {0.5F, 0.5083F}) {
                const vec3 direction = directionAt(character, joint, seconds);
                const bool jumps = std::string(turning) == "STEP";
                CHECK(glm::distance(direction, jumps ? vec3(0, 1, 0) : halfTurned) < (seconds == 0.5F ? 1e-3F : 0.03F));
                std::vector<RigidTransform> pose(character.skeleton.parents.size());
                sampleClip(character.clips[0], seconds, pose);
                CHECK(pose[joint].translation.y == Approx(held ? 0.6F : 0.6F + seconds).margin(1e-4));
            }
            std::vector<RigidTransform> last(character.skeleton.parents.size());
            sampleClip(character.clips[0], 0.9999F, last);
            CHECK(last[joint].translation.y == Approx(held ? 0.6F : 1.6F).margin(1e-3));
            CHECK(glm::distance(directionAt(character, joint, 1.0F), vec3(-1, 0, 0)) < 1e-3F);
        }
    }
}

TEST_CASE("a channel that points at a node's part moves it as one that names them, others are told") {
    const TemporaryFolder folder;
    GltfFile file = makePostRig();
    const std::vector<float> times = {0, 1};
    file.addTurn("turn", 2, times, file.addFloats(quarterTurn(), "VEC4"), "LINEAR");
    auto& channels = file.json["animations"][0]["channels"];
    const auto pointTo = [&](const char* pointer) {
        channels[0]["target"] = {{"path", "pointer"},
                                 {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}};
        file.saveBinary(folder / "rig.glb");
        return imported(folder / "rig.glb");
    };
    const Character character = pointTo("/nodes/2/rotation");
    const std::string name = file.json["nodes"][2]["name"];
    CHECK(glm::distance(directionAt(character, jointNamed(character, name), 1.0F), vec3(-1, 0, 0)) < 1e-3F);
    CHECK(character.warnings.empty());
    for (const char* other :
         {"/materials/0/alphaCutoff", "/nodes/99/rotation", "/nodes/2", "/nodes/two/rotation", ""}) {
        const Character still = pointTo(other);
        CHECK(still.clips.empty());
        CHECK(warns(still, "animations of other things than nodes"));
    }
}

TEST_CASE("a skin without inverse bind matrices holds its vertices relative to their joints") {
    const TemporaryFolder folder;
    GltfFile plain = makePostRig();
    plain.saveBinary(folder / "plain.glb");
    GltfFile file = makePostRig();
    const Post post = makePost();
    std::vector<float> positions;
    for (std::size_t v = 0; v < post.positions.size(); ++v) {
        const auto joint = static_cast<float>(post.skin[v].joints[0]);
        const vec3 local = post.positions[v] - vec3(0, 0.6F * joint, 0);
        positions.insert(positions.end(), {local.x, local.y, local.z});
    }
    file.json["skins"][0].erase("inverseBindMatrices");
    file.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = file.addFloats(positions, "VEC3");
    file.saveBinary(folder / "rig.glb");
    CHECK(largestDifference(bindVertices(imported(folder / "rig.glb")), bindVertices(imported(folder / "plain.glb"))) <
          1e-4F);
}

TEST_CASE("joints beyond the last inverse bind matrix are bound where they stand, with a word") {
    const TemporaryFolder folder;
    GltfFile file = makePostRig();
    file.saveBinary(folder / "plain.glb");
    const int matrices = file.json["skins"][0]["inverseBindMatrices"];
    file.json["accessors"][matrices]["count"] = 2;
    file.saveBinary(folder / "rig.glb");
    const Character character = imported(folder / "rig.glb");
    checkInvariants(character);
    CHECK(warns(character, "3 joints and 2 inverse bind matrices"));
    const Character plain = imported(folder / "plain.glb");
    CHECK(largestDifference(bindVertices(character), bindVertices(plain)) < 1e-5F);
    CHECK(character.skeleton.skinWeight == plain.skeleton.skinWeight);
}

TEST_CASE("a skin of two joints a vertex may say so") {
    const TemporaryFolder folder;
    GltfFile file = makePostRig();
    file.saveBinary(folder / "plain.glb");
    std::vector<std::uint8_t> joints;
    std::vector<float> weights;
    for (const HandSkin& skin : makePost().skin) {
        joints.insert(joints.end(), {skin.joints[0], skin.joints[1]});
        weights.insert(weights.end(), {skin.weights[0], skin.weights[1]});
    }
    auto& attributes = file.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = file.addComponents<std::uint8_t>(joints, 5121, "VEC2", joints.size() / 2, false);
    attributes["WEIGHTS_0"] = file.addFloats(weights, "VEC2");
    file.saveBinary(folder / "rig.glb");
    CHECK(imported(folder / "rig.glb").skeleton.skinWeight == imported(folder / "plain.glb").skeleton.skinWeight);
}

TEST_CASE("joints of one name are told apart by their index") {
    const TemporaryFolder folder;
    GltfFile file = makePostRig();
    for (int node = 1; node <= 3; ++node)
        file.json["nodes"][node]["name"] = "Bone";
    const std::vector<float> times = {0, 1};
    file.addTurn("turn", 3, times, file.addFloats(quarterTurn(), "VEC4"), "LINEAR");
    file.saveBinary(folder / "rig.glb");
    const Character character = imported(folder / "rig.glb");
    CHECK(glm::distance(directionAt(character, 3, 1.0F), vec3(-1, 0, 0)) < 1e-3F);
    CHECK(glm::distance(directionAt(character, 2, 1.0F), vec3(0, 1, 0)) < 1e-3F);
    CHECK(character.skeleton.skinWeight[1] == Approx(character.skeleton.skinWeight[2]));
}

TEST_CASE("a buffer is found by its percent-encoded name, and not outside of the model's folder") {
    const TemporaryFolder folder;
    const GltfFile file = makePostRig();
    file.saveBeside(folder / "my rig.gltf", "my rig.bin", "my%20rig.bin");
    checkInvariants(imported(folder / "my rig.gltf"));
    std::filesystem::create_directories(folder / "below");
    // As files come from systems that do not tell capitals, and addresses from the net.
    for (const char* uri : {"My%20Rig.BIN", "Below/../MY%20RIG.bin", "my%20rig.bin?v=3#x"}) {
        INFO(uri);
        file.saveBeside(folder / "other.gltf", "my rig.bin", uri);
        checkInvariants(imported(folder / "other.gltf"));
    }
    for (const char* uri : {"../my%20rig.bin", "%2e%2e/my%20rig.bin", "/etc/passwd"}) {
        INFO(uri);
        file.saveBeside(folder / "below/rig.gltf", "unused.bin", uri);
        const Result<Character> outside = importCharacter(folder / "below/rig.gltf");
        REQUIRE_FALSE(outside.ok());
        CHECK(outside.error().message.find("outside") != std::string::npos);
    }
}

TEST_CASE("a data URI is one in capitals, too") {
    const TemporaryFolder folder;
    makePostRig().saveText(folder / "rig.gltf");
    std::ifstream in(folder / "rig.gltf");
    std::string text((std::istreambuf_iterator<char>(in)), {});
    const std::string head = "data:application/octet-stream;base64,";
    text.replace(text.find(head), head.size(), "DATA:Application/Octet-Stream;Charset=utf-8;BASE64,");
    std::ofstream(folder / "capitals.gltf") << text;
    CHECK(imported(folder / "capitals.gltf").meshes[0].positions == imported(folder / "rig.gltf").meshes[0].positions);
    // The characters of base64 that mean something else in a URI may be escaped in one.
    std::string escaped;
    for (const char c : text) {
        const char* as = c == '+' ? "%2B" : c == '=' ? "%3D" : nullptr;
        as != nullptr ? escaped += as : escaped += c;
    }
    REQUIRE(escaped.find("%3D") != std::string::npos);
    std::ofstream(folder / "escaped.gltf") << escaped;
    CHECK(imported(folder / "escaped.gltf").meshes[0].positions == imported(folder / "rig.gltf").meshes[0].positions);
}

TEST_CASE("an index may be written as 2.0") {
    const TemporaryFolder folder;
    GltfFile file = makePostRig();
    file.saveText(folder / "rig.gltf");
    const std::function<void(nlohmann::json&)> loosen = [&](nlohmann::json& value) {
        if (value.is_number_integer()) value = value.get<double>();
        if (!value.is_structured()) return;
        for (nlohmann::json& entry : value)
            loosen(entry);
    };
    loosen(file.json);
    REQUIRE(file.json["scene"].dump() == "0.0");
    file.saveText(folder / "loose.gltf");
    const Character loose = imported(folder / "loose.gltf");
    checkInvariants(loose);
    CHECK(loose.meshes[0].positions == imported(folder / "rig.gltf").meshes[0].positions);
    file.json["skins"][0]["joints"][0] = 0.5;
    file.saveText(folder / "half.gltf");
    CHECK_FALSE(importCharacter(folder / "half.gltf").ok());
}

TEST_CASE("a shared node, a ring of nodes and a deep chain are refused by name of the limit") {
    const TemporaryFolder folder;
    const auto refusedFor = [&](const GltfFile& file, const std::string& word) {
        file.saveText(folder / "rig.gltf");
        const Result<Character> result = importCharacter(folder / "rig.gltf");
        REQUIRE_FALSE(result.ok());
        CHECK(result.error().code == ErrorCode::input);
        CHECK_THAT(result.error().message, Catch::Contains(word));
    };
    GltfFile shared = makePostRig();
    const int node = shared.addNode("twice", 0);
    shared.json["nodes"][1]["children"].push_back(node);
    refusedFor(shared, "two parents");
    GltfFile ring = makePostRig();
    ring.json["nodes"][3]["children"].push_back(1);
    refusedFor(ring, "two parents");
    // Joints that no scene holds come along with their skin; here they hang on each other.
    GltfFile apart = makePostRig();
    for (int i = 0; i < static_cast<int>(apart.json["nodes"].size()); ++i) {
        if (apart.json["nodes"][i].contains("skin")) apart.json["scenes"] = {{{"nodes", {i}}}};
    }
    const int joint = apart.json["skins"][0]["joints"][0];
    const int last = apart.addNode("last", joint);
    apart.json["nodes"][last]["children"] = {joint};
    apart.json["skins"][0]["joints"].push_back(last);
    apart.json["skins"][0].erase("inverseBindMatrices");
    refusedFor(apart, "two parents");
    GltfFile chain;
    for (int i = 0; i < 5000; ++i)
        chain.addNode("link", i - 1);
    refusedFor(chain, "4096");
}

TEST_CASE("a small skinned mesh at one end of an armature does not draw the other joints to the origin") {
    const TemporaryFolder folder;
    GltfFile file;
    std::vector<int> nodes;
    std::vector<mat4> inverseBinds;
    for (int i = 0; i < 12; ++i) {
        const float height = 0.15F * static_cast<float>(i);
        nodes.push_back(file.addNode("joint" + std::to_string(i), i == 0 ? -1 : nodes.back(),
                                     glm::translate(mat4(1.0F), vec3(0, i == 0 ? 0.0F : 0.15F, 0))));
        inverseBinds.push_back(glm::translate(mat4(1.0F), vec3(0, -height, 0)));
    }
    Post plane = makePost();
    for (std::size_t v = 0; v < plane.positions.size(); ++v) {
        plane.positions[v] *= 0.1F;
        plane.skin[v].joints[0] = 1;
    }
    const int body = file.addNode("Plane", -1);
    file.json["nodes"][body]["mesh"] = addPostMesh(file, plane);
    file.json["nodes"][body]["skin"] = addSkin(file, nodes, inverseBinds);
    file.saveBinary(folder / "helper.glb");
    const Character character = imported(folder / "helper.glb");
    const int top = findJoint(character.skeleton, "joint11");
    REQUIRE(top >= 0);
    CHECK(std::abs(character.skeleton.bindModelFromJoint[top].translation.y - 1.65F) < 1e-4F);
}

TEST_CASE("an armature in a rigid mesh keeps its joints, though the mesh's node stands at the origin") {
    // As where a figure was parented to its bones without weights.
    const TemporaryFolder folder;
    GltfFile file;
    int last = -1;
    for (int i = 0; i < 12; ++i) {
        const vec3 step(0, i == 0 ? 0.05F : 0.15F, 0);
        last = file.addNode("joint" + std::to_string(i), last, glm::translate(mat4(1.0F), step));
    }
    // Beside the origin by what rounding leaves.
    const int body = file.addNode("Body", -1, glm::translate(mat4(1.0F), vec3(1e-7F, 2e-7F, 0)));
    file.json["nodes"][body]["mesh"] = addPostMesh(file, makePost(), mat4(1.0F), false);
    file.saveBinary(folder / "stiff.glb");
    const Character character = imported(folder / "stiff.glb");
    REQUIRE(character.skeleton.jointCount() >= 13);
    float highest = 0.0F;
    for (const char* name : {"joint3", "joint11"}) {
        const int joint = findJoint(character.skeleton, name);
        REQUIRE(joint >= 0);
        const float height = character.skeleton.bindModelFromJoint[joint].translation.y;
        CHECK(height > highest + 0.2F);
        highest = height;
    }
}

TEST_CASE("a figure far from the origin is brought to it with a word, and things beside it are left out") {
    const TemporaryFolder folder;
    GltfFile far = makePostRig(glm::translate(mat4(1.0F), vec3(100, 0, -40)));
    far.saveBinary(folder / "far.glb");
    const Character brought = imported(folder / "far.glb");
    for (const vec3& p : bindVertices(brought))
        CHECK(std::abs(p.x) < 1.0F);
    for (const RigidTransform& joint : brought.skeleton.bindModelFromJoint)
        CHECK(glm::length(joint.translation) < 3.0F);

    GltfFile stage = makePostRig();
    const Character alone = [&] {
        stage.saveBinary(folder / "alone.glb");
        return imported(folder / "alone.glb");
    }();
    const int ground = stage.addNode("Ground", -1, glm::scale(mat4(1.0F), vec3(30, 0.1F, 30)));
    stage.json["nodes"][ground]["mesh"] = addPostMesh(stage, makePost(), mat4(1.0F), false);
    stage.saveBinary(folder / "stage.glb");
    const Character staged = imported(folder / "stage.glb");
    CHECK(warns(staged, "Ground"));
    CHECK(bindVertices(staged) == bindVertices(alone));
}
