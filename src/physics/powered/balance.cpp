#include "physics/powered/balance.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <tuple>
#include <utility>

#include "physics/collision/shape.hpp"

namespace lutka::physics {
namespace {

constexpr float kGain = 2.5F;  // times the capture point's distance from home that it presses beyond it
// Of what a foot reaches between its caps' centres that it presses within: it rolls on a cap before it tips.
constexpr float kFootShare = 1.2F;
constexpr float kWidthShare = 0.8F;  // of the way between the feet, likewise
constexpr float kLeastHeightM = 0.05F;
constexpr float kLeastLoad = 0.1F;
constexpr float kFlat = 0.8F;  // cosine of the steepest foot that stands

constexpr float kHomeM = 0.03F;      // no farther from where the doll is does home go on,
constexpr float kHomeSpeed = 0.1F;   // nor faster, m/s
constexpr float kStill = 0.08F;      // m/s: faster it does not bow,
constexpr float kNearHomeM = 0.01F;  // nor nearer to home
constexpr float kBowPerM = 4.0F;     // radians a second
constexpr float kUnbow = 0.2F;       // 1/s
constexpr float kMostBow = 0.25F;    // radians

constexpr float kLeanPerM = 3.0F;  // radians of lean a metre that the feet do not reach
constexpr float kMostLean = 0.4F;  // radians
constexpr float kLeanHz = 2.0F;
constexpr float kBackHz = 0.5F;
constexpr float kHipShare = 0.3F;  // of the lean; the trunk has the rest
constexpr float kArmShare = 3.0F;

const vec3 kUp(0, 1, 0);

vec3 level(const vec3& v) {
    return {v.x, 0.0F, v.z};
}

// The way along which a shape lies longest, and how far it presses on the ground along it: as far as its caps' centres.
std::pair<vec3, float> lengthOf(const PrimitiveShape& shape) {
    if (shape.kind == PrimitiveShape::Kind::capsule) return {{0, 1, 0}, shape.halfLength};
    if (shape.kind == PrimitiveShape::Kind::sphere) return {{0, 1, 0}, 0.0F};
    const vec3 half = halfBox(shape);
    const float most = std::max({half.x, half.y, half.z});
    return {half.x == most ? vec3(1, 0, 0) : half.y == most ? vec3(0, 1, 0) : vec3(0, 0, 1), most};
}

}  // namespace

Balance::Balance(const RagdollProfile& profile) : profile_(profile) {
    for (const BodyProfile& body : profile.bodies)
        massKg_ += body.massKg;
    constexpr std::array<Role, 2> kFeet{Role::leftFoot, Role::rightFoot};
    for (std::size_t side = 0; side < kFeet.size(); ++side) {
        Foot& foot = feet_[side];
        foot.body = bodyOf(profile, kFeet[side]);
        if (foot.body >= 0) std::tie(foot.along, foot.half) = lengthOf(profile.bodies[foot.body].shape);
        // constraints[i].child == i + 1
        for (int body = foot.body; body > 0; body = profile.constraints[body - 1].parent)
            if (const auto role = profile.bodies[body].role; role && !animation::isSpine(*role))
                foot.leg.push_back(body - 1);
    }
    for (int i = 0; i < static_cast<int>(profile.constraints.size()); ++i) {
        const auto role = profile.bodies[profile.constraints[i].child].role;
        if (!role) continue;
        if (animation::isSpine(*role)) trunk_.push_back(i);
        if (role == Role::leftUpperArm || role == Role::rightUpperArm) arms_.push_back(i);
    }
    stance_.share.resize(profile.constraints.size());
    stance_.axis.resize(profile.constraints.size());
    stance_.torque.resize(profile.constraints.size());
    stance_.turn.resize(profile.constraints.size());
}

void Balance::findFeet(std::span<const BodyState> bodies, const std::array<bool, 2>& grounded) {
    for (std::size_t side = 0; side < feet_.size(); ++side) {
        Foot& foot = feet_[side];
        foot.stands = foot.body >= 0 && grounded[side] && !foot.leg.empty();
        foot.load = 0.0F;
        if (!foot.stands) continue;
        const RigidTransform& at = bodies[foot.body].worldFromBody;
        foot.middle = at.translation;
        const vec3 way = level(at.rotation * foot.along);
        foot.heading = glm::length(way) > kFlat ? glm::normalize(way) : vec3(0);
    }
}

// How much of the weight each foot carries when it presses at `pressed` in all.
void Balance::shareLoad(const vec3& pressed) {
    const bool both = feet_[0].stands && feet_[1].stands;
    if (!both) {
        for (Foot& foot : feet_)
            foot.load = foot.stands ? 1.0F : 0.0F;
        return;
    }
    const vec3 across = level(feet_[1].middle - feet_[0].middle);
    const float square = std::max(glm::dot(across, across), 1e-6F);
    const float second = glm::dot(level(pressed - feet_[0].middle), across) / square;
    feet_[1].load = std::clamp(second, kLeastLoad, 1.0F - kLeastLoad);
    feet_[0].load = 1.0F - feet_[1].load;
}

// Ankles: each foot presses where the whole does, as far as it reaches.
void Balance::press(std::span<const BodyState> bodies, const vec3& pressed, float weight) {
    for (const Foot& foot : feet_) {
        if (!foot.stands || foot.heading == vec3(0)) continue;
        const int joint = foot.leg.front();
        const ConstraintProfile& ankle = profile_.constraints[joint];
        const vec3 at = bodies[ankle.child].worldFromBody * ankle.childFromFrame.translation - foot.middle;
        const float reach = kFootShare * foot.half;
        const float lever = std::clamp(glm::dot(pressed, foot.heading), -reach, reach) - glm::dot(at, foot.heading);
        stance_.axis[joint] = glm::cross(kUp, foot.heading);
        stance_.torque[joint] = weight * foot.load * lever;
    }
}

// The mean way of the feet that stand; 0: they have none.
vec3 Balance::headingOfFeet() const {
    vec3 sum(0);
    for (const Foot& foot : feet_)
        if (foot.stands) sum += glm::dot(foot.heading, sum) < 0.0F ? -foot.heading : foot.heading;
    return glm::length(sum) > 1e-3F ? glm::normalize(sum) : vec3(0);
}

// How much farther out it would have to press than its feet reach, level.
vec3 Balance::beyondFeet(const vec3& pressed) const {
    const vec3 heading = headingOfFeet();
    if (heading == vec3(0)) return vec3(0);
    float half = 0.0F;
    float width = 0.0F;
    for (const Foot& foot : feet_)
        if (foot.stands) half = std::max(half, foot.half);
    const vec3 side = glm::cross(kUp, heading);
    if (feet_[0].stands && feet_[1].stands) width = 0.5F * std::abs(glm::dot(feet_[1].middle - feet_[0].middle, side));
    const auto past = [](float value, float bound) { return value - std::clamp(value, -bound, bound); };
    return heading * past(glm::dot(pressed, heading), kFootShare * half) +
           side * past(glm::dot(pressed, side), kWidthShare * width);
}

// Hips, trunk and arms. Quickly out of the pose and slowly back into it.
void Balance::lean(const vec3& beyond, float dt) {
    vec3 wanted = kLeanPerM * glm::cross(kUp, beyond);
    if (const float angle = glm::length(wanted); angle > kMostLean) wanted *= kMostLean / angle;
    const bool grows = glm::dot(wanted, wanted) > glm::dot(lean_, lean_);
    const float omega = 2.0F * kPi * (grows ? kLeanHz : kBackHz);
    // A critically damped spring, at the end of the step.
    leanRate_ =
        (leanRate_ + dt * omega * omega * (wanted - lean_)) / (1.0F + 2.0F * dt * omega + dt * dt * omega * omega);
    lean_ += dt * leanRate_;
    for (const Foot& foot : feet_)
        if (!foot.leg.empty()) stance_.turn[foot.leg.back()] = -kHipShare * lean_;
    for (const int joint : trunk_)
        stance_.turn[joint] = (1.0F - kHipShare) / static_cast<float>(trunk_.size()) * lean_;
    for (const int joint : arms_)
        stance_.turn[joint] = kArmShare * lean_;
}

// The doll is brought to rest over the middle of its feet. It comes there from where its pose has it, as far as its
// ankles let it: they may be at their limits.
void Balance::drawHome(float ahead, float dt) {
    if (!isHome_) home_ = ahead;
    isHome_ = true;
    if (std::abs(ahead - home_) < kHomeM) home_ -= std::clamp(home_, -dt * kHomeSpeed, dt * kHomeSpeed);
}

// What the ankles do not bring about the hips do, where the doll stands still: it bows.
void Balance::bow(float ahead, float speed, float dt) {
    const float off = ahead - home_;
    if (std::abs(speed) > kStill || std::abs(off) > 2.0F * kHomeM) return;
    const float stuck = off - std::clamp(off, -kNearHomeM, kNearHomeM);
    bow_ = std::clamp(bow_ - dt * (kBowPerM * stuck + kUnbow * bow_), -kMostBow, kMostBow);
}

const Stance* Balance::stanceOf(std::span<const BodyState> bodies, const std::array<bool, 2>& grounded, float gravity,
                                float dt) {
    std::fill(stance_.share.begin(), stance_.share.end(), 0.0F);
    std::fill(stance_.axis.begin(), stance_.axis.end(), vec3(0));
    std::fill(stance_.torque.begin(), stance_.torque.end(), 0.0F);
    std::fill(stance_.turn.begin(), stance_.turn.end(), vec3(0));
    findFeet(bodies, grounded);
    const auto count =
        static_cast<float>(std::count_if(feet_.begin(), feet_.end(), [](const Foot& f) { return f.stands; }));
    if (count == 0.0F || massKg_ <= 0.0F) {
        lean_ = leanRate_ = vec3(0);
        isHome_ = false;
        bow_ = 0.0F;
        return nullptr;
    }
    vec3 centre(0);
    vec3 velocity(0);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const float share = profile_.bodies[i].massKg / massKg_;
        centre += share * bodies[i].worldFromBody.translation;
        velocity += share * bodies[i].linearVelocity;
    }
    vec3 home(0);
    for (const Foot& foot : feet_)
        if (foot.stands) home += foot.middle / count;
    const float height = std::max(centre.y - home.y, kLeastHeightM);
    const vec3 heading = headingOfFeet();
    drawHome(glm::dot(centre - home, heading), dt);
    bow(glm::dot(centre - home, heading), glm::dot(velocity, heading), dt);
    const vec3 capture = level(centre - home) + level(velocity) * std::sqrt(height / gravity);
    const vec3 pressed = capture + kGain * (capture - home_ * heading);
    shareLoad(home + pressed);
    for (const Foot& foot : feet_)
        if (foot.stands)
            for (const int joint : foot.leg)
                stance_.share[joint] = 1.0F / count;
    press(bodies, pressed, massKg_ * gravity);
    vec3 beyond = beyondFeet(pressed);
    if (glm::dot(beyond, velocity) <= 0.0F) beyond = vec3(0);
    lean(beyond, dt);
    for (const Foot& foot : feet_)
        if (!foot.leg.empty()) stance_.turn[foot.leg.back()] -= bow_ * glm::cross(kUp, heading);
    return &stance_;
}

}  // namespace lutka::physics
