#include "scene/start_pose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "animation/pose.hpp"

namespace lutka::scene {
namespace {

using physics::BodyState;

std::vector<BodyState> bodiesOf(const RagdollAsset& asset, std::span<const RigidTransform> modelFromJoint) {
    std::vector<BodyState> bodies(asset.profile.bodies.size());
    physics::bodiesFromPose(asset.rig, modelFromJoint, {}, bodies);
    return bodies;
}

std::vector<BodyState> bodiesAt(const RagdollAsset& asset, const animation::Clip& clip, float seconds) {
    std::vector<RigidTransform> pose(asset.character.skeleton.parents.size());
    animation::sampleClip(clip, seconds, pose);
    animation::localToModel(asset.character.skeleton, pose, pose);
    return bodiesOf(asset, pose);
}

Result<const animation::Clip*> findClip(const animation::Character& character, const std::string& name) {
    std::string known;
    for (const animation::Clip& clip : character.clips) {
        if (clip.name == name) return &clip;
        known += (known.empty() ? "" : ", ") + clip.name;
    }
    return Error{ErrorCode::usage, fmt::format("there is no clip named '{}'", name), character.file.string(),
                 known.empty() ? "the file has no clips" : "the clips are " + known};
}

// "a@1" may be a clip's own name, which a command line reads as one second into "a". Where no clip is called "a", it
// is.
ClipStart withWholeName(const animation::Character& character, const ClipStart& start) {
    const auto isNamed = [&](const animation::Clip& clip) { return clip.name == start.clip; };
    if (std::any_of(character.clips.begin(), character.clips.end(), isNamed)) return start;
    for (const animation::Clip& clip : character.clips) {
        if (!clip.name.starts_with(start.clip + "@")) continue;
        const char* number = clip.name.c_str() + start.clip.size() + 1;
        char* end = nullptr;
        const float seconds = std::strtof(number, &end);
        if (end != number && *end == '\0' && seconds == start.seconds) return {clip.name, 0.0F};
    }
    return start;
}

}  // namespace

Result<std::vector<BodyState>> startBodies(const RagdollAsset& asset, const SimulationOptions& options,
                                           const Placement& placement) {
    const bool own = placement.clip || placement.pose;
    std::optional<ClipStart> start = own ? placement.clip : options.fromClip;
    if (!start) {
        if (placement.pose.value_or(options.pose) == StartPose::bind) {
            return bodiesOf(asset, asset.character.skeleton.bindModelFromJoint);
        }
        return bodiesOf(asset, animation::nodePose(asset.character.skeleton));
    }
    start = withWholeName(asset.character, *start);
    const auto clip = findClip(asset.character, start->clip);
    if (!clip) return clip.error();
    const float length = clip.value()->seconds();
    constexpr float kRounding = 1e-3F;  // seconds
    if (start->seconds < 0.0F || start->seconds > length + kRounding) {
        return Error{ErrorCode::usage, fmt::format("clip '{}' has no pose at {} s", start->clip, start->seconds),
                     asset.character.file.string(), fmt::format("it lasts from 0 to {:.3g} s", length)};
    }
    const float now = std::clamp(start->seconds, 0.0F, length);
    const float before = std::max(now - options.dt, 0.0F);
    const float after = std::min(now + options.dt, length);
    std::vector<BodyState> bodies = bodiesAt(asset, *clip.value(), now);
    if (after <= before) return bodies;  // a clip of one frame stands still
    const std::vector<BodyState> a = bodiesAt(asset, *clip.value(), before);
    const std::vector<BodyState> b = bodiesAt(asset, *clip.value(), after);
    const float perSecond = 1.0F / (after - before);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const RigidTransform& from = a[i].worldFromBody;
        const RigidTransform& to = b[i].worldFromBody;
        bodies[i].linearVelocity = (to.translation - from.translation) * perSecond;
        bodies[i].angularVelocity = rotationVector(to.rotation * glm::conjugate(from.rotation)) * perSecond;
    }
    return bodies;
}

}  // namespace lutka::scene
