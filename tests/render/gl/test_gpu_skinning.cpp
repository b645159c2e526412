#include <algorithm>
#include <filesystem>
#include <glm/common.hpp>

#include "animation/import/import_character.hpp"
#include "gl_fixture.hpp"
#include "support/rigs.hpp"
#include "support/zoo.hpp"

using namespace lutka;
using namespace lutka::test;

namespace {

/// The largest differences between GPU and CPU over all meshes.
struct SkinningError {
    float position = 0.0F;  ///< Metres.
    float normal = 0.0F;    ///< Length of the difference of unit vectors.
};

float heightOf(const animation::Character& character) {
    float lowest = 1e9F;
    float highest = -1e9F;
    for (const animation::SkinnedMesh& mesh : character.meshes) {
        for (const vec3& position : mesh.positions) {
            lowest = std::min(lowest, position.y);
            highest = std::max(highest, position.y);
        }
    }
    return highest - lowest;
}

SkinningError compareSkinning(GlFixture& gl, render::CharacterHandle handle, const animation::Character& character,
                              const std::vector<animation::SkinMatrix>& palette) {
    SkinningError error;
    for (std::size_t m = 0; m < character.meshes.size(); ++m) {
        const animation::SkinnedMesh& mesh = character.meshes[m];
        const std::size_t count = mesh.positions.size();
        std::vector<vec3> cpuPositions(count);
        std::vector<vec3> cpuNormals(count);
        std::vector<vec3> gpuPositions(count);
        std::vector<vec3> gpuNormals(count);
        animation::skinVertices(mesh, palette, cpuPositions, cpuNormals);
        gl.renderer.skinOnGpu(handle, static_cast<int>(m), palette, gpuPositions, gpuNormals);
        for (std::size_t i = 0; i < count; ++i) {
            // Written so that a NaN fails too.
            const float apart = glm::length(gpuPositions[i] - cpuPositions[i]);
            if (!(apart <= error.position)) error.position = apart;
            const float turned = glm::length(gpuNormals[i] - cpuNormals[i]);
            if (isFinite(cpuNormals[i]) && !(turned <= error.normal)) error.normal = turned;
        }
    }
    return error;
}

void checkSkinning(GlFixture& gl, const animation::Character& character) {
    INFO(character.name);
    const render::CharacterHandle handle = gl.upload(character);
    const float height = heightOf(character);
    Random random(21);
    for (const float angle : {0.0F, 0.4F, 1.5F}) {
        const auto palette = randomPalette(character.skeleton, random, angle);
        const SkinningError error = compareSkinning(gl, handle, character, palette);
        CHECK(error.position < 1e-4F * height);
        // Where two joints nearly cancel, rounding turns the blended normal a little.
        CHECK(error.normal < 2e-2F);
    }
    gl.renderer.removeCharacter(handle);
}

}  // namespace

TEST_CASE("the GPU skins the hand-made figure as the CPU does in any pose") {
    const auto gl = GlFixture::create();
    if (!gl) return;
    checkSkinning(*gl, makeBiped());
}

TEST_CASE("the comparison of GPU and CPU skinning sees a joint that is off by a millimetre") {
    const auto gl = GlFixture::create();
    if (!gl) return;
    const animation::Character biped = makeBiped();
    const render::CharacterHandle handle = gl->upload(biped);
    const auto palette = bindPalette(biped.skeleton);
    auto other = palette;
    other[7].rows[1].w += 0.001F;
    const animation::SkinnedMesh& mesh = biped.meshes[0];
    std::vector<vec3> cpu(mesh.positions.size());
    std::vector<vec3> gpu(mesh.positions.size());
    std::vector<vec3> normals(mesh.positions.size());
    animation::skinVertices(mesh, palette, cpu, {});
    gl->renderer.skinOnGpu(handle, 0, other, gpu, normals);
    float worst = 0.0F;
    for (std::size_t i = 0; i < cpu.size(); ++i)
        worst = std::max(worst, glm::length(gpu[i] - cpu[i]));
    CHECK(worst == Approx(0.001F).margin(1e-5));
}

TEST_CASE("the GPU skins vertices with four weights as the CPU does") {
    const auto gl = GlFixture::create();
    if (!gl) return;
    animation::Character biped = makeBiped();
    Random random(5);
    const auto joints = static_cast<float>(biped.skeleton.jointCount());
    for (std::size_t i = 0; i < biped.meshes[0].positions.size(); ++i) {
        std::array<float, 4> weights{};
        float sum = 0.0F;
        for (std::size_t slot = 0; slot < weights.size(); ++slot) {
            weights[slot] = random.uniform(0.1F, 1.0F);
            sum += weights[slot];
            biped.meshes[0].joints[i][slot] = static_cast<std::uint16_t>(random.uniform(0, joints));
        }
        std::sort(weights.begin(), weights.end(), std::greater<>());
        for (std::size_t slot = 0; slot < weights.size(); ++slot)
            biped.meshes[0].weights[i][slot] = weights[slot] / sum;
    }
    const render::CharacterHandle handle = gl->upload(biped);
    const SkinningError error = compareSkinning(*gl, handle, biped, randomPalette(biped.skeleton, random, 0.6F));
    CHECK(error.position < 1e-5F);
    CHECK(error.normal < 1e-3F);
}

TEST_CASE("the GPU skins our own mannequin as the CPU does") {
    const auto gl = GlFixture::create();
    if (!gl) return;
    const Result<animation::Character> mannequin =
        animation::importCharacter(std::filesystem::path(LUTKA_ASSETS_DIR) / "models" / "mannequin.glb");
    if (!mannequin) FAIL(mannequin.error().text());
    checkSkinning(*gl, mannequin.value());
}

TEST_CASE("the GPU skins every model of the zoo as the CPU does") {
    const auto gl = GlFixture::create();
    if (!gl || !zooIsThere()) return;
    int models = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(LUTKA_ZOO_DIR)) {
        const std::string extension = entry.path().extension().string();
        if (!entry.is_regular_file() || extension == ".txt" || extension == ".json" || extension == ".py") continue;
        // Which files can be imported is the importer's test; here each that can must be skinned right.
        animation::ImportOptions options;
        options.loadTextures = false;
        const Result<animation::Character> character = animation::importCharacter(entry.path(), options);
        if (!character || character.value().meshes.empty()) continue;
        checkSkinning(*gl, character.value());
        ++models;
    }
    CHECK(models >= 20);
}
