#include "scene/run/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <functional>
#include <glm/geometric.hpp>

#include "core/assert.hpp"
#include "core/random.hpp"
#include "scene/asset/skin_reach.hpp"
#include "scene/puppet/stand_on_ground.hpp"
#include "scene/run/make_world.hpp"
#include "scene/run/simulation_check.hpp"
#include "scene/run/start_pose.hpp"

namespace lutka::scene {
namespace {

using physics::BodyState;

vec3 centreOfMass(const physics::RagdollProfile& profile, std::span<const BodyState> bodies) {
    vec3 sum(0);
    float mass = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        sum += bodies[i].worldFromBody.translation * profile.bodies[i].massKg;
        mass += profile.bodies[i].massKg;
    }
    return sum / mass;
}

// Model space → world at a placement, the placement's own velocities added.
void place(const physics::RagdollProfile& profile, const Placement& placement, std::span<const BodyState> inModel,
           std::span<BodyState> inWorld) {
    const RigidTransform& worldFromModel = placement.worldFromModel;
    for (std::size_t i = 0; i < inModel.size(); ++i) {
        inWorld[i].worldFromBody = worldFromModel * inModel[i].worldFromBody;
        inWorld[i].linearVelocity = worldFromModel.rotation * inModel[i].linearVelocity;
        inWorld[i].angularVelocity = worldFromModel.rotation * inModel[i].angularVelocity;
    }
    const vec3 centre = centreOfMass(profile, inWorld);
    for (BodyState& body : inWorld) {
        const vec3 arm = body.worldFromBody.translation - centre;
        body.linearVelocity += placement.linearVelocity + glm::cross(placement.angularVelocity, arm);
        body.angularVelocity += placement.angularVelocity;
    }
}

// Strong enough to hold several figures' weight: a pin is a part of the scene, not a user's pull.
constexpr float kPinForceN = 5000.0F;

}  // namespace

SimulationOptions simulationOptionsOf(const EntityScene& scene) {
    SimulationOptions options;
    options.world = scene.simulation.world;
    options.dt = scene.simulation.dt;
    if (scene.simulation.puppets) {
        const ScenePuppets& puppets = *scene.simulation.puppets;
        PuppetPlay& play = options.puppet.emplace();
        play.start.clip = puppets.clip;
        play.ownMuscles = !puppets.muscles;
        play.puppet.muscles = physics::musclesOf(puppets.muscles.value_or(physics::MusclePreset::powered));
        play.puppet.muscles.strength = puppets.strength;
        play.pinForceN = puppets.pinForceN;
        play.led = puppets.kinematic;
        play.getUp = puppets.getUp;
        play.limp = puppets.limp;
        play.pace = puppets.pace;
        play.borrows = true;
    }
    return options;
}

Result<std::unique_ptr<Simulation>> Simulation::create(const RagdollAsset& asset, Scenario scenario,
                                                       const SimulationOptions& options) {
    return create(std::vector<const RagdollAsset*>{&asset}, std::move(scenario), options);
}

Result<std::unique_ptr<Simulation>> Simulation::create(std::vector<const RagdollAsset*> assets, Scenario scenario,
                                                       const SimulationOptions& options) {
    if (const std::vector<std::string> problems = problemsOf(assets, scenario, options); !problems.empty())
        return Error{ErrorCode::usage, fmt::format("{}", fmt::join(problems, "; ")), "simulation", {}};
    std::unique_ptr<Simulation> simulation(new Simulation(std::move(assets), std::move(scenario), options));
    if (auto found = simulation->findStarts(); !found) return found.error();
    if (auto found = simulation->findPuppets(); !found) return found.error();
    if (auto found = simulation->findClips(); !found) return found.error();
    simulation->build();
    return simulation;
}

Simulation::Simulation(std::vector<const RagdollAsset*> assets, Scenario scenario, const SimulationOptions& options)
    : assets_(std::move(assets)),
      scenario_(std::move(scenario)),
      options_(options),
      eye_(options.eye.value_or(scenario_.focus)) {
    firstBody_.push_back(0);
    for (int doll = 0; doll < dollCount(); ++doll)
        firstBody_.push_back(firstBody_.back() + assetOf(doll).profile.bodies.size());
    motions_.resize(scenario_.dolls.size());
    if (!options_.puppet) return;
    // Puppets begin where their clip does; one that is borrowed is known to the cast alone.
    if (!options_.puppet->start.clip.empty() && !options_.fromClip && !options_.puppet->borrows &&
        !options_.puppet->limp)
        options_.fromClip = options_.puppet->start;
    PuppetPlay& play = *options_.puppet;
    play.hits.insert(play.hits.end(), scenario_.hits.begin(), scenario_.hits.end());
    play.gravity = options_.world.gravity;
    options_.world.contactReports = true;  // what flies against a puppet weakens it
}

Result<void> Simulation::findStarts() {
    std::vector<const Placement*> known;
    for (int doll = 0; doll < dollCount(); ++doll) {
        const Placement& placement = scenario_.dolls[doll];
        const auto same = std::find_if(known.begin(), known.end(), [&](const Placement* other) {
            return other->asset == placement.asset && other->pose == placement.pose && other->clip == placement.clip;
        });
        startOfDoll_.push_back(static_cast<std::size_t>(same - known.begin()));
        if (same != known.end()) continue;
        // Puppets with borrowed clips are placed by their cast.
        Placement from = placement;
        if (options_.puppet && options_.puppet->borrows) from.clip.reset();
        auto start = startBodies(assetOf(doll), options_, from);
        if (!start) return start.error();
        starts_.push_back(std::move(start).value());
        known.push_back(&placement);
    }
    return {};
}

Result<void> Simulation::findPuppets() {
    if (!options_.puppet) return {};
    if (!options_.puppet->led.empty() && options_.world.solver == physics::SolverKind::stock)
        return Error{ErrorCode::usage, "the solver 'stock' can't lead bodies to a clip", "kinematic",
                     "take 'crowd' or 'bullet'"};
    auto cast = PuppetCast::create(assets_, scenario_, *options_.puppet);
    if (!cast) return cast.error();
    puppets_ = std::move(cast).value();
    return {};
}

Result<void> Simulation::findClips() {
    if (!options_.play) return {};
    auto cast = ClipCast::create(assets_, *options_.play);
    if (!cast) return cast.error();
    clipCast_ = std::move(cast).value();
    return {};
}

void Simulation::build() {
    if (puppets_ != nullptr) puppets_->end();
    meter_.reset();
    shedder_.reset();
    dollIds_.clear();
    const bool isFirst = world_ == nullptr;
    world_ = makeWorld(options_.world);
    // None is refused: create() has asked the same question.
    for (const physics::StaticShape& shape : scenario_.statics) {
        [[maybe_unused]] const physics::StaticId id = world_->addStatic(shape);
        LUTKA_ASSERT(id.isSet());
    }
    for (const physics::DynamicProp& prop : scenario_.props) {
        [[maybe_unused]] const physics::PropId id = world_->addProp(prop);
        LUTKA_ASSERT(id.isSet());
    }
    if (puppets_ != nullptr && !puppets_->settings().limp) {
        const auto startOf = [this](int doll) -> std::span<const BodyState> {
            if (options_.puppet->borrows) return {};
            return starts_[startOfDoll_[doll]];
        };
        if (isFirst) standOnGround(*world_, assets_, startOf, scenario_);
        puppets_->place(scenario_.dolls);
    }
    for (int doll = 0; doll < dollCount(); ++doll) {
        placeAtStart(doll);
        dollIds_.push_back(world_->addDoll(assetOf(doll).profile, scratch_));
    }
    addPins();
    if (puppets_ != nullptr) puppets_->begin(*world_, dollIds_);
    watch();
    steps_ = 0;
    stepMs_.clear();
    stepMs_.reserve(2 * kKeptSteps);
    secondsMeasured_ = 0;
    if (clipCast_ != nullptr) {
        clipCast_->reset();
        placeActors();
    }
    remember();
    noteJump();
}

// Pulls on the bodies that the scene holds, towards where they start.
void Simulation::addPins() {
    for (const Pin& pin : scenario_.pins) {
        const RagdollAsset& asset = assetOf(pin.doll);
        const int body = physics::bodyNamed(asset.profile, pin.body);
        if (body < 0) continue;  // a figure without hands falls
        placeAtStart(pin.doll);
        const vec3 hold = bodyFromHold(asset.profile, asset.rig, body);
        const vec3 held = scratch_[body].worldFromBody * hold;
        world_->addDrag({dollIds_[pin.doll], body, hold, held, kPinForceN});
    }
}

// What is spared, or what is measured.
void Simulation::watch() {
    if (options_.shed.any()) {
        std::vector<LoadShedder::Kind> kinds;
        kinds.reserve(scenario_.dolls.size());
        for (int doll = 0; doll < dollCount(); ++doll)
            kinds.push_back({&assetOf(doll).profile, &assetOf(doll).rig});
        shedder_ = std::make_unique<LoadShedder>(kinds, *world_, scenario_.statics, options_.world, options_.shed);
    } else if (options_.measure && clipCast_ == nullptr) {
        meter_ = std::make_unique<physics::QualityMeter>(*world_, scenario_.statics, options_.world.gravity);
    }
}

// The dolls' bodies where the clip has them: what is placed, not simulated.
void Simulation::placeActors() {
    for (int doll = 0; doll < dollCount(); ++doll) {
        scratch_.resize(assetOf(doll).profile.bodies.size());
        clipCast_->bodies(scenario_.dolls[doll].asset, scratch_);
        const RigidTransform& worldFromModel = scenario_.dolls[doll].worldFromModel;
        for (BodyState& body : scratch_) {
            body.worldFromBody = worldFromModel * body.worldFromBody;
            body.linearVelocity = worldFromModel.rotation * body.linearVelocity;
            body.angularVelocity = worldFromModel.rotation * body.angularVelocity;
        }
        world_->setBodies(dollIds_[doll], scratch_);
    }
}

// The doll's bodies at its start, in scratch_.
void Simulation::placeAtStart(int doll) {
    const std::vector<BodyState>& start = starts_[startOfDoll_[doll]];
    scratch_.resize(start.size());
    place(assetOf(doll).profile, scenario_.dolls[doll], start, scratch_);
}

void Simulation::reset() {
    build();
}

void Simulation::refresh() {
    remember();
    noteJump();
}

void Simulation::remember() {
    present_.resize(bodyCount() + scenario_.props.size());
    for (int doll = 0; doll < dollCount(); ++doll) {
        const auto to = std::span(present_).subspan(firstBody_[doll], firstBody_[doll + 1] - firstBody_[doll]);
        if (shedder_ != nullptr) {
            shedder_->getBodies(doll, to);
            continue;
        }
        scratch_.resize(to.size());
        world_->getBodies(dollIds_[doll], scratch_);
        for (std::size_t i = 0; i < to.size(); ++i)
            to[i] = scratch_[i].worldFromBody;
    }
    std::size_t at = bodyCount();
    for (const physics::PropId prop : world_->props())
        present_[at++] = world_->propState(prop).worldFromBody;
}

std::span<const std::vector<vec3>> Simulation::skinReachOf(int doll) {
    skinReach_.resize(assets_.size());
    std::vector<std::vector<vec3>>& reach = skinReach_[static_cast<std::size_t>(scenario_.dolls[doll].asset)];
    if (reach.empty()) reach = skinReach(assetOf(doll));
    return reach;
}

void Simulation::step() {
    using Clock = std::chrono::steady_clock;
    const auto before = Clock::now();
    Clock::duration measured{0};
    if (puppets_ != nullptr) puppets_->prepare(options_.dt);
    if (clipCast_ != nullptr) {
        clipCast_->advance(options_.dt);
        placeActors();
    } else if (shedder_ != nullptr) {
        shedder_->step(options_.dt, eye_);
    } else if (meter_ != nullptr) {
        const double substep = static_cast<double>(options_.dt) / world_->substepsPerStep();
        const auto sample = [&] {
            const auto measuring = Clock::now();
            secondsMeasured_ += substep;
            meter_->sample(secondsMeasured_);
            measured += Clock::now() - measuring;
        };
        world_->step(options_.dt, std::cref(sample));  // by reference: a copy of its captures would be on the heap
    } else {
        world_->step(options_.dt);
    }
    noteTime(std::chrono::duration<float, std::milli>(Clock::now() - before - measured).count());
    if (puppets_ != nullptr) puppets_->measure();
    previous_ = present_;  // not swapped: what is given to callers stays in its place
    remember();
    noteMotion();
}

// The older half of the times goes when there is no more room.
void Simulation::noteTime(float milliseconds) {
    ++steps_;
    if (stepMs_.size() == 2 * kKeptSteps) stepMs_.erase(stepMs_.begin(), stepMs_.begin() + kKeptSteps);
    stepMs_.push_back(milliseconds);
}

// After a step. By their bits rather than by isAsleep(): frozen dolls and what a recording shows at rest count too,
// and what is moved by hand does not.
void Simulation::noteMotion() {
    for (int doll = 0; doll < dollCount(); ++doll) {
        const std::size_t first = firstBody_[doll];
        const std::size_t bytes = (firstBody_[doll + 1] - first) * sizeof(RigidTransform);
        const bool moves = std::memcmp(&previous_[first], &present_[first], bytes) != 0;
        PosedSkins::Motion& motion = motions_[doll];
        // In the step that brings it to rest what it came from changes once more.
        if (moves || motion.moves) ++motion.revision;
        motion.moves = moves;
    }
}

// After placing: what was before is where all are now.
void Simulation::noteJump() {
    previous_ = present_;
    for (PosedSkins::Motion& motion : motions_) {
        ++motion.revision;
        motion.moves = false;
    }
}

void Simulation::show(std::span<const RigidTransform> frame) {
    LUTKA_ASSERT(frame.size() == present_.size());
    previous_ = present_;  // not swapped: what is given to callers stays in its place
    std::copy(frame.begin(), frame.end(), present_.begin());
    noteMotion();
    noteTime(0.0F);
}

void Simulation::preview(std::span<const RigidTransform> frame) {
    LUTKA_ASSERT(frame.size() == present_.size());
    std::copy(frame.begin(), frame.end(), present_.begin());
    noteJump();
}

std::span<const RigidTransform> Simulation::worldFromBody(int doll, float alpha) {
    const std::size_t first = firstBody_[doll];
    const std::size_t bodies = firstBody_[doll + 1] - first;
    if (alpha >= 1.0F) return std::span(present_).subspan(first, bodies);
    mixed_.resize(bodies);
    for (std::size_t i = 0; i < bodies; ++i)
        mixed_[i] = interpolate(previous_[first + i], present_[first + i], alpha);
    return mixed_;
}

RigidTransform Simulation::worldFromProp(int prop, float alpha) const {
    const std::size_t at = bodyCount() + static_cast<std::size_t>(prop);
    return interpolate(previous_[at], present_[at], alpha);
}

void Simulation::pose(int doll, float alpha, std::span<RigidTransform> modelFromJoint) {
    // The clip's own pose: bodies know nothing of fingers.
    if (clipCast_ != nullptr) {
        clipCast_->pose(scenario_.dolls[doll].asset, alpha, modelFromJoint);
        return;
    }
    const RagdollAsset& asset = assetOf(doll);
    physics::poseFromBodies(asset.rig, asset.character.skeleton, worldFromBody(doll, alpha), worldFromModel(doll),
                            modelFromJoint);
}

const PosedSkins& Simulation::poseSkins(float alpha) {
    if (skins_ == nullptr) skins_ = std::make_unique<PosedSkins>(assets_, scenario_, options_.world.threads);
    skins_->update({previous_, present_, motions_}, alpha);
    for (int doll = 0; clipCast_ != nullptr && doll < dollCount(); ++doll) {
        actorPose_.resize(assetOf(doll).character.skeleton.parents.size());
        pose(doll, alpha, actorPose_);
        skins_->show(doll, assetOf(doll).character.skeleton, actorPose_);
    }
    return *skins_;
}

void Simulation::getBodies(int doll, std::span<BodyState> bodies) const {
    if (shedder_ != nullptr)
        shedder_->getStates(doll, bodies);
    else
        world_->getBodies(dollIds_[doll], bodies);
}

bool Simulation::isAsleep(int doll) const {
    return shedder_ != nullptr ? shedder_->still(doll) : world_->isAsleep(dollIds_[doll]);
}

physics::DollId Simulation::dollId(int doll) const {
    return shedder_ != nullptr ? shedder_->idIn(*world_, doll) : dollIds_[doll];
}

int Simulation::dollOf(physics::DollId id) const {
    for (int doll = 0; id.isSet() && doll < dollCount(); ++doll)
        if (dollId(doll) == id) return doll;
    return -1;
}

physics::Quality Simulation::quality() const {
    return meter_ != nullptr ? meter_->result() : physics::Quality{};
}

std::uint64_t Simulation::stateHash() const {
    std::uint64_t hash = kHashStart;
    for (int doll = 0; doll < dollCount(); ++doll) {
        scratch_.resize(assetOf(doll).profile.bodies.size());
        getBodies(doll, scratch_);
        for (const BodyState& body : scratch_)
            hash = hashBytes(&body, sizeof body, hash);
    }
    return hash;
}

}  // namespace lutka::scene
