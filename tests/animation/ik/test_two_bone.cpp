#include "animation/ik/two_bone.hpp"

#include <glm/geometric.hpp>

#include "animation/pose.hpp"
#include "random_chain.hpp"
#include "support/catch.hpp"
#include "support/counting_new.hpp"

using namespace lutka;
using namespace lutka::animation;

namespace {

/// A limb of a random rig, with a joint between its bones now and then, and a way to ask about it.
struct Limb {
    test::RandomChain chain;
    TwoBone bones;

    explicit Limb(Random& random, float mostBend = 0.6F) {
        const bool between = random.next() % 2 == 0;
        chain = test::makeRandomChain(random, between ? 4 : 3, mostBend);
        bones.upper = chain.joints[0];
        bones.middle = chain.joints[between ? 2 : 1];
        bones.end = chain.joints.back();
        bones.bendInUpper = test::randomDirection(random);
    }
    [[nodiscard]] vec3 at(int joint) const { return modelFrameOf(chain.skeleton, chain.pose, joint).translation; }
    [[nodiscard]] float upper() const { return glm::distance(at(bones.middle), at(bones.upper)); }
    [[nodiscard]] float lower() const { return glm::distance(at(bones.end), at(bones.middle)); }
    /// A target between those parts of the limb's reach.
    [[nodiscard]] vec3 target(Random& random, float low, float high) const {
        const float least = std::abs(upper() - lower());
        const float most = upper() + lower();
        return at(bones.upper) + test::randomDirection(random) * (least + (most - least) * random.uniform(low, high));
    }
    Reached solve(const TwoBoneGoal& goal) { return solveTwoBone(chain.skeleton, bones, goal, chain.pose); }
};

}  // namespace

TEST_CASE("two bones reach any target within their reach and keep their lengths") {
    Random random(1);
    float worst = 0.0F;
    for (int i = 0; i < 2000; ++i) {
        Limb limb(random);
        limb.bones.mostFlexion = kPi;
        const std::vector<RigidTransform> before = limb.chain.pose;
        TwoBoneGoal goal;
        goal.softness = 0.0F;
        goal.target = limb.target(random, 0.02F, 0.98F);
        if (i % 2 == 0) goal.pole = test::randomDirection(random);
        const Reached reached = limb.solve(goal);
        worst = std::max({worst, reached.errorM, glm::distance(limb.at(limb.bones.end), goal.target)});
        CHECK(test::stretchBetween(limb.chain.skeleton, before, limb.chain.pose) < 1e-5F);
    }
    CHECK(worst < 1e-4F);
}

TEST_CASE("the middle joint bends towards the pole, and without one in the plane that it is in") {
    Random random(2);
    for (int i = 0; i < 500; ++i) {
        Limb limb(random);
        TwoBoneGoal goal;
        goal.target = limb.target(random, 0.3F, 0.8F);
        const vec3 pole = test::randomDirection(random);
        goal.pole = pole;
        Limb poled = limb;
        poled.solve(goal);
        const vec3 start = poled.at(poled.bones.upper);
        const vec3 along = glm::normalize(goal.target - start);
        const vec3 bend = poled.at(poled.bones.middle) - start;
        const vec3 side = bend - along * glm::dot(bend, along);
        const vec3 wanted = pole - along * glm::dot(pole, along);
        if (glm::length(wanted) > 0.1F) CHECK(glm::dot(glm::normalize(side), glm::normalize(wanted)) > 0.9999F);
        // What is solved stays as it is when it is solved again.
        const std::vector<RigidTransform> first = poled.chain.pose;
        goal.pole.reset();
        poled.solve(goal);
        CHECK(test::turnBetween(first, poled.chain.pose) < 2e-3F);
    }
}

TEST_CASE("a straight limb bends where its hint says") {
    Random random(3);
    for (int i = 0; i < 200; ++i) {
        Limb limb(random, 0.0F);
        const RigidTransform upper = modelFrameOf(limb.chain.skeleton, limb.chain.pose, limb.bones.upper);
        const vec3 along = glm::normalize(limb.at(limb.bones.end) - upper.translation);
        const vec3 hint = glm::normalize(glm::cross(along, test::randomDirection(random)));
        limb.bones.bendInUpper = glm::conjugate(upper.rotation) * hint;
        TwoBoneGoal goal;
        goal.target = upper.translation + along * (limb.upper() + limb.lower()) * 0.8F;
        limb.solve(goal);
        const vec3 bend = limb.at(limb.bones.middle) - upper.translation;
        CHECK(glm::dot(glm::normalize(bend - along * glm::dot(bend, along)), hint) > 0.999F);
    }
}

TEST_CASE("limits of flexion and of the upper joint are kept") {
    Random random(4);
    for (int i = 0; i < 1000; ++i) {
        Limb limb(random);
        limb.bones.leastFlexion = random.uniform(0.0F, 0.3F);
        limb.bones.mostFlexion = random.uniform(1.0F, 2.5F);
        SwingTwistRange range;
        range.parentFromNeutral = limb.chain.pose[limb.bones.upper].rotation;
        range.mostSwingY = random.uniform(0.3F, 1.0F);
        range.mostSwingZ = random.uniform(0.3F, 1.0F);
        range.leastTwist = -0.5F;
        range.mostTwist = 0.5F;
        limb.bones.range = range;
        TwoBoneGoal goal;
        goal.target = limb.target(random, -0.5F, 1.5F);
        const Reached reached = limb.solve(goal);
        CHECK(reached.errorM == Approx(glm::distance(limb.at(limb.bones.end), goal.target)).margin(1e-5));
        CHECK(excessOf(range, limb.chain.pose[limb.bones.upper].rotation) < 1e-3F);
        const vec3 upper = glm::normalize(limb.at(limb.bones.middle) - limb.at(limb.bones.upper));
        const vec3 lower = glm::normalize(limb.at(limb.bones.end) - limb.at(limb.bones.middle));
        const float flexion = std::acos(std::clamp(glm::dot(upper, lower), -1.0F, 1.0F));
        CHECK(flexion > limb.bones.leastFlexion - 2e-3F);
        CHECK(flexion < limb.bones.mostFlexion + 2e-3F);
    }
}

TEST_CASE("an end's rotation is had as it is asked for") {
    Random random(5);
    for (int i = 0; i < 100; ++i) {
        Limb limb(random);
        TwoBoneGoal goal;
        goal.target = limb.target(random, 0.2F, 0.9F);
        goal.endRotation = test::randomTurn(random, kPi);
        limb.solve(goal);
        const quat end = modelFrameOf(limb.chain.skeleton, limb.chain.pose, limb.bones.end).rotation;
        CHECK(glm::length(rotationVector(glm::conjugate(*goal.endRotation) * end)) < 1e-3F);
    }
}

// 1 mm of the target turns no joint by more than 2.5 degrees, through the edge of reach and out of it.
TEST_CASE("a target that moves by a millimetre snaps no joint, within reach, at its edge and beyond") {
    Random random(6);
    float worst = 0.0F;
    for (int i = 0; i < 100; ++i) {
        Limb limb(random);
        const float whole = limb.upper() + limb.lower();
        const float least = std::abs(limb.upper() - limb.lower());
        TwoBoneGoal goal;
        goal.pole = test::randomDirection(random);
        // Outwards along a line that keeps away from the pole's.
        vec3 line = test::randomDirection(random);
        while (std::abs(glm::dot(line, *goal.pole)) > 0.8F)
            line = test::randomDirection(random);
        const std::vector<RigidTransform> rest = limb.chain.pose;
        std::vector<RigidTransform> last;
        for (float way = std::max(least, 0.1F); way < whole * 1.3F; way += 1e-3F) {
            goal.target = limb.at(limb.bones.upper) + line * way;
            limb.chain.pose = rest;
            limb.solve(goal);
            if (!last.empty()) worst = std::max(worst, test::turnBetween(last, limb.chain.pose));
            last = limb.chain.pose;
        }
    }
    INFO(degrees(worst));
    CHECK(degrees(worst) < 2.5F);
}

TEST_CASE("targets on the joint itself and limbs without length give numbers") {
    Random random(7);
    Limb limb(random);
    TwoBoneGoal goal;
    goal.target = limb.at(limb.bones.upper);
    goal.pole = vec3(0);
    limb.solve(goal);
    for (const RigidTransform& frame : limb.chain.pose)
        CHECK(isFinite(frame));
    limb.chain.pose[limb.bones.end].translation = vec3(0);
    goal.target += vec3(1, 0, 0);
    limb.solve(goal);
    for (const RigidTransform& frame : limb.chain.pose)
        CHECK(isFinite(frame));
}

TEST_CASE("solving two bones allocates nothing and gives the same bits again") {
    Random random(8);
    Limb limb(random);
    TwoBoneGoal goal;
    goal.target = limb.target(random, 0.2F, 0.9F);
    const Limb again = limb;
    const std::size_t before = test::allocationCount();
    limb.solve(goal);
    CHECK(test::allocationCount() == before);
    Limb second = again;
    second.solve(goal);
    CHECK(test::turnBetween(limb.chain.pose, second.chain.pose) == 0.0F);
}
