// Inter-Quake Models, made here.

#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "animation/import/gltf_file.hpp"
#include "animation/import/iqm/iqm_document.hpp"
#include "animation/import/iqm/read_iqm.hpp"
#include "support/catch.hpp"

using namespace lutka;
using namespace lutka::animation;
using namespace lutka::animation::rig_import;

namespace {

constexpr float kHalfTurn = 0.70710678F;  // sine and cosine of an eighth of a turn: a quarter turn's quaternion

template <class Number>
void put(std::string& to, Number number) {
    to.append(reinterpret_cast<const char*>(&number), sizeof(number));
}
template <class Number>
void putAll(std::string& to, const std::vector<Number>& numbers) {
    for (const Number number : numbers)
        put(to, number);
}

// A root and an upper bone one unit above it along the root's y, which the root's quarter turn about z makes -x of the
// scene. A triangle of one vertex on the root, one on the bone, one on both by halves. Two frames a second in which the
// bone goes from 1 to 3 along y.
struct IqmFile {
    std::uint32_t version = 2;
    bool floatWeights = false;
    std::string material = "skin";
    std::int32_t boneParent = 0;
    float frameRate = 2.0F;
    std::uint32_t animationFrames = 2;
    std::uint32_t poses = 2;
    bool stands = false;  // no channel moves, and there are no frames
    std::uint32_t animationCount = 1;
    std::uint32_t frameCount = 2;

    [[nodiscard]] std::string bytes() const {
        std::string texts(1, '\0');
        const auto named = [&](const std::string& text) {
            const auto at = static_cast<std::uint32_t>(texts.size());
            texts += text + '\0';
            return at;
        };
        std::string joints;
        const auto joint = [&](const std::string& name, std::int32_t parent, std::vector<float> numbers) {
            put(joints, named(name));
            put(joints, parent);
            if (version == 1) numbers.erase(numbers.begin() + 6);
            putAll(joints, numbers);
        };
        // Version 1 takes the rotation's real part as not positive: the quaternion negated is the same turn.
        const float sign = version == 1 ? -1.0F : 1.0F;
        joint("root", -1, {0, 0, 0, 0, 0, sign * kHalfTurn, sign * kHalfTurn, 1, 1, 1});
        joint("bone", boneParent, {0, 1, 0, 0, 0, 0, sign, 1, 1, 1});
        std::string meshes;
        putAll<std::uint32_t>(meshes, {named("body"), named(material), 0, 3, 0, 1});
        std::string animations;
        const std::uint32_t animationName = named("stretch");
        for (std::uint32_t i = 0; i < animationCount; ++i) {
            putAll<std::uint32_t>(animations, {animationName, 0, animationFrames});
            put(animations, frameRate);
            put<std::uint32_t>(animations, 1);
        }
        std::string positions;
        putAll<float>(positions, {0, 0, 0, -1, 0, 0, 0, 0, 2});
        std::string indices;
        putAll<std::uint8_t>(indices, {0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0});
        std::string weights;
        if (floatWeights) {
            putAll<float>(weights, {1, 0, 0, 0, 1, 0, 0, 0, 0.5F, 0.5F, 0, 0});
        } else {
            putAll<std::uint8_t>(weights, {255, 0, 0, 0, 255, 0, 0, 0, 128, 127, 0, 0});
        }
        std::string triangles;
        putAll<std::uint32_t>(triangles, {0, 1, 2});
        std::string poseBytes;
        for (std::uint32_t i = 0; i < poses; ++i) {
            const bool moves = i == 1 && !stands;
            put<std::int32_t>(poseBytes, static_cast<std::int32_t>(i) - 1);
            put<std::uint32_t>(poseBytes, moves ? 2U : 0U);  // y of the translation
            const bool isBone = i == 1;
            std::vector<float> offsets = {0,
                                          isBone ? 1.0F : 0.0F,
                                          0,
                                          0,
                                          0,
                                          isBone ? 0.0F : sign * kHalfTurn,
                                          isBone ? sign : sign * kHalfTurn,
                                          1,
                                          1,
                                          1};
            std::vector<float> scales = {0, moves ? 2.0F / 65535.0F : 0.0F, 0, 0, 0, 0, 0, 0, 0, 0};
            if (version == 1) {
                offsets.erase(offsets.begin() + 6);
                scales.erase(scales.begin() + 6);
            }
            putAll(poseBytes, offsets);
            putAll(poseBytes, scales);
        }
        std::string frames;
        if (!stands) putAll<std::uint16_t>(frames, {0, 65535});

        constexpr std::uint32_t kHeader = 16 + 27 * 4;
        std::string body;
        const auto place = [&](const std::string& part) {
            const auto at = static_cast<std::uint32_t>(kHeader + body.size());
            body += part;
            return at;
        };
        const std::uint32_t textAt = place(texts), meshesAt = place(meshes), positionsAt = place(positions),
                            indicesAt = place(indices), weightsAt = place(weights);
        std::string arrays;
        putAll<std::uint32_t>(arrays, {0, 0, 7, 3, positionsAt});
        putAll<std::uint32_t>(arrays, {4, 0, 1, 4, indicesAt});
        putAll<std::uint32_t>(arrays, {5, 0, floatWeights ? 7U : 1U, 4, weightsAt});
        const std::uint32_t arraysAt = place(arrays), trianglesAt = place(triangles), jointsAt = place(joints),
                            posesAt = place(poseBytes), animationsAt = place(animations), framesAt = place(frames);
        std::string out("INTERQUAKEMODEL\0", 16);
        const auto size = [](const std::string& text) { return static_cast<std::uint32_t>(text.size()); };
        putAll<std::uint32_t>(out, {version,
                                    kHeader + size(body),
                                    0,
                                    size(texts),
                                    textAt,
                                    1,
                                    meshesAt,
                                    3,
                                    3,
                                    arraysAt,
                                    1,
                                    trianglesAt,
                                    0,
                                    2,
                                    jointsAt,
                                    poses,
                                    posesAt,
                                    animationCount,
                                    animationsAt,
                                    frameCount,
                                    stands ? 0U : 1U,
                                    framesAt,
                                    0,
                                    0,
                                    0,
                                    0,
                                    0});
        return out + body;
    }
};

Result<iqm::IqmDocument> parsed(const std::string& bytes) {
    return iqm::parseIqm({reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()}, "figure.iqm");
}

Result<SourceScene> sceneOf(const IqmFile& made, const test::TemporaryFolder& folder) {
    const std::filesystem::path file = folder / "figure.iqm";
    std::ofstream(file, std::ios::binary) << made.bytes();
    return readIqm(file, {});
}

}  // namespace

// Assimp 5.2.5 gives one joint, <IQMRoot>, and a rigid mesh.
TEST_CASE("an IQM file's joints, skin and animations are read") {
    const test::TemporaryFolder dir;
    for (const std::uint32_t version : {1U, 2U}) {
        for (const bool floatWeights : {false, true}) {
            CAPTURE(version, floatWeights);
            IqmFile made;
            made.version = version;
            made.floatWeights = floatWeights;
            const Result<SourceScene> read = sceneOf(made, dir);
            REQUIRE(read.ok());
            const SourceScene& scene = read.value();
            REQUIRE(scene.nodes.size() == 3);  // and the mesh's
            CHECK(scene.nodes[0].name == "root");
            CHECK(scene.nodes[1].name == "bone");
            CHECK(scene.nodes[1].parent == 0);
            REQUIRE(scene.skins.size() == 1);
            const glm::dmat4 boneInScene = glm::inverse(scene.skins[0].joints[1].jointFromMesh);
            CHECK(boneInScene[3].x == Approx(-1.0).margin(1e-6));
            CHECK(boneInScene[3].y == Approx(0.0).margin(1e-6));
            REQUIRE(scene.meshes.size() == 1);
            const SourceMesh& mesh = scene.meshes[0];
            CHECK(mesh.indices == std::vector<std::uint32_t>{0, 2, 1});  // counter-clockwise
            REQUIRE(mesh.influences.size() == 4);
            CHECK(mesh.influences[1].slot == 1);
            CHECK(mesh.influences[1].weight == Approx(1.0F));
            CHECK(mesh.influences[2].weight == Approx(0.5F).margin(0.01));
            REQUIRE(scene.clips.size() == 1);
            CHECK(scene.clips[0].name == "stretch");
            const SourceChannel& places = scene.clips[0].channels[3];  // of the bone
            CHECK(places.times == std::vector<double>{0.0, 0.5});
            CHECK(places.values[4] == Approx(3.0F));
        }
    }
}

TEST_CASE("an IQM file's material is a picture only where there is one") {
    const test::TemporaryFolder dir;
    IqmFile made;
    Result<SourceScene> read = sceneOf(made, dir);
    REQUIRE(read.ok());
    CHECK(read.value().warnings.empty());  // "skin" may be any name
    made.material = "missing.tga";
    read = sceneOf(made, dir);
    REQUIRE(read.ok());
    REQUIRE(read.value().warnings.size() == 1);
    CHECK(read.value().warnings[0].find("missing.tga") != std::string::npos);
}

TEST_CASE("animations of other joints than an IQM file's own, and without a rate, are told") {
    IqmFile made;
    made.poses = 1;
    Result<iqm::IqmDocument> document = parsed(made.bytes());
    REQUIRE(document.ok());
    CHECK(document.value().animations.empty());
    REQUIRE(document.value().warnings.size() == 1);
    made.poses = 2;
    made.frameRate = 0.0F;
    made.animationFrames = 7;  // of which there are two
    document = parsed(made.bytes());
    REQUIRE(document.ok());
    REQUIRE(document.value().animations.size() == 1);
    CHECK(document.value().animations[0].frameCount == 2);
    CHECK(document.value().animations[0].frameRate == 30.0);
    CHECK(document.value().warnings.size() == 1);
}

TEST_CASE("an IQM animation in which nothing moves is one frame, though the file holds none") {
    IqmFile made;
    made.stands = true;
    made.frameCount = 2'000'000;
    made.animationFrames = 2'000'000;
    const Result<iqm::IqmDocument> document = parsed(made.bytes());
    REQUIRE(document.ok());
    CHECK(document.value().frames.size() == 2);
    REQUIRE(document.value().animations.size() == 1);
    CHECK(document.value().animations[0].frameCount == 1);
    CHECK(document.value().frames[1].translation.y == Approx(1.0));
}

// Each would be a clip of its own: gigabytes from a file of 20 bytes a clip.
TEST_CASE("IQM animations that share all frames of a file are refused beyond what can be read") {
    IqmFile made;
    made.animationCount = 2'000'000;
    const Result<iqm::IqmDocument> document = parsed(made.bytes());
    REQUIRE(!document.ok());
    CHECK(document.error().message.find("overlap") != std::string::npos);
}

TEST_CASE("a damaged IQM file is refused, wherever it is cut off") {
    IqmFile made;
    const std::string whole = made.bytes();
    REQUIRE(parsed(whole).ok());
    for (std::size_t length = 0; length < whole.size(); ++length) {
        CAPTURE(length);
        const Result<iqm::IqmDocument> cut = parsed(whole.substr(0, length));
        REQUIRE(!cut.ok());
        CHECK(cut.error().code == ErrorCode::input);
        CHECK(!cut.error().mend.empty());
    }
    made.boneParent = 5;
    CHECK(!parsed(made.bytes()).ok());
    made.boneParent = 0;
    made.version = 3;
    const Result<iqm::IqmDocument> other = parsed(made.bytes());
    REQUIRE(!other.ok());
    CHECK(other.error().message.find("IQM 3") != std::string::npos);
}

// Nothing may be read outside of the file (the sanitizers watch), whatever its numbers say.
TEST_CASE("an IQM file with any one number changed is read or refused") {
    const std::string whole = IqmFile{}.bytes();
    for (std::size_t at = 16; at + 4 <= whole.size(); at += 4) {
        for (const std::uint32_t number : {0U, 1U, 3U, 0x7FFFFFFFU, 0xFFFFFFFFU, 0x10000U}) {
            std::string changed = whole;
            std::memcpy(changed.data() + at, &number, 4);
            const Result<iqm::IqmDocument> read = parsed(changed);
            if (!read.ok()) CHECK(read.error().code == ErrorCode::input);
        }
    }
}
