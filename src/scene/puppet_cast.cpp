#include "scene/puppet_cast.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "animation/pose.hpp"
#include "core/files.hpp"
#include "physics/collision/shape.hpp"
#include "physics/collision/static_distance.hpp"
#include "scene/clip_cast.hpp"
#include "scene/reachable_clip.hpp"

namespace lutka::scene {
namespace {

using physics::BodyState;
using physics::PuppetState;

constexpr float kFeltNs = 1.0F;                              // in a step: less is a touch
constexpr std::string_view kDonor = "models/mannequin.glb";  // of clips that a character lacks

std::string bodiesOf(const physics::RagdollProfile& profile) {
    std::string names;
    for (const physics::BodyProfile& body : profile.bodies)
        names += (names.empty() ? "" : ", ") + body.name;
    return "its bodies are " + names;
}

// The body that a blow to a part meets; rigs divide the trunk into one to three, so that a part of it that has no body
// of its own is in the next one below. -1: none.
int bodyMet(const physics::RagdollProfile& profile, std::string_view name) {
    int body = physics::bodyNamed(profile, name);
    if (body >= 0) return body;
    auto role = animation::roleFromName(name);
    if (role) body = physics::bodyOf(profile, *role);
    while (body < 0 && role && animation::isSpine(*role)) {
        role = animation::parentRole(*role);
        body = physics::bodyOf(profile, *role);
    }
    return body;
}

// Whether a part of that name holds the body.
bool holds(std::string_view name, const physics::BodyProfile& body) {
    const auto group = static_cast<std::size_t>(physics::muscleGroupOf(body));
    return name == "all" || name == body.name || name == physics::kMuscleGroupNames[group];
}

// The kinematic ones, which follow the clip whatever it asks for.
std::vector<bool> keptBodies(const physics::RagdollProfile& profile, std::span<const LedPart> led) {
    std::vector<bool> kept(profile.bodies.size(), false);
    for (std::size_t body = 0; body < kept.size(); ++body)
        for (const LedPart& part : led)
            if (holds(part.name, profile.bodies[body])) kept[body] = part.weight >= 1.0F;
    return kept;
}

// Every part names a body of some doll.
Result<void> checkLed(std::span<const RagdollAsset* const> assets, std::span<const LedPart> led) {
    for (const LedPart& part : led) {
        const bool known = std::any_of(assets.begin(), assets.end(), [&](const RagdollAsset* asset) {
            const auto& bodies = asset->profile.bodies;
            return std::any_of(bodies.begin(), bodies.end(), [&](const auto& body) { return holds(part.name, body); });
        });
        if (known) continue;
        return Error{ErrorCode::usage, fmt::format("no doll has a body or group named '{}'", part.name),
                     assets.front()->character.file.string(),
                     bodiesOf(assets.front()->profile) + "; its groups are trunk, head, arm and leg, or say all"};
    }
    return {};
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
            return bodyMet(asset->profile, hit.body) >= 0;
        });
        if (known) continue;
        return Error{ErrorCode::usage, fmt::format("no doll has a body {}", hit.body),
                     assets.front()->character.file.string(), bodiesOf(assets.front()->profile)};
    }
    if (auto known = checkLed(assets, play.led); !known) return known.error();
    std::unique_ptr<PuppetCast> cast(new PuppetCast(assets, scenario, std::move(play)));
    PuppetPlay& own = cast->play_;
    if (own.getUp && own.start.clip.empty()) own.start.clip = "idle";
    std::unique_ptr<RagdollAsset> donor;
    own.borrows = own.borrows || own.getUp;
    const auto lacks = [&](const RagdollAsset* asset) {
        const bool has = own.start.clip.empty() || ownClip(*asset, own.start.clip, !own.clipOfUser) >= 0;
        return !has || (own.getUp && !GetUpClips::hasOwn(*asset));
    };
    if (own.borrows && std::any_of(assets.begin(), assets.end(), lacks)) {
        const auto file = findAsset(kDonor);
        if (!file) return file.error();
        auto loaded = loadRagdoll(file.value());
        if (!loaded) return loaded.error();
        donor = std::move(loaded).value();
    }
    for (const RagdollAsset* asset : assets)
        if (auto found = cast->findClips(*asset, donor.get()); !found) return found.error();
    return cast;
}

// The clip that is played, and the ways to get up.
Result<void> PuppetCast::findClips(const RagdollAsset& asset, const RagdollAsset* donor) {
    floors_.push_back(std::make_unique<FloorKeeper>(asset));
    if (play_.getUp) {
        auto clips = GetUpClips::create(asset, donor);
        if (!clips) return clips.error();
        getUps_.push_back(std::make_unique<GetUpClips>(std::move(clips).value()));
    }
    if (play_.start.clip.empty()) return {};
    float seconds = 0.0F;
    animation::Clip clip;
    auto borrowed = clipOf(asset, donor, play_.start.clip, !play_.clipOfUser);
    // One that is there and can't be had says why.
    if (donor != nullptr && !borrowed && borrowed.error().code != ErrorCode::usage) return borrowed.error();
    if (donor != nullptr && borrowed) {
        clip = std::move(borrowed).value();
        seconds = std::clamp(play_.start.seconds, 0.0F, clip.seconds());
    } else {
        const auto moment = findClipMoment(asset.character, play_.start);
        if (!moment) return moment.error();
        clip = *moment.value().clip;
        seconds = moment.value().seconds;
    }
    const FloorKeeper* floor = play_.led.empty() ? floors_.back().get() : nullptr;
    ReachableClip reachable = reachableClip(asset, clip, keptBodies(asset.profile, play_.led), floor);
    if (reachable.mostDeg > reach_.clipReachDeg) {
        reach_.clipReachDeg = reachable.mostDeg;
        reach_.clipReachJoint = reachable.joint;
    }
    auto library =
        animation::ClipLibrary::create(asset.character.skeleton, std::span(&reachable.clip, 1), travelOf(asset));
    if (!library) return library.error();
    libraries_.push_back(std::make_unique<animation::ClipLibrary>(std::move(library).value()));
    startSeconds_.push_back(seconds);
    return {};
}

PuppetCast::PuppetCast(std::span<const RagdollAsset* const> assets, const Scenario& scenario, PuppetPlay play)
    : assets_(assets.begin(), assets.end()), placements_(scenario.dolls), play_(std::move(play)) {
    isLevel_ = std::all_of(scenario.statics.begin(), scenario.statics.end(), [](const physics::StaticShape& shape) {
        const vec3 up = shape.worldFromShape.rotation * vec3(0, 1, 0);
        return shape.kind == physics::StaticShape::Kind::plane && up.y > 1.0F - 1e-4F;
    });
    statics_ = scenario.statics;
    std::stable_sort(play_.hits.begin(), play_.hits.end(),
                     [](const PuppetHit& a, const PuppetHit& b) { return a.seconds < b.seconds; });
}

void PuppetCast::begin(physics::World& world, std::span<const physics::DollId> dolls) {
    end();
    world_ = &world;
    seconds_ = gapsM_ = 0.0;
    standing_ = 0;
    tallies_.assign(assets_.size(), {});
    worst_ = {};
    risen_ = {};
    risenSeconds_ = matchedM_ = 0.0;
    for (std::size_t i = 0; i < dolls.size(); ++i) {
        Actor& actor = actors_.emplace_back();
        const Placement& placement = placements_[i];
        actor.asset = assets_[placement.asset];
        if (!libraries_.empty()) actor.library = libraries_[placement.asset].get();
        actor.assetIndex = placement.asset;
        actor.floor = floors_[placement.asset].get();
        actor.worldFromModel = placement.worldFromModel;
        actor.soles = standingFloorOf(*actor.asset);
        actor.base = placement.worldFromModel.translation.y + actor.soles;
        if (!isLevel_) actor.terrain = TerrainWalk::of(*actor.asset);
        actor.root = std::max(physics::bodyOf(actor.asset->profile, physics::Role::hips), 0);
        bodies_.resize(actor.asset->profile.bodies.size());
        world.getBodies(dolls[i], bodies_);
        actor.puppet = std::make_unique<physics::Puppet>(world, dolls[i], actor.asset->profile, actor.root, bodies_,
                                                         settingsOf(*actor.asset, actor.root));
        for (const BodyState& body : bodies_)
            actor.to.push_back(body.worldFromBody);
        actor.puppet->settings().muscles.strength *= placement.strength;
        const float seconds = placement.clip ? placement.clip->seconds : 0.0F;
        if (actor.library != nullptr)
            startClip(actor,
                      seconds > 0.0F ? std::min(seconds, actor.library->seconds(0)) : startSeconds_[placement.asset],
                      world, dolls[i]);
        actor.from = actor.raw = actor.to;
        actor.feet[0].body = physics::bodyOf(actor.asset->profile, physics::Role::leftFoot);
        actor.feet[1].body = physics::bodyOf(actor.asset->profile, physics::Role::rightFoot);
        if (play_.limp) actor.puppet->goLimp();
    }
    for (Actor& actor : actors_)
        actor.puppet->onChange(
            [this, &actor](physics::PuppetState, physics::PuppetState after) { notice(actor, after); });
}

// What the play asks for, and the profile where it asks for nothing.
physics::PuppetSettings PuppetCast::settingsOf(const RagdollAsset& asset, int root) const {
    const physics::RagdollProfile& profile = asset.profile;
    physics::PuppetSettings settings = play_.puppet;
    if (const auto own = physics::musclesOf(profile, play_.gravity); own && play_.ownMuscles) {
        settings.muscles = *own;
        settings.muscles.strength *= play_.puppet.muscles.strength;
    }
    if (play_.ownMuscles && settings.muscles.bodies.empty())
        for (const physics::BodyProfile& body : profile.bodies)
            settings.muscles.bodies.push_back(body.muscle);
    if (play_.carriesGravity) settings.muscles.carriedGravity = play_.gravity;
    settings.gravity = std::max(-play_.gravity.y, 0.1F);
    settings.pinForceN = play_.pinForceN.value_or(profile.bodies[root].pinForceN.value_or(settings.pinForceN));
    for (const physics::BodyProfile& body : profile.bodies)
        settings.pins.push_back(body.pinForceN.value_or(0.0F));
    if (play_.led.empty()) return settings;
    settings.led.assign(profile.bodies.size(), 0.0F);
    for (const LedPart& part : play_.led)
        for (std::size_t body = 0; body < settings.led.size(); ++body)
            if (holds(part.name, profile.bodies[body])) settings.led[body] = part.weight;
    return settings;
}

PuppetMemory PuppetCast::memoryOf(int doll) const {
    const Actor& actor = actors_[doll];
    const PuppetState state = actor.puppet->state();
    return {actor.worldFromModel, actor.player != nullptr ? actor.player->seconds(0) : 0.0F,     actor.ground,
            actor.base,           state == PuppetState::limp || state == PuppetState::gettingUp, seconds_};
}

void PuppetCast::resume(int doll, const PuppetMemory& memory) {
    Actor& actor = actors_[doll];
    seconds_ = memory.seconds;
    actor.worldFromModel = memory.worldFromModel;
    actor.ground = memory.ground;
    actor.base = memory.base;
    actor.rising.reset();
    actor.puppet->approach();
    if (actor.player != nullptr) {
        actor.player->seek(0, memory.clipSeconds);
        pose(actor, actor.to);
        actor.from = actor.raw = actor.to;
    }
    constexpr float atOnce = 1e-3F;  // seconds
    // To be limp again as it was is no knock-out.
    const int knockOuts = worst_.knockOuts;
    if (memory.limp)
        actor.puppet->goLimp();
    else
        actor.puppet->comeBack(atOnce);
    worst_.knockOuts = knockOuts;
}

void PuppetCast::startClip(Actor& actor, float seconds, physics::World& world, physics::DollId doll) {
    // Shapes reach a little beyond the skin, and clips put feet into the ground: a pinned doll would tread on it.
    actor.lift = std::max(-clearance(actor), 0.0F);
    if (!play_.limp) actor.worldFromModel.translation.y += actor.lift;
    actor.player = std::make_unique<animation::ClipPlayer>(*actor.library, std::vector<animation::LayerSettings>{},
                                                           animation::RootMotion::extract);
    actor.player->play(0, 0, {.start = seconds});
    pose(actor, actor.to);
    if (play_.limp) return;
    bodies_.resize(actor.to.size());
    world.getBodies(doll, bodies_);
    const bool isElsewhere = play_.borrows || seconds != startSeconds_[actor.assetIndex];
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        bodies_[i].worldFromBody.translation.y += actor.lift;
        if (isElsewhere) bodies_[i] = {actor.to[i], vec3(0), vec3(0)};
    }
    world.setBodies(doll, bodies_);
}

// How far its lowest body stays above the ground of its bind pose, or what it is to keep over it, metres.
float PuppetCast::clearance(const Actor& actor) {
    constexpr float kStep = 1.0F / 60.0F;
    const animation::Skeleton& skeleton = actor.asset->character.skeleton;
    const RigidTransform standing{actor.asset->map.standardFromModel, vec3(0, -actor.soles, 0)};
    float lowest = 1e9F;
    joints_.resize(skeleton.parents.size());
    for (float seconds = 0.0F; seconds <= actor.library->seconds(0); seconds += kStep) {
        actor.library->sampleInPlace(0, seconds, joints_);
        animation::localToModel(skeleton, joints_, joints_);
        bodies_.resize(actor.asset->profile.bodies.size());
        physics::bodiesFromPose(actor.asset->rig, joints_, standing, bodies_);
        for (std::size_t i = 0; i < bodies_.size(); ++i)
            lowest = std::min(lowest, actor.floor->heightOver(static_cast<int>(i), bodies_[i].worldFromBody));
    }
    return lowest;
}

void PuppetCast::notice(Actor& actor, physics::PuppetState after) {
    if (after == physics::PuppetState::limp) ++worst_.knockOuts;
    if (after == physics::PuppetState::animated && actor.sinceHit >= 0.0F) {
        worst_.recoverySeconds = std::max(worst_.recoverySeconds, actor.sinceHit);
        actor.sinceHit = -1.0F;
    }
}

// The bodies of the player's pose now, in the world.
void PuppetCast::pose(Actor& actor, std::vector<RigidTransform>& bodies, float dt) {
    const animation::Skeleton& skeleton = actor.asset->character.skeleton;
    joints_.resize(skeleton.parents.size());
    actor.player->pose(joints_);
    RigidTransform worldFromModel = actor.worldFromModel;
    if (actor.terrain) {
        // Which feet stand is measured by it in any case.
        fitted_ = joints_;
        const auto ground = [this](const vec3& point) { return footing(point); };
        const RigidTransform lifted = actor.terrain->fit(ground, dt, actor.base + actor.lift, worldFromModel, fitted_);
        if (play_.meetsGround) {
            worldFromModel = lifted;
            std::swap(joints_, fitted_);
            // Nothing to walk on: it falls, also what is led.
            if (actor.terrain->isOverNothing()) actor.puppet->goLimp();
        }
    }
    animation::localToModel(skeleton, joints_, joints_);
    bodies_.resize(actor.asset->profile.bodies.size());
    physics::bodiesFromPose(actor.asset->rig, joints_, worldFromModel, bodies_);
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
            const int body = bodyMet(actor.asset->profile, hit.body);
            if (body < 0 || (hit.doll >= 0 && &actor != &actors_[hit.doll])) continue;
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
    dt_ = dt;
    for (Actor& actor : actors_) {
        if (play_.getUp) watchRest(actor, dt);
        if (actor.rising)
            rise(actor, dt);
        else if (actor.player != nullptr)
            playOn(actor, dt);
        if (actor.sinceHit >= 0.0F) actor.sinceHit += dt;
        actor.puppet->prepare(actor.from, actor.to, dt);
    }
    seconds_ += static_cast<double>(dt);
}

// One step of the clip.
void PuppetCast::playOn(Actor& actor, float dt) {
    actor.player->advance(dt);
    actor.worldFromModel = actor.worldFromModel * actor.player->rootDelta();
    const vec3 ahead =
        actor.worldFromModel.rotation * (glm::conjugate(actor.asset->map.standardFromModel) * vec3(0, 0, 1));
    actor.worldFromModel.translation += ahead * (play_.pace * dt);
    pose(actor, actor.raw, dt);
    show(actor, dt);
}

// Ground is what stays where it is: a ray goes through dolls and props.
std::optional<animation::GroundHit> PuppetCast::groundOn(const vec3& from, const vec3& to) const {
    constexpr int kMostAbove = 64;  // shapes of its own legs, and of those who lie there
    constexpr float kOnM = 2e-3F;
    physics::BodyShape point;
    point.kind = physics::BodyShape::Kind::sphere;
    point.radius = 0.0F;
    vec3 start = from;
    for (int i = 0; i < kMostAbove && start.y > to.y; ++i) {
        const auto hit = world_->rayTest(start, to);
        if (!hit) return std::nullopt;
        const bool isStatic = std::any_of(statics_.begin(), statics_.end(), [&](const physics::StaticShape& shape) {
            return std::abs(physics::distanceToStatic(point, {quat(1, 0, 0, 0), hit->position}, shape)) < kOnM;
        });
        if (!hit->doll.isSet() && isStatic && hit->normal.y > 0.1F)
            return animation::GroundHit{hit->position.y, hit->normal};
        start = hit->position - vec3(0, 1e-3F, 0);
    }
    return std::nullopt;
}

// The ground at a point: the highest that is no more than a tall step above it.
std::optional<animation::GroundHit> PuppetCast::footing(const vec3& point) const {
    constexpr float kAboveM = 0.8F;
    constexpr float kBelowM = 2.0F;
    return groundOn(point + vec3(0, kAboveM, 0), point - vec3(0, kBelowM, 0));
}

// What flies against a puppet weakens it as a hit does.
void PuppetCast::feelContacts() {
    using Side = physics::ContactReport::Side;
    const auto feel = [&](const Side& own, const Side& other, float impulse) {
        if (own.kind != Side::Kind::doll || other.kind != Side::Kind::prop || impulse < kFeltNs) return;
        for (Actor& actor : actors_) {
            if (actor.puppet->doll() != own.doll) continue;
            actor.puppet->feel(own.body, impulse);
            if (actor.puppet->state() == PuppetState::reacting) actor.sinceHit = 0.0F;
        }
    };
    for (const physics::ContactReport& report : world_->contactReports()) {
        feel(report.a, report.b, report.impulse);
        feel(report.b, report.a, report.impulse);
    }
    // Only who holds itself up asks for the ground.
    for (Actor& actor : actors_)
        if (actor.puppet->settings().pinForceN <= 0.0F) feelGround(actor);
}

// Which feet stand on something: what pushes them from below, and is none of their own doll.
void PuppetCast::feelGround(Actor& actor) {
    using Side = physics::ContactReport::Side;
    constexpr float kUp = 0.5F;
    const physics::DollId own = actor.puppet->doll();
    std::array<bool, 2> grounded{false, false};
    const auto feel = [&](const Side& one, const Side& other, float up) {
        if (one.kind != Side::Kind::doll || one.doll != own || up < kUp) return;
        if (other.kind == Side::Kind::doll && other.doll == own) return;
        for (std::size_t side = 0; side < grounded.size(); ++side)
            grounded[side] = grounded[side] || one.body == actor.puppet->feet()[side];
    };
    for (const physics::ContactReport& report : world_->contactReports()) {
        feel(report.a, report.b, report.normal.y);
        feel(report.b, report.a, -report.normal.y);
    }
    actor.puppet->setGrounded(grounded);
}

}  // namespace lutka::scene
