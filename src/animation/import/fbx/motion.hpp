#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "animation/import/fbx/curve.hpp"
#include "animation/import/fbx/node_transform.hpp"
#include "animation/import/fbx/objects.hpp"

namespace lutka::animation::rig_import::fbx {

/// Curves for a part of a node's transform. A coordinate without a curve has its default.
struct AnimatedPart {
    int node = -1;  ///< Scene node.
    Part part = Part::translation;
    std::array<std::optional<Curve>, 3> curves;
    dvec3 defaults{0};

    [[nodiscard]] dvec3 at(double seconds) const;
};

/// How a layer's values meet those of the layers below it.
enum class Blend { replace, add, mix };

struct MotionLayer {
    Blend blend = Blend::replace;
    double weight = 1.0;            ///< [0, 1]
    std::optional<Curve> weights;   ///< The weight over time, in percent, where it changes.
    bool rotationsByAngle = false;  ///< Angles are added one by one, not the rotations composed.
    bool scalesAdd = false;         ///< Scales are added, not multiplied.
    std::vector<AnimatedPart> parts;
};

/// An AnimationStack (FBX 7) or a take (FBX 6).
struct Motion {
    std::string name;
    std::optional<std::pair<double, double>> span;  ///< Seconds, as the file states it.
    std::vector<MotionLayer> layers;                ///< Those with curves; the lowest first.
};

/// All motions of the document that move nodes.
[[nodiscard]] std::vector<Motion> readMotions(const Document& document, const Objects& objects,
                                              const std::map<int, int>& nodeOfModel);

/// Replaces in `transform` what the motion says of that node at a time.
class MotionPlayer {
  public:
    /// `transforms` are the nodes' own; all outlive the player.
    MotionPlayer(const Motion& motion, const std::vector<NodeTransform>& transforms)
        : motion_(motion), own_(transforms) {}

    /// All nodes' transforms at that time, into `out`.
    void pose(double seconds, std::vector<NodeTransform>& out) const;

  private:
    const Motion& motion_;
    const std::vector<NodeTransform>& own_;
};

}  // namespace lutka::animation::rig_import::fbx
