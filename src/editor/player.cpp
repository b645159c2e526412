#include "editor/player.hpp"

#include <algorithm>

#include "scene/scenario.hpp"

namespace lutka::editor {
namespace {

constexpr float kBallRadius = 0.09F;  // metres; with the mass, a medicine ball
constexpr float kBallMassKg = 5.0F;
constexpr float kPosingDamping = 0.75F;  // of the velocity that a step leaves while posing
constexpr std::size_t kMaxThrown = 24;   // each makes every step slower

physics::StaticShape staticOf(const SceneObject& object) {
    physics::StaticShape shape;
    shape.kind = physics::StaticShape::Kind::box;
    shape.worldFromShape = object.worldFromObject;
    shape.halfExtents = object.halfExtents;
    return shape;
}

physics::DynamicProp propOf(const SceneObject& object) {
    physics::DynamicProp prop;
    prop.shape.kind = physics::BodyShape::Kind::sphere;
    prop.shape.radius = object.radius;
    prop.massKg = object.massKg;
    prop.state.worldFromBody = object.worldFromObject;
    return prop;
}

std::vector<SceneObject> ballsOf(std::span<const SceneObject> objects) {
    std::vector<SceneObject> balls;
    std::copy_if(objects.begin(), objects.end(), std::back_inserter(balls),
                 [](const SceneObject& object) { return object.kind == SceneObject::Kind::ball; });
    return balls;
}

// Whether every body is the same part of the same joint, so that its state can go on bit for bit.
bool sameFrames(std::span<const physics::BodyProfile> a, std::span<const physics::BodyProfile> b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const physics::BodyProfile& x, const physics::BodyProfile& y) {
                          return x.role == y.role && x.jointPath == y.jointPath &&
                                 x.jointFromBody.rotation == y.jointFromBody.rotation &&
                                 x.jointFromBody.translation == y.jointFromBody.translation;
                      });
}

}  // namespace

/// What moves, with the joints and the roles it belongs to, so that it survives a change of the ragdoll.
struct Player::Motion {
    struct Doll {
        std::vector<physics::BodyState> bodies;
        std::vector<RigidTransform> modelFromJoint;
        RigidTransform worldFromModel;
    };
    std::vector<physics::BodyProfile> bodies;  // as they were
    std::vector<Doll> dolls;
    std::vector<physics::BodyState> props;
    std::size_t ownProps = 0;  // the scenario's
};

Player::Motion Player::capture() const {
    Motion motion;
    scene::Simulation& simulation = *simulation_;
    const scene::RagdollAsset& asset = simulation.asset();
    motion.bodies = asset.profile.bodies;
    for (int doll = 0; doll < simulation.dollCount(); ++doll) {
        Motion::Doll& one = motion.dolls.emplace_back();
        one.bodies.resize(asset.profile.bodies.size());
        one.modelFromJoint.resize(asset.character.skeleton.parents.size());
        one.worldFromModel = simulation.worldFromModel(doll);
        simulation.world().getBodies(doll, one.bodies);
        simulation.pose(doll, 1.0F, one.modelFromJoint);
    }
    for (int prop = 0; prop < simulation.world().propCount(); ++prop)
        motion.props.push_back(simulation.world().propState(prop));
    motion.ownProps = static_cast<std::size_t>(firstBall_);
    return motion;
}

void Player::restore(const Motion& motion) {
    scene::Simulation& simulation = *simulation_;
    const bool same = sameFrames(motion.bodies, simulation.asset().profile.bodies);
    std::vector<physics::BodyState> bodies(simulation.asset().profile.bodies.size());
    const int dolls = std::min(simulation.dollCount(), static_cast<int>(motion.dolls.size()));
    for (int doll = 0; doll < dolls; ++doll) {
        const Motion::Doll& was = motion.dolls[doll];
        if (!same) placeByJoints(motion.bodies, was.bodies, was.modelFromJoint, was.worldFromModel, bodies);
        simulation.world().setBodies(doll, same ? was.bodies : bodies);
    }
    simulation.refresh();
}

// Other bodies than before: the skin stays where it is, and each body goes on with its role's velocity.
void Player::placeByJoints(std::span<const physics::BodyProfile> oldBodies,
                           std::span<const physics::BodyState> oldStates,
                           std::span<const RigidTransform> modelFromJoint, const RigidTransform& worldFromModel,
                           std::span<physics::BodyState> bodies) const {
    const scene::RagdollAsset& asset = simulation_->asset();
    physics::bodiesFromPose(asset.rig, modelFromJoint, worldFromModel, bodies);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const auto old = std::find_if(oldBodies.begin(), oldBodies.end(), [&](const physics::BodyProfile& body) {
            return body.role == asset.profile.bodies[i].role;
        });
        if (old == oldBodies.end()) continue;
        const physics::BodyState& state = oldStates[old - oldBodies.begin()];
        bodies[i].linearVelocity = state.linearVelocity;
        bodies[i].angularVelocity = state.angularVelocity;
    }
}

Result<scene::Scenario> Player::makeScenario() {
    const scene::RagdollAsset& asset = document_.asset();
    const SceneSettings& settings = document_.state().scene;
    auto scenario = scene::makeScenario(settings.scenario, settings.count, settings.seed,
                                        scene::figureBounds(asset.profile, asset.rig), asset.profile.standardFromModel);
    if (!scenario) return scenario.error();
    firstBall_ = static_cast<int>(scenario.value().props.size());
    for (const SceneObject& object : settings.objects) {
        if (object.kind == SceneObject::Kind::box) scenario.value().statics.push_back(staticOf(object));
        if (object.kind == SceneObject::Kind::ball) scenario.value().props.push_back(propOf(object));
    }
    auto& props = scenario.value().props;
    props.insert(props.end(), thrown_.begin(), thrown_.end());
    return scenario;
}

// Props go on where they are. A ball that the user moved since, or that is new, starts where the document has it.
void Player::keepProps(const Motion& motion, scene::Scenario& scenario) const {
    const auto own = static_cast<std::size_t>(firstBall_);
    if (own == motion.ownProps) {
        for (std::size_t i = 0; i < own; ++i)
            scenario.props[i].state = motion.props[i];
    }
    const std::vector<SceneObject> before = ballsOf(built_);
    const std::vector<SceneObject> now = ballsOf(document_.state().scene.objects);
    for (std::size_t i = 0; i < std::min(before.size(), now.size()); ++i) {
        const bool moved = before[i].worldFromObject.translation != now[i].worldFromObject.translation;
        if (!moved) scenario.props[own + i].state = motion.props[motion.ownProps + i];
    }
    const std::size_t firstOld = motion.ownProps + before.size();
    const std::size_t firstNew = own + now.size();
    for (std::size_t i = 0; firstOld + i < motion.props.size() && firstNew + i < scenario.props.size(); ++i)
        scenario.props[firstNew + i].state = motion.props[firstOld + i];
}

Result<void> Player::rebuild(Keep keep) {
    if (keep == Keep::nothing) {
        thrown_.clear();
        posing_ = false;
        secondsBefore_ = 0.0;
    } else if (simulation_ != nullptr) {
        secondsBefore_ = seconds();
    }
    std::optional<Motion> motion;
    if (keep == Keep::motion && simulation_ != nullptr) motion = capture();
    simulation_.reset();  // it borrows the asset that changes now
    document_.commitAsset();
    revision_ = document_.revision();
    auto scenario = makeScenario();
    if (!scenario) return scenario.error();
    if (motion) keepProps(*motion, scenario.value());
    built_ = document_.state().scene.objects;
    scene::SimulationOptions options;
    options.world = document_.state().scene.world;
    if (posing_) {
        options.world.gravity = vec3(0);
        options.world.sleeping = false;
    }
    options.pose = document_.state().scene.pose;
    auto simulation = scene::Simulation::create(document_.asset(), std::move(scenario).value(), options);
    if (!simulation) return simulation.error();
    simulation_ = std::move(simulation).value();
    if (motion) restore(*motion);
    loop_.restart();
    return {};
}

void Player::dampDolls(float share) {
    for (int doll = 0; doll < simulation_->dollCount(); ++doll) {
        auto bodies = bodiesOf(doll);
        for (physics::BodyState& body : bodies) {
            body.linearVelocity *= share;
            body.angularVelocity *= share;
        }
        simulation_->world().setBodies(doll, bodies);
    }
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

void Player::advance(double seconds) {
    if (!playing_ && !posing_) return;
    loop_.setSpeed(posing_ ? 1.0 : speed_);
    loop_.advance(seconds, [&] {
        simulation_->step();
        if (posing_) dampDolls(kPosingDamping);
    });
}

void Player::stepOnce() {
    playing_ = false;
    loop_.restart();
    simulation_->step();
}

Result<void> Player::reset() {
    return rebuild(Keep::nothing);
}

RigidTransform Player::worldFromObject(int object) const {
    const SceneObject& one = document_.state().scene.objects[object];
    if (one.kind != SceneObject::Kind::ball || stale()) return one.worldFromObject;
    const auto before = std::span(built_).first(static_cast<std::size_t>(object));
    return simulation_->worldFromProp(firstBall_ + static_cast<int>(ballsOf(before).size()), alpha());
}

std::vector<SceneObject> Player::presentObjects() const {
    std::vector<SceneObject> objects = document_.state().scene.objects;
    for (std::size_t i = 0; i < objects.size(); ++i)
        objects[i].worldFromObject = worldFromObject(static_cast<int>(i));
    return objects;
}

std::vector<physics::BodyState> Player::bodiesOf(int doll) const {
    std::vector<physics::BodyState> bodies(simulation_->asset().profile.bodies.size());
    simulation_->world().getBodies(doll, bodies);
    return bodies;
}

void Player::placeBodies(int doll, std::span<const physics::BodyState> bodies) {
    simulation_->world().setBodies(doll, bodies);
    simulation_->refresh();
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
    for (int prop = 0; prop < simulation_->world().propCount(); ++prop)
        frame.push_back(simulation_->world().propState(prop).worldFromBody);
    simulation_->preview(frame);
}

Result<void> Player::throwBall(const vec3& from, const vec3& velocity) {
    physics::DynamicProp ball;
    ball.shape.kind = physics::BodyShape::Kind::sphere;
    ball.shape.radius = kBallRadius;
    ball.massKg = kBallMassKg;
    ball.state.worldFromBody.translation = from;
    ball.state.linearVelocity = velocity;
    if (thrown_.size() >= kMaxThrown) return Error{ErrorCode::usage, "enough balls are in play: reset first", "", ""};
    thrown_.push_back(ball);
    return rebuild(Keep::motion);
}

}  // namespace lutka::editor
