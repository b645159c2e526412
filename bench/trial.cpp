#include "trial.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <glm/geometric.hpp>

#include "support/dolls.hpp"
#include "support/rigs.hpp"

namespace lutka::bench {
namespace {

constexpr float kDt = 1.0F / 60.0F;

// A program for developers: a wrong scene or profile ends it with a word.
template <class T>
T orExit(Result<T> result) {
    if (result.ok()) return std::move(result).value();
    std::fprintf(stderr, "%s\n", result.error().text().c_str());
    std::exit(static_cast<int>(result.error().code));
}

}  // namespace

std::unique_ptr<scene::RagdollAsset> handMadeDoll() {
    auto asset = std::make_unique<scene::RagdollAsset>();
    asset->character = test::makeBiped();
    asset->map = test::mapOfBiped(asset->character);
    asset->profile = test::makeDoll();
    asset->rig = orExit(physics::bindRig(asset->profile, asset->character.skeleton));
    return asset;
}

std::vector<physics::BodyState> placedBodies(const scene::RagdollAsset& asset, const scene::Placement& placement) {
    std::vector<physics::BodyState> bodies(asset.profile.bodies.size());
    physics::bodiesFromPose(asset.rig, asset.character.skeleton.bindModelFromJoint, placement.worldFromModel, bodies);
    vec3 centre(0);
    for (std::size_t i = 0; i < bodies.size(); ++i)
        centre += bodies[i].worldFromBody.translation * (asset.profile.bodies[i].massKg / asset.profile.totalMassKg);
    for (physics::BodyState& body : bodies) {
        const vec3 arm = body.worldFromBody.translation - centre;
        body.linearVelocity = placement.linearVelocity + glm::cross(placement.angularVelocity, arm);
        body.angularVelocity = placement.angularVelocity;
    }
    return bodies;
}

Trial::Trial(const scene::RagdollAsset& asset, const TrialSettings& settings)
    : settings_(settings),
      scenario_(
          orExit(scene::makeScenario({.name = settings.scene, .count = settings.count, .seed = settings.seed}, asset))),
      world_(physics::createBulletWorld(settings.world, settings.tuning)) {
    for (const physics::StaticShape& shape : scenario_.statics)
        world_->addStatic(shape);
    for (const physics::DynamicProp& prop : scenario_.props)
        world_->addProp(prop);
    for (const scene::Placement& placement : scenario_.dolls)
        world_->addDoll(asset.profile, placedBodies(asset, placement));
    for (const scene::Pin& pin : scenario_.pins) {
        const int body = physics::bodyNamed(asset.profile, pin.body);
        if (body < 0) continue;
        const RigidTransform worldFromBody = placedBodies(asset, scenario_.dolls[pin.doll])[body].worldFromBody;
        world_->addDrag({world_->dolls()[pin.doll], body, vec3(0), worldFromBody.translation, 5000.0F});
    }
    if (settings.measure)
        meter_ = std::make_unique<physics::QualityMeter>(*world_, scenario_.statics, settings.world.gravity);
    length_ = static_cast<int>((settings.seconds > 0 ? settings.seconds : scenario_.seconds + 2.0F) / kDt);
}

void Trial::step() {
    using Clock = std::chrono::steady_clock;
    Clock::duration measuring{0};
    const auto before = Clock::now();
    const double substep = static_cast<double>(kDt) / world_->substepsPerStep();
    if (meter_ != nullptr) {
        world_->step(kDt, [&] {
            const auto start = Clock::now();
            seconds_ += substep;
            meter_->sample(seconds_);
            measuring += Clock::now() - start;
        });
    } else {
        world_->step(kDt);
    }
    ms_ += std::chrono::duration<double, std::milli>(Clock::now() - before - measuring).count();
    ++steps_;
    if (settings_.measure) watchTurning();
}

void Trial::watchTurning() {
    if (turnBeforeSleep_) return;
    float fastest = 0;
    bool asleep = true;
    for (const physics::DollId doll : world_->dolls()) {
        std::vector<physics::BodyState> bodies(world_->profileOf(doll).bodies.size());
        world_->getBodies(doll, bodies);
        for (const physics::BodyState& body : bodies)
            fastest = std::max(fastest, glm::length(body.angularVelocity));
        asleep = asleep && world_->isAsleep(doll);
    }
    constexpr std::size_t kSecond = 60;
    if (asleep)
        turnBeforeSleep_ = *std::max_element(turning_.end() - std::min(turning_.size(), kSecond), turning_.end());
    turning_.push_back(fastest);
}

TrialResult Trial::result() const {
    TrialResult result;
    if (meter_ != nullptr) result.quality = meter_->result();
    result.settled = result.quality.settleSeconds && *result.quality.settleSeconds <= 6.0F;
    result.slept = turnBeforeSleep_.has_value();
    result.turnBeforeSleep = turnBeforeSleep_.value_or(0.0F);
    result.msPerStep = ms_ / std::max(steps_, 1);
    return result;
}

}  // namespace lutka::bench
