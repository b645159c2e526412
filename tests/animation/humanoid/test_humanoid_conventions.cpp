#include <cstdio>

#include "animation/humanoid/map_humanoid.hpp"
#include "core/random.hpp"
#include "rig_variations.hpp"
#include "support/catch.hpp"
#include "synthetic_rigs.hpp"

namespace lutka::test {
namespace {

Score scoreRig(const SyntheticRig& rig, const animation::Character& character, const char* what) {
    const animation::HumanoidMap map = animation::mapHumanoid(character);
    const Score score = scoreMap(rig.truth, map, rig.character.skeleton.names);
    if (score.right != score.of || score.optionalRight != score.optionalOf) {
        std::printf("  %-24s %-12s required %2d/%2d optional %d/%d  %s\n", rig.truth.model.c_str(), what, score.right,
                    score.of, score.optionalRight, score.optionalOf, score.faults.c_str());
    }
    return score;
}

void checkShare(const Score& score, double least) {
    std::printf("  required %d/%d, optional %d/%d\n", score.right, score.of, score.optionalRight, score.optionalOf);
    CHECK(score.right >= least * score.of);
}

}  // namespace

TEST_CASE("rigs of every naming convention map to their truth", "[conventions]") {
    for (const std::string& convention : syntheticConventions()) {
        const SyntheticRig rig = makeSyntheticRig(convention);
        const Score score = scoreRig(rig, rig.character, "named");
        INFO(convention << ": " << score.faults);
        CHECK(score.right == score.of);
        CHECK(score.optionalRight == score.optionalOf);
    }
}

TEST_CASE("rigs of every naming convention map without their names", "[conventions]") {
    Score total;
    for (const std::string& convention : syntheticConventions()) {
        const SyntheticRig rig = makeSyntheticRig(convention);
        total += scoreRig(rig, withoutNames(rig.character), "unnamed");
    }
    checkShare(total, 0.95);
}

TEST_CASE("hair, skirts, tails and wings take no roles", "[conventions]") {
    Score named;
    Score unnamed;
    for (const std::string& convention : syntheticConventions()) {
        SyntheticRig rig = makeSyntheticRig(convention);
        addAccessories(rig, 7);
        named += scoreRig(rig, rig.character, "named");
        unnamed += scoreRig(rig, withoutNames(rig.character), "unnamed");
    }
    checkShare(named, 1.0);
    checkShare(unnamed, 0.95);
}

TEST_CASE("any build and any pose of the arms maps", "[conventions]") {
    Score named;
    Score unnamed;
    Random random(11);
    for (const std::string& convention : syntheticConventions()) {
        for (int i = 0; i < 12; ++i) {
            Build build;
            build.arms = random.uniform(0.75F, 1.3F);
            build.legs = random.uniform(0.6F, 1.2F);
            build.trunk = random.uniform(0.75F, 1.3F);
            build.head = random.uniform(0.8F, 2.0F);
            build.shoulders = random.uniform(0.8F, 1.4F);
            build.armsDown = random.uniform(-0.1F, 1.4F);
            build.elbows = random.uniform(0.0F, 0.5F);
            const SyntheticRig rig = makeSyntheticRig(convention, build);
            const animation::Character character = jittered(rig.character, 0.008F, random.next());
            named += scoreRig(rig, character, "named");
            unnamed += scoreRig(rig, withoutNames(character), "unnamed");
        }
    }
    checkShare(named, 0.995);
    checkShare(unnamed, 0.95);
}

TEST_CASE("the order of joints in the file changes nothing", "[conventions]") {
    for (const std::string& convention : syntheticConventions()) {
        const SyntheticRig rig = makeSyntheticRig(convention);
        std::vector<int> order;
        const animation::Character character = shuffled(rig.character, 5, order);
        const animation::HumanoidMap straight = animation::mapHumanoid(rig.character);
        const animation::HumanoidMap other = animation::mapHumanoid(character);
        INFO(convention);
        REQUIRE(other.humanoid);
        for (int index = 0; index < animation::kRoleCount; ++index) {
            const animation::Role role = animation::roleAt(index);
            INFO(animation::roleName(role));
            const int joint = other.jointOf(role);
            CHECK((joint == animation::kNoJoint ? joint : order[joint]) == straight.jointOf(role));
        }
    }
}

}  // namespace lutka::test
