// Draw the skin yourself: a palette a doll for the GPU, or skinned vertices from the CPU.
#include <cmath>
#include <cstdio>

#include "animation/skinning.hpp"
#include "scene/run/simulation.hpp"

using namespace lutka;

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    const auto ragdoll = scene::loadRagdoll(argv[1]);
    if (!ragdoll) {
        std::fprintf(stderr, "%s\n", ragdoll.error().text().c_str());
        return 3;
    }
    const scene::RagdollAsset& asset = *ragdoll.value();
    auto scenario = scene::makeScenario({.name = "spread", .count = 10, .seed = 1}, asset);
    if (!scenario) return 2;
    scene::SimulationOptions options;
    options.measure = false;  // no quality figures: a game does not need them
    auto created = scene::Simulation::create(asset, std::move(scenario).value(), options);
    if (!created) return 2;
    scene::Simulation& simulation = *created.value();
    float lowest = 1e9F;
    // [howto]
    for (int step = 0; step < 120; ++step)
        simulation.step();
    const float alpha = 0.5F;  // half way between the last two steps: what a frame loop has left over
    const scene::PosedSkins& skins = simulation.poseSkins(alpha);  // all dolls at once
    for (int doll = 0; doll < simulation.dollCount(); ++doll) {
        // For a vertex shader: 3 x 4 matrices by rows, model space; then worldFromModel.
        const std::span<const animation::SkinMatrix> palette = skins.palette(doll);
        const RigidTransform& worldFromModel = simulation.worldFromModel(doll);
        // The same on the CPU, for engines that want vertices.
        for (const animation::SkinnedMesh& mesh : asset.character.meshes) {
            std::vector<vec3> positions(mesh.positions.size());
            std::vector<vec3> normals(mesh.positions.size());
            animation::skinVertices(mesh, palette, positions, normals);
            for (const vec3& position : positions)
                lowest = std::min(lowest, (worldFromModel * position).y);
        }
    }
    // [/howto]
    std::printf("the lowest vertex is at %.3f m\n", static_cast<double>(lowest));
    return std::abs(lowest) < 0.15F ? 0 : 1;
}
