#include "physics/fit/edit_bodies.hpp"

#include <glm/geometric.hpp>
#include <numeric>

#include "physics/collision/shape.hpp"
#include "physics/fit/fit_ragdoll.hpp"
#include "physics/fit/rebind.hpp"
#include "support/catch.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using namespace lutka::physics;

namespace {

struct Bench {
    animation::Character character;
    animation::HumanoidMap map;
    RagdollProfile profile;

    [[nodiscard]] int joint(const std::string& name) const { return animation::findJoint(character.skeleton, name); }
};

Bench tailedBench() {
    Bench bench;
    bench.character = test::makeBipedWithAppendages();
    bench.map = animation::mapHumanoid(bench.character);
    bench.profile = fitRagdoll(bench.character, bench.map).value();
    return bench;
}

float massOf(const RagdollProfile& profile) {
    return std::accumulate(profile.bodies.begin(), profile.bodies.end(), 0.0F,
                           [](float sum, const BodyProfile& body) { return sum + body.massKg; });
}

void checkSound(const Bench& bench, const RagdollProfile& profile) {
    CHECK(validate(profile).empty());
    CHECK(massOf(profile) == Approx(bench.profile.totalMassKg).epsilon(1e-4));
    // The anchors of every constraint meet in the bind pose.
    const auto shapes = shapesInBindPose(profile, bench.character.skeleton);
    for (const ConstraintProfile& c : profile.constraints) {
        const vec3 a = shapes[c.parent].standardFromBody * c.parentFromFrame.translation;
        const vec3 b = shapes[c.child].standardFromBody * c.childFromFrame.translation;
        INFO(profile.bodies[c.child].name);
        CHECK(glm::distance(a, b) < 1e-3F);
    }
}

std::string tailJoint(const Bench& bench, int index) {
    std::vector<std::string> tail;
    for (const std::string& name : bench.character.skeleton.names) {
        if (name.find("tail") != std::string::npos || name.find("Tail") != std::string::npos) tail.push_back(name);
    }
    REQUIRE(static_cast<int>(tail.size()) > index);
    return tail[static_cast<std::size_t>(index)];
}

}  // namespace

TEST_CASE("a body is added on a joint of the tail, shaped by its skin and hung on the body above") {
    const Bench bench = tailedBench();
    const std::string first = tailJoint(bench, 0);
    const auto added = addBody(bench.profile, bench.character, bench.map, bench.joint(first));
    REQUIRE(added.ok());
    const RagdollProfile& profile = added.value();
    REQUIRE(profile.bodies.size() == bench.profile.bodies.size() + 1);
    checkSound(bench, profile);
    const int body = bodyNamed(profile, first);
    REQUIRE(body > 0);
    CHECK(profile.constraints[body - 1].parent == bodyOf(profile, Role::hips));
    CHECK(profile.bodies[body].massKg < profile.bodies[0].massKg);
    CHECK(profile.constraints[body - 1].frictionNm > 0.0F);
    // Whoever is not concerned keeps everything.
    for (const Role role : {Role::head, Role::leftFoot}) {
        const BodyProfile& now = profile.bodies[bodyOf(profile, role)];
        const BodyProfile& was = bench.profile.bodies[bodyOf(bench.profile, role)];
        CHECK(now.shape.radius == was.shape.radius);
        CHECK(now.massKg == was.massKg);
    }
    CHECK_FALSE(addBody(profile, bench.character, bench.map, bench.joint(first)).ok());
}

TEST_CASE("a body between two others takes the lower one over, and taken away it gives it back") {
    const Bench bench = tailedBench();
    const std::string first = tailJoint(bench, 0);
    const std::string second = tailJoint(bench, 1);
    const auto lower = addBody(bench.profile, bench.character, bench.map, bench.joint(second));
    REQUIRE(lower.ok());
    const auto both = addBody(lower.value(), bench.character, bench.map, bench.joint(first));
    REQUIRE(both.ok());
    checkSound(bench, both.value());
    const int upperBody = bodyNamed(both.value(), first);
    const int lowerBody = bodyNamed(both.value(), second);
    REQUIRE(upperBody < lowerBody);
    CHECK(both.value().constraints[lowerBody - 1].parent == upperBody);
    const auto removed = removeBody(both.value(), bench.character, upperBody);
    REQUIRE(removed.ok());
    checkSound(bench, removed.value());
    CHECK(bodyNamed(removed.value(), first) < 0);
    const int left = bodyNamed(removed.value(), second);
    CHECK(removed.value().constraints[left - 1].parent == bodyOf(removed.value(), Role::hips));
}

TEST_CASE("a forearm merged into the upper arm makes one body of both, and the hand hangs on it") {
    const Bench bench = tailedBench();
    const int forearm = bodyOf(bench.profile, Role::leftLowerArm);
    const auto merged = mergeBody(bench.profile, bench.character, bench.map, forearm);
    REQUIRE(merged.ok());
    checkSound(bench, merged.value());
    const int upper = bodyOf(merged.value(), Role::leftUpperArm);
    const int hand = bodyOf(merged.value(), Role::leftHand);
    CHECK(merged.value().constraints[hand - 1].parent == upper);
    const auto lengthOf = [](const BodyShape& shape) { return 2.0F * (shape.halfLength + shape.radius); };
    CHECK(lengthOf(merged.value().bodies[upper].shape) >
          1.3F * lengthOf(bench.profile.bodies[bodyOf(bench.profile, Role::leftUpperArm)].shape));
}

TEST_CASE("a tail of one body is split at its middle joint, and a body without a joint inside is not") {
    const Bench bench = tailedBench();
    const auto added = addBody(bench.profile, bench.character, bench.map, bench.joint(tailJoint(bench, 0)));
    REQUIRE(added.ok());
    const int tail = bodyNamed(added.value(), tailJoint(bench, 0));
    const auto split = splitBody(added.value(), bench.character, bench.map, tail);
    REQUIRE(split.ok());
    checkSound(bench, split.value());
    CHECK(split.value().bodies.size() == added.value().bodies.size() + 1);
    const int upper = bodyNamed(split.value(), tailJoint(bench, 0));
    CHECK(shapeVolume(split.value().bodies[upper].shape) < shapeVolume(added.value().bodies[tail].shape));
    const auto foot = splitBody(bench.profile, bench.character, bench.map, bodyOf(bench.profile, Role::leftUpperLeg));
    REQUIRE_FALSE(foot.ok());
    CHECK(foot.error().code == ErrorCode::usage);
}

TEST_CASE("the root is not removed, and a ragdoll by hand begins with it alone") {
    const Bench bench = tailedBench();
    CHECK_FALSE(removeBody(bench.profile, bench.character, 0).ok());
    RagdollProfile profile = rootAlone(bench.profile, bench.character, bench.map);
    CHECK(profile.bodies.size() == 1);
    checkSound(bench, profile);
    for (const char* name : {"head", "leftUpperArm", "leftLowerArm"}) {
        INFO(name);
        const int body = bodyOf(bench.profile, *animation::roleFromName(name));
        auto next = addBody(profile, bench.character, bench.map, bench.joint(bench.profile.bodies[body].jointPath));
        REQUIRE(next.ok());
        profile = std::move(next).value();
    }
    checkSound(bench, profile);
    CHECK(profile.bodies.size() == 4);
}
