#include "scene/puppet_cast.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "animation/pose.hpp"
#include "physics/collision/shape.hpp"
#include "scene/clip_cast.hpp"

namespace lutka::scene {
namespace {

using physics::BodyState;

std::string bodiesOf(const physics::RagdollProfile& profile) {
    std::string names;
    for (const physics::BodyProfile& body : profile.bodies)
        names += (names.empty() ? "" : ", ") + body.name;
    return "its bodies are " + names;
}

// The hips carry the figure over the ground, in the character's standard stance.
animation::RootMotionSettings travelOf(const RagdollAsset& asset) {
    animation::RootMotionSettings settings;
    settings.joint = asset.map.jointOf(animation::Role::hips);
    settings.up = glm::conjugate(asset.map.standardFromModel) * vec3(0, 1, 0);
    return settings;
}

}  // namespace

Result<std::unique_ptr<PuppetCast>> PuppetCast::create(std::span<const RagdollAsset* const> assets,
                                                       const Scenario& scenario, PuppetPlay play) {
    for (const PuppetHit& hit : play.hits) {
        const bool known = std::any_of(assets.begin(), assets.end(), [&](const RagdollAsset* asset) {
            return physics::bodyOf(asset->profile, hit.role) >= 0;
        });
        if (known) continue;
        return Error{ErrorCode::usage, fmt::format("no doll has a body for {}", animation::roleName(hit.role)),
                     assets.front()->character.file.string(), bodiesOf(assets.front()->profile)};
    }
    std::unique_ptr<PuppetCast> cast(new PuppetCast(assets, scenario, std::move(play)));
    for (const RagdollAsset* asset : assets) {
        if (cast->play_.start.clip.empty()) continue;
        const auto moment = findClipMoment(asset->character, cast->play_.start);
        if (!moment) return moment.error();
        auto library = animation::ClipLibrary::create(asset->character.skeleton, std::span(moment.value().clip, 1),
                                                      travelOf(*asset));
        if (!library) return library.error();
        cast->libraries_.push_back(std::make_unique<animation::ClipLibrary>(std::move(library).value()));
        cast->startSeconds_.push_back(moment.value().seconds);
    }
    return cast;
}

PuppetCast::PuppetCast(std::span<const RagdollAsset* const> assets, const Scenario& scenario, PuppetPlay play)
    : assets_(assets.begin(), assets.end()), placements_(scenario.dolls), play_(std::move(play)) {
    std::stable_sort(play_.hits.begin(), play_.hits.end(),
                     [](const PuppetHit& a, const PuppetHit& b) { return a.seconds < b.seconds; });
}

void PuppetCast::begin(physics::World& world, std::span<const physics::DollId> dolls) {
    end();
    world_ = &world;
    seconds_ = squares_ = 0.0;
    count_ = 0;
    worst_ = {};
    for (std::size_t i = 0; i < dolls.size(); ++i) {
        Actor& actor = actors_.emplace_back();
        const Placement& placement = placements_[i];
        actor.asset = assets_[placement.asset];
        if (!libraries_.empty()) actor.library = libraries_[placement.asset].get();
        actor.worldFromModel = placement.worldFromModel;
        actor.root = std::max(physics::bodyOf(actor.asset->profile, physics::Role::hips), 0);
        bodies_.resize(actor.asset->profile.bodies.size());
        world.getBodies(dolls[i], bodies_);
        actor.puppet =
            std::make_unique<physics::Puppet>(world, dolls[i], actor.asset->profile, actor.root, bodies_, play_.puppet);
        for (const BodyState& body : bodies_)
            actor.to.push_back(body.worldFromBody);
        if (actor.library != nullptr) startClip(actor, startSeconds_[placement.asset], world, dolls[i]);
        actor.from = actor.to;
    }
    for (Actor& actor : actors_)
        actor.puppet->onChange(
            [this, &actor](physics::PuppetState, physics::PuppetState after) { notice(actor, after); });
}

void PuppetCast::startClip(Actor& actor, float seconds, physics::World& world, physics::DollId doll) {
    // Shapes reach a little beyond the skin, and clips put feet into the ground: a pinned doll would tread on it with
    // all the force that it has.
    const float lift = std::max(-clearance(actor), 0.0F);
    actor.worldFromModel.translation.y += lift;
    bodies_.resize(actor.asset->profile.bodies.size());
    world.getBodies(doll, bodies_);
    for (BodyState& body : bodies_)
        body.worldFromBody.translation.y += lift;
    world.setBodies(doll, bodies_);
    actor.player = std::make_unique<animation::ClipPlayer>(*actor.library, std::vector<animation::LayerSettings>{},
                                                           animation::RootMotion::extract);
    actor.player->play(0, 0, {.start = seconds});
    pose(actor, actor.to);
}

// How far above the ground that the doll is placed on (the height of its model's origin) its lowest body stays
// throughout the clip, metres.
float PuppetCast::clearance(const Actor& actor) {
    constexpr float kStep = 1.0F / 60.0F;
    const animation::Skeleton& skeleton = actor.asset->character.skeleton;
    float lowest = 1e9F;
    joints_.resize(skeleton.parents.size());
    for (float seconds = 0.0F; seconds <= actor.library->seconds(0); seconds += kStep) {
        actor.library->sampleInPlace(0, seconds, joints_);
        animation::localToModel(skeleton, joints_, joints_);
        bodies_.resize(actor.asset->profile.bodies.size());
        physics::bodiesFromPose(actor.asset->rig, joints_, actor.worldFromModel, bodies_);
        for (std::size_t i = 0; i < bodies_.size(); ++i) {
            const RigidTransform& at = bodies_[i].worldFromBody;
            const vec3 up = glm::conjugate(at.rotation) * vec3(0, 1, 0);
            lowest =
                std::min(lowest, at.translation.y - physics::supportExtent(actor.asset->profile.bodies[i].shape, up));
        }
    }
    return lowest - actor.worldFromModel.translation.y;
}

void PuppetCast::notice(Actor& actor, physics::PuppetState after) {
    if (after == physics::PuppetState::limp) ++worst_.knockOuts;
    if (after == physics::PuppetState::animated && actor.sinceHit >= 0.0F) {
        worst_.recoverySeconds = std::max(worst_.recoverySeconds, actor.sinceHit);
        actor.sinceHit = -1.0F;
    }
}

// The bodies of the player's pose now, in the world.
void PuppetCast::pose(Actor& actor, std::vector<RigidTransform>& bodies) {
    const animation::Skeleton& skeleton = actor.asset->character.skeleton;
    joints_.resize(skeleton.parents.size());
    actor.player->pose(joints_);
    animation::localToModel(skeleton, joints_, joints_);
    bodies_.resize(actor.asset->profile.bodies.size());
    physics::bodiesFromPose(actor.asset->rig, joints_, actor.worldFromModel, bodies_);
    bodies.resize(bodies_.size());
    for (std::size_t i = 0; i < bodies.size(); ++i)
        bodies[i] = bodies_[i].worldFromBody;
}

// Hits whose moment lies in the coming step.
void PuppetCast::hitDue(float dt) {
    for (const PuppetHit& hit : play_.hits) {
        const auto at = static_cast<double>(hit.seconds);
        if (at < seconds_ || at >= seconds_ + static_cast<double>(dt)) continue;
        for (Actor& actor : actors_) {
            const int body = physics::bodyOf(actor.asset->profile, hit.role);
            if (body < 0) continue;
            bodies_.resize(actor.asset->profile.bodies.size());
            world_->getBodies(actor.puppet->doll(), bodies_);
            actor.puppet->hit(
                body, bodies_[body].worldFromBody.translation,
                actor.worldFromModel.rotation * (glm::conjugate(actor.asset->map.standardFromModel) * hit.impulse));
            actor.sinceHit = 0.0F;
        }
    }
}

void PuppetCast::prepare(float dt) {
    hitDue(dt);
    for (Actor& actor : actors_) {
        if (actor.player != nullptr) {
            std::swap(actor.from, actor.to);
            actor.player->advance(dt);
            actor.worldFromModel = actor.worldFromModel * actor.player->rootDelta();
            pose(actor, actor.to);
        }
        if (actor.sinceHit >= 0.0F) actor.sinceHit += dt;
        actor.puppet->prepare(actor.from, actor.to, dt);
    }
    seconds_ += static_cast<double>(dt);
}

void PuppetCast::measure() {
    for (Actor& actor : actors_) {
        if (actor.puppet->state() == physics::PuppetState::limp) continue;
        const physics::RagdollProfile& profile = actor.asset->profile;
        bodies_.resize(profile.bodies.size());
        world_->getBodies(actor.puppet->doll(), bodies_);
        frames_.clear();
        for (const BodyState& body : bodies_)
            frames_.push_back(body.worldFromBody);
        errors_.resize(profile.constraints.size());
        physics::jointErrors(profile, actor.to, frames_, errors_);
        for (std::size_t i = 0; i < errors_.size(); ++i) {
            const float degreesOff = degrees(errors_[i]);
            squares_ += static_cast<double>(degreesOff) * static_cast<double>(degreesOff);
            ++count_;
            if (degreesOff <= worst_.maxDeg) continue;
            worst_.maxDeg = degreesOff;
            worst_.worstJoint = profile.bodies[profile.constraints[i].child].name;
        }
        worst_.rootM =
            std::max(worst_.rootM, glm::distance(frames_[actor.root].translation, actor.to[actor.root].translation));
    }
}

PuppetFigures PuppetCast::figures() const {
    PuppetFigures figures = worst_;
    figures.rmsDeg = count_ > 0 ? static_cast<float>(std::sqrt(squares_ / static_cast<double>(count_))) : 0.0F;
    figures.limp = static_cast<int>(std::count_if(actors_.begin(), actors_.end(), [](const Actor& actor) {
        return actor.puppet->state() == physics::PuppetState::limp;
    }));
    return figures;
}

}  // namespace lutka::scene
