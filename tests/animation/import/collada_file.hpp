#pragma once

#include <string>
#include <vector>

#include "core/math.hpp"

namespace lutka::test {

/// A Collada document of a strip 1.8 m tall on the joints low, middle and high, at the heights 0, 0.6 and 1.2 m, each
/// of which moves two of its eight vertices (those at 0 and 0.6 m the lowest). Its parts are texts that a test changes.
struct ColladaFile {
    std::string jointNames = "low middle high";  ///< As the skin lists them.
    std::string jointList = "Name_array";        ///< The element that lists them.
    std::string nodes;                           ///< In the scene.
    std::string animations;
    std::string clips;
    std::string scene = "<scene><instance_visual_scene url=\"#s\"/></scene>";

    [[nodiscard]] std::string text() const;
};

/// The three joints below each other, with ids that start with `prefix`, sids as ColladaFile::jointNames has them, and
/// `high` turned about Z. Each is a <translate sid="t">, a <rotate sid="rz"> and a <matrix sid="m"> of no effect.
[[nodiscard]] std::string colladaJoints(const std::string& prefix, float turnOfHighDeg = 0.0F);

/// What shows the skin, on a skeleton (none: empty).
[[nodiscard]] std::string colladaBody(const std::string& id, const std::string& skeleton);

/// The sources, the sampler and the channel of a straight curve; `id` begins all ids.
[[nodiscard]] std::string colladaChannel(const std::string& id, const std::string& target,
                                         const std::vector<float>& times, const std::vector<float>& values,
                                         int stride = 1, const std::string& params = "<param type=\"float\"/>");

}  // namespace lutka::test
