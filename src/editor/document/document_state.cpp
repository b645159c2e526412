#include "editor/document/document_state.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "physics/fit/edit_bodies.hpp"

namespace lutka::editor {
namespace {

using animation::HumanoidMap;
using Fixed = std::array<std::optional<int>, animation::kRoleCount>;

// Two roles on one joint can only come from the user's own choices.
std::optional<Error> checkTwice(const animation::Character& character, const Fixed& fixed) {
    for (int a = 0; a < animation::kRoleCount; ++a) {
        for (int b = a + 1; b < animation::kRoleCount; ++b) {
            if (!fixed[a] || fixed[a] != fixed[b] || *fixed[a] == animation::kNoJoint) continue;
            return Error{
                ErrorCode::input,
                fmt::format("the joint \"{}\" cannot be both {} and {}", character.skeleton.names[*fixed[a]],
                            animation::roleName(animation::roleAt(a)), animation::roleName(animation::roleAt(b))),
                "", "unmap one of them first"};
        }
    }
    return std::nullopt;
}

}  // namespace

BodySet bodySetBetween(const physics::RagdollProfile& fitted, const physics::RagdollProfile& given) {
    BodySet set;
    for (const physics::BodyProfile& body : given.bodies) {
        if (physics::bodyNamed(fitted, body.name) < 0 && !body.role) set.addedJoints.push_back(body.jointPath);
    }
    for (const physics::BodyProfile& body : fitted.bodies) {
        if (physics::bodyNamed(given, body.name) < 0) set.removed.push_back(body.name);
    }
    return set;
}

physics::RagdollProfile withBodySet(physics::RagdollProfile fitted, const animation::Character& character,
                                    const HumanoidMap& map, const BodySet& bodies) {
    const auto take = [&](Result<physics::RagdollProfile> changed) {
        if (changed) fitted = std::move(changed).value();
    };
    for (const std::string& path : bodies.addedJoints) {
        const int joint = animation::findJoint(character.skeleton, path);
        if (joint != animation::kNoJoint) take(physics::addBody(fitted, character, map, joint));
    }
    for (const std::string& name : bodies.removed) {
        const int body = physics::bodyNamed(fitted, name);
        if (body > 0) take(physics::removeBody(fitted, character, body));
    }
    return fitted;
}

void takeFixedTo(DocumentState& state, const animation::Skeleton& from, const animation::Skeleton& to) {
    for (std::optional<int>& joint : state.fixed) {
        if (!joint || *joint == animation::kNoJoint) continue;
        const int found = animation::findJoint(to, animation::jointPath(from, *joint));
        joint = found != animation::kNoJoint ? std::optional(found) : std::nullopt;
    }
}

Result<HumanoidMap> mapWithFixed(const animation::Character& character, const Fixed& fixed) {
    if (const auto twice = checkTwice(character, fixed)) return *twice;
    animation::MapOptions options;
    for (int role = 0; role < animation::kRoleCount; ++role) {
        if (fixed[role] && *fixed[role] != animation::kNoJoint) options.fixed[role] = fixed[role];
    }
    HumanoidMap map = animation::mapHumanoid(character, options);
    if (!map.humanoid) {
        return Error{ErrorCode::input,
                     "with these bindings the figure is not a humanoid: " +
                         (map.warnings.empty() ? std::string("no reason was given") : map.warnings.front()),
                     "", "assign another joint"};
    }
    for (int role = 0; role < animation::kRoleCount; ++role) {
        if (fixed[role] != animation::kNoJoint) continue;
        if (animation::isRequired(animation::roleAt(role))) {
            return Error{ErrorCode::input,
                         fmt::format("{} is required and cannot be left without a joint",
                                     animation::roleName(animation::roleAt(role))),
                         "", "assign another joint instead"};
        }
        map.roles[role].reset();
    }
    return map;
}

}  // namespace lutka::editor
