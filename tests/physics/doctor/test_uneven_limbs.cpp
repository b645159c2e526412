#include <algorithm>
#include <glm/common.hpp>

#include "physics/doctor/doctor.hpp"
#include "physics/fit/fit_ragdoll.hpp"
#include "support/catch.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using namespace lutka::physics;

TEST_CASE("the doctor tells of a role on a joint too far out by the limb's uneven halves") {
    animation::Character character = test::makeBiped();
    const animation::HumanoidMap map = test::mapOfBiped(character);
    const auto findings = [&] {
        std::vector<Finding> all = diagnose(fitRagdoll(character, map).value(), character, map).findings;
        std::erase_if(all, [](const Finding& finding) { return finding.code != "limb-uneven"; });
        return all;
    };
    CHECK(findings().empty());
    // The elbow near the wrist.
    std::vector<RigidTransform>& joints = character.skeleton.bindModelFromJoint;
    RigidTransform& elbow = joints[map.jointOf(Role::leftLowerArm)];
    elbow.translation = glm::mix(elbow.translation, joints[map.jointOf(Role::leftHand)].translation, 0.8F);
    const std::vector<Finding> found = findings();
    REQUIRE(found.size() == 1);
    CHECK(found.front().place == "leftLowerArm");
    CHECK(found.front().severity == Severity::warning);
    CHECK_THAT(found.front().measure, Catch::Contains("leftUpperArm is"));
}
