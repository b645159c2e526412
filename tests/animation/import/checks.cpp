#include "animation/import/checks.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "animation/pose.hpp"
#include "animation/skinning.hpp"
#include "support/catch.hpp"

namespace lutka::test {

using namespace animation;

Character imported(const std::filesystem::path& file, const ImportOptions& options) {
    Result<Character> result = importCharacter(file, options);
    if (!result) FAIL(result.error().text());
    return std::move(result).value();
}

std::vector<vec3> bindVertices(const Character& character) {
    std::vector<vec3> out;
    for (const SkinnedMesh& mesh : character.meshes)
        out.insert(out.end(), mesh.positions.begin(), mesh.positions.end());
    return out;
}

float largestError(const Character& character, const std::vector<RigidTransform>& modelFromJoint,
                   const std::vector<vec3>& expected) {
    std::vector<SkinMatrix> palette(modelFromJoint.size());
    skinMatrices(character.skeleton.bindModelFromJoint, modelFromJoint, palette);
    float worst = 0.0F;
    std::size_t first = 0;
    for (const SkinnedMesh& mesh : character.meshes) {
        std::vector<vec3> posed(mesh.positions.size());
        skinVertices(mesh, palette, posed, {});
        REQUIRE(first + posed.size() <= expected.size());
        for (std::size_t v = 0; v < posed.size(); ++v)
            worst = std::max(worst, glm::distance(posed[v], expected[first + v]));
        first += posed.size();
    }
    CHECK(first == expected.size());
    return worst;
}

namespace {

// Counts instead of one assertion a vertex: thousands of passed assertions say no more than one.
void checkMesh(const SkinnedMesh& mesh, const Character& character, std::vector<double>& weightOfJoint) {
    const std::size_t count = mesh.positions.size();
    REQUIRE(mesh.normals.size() == count);
    REQUIRE(mesh.joints.size() == count);
    REQUIRE(mesh.weights.size() == count);
    CHECK((mesh.uvs.empty() || mesh.uvs.size() == count));
    CHECK(mesh.tangents.size() == mesh.uvs.size());
    CHECK(mesh.indices.size() % 3 == 0);
    CHECK(mesh.material >= 0);
    CHECK(mesh.material < static_cast<int>(character.materials.size()));
    int badIndices = 0;
    for (const std::uint32_t index : mesh.indices)
        badIndices += index < count ? 0 : 1;
    CHECK(badIndices == 0);
    int badVertices = 0;
    int badWeights = 0;
    for (std::size_t v = 0; v < count; ++v) {
        const bool unit = std::abs(glm::length(mesh.normals[v]) - 1.0F) < 1e-3F;
        badVertices += isFinite(mesh.positions[v]) && unit ? 0 : 1;
        const auto& w = mesh.weights[v];
        const bool sorted = w[0] >= w[1] && w[1] >= w[2] && w[2] >= w[3] && w[3] >= 0.0F;
        const bool whole = std::all_of(w.begin(), w.end(), [](float x) { return x == 0.0F || std::isnormal(x); });
        badWeights += sorted && whole && std::abs(w[0] + w[1] + w[2] + w[3] - 1.0F) < 1e-5F ? 0 : 1;
        for (int i = 0; i < kMaxInfluences; ++i) {
            REQUIRE(mesh.joints[v][i] < character.skeleton.jointCount());
            weightOfJoint[mesh.joints[v][i]] += w[i];
        }
    }
    CHECK(badVertices == 0);
    CHECK(badWeights == 0);
}

}  // namespace

void checkInvariants(const Character& character) {
    const Skeleton& skeleton = character.skeleton;
    const std::vector<std::string> problems = validate(skeleton);
    for (const std::string& problem : problems)
        UNSCOPED_INFO(problem);
    REQUIRE(problems.empty());
    std::vector<double> weightOfJoint(skeleton.parents.size(), 0.0);
    for (const SkinnedMesh& mesh : character.meshes)
        checkMesh(mesh, character, weightOfJoint);
    int wrongSums = 0;
    for (std::size_t joint = 0; joint < weightOfJoint.size(); ++joint) {
        const double difference = std::abs(weightOfJoint[joint] - skeleton.skinWeight[joint]);
        wrongSums += difference <= 1e-3 * std::max(1.0, weightOfJoint[joint]) ? 0 : 1;
    }
    CHECK(wrongSums == 0);
    CHECK(largestError(character, skeleton.bindModelFromJoint, bindVertices(character)) < 1e-5F);
    for (const Clip& clip : character.clips) {
        CHECK(clip.frameCount >= 1);
        CHECK(clip.framesPerSecond > 0.0F);
        CHECK(clip.parentFromJoint.size() == skeleton.parents.size() * static_cast<std::size_t>(clip.frameCount));
        const auto bad = std::count_if(clip.parentFromJoint.begin(), clip.parentFromJoint.end(), [](const auto& frame) {
            return !isFinite(frame) || std::abs(glm::length(frame.rotation) - 1.0F) > 1e-3F;
        });
        CHECK(bad == 0);
    }
}

bool warns(const Character& character, const std::string& text) {
    return std::any_of(character.warnings.begin(), character.warnings.end(),
                       [&](const std::string& warning) { return warning.find(text) != std::string::npos; });
}

}  // namespace lutka::test
