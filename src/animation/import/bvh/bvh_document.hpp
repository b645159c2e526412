#pragma once

#include <array>
#include <cstddef>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"

namespace lutka::animation::rig_import::bvh {

/// A channel of a joint: which axis, and whether it turns or moves.
struct Channel {
    int axis = 0;
    bool turns = true;
};

struct Joint {
    std::string name;
    int parent = -1;
    glm::dvec3 offset{0};           ///< From the parent.
    std::vector<Channel> channels;  ///< In the file's order; rotations apply from the last to the first.
    std::size_t firstValue = 0;     ///< Place of its first channel in a frame.
};

/// A BVH file: joints, parents before children in the file's order, and the frames of its motion. End sites are joints
/// without channels, named "EndSite_" and their parent's name.
struct BvhDocument {
    std::vector<Joint> joints;
    std::size_t channelCount = 0;
    double frameSeconds = 1.0 / 30.0;
    std::vector<float> frames;  ///< channelCount numbers a frame.
    std::vector<std::string> warnings;

    [[nodiscard]] std::size_t frameCount() const { return channelCount > 0 ? frames.size() / channelCount : 0; }

    /// A joint in a frame: position channels replace the offset, one by one.
    [[nodiscard]] glm::dmat4 parentFromJoint(std::size_t joint, std::size_t frame) const;
};

/// Whether the text is that of a BVH file.
[[nodiscard]] bool isBvh(std::string_view beginning);

/// Parses the text, with any kind of line ends and blanks. Frames that are cut off are left out, with a warning. Fails
/// with ErrorCode::input when the hierarchy is damaged, has more than 65,535 joints or is deeper than 4,096, or when
/// the motion has more than 64 million numbers.
[[nodiscard]] Result<BvhDocument> parseBvh(std::string_view text, const std::string& location);

}  // namespace lutka::animation::rig_import::bvh
