#include "editor/play/player.hpp"

#include <algorithm>

#include "scene/description/scenario.hpp"

namespace lutka::editor {
namespace {

constexpr float kBallRadius = 0.09F;  // metres; with the mass, a medicine ball
constexpr float kBallMassKg = 5.0F;
constexpr float kPosingDamping = 0.75F;  // of the velocity that a step leaves while posing
constexpr std::size_t kMaxThrown = 24;   // each makes every step slower

physics::DynamicProp ballAt(const vec3& place) {
    physics::DynamicProp ball;
    ball.shape.kind = physics::BodyShape::Kind::sphere;
    ball.shape.radius = kBallRadius;
    ball.massKg = kBallMassKg;
    ball.state.worldFromBody.translation = place;
    return ball;
}

}  // namespace

Player::Player(EditorDocument& document, scene::FrameLoop::Clock clock)
    : document_(document), loop_({}, std::move(clock)) {}

Result<scene::Scenario> Player::makeScenario() {
    std::vector<scene::Figure> figures;
    for (const scene::RagdollAsset* asset : document_.sceneDocument().assets())
        figures.push_back(scene::figureOf(*asset));
    auto scenario = scene::compileScene(document_.scene(), figures, document_.sceneDocument().assetOfRagdoll());
    if (!scenario) return scenario;
    const std::optional<scene::ClipStart>& clip = document_.sceneDocument().settings().clip;
    for (scene::Placement& doll : scenario.value().dolls) {
        if (!doll.pose && !doll.clip && doll.asset == 0) doll.clip = clip;
    }
    auto& props = scenario.value().props;
    props.insert(props.end(), thrown_.begin(), thrown_.end());
    return scenario;
}

Result<void> Player::build(const Motion* motion, bool all, Hold hold) {
    held_.detach();
    simulation_.reset();  // it borrows the asset that changes now
    document_.commitAsset();
    revision_ = document_.revision();
    auto scenario = makeScenario();
    if (!scenario) return scenario.error();
    if (motion != nullptr) keepProps(*motion, all, scenario.value());
    scene::SimulationOptions options = scene::simulationOptionsOf(document_.scene());
    if (posing_) {
        options.world.gravity = vec3(0);
        options.world.sleeping = false;
    }
    options.pose = document_.sceneDocument().settings().pose;
    auto simulation = scene::Simulation::create(document_.sceneDocument().assets(), scenario.value(), options);
    if (!simulation && options.puppet) {
        // A figure that can't follow the clip falls.
        refusal_ = "The characters fall: " + simulation.error().text();
        options.puppet.reset();
        simulation = scene::Simulation::create(document_.sceneDocument().assets(), scenario.value(), options);
    }
    if (!simulation) return simulation.error();
    simulation_ = std::move(simulation).value();
    governor_.emplace(simulation_->world().substepsPerStep());
    if (motion != nullptr) restore(*motion, all);
    if (stage_ && !stage_->follow(*simulation_)) stage_.reset();
    held_.attach(*simulation_, [&](int doll) {
        return hold == Hold::here || motion == nullptr || all || !startsAsBefore(entityOfDoll(doll));
    });
    built_ = document_.scene();
    loop_.setStepSeconds(options.dt);
    loop_.restart();
    return {};
}

Result<void> Player::rebuild(Keep keep) {
    if (keep == Keep::nothing) stage_.reset();
    if (deck_.replaying()) deck_.endReplay(*simulation_);
    thrown_.resize(thrown_.size() - std::min(thrown_.size(), std::exchange(thrownForReplay_, 0)));
    std::optional<Motion> motion;
    if (keep == Keep::motion && simulation_ != nullptr) motion = capture();
    if (keep == Keep::nothing) {
        deck_.stop("the scene begins anew");
        atPlay_.reset();
        thrown_.clear();
        posing_ = false;
        secondsBefore_ = 0.0;
        somethingMoved();
    } else if (simulation_ != nullptr) {
        secondsBefore_ = seconds();
    }
    // Bodies of another cut can't go on as they were; when the old ones come back before anything moved, they do.
    if (motion && !suits(*motion)) {
        remember(*motion);
        if (const Motion* old = remembered(); old != nullptr) motion = *old;
    }
    return build(motion ? &*motion : nullptr, false);
}

PlayState Player::state() const {
    PlayState now{capture(), thrown_, {}, seconds(), moment_};
    // A clip is only shown: to go back is to go back to where the doll was before it.
    if (const auto before = stage_ ? stage_->before(*simulation_) : std::nullopt)
        now.motion.dolls[stage_->doll()].bodies = *before;
    return now;
}

Result<void> Player::restore(const PlayState& state) {
    endReplay();
    stage_.reset();
    thrown_ = state.thrown;
    posing_ = false;
    if (auto built = build(&state.motion, true); !built) return built;
    secondsBefore_ = state.seconds;
    moment_ = state.moment;
    return {};
}

void Player::dampDolls(float share) {
    for (int doll = 0; doll < simulation_->dollCount(); ++doll) {
        auto bodies = bodiesOf(doll);
        for (physics::BodyState& body : bodies) {
            body.linearVelocity *= share;
            body.angularVelocity *= share;
        }
        simulation_->world().setBodies(simulation_->dollId(doll), bodies);
    }
    somethingMoved();
}

Result<void> Player::setPosing(bool posing) {
    if (posing == posing_) return {};
    if (posing_) dampDolls(0.0F);
    secondsBefore_ = seconds();
    posing_ = posing;
    const double standing = secondsBefore_;
    auto rebuilt = rebuild(Keep::motion);
    secondsBefore_ = standing;
    return rebuilt;
}

void Player::setPlaying(bool playing) {
    if (playing && !playing_ && !deck_.replaying() && !stage_ && simulation_ != nullptr) atPlay_ = capture();
    if (playing && stage_ && stage_->atEnd()) seekClip(0.0F);
    if (playing && deck_.replaying() && deck_.atEnd()) scrubTo(0.0);
    playing_ = playing;
}

void Player::returnToPlay() {
    if (!atPlay_) return;
    endReplay();
    stage_.reset();
    playing_ = false;
    // As a rebuild would, but for the time: what was thrown since stays thrown.
    const Motion motion = *std::exchange(atPlay_, std::nullopt);
    somethingMoved();
    [[maybe_unused]] const bool built = build(&motion, false, Hold::here).ok();
    LUTKA_ASSERT(built);  // the document is as it was
}

// Held bodies stay where they have been put.
void Player::holdHere() {
    held_.attach(*simulation_, [](int) { return true; });
}

void Player::advance(double seconds) {
    if (deck_.replaying()) return advanceReplay(seconds);
    if (stage_) return moveClip(playing_ ? static_cast<float>(std::min(seconds, 0.1) * speed_) : 0.0F);
    if (!playing_ && !posing_) return;
    loop_.setSpeed(posing_ ? 1.0 : speed_);
    loop_.advance(seconds, [&] {
        step();
        if (posing_) dampDolls(kPosingDamping);
        deck_.keepStep(*simulation_);
    });
    if (sparing_) simulation_->world().setSubsteps(governor_->update(loop_.load()));
}

void Player::stepOnce() {
    playing_ = false;
    if (deck_.replaying()) return deck_.showNextStep(*simulation_);
    if (stage_) return moveClip(simulation_->options().dt);
    loop_.restart();
    step();
    deck_.keepStep(*simulation_);
}

void Player::step() {
    held_.prepare(simulation_->options().dt);
    simulation_->step();
    somethingMoved();
}

void Player::simulateOnly(std::span<const Item> bodies) {
    std::vector<int> dolls;
    for (int doll = 0; doll < simulation_->dollCount(); ++doll)
        if (isEditedDoll(doll)) dolls.push_back(doll);
    held_.holdAllBut(bodies, dolls, *simulation_);
}

Result<void> Player::showClip(const std::string& clip, int doll) {
    endReplay();
    if (stage_ && stage_->doll() != doll) endClip(true);
    auto stage = ClipStage::create(*simulation_, doll, clip);
    if (!stage) return stage.error();
    if (stage_) stage.value().takeOver(*stage_);
    stage_ = std::move(stage).value();
    moveClip(0.0F);
    return {};
}

void Player::moveClip(float seconds) {
    stage_->advance(seconds);
    stage_->place(*simulation_);
    if (seconds > 0.0F) somethingMoved();
    if (stage_->atEnd()) playing_ = false;
}

void Player::seekClip(float seconds) {
    if (!stage_) return;
    stage_->seek(seconds);
    moveClip(0.0F);
    somethingMoved();
}

void Player::endClip(bool back) {
    if (!stage_) return;
    if (back) stage_->placeBack(*simulation_);
    stage_.reset();
    holdHere();
    loop_.restart();
    somethingMoved();
}

void Player::hit(const Item& body, const vec3& point, const vec3& impulse) {
    endClip(false);
    if (scene::PuppetCast* puppets = simulation_->puppets())
        puppets->puppet(body.doll).hit(body.index, point, impulse);
    else
        simulation_->world().applyImpulse(simulation_->dollId(body.doll), body.index, impulse, point);
    somethingMoved();
}

Result<void> Player::reset() {
    return rebuild(Keep::nothing);
}

int Player::dollOf(scene::EntityId id) const {
    const auto& dolls = simulation_->scenario().dollEntities;
    const auto at = std::find(dolls.begin(), dolls.end(), id);
    return at != dolls.end() ? static_cast<int>(at - dolls.begin()) : -1;
}

RigidTransform Player::worldFromEntity(scene::EntityId id) const {
    RigidTransform start = scene::worldFromEntity(document_.scene(), id);
    if (stale()) return start;
    const auto& props = simulation_->scenario().propEntities;
    if (const auto prop = std::find(props.begin(), props.end(), id); prop != props.end()) {
        return simulation_->worldFromProp(static_cast<int>(prop - props.begin()), alpha());
    }
    if (const int doll = dollOf(id); doll >= 0) {
        return {start.rotation, bodiesOf(doll).front().worldFromBody.translation};
    }
    return start;
}

std::vector<physics::BodyState> Player::bodiesOf(int doll) const {
    std::vector<physics::BodyState> bodies(simulation_->assetOf(doll).profile.bodies.size());
    simulation_->getBodies(doll, bodies);
    return bodies;
}

void Player::placeBodies(int doll, std::span<const physics::BodyState> bodies) {
    simulation_->world().setBodies(simulation_->dollId(doll), bodies);
    simulation_->refresh();
    holdHere();
    somethingMoved();
}

void Player::preview(int doll, std::span<const RigidTransform> worldFromBody) {
    std::vector<RigidTransform> frame;
    for (int other = 0; other < simulation_->dollCount(); ++other) {
        if (other == doll) {
            frame.insert(frame.end(), worldFromBody.begin(), worldFromBody.end());
            continue;
        }
        for (const physics::BodyState& body : bodiesOf(other))
            frame.push_back(body.worldFromBody);
    }
    for (const physics::PropId prop : simulation_->world().props())
        frame.push_back(simulation_->world().propState(prop).worldFromBody);
    simulation_->preview(frame);
}

Result<void> Player::throwBall(const vec3& from, const vec3& velocity) {
    physics::DynamicProp ball = ballAt(from);
    ball.state.linearVelocity = velocity;
    if (thrown_.size() >= kMaxThrown) return Error{ErrorCode::usage, "enough balls are in play: reset first", "", ""};
    thrown_.push_back(ball);
    somethingMoved();
    return rebuild(Keep::motion);
}

void Player::startRecording() {
    endReplay();
    endClip(true);
    deck_.start(*simulation_);
}

// Balls that a reset took away are in play again while their take is shown.
Result<void> Player::replay() {
    endReplay();
    endClip(true);
    const int take = deck_.current();
    const std::size_t wanted = take < 0 ? 0 : deck_.takes()[static_cast<std::size_t>(take)].cast.thrown;
    if (wanted > thrown_.size()) {
        const std::size_t missing = wanted - thrown_.size();
        thrown_.resize(wanted, ballAt(vec3(0, -1.0F, 0)));
        deck_.stop("it is shown now");
        if (auto rebuilt = rebuild(Keep::motion); !rebuilt) return rebuilt;
        thrownForReplay_ = missing;
    }
    auto shown = deck_.replay(*simulation_);
    if (shown) playing_ = true;
    if (!shown) takeReplayBallsAway();
    return shown;
}

void Player::takeReplayBallsAway() {
    if (thrownForReplay_ == 0) return;
    [[maybe_unused]] const bool rebuilt = rebuild(Keep::motion).ok();
    LUTKA_ASSERT(rebuilt);  // the document is as it was
}

void Player::endReplay() {
    if (!deck_.replaying()) return;
    deck_.endReplay(*simulation_);
    playing_ = false;
    loop_.restart();
    simulation_->refresh();
    takeReplayBallsAway();
}

void Player::advanceReplay(double seconds) {
    if (!playing_) return;
    if (deck_.atEnd()) {
        playing_ = false;
        return;
    }
    scrubTo(deck_.position() + std::min(seconds, 0.1) * speed_);
}

Result<void> Player::openRecording(const std::filesystem::path& file) {
    endReplay();
    endClip(true);
    auto shown = deck_.open(file, *simulation_);
    if (shown) playing_ = true;
    return shown;
}

}  // namespace lutka::editor
