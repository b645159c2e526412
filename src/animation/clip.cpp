#include "animation/clip.hpp"

#include <algorithm>

#include "core/assert.hpp"

namespace lutka::animation {

void sampleClip(const Clip& clip, float seconds, std::span<RigidTransform> parentFromJoint) {
    const std::size_t joints = parentFromJoint.size();
    LUTKA_ASSERT(clip.frameCount >= 1);
    LUTKA_ASSERT(clip.parentFromJoint.size() == joints * static_cast<std::size_t>(clip.frameCount));
    const float last = static_cast<float>(clip.frameCount - 1);
    const float at = std::clamp(seconds * clip.framesPerSecond, 0.0F, last);
    const auto before = static_cast<std::size_t>(at);
    const std::size_t after = std::min<std::size_t>(before + 1, static_cast<std::size_t>(clip.frameCount) - 1);
    const float alpha = at - static_cast<float>(before);
    for (std::size_t joint = 0; joint < joints; ++joint) {
        parentFromJoint[joint] = interpolate(clip.parentFromJoint[before * joints + joint],
                                             clip.parentFromJoint[after * joints + joint], alpha);
    }
}

}  // namespace lutka::animation
