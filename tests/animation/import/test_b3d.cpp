// Blitz3D's files, made here.

#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "animation/import/assimp/b3d_bytes.hpp"
#include "animation/import/checks.hpp"
#include "animation/import/gltf_file.hpp"
#include "support/catch.hpp"

using namespace lutka;
using namespace lutka::animation;
using namespace lutka::test;

namespace {

template <class Number>
std::string packed(const std::vector<Number>& numbers) {
    std::string out(numbers.size() * sizeof(Number), '\0');
    std::memcpy(out.data(), numbers.data(), out.size());
    return out;
}

std::string chunk(const std::string& tag, const std::string& body) {
    return tag + packed<std::int32_t>({static_cast<std::int32_t>(body.size())}) + body;
}

std::string node(const std::string& name, const std::string& inner, float height = 0.0F) {
    return chunk("NODE", name + '\0' + packed<float>({0, height, 0, 1, 1, 1, 1, 0, 0, 0}) + inner);
}

// A triangle at that height, with its own copy of the skeleton: the upper bone moves its last corners, the lower one
// the first `low`.
std::string part(const std::string& name, float height, int low) {
    const std::string vertices =
        packed<std::int32_t>({0, 0, 0}) + packed<float>({0, height, 0, 1, height, 0, 0, height + 1, 0});
    const std::string triangles = packed<std::int32_t>({-1, 0, 1, 2});
    const auto weights = [](int from, int to) {
        std::string out;
        for (int vertex = from; vertex < to; ++vertex)
            out += packed<std::int32_t>({vertex}) + packed<float>({1.0F});
        return chunk("BONE", out);
    };
    const std::string upper = node("High", weights(low, 3), 2.0F);
    return node(name, chunk("MESH", packed<std::int32_t>({-1}) + chunk("VRTS", vertices) + chunk("TRIS", triangles)) +
                          node("Low", weights(0, low) + upper));
}

std::string twoParts() {
    return chunk("BB3D", packed<std::int32_t>({1}) + node("Root", part("Trousers", 0.0F, 2) + part("Shirt", 2.0F, 1)));
}

// One mesh, and two brushes of two textures each, of which the file has one at most.
std::string brushes(bool withTexture) {
    const auto brush = [](const std::string& name, const std::vector<std::int32_t>& textures) {
        return name + '\0' + packed<float>({1, 0.5F, 0, 1, 0}) + packed<std::int32_t>({1, 0}) + packed(textures);
    };
    const std::string texture =
        std::string("fur.png") + '\0' + packed<std::int32_t>({1, 2}) + packed<float>({0, 0, 1, 1, 0});
    return chunk("BB3D", packed<std::int32_t>({1}) + (withTexture ? chunk("TEXS", texture) : std::string()) +
                             chunk("BRUS", packed<std::int32_t>({2}) + brush("Fur", {0, -1}) + brush("Cloth", {7, 1})) +
                             node("Root", part("Body", 0.0F, 1)));
}

}  // namespace

TEST_CASE("every mesh of a B3D hangs on its own bones") {
    const TemporaryFolder folder;
    std::ofstream(folder / "parts.b3d", std::ios::binary) << twoParts();
    const Character character = imported(folder / "parts.b3d");
    REQUIRE(character.meshes.size() == 2);
    for (const SkinnedMesh& mesh : character.meshes) {
        CHECK_FALSE(mesh.rigid);
        int low = 0;
        for (std::size_t vertex = 0; vertex < mesh.positions.size(); ++vertex) {
            low += character.skeleton.names[mesh.joints[vertex][0]] == "Low" ? 1 : 0;
            CHECK(mesh.weights[vertex][0] == Approx(1.0F));
        }
        CHECK(mesh.positions.size() == 3);
        CHECK(low == (mesh.name == "Shirt" ? 1 : 2));
    }
}

TEST_CASE("a brush of a B3D may name a texture that the file has not") {
    for (const bool withTexture : {false, true}) {
        const TemporaryFolder folder;
        std::ofstream(folder / "fur.b3d", std::ios::binary) << brushes(withTexture);
        const Character character = imported(folder / "fur.b3d");
        REQUIRE(character.meshes.size() == 1);
        CHECK(character.meshes[0].positions.size() == 3);
    }
}

TEST_CASE("a damaged B3D is tidied as far as it goes, and no further") {
    for (const std::string& file : {twoParts(), brushes(true)}) {
        for (std::size_t length = 0; length <= file.size(); ++length) {
            const std::string part = file.substr(0, length);
            CHECK(rig_import::tidyB3d(part).size() == part.size());
        }
    }
    const std::string whole = twoParts();
    const std::string tidied = rig_import::tidyB3d(whole);
    CHECK(tidied != whole);
    const std::size_t first = whole.find("Shirt");
    CHECK(tidied.substr(0, first) == whole.substr(0, first));
}
