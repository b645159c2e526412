#include "export/doll_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "physics/collision/shape.hpp"
#include "physics/profile/constraint_frames.hpp"

namespace lutka::exporting {

using physics::ConstraintProfile;
using physics::RagdollProfile;

namespace {

// Letters, digits and single underscores of ASCII, a letter first.
std::string identifier(const std::string& name) {
    std::string word;
    for (const char c : name) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
        if (plain || word.empty() || word.back() != '_') word += plain ? c : '_';
    }
    const bool startsWell = !word.empty() && (word[0] < '0' || word[0] > '9') && word[0] != '_';
    return startsWell ? word : "body_" + word;
}

}  // namespace

quat zUpFromStandard() {
    return {0.5F, 0.5F, 0.5F, 0.5F};  // x → y, y → z, z → x
}

RigidTransform neutralParentFromChild(const ConstraintProfile& constraint) {
    return constraint.parentFromFrame * inverse(constraint.childFromFrame);
}

std::vector<RigidTransform> neutralPose(const ExportSource& source) {
    std::vector<RigidTransform> pose{source.rig.bindModelFromBody[0]};
    for (const ConstraintProfile& constraint : source.profile.constraints) {
        RigidTransform body = pose[constraint.parent] * neutralParentFromChild(constraint);
        body.rotation = glm::normalize(body.rotation);
        pose.push_back(body);
    }
    return pose;
}

quat bindRotation(const ExportSource& source, const ConstraintProfile& constraint) {
    return physics::relativeFrame(
        constraint, {source.rig.bindModelFromBody[constraint.parent], source.rig.bindModelFromBody[constraint.child]});
}

float bindHingeAngle(const ExportSource& source, const ConstraintProfile& constraint) {
    const quat relative = bindRotation(source, constraint);
    return std::remainder(2.0F * std::atan2(relative.z, relative.w), 2.0F * kPi);
}

float lowestPoint(const RagdollProfile& profile, std::span<const RigidTransform> spaceFromBody, const vec3& up) {
    float lowest = std::numeric_limits<float>::max();
    for (std::size_t i = 0; i < spaceFromBody.size(); ++i) {
        const vec3 bodyDown = glm::conjugate(spaceFromBody[i].rotation) * -up;
        const float reach = physics::supportExtent(profile.bodies[i].shape, bodyDown);
        lowest = std::min(lowest, glm::dot(spaceFromBody[i].translation, up) - reach);
    }
    return lowest;
}

RigidTransform standingFromModel(const ExportSource& source) {
    const quat& turn = source.profile.standardFromModel;
    const vec3 up = glm::conjugate(turn) * vec3(0, 1, 0);
    return {turn, vec3(0, -lowestPoint(source.profile, source.rig.bindModelFromBody, up), 0)};
}

std::string bodyName(const RagdollProfile& profile, int body) {
    // A name of a file's joint may hold anything; the number keeps apart what becomes equal, the two underscores keep
    // it from being another's name.
    const std::string& name = profile.bodies[body].name;
    std::string word = identifier(name);
    for (std::size_t other = 0; other < profile.bodies.size(); ++other) {
        const bool same = static_cast<int>(other) != body && identifier(profile.bodies[other].name) == word;
        if (same) return word + fmt::format("__{}", body);
    }
    return word;
}

std::string addedName(const std::string& body, std::size_t index) {
    return body + fmt::format("__shape{}", index + 2);
}

}  // namespace lutka::exporting
