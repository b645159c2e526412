#include "scene/puppet/puppet_cast.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "animation/pose.hpp"
#include "physics/collision/shape.hpp"
#include "physics/profile/constraint_state.hpp"

namespace lutka::scene {
namespace {

using physics::BodyState;
using physics::PuppetState;

constexpr float kFeltNs = 1.0F;           // in a step: less is a touch
constexpr float kStrengthSeconds = 0.3F;  // in which the strength of one that gets up comes

// The turn about the vertical that is in a rotation.
quat headingOf(const quat& turn) {
    const float length = std::hypot(turn.w, turn.y);
    return length > 1e-4F ? quat(turn.w / length, 0, turn.y / length, 0) : quat(1, 0, 0, 0);
}

bool isNearLimits(const physics::RagdollProfile& profile, std::span<const RigidTransform> worldFromBody) {
    constexpr float kMostBeyond = radians(20.0F);
    return std::all_of(profile.constraints.begin(), profile.constraints.end(), [&](const auto& joint) {
        return physics::measureConstraint(joint, worldFromBody[joint.parent], worldFromBody[joint.child]).violation <=
               kMostBeyond;
    });
}

}  // namespace

Result<std::unique_ptr<PuppetCast>> PuppetCast::create(std::span<const RagdollAsset* const> assets,
                                                       const Scenario& scenario, PuppetPlay play) {
    if (auto known = checkBodies(assets, play); !known) return known.error();
    if (play.getUp && play.start.clip.empty()) play.start.clip = "idle";
    play.borrows = play.borrows || play.getUp;
    auto donor = donorFor(assets, play);
    if (!donor) return donor.error();
    std::unique_ptr<PuppetCast> cast(new PuppetCast(assets, scenario, std::move(play)));
    for (const RagdollAsset* asset : assets) {
        auto clips = findPuppetClips(*asset, donor.value().get(), cast->play_);
        if (!clips) return clips.error();
        cast->clips_.push_back(std::move(clips).value());
    }
    return cast;
}

PuppetCast::PuppetCast(std::span<const RagdollAsset* const> assets, const Scenario& scenario, PuppetPlay play)
    : assets_(assets.begin(), assets.end()),
      ground_(scenario.statics),
      placements_(scenario.dolls),
      play_(std::move(play)),
      tally_(assets) {
    std::stable_sort(play_.hits.begin(), play_.hits.end(),
                     [](const PuppetHit& a, const PuppetHit& b) { return a.seconds < b.seconds; });
}

void PuppetCast::begin(physics::World& world, std::span<const physics::DollId> dolls) {
    end();
    world_ = &world;
    seconds_ = 0.0;
    tally_ = TrackingTally(assets_);
    getUps_ = {};
    for (std::size_t i = 0; i < dolls.size(); ++i) {
        const Placement& placement = placements_[i];
        const RagdollAsset& asset = *assets_[placement.asset];
        Actor& actor = actors_.emplace_back(asset, clips_[placement.asset]);
        actor.assetIndex = placement.asset;
        actor.worldFromModel = placement.worldFromModel;
        actor.soles = standingFloorOf(asset);
        actor.base = placement.worldFromModel.translation.y + actor.soles;
        if (!ground_.isLevel()) actor.terrain = TerrainWalk::of(asset);
        actor.root = std::max(physics::bodyOf(asset.profile, physics::Role::hips), 0);
        bodies_.resize(asset.profile.bodies.size());
        world.getBodies(dolls[i], bodies_);
        actor.puppet = std::make_unique<physics::Puppet>(world, dolls[i], asset.profile, actor.root, bodies_,
                                                         settingsOf(play_, asset.profile, actor.root));
        now_.clear();
        for (const BodyState& body : bodies_)
            now_.push_back(body.worldFromBody);
        actor.motion.setPose(now_);
        actor.puppet->settings().muscles.strength *= placement.strength;
        const float seconds = placement.clip ? placement.clip->seconds : 0.0F;
        if (const auto& library = actor.clips->library)
            startClip(actor, seconds > 0.0F ? std::min(seconds, library->seconds(0)) : actor.clips->startSeconds,
                      dolls[i]);
        if (play_.limp) actor.puppet->goLimp();
    }
    for (Actor& actor : actors_)
        actor.puppet->onChange(
            [this, &actor](physics::PuppetState, physics::PuppetState after) { notice(actor, after); });
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
    actor.rising.end();
    actor.puppet->approach();
    if (actor.player != nullptr) {
        actor.player->seek(0, memory.clipSeconds);
        pose(actor, now_);
        actor.motion.setPose(now_);
    }
    constexpr float atOnce = 1e-3F;  // seconds
    isResuming_ = true;
    if (memory.limp)
        actor.puppet->goLimp();
    else
        actor.puppet->comeBack(atOnce);
    isResuming_ = false;
}

void PuppetCast::startClip(Actor& actor, float seconds, physics::DollId doll) {
    // Shapes reach a little beyond the skin, and clips put feet into the ground: a pinned doll would tread on it.
    actor.lift = std::max(-clearance(actor), 0.0F);
    if (!play_.limp) actor.worldFromModel.translation.y += actor.lift;
    actor.player = std::make_unique<animation::ClipPlayer>(
        *actor.clips->library, std::vector<animation::LayerSettings>{}, animation::RootMotion::extract);
    actor.player->play(0, 0, {.start = seconds});
    pose(actor, now_);
    actor.motion.setPose(now_);
    if (play_.limp) return;
    bodies_.resize(now_.size());
    world_->getBodies(doll, bodies_);
    const bool isElsewhere = play_.borrows || seconds != actor.clips->startSeconds;
    // On ramps and steps the pose is fitted to the ground there: begun in the level one, the doll would be pulled over.
    // Where a slope asks far more of an ankle than it can give, the limit would turn the foot into the ground at once.
    const bool isFitted = actor.terrain && play_.meetsGround && isNearLimits(actor.asset->profile, now_);
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        bodies_[i].worldFromBody.translation.y += actor.lift;
        if (isElsewhere)
            bodies_[i] = {now_[i], vec3(0), vec3(0)};
        else if (isFitted)
            bodies_[i].worldFromBody = now_[i];
    }
    world_->setBodies(doll, bodies_);
}

// How far its lowest body stays above the ground of its bind pose, or what it is to keep over it, metres.
float PuppetCast::clearance(const Actor& actor) {
    constexpr float kStep = 1.0F / 60.0F;
    const animation::Skeleton& skeleton = actor.asset->character.skeleton;
    const RigidTransform standing{actor.asset->map.standardFromModel, vec3(0, -actor.soles, 0)};
    float lowest = 1e9F;
    joints_.resize(skeleton.parents.size());
    for (float seconds = 0.0F; seconds <= actor.clips->library->seconds(0); seconds += kStep) {
        actor.clips->library->sampleInPlace(0, seconds, joints_);
        animation::localToModel(skeleton, joints_, joints_);
        bodies_.resize(actor.asset->profile.bodies.size());
        physics::bodiesFromPose(actor.asset->rig, joints_, standing, bodies_);
        for (std::size_t i = 0; i < bodies_.size(); ++i)
            lowest = std::min(lowest, actor.clips->floor->heightOver(static_cast<int>(i), bodies_[i].worldFromBody));
    }
    return lowest;
}

void PuppetCast::notice(Actor& actor, physics::PuppetState after) {
    if (after == physics::PuppetState::limp && !isResuming_) tally_.addKnockOut();
    if (after == physics::PuppetState::animated && actor.sinceHit >= 0.0F) {
        tally_.addRecovery(actor.sinceHit);
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
        const auto ground = [this](const vec3& point) { return ground_.footing(*world_, point); };
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

// A doll's bodies as they are in the world. Holds until the next call.
std::span<const BodyState> PuppetCast::readBodies(const Actor& actor) {
    bodies_.resize(actor.asset->profile.bodies.size());
    world_->getBodies(actor.puppet->doll(), bodies_);
    return bodies_;
}

// Hits whose moment lies in the coming step.
void PuppetCast::hitDue(float dt) {
    for (const PuppetHit& hit : play_.hits) {
        const auto at = static_cast<double>(hit.seconds);
        if (at < seconds_ || at >= seconds_ + static_cast<double>(dt)) continue;
        for (Actor& actor : actors_) {
            const int body = bodyMet(actor.asset->profile, hit.body);
            if (body < 0 || (hit.doll >= 0 && &actor != &actors_[hit.doll])) continue;
            actor.puppet->hit(
                body, readBodies(actor)[body].worldFromBody.translation,
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
        if (actor.rising.isOn())
            rise(actor, dt);
        else if (actor.player != nullptr)
            playOn(actor, dt);
        if (actor.sinceHit >= 0.0F) actor.sinceHit += dt;
        actor.puppet->prepare(actor.motion.from(), actor.motion.to(), dt);
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
    pose(actor, actor.motion.raw(), dt);
    show(actor, dt);
}

// What the doll is to do: the raw motion, blended into, and out of the floor while that is not sure.
void PuppetCast::show(Actor& actor, float dt) {
    const float level = levelOf(actor);
    const GroundHeight ground = [this, level](const vec3& point) {
        return ground_.isLevel() ? level : ground_.heightBelow(*world_, point);
    };
    // A doll that nothing holds up keeps its feet on the ground.
    const bool mayStep = actor.puppet->settings().pinForceN > 0.0F && play_.led.empty();
    actor.motion.advance({readBodies(actor), ground, actor.rising.isOn(), mayStep, dt});
}

std::span<const RigidTransform> PuppetCast::pose(int doll, float alpha) {
    const ShownMotion& motion = actors_[doll].motion;
    mixed_.resize(motion.to().size());
    for (std::size_t body = 0; body < mixed_.size(); ++body)
        mixed_[body] = interpolate(motion.from()[body], motion.to()[body], alpha);
    return mixed_;
}

// Height of the level floor that it is on.
float PuppetCast::levelOf(const Actor& actor) {
    return actor.rising.isOn() ? actor.ground : actor.worldFromModel.translation.y + actor.soles - actor.lift;
}

void PuppetCast::watchRest(Actor& actor, float dt) {
    if (actor.puppet->state() != PuppetState::limp) {
        actor.rising.wake();
        return;
    }
    const bool isAsleep = world_->isAsleep(actor.puppet->doll());
    if (actor.rising.watch(actor.asset->profile, readBodies(actor), isAsleep, dt)) beginRising(actor, dt);
}

// From where the doll lies into the frame that is most like it.
void PuppetCast::beginRising(Actor& actor, float dt) {
    GetUpClips& clips = *actor.clips->getUp;
    actor.motion.follow(readBodies(actor), dt);
    const std::vector<RigidTransform>& now = actor.motion.to();
    actor.ground = ground_.heightBelow(*world_, now[actor.root].translation);
    actor.rising.begin(clips.match(now, actor.ground));
    actor.motion.raw().resize(now.size());
    clips.sample(actor.rising.match(), actor.rising.clipSeconds(), actor.motion.raw());
    actor.motion.blendIntoRaw(dt);
    actor.puppet->getUp(kStrengthSeconds);
    getUps_.begin(actor.rising.match().distanceM);
}

void PuppetCast::rise(Actor& actor, float dt) {
    GetUpClips& clips = *actor.clips->getUp;
    actor.rising.advance(dt, actor.motion.mostFootLag(readBodies(actor)), actor.motion.blended());
    clips.sample(actor.rising.match(), actor.rising.clipSeconds(), actor.motion.raw());
    if (actor.rising.clipSeconds() >= clips.seconds(actor.rising.match().clip)) {
        standUp(actor, dt);
        return;
    }
    show(actor, dt);
    // The pin carries most of the doll on its way up, so that the ground holds a foot with little: a hip that turns a
    // heavy trunk would push it away. It is held as by the friction of its share of the weight.
    constexpr float kGrip = 0.25F;  // of the doll's weight
    actor.feet.hold(*actor.puppet, readBodies(actor),
                    kGrip * actor.asset->profile.totalMassKg * glm::length(play_.gravity));
}

// On with the clip, over the place where it stands and as it heads.
void PuppetCast::standUp(Actor& actor, float dt) {
    actor.rising.end();
    actor.puppet->stand();
    getUps_.stand(actor.rising.seconds());
    actor.feet.release();
    const RigidTransform stands = actor.motion.to()[actor.root];
    actor.player->play(0, 0, {});
    actor.worldFromModel = {actor.asset->map.standardFromModel, {0, actor.ground + actor.lift - actor.soles, 0}};
    actor.base = actor.ground;
    pose(actor, now_);
    const quat heading = headingOf(glm::normalize(stands.rotation * glm::conjugate(now_[actor.root].rotation)));
    actor.worldFromModel.rotation = glm::normalize(heading * actor.worldFromModel.rotation);
    const vec3 shift = stands.translation - heading * now_[actor.root].translation;
    actor.worldFromModel.translation = heading * actor.worldFromModel.translation + vec3(shift.x, 0, shift.z);
    pose(actor, actor.motion.raw());
    actor.motion.blendIntoRaw(dt);
    playOn(actor, dt);
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

// Bodies are in frames_ after a step, as for the next two.
void PuppetCast::measureRising(Actor& actor) {
    const physics::RagdollProfile& profile = actor.asset->profile;
    const auto turn = actor.rising.turnOfStep(profile, frames_);
    if (turn) getUps_.turn(turn->degrees, profile.bodies[profile.constraints[turn->constraint].child].name);
}

void PuppetCast::measureFeet(Actor& actor) {
    if (actor.puppet->state() == PuppetState::reacting) {
        // What strikes it may move its feet.
        actor.feet.release();
        return;
    }
    const bool rises = actor.rising.isOn();
    const animation::GroundHit level{levelOf(actor), vec3(0, 1, 0)};
    const auto ground = [&](const vec3& point) {
        return ground_.isLevel() ? level : ground_.footing(*world_, point).value_or(level);
    };
    const float slid = actor.feet.slideAfter(
        {actor.motion.from(), actor.motion.to(), frames_, ground, dt_, rises ? actor.rising.pace() : 1.0F});
    if (slid < 0.0F) return;
    tally_.addSlide(slid);
    if (rises) getUps_.slide(slid);
}

// How near feet that stand in the clip are to the ground.
void PuppetCast::measureFooting(const Actor& actor) {
    if (!actor.terrain || actor.rising.isOn() || actor.puppet->state() != PuppetState::animated) return;
    const physics::RagdollProfile& profile = actor.asset->profile;
    const std::array<int, 2> feet{physics::bodyOf(profile, physics::Role::leftFoot),
                                  physics::bodyOf(profile, physics::Role::rightFoot)};
    for (int leg = 0; leg < 2; ++leg) {
        if (feet[leg] < 0 || !actor.terrain->stands(leg)) continue;
        tally_.addFooting(ground_.distanceFrom(profile.bodies[feet[leg]].shape, frames_[feet[leg]]));
    }
}

void PuppetCast::measure() {
    feelContacts();
    for (Actor& actor : actors_) {
        if (actor.puppet->state() == physics::PuppetState::limp) continue;
        const physics::RagdollProfile& profile = actor.asset->profile;
        frames_.clear();
        for (const BodyState& body : readBodies(actor))
            frames_.push_back(body.worldFromBody);
        if (actor.rising.isOn()) measureRising(actor);
        measureFeet(actor);
        measureFooting(actor);
        const std::vector<RigidTransform>& aim = actor.motion.to();
        for (std::size_t i = 0; i < frames_.size(); ++i)
            if (actor.puppet->weightOf(static_cast<int>(i)) >= 1.0F)
                tally_.addLed(glm::distance(frames_[i].translation, aim[i].translation));
        errors_.resize(profile.constraints.size());
        physics::jointErrors(profile, aim, frames_, errors_);
        tally_.addJoints(actor.assetIndex, errors_);
        tally_.addRoot(glm::distance(frames_[actor.root].translation, aim[actor.root].translation));
    }
}

PuppetFigures PuppetCast::figures() const {
    PuppetFigures figures = tally_.figures();
    for (const PuppetClips& clips : clips_) {
        if (clips.reachDeg <= figures.clipReachDeg) continue;
        figures.clipReachDeg = clips.reachDeg;
        figures.clipReachJoint = clips.reachJoint;
    }
    figures.limp = static_cast<int>(std::count_if(actors_.begin(), actors_.end(), [](const Actor& actor) {
        return actor.puppet->state() == physics::PuppetState::limp;
    }));
    return figures;
}

}  // namespace lutka::scene
