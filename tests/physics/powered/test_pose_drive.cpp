#include "physics/powered/pose_drive.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "physics/powered/body_pin.hpp"
#include "physics/profile/constraint_state.hpp"
#include "physics/worlds/world_table.hpp"
#include "support/catch.hpp"
#include "support/counting_new.hpp"
#include "support/dolls.hpp"

using namespace lutka;
using namespace lutka::test;
using physics::BodyState;
using physics::MusclePreset;
using physics::MuscleSettings;
using physics::PoseDrive;
using physics::RagdollProfile;
using physics::Role;
using physics::SolverKind;

namespace {

// A pose in motion: every joint of the limbs turns to and fro about its frame's z, within what the hand-made doll's
// limits allow; the hips stay.
class Exercise {
  public:
    Exercise(const RagdollProfile& profile, std::span<const BodyState> start) : profile_(profile) {
        for (const BodyState& body : start)
            start_.push_back(body.worldFromBody);
    }

    [[nodiscard]] std::vector<RigidTransform> at(float seconds) const {
        std::vector<RigidTransform> pose = start_;
        for (std::size_t i = 0; i < profile_.constraints.size(); ++i) {
            const physics::ConstraintProfile& constraint = profile_.constraints[i];
            const RigidTransform& parent = pose[constraint.parent];
            const RigidTransform& startParent = start_[constraint.parent];
            // Where the parent has carried the child, then the joint's own turn about its anchor.
            const RigidTransform carried = parent * inverse(startParent) * start_[constraint.child];
            const vec3 anchor = parent * constraint.parentFromFrame.translation;
            const vec3 axis = parent.rotation * constraint.parentFromFrame.rotation * vec3(0, 0, 1);
            const float swing = middleOf(constraint) * (1.0F - std::cos(4.0F * seconds));
            const quat turn = glm::angleAxis(swing, axis);
            pose[constraint.child] = {turn * carried.rotation, anchor + turn * (carried.translation - anchor)};
        }
        return pose;
    }

  private:
    // Half the way that the joint goes: a hinge to the middle of its range from where it starts, a cone a little.
    [[nodiscard]] float middleOf(const physics::ConstraintProfile& constraint) const {
        if (constraint.kind == physics::ConstraintProfile::Kind::coneTwist) return 0.05F;
        const auto state = physics::measureConstraint(constraint, start_[constraint.parent], start_[constraint.child]);
        const float middle = 0.5F * (constraint.hinge.lower + constraint.hinge.upper);
        return 0.4F * (middle - state.hingeAngle);
    }

    const RagdollProfile& profile_;
    std::vector<RigidTransform> start_;
};

struct Tracking {
    float rms = 0.0F;  // degrees over all joints and steps after the first half second
    float most = 0.0F;
    float speed = 0.0F;  // of any body at the end, m/s
    physics::Quality quality;
};

// The doll, its hips pinned in the air, follows the exercise for `seconds`.
Tracking track(const RagdollProfile& profile, SolverKind solver, const MuscleSettings& muscles, float seconds = 3.0F) {
    const auto world = worldOf(solver);
    const auto start = standingDoll(profile, {0, 1.0F, 0});
    const physics::DollId doll = world->addDoll(profile, start);
    const Exercise exercise(profile, start);
    PoseDrive drive(profile, start);
    const int hips = physics::bodyOf(profile, Role::hips);
    physics::BodyPin pin(*world, doll, hips);
    physics::QualityMeter meter(*world, std::span<const physics::StaticShape>{}, {0, -9.81F, 0});
    std::vector<float> errors(profile.constraints.size());
    Tracking tracking;
    double squares = 0.0;
    int count = 0;
    const int steps = static_cast<int>(seconds / kFrame);
    for (int i = 0; i < steps; ++i) {
        const auto from = exercise.at(static_cast<float>(i) * kFrame);
        const auto to = exercise.at(static_cast<float>(i + 1) * kFrame);
        drive.drive(*world, doll, muscles, from, to, kFrame);
        pin.follow(from[hips], to[hips], kFrame, 1e5F);
        world->step(kFrame, [&] { meter.sample(static_cast<double>(i + 1) * static_cast<double>(kFrame)); });
        if (i < 30) continue;
        std::vector<RigidTransform> bodies;
        for (const BodyState& body : bodiesOfDoll(*world, 0))
            bodies.push_back(body.worldFromBody);
        jointErrors(profile, to, bodies, errors);
        for (const float error : errors) {
            squares += static_cast<double>(degrees(error)) * static_cast<double>(degrees(error));
            tracking.most = std::max(tracking.most, degrees(error));
            ++count;
        }
    }
    tracking.rms = static_cast<float>(std::sqrt(squares / count));
    for (const BodyState& body : bodiesOfDoll(*world, 0))
        tracking.speed = std::max(tracking.speed, glm::length(body.linearVelocity));
    tracking.quality = meter.result();
    return tracking;
}

}  // namespace

TEST_CASE("a doll with muscles, hung by its hips, follows a pose in motion within five degrees") {
    const RagdollProfile profile = makeDoll();
    for (const SolverKind solver : kOurSolvers) {
        INFO(physics::solverName(solver));
        const Tracking powered = track(profile, solver, physics::musclesOf(MusclePreset::powered));
        INFO("powered: " << powered.rms << " rms, " << powered.most << " at most");
        CHECK(powered.rms < 5.0F);
        CHECK(powered.quality.nonFinite == 0);
        const Tracking stiff = track(profile, solver, physics::musclesOf(MusclePreset::stiff));
        INFO("stiff: " << stiff.rms << " rms, " << stiff.most << " at most");
        CHECK(stiff.rms < 1.0F);
        CHECK(stiff.most < 5.0F);
        const Tracking limp = track(profile, solver, physics::musclesOf(MusclePreset::limp));
        INFO("limp: " << limp.rms << " rms");
        CHECK(limp.rms > 10.0F);
    }
}

TEST_CASE("muscles whose factors are all as large as they may be hold a doll together") {
    const RagdollProfile profile = makeDoll();
    constexpr float kMost = physics::MuscleFactors::kMost;
    MuscleSettings muscles = physics::musclesOf(MusclePreset::stiff);
    muscles.frequencyHz = physics::MuscleProfile::kMostHz;
    muscles.dampingRatio = muscles.strength = muscles.torque = kMost;
    muscles.groups.fill({kMost, kMost, kMost});
    muscles.bodies.assign(profile.bodies.size(), {kMost, kMost, kMost});
    const physics::MuscleFactors together = physics::factorsOf(muscles, profile, 1);
    CHECK(together == physics::MuscleFactors{kMost, kMost, kMost});
    CHECK(physics::strengthOf(muscles, profile, 1) == kMost);
    for (const SolverKind solver : kOurSolvers) {
        INFO(physics::solverName(solver));
        const Tracking firm = track(profile, solver, muscles, 1.0F);
        INFO(firm.rms << " degrees rms, " << firm.quality.jointSeparationM.max * 1e3F << " mm apart");
        CHECK(firm.quality.nonFinite == 0);
        CHECK(firm.rms < 1.0F);
        CHECK(firm.quality.jointSeparationM.max < 0.01F);
    }
}

TEST_CASE("the stronger the muscles, the closer the pose, over six orders of magnitude, and nothing shakes") {
    const RagdollProfile profile = makeDoll();
    MuscleSettings muscles = physics::musclesOf(MusclePreset::powered);
    muscles.bounded = false;
    for (const SolverKind solver : kOurSolvers) {
        float last = 1e9F;
        for (const float strength : {0.01F, 0.1F, 1.0F, 10.0F, 100.0F, 1000.0F, 10000.0F}) {
            muscles.strength = strength;
            const Tracking found = track(profile, solver, muscles);
            INFO(physics::solverName(solver) << " strength " << strength << ": " << found.rms << " rms, " << found.most
                                             << " at most, " << found.speed << " m/s at the end");
            CHECK(found.quality.nonFinite == 0);
            CHECK(found.rms < std::max(last, 0.2F));
            CHECK(found.speed < 6.0F);
            CHECK(found.quality.jointSeparationM.max < 0.01F);
            last = found.rms;
        }
        CHECK(last < 0.5F);
    }
}

TEST_CASE("joints that carry what hangs on them do not sag") {
    const RagdollProfile profile = makeDoll();
    MuscleSettings muscles = physics::musclesOf(MusclePreset::weak);
    muscles.bounded = false;
    for (const SolverKind solver : kOurSolvers) {
        muscles.carriedGravity = vec3(0);
        const Tracking sagging = track(profile, solver, muscles);
        muscles.carriedGravity = {0, -9.81F, 0};
        const Tracking carried = track(profile, solver, muscles);
        INFO(physics::solverName(solver) << ": " << sagging.rms << " and " << carried.rms);
        CHECK(carried.rms < 0.6F * sagging.rms);
    }
}

TEST_CASE("muscles are set by frequency, group and body, without strength a joint is limp") {
    const RagdollProfile profile = makeDoll();
    const auto start = standingDoll(profile, {0, 1.0F, 0});
    const PoseDrive drive(profile, start);
    MuscleSettings muscles = physics::musclesOf(MusclePreset::powered);
    const auto constraintOf = [&](Role role) {
        const int body = physics::bodyOf(profile, role);
        for (std::size_t i = 0; i < profile.constraints.size(); ++i)
            if (profile.constraints[i].child == body) return static_cast<int>(i);
        return -1;
    };
    const int elbow = constraintOf(Role::leftLowerArm);
    const int hip = constraintOf(Role::leftUpperLeg);
    const float omega = 2.0F * kPi * 10.0F;
    CHECK(drive.stiffnessOf(elbow, muscles) == Approx(drive.inertiaOf(elbow) * omega * omega));
    // A forearm with its hand, 1.5 to 2 kg, a foot long.
    CHECK(drive.inertiaOf(elbow) > 0.02F);
    CHECK(drive.inertiaOf(elbow) < 0.2F);
    CHECK(drive.inertiaOf(hip) > 5.0F * drive.inertiaOf(elbow));
    CHECK(drive.torqueBoundOf(hip, muscles) == Approx(3.0F * drive.torqueBoundOf(elbow, muscles)));
    physics::MuscleFactors& arm = muscles.groups[static_cast<std::size_t>(physics::MuscleGroup::arm)];
    arm.strength = 0.5F;
    CHECK(drive.stiffnessOf(elbow, muscles) == Approx(0.5F * drive.inertiaOf(elbow) * omega * omega));
    const float bound = drive.torqueBoundOf(elbow, muscles);
    arm.torque = 3.0F;
    muscles.torque = 2.0F;
    CHECK(drive.torqueBoundOf(elbow, muscles) == Approx(6.0F * bound));
    CHECK(drive.stiffnessOf(elbow, muscles) == Approx(0.5F * drive.inertiaOf(elbow) * omega * omega));
    muscles.bodies.resize(profile.bodies.size());
    muscles.bodies[profile.constraints[elbow].child].strength = 0.0F;
    CHECK(drive.stiffnessOf(elbow, muscles) == 0.0F);
    CHECK(drive.stiffnessOf(hip, muscles) > 0.0F);
}

TEST_CASE("an arm on a leash comes from one end of its range to the other") {
    const RagdollProfile profile = makeDoll();
    const int arm = physics::bodyOf(profile, Role::leftUpperArm);
    const physics::ConstraintProfile& shoulder = profile.constraints[arm - 1];
    for (const SolverKind solver : kOurSolvers) {
        INFO(physics::solverName(solver));
        physics::WorldSettings settings;
        settings.gravity = vec3(0);
        const auto world = worldOf(solver, settings);
        const auto start = standingDoll(profile, {0, 1, 0});
        const physics::DollId doll = world->addDoll(profile, start);
        PoseDrive drive(profile, start);
        const auto poseWith = [&](float swing) {
            std::vector<RigidTransform> pose;
            for (const BodyState& body : start)
                pose.push_back(body.worldFromBody);
            const quat turned = pose[shoulder.parent].rotation * shoulder.parentFromFrame.rotation *
                                glm::angleAxis(swing, vec3(0, 0, 1)) * glm::conjugate(shoulder.childFromFrame.rotation);
            const quat by = turned * glm::conjugate(pose[arm].rotation);
            for (const Role role : {Role::leftUpperArm, Role::leftLowerArm, Role::leftHand}) {
                quat& rotation = pose[physics::bodyOf(profile, role)].rotation;
                rotation = by * rotation;
            }
            return pose;
        };
        const auto go = [&](const std::vector<RigidTransform>& pose, int steps) {
            for (int i = 0; i < steps; ++i) {
                drive.drive(*world, doll, musclesOf(MusclePreset::powered), pose, pose, kFrame);
                world->step(kFrame);
            }
            std::vector<RigidTransform> bodies;
            for (const BodyState& body : bodiesOfDoll(*world, 0))
                bodies.push_back(body.worldFromBody);
            std::vector<float> errors(profile.constraints.size());
            physics::jointErrors(profile, pose, bodies, errors);
            return degrees(errors[arm - 1]);
        };
        REQUIRE(go(poseWith(radians(68.0F)), 120) < 3.0F);
        drive.setMostLead(radians(15.0F));
        drive.setMostSpeed(radians(450.0F));
        drive.setGoesByMiddle(true);
        CHECK(go(poseWith(radians(-40.0F)), 1) > 100.0F);
        CHECK(go(poseWith(radians(-40.0F)), 120) < 5.0F);
    }
}

TEST_CASE("a foot on a leash that is trodden on with the weight of a doll turns by less than ten degrees in a step") {
    const RagdollProfile profile = makeDoll();
    for (const SolverKind solver : kOurSolvers) {
        INFO(physics::solverName(solver));
        physics::WorldSettings settings;
        settings.gravity = vec3(0);
        const auto world = worldOf(solver, settings);
        const auto start = standingDoll(profile, {0, 1, 0});
        const physics::DollId doll = world->addDoll(profile, start);
        PoseDrive drive(profile, start);
        drive.setMostLead(radians(15.0F));
        drive.setMostSpeed(radians(450.0F));
        std::vector<RigidTransform> pose;
        for (const BodyState& body : start)
            pose.push_back(body.worldFromBody);
        const int end = physics::bodyOf(profile, Role::leftFoot);
        const int above = profile.constraints[end - 1].parent;
        const auto turnOf = [&] {
            const auto bodies = bodiesOfDoll(*world, 0);
            return glm::conjugate(bodies[above].worldFromBody.rotation) * bodies[end].worldFromBody.rotation;
        };
        float most = 0.0F;
        float whole = 0.0F;
        const quat first = turnOf();
        quat last = first;
        for (int i = 0; i < 30; ++i) {
            drive.drive(*world, doll, musclesOf(MusclePreset::powered), pose, pose, kFrame);
            // What a doll of 75 kg weighs, at the tip, for a tenth of a second.
            if (i < 6)
                world->applyImpulse(doll, end, vec3(0, 0, 75.0F * 9.81F * kFrame),
                                    bodiesOfDoll(*world, 0)[end].worldFromBody * vec3(0, 0.12F, 0));
            world->step(kFrame);
            const quat now = turnOf();
            most = std::max(most, degrees(glm::length(rotationVector(glm::normalize(now * glm::conjugate(last))))));
            whole = std::max(whole, degrees(glm::length(rotationVector(glm::normalize(now * glm::conjugate(first))))));
            last = now;
        }
        INFO(most << " degrees in a step, " << whole << " in all");
        CHECK(whole > 2.0F);
        CHECK(most < 10.0F);
        CHECK(whole < 20.0F);
    }
}

TEST_CASE("a head too large for an adult's neck is carried by what it weighs") {
    RagdollProfile profile = makeDoll();
    const int head = physics::bodyOf(profile, Role::head);
    const MuscleSettings muscles = musclesOf(MusclePreset::powered);
    const auto boundOf = [&](int body) {
        return PoseDrive(profile, standingDoll(profile, vec3(0))).torqueBoundOf(body - 1, muscles);
    };
    const float neck = boundOf(head);
    physics::ConstraintProfile& joint = profile.constraints[head - 1];
    joint.childFromFrame.translation *= 6.0F;
    const float lever = glm::length(joint.childFromFrame.translation) * profile.bodies[head].massKg;
    CHECK(boundOf(head) == Approx(3.0F * 9.81F * lever).epsilon(0.01));
    CHECK(boundOf(head) > 1.5F * neck);
}

TEST_CASE("a pinned body is where its frame in motion is, and is let go of with the pin") {
    const RagdollProfile profile = makeDoll();
    for (const SolverKind solver : kOurSolvers) {
        INFO(physics::solverName(solver));
        const auto world = worldOf(solver);
        const auto start = standingDoll(profile, {0, 1.0F, 0});
        const physics::DollId doll = world->addDoll(profile, start);
        const int hips = physics::bodyOf(profile, Role::hips);
        const RigidTransform home = start[hips].worldFromBody;
        const auto frameAt = [&](float t) {
            const quat turn = glm::angleAxis(0.5F * std::sin(3.0F * t), vec3(0, 1, 0));
            return RigidTransform{turn * home.rotation, home.translation + vec3(0.7F * std::sin(2.0F * t), 0, 0)};
        };
        {
            physics::BodyPin pin(*world, doll, hips);
            float worst = 0.0F;
            float turned = 0.0F;
            for (int i = 0; i < 180; ++i) {
                const float t = static_cast<float>(i) * kFrame;
                pin.follow(frameAt(t), frameAt(t + kFrame), kFrame, 1e5F);
                world->step(kFrame);
                if (i < 30) continue;
                const RigidTransform now = bodyOfDoll(*world, 0, hips).worldFromBody;
                const RigidTransform wanted = frameAt(t + kFrame);
                worst = std::max(worst, glm::distance(now.translation, wanted.translation));
                turned = std::max(
                    turned,
                    glm::length(rotationVector(glm::normalize(now.rotation * glm::conjugate(wanted.rotation)))));
            }
            INFO(worst << " m, " << degrees(turned) << " degrees");
            CHECK(worst < 0.02F);
            CHECK(degrees(turned) < 6.0F);
            CHECK(world->drags().size() == 3);
        }
        CHECK(world->drags().empty());
    }
}

TEST_CASE("driving a doll allocates nothing after its first step") {
    const RagdollProfile profile = makeDoll();
    const auto world = worldOf(SolverKind::crowd);
    const auto start = standingDoll(profile, {0, 1.0F, 0});
    const physics::DollId doll = world->addDoll(profile, start);
    PoseDrive drive(profile, start);
    MuscleSettings muscles = physics::musclesOf(MusclePreset::powered);
    muscles.carriedGravity = {0, -9.81F, 0};
    std::vector<RigidTransform> pose;
    for (const BodyState& body : start)
        pose.push_back(body.worldFromBody);
    for (int i = 0; i < 10; ++i) {
        drive.drive(*world, doll, muscles, pose, pose, kFrame);
        world->step(kFrame);
    }
    const auto before = allocationCount();
    for (int i = 0; i < 10; ++i) {
        drive.drive(*world, doll, muscles, pose, pose, kFrame);
        world->step(kFrame);
    }
    CHECK(allocationCount() == before);
}
