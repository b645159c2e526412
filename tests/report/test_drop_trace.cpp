#include "report/drop_trace.hpp"

#include "scene/measure/checkup.hpp"
#include "support/catch.hpp"
#include "support/ragdolls.hpp"

using namespace lutka;
using namespace lutka::reporting;

TEST_CASE("a drop's trace has a figure a step, a pose every other step, and agrees with the quality figures") {
    const auto asset = test::bipedRagdoll();
    std::vector<DropRecorder> recorders(3);
    const scene::Checkup checkup =
        scene::examine(*asset, [&](int drop, scene::Simulation& simulation) { recorders[drop].sample(simulation); });
    REQUIRE(checkup.drops.size() == 3);
    for (std::size_t i = 0; i < recorders.size(); ++i) {
        const DropTrace& trace = recorders[i].trace();
        const physics::Quality& quality = checkup.drops[i];
        CHECK(trace.energyJ.size() == 361);
        CHECK(trace.separationM.size() == 361);
        CHECK(trace.poses == 181);
        CHECK(trace.worldFromBody.size() == 181 * asset->profile.bodies.size());
        CHECK(trace.worldFromJoint.size() == 181 * asset->character.skeleton.parents.size());
        CHECK(trace.energyJ.front() == Approx(quality.initialEnergyJ).epsilon(1e-3));
        CHECK(trace.energyJ.back() < 0.5F * trace.energyJ.front());
        for (std::size_t step = 0; step < trace.separationM.size(); ++step) {
            CHECK(trace.separationM[step] <= quality.jointSeparationM.max + 1e-6F);
            CHECK(trace.violationDeg[step] <= quality.limitViolationDeg.max + 1e-3F);
        }
        // A fall of 1 m.
        REQUIRE(trace.firstContactS);
        CHECK(*trace.firstContactS == Approx(std::sqrt(2.0F / 9.81F)).margin(0.06));
    }
}

TEST_CASE("a checkup that is watched finds what one finds that is not") {
    const auto asset = test::bipedRagdoll();
    int calls = 0;
    const scene::Checkup watched = scene::examine(*asset, [&](int, scene::Simulation&) { ++calls; });
    const scene::Checkup plain = scene::examine(*asset);
    CHECK(calls == 3 * 361);
    CHECK(scene::checkupJson(*asset, watched) == scene::checkupJson(*asset, plain));
}

TEST_CASE("a figure that is not dropped stands on the floor in its bind pose") {
    const auto asset = test::bipedRagdoll();
    const DropTrace trace = standingTrace(*asset);
    REQUIRE(trace.poses == 1);
    const auto& bind = asset->character.skeleton.bindModelFromJoint;
    REQUIRE(trace.worldFromJoint.size() == bind.size());
    float lowest = 1.0F;
    for (const animation::SkinnedMesh& mesh : asset->character.meshes) {
        for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
            const int joint = mesh.joints[v][0];
            lowest = std::min(lowest, (trace.worldFromJoint[joint] * (inverse(bind[joint]) * mesh.positions[v])).y);
        }
    }
    CHECK(lowest == Approx(0).margin(1e-5));
}
