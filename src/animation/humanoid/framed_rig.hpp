#pragma once

#include <array>
#include <span>
#include <vector>

#include "animation/humanoid/mirror_planes.hpp"
#include "animation/humanoid/rig_features.hpp"

namespace lutka::animation {

/// Axes in which a figure would stand upright: x across the mirror plane, y up, z = x × y. Whether +z or -z is the
/// front, and so which half is the left, is settled last.
struct Stance {
    MirrorPlane plane;
    vec3 up;
    bool byNames = false;  ///< Read off the names: +x is the side that they call left, and they pair the joints first.

    [[nodiscard]] vec3 across() const { return plane.normal; }
    [[nodiscard]] vec3 through() const;
};

/// Two joints that are each other's mirror image.
struct JointPair {
    std::array<int, 2> joints;  ///< [0] on the +x half, [1] on the -x half.
    vec3 position;              ///< In the stance, mean of the two with the second mirrored: x >= 0 as a rule.
    PartScores names;           ///< Mean of both names' evidence.
    float ownWeight;            ///< Sum of both, share of the skin.
    float subtreeWeight;
    bool shadow;  ///< Both coincide with joints they belong to (RigFeatures::shadow).
    bool helper;  ///< By its name.
};

struct Box {
    vec3 low{1e30F};
    vec3 high{-1e30F};
    vec3 sum{0};
    int count = 0;

    void add(const vec3& point);
    void add(const Box& other);
    [[nodiscard]] vec3 mean() const { return count > 0 ? sum / static_cast<float>(count) : vec3(0); }
};

/// The rig seen in a stance: positions, vertices and mirror pairs in its axes.
struct FramedRig {
    const RigFeatures* rig = nullptr;
    Stance stance;
    std::vector<vec3> positions;
    std::vector<Box> ownSkin;        ///< Vertices that each joint moves most.
    std::vector<Box> subtreeSkin;    ///< … and all below it but what is held by its name; like the next.
    std::vector<Box> subtreeJoints;  ///< Joints with skin at or below each joint (all joints where there is no skin).
    std::vector<JointPair> pairs;
    std::vector<int> pairOf;  ///< Per joint: index of its pair, or -1 for a central or lonely joint.
    float floor = 0.0F;       ///< Lowest y of the figure, without the lowest hundredth of its vertices.
    float spread = 0.0F;

    /// Whether both joints of pair `upper` are above those of pair `lower` in the tree.
    [[nodiscard]] bool isAbove(int upper, int lower) const;
    /// Whether both joints are ends of blocks, which move the corners there: no skin goes on beyond them.
    [[nodiscard]] bool isTip(const JointPair& pair) const;
    [[nodiscard]] float segment(int pairA, int pairB) const;  ///< Mean distance of the two sides.
};

[[nodiscard]] FramedRig frameRig(const RigFeatures& rig, const Stance& stance);

}  // namespace lutka::animation
