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

using animation::SkinningMethod;

/// The largest differences between GPU and CPU over all meshes.
struct SkinningError {
    float position = 0.0F;  ///< Metres.
    float normal = 0.0F;    ///< Length of the difference of unit vectors.
    float tangent = 0.0F;   ///< The same.
};

/// What comes out of skinning a mesh.
struct Skinned {
    std::vector<vec3> positions;
    std::vector<vec3> normals;
    std::vector<vec3> tangents;

    explicit Skinned(std::size_t vertices) : positions(vertices), normals(vertices), tangents(vertices) {}
    [[nodiscard]] render::SkinnedVertices views() { return {positions, normals, tangents}; }
};

// Written so that a NaN counts too.
void widen(float& worst, float difference) {
    if (!(difference <= worst)) worst = difference;
}

// The CPU's result; tangents are turned as normals are.
Skinned skinOnCpu(SkinningMethod method, const animation::SkinnedMesh& mesh,
                  const std::vector<animation::SkinMatrix>& palette) {
    Skinned out(mesh.positions.size());
    animation::skinVertices(method, mesh, palette, out.positions, out.normals);
    if (mesh.tangents.empty()) return out;
    animation::SkinnedMesh along = mesh;
    std::transform(mesh.tangents.begin(), mesh.tangents.end(), along.normals.begin(),
                   [](const vec4& tangent) { return vec3(tangent); });
    std::vector<vec3> ignored(out.positions.size());
    animation::skinVertices(method, along, palette, ignored, out.tangents);
    return out;
}

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

SkinningError compareSkinning(GlFixture& gl, const render::CharacterItem& item, const animation::Character& character,
                              const std::vector<animation::SkinMatrix>& palette) {
    SkinningError error;
    for (std::size_t m = 0; m < character.meshes.size(); ++m) {
        const animation::SkinnedMesh& mesh = character.meshes[m];
        const Skinned cpu = skinOnCpu(item.skinning, mesh, palette);
        Skinned gpu(mesh.positions.size());
        gl.renderer.skinOnGpu(item, static_cast<int>(m), gpu.views());
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            widen(error.position, glm::length(gpu.positions[i] - cpu.positions[i]));
            if (isFinite(cpu.normals[i])) widen(error.normal, glm::length(gpu.normals[i] - cpu.normals[i]));
            // Where two joints nearly cancel a direction, its length says nothing.
            const bool there =
                !mesh.tangents.empty() && isFinite(cpu.tangents[i]) && glm::length(gpu.tangents[i]) > 0.05F;
            if (there) widen(error.tangent, glm::length(glm::normalize(gpu.tangents[i]) - cpu.tangents[i]));
        }
    }
    return error;
}

void checkSkinning(GlFixture& gl, const animation::Character& character) {
    INFO(character.name);
    render::CharacterItem item;
    item.character = gl.upload(character);
    const float height = heightOf(character);
    Random random(21);
    for (const float angle : {0.0F, 0.4F, 1.5F}) {
        const auto palette = randomPalette(character.skeleton, random, angle);
        item.palette = palette;
        for (const SkinningMethod method : {SkinningMethod::linear, SkinningMethod::dualQuaternion}) {
            item.skinning = method;
            const SkinningError error = compareSkinning(gl, item, character, palette);
            INFO((method == SkinningMethod::linear ? "linear, up to " : "dual quaternions, up to ") << angle);
            CHECK(error.position < 1e-4F * height);
            // Where two joints nearly cancel, rounding turns the blended normal a little.
            CHECK(error.normal < 2e-2F);
            CHECK(error.tangent < 2e-2F);
        }
    }
    gl.renderer.removeCharacter(item.character);
}

}  // namespace

TEST_CASE("the GPU skins the hand-made figure as the CPU does in any pose") {
    const auto gl = GlFixture::create();
    NEEDS_GL(gl);
    checkSkinning(*gl, makeBiped());
}

TEST_CASE("the comparison of GPU and CPU skinning sees a joint that is off by a millimetre") {
    const auto gl = GlFixture::create();
    NEEDS_GL(gl);
    const animation::Character biped = makeBiped();
    render::CharacterItem item;
    item.character = gl->upload(biped);
    const auto palette = bindPalette(biped.skeleton);
    auto other = palette;
    other[7].rows[1].w += 0.001F;
    item.palette = other;
    for (const SkinningMethod method : {SkinningMethod::linear, SkinningMethod::dualQuaternion}) {
        item.skinning = method;
        CHECK(compareSkinning(*gl, item, biped, palette).position == Approx(0.001F).margin(1e-5));
    }
}

TEST_CASE("the GPU skins vertices with four weights as the CPU does") {
    const auto gl = GlFixture::create();
    NEEDS_GL(gl);
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
    render::CharacterItem item;
    item.character = gl->upload(biped);
    const auto palette = randomPalette(biped.skeleton, random, 0.6F);
    item.palette = palette;
    for (const SkinningMethod method : {SkinningMethod::linear, SkinningMethod::dualQuaternion}) {
        item.skinning = method;
        const SkinningError error = compareSkinning(*gl, item, biped, palette);
        CHECK(error.position < 1e-5F);
        CHECK(error.normal < 1e-3F);
    }
}

TEST_CASE("the GPU skins our own mannequin as the CPU does") {
    const auto gl = GlFixture::create();
    NEEDS_GL(gl);
    const Result<animation::Character> mannequin =
        animation::importCharacter(std::filesystem::path(LUTKA_ASSETS_DIR) / "models" / "mannequin.glb");
    if (!mannequin) FAIL(mannequin.error().text());
    checkSkinning(*gl, mannequin.value());
}

TEST_CASE("the GPU skins every model of the zoo as the CPU does") {
    const auto gl = GlFixture::create();
    NEEDS_GL(gl);
    NEEDS_ZOO();
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
