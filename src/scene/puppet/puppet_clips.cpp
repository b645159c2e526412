#include "scene/puppet/puppet_clips.hpp"

#include <algorithm>
#include <glm/gtc/quaternion.hpp>
#include <utility>
#include <vector>

#include "core/files.hpp"
#include "scene/puppet/clip_cast.hpp"
#include "scene/puppet/reachable_clip.hpp"

namespace lutka::scene {
namespace {

constexpr const char* kDonor = "models/mannequin.glb";

// The hips carry the figure over the ground, in the character's standard stance.
animation::RootMotionSettings travelOf(const RagdollAsset& asset) {
    animation::RootMotionSettings settings;
    settings.joint = asset.map.jointOf(animation::Role::hips);
    settings.up = glm::conjugate(asset.map.standardFromModel) * vec3(0, 1, 0);
    return settings;
}

// The clip that is asked for and its moment: the donor's and the character's own as clipOf() has it, or the
// character's alone.
Result<std::pair<animation::Clip, float>> findClip(const RagdollAsset& asset, const RagdollAsset* donor,
                                                   const PuppetPlay& play) {
    if (donor != nullptr) {
        auto clip = clipOf(asset, donor, play.start.clip, !play.clipOfUser);
        if (clip) {
            const float seconds = std::clamp(play.start.seconds, 0.0F, clip.value().seconds());
            return std::pair(std::move(clip).value(), seconds);
        }
        // One that is there and can't be had says why.
        if (clip.error().code != ErrorCode::usage) return clip.error();
    }
    const auto moment = findClipMoment(asset.character, play.start);
    if (!moment) return moment.error();
    return std::pair(*moment.value().clip, moment.value().seconds);
}

}  // namespace

Result<std::unique_ptr<RagdollAsset>> donorFor(std::span<const RagdollAsset* const> assets, const PuppetPlay& play) {
    const auto lacks = [&](const RagdollAsset* asset) {
        const bool has = play.start.clip.empty() || ownClip(*asset, play.start.clip, !play.clipOfUser) >= 0;
        return !has || (play.getUp && !GetUpClips::hasOwn(*asset));
    };
    if (!play.borrows || std::none_of(assets.begin(), assets.end(), lacks)) return std::unique_ptr<RagdollAsset>();
    const auto file = findAsset(kDonor);
    if (!file) return file.error();
    return loadRagdoll(file.value());
}

Result<PuppetClips> findPuppetClips(const RagdollAsset& asset, const RagdollAsset* donor, const PuppetPlay& play) {
    PuppetClips clips;
    clips.floor = std::make_unique<FloorKeeper>(asset);
    if (play.getUp) {
        auto getUp = GetUpClips::create(asset, donor);
        if (!getUp) return getUp.error();
        clips.getUp = std::make_unique<GetUpClips>(std::move(getUp).value());
    }
    if (play.start.clip.empty()) return clips;
    auto found = findClip(asset, donor, play);
    if (!found) return found.error();
    clips.startSeconds = found.value().second;
    const FloorKeeper* floor = play.led.empty() ? clips.floor.get() : nullptr;
    ReachableClip reachable = reachableClip(asset, found.value().first, keptBodies(asset.profile, play.led), floor);
    clips.reachDeg = reachable.mostDeg;
    clips.reachJoint = reachable.joint;
    auto library =
        animation::ClipLibrary::create(asset.character.skeleton, std::span(&reachable.clip, 1), travelOf(asset));
    if (!library) return library.error();
    clips.library = std::make_unique<animation::ClipLibrary>(std::move(library).value());
    return clips;
}

}  // namespace lutka::scene
