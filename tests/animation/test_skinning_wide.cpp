#include <algorithm>
#include <glm/geometric.hpp>

#include "animation/skinning.hpp"
#include "core/random.hpp"
#include "support/catch.hpp"
#include "support/counting_new.hpp"

using namespace lutka;
using namespace lutka::animation;

namespace {

constexpr std::size_t kJoints = 40;

vec3 anyDirection(Random& random) {
    vec3 v(0);
    while (glm::length(v) < 0.1F)
        v = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    return glm::normalize(v);
}

RigidTransform anyFrame(Random& random) {
    return {glm::angleAxis(random.uniform(0.0F, 3.0F), anyDirection(random)), anyDirection(random)};
}

// Vertices with `influences` joints each (0: any number), a normal and a tangent.
SkinnedMesh anyMesh(std::size_t vertices, int influences, Random& random) {
    SkinnedMesh mesh;
    for (std::size_t v = 0; v < vertices; ++v) {
        mesh.positions.push_back(anyDirection(random) * 1.7F);
        mesh.normals.push_back(anyDirection(random));
        mesh.tangents.emplace_back(anyDirection(random), random.uniform(-1, 1) < 0.0F ? -1.0F : 1.0F);
        const int count = influences > 0 ? influences : 1 + static_cast<int>(random.uniform(0.0F, 3.999F));
        std::array<float, 4> weights{};
        float sum = 0;
        for (int i = 0; i < count; ++i) {
            weights[i] = random.uniform(0.1F, 1.0F);
            sum += weights[i];
        }
        for (float& weight : weights)
            weight /= sum;
        std::sort(weights.begin(), weights.end(), std::greater<>());
        mesh.weights.push_back(weights);
        std::array<std::uint16_t, 4> joints{};
        for (std::uint16_t& joint : joints)
            joint = static_cast<std::uint16_t>(random.uniform(0.0F, kJoints - 0.01F));
        mesh.joints.push_back(joints);
    }
    return mesh;
}

std::vector<SkinMatrix> anyPalette(Random& random) {
    std::vector<RigidTransform> bind(kJoints);
    std::vector<RigidTransform> pose(kJoints);
    for (std::size_t joint = 0; joint < kJoints; ++joint) {
        bind[joint] = anyFrame(random);
        pose[joint] = anyFrame(random);
    }
    std::vector<SkinMatrix> palette(kJoints);
    skinMatrices(bind, pose, palette);
    return palette;
}

struct Skin {
    explicit Skin(std::size_t vertices) : positions(vertices), normals(vertices), tangents(vertices) {}
    std::vector<vec3> positions;
    std::vector<vec3> normals;
    std::vector<vec4> tangents;
    bool operator==(const Skin&) const = default;
};

}  // namespace

TEST_CASE("wide skinning gives the plain loop's bits on every instruction set and for every remainder") {
    Random random(3);
    const std::vector<SkinMatrix> palette = anyPalette(random);
    for (const InstructionSet set : {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512}) {
        if (!hasInstructionSet(set)) continue;
        for (int influences = 0; influences <= 4; ++influences) {
            for (const std::size_t vertices : {0, 1, 3, 4, 7, 8, 9, 15, 16, 1003}) {
                const SkinnedMesh mesh = anyMesh(vertices, influences, random);
                Skin wide(vertices);
                Skin plain(vertices);
                skinVertices(set, mesh, palette, wide.positions, wide.normals, wide.tangents);
                skinVerticesByScalars(InstructionSet::baseline, mesh, palette, plain.positions, plain.normals,
                                      plain.tangents);
                INFO(influences << " influences, " << vertices << " vertices");
                CHECK(wide == plain);
            }
        }
    }
}

TEST_CASE("vertices that share joints, that are not whole and of very large palettes get the plain loop's bits too") {
    Random random(11);
    std::vector<SkinMatrix> palette = anyPalette(random);
    SkinnedMesh mesh = anyMesh(700, 0, random);
    // Stretches of one to 24 vertices with the same joints, in lanes of any register.
    for (std::size_t v = 1; v < mesh.joints.size(); ++v)
        if (random.uniform(0, 1) < 0.9F) mesh.joints[v] = mesh.joints[v - 1];
    for (std::size_t v = 0; v < 200; ++v)
        mesh.weights[v] = {v < 100 ? 1.0F : 0.7F, 0, 0, 0};
    SkinnedMesh large = mesh;
    for (auto& joints : large.joints)
        joints[0] = static_cast<std::uint16_t>(joints[0] + 20000);
    std::vector<SkinMatrix> largePalette(20000);
    largePalette.insert(largePalette.end(), palette.begin(), palette.end());
    for (const InstructionSet set : {InstructionSet::baseline, InstructionSet::avx2}) {
        if (!hasInstructionSet(set)) continue;
        Skin wide(700);
        Skin plain(700);
        skinVertices(set, mesh, palette, wide.positions, wide.normals, wide.tangents);
        skinVerticesByScalars(InstructionSet::baseline, mesh, palette, plain.positions, plain.normals, plain.tangents);
        CHECK(wide == plain);
        skinVertices(set, large, largePalette, wide.positions, wide.normals, wide.tangents);
        skinVerticesByScalars(InstructionSet::baseline, large, largePalette, plain.positions, plain.normals,
                              plain.tangents);
        CHECK(wide == plain);
    }
}

TEST_CASE("skinning is the weighted sum of what each joint does to the vertex") {
    Random random(5);
    const std::vector<SkinMatrix> palette = anyPalette(random);
    const SkinnedMesh mesh = anyMesh(100, 0, random);
    Skin skin(100);
    skinVertices(mesh, palette, skin.positions, skin.normals, skin.tangents);
    const auto sumOf = [&](std::size_t vertex, const vec4& v) {
        glm::dvec3 sum(0);
        for (int slot = 0; slot < kMaxInfluences; ++slot) {
            const SkinMatrix& matrix = palette[mesh.joints[vertex][slot]];
            for (int row = 0; row < 3; ++row)
                sum[row] += static_cast<double>(mesh.weights[vertex][slot]) *
                            glm::dot(glm::dvec4(matrix.rows[row]), glm::dvec4(v));
        }
        return sum;
    };
    for (std::size_t v = 0; v < 100; ++v) {
        CHECK(glm::distance(glm::dvec3(skin.positions[v]), sumOf(v, vec4(mesh.positions[v], 1))) < 1e-6);
        const glm::dvec3 normal = glm::normalize(sumOf(v, vec4(mesh.normals[v], 0)));
        CHECK(glm::distance(glm::dvec3(skin.normals[v]), normal) < 1e-5);
        const glm::dvec3 tangent = glm::normalize(sumOf(v, vec4(vec3(mesh.tangents[v]), 0)));
        CHECK(glm::distance(glm::dvec3(skin.tangents[v]), tangent) < 1e-5);
        CHECK(skin.tangents[v].w == mesh.tangents[v].w);
    }
}

TEST_CASE("normals and tangents can be left out and nothing is allocated") {
    Random random(7);
    const std::vector<SkinMatrix> palette = anyPalette(random);
    const SkinnedMesh mesh = anyMesh(77, 0, random);
    Skin skin(77);
    Skin alone(77);
    const std::size_t before = test::allocationCount();
    skinVertices(mesh, palette, skin.positions, skin.normals, skin.tangents);
    skinVertices(mesh, palette, alone.positions, {});
    CHECK(test::allocationCount() == before);
    CHECK(alone.positions == skin.positions);
}
