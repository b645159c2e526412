#include "animation/counted_vertices.hpp"

#include <algorithm>

namespace lutka::animation {

std::vector<std::size_t> countedVertices(const Character& character) {
    constexpr float kMostOfRigidMesh = 0.25F;
    std::size_t skinned = 0;
    for (const SkinnedMesh& mesh : character.meshes)
        skinned += mesh.rigid ? 0 : mesh.positions.size();
    const auto most = static_cast<std::size_t>(kMostOfRigidMesh * static_cast<float>(skinned));
    std::vector<std::size_t> counted;
    for (const SkinnedMesh& mesh : character.meshes) {
        const bool limited = mesh.rigid && skinned > 0;
        counted.push_back(limited ? std::min(mesh.positions.size(), most) : mesh.positions.size());
    }
    return counted;
}

}  // namespace lutka::animation
