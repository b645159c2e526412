#include "scene/puppet/clip_cast.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <glm/geometric.hpp>

#include "animation/clip_reference.hpp"
#include "animation/pose.hpp"

namespace lutka::scene {
namespace {

using animation::Character;
using animation::Clip;
using physics::BodyState;

Result<const Clip*> clipNamed(const Character& character, const std::string& name) {
    if (const int clip = animation::clipMeant(character.clips, name); clip >= 0) return &character.clips[clip];
    animation::ClipDoubt doubt = animation::clipDoubt(character.clips, name);
    return Error{ErrorCode::usage, std::move(doubt.message), character.file.string(), std::move(doubt.mend)};
}

// "a@1" may be a clip's own name, which a command line reads as one second into "a". Where no clip is called just "a",
// it is.
ClipStart withWholeName(const Character& character, const ClipStart& start) {
    const auto isNamedSo = [&](const Clip& clip) { return clip.name == start.clip; };
    if (std::any_of(character.clips.begin(), character.clips.end(), isNamedSo)) return start;
    for (const Clip& clip : character.clips) {
        if (!clip.name.starts_with(start.clip + "@")) continue;
        const char* number = clip.name.c_str() + start.clip.size() + 1;
        char* end = nullptr;
        const float seconds = std::strtof(number, &end);
        if (end != number && *end == '\0' && seconds == start.seconds) return {clip.name, 0.0F};
    }
    return start;
}

}  // namespace

Result<ClipMoment> findClipMoment(const Character& character, const ClipStart& start) {
    const ClipStart whole = withWholeName(character, start);
    const auto clip = clipNamed(character, whole.clip);
    if (!clip) return clip.error();
    const float length = clip.value()->seconds();
    constexpr float kRounding = 1e-3F;  // seconds
    if (!(whole.seconds >= 0.0F && whole.seconds <= length + kRounding)) {
        return Error{ErrorCode::usage, fmt::format("clip '{}' has no pose at {} s", whole.clip, whole.seconds),
                     character.file.string(), fmt::format("it lasts from 0 to {:.3g} s", length)};
    }
    return ClipMoment{clip.value(), std::clamp(whole.seconds, 0.0F, length)};
}

Result<std::unique_ptr<ClipCast>> ClipCast::create(std::span<const RagdollAsset* const> assets, const ClipPlay& play) {
    std::unique_ptr<ClipCast> cast(new ClipCast(play));
    cast->actors_.reserve(assets.size());  // players point at their libraries
    for (const RagdollAsset* asset : assets) {
        const auto moment = findClipMoment(asset->character, play.start);
        if (!moment) return moment.error();
        animation::RootMotionSettings root;
        root.joint = asset->map.jointOf(animation::Role::hips);
        root.up = glm::conjugate(asset->map.standardFromModel) * vec3(0, 1, 0);
        auto library =
            animation::ClipLibrary::create(asset->character.skeleton, std::span(moment.value().clip, 1), root);
        if (!library) return library.error();
        cast->actors_.push_back(
            {asset, std::move(library).value(), nullptr, moment.value().seconds, {}, {}, {}, {}, {}, {}});
        Actor& actor = cast->actors_.back();
        actor.player = std::make_unique<animation::ClipPlayer>(actor.library, std::vector<animation::LayerSettings>{},
                                                               animation::RootMotion::extract);
        actor.startGround = actor.library.groundFrame(0, actor.start);
        actor.before.resize(asset->character.skeleton.parents.size());
        actor.now.resize(actor.before.size());
        actor.bodies.resize(asset->profile.bodies.size());
        actor.bodiesBefore.resize(actor.bodies.size());
    }
    cast->reset();
    return cast;
}

void ClipCast::take(Actor& actor) const {
    actor.player->pose(actor.now);
    for (const int root : actor.library.rootJoints())
        actor.now[root] = actor.ground * actor.now[root];
    animation::localToModel(actor.asset->character.skeleton, actor.now, actor.now);
    physics::bodiesFromPose(actor.asset->rig, actor.now, {}, actor.bodies);
}

void ClipCast::reset() {
    for (Actor& actor : actors_) {
        actor.player->play(0, 0, {.loop = settings_.loop, .speed = settings_.speed, .start = actor.start});
        actor.ground = actor.startGround;
        take(actor);
        actor.before = actor.now;
    }
}

void ClipCast::advance(float dt) {
    for (Actor& actor : actors_) {
        std::swap(actor.before, actor.now);
        std::swap(actor.bodiesBefore, actor.bodies);
        actor.player->advance(dt);
        if (!settings_.inPlace) actor.ground = actor.ground * actor.player->rootDelta();
        take(actor);
        for (std::size_t i = 0; i < actor.bodies.size(); ++i) {
            const RigidTransform& from = actor.bodiesBefore[i].worldFromBody;
            const RigidTransform& to = actor.bodies[i].worldFromBody;
            actor.bodies[i].linearVelocity = (to.translation - from.translation) / dt;
            actor.bodies[i].angularVelocity = rotationVector(to.rotation * glm::conjugate(from.rotation)) / dt;
        }
    }
}

void ClipCast::pose(int asset, float alpha, std::span<RigidTransform> modelFromJoint) const {
    const Actor& actor = actors_[asset];
    for (std::size_t joint = 0; joint < modelFromJoint.size(); ++joint)
        modelFromJoint[joint] = interpolate(actor.before[joint], actor.now[joint], alpha);
}

void ClipCast::bodies(int asset, std::span<BodyState> bodies) const {
    std::copy(actors_[asset].bodies.begin(), actors_[asset].bodies.end(), bodies.begin());
}

float ClipCast::travelM(int asset) const {
    return glm::distance(actors_[asset].ground.translation, actors_[asset].startGround.translation);
}

}  // namespace lutka::scene
