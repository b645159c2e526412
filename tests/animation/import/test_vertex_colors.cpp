// Vertex colours: every form that glTF has for them, and the formats whose colours are sRGB.

#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>

#include "animation/import/checks.hpp"
#include "animation/import/gltf_file.hpp"
#include "support/catch.hpp"

using namespace lutka;
using namespace lutka::animation;
using namespace lutka::test;

namespace {

// A colour for each height of the post, as all forms can hold it but for half a step of a byte.
vec4 colorAt(float height) {
    return {height / 1.8F, 0.25F, 1.0F - height / 1.8F, 0.5F};
}

template <class T>
std::vector<T> packed(std::size_t width, float one) {
    std::vector<T> values;
    for (const vec3& position : makePost().positions) {
        const vec4 color = colorAt(position.y);
        for (std::size_t i = 0; i < width; ++i) {
            const float value = color[static_cast<int>(i)] * one;
            values.push_back(static_cast<T>(one > 1.0F ? std::round(value) : value));
        }
        if (sizeof(T) * width % 4 != 0) values.resize(values.size() + (4 - sizeof(T) * width % 4) / sizeof(T));
    }
    return values;
}

void setColors(GltfFile& file, int accessor, std::size_t stride) {
    file.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = accessor;
    const int view = file.json["accessors"][accessor]["bufferView"];
    file.json["bufferViews"][view]["byteStride"] = stride;
}

// The farthest that a vertex's colour is from what its height has; alpha counts where `alpha` says so.
float farthestColor(const Character& character, bool alpha) {
    float worst = 0.0F;
    for (const SkinnedMesh& mesh : character.meshes) {
        REQUIRE(mesh.colors.size() == mesh.positions.size());
        for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
            vec4 expected = colorAt(mesh.positions[v].y);
            if (!alpha) expected.a = 1.0F;
            worst = std::max(worst, glm::distance(mesh.colors[v], expected));
        }
    }
    return worst;
}

Character readColors(const GltfFile& file) {
    const TemporaryFolder folder;
    file.saveBinary(folder / "rig.glb");
    Character character = imported(folder / "rig.glb");
    checkInvariants(character);
    CHECK(character.warnings.empty());
    return character;
}

}  // namespace

TEST_CASE("vertex colours are read from floats, bytes and shorts, of three and four components") {
    const std::size_t count = makePost().positions.size();
    for (const std::size_t width : {std::size_t{3}, std::size_t{4}}) {
        const std::string type = "VEC" + std::to_string(width);
        INFO(type);
        GltfFile floats = makePostRig();
        setColors(floats, floats.addComponents<float>(packed<float>(width, 1.0F), 5126, type, count, false), 4 * width);
        CHECK(farthestColor(readColors(floats), width == 4) < 1e-6F);
        GltfFile bytes = makePostRig();
        setColors(bytes,
                  bytes.addComponents<std::uint8_t>(packed<std::uint8_t>(width, 255.0F), 5121, type, count, true), 4);
        CHECK(farthestColor(readColors(bytes), width == 4) < 0.005F);
        GltfFile shorts = makePostRig();
        setColors(shorts,
                  shorts.addComponents<std::uint16_t>(packed<std::uint16_t>(width, 65535.0F), 5123, type, count, true),
                  8);
        CHECK(farthestColor(readColors(shorts), width == 4) < 2e-5F);
    }
}

TEST_CASE("sparse vertex colours change the vertices that they list") {
    GltfFile file = makePostRig();
    const std::size_t count = makePost().positions.size();
    const std::vector<float> white(4 * count, 1.0F);
    const int colors = file.addComponents<float>(white, 5126, "VEC4", count, false);
    setColors(file, colors, 16);
    const std::vector<float> red = {1, 0, 0, 1};
    const std::vector<std::uint16_t> which = {5};
    const int indices = file.addIndices(which);
    const int values = file.addFloats(red, "VEC4");
    file.json["accessors"][colors]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", file.json["accessors"][indices]["bufferView"]}, {"componentType", 5123}}},
        {"values", {{"bufferView", file.json["accessors"][values]["bufferView"]}}}};
    const Character character = readColors(file);
    const SkinnedMesh& mesh = character.meshes[0];
    REQUIRE(mesh.colors.size() == mesh.positions.size());
    const vec3 marked = makePost().positions[5];
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const bool is = glm::distance(mesh.positions[v], marked) < 1e-5F;
        CHECK(mesh.colors[v] == (is ? vec4(1, 0, 0, 1) : vec4(1.0F)));
    }
}

TEST_CASE("white vertex colours are none, and vertices of two colours are two vertices") {
    GltfFile file = makePostRig();
    const std::size_t count = makePost().positions.size();
    const std::vector<float> white(4 * count, 1.0F);
    setColors(file, file.addComponents<float>(white, 5126, "VEC4", count, false), 16);
    CHECK(readColors(file).meshes[0].colors.empty());

    // Two triangles at one place, of one colour each.
    GltfFile twice = makePostRig();
    Post post = makePost();
    const std::size_t half = post.positions.size();
    post.positions.insert(post.positions.end(), post.positions.begin(), post.positions.end());
    post.skin.insert(post.skin.end(), post.skin.begin(), post.skin.end());
    for (const std::uint16_t index : makePost().indices)
        post.indices.push_back(static_cast<std::uint16_t>(index + half));
    const int mesh = addPostMesh(twice, post);
    twice.json["nodes"][4]["mesh"] = mesh;
    std::vector<float> colors;
    for (std::size_t v = 0; v < 2 * half; ++v)
        colors.insert(colors.end(), {v < half ? 1.0F : 0.0F, 0.0F, 0.0F});
    twice.json["meshes"][mesh]["primitives"][0]["attributes"]["COLOR_0"] = twice.addFloats(colors, "VEC3");
    CHECK(readColors(twice).meshes[0].positions.size() == 2 * half);
}

TEST_CASE("the colours of a PLY are sRGB and become linear") {
    const TemporaryFolder folder;
    std::ofstream(folder / "post.ply")
        << "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
           "property float z\nproperty uchar red\nproperty uchar green\n"
           "property uchar blue\nelement face 1\n"
           "property list uchar int vertex_indices\nend_header\n"
           "0 0 0 255 128 0\n1 0 0 255 128 0\n0 1.7 0 255 128 0\n3 0 1 2\n";
    const Character ply = imported(folder / "post.ply");
    REQUIRE(ply.meshes.size() == 1);
    REQUIRE(ply.meshes[0].colors.size() == 3);
    CHECK(glm::distance(ply.meshes[0].colors[0], vec4(1.0F, 0.2158F, 0.0F, 1.0F)) < 1e-3F);
}

TEST_CASE("vertex colours that are black everywhere are data outside of glTF, and colours in it") {
    const TemporaryFolder folder;
    std::ofstream(folder / "post.ply")
        << "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
           "property float z\nproperty uchar red\nproperty uchar green\n"
           "property uchar blue\nproperty uchar alpha\nelement face 1\n"
           "property list uchar int vertex_indices\nend_header\n"
           "0 0 0 0 0 0 90\n1 0 0 0 0 0 200\n0 1.7 0 0 0 0 7\n3 0 1 2\n";
    CHECK(imported(folder / "post.ply").meshes[0].colors.empty());

    GltfFile file = makePostRig();
    const std::size_t count = makePost().positions.size();
    setColors(file, file.addFloats(std::vector<float>(3 * count, 0.0F), "VEC3"), 12);
    CHECK(readColors(file).meshes[0].colors.size() == readColors(file).meshes[0].positions.size());
}
