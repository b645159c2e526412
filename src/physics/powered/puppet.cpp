#include "physics/powered/puppet.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <utility>

namespace lutka::physics {
namespace {

constexpr float kUnfelt = 0.01F;  // of the strength: what is still lost then is not felt
// On the way up again after it failed: a root that is turned farther from its pose is pulled at more than the usual
// reach,
constexpr float kBehind = radians(25.0F);
constexpr float kFarBehind = radians(40.0F);  // one that is so far at
constexpr float kMostReach = 0.25F;           // of the doll's height.

float eased(float t) {
    const float clamped = std::clamp(t, 0.0F, 1.0F);
    return clamped * clamped * (3.0F - 2.0F * clamped);
}

// How many joints lie between any two bodies: constraints come parents before children, so a child is one joint farther
// from all bodies that came before it than its parent is.
std::vector<std::vector<int>> distancesOf(const RagdollProfile& profile, int root) {
    const std::size_t count = profile.bodies.size();
    std::vector<std::vector<int>> distance(count, std::vector<int>(count, 0));
    std::vector<int> known{root};
    for (const ConstraintProfile& constraint : profile.constraints) {
        for (const int other : known) {
            distance[constraint.child][other] = distance[constraint.parent][other] + 1;
            distance[other][constraint.child] = distance[constraint.child][other];
        }
        known.push_back(constraint.child);
    }
    return distance;
}

int rootOf(const RagdollProfile& profile) {
    std::vector<bool> isChild(profile.bodies.size(), false);
    for (const ConstraintProfile& constraint : profile.constraints)
        isChild[constraint.child] = true;
    const auto at = std::find(isChild.begin(), isChild.end(), false);
    return at == isChild.end() ? 0 : static_cast<int>(at - isChild.begin());
}

}  // namespace

std::string_view puppetStateName(PuppetState state) {
    constexpr std::array<std::string_view, 4> names{"animated", "reacting", "limp", "gettingUp"};
    return names[static_cast<std::size_t>(state)];
}

Puppet::Puppet(World& world, DollId doll, const RagdollProfile& profile, int root, std::span<const BodyState> bodies,
               const PuppetSettings& settings)
    : world_(world),
      doll_(doll),
      profile_(profile),
      root_(root),
      settings_(settings),
      drive_(profile, bodies),
      balance_(profile),
      pins_(profile.bodies.size()),
      holds_(profile.bodies.size()),
      weights_(settings.led.empty() ? std::vector<float>(profile.bodies.size(), 0.0F) : settings.led),
      isThere_(profile.bodies.size(), true),
      losses_(profile.bodies.size()),
      distance_(distancesOf(profile, rootOf(profile))),
      factors_(profile.bodies.size(), 1.0F),
      bodies_(bodies.begin(), bodies.end()) {}

void Puppet::change(PuppetState state) {
    if (state == state_) return;
    const PuppetState before = std::exchange(state_, state);
    if (state == PuppetState::animated) failedToRise_ = false;
    if (before == PuppetState::gettingUp && state == PuppetState::limp) failedToRise_ = true;
    if (state == PuppetState::limp) {
        drive_.release(world_, doll_);
        letGo();
    }
    if (listener_) listener_(before, state);
}

float Puppet::lossOf(int body) const {
    const Loss& loss = losses_[body];
    if (loss.amount <= 0.0F || loss.seconds >= settings_.recoverySeconds) return 0.0F;
    const float over = loss.seconds / settings_.recoverySeconds;
    return loss.amount * (1.0F - eased(over));
}

float Puppet::strengthLeft(int body) const {
    return state_ == PuppetState::limp ? 0.0F : back_ * (1.0F - lossOf(body));
}

void Puppet::hit(int body, const vec3& point, const vec3& impulse) {
    world_.applyImpulse(doll_, body, impulse, point);
    feel(body, glm::length(impulse));
}

void Puppet::feel(int body, float impulse) {
    if (state_ == PuppetState::limp) return;
    const float speed = impulse / profile_.bodies[body].massKg;
    const float lost = 1.0F - std::exp(-speed / settings_.hitSpeed);
    for (std::size_t other = 0; other < losses_.size(); ++other) {
        const float share = lost * std::pow(settings_.falloff, static_cast<float>(distance_[body][other]));
        losses_[other] = {1.0F - (1.0F - lossOf(static_cast<int>(other))) * (1.0F - share), 0.0F};
    }
    if (state_ == PuppetState::animated) change(PuppetState::reacting);
}

void Puppet::goLimp() {
    change(PuppetState::limp);
}

void Puppet::beginReturn(float seconds, bool standsByItself) {
    if (state_ != PuppetState::limp) return;
    std::fill(losses_.begin(), losses_.end(), Loss{});
    back_ = 0.0F;
    backSeconds_ = std::max(seconds, 1e-3F);
    standsByItself_ = standsByItself;
    change(PuppetState::gettingUp);
}

void Puppet::comeBack(float seconds) {
    beginReturn(seconds, true);
}

void Puppet::getUp(float seconds) {
    beginReturn(seconds, false);
}

void Puppet::stand() {
    if (state_ != PuppetState::gettingUp) return;
    back_ = 1.0F;
    change(PuppetState::reacting);
}

void Puppet::hold(int body, const RigidTransform& worldFromBody, float forceN) {
    holds_[body] = {worldFromBody, forceN};
}

void Puppet::approach() {
    isThere_.assign(isThere_.size(), false);
}

void Puppet::recover(float dt) {
    for (Loss& loss : losses_)
        loss.seconds += dt;
    if (state_ == PuppetState::gettingUp) {
        back_ = std::min(back_ + dt / backSeconds_, 1.0F);
        if (back_ >= 1.0F && standsByItself_) change(PuppetState::reacting);
    }
    if (state_ != PuppetState::reacting) return;
    float most = 0.0F;
    for (int body = 0; body < static_cast<int>(losses_.size()); ++body)
        most = std::max(most, lossOf(body));
    if (most <= kUnfelt) change(PuppetState::animated);
}

bool Puppet::isTooMuch(std::span<const RigidTransform> pose) {
    world_.getBodies(doll_, bodies_);
    float lost = 0.0F;
    float weight = 0.0F;
    for (int i = 0; i < static_cast<int>(profile_.constraints.size()); ++i) {
        lost += drive_.inertiaOf(i) * lossOf(profile_.constraints[i].child);
        weight += drive_.inertiaOf(i);
    }
    if (weight > 0.0F && lost > settings_.knockOutLoss * weight) return true;
    const quat off = bodies_[root_].worldFromBody.rotation * glm::conjugate(pose[root_].rotation);
    const bool comesFromAfar = state_ == PuppetState::gettingUp && standsByItself_;
    return !comesFromAfar && glm::length(rotationVector(glm::normalize(off))) > settings_.knockOutTilt;
}

// Bodies that are led themselves. On the way to its feet none is: the pose comes to the doll then.
void Puppet::lead(std::span<const RigidTransform> from, std::span<const RigidTransform> to, float dt) {
    const bool getsUp = state_ == PuppetState::gettingUp && !standsByItself_;
    const float most = settings_.leadSeconds > 0.0F ? dt / settings_.leadSeconds : 1.0F;
    for (int body = 0; body < static_cast<int>(weights_.size()); ++body) {
        const float wanted = getsUp || settings_.led.empty() ? 0.0F : settings_.led[body];
        float& weight = weights_[body];
        const bool wasLed = weight > 0.0F;
        weight = std::min(wanted, weight + most);
        if (weight < wanted || !wasLed) isThere_[body] = false;
        if (weight <= 0.0F) {
            if (wasLed) world_.setBodyTarget(doll_, body, std::nullopt);
            continue;
        }
        BodyTarget target;
        target.worldFromBody = to[body];
        target.linearVelocity = (to[body].translation - from[body].translation) / dt;
        target.angularVelocity =
            rotationVector(glm::normalize(to[body].rotation * glm::conjugate(from[body].rotation))) / dt;
        target.weight = weight;
        if (!isThere_[body]) draw(body, target);
        weight = target.weight;
        world_.setBodyTarget(doll_, body, target);
    }
}

// A body on its way to its pose is drawn no faster than it may be, and is not kinematic before it is near.
void Puppet::draw(int body, BodyTarget& target) {
    constexpr float kNearlyKinematic = 0.95F;
    constexpr float kNearM = 0.002F;
    constexpr float kNearTurn = radians(0.5F);
    // bodies_ are those of now: isTooMuch() has asked for them.
    const RigidTransform& at = bodies_[body].worldFromBody;
    const vec3 way = target.worldFromBody.translation - at.translation;
    const vec3 turn = rotationVector(glm::normalize(target.worldFromBody.rotation * glm::conjugate(at.rotation)));
    if (glm::length(way) < kNearM && glm::length(turn) < kNearTurn) {
        isThere_[body] = true;
        return;
    }
    target.weight = std::min(target.weight, kNearlyKinematic);
    // A critically damped spring comes to half its frequency times the distance.
    const float pull = kPi * frequencyOf(target.weight);
    const float share = std::min(1.0F, settings_.leadSpeed / std::max(pull * glm::length(way), 1e-6F));
    const float angle = glm::length(turn);
    const float turnShare = std::min(1.0F, settings_.leadTurn / std::max(pull * angle, 1e-6F));
    target.worldFromBody.translation = at.translation + way * share;
    if (angle > 1e-6F)
        target.worldFromBody.rotation = glm::normalize(glm::angleAxis(angle * turnShare, turn / angle) * at.rotation);
}

// Pins: of the root, and of the bodies that settings name.
void Puppet::pull(std::span<const RigidTransform> from, std::span<const RigidTransform> to, float dt) {
    const bool getsUp = state_ == PuppetState::gettingUp && !standsByItself_;
    for (int body = 0; body < static_cast<int>(pins_.size()); ++body) {
        const auto at = static_cast<std::size_t>(body);
        float force = at < settings_.pins.size() && !getsUp ? settings_.pins[at] : 0.0F;
        if (body == root_) force = getsUp ? settings_.getUpForceN : settings_.pinForceN;
        const Hold hold = std::exchange(holds_[at], {});
        const bool holds = getsUp && body != root_ && hold.forceN > 0.0F;
        if (holds) force = hold.forceN;
        force *= strengthLeft(body);
        std::unique_ptr<BodyPin>& pin = pins_[at];
        if (force <= 0.0F || weights_[at] > 0.0F) {
            pin.reset();
            continue;
        }
        if (pin == nullptr) pin = std::make_unique<BodyPin>(world_, doll_, body);
        if (holds)
            pin->follow(hold.worldFromBody, hold.worldFromBody, dt, force);
        else
            pin->follow(from[at], to[at], dt, force, getsUp && failedToRise_ ? reachOf(from[at]) : BodyPin::kReachM);
    }
}

// How far from the root's centre it is pulled up: where it can't follow its pose, a heavy trunk on short limbs, from
// farther and farther, so that its pin turns it.
float Puppet::reachOf(const RigidTransform& pose) const {
    // bodies_ are those of now: isTooMuch() has asked for them.
    const quat off = bodies_[root_].worldFromBody.rotation * glm::conjugate(pose.rotation);
    const float behind = (glm::length(rotationVector(glm::normalize(off))) - kBehind) / (kFarBehind - kBehind);
    const float most = std::max(kMostReach * drive_.height(), BodyPin::kReachM);
    return BodyPin::kReachM + (most - BodyPin::kReachM) * std::clamp(behind, 0.0F, 1.0F);
}

// By a pin or a led body, to the pose itself.
bool Puppet::isHeld() const {
    if (settings_.pinForceN > 0.0F) return true;
    for (std::size_t body = 0; body < weights_.size(); ++body) {
        const bool isPinned =
            body < settings_.pins.size() && static_cast<int>(body) != root_ && settings_.pins[body] > 0.0F;
        if (isPinned || weights_[body] > 0.0F) return true;
    }
    return false;
}

void Puppet::letGo() {
    for (std::unique_ptr<BodyPin>& pin : pins_)
        pin.reset();
    for (int body = 0; body < static_cast<int>(weights_.size()); ++body)
        if (std::exchange(weights_[body], 0.0F) > 0.0F) world_.setBodyTarget(doll_, body, std::nullopt);
}

void Puppet::prepare(std::span<const RigidTransform> from, std::span<const RigidTransform> to, float dt) {
    if (state_ != PuppetState::limp && isTooMuch(from)) change(PuppetState::limp);
    if (state_ == PuppetState::limp) {
        isLeashed_ = false;
        return;
    }
    for (std::size_t body = 0; body < factors_.size(); ++body)
        factors_[body] = strengthLeft(static_cast<int>(body));
    const bool getsUp = state_ == PuppetState::gettingUp && !standsByItself_;
    // Once it stands a limb may still be behind: it comes along as gently.
    isLeashed_ = getsUp || (isLeashed_ && drive_.farthest() > settings_.getUpLead);
    drive_.setMostLead(isLeashed_ ? settings_.getUpLead : kPi);
    drive_.setMostSpeed(isLeashed_ ? settings_.getUpSpeed : PoseDrive::kUnbounded);
    drive_.setGoesByMiddle(getsUp);
    lead(from, to, dt);
    for (const ConstraintProfile& joint : profile_.constraints)
        if (weights_[joint.parent] >= 1.0F && weights_[joint.child] >= 1.0F) factors_[joint.child] = 0.0F;
    const bool standsFreely = settings_.balances && !getsUp && !isHeld();
    // bodies_ are those of now: isTooMuch() has asked for them.
    const Stance* stance = standsFreely ? balance_.stanceOf(bodies_, grounded_, settings_.gravity, dt) : nullptr;
    drive_.drive(world_, doll_, settings_.muscles, from, to, dt, factors_, stance);
    pull(from, to, dt);
    recover(dt);
}

}  // namespace lutka::physics
