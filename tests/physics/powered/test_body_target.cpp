#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "physics/powered/puppet.hpp"
#include "physics/worlds/world_table.hpp"
#include "support/catch.hpp"
#include "support/dolls.hpp"

using namespace lutka;
using namespace lutka::test;
using physics::BodyState;
using physics::BodyTarget;
using physics::Puppet;
using physics::PuppetSettings;
using physics::RagdollProfile;
using physics::Role;
using physics::SolverKind;

namespace {

// A figure's frames going forward and turning to and fro as a whole, `seconds` after they stood in `start`.
std::vector<RigidTransform> wayOf(std::span<const BodyState> start, float seconds) {
    const quat turn = glm::angleAxis(0.6F * std::sin(3.0F * seconds), vec3(0, 1, 0));
    const vec3 way(0.2F * std::sin(2.0F * seconds), 0, 1.3F * seconds);
    std::vector<RigidTransform> frames;
    for (const BodyState& body : start) {
        const RigidTransform& at = body.worldFromBody;
        frames.push_back({turn * at.rotation, turn * at.translation + way});
    }
    return frames;
}

BodyTarget targetOf(const RigidTransform& from, const RigidTransform& to, float weight = 1.0F) {
    BodyTarget target;
    target.worldFromBody = to;
    target.linearVelocity = (to.translation - from.translation) / kFrame;
    target.angularVelocity = rotationVector(glm::normalize(to.rotation * glm::conjugate(from.rotation))) / kFrame;
    target.weight = weight;
    return target;
}

float angleBetween(const quat& a, const quat& b) {
    return degrees(glm::length(rotationVector(glm::normalize(a * glm::conjugate(b)))));
}

// Largest turn of a joint since the frames before, degrees; they become the present ones.
class JumpMeter {
  public:
    explicit JumpMeter(const RagdollProfile& profile) : profile_(profile) {}
    void look(std::span<const BodyState> bodies) {
        std::vector<quat> now;
        for (const physics::ConstraintProfile& joint : profile_.constraints)
            now.push_back(glm::conjugate(bodies[joint.parent].worldFromBody.rotation) *
                          bodies[joint.child].worldFromBody.rotation);
        for (std::size_t i = 0; i < joints_.size(); ++i)
            most_ = std::max(most_, angleBetween(now[i], joints_[i]));
        joints_ = now;
    }
    void forget() { most_ = 0.0F; }
    [[nodiscard]] float most() const { return most_; }

  private:
    const RagdollProfile& profile_;
    std::vector<quat> joints_;
    float most_ = 0.0F;
};

}  // namespace

TEST_CASE("a kinematic body is where its target is, whatever hangs on it, and lets go with the target's velocity") {
    const RagdollProfile profile = makeDoll();
    for (const SolverKind solver : kOurSolvers) {
        INFO(physics::solverName(solver));
        const auto world = worldOf(solver);
        const auto start = standingDoll(profile, {0, 1.0F, 0});
        const physics::DollId doll = world->addDoll(profile, start);
        const int hips = physics::bodyOf(profile, Role::hips);
        const int hand = physics::bodyOf(profile, Role::leftHand);
        float off = 0.0F;
        float turned = 0.0F;
        BodyTarget target;
        for (int i = 0; i < 90; ++i) {
            const auto from = wayOf(start, kFrame * static_cast<float>(i));
            const auto to = wayOf(start, kFrame * static_cast<float>(i + 1));
            target = targetOf(from[hips], to[hips]);
            world->setBodyTarget(doll, hips, target);
            world->setBodyTarget(doll, hand, targetOf(from[hand], to[hand]));
            world->step(kFrame);
            for (const int body : {hips, hand}) {
                const RigidTransform now = bodyOfDoll(*world, 0, body).worldFromBody;
                off = std::max(off, glm::distance(now.translation, to[body].translation));
                turned = std::max(turned, angleBetween(now.rotation, to[body].rotation));
            }
        }
        INFO("off by " << off * 1e3F << " mm, " << turned << " degrees");
        CHECK(off < 0.001F);
        CHECK(turned < 0.1F);
        CHECK(std::isfinite(world->dragWork()));
        const vec3 wanted = target.linearVelocity;
        const vec3 had = bodyOfDoll(*world, 0, hips).linearVelocity;
        CHECK(glm::distance(had, wanted) < 0.01F * glm::length(wanted));
        const vec3 turn = bodyOfDoll(*world, 0, hips).angularVelocity;
        CHECK(glm::distance(turn, target.angularVelocity) < 0.01F * glm::length(target.angularVelocity));
        world->setBodyTarget(doll, hips, std::nullopt);
        world->setBodyTarget(doll, hand, std::nullopt);
        // Nothing stays behind that would push: it falls like a doll.
        const float height = bodyOfDoll(*world, 0, hips).worldFromBody.translation.y;
        stepSeconds(*world, 0.3F);
        CHECK(bodyOfDoll(*world, 0, hips).worldFromBody.translation.y < height - 0.2F);
    }
}

TEST_CASE("others feel an infinite mass in a kinematic body, and static geometry is no hindrance to it") {
    const RagdollProfile rod = rodProfile(0.2F, 0.05F, 0.3F);
    for (const SolverKind solver : kOurSolvers) {
        INFO(physics::solverName(solver));
        const auto world = worldOf(solver);
        world->addStatic(physics::StaticShape{});
        const std::vector<BodyState> start{stateAt({0, 0.3F, 0}, glm::angleAxis(kPi / 2, vec3(0, 0, 1)))};
        const physics::DollId doll = world->addDoll(rod, start);
        physics::DynamicProp crate;
        crate.shape.kind = physics::BodyShape::Kind::box;
        crate.shape.halfExtents = vec3(0.2F);
        crate.massKg = 60.0F;
        crate.state = stateAt({0, 0.25F, 0.6F});
        const physics::PropId prop = world->addProp(crate);
        const float speed = 1.0F;
        RigidTransform from = start[0].worldFromBody;
        float off = 0.0F;
        for (int i = 0; i < 60; ++i) {
            RigidTransform to = from;
            to.translation.z += speed * kFrame;
            to.translation.y -= i < 30 ? 0.0F : 0.02F;  // through the floor
            world->setBodyTarget(doll, 0, targetOf(from, to));
            world->step(kFrame);
            off = std::max(off, glm::distance(bodyOfDoll(*world, 0).worldFromBody.translation, to.translation));
            from = to;
            // Two hundred times as heavy, the crate is pushed along all the same.
            if (i == 45) CHECK(world->propState(prop).linearVelocity.z > 0.9F * speed);
        }
        INFO("off by " << off * 1e3F << " mm");
        CHECK(off < 0.001F);
        CHECK(from.translation.y < 0.0F);
    }
}

TEST_CASE("what a kinematic body gives to what it pushes is counted as its work") {
    // A rod comes at one metre a second upon a crate that floats at rest and takes it along: the push is the crate's
    // momentum, and half of its work is lost in the hit. The rod's own energy is the rest.
    const RagdollProfile rod = rodProfile(0.2F, 0.05F, 0.3F);
    physics::WorldSettings settings;
    settings.gravity = vec3(0);
    const auto world = worldOf(SolverKind::crowd, settings);
    const std::vector<BodyState> start{stateAt({0, 0, 0}, glm::angleAxis(kPi / 2, vec3(0, 0, 1)))};
    const physics::DollId doll = world->addDoll(rod, start);
    physics::DynamicProp crate;
    crate.shape.kind = physics::BodyShape::Kind::box;
    crate.shape.halfExtents = vec3(0.2F);
    crate.massKg = 60.0F;
    crate.state = stateAt({0, 0, 0.405F});  // met within a step: what rests against something already is braked
    const physics::PropId prop = world->addProp(crate);
    RigidTransform from = start[0].worldFromBody;
    for (int i = 0; i < 30; ++i) {
        RigidTransform to = from;
        to.translation.z += kFrame;
        world->setBodyTarget(doll, 0, targetOf(from, to));
        world->step(kFrame);
        from = to;
    }
    const double speed = static_cast<double>(world->propState(prop).linearVelocity.z);
    CHECK(speed > 0.9);
    CHECK(world->dragWork() == Approx(60.0 * speed + 0.15).epsilon(0.03));
}

TEST_CASE("a motor between two kinematic bodies moves nothing and works nothing") {
    const RagdollProfile profile = makeDoll();
    const auto world = worldOf(SolverKind::crowd);
    const auto start = standingDoll(profile, {0, 1.0F, 0});
    const physics::DollId doll = world->addDoll(profile, start);
    const int shin = physics::bodyOf(profile, Role::leftLowerLeg);
    const int knee = shin - 1;  // the constraint of a body has its number less one
    REQUIRE(profile.constraints[knee].child == shin);
    world->setMotor(doll, knee, physics::JointMotor{{1, 0, 0, 0}, 1.0F, 60.0F, 4.0F});
    for (int i = 0; i < 30; ++i) {
        for (int body = 0; body < static_cast<int>(start.size()); ++body) {
            RigidTransform from = start[body].worldFromBody;
            RigidTransform to = from;
            if (body == shin) {  // led out of its joint's angle
                from.rotation = glm::angleAxis(0.01F * static_cast<float>(i), vec3(1, 0, 0)) * from.rotation;
                to.rotation = glm::angleAxis(0.01F * static_cast<float>(i + 1), vec3(1, 0, 0)) * to.rotation;
            }
            world->setBodyTarget(doll, body, targetOf(from, to));
        }
        world->step(kFrame);
    }
    CHECK(world->motorWork() == 0.0);
}

TEST_CASE("kinematic joints beyond their limits give way to the pose and throw nothing") {
    const RagdollProfile profile = makeDoll();
    for (const SolverKind solver : kOurSolvers) {
        INFO(physics::solverName(solver));
        const auto world = worldOf(solver);
        const auto start = standingDoll(profile, {0, 1.0F, 0});
        const physics::DollId doll = world->addDoll(profile, start);
        const int shin = physics::bodyOf(profile, Role::leftLowerLeg);
        const int thigh = physics::bodyOf(profile, Role::leftUpperLeg);
        const int foot = physics::bodyOf(profile, Role::leftFoot);
        // A knee bent the wrong way by 60 degrees.
        const physics::ConstraintProfile* knee = nullptr;
        for (const auto& joint : profile.constraints)
            if (joint.child == shin) knee = &joint;
        const vec3 anchor = start[thigh].worldFromBody * knee->parentFromFrame.translation;
        const vec3 axis = start[thigh].worldFromBody.rotation * knee->parentFromFrame.rotation * vec3(0, 0, 1);
        const quat bend = glm::angleAxis(-radians(60.0F), axis);
        const auto bent = [&](int body) {
            const RigidTransform& at = start[body].worldFromBody;
            return RigidTransform{bend * at.rotation, anchor + bend * (at.translation - anchor)};
        };
        for (int i = 0; i < 120; ++i) {
            world->setBodyTarget(doll, thigh, targetOf(start[thigh].worldFromBody, start[thigh].worldFromBody));
            for (const int body : {shin, foot})
                world->setBodyTarget(doll, body, targetOf(bent(body), bent(body)));
            world->step(kFrame);
        }
        CHECK(glm::distance(bodyOfDoll(*world, 0, shin).worldFromBody.translation, bent(shin).translation) < 0.002F);
        CHECK(glm::length(bodyOfDoll(*world, 0, physics::bodyOf(profile, Role::head)).linearVelocity) < 3.0F);
        for (const int body : {thigh, shin, foot})
            world->setBodyTarget(doll, body, std::nullopt);
        float fastest = 0.0F;
        for (int i = 0; i < 30; ++i) {
            world->step(kFrame);
            for (const BodyState& body : bodiesOfDoll(*world, 0))
                fastest = std::max(fastest, glm::length(body.linearVelocity));
        }
        INFO("fastest body after letting go " << fastest << " m/s");
        CHECK(fastest < 12.0F);
        CHECK(world->caught().empty());
    }
}

TEST_CASE("the more weight a body's target has, the nearer the body is to it") {
    const RagdollProfile profile = makeDoll();
    for (const SolverKind solver : kOurSolvers) {
        INFO(physics::solverName(solver));
        float last = 1e9F;
        for (const float weight : {0.05F, 0.3F, 0.6F, 0.9F, 0.99F, 1.0F}) {
            const auto world = worldOf(solver);
            const auto start = standingDoll(profile, {0, 1.0F, 0});
            const physics::DollId doll = world->addDoll(profile, start);
            const int hips = physics::bodyOf(profile, Role::hips);
            float off = 0.0F;
            for (int i = 0; i < 120; ++i) {
                const auto from = wayOf(start, kFrame * static_cast<float>(i));
                const auto to = wayOf(start, kFrame * static_cast<float>(i + 1));
                world->setBodyTarget(doll, hips, targetOf(from[hips], to[hips], weight));
                world->step(kFrame);
                if (i < 60) continue;
                const vec3 now = bodyOfDoll(*world, 0, hips).worldFromBody.translation;
                off += glm::distance(now, to[hips].translation) / 60.0F;
            }
            INFO("weight " << weight << ": " << off << " m");
            CHECK(off < last);
            last = off;
            CHECK(world->caught().empty());
        }
        CHECK(last < 0.001F);
    }
}

TEST_CASE("a puppet is led to its pose over a time, interrupted at any moment, without a snap") {
    const RagdollProfile profile = makeDoll();
    for (const SolverKind solver : kOurSolvers) {
        INFO(physics::solverName(solver));
        PuppetSettings settings;
        settings.muscles = physics::musclesOf(physics::MusclePreset::limp);
        settings.knockOutLoss = settings.knockOutTilt = 1e3F;
        settings.pinForceN = 0.0F;
        settings.led.assign(profile.bodies.size(), 1.0F);
        const auto world = worldOf(solver);
        world->addStatic(physics::StaticShape{});
        const auto start = standingDoll(profile, vec3(0));
        const physics::DollId doll = world->addDoll(profile, start);
        Puppet puppet(*world, doll, profile, physics::bodyOf(profile, Role::hips), start, settings);
        std::vector<RigidTransform> pose;
        for (const BodyState& body : start)
            pose.push_back(body.worldFromBody);
        JumpMeter jumps(profile);
        const auto run = [&](int steps) {
            for (int i = 0; i < steps; ++i) {
                puppet.prepare(pose, pose, kFrame);
                world->step(kFrame);
                jumps.look(bodiesOfDoll(*world, 0));
            }
        };
        const auto offBy = [&] {
            float off = 0.0F;
            for (std::size_t body = 0; body < pose.size(); ++body)
                off =
                    std::max(off, glm::distance(bodyOfDoll(*world, 0, static_cast<int>(body)).worldFromBody.translation,
                                                pose[body].translation));
            return off;
        };
        run(30);
        CHECK(offBy() < 0.001F);
        puppet.settings().led.assign(profile.bodies.size(), 0.0F);
        // Falls, until its arms have come down on it: that is the doll's own motion, whether it is caught or not.
        run(32);
        CHECK(offBy() > 0.1F);
        jumps.forget();
        puppet.settings().led.assign(profile.bodies.size(), 1.0F);
        run(11);  // on its way
        CHECK(puppet.weightOf(0) > 0.2F);
        CHECK(puppet.weightOf(0) < 0.9F);
        puppet.settings().led.assign(profile.bodies.size(), 0.0F);
        run(7);
        puppet.settings().led.assign(profile.bodies.size(), 1.0F);
        run(120);
        INFO("largest turn of a joint between two frames " << jumps.most() << " degrees");
        CHECK(jumps.most() < 10.0F);
        CHECK(offBy() < 0.001F);
        puppet.goLimp();
        CHECK(puppet.weightOf(0) == 0.0F);
        const int hand = physics::bodyOf(profile, Role::leftHand);
        const float height = bodyOfDoll(*world, 0, hand).worldFromBody.translation.y;
        run(60);
        CHECK(bodyOfDoll(*world, 0, hand).worldFromBody.translation.y < height - 0.1F);
    }
}

TEST_CASE("targets that make no sense are refused, and Bullet's own solver has none") {
    const RagdollProfile profile = makeDoll();
    const auto world = worldOf(SolverKind::crowd);
    const auto start = standingDoll(profile, {0, 1.0F, 0});
    const physics::DollId doll = world->addDoll(profile, start);
    int told = 0;
    world->setRefusalSink([&](std::string_view) { ++told; });
    BodyTarget target = targetOf(start[0].worldFromBody, start[0].worldFromBody);
    world->setBodyTarget(doll, 99, target);
    target.weight = 0.0F;
    world->setBodyTarget(doll, 0, target);
    target.weight = 1.0F;
    target.linearVelocity.x = std::nanf("");
    world->setBodyTarget(doll, 0, target);
    CHECK(told == 3);
    const auto stock = worldOf(SolverKind::stock);
    const physics::DollId other = stock->addDoll(profile, start);
    stock->setRefusalSink([&](std::string_view) { ++told; });
    stock->setBodyTarget(other, 0, targetOf(start[0].worldFromBody, start[0].worldFromBody));
    CHECK(told == 4);
}
