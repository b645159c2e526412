#include "physics/powered/puppet.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "physics/worlds/world_table.hpp"
#include "support/catch.hpp"
#include "support/dolls.hpp"

using namespace lutka;
using namespace lutka::test;
using physics::BodyState;
using physics::Puppet;
using physics::PuppetSettings;
using physics::PuppetState;
using physics::RagdollProfile;
using physics::Role;
using physics::SolverKind;

namespace {

// A puppet that stands in its start pose on a floor.
class Stage {
  public:
    Stage(SolverKind solver, const PuppetSettings& settings, const vec3& position = vec3(0))
        : profile_(makeDoll()), world_(worldOf(solver)), start_(standingDoll(profile_, position)) {
        world_->addStatic(physics::StaticShape{});
        doll_ = world_->addDoll(profile_, start_);
        for (const BodyState& body : start_)
            pose_.push_back(body.worldFromBody);
        puppet_ =
            std::make_unique<Puppet>(*world_, doll_, profile_, physics::bodyOf(profile_, Role::hips), start_, settings);
        puppet_->onChange([this](PuppetState, PuppetState after) { changes_.push_back(after); });
    }

    void step(int count = 1) {
        for (int i = 0; i < count; ++i) {
            puppet_->prepare(pose_, pose_, kFrame);
            world_->step(kFrame);
        }
    }
    [[nodiscard]] int body(Role role) const { return physics::bodyOf(profile_, role); }
    // From the pose, degrees.
    [[nodiscard]] float turned(Role role) const {
        const quat now = bodyOfDoll(*world_, 0, body(role)).worldFromBody.rotation;
        return degrees(glm::length(rotationVector(glm::normalize(now * glm::conjugate(pose_[body(role)].rotation)))));
    }
    void hit(Role role, const vec3& impulse) {
        puppet_->hit(body(role), bodyOfDoll(*world_, 0, body(role)).worldFromBody.translation, impulse);
    }
    [[nodiscard]] Puppet& puppet() { return *puppet_; }
    [[nodiscard]] physics::World& world() { return *world_; }
    [[nodiscard]] const std::vector<PuppetState>& changes() const { return changes_; }
    [[nodiscard]] float height(Role role) const {
        return bodyOfDoll(*world_, 0, body(role)).worldFromBody.translation.y;
    }

  private:
    RagdollProfile profile_;
    std::unique_ptr<physics::World> world_;
    std::vector<BodyState> start_;
    std::vector<RigidTransform> pose_;
    physics::DollId doll_;
    std::unique_ptr<Puppet> puppet_;
    std::vector<PuppetState> changes_;
};

}  // namespace

TEST_CASE("a foot that is held while the doll gets up is not pushed away from where it stands") {
    for (const SolverKind solver : kOurSolvers) {
        const auto pushed = [&](float holdN, bool getsUp) {
            Stage stage(solver, {}, {0, 0.5F, 0});  // no ground holds the foot
            const int foot = stage.body(Role::leftFoot);
            const RigidTransform place = bodyOfDoll(stage.world(), 0, foot).worldFromBody;
            stage.puppet().goLimp();
            if (getsUp)
                stage.puppet().getUp(0.01F);
            else
                stage.puppet().comeBack(0.01F);
            for (int i = 0; i < 30; ++i) {
                stage.puppet().hold(foot, place, holdN);
                stage.world().applyForce(stage.world().dolls()[0], foot, {100, 0, 0},
                                         bodyOfDoll(stage.world(), 0, foot).worldFromBody.translation);
                stage.step();
            }
            return bodyOfDoll(stage.world(), 0, foot).worldFromBody.translation.x - place.translation.x;
        };
        INFO(physics::solverName(solver));
        const float free = pushed(0.0F, true);
        CHECK(free > 0.02F);
        CHECK(pushed(400.0F, true) < 0.25F * free);
        // It is held on its way to its feet alone.
        CHECK(pushed(400.0F, false) > 0.5F * free);
    }
}

TEST_CASE("what a pin gives a doll that hangs by its hips is the doll's weight") {
    for (const SolverKind solver : kOurSolvers) {
        INFO(physics::solverName(solver));
        Stage stage(solver, {}, {0, 1, 0});
        stage.step(60);
        const double before = stage.world().dragImpulse();
        stage.step(60);
        double massKg = 0.0;
        const RagdollProfile doll = makeDoll();
        for (const physics::BodyProfile& body : doll.bodies)
            massKg += static_cast<double>(body.massKg);
        CHECK(stage.world().dragImpulse() - before == Approx(massKg * 9.81).epsilon(0.01));
    }
}

TEST_CASE("a hit on the forearm moves the arm and not the pelvis, and the arm is back within half a second") {
    for (const SolverKind solver : kOurSolvers) {
        INFO(physics::solverName(solver));
        Stage stage(solver, {});
        stage.step(60);
        CHECK(stage.puppet().state() == PuppetState::animated);
        stage.hit(Role::leftLowerArm, {0, 0, 10});
        CHECK(stage.puppet().state() == PuppetState::reacting);
        CHECK(stage.puppet().strengthLeft(stage.body(Role::leftLowerArm)) < 0.2F);
        CHECK(stage.puppet().strengthLeft(stage.body(Role::leftUpperArm)) < 0.8F);
        CHECK(stage.puppet().strengthLeft(stage.body(Role::rightFoot)) > 0.95F);
        float arm = 0.0F;
        float pelvis = 0.0F;
        for (int i = 0; i < 30; ++i) {
            stage.step();
            arm = std::max(arm, stage.turned(Role::leftLowerArm));
            pelvis = std::max(pelvis, stage.turned(Role::hips));
        }
        INFO("arm " << arm << ", pelvis " << pelvis << ", after half a second " << stage.turned(Role::leftLowerArm));
        CHECK(arm >= 15.0F);
        CHECK(pelvis <= 3.0F);
        CHECK(stage.turned(Role::leftLowerArm) < 3.0F);
        stage.step(30);
        CHECK(stage.turned(Role::leftLowerArm) < 3.0F);
        CHECK(stage.puppet().state() == PuppetState::animated);
        CHECK(stage.changes() == std::vector{PuppetState::reacting, PuppetState::animated});
    }
}

TEST_CASE("hits add up, and too much of them is a knock-out: the doll falls like any other") {
    for (const SolverKind solver : kOurSolvers) {
        INFO(physics::solverName(solver));
        Stage stage(solver, {});
        stage.step(30);
        const float hips = stage.height(Role::hips);
        stage.hit(Role::leftLowerArm, {0, 0, 3});
        const float once = stage.puppet().strengthLeft(stage.body(Role::leftLowerArm));
        stage.hit(Role::leftLowerArm, {0, 0, 3});
        CHECK(stage.puppet().strengthLeft(stage.body(Role::leftLowerArm)) == Approx(once * once));
        stage.hit(Role::chest, {0, 0, 400});
        stage.hit(Role::hips, {0, 0, 400});
        stage.step(180);
        CHECK(stage.puppet().state() == PuppetState::limp);
        CHECK(stage.height(Role::hips) < 0.5F * hips);
        CHECK(stage.world().drags().empty());
        const double work = stage.world().motorWork();
        stage.step(30);
        CHECK(stage.world().motorWork() == work);
    }
}

TEST_CASE("a puppet that gets up does so until it stands, and a hit that is too much ends it") {
    for (const SolverKind solver : kOurSolvers) {
        INFO(physics::solverName(solver));
        PuppetSettings settings;
        settings.knockOutLoss = 0.4F;
        Stage stage(solver, settings);
        stage.step(10);
        stage.puppet().stand();  // means nothing to one that stands
        CHECK(stage.puppet().state() == PuppetState::animated);
        stage.puppet().goLimp();
        stage.step(6);
        stage.puppet().getUp(0.2F);
        stage.step(60);
        CHECK(stage.puppet().state() == PuppetState::gettingUp);
        stage.hit(Role::hips, {0, 0, 300});
        stage.hit(Role::chest, {0, 0, 300});
        stage.step();
        CHECK(stage.puppet().state() == PuppetState::limp);
        Stage other(solver, {});
        other.puppet().goLimp();
        other.step(3);
        other.puppet().getUp(0.2F);
        other.step(30);
        other.puppet().stand();
        other.step(2);
        CHECK(other.puppet().state() == PuppetState::animated);
        CHECK(other.changes() == std::vector<PuppetState>{PuppetState::limp, PuppetState::gettingUp,
                                                          PuppetState::reacting, PuppetState::animated});
    }
}

TEST_CASE("once it failed to rise the hips' pin turns up a trunk that has nearly all the mass") {
    for (const SolverKind solver : kOurSolvers) {
        INFO(physics::solverName(solver));
        RagdollProfile profile = makeDoll();
        const int hips = physics::bodyOf(profile, Role::hips);
        const int chest = physics::bodyOf(profile, Role::chest);
        // On its back in the air, so that nothing but the pin holds it.
        const auto start = standingDoll(profile, {0, 1.0F, 0}, glm::angleAxis(-kPi / 2, vec3(1, 0, 0)));
        profile.totalMassKg = 0.0F;
        for (physics::BodyProfile& body : profile.bodies) {
            const float factor = body.role == Role::chest ? 80.0F / body.massKg : 0.2F;
            body.massKg *= factor;
            body.inertia *= factor;
            profile.totalMassKg += body.massKg;
        }
        const float lever =
            std::abs(start[chest].worldFromBody.translation.z - start[hips].worldFromBody.translation.z);
        CHECK(80.0F * 9.81F * lever > 250.0F);
        const auto world = worldOf(solver);
        const physics::DollId doll = world->addDoll(profile, start);
        Puppet puppet(*world, doll, profile, hips, start, {});
        std::vector<RigidTransform> pose;
        for (const BodyState& body : start)
            pose.push_back(body.worldFromBody);
        puppet.goLimp();
        puppet.getUp(0.05F);
        puppet.goLimp();
        puppet.getUp(0.05F);
        float off = 0.0F;
        for (int i = 0; i < 90; ++i) {
            puppet.prepare(pose, pose, kFrame);
            world->step(kFrame);
            const quat now = bodyOfDoll(*world, 0, hips).worldFromBody.rotation;
            off = std::max(
                off, degrees(glm::length(rotationVector(glm::normalize(now * glm::conjugate(pose[hips].rotation))))));
        }
        INFO(off << " degrees, lever " << lever);
        CHECK(puppet.state() == PuppetState::gettingUp);
        CHECK(off < 45.0F);
    }
}

TEST_CASE("what acts by itself weakens a puppet as a hit does, and pushes it no further") {
    Stage stage(SolverKind::crowd, {});
    stage.step(30);
    const float height = stage.height(Role::leftLowerArm);
    stage.puppet().feel(stage.body(Role::leftLowerArm), 10.0F);
    CHECK(stage.puppet().state() == PuppetState::reacting);
    CHECK(stage.puppet().strengthLeft(stage.body(Role::leftLowerArm)) < 0.2F);
    CHECK(stage.height(Role::leftLowerArm) == height);
}

TEST_CASE("a limp puppet that comes back is led to its pose without a snap, and may be interrupted") {
    for (const SolverKind solver : kOurSolvers) {
        INFO(physics::solverName(solver));
        PuppetSettings settings;
        Stage stage(solver, settings);
        stage.step(10);
        stage.puppet().goLimp();
        stage.step(12);  // sinks a little
        stage.puppet().comeBack(0.5F);
        CHECK(stage.puppet().state() == PuppetState::gettingUp);
        float jump = 0.0F;
        float last = stage.turned(Role::leftUpperLeg);
        for (int i = 0; i < 90; ++i) {
            stage.step();
            const float now = stage.turned(Role::leftUpperLeg);
            jump = std::max(jump, std::abs(now - last));
            last = now;
        }
        INFO("largest change between two frames " << jump << " degrees");
        CHECK(jump < 10.0F);
        CHECK(stage.puppet().state() == PuppetState::animated);
        CHECK(stage.turned(Role::leftUpperLeg) < 3.0F);
        stage.puppet().goLimp();
        stage.puppet().comeBack(1.0F);
        stage.step(5);
        stage.puppet().goLimp();
        CHECK(stage.puppet().state() == PuppetState::limp);
        CHECK(stage.puppet().strengthLeft(0) == 0.0F);
    }
}

TEST_CASE("a puppet that is pushed over goes limp by its tilt") {
    PuppetSettings settings;
    settings.pinForceN = 0.0F;  // nothing holds it up but its legs
    settings.knockOutLoss = 2.0F;
    Stage stage(SolverKind::crowd, settings);
    stage.step(5);
    stage.hit(Role::chest, {0, 0, 150});
    stage.step(120);
    CHECK(stage.puppet().state() == PuppetState::limp);
}

TEST_CASE("an impulse's work is what the body gains, and is no growth of energy") {
    for (const SolverKind solver : kAllSolvers) {
        INFO(physics::solverName(solver));
        physics::WorldSettings settings;
        settings.gravity = vec3(0);
        const auto world = worldOf(solver, settings);
        const RagdollProfile rod = rodProfile(0.4F, 0.1F);
        const physics::DollId doll = world->addDoll(
            rod, std::vector<BodyState>{stateAt({0, 1, 0}, glm::angleAxis(0.7F, vec3(1, 0, 0)), {0.5F, 0, 0})});
        const auto energyOf = [&] {
            const BodyState state = bodyOfDoll(*world, 0);
            const vec3 turn = glm::conjugate(state.worldFromBody.rotation) * state.angularVelocity;
            return 0.5F * (rod.bodies[0].massKg * glm::dot(state.linearVelocity, state.linearVelocity) +
                           glm::dot(turn, world->inertiaOf(doll, 0) * turn));
        };
        physics::QualityMeter meter(*world, {}, settings.gravity);
        const float before = energyOf();
        world->applyImpulse(doll, 0, {1, 3, -2}, {0.05F, 1.3F, 0.1F});
        world->applyImpulse(doll, 0, {-2, 0, 1}, {0, 0.8F, 0});
        CHECK(world->impulseWork() == Approx(energyOf() - before).epsilon(1e-3));
        CHECK(world->impulseWork() > 1.0);
        meter.sample(0.1);
        CHECK(meter.result().energyGrowthJ < 0.01F);
    }
}
