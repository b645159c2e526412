#pragma once

#include <string>
#include <vector>

#include "animation/humanoid/map_humanoid.hpp"
#include "support/rigs.hpp"

namespace lutka::test {

/// That place on the left, which is side 0, or its mirror image.
inline vec3 onSide(const vec3& place, int side) {
    return side == 0 ? place : place * vec3(-1, 1, 1);
}

/// A skeleton of joints that a test places one by one.
struct PlacedJoints {
    std::vector<JointSpec> joints;
    std::vector<float> skin;  ///< Weight that each joint moves, where the figure has a skin.

    /// Returns the joint's index.
    int add(const std::string& name, int parent, const vec3& place, float weight = 100.0F) {
        joints.push_back({name, parent, place});
        skin.push_back(weight);
        return static_cast<int>(joints.size()) - 1;
    }

    [[nodiscard]] const vec3& placeOf(int joint) const { return joints[static_cast<std::size_t>(joint)].position; }

    [[nodiscard]] animation::HumanoidMap map(bool skinned) const {
        animation::Character character;
        character.skeleton = makeSkeleton(joints);
        character.skeleton.skinWeight = skinned ? skin : std::vector<float>(joints.size(), 0.0F);
        return animation::mapHumanoid(character);
    }

    /// Of the joint that has the role; "none" without one.
    [[nodiscard]] std::string nameOf(const animation::HumanoidMap& map, animation::Role role) const {
        const int joint = map.jointOf(role);
        return joint == animation::kNoJoint ? "none" : joints[static_cast<std::size_t>(joint)].name;
    }
};

}  // namespace lutka::test
