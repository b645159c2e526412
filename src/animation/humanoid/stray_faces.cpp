#include "animation/humanoid/stray_faces.hpp"

#include <cstddef>
#include <glm/geometric.hpp>
#include <limits>

namespace lutka::animation {

std::vector<int> countStrayFaces(const FramedRig& framed, const std::vector<int>& central, int armRoot, float lowest) {
    const RigFeatures& rig = *framed.rig;
    std::vector<int> faces(static_cast<std::size_t>(rig.count()), 0);
    for (int face = 0; face < rig.count(); ++face) {
        const int parent = rig.parents[face];
        if (!rig.names[face].face || framed.positions[face].y < lowest) continue;
        if (parent != kNoJoint && !rig.isAncestorOrSelf(parent, armRoot)) continue;
        int nearest = kNoJoint;
        float least = std::numeric_limits<float>::max();
        for (const int joint : central) {
            const float distance = glm::distance(framed.positions[joint], framed.positions[face]);
            if (rig.names[joint].face || distance >= least) continue;
            least = distance;
            nearest = joint;
        }
        if (nearest != kNoJoint) ++faces[static_cast<std::size_t>(nearest)];
    }
    return faces;
}

}  // namespace lutka::animation
