#include "scene/puppet/get_up_clips.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "animation/clip_reference.hpp"
#include "animation/pose.hpp"
#include "animation/retarget/retarget_clip.hpp"
#include "core/letter_case.hpp"
#include "scene/puppet/reachable_clip.hpp"

namespace lutka::scene {
namespace {

using animation::Clip;
using physics::Role;

constexpr float kFrameStep = 1.0F / 20.0F;  // seconds between the frames that are compared
constexpr float kLowHips = 0.45F;           // of the standing height: beyond it a figure is no longer lying
constexpr float kReachM = 0.15F;            // of the points that show how a body is turned
constexpr std::size_t kPointsOfBody = 3;

// Lower case without what lies between words.
std::string plainName(std::string_view name) {
    std::string plain;
    for (const char c : name)
        if (std::isalnum(static_cast<unsigned char>(c)) != 0) plain += lowerCased(c);
    return plain;
}

// Over what the figure stands on.
float hipsHeight(const RagdollAsset& asset, const Clip& clip, float seconds) {
    std::vector<RigidTransform> pose(asset.character.skeleton.parents.size());
    animation::sampleClip(clip, seconds, pose);
    const vec3 up = glm::conjugate(asset.profile.standardFromModel) * vec3(0, 1, 0);
    const int joint = asset.rig.jointOfBody.front();
    return glm::dot(animation::modelFrameOf(asset.character.skeleton, pose, joint).translation, up) -
           standingFloorOf(asset);
}

// Whether the trunk is nearer to the ground than to the upright: who sits stands up, but does not get up.
bool liesAtFirst(const RagdollAsset& asset, const Clip& clip) {
    int top = -1;
    for (const Role role : {Role::spine, Role::chest, Role::upperChest, Role::head})
        if (const int body = physics::bodyOf(asset.profile, role); body > 0) top = asset.rig.jointOfBody[body];
    if (top < 0) return true;
    std::vector<RigidTransform> pose(asset.character.skeleton.parents.size());
    animation::sampleClip(clip, 0.0F, pose);
    const auto placeOf = [&](int joint) {
        return animation::modelFrameOf(asset.character.skeleton, pose, joint).translation;
    };
    const vec3 trunk = asset.profile.standardFromModel * (placeOf(top) - placeOf(asset.rig.jointOfBody.front()));
    constexpr float kLeans = 0.7F;  // cosine of 45 degrees
    return trunk.y < kLeans * glm::length(trunk);
}

bool isGetUp(const RagdollAsset& asset, const Clip& clip) {
    const std::string name = plainName(clip.name);
    if (name.find("getup") == std::string::npos && name.find("standup") == std::string::npos) return false;
    if (clip.frameCount < 2) return false;
    return hipsHeight(asset, clip, 0.0F) < 0.5F * hipsHeight(asset, clip, clip.seconds()) && liesAtFirst(asset, clip);
}

Result<Clip> retargeted(const RagdollAsset& asset, const RagdollAsset& donor, const Clip& clip) {
    auto retargeter = animation::Retargeter::make(donor.character, donor.map, asset.character, asset.map);
    if (!retargeter) return retargeter.error();
    auto result = animation::retargetClip(retargeter.value(), clip);
    if (!result) return result.error();
    return std::move(result.value().clip);
}

}  // namespace

std::string_view lyingName(Lying lying) {
    constexpr std::array<std::string_view, 4> names{"prone", "supine", "left side", "right side"};
    return names[static_cast<std::size_t>(lying)];
}

Lying lyingOf(const RagdollAsset& asset, std::span<const RigidTransform> worldFromBody) {
    vec3 front(0);
    vec3 left(0);
    for (const Role role : {Role::hips, Role::spine, Role::chest, Role::upperChest}) {
        const int body = physics::bodyOf(asset.profile, role);
        if (body < 0) continue;
        const quat worldFromStandard = worldFromBody[body].rotation *
                                       glm::conjugate(asset.rig.bindModelFromBody[body].rotation) *
                                       glm::conjugate(asset.profile.standardFromModel);
        front += asset.profile.bodies[body].massKg * (worldFromStandard * vec3(0, 0, 1));
        left += asset.profile.bodies[body].massKg * (worldFromStandard * vec3(1, 0, 0));
    }
    if (std::abs(front.y) >= std::abs(left.y)) return front.y < 0.0F ? Lying::prone : Lying::supine;
    return left.y < 0.0F ? Lying::leftSide : Lying::rightSide;
}

int ownClip(const RagdollAsset& asset, std::string_view name, bool exactly) {
    const int meant = animation::clipMeant(asset.character.clips, name);
    const bool alike = meant >= 0 && !name.starts_with('#') && asset.character.clips[meant].name != name;
    return exactly && alike ? -1 : meant;
}

Result<Clip> clipOf(const RagdollAsset& asset, const RagdollAsset* donor, std::string_view name, bool exactly) {
    const std::vector<Clip>& own = asset.character.clips;
    if (const int at = ownClip(asset, name, exactly && donor != nullptr); at >= 0) return own[at];
    if (donor != nullptr) {
        const std::vector<Clip>& given = donor->character.clips;
        // By its name alone: a number means one of the character's own.
        const auto at = std::find_if(given.begin(), given.end(), [&](const Clip& clip) { return clip.name == name; });
        if (at != given.end()) return retargeted(asset, *donor, *at);
    }
    return Error{ErrorCode::usage, fmt::format("there is no clip named '{}'", name), asset.character.file.string(),
                 "name one of the character's own clips"};
}

GetUpClips::GetUpClips(const RagdollAsset& asset) : asset_(&asset), floor_(standingFloorOf(asset)) {}

bool GetUpClips::hasOwn(const RagdollAsset& asset) {
    return std::any_of(asset.character.clips.begin(), asset.character.clips.end(),
                       [&](const Clip& clip) { return isGetUp(asset, clip); });
}

Result<GetUpClips> GetUpClips::create(const RagdollAsset& asset, const RagdollAsset* donor) {
    GetUpClips clips(asset);
    clips.joints_.resize(asset.character.skeleton.parents.size());
    clips.bodies_.resize(asset.profile.bodies.size());
    for (const Clip& clip : asset.character.clips)
        if (isGetUp(asset, clip)) clips.clips_.push_back(reachableClip(asset, clip).clip);
    const bool borrows = clips.clips_.empty() && donor != nullptr;
    for (const Clip& clip : borrows ? std::span<const Clip>(donor->character.clips) : std::span<const Clip>()) {
        if (!isGetUp(*donor, clip)) continue;
        auto taken = retargeted(asset, *donor, clip);
        if (!taken) return taken.error();
        clips.clips_.push_back(reachableClip(asset, taken.value()).clip);
    }
    if (clips.clips_.empty()) {
        return Error{ErrorCode::input, "the character has no clip in which it gets up", asset.character.file.string(),
                     "give it one whose name holds 'get up' and that goes from lying to standing"};
    }
    for (int clip = 0; clip < clips.clipCount(); ++clip)
        clips.addFrames(clip);
    return clips;
}

void GetUpClips::addFrames(int clip) {
    std::vector<RigidTransform> bodies(bodies_.size());
    const float standing = hipsHeight(*asset_, clips_[clip], seconds(clip));
    for (float at = 0.0F; at < seconds(clip); at += kFrameStep) {
        if (hipsHeight(*asset_, clips_[clip], at) > kLowHips * standing) break;
        sample({clip, at, {}, 0.0F}, at, bodies);
        frames_.push_back({clip, at, pointsOf(bodies)});
    }
}

std::vector<vec3> GetUpClips::pointsOf(std::span<const RigidTransform> bodies) const {
    std::vector<vec3> points;
    points.reserve(kPointsOfBody * bodies.size());
    for (const RigidTransform& body : bodies) {
        points.push_back(body.translation);
        points.push_back(body * vec3(kReachM, 0, 0));
        points.push_back(body * vec3(0, 0, kReachM));
    }
    return points;
}

void GetUpClips::sample(const Match& match, float seconds, std::span<RigidTransform> worldFromBody) {
    animation::sampleClip(clips_[match.clip], seconds, joints_);
    animation::localToModel(asset_->character.skeleton, joints_, joints_);
    const RigidTransform standardFromModel{asset_->profile.standardFromModel, vec3(0, -floor_, 0)};
    physics::bodiesFromPose(asset_->rig, joints_, match.worldFromStandard * standardFromModel, bodies_);
    for (std::size_t i = 0; i < bodies_.size(); ++i)
        worldFromBody[i] = bodies_[i].worldFromBody;
}

GetUpClips::Match GetUpClips::match(std::span<const RigidTransform> worldFromBody, float ground) const {
    const std::vector<vec3> doll = pointsOf(worldFromBody);
    Match best;
    best.distanceM = 1e9F;
    for (const Frame& frame : frames_) {
        vec3 dollMiddle(0);
        vec3 clipMiddle(0);
        float mass = 0.0F;
        const auto weightOf = [&](std::size_t point) { return asset_->profile.bodies[point / kPointsOfBody].massKg; };
        for (std::size_t i = 0; i < doll.size(); ++i) {
            dollMiddle += weightOf(i) * doll[i];
            clipMiddle += weightOf(i) * frame.points[i];
            mass += weightOf(i);
        }
        dollMiddle = vec3(dollMiddle.x / mass, ground, dollMiddle.z / mass);
        clipMiddle = vec3(clipMiddle.x / mass, 0.0F, clipMiddle.z / mass);
        float along = 0.0F;
        float across = 0.0F;
        float squares = 0.0F;
        for (std::size_t i = 0; i < doll.size(); ++i) {
            const vec3 p = frame.points[i] - clipMiddle;
            const vec3 q = doll[i] - dollMiddle;
            along += weightOf(i) * (q.x * p.x + q.z * p.z);
            across += weightOf(i) * (q.x * p.z - q.z * p.x);
            squares += weightOf(i) * (p.x * p.x + p.z * p.z + q.x * q.x + q.z * q.z + (q.y - p.y) * (q.y - p.y));
        }
        const float least = squares - 2.0F * std::hypot(along, across);
        const float distance = std::sqrt(std::max(least, 0.0F) / mass);
        if (distance >= best.distanceM) continue;
        const quat turn = glm::angleAxis(std::atan2(across, along), vec3(0, 1, 0));
        best = {frame.clip, frame.seconds, {turn, dollMiddle - turn * clipMiddle}, distance};
    }
    return best;
}

}  // namespace lutka::scene
