#pragma once

#include <string>
#include <vector>

#include "animation/character.hpp"
#include "animation/humanoid/map_humanoid.hpp"

namespace lutka::test {

/// A joint of a hand-made rig: its bind position in model space (metres), identity rotation.
struct JointSpec {
    std::string name;
    int parent;
    vec3 position;
};

/// A skeleton whose bind and node poses agree.
[[nodiscard]] animation::Skeleton makeSkeleton(const std::vector<JointSpec>& joints);

/// A closed tube of skin around the way from a joint to `end`, moved by that joint alone.
struct TubeSpec {
    int joint;
    vec3 end;
    float radius;  ///< Its end rings are drawn in to half of it.
};

/// A figure of tubes.
[[nodiscard]] animation::Character makeFigure(const std::string& name, const std::vector<JointSpec>& joints,
                                              const std::vector<TubeSpec>& tubes);

/// A standing 1.75 m figure in T-pose facing +Z with the 20 joints of `biped()` and a box-limbed skin: what unit tests
/// use where a real model would hide the answer.
[[nodiscard]] animation::Character makeBiped();

/// A four-legged creature of 1 m, facing +Z: a control as root, trunk of three joints, neck, head with jaw and eyes, a
/// tail of four joints, legs of three with a twist joint in each thigh.
[[nodiscard]] animation::Character makeQuadruped();

/// makeBiped() with a tail of three joints, two ears, hair of two joints, fingers and a sword in the right hand.
[[nodiscard]] animation::Character makeBipedWithAppendages();

/// A joint "Scene" without skin above all that the figure has; its joints, and those of the map, move up by one.
void addRoot(animation::Character& figure, animation::HumanoidMap& map);

/// So many boxes beside the figure, each a mesh without a skin on a node of its own called by `name` and a number,
/// below a root "room". They hang on nodes "group" of so many each, where `group` is not 0.
void addParts(animation::Character& character, int count, const std::string& name, int group = 0);

/// The map of makeBiped(), exact.
[[nodiscard]] animation::HumanoidMap mapOfBiped(const animation::Character& biped);

}  // namespace lutka::test
