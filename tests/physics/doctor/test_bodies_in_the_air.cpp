#include <algorithm>

#include "physics/doctor/doctor.hpp"
#include "physics/fit/fit_ragdoll.hpp"
#include "support/catch.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using namespace lutka::physics;

TEST_CASE("the doctor certifies no body that is where the figure is not") {
    animation::Character character = test::makeBiped();
    const animation::HumanoidMap map = test::mapOfBiped(character);
    const auto look = [&] { return diagnose(fitRagdoll(character, map).value(), character, map); };
    const auto inTheAir = [](const Diagnosis& diagnosis) {
        std::vector<std::string> places;
        for (const Finding& finding : diagnosis.findings)
            if (finding.code == "body-in-the-air") places.push_back(finding.place);
        return places;
    };
    CHECK(inTheAir(look()).empty());
    // The file has a joint for the left hand, but its mesh ends at the wrist.
    animation::SkinnedMesh& mesh = character.meshes[0];
    const int hand = map.jointOf(Role::leftHand);
    const int chest = map.jointOf(Role::chest);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        if (mesh.joints[v][0] != hand) continue;
        mesh.joints[v][0] = static_cast<std::uint16_t>(chest);
        mesh.positions[v] = character.skeleton.bindModelFromJoint[chest].translation;
    }
    const Diagnosis sick = look();
    CHECK(inTheAir(sick) == std::vector<std::string>{"leftHand"});
    CHECK(sick.score <= 90.0F);
    CHECK_FALSE(sick.hasErrors());
}
