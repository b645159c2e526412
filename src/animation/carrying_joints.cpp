#include "animation/carrying_joints.hpp"

#include <cstddef>

namespace lutka::animation {

CarryingJoints carryingJoints(const Character& character) {
    const std::size_t count = character.skeleton.names.size();
    CarryingJoints carrying{std::vector<bool>(count, false), std::vector<bool>(count, false)};
    for (const SkinnedMesh& mesh : character.meshes) {
        if (mesh.rigid) {
            if (!mesh.joints.empty() && mesh.joints[0][0] < count) carrying.rigid[mesh.joints[0][0]] = true;
            continue;
        }
        for (std::size_t i = 0; i < mesh.joints.size() && i < mesh.weights.size(); ++i) {
            for (int slot = 0; slot < kMaxInfluences; ++slot) {
                const std::size_t joint = mesh.joints[i][slot];
                if (mesh.weights[i][slot] > 0.0F && joint < count) carrying.skin[joint] = true;
            }
        }
    }
    return carrying;
}

}  // namespace lutka::animation
