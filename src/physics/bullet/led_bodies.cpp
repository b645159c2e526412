#include "physics/bullet/led_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "physics/bullet/convert.hpp"
#include "physics/collision/shape.hpp"

namespace lutka::physics {
namespace {

constexpr float kHeavy = 200.0F;  // of a kinematic body, over its doll's mass

}  // namespace

LedBodies::LedBodies(std::vector<btRigidBody*> bodies, const RagdollProfile& profile, std::vector<vec3> inertia,
                     const vec3& gravity)
    : bodies_(std::move(bodies)),
      profile_(profile),
      inertia_(std::move(inertia)),
      gravity_(gravity),
      linearDamping_(bodies_.front()->getLinearDamping()),
      angularDamping_(bodies_.front()->getAngularDamping()),
      targets_(bodies_.size()),
      led_(bodies_.size()),
      turned_(bodies_.size()) {
    for (const BodyProfile& body : profile.bodies) {
        heavyKg_ += kHeavy * body.massKg;
        const BodyShape& shape = body.shape;
        const float half = shape.isAngular() ? boundingRadius(static_cast<const PrimitiveShape&>(shape))
                                             : shape.radius + shape.halfLength;
        reach_ = std::max({reach_, half, shape.more.empty() ? 0.0F : boundingRadius(shape)});
    }
}

void LedBodies::weigh(int body, bool heavy) {
    btRigidBody& made = *bodies_[body];
    const vec3 inertia = heavy ? vec3(heavyKg_ * reach_ * reach_) : inertia_[body];
    made.setMassProps(heavy ? heavyKg_ : profile_.bodies[body].massKg, toBullet(inertia));
    made.setGravity(toBullet(heavy ? vec3(0) : gravity_));
    made.setDamping(heavy ? 0.0F : linearDamping_, heavy ? 0.0F : angularDamping_);
    const int others = made.getFlags() & ~BT_DISABLE_WORLD_GRAVITY;
    made.setFlags(heavy ? others | BT_DISABLE_WORLD_GRAVITY : others);
    made.updateInertiaTensor();
}

bool LedBodies::set(int body, const std::optional<BodyTarget>& target) {
    const bool was = isKinematic(body);
    count_ += (target ? 1 : 0) - (targets_[body] ? 1 : 0);
    targets_[body] = target;
    if (isKinematic(body) == was) return false;
    weigh(body, !was);
    return true;
}

void LedBodies::lead(float seconds, float remaining) {
    given_ = 0.0;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        if (!targets_[i]) continue;
        const BodyTarget& target = *targets_[i];
        btRigidBody& body = *bodies_[i];
        const bool kinematic = target.weight >= 1.0F;
        const float omega = kinematic ? 0.0F : 2.0F * kPi * frequencyOf(target.weight);
        const float answer = seconds * omega * (seconds * omega + 2.0F);
        const float share = kinematic ? 1.0F : answer / (1.0F + answer);
        const float pull = kinematic ? 1.0F / seconds : omega / (seconds * omega + 2.0F);
        const RigidTransform at = fromBullet(body.getWorldTransform());
        const vec3 ahead = at.translation - target.worldFromBody.translation + target.linearVelocity * remaining;
        const vec3 turned =
            rotationVector(glm::normalize(at.rotation * glm::conjugate(target.worldFromBody.rotation))) +
            target.angularVelocity * remaining;
        const vec3 before = fromBullet(body.getLinearVelocity());
        const vec3 turnBefore = fromBullet(body.getAngularVelocity());
        const vec3 gain = (target.linearVelocity - ahead * pull - before) * share;
        const vec3 turnGain = (target.angularVelocity - turned * pull - turnBefore) * share;
        led_[i] = toBullet(before + gain);
        turned_[i] = toBullet(turnBefore + turnGain);
        body.setLinearVelocity(led_[i]);
        body.setAngularVelocity(turned_[i]);
        if (kinematic) continue;
        const vec3 inBody = glm::conjugate(at.rotation) * turnGain;
        const vec3 mean = glm::conjugate(at.rotation) * (turnBefore + 0.5F * turnGain);
        given_ += static_cast<double>(profile_.bodies[i].massKg * glm::dot(gain, before + 0.5F * gain) +
                                      glm::dot(inertia_[i] * inBody, mean));
    }
}

double LedBodies::work() const {
    double work = given_;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        if (!isKinematic(static_cast<int>(i))) continue;
        // What others changed of it, it has set against.
        const btVector3 change = bodies_[i]->getLinearVelocity() - led_[i];
        const btVector3 turnChange = bodies_[i]->getAngularVelocity() - turned_[i];
        work -= static_cast<double>(heavyKg_ * change.dot(led_[i] + 0.5F * change) +
                                    heavyKg_ * reach_ * reach_ * turnChange.dot(turned_[i] + 0.5F * turnChange));
    }
    return std::isfinite(work) ? work : 0.0;
}

}  // namespace lutka::physics
