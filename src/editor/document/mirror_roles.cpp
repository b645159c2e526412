#include "editor/document/mirror_roles.hpp"

#include <fmt/format.h>

#include <glm/geometric.hpp>

namespace lutka::editor {
namespace {

using animation::Role;

// The joint nearest to the mirror image of `joint` in the standard stance; kNoJoint when none is within a tenth of the
// figure's height.
int mirroredJoint(const animation::Character& character, const DocumentState& state, int joint) {
    const auto& frames = character.skeleton.bindModelFromJoint;
    const quat& standard = state.map.standardFromModel;
    const float middle = (standard * frames[state.map.jointOf(Role::hips)].translation).x;
    vec3 wanted = standard * frames[joint].translation;
    wanted.x = 2.0F * middle - wanted.x;
    int best = animation::kNoJoint;
    float bestDistance = state.profile.heightM * 0.1F;
    for (int other = 0; other < character.skeleton.jointCount(); ++other) {
        const float distance = glm::distance(standard * frames[other].translation, wanted);
        // Helpers often share a place with the joint that deforms; the skin tells them apart.
        const bool deforms =
            character.skeleton.skinWeight[other] > 0.0F || character.skeleton.skinWeight[joint] <= 0.0F;
        if (other == joint || !deforms || distance >= bestDistance) continue;
        best = other;
        bestDistance = distance;
    }
    return best;
}

}  // namespace

Result<void> mirrorFixed(DocumentState& state, const animation::Character& character, animation::Side from) {
    for (int i = 0; i < animation::kRoleCount; ++i) {
        const Role role = animation::roleAt(i);
        const int joint = state.map.jointOf(role);
        if (animation::sideOf(role) != from || joint == animation::kNoJoint) continue;
        const int other = mirroredJoint(character, state, joint);
        if (other == animation::kNoJoint) {
            return Error{ErrorCode::input,
                         fmt::format("\"{}\" has no joint opposite to it", character.skeleton.names[joint]), "",
                         "assign the role by hand"};
        }
        state.fixed[i] = joint;
        state.fixed[animation::indexOf(animation::mirrored(role))] = other;
    }
    return {};
}

}  // namespace lutka::editor
