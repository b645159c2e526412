// skinning MODEL...: linear blend skinning of positions and normals on the CPU, the plain loop beside the wide kernel
// compiled with the same flags, one row a model, as CSV; and by how many degrees normals turned by the blended matrix
// are off those turned by its inverse transpose, every joint bent at random by up to 30, 60 and 90 degrees.
//
// Many short rounds in turn and their medians: on a machine that others share, ratios taken side by side travel.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "animation/import/import_character.hpp"
#include "animation/pose.hpp"
#include "animation/skinning.hpp"
#include "core/random.hpp"
#include "timing.hpp"

namespace {

using namespace lutka;

constexpr int kRounds = 101;
constexpr double kVerticesARound = 40000;  // a fraction of a millisecond

struct Buffers {
    std::vector<std::vector<vec3>> positions, normals;
};

using Skin = void (*)(InstructionSet, const animation::SkinnedMesh&, std::span<const animation::SkinMatrix>,
                      std::span<vec3>, std::span<vec3>, std::span<vec4>);

double nsAVertex(Skin skin, InstructionSet set, const animation::Character& character,
                 std::span<const animation::SkinMatrix> palette, Buffers& out, double vertices) {
    const int passes = std::max(1, static_cast<int>(kVerticesARound / vertices));
    const auto before = std::chrono::steady_clock::now();
    for (int pass = 0; pass < passes; ++pass) {
        for (std::size_t i = 0; i < character.meshes.size(); ++i)
            skin(set, character.meshes[i], palette, out.positions[i], out.normals[i], {});
    }
    const auto taken = std::chrono::steady_clock::now() - before;
    return std::chrono::duration<double, std::nano>(taken).count() / (vertices * passes);
}

std::vector<animation::SkinMatrix> bentPalette(const animation::Skeleton& skeleton, float mostDeg, Random& random) {
    std::vector<RigidTransform> local(skeleton.parents.size());
    std::vector<RigidTransform> model(skeleton.parents.size());
    animation::modelToLocal(skeleton, skeleton.bindModelFromJoint, local);
    for (RigidTransform& joint : local) {
        const vec3 axis{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0.1F, 1)};
        joint.rotation = joint.rotation * glm::angleAxis(radians(random.uniform(0, mostDeg)), glm::normalize(axis));
    }
    animation::localToModel(skeleton, local, model);
    std::vector<animation::SkinMatrix> palette(skeleton.parents.size());
    animation::skinMatrices(skeleton.bindModelFromJoint, model, palette);
    return palette;
}

double normalErrorDeg(const animation::SkinnedMesh& mesh, std::size_t vertex,
                      std::span<const animation::SkinMatrix> palette) {
    glm::dmat3 blended(0.0);
    for (int slot = 0; slot < animation::kMaxInfluences; ++slot) {
        const animation::SkinMatrix& matrix = palette[mesh.joints[vertex][slot]];
        for (int row = 0; row < 3; ++row) {
            for (int column = 0; column < 3; ++column)
                blended[column][row] += static_cast<double>(mesh.weights[vertex][slot] * matrix.rows[row][column]);
        }
    }
    // The inverse transpose but for its length.
    glm::dmat3 cofactors(glm::cross(blended[1], blended[2]), glm::cross(blended[2], blended[0]),
                         glm::cross(blended[0], blended[1]));
    if (glm::dot(blended[0], cofactors[0]) < 0.0) cofactors *= -1.0;
    const glm::dvec3 normal(mesh.normals[vertex]);
    const double cosine = glm::dot(glm::normalize(blended * normal), glm::normalize(cofactors * normal));
    return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / 3.14159265358979;
}

void printNormalErrors(const animation::Character& character) {
    Random random(7);
    std::vector<double> errors;
    for (const float mostDeg : {30.0F, 60.0F, 90.0F}) {
        const auto palette = bentPalette(character.skeleton, mostDeg, random);
        for (const animation::SkinnedMesh& mesh : character.meshes) {
            for (std::size_t vertex = 0; vertex < mesh.positions.size(); ++vertex)
                errors.push_back(normalErrorDeg(mesh, vertex, palette));
        }
    }
    std::sort(errors.begin(), errors.end());
    const auto at = [&](double share) {
        return errors[static_cast<std::size_t>(share * static_cast<double>(errors.size() - 1))];
    };
    fmt::print(",{:.1f},{:.1f},{:.1f},{:.1f}", at(0.5), at(0.95), at(0.99), at(1.0));
}

void measure(const std::string& file, const animation::Character& character) {
    Buffers out;
    double vertices = 0;
    double influences = 0;
    for (const animation::SkinnedMesh& mesh : character.meshes) {
        out.positions.emplace_back(mesh.positions.size());
        out.normals.emplace_back(mesh.positions.size());
        vertices += static_cast<double>(mesh.positions.size());
        for (const auto& weights : mesh.weights)
            influences +=
                static_cast<double>(std::count_if(weights.begin(), weights.end(), [](float w) { return w != 0; }));
    }
    if (vertices == 0) return;
    std::vector<animation::SkinMatrix> palette(character.skeleton.parents.size());
    const std::vector<RigidTransform>& bind = character.skeleton.bindModelFromJoint;
    std::vector<RigidTransform> pose = bind;
    for (RigidTransform& joint : pose)
        joint.rotation = joint.rotation * glm::angleAxis(0.3F, vec3(1, 0, 0));
    animation::skinMatrices(bind, pose, palette);
    fmt::print("{},{:.0f},{:.2f}", file, vertices, influences / vertices);
    const auto run = [&](InstructionSet set) {
        std::vector<double> plain, wide, ratio;
        for (int round = 0; round < kRounds; ++round) {
            plain.push_back(nsAVertex(animation::skinVerticesByScalars, set, character, palette, out, vertices));
            wide.push_back(nsAVertex(animation::skinVertices, set, character, palette, out, vertices));
            ratio.push_back(plain.back() / wide.back());
        }
        fmt::print(",{:.2f},{:.2f},{:.2f}", medianOf(plain), medianOf(wide), medianOf(ratio));
    };
    run(InstructionSet::baseline);
    if (hasInstructionSet(InstructionSet::avx2))
        run(InstructionSet::avx2);
    else
        fmt::print(",,,");
    printNormalErrors(character);
    fmt::print("\n");
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) {
        fmt::print(stderr, "usage: skinning MODEL...\n");
        return 2;
    }
    fmt::print(
        "model,vertices,joints_a_vertex,plain_ns,four_wide_ns,ratio,plain_avx2_ns,eight_wide_ns,ratio_avx2,"
        "normal_p50_deg,normal_p95_deg,normal_p99_deg,normal_max_deg\n");
    animation::ImportOptions options;
    options.loadTextures = false;
    for (int i = 1; i < argc; ++i) {
        const auto character = animation::importCharacter(argv[i], options);
        if (character)
            measure(argv[i], character.value());
        else
            fmt::print(stderr, "{}\n", character.error().text());
    }
    return 0;
}
