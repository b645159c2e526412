#include "animation/import/fbx/scene_layout.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace lutka::animation::rig_import::fbx {
namespace {

bool isUneven(const dvec3& scale) {
    const double most = std::max({std::abs(scale.x), std::abs(scale.y), std::abs(scale.z)});
    return std::abs(scale.x - scale.y) + std::abs(scale.y - scale.z) > 1e-9 * most;
}

std::vector<bool> unevenNodes(const ModelTree& tree, std::span<const Motion> motions) {
    std::vector<bool> out(tree.parents.size(), false);
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = isUneven(tree.transforms[i][Part::scaling]);
    for (const Motion& motion : motions) {
        for (const MotionLayer& layer : motion.layers) {
            for (const AnimatedPart& part : layer.parts) {
                const bool moves = std::any_of(part.curves.begin(), part.curves.end(),
                                               [](const auto& curve) { return curve && curve->moves(); });
                if (part.part == Part::scaling && (moves || isUneven(part.defaults)))
                    out[static_cast<std::size_t>(part.node)] = true;
            }
        }
    }
    return out;
}

}  // namespace

SceneLayout layoutOf(const ModelTree& tree, std::span<const Motion> motions) {
    const std::vector<bool> uneven = unevenNodes(tree, motions);
    SceneLayout out;
    int next = 0;
    for (std::size_t i = 0; i < tree.parents.size(); ++i) {
        const int parent = tree.parents[i];
        const bool split = parent >= 0 && uneven[static_cast<std::size_t>(parent)] &&
                           tree.transforms[i].inherit == Inherit::withoutScale;
        out.helper.push_back(split ? next++ : -1);
        out.sceneNode.push_back(next++);
    }
    return out;
}

dmat4 parentFromHelper(const dmat4& parentFromNode, const NodeTransform& parent) {
    const dmat4 place = glm::translate(dmat4(1.0), dvec3(parentFromNode[3]));
    return glm::scale(place, 1.0 / usableScale(parent[Part::scaling]));
}

}  // namespace lutka::animation::rig_import::fbx
