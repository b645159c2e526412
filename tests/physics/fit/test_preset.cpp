#include "physics/fit/preset.hpp"

#include "animation/humanoid/map_humanoid.hpp"
#include "physics/doctor/doctor.hpp"
#include "physics/fit/fit_ragdoll.hpp"
#include "support/catch.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using namespace lutka::physics;

namespace {

RagdollProfile fit(RagdollPreset preset) {
    const animation::Character biped = test::makeBiped();
    FitOptions options;
    options.preset = preset;
    return fitRagdoll(biped, animation::mapHumanoid(biped), options).value();
}

}  // namespace

TEST_CASE("each preset gives a valid ragdoll that holds its bind pose") {
    const animation::Character biped = test::makeBiped();
    const animation::HumanoidMap map = animation::mapHumanoid(biped);
    for (const PresetInfo& info : presetInfos()) {
        INFO(info.name);
        const RagdollProfile profile = fit(info.preset);
        CHECK(validate(profile).empty());
        const Diagnosis diagnosis = diagnose(profile, biped, map);
        for (const Finding& finding : diagnosis.findings)
            CHECK(finding.code != "bind-outside-limits");
        CHECK(profile.totalMassKg == Approx(75.0F));
    }
}

TEST_CASE("loose goes further with less friction and stiff the other way") {
    const RagdollProfile plain = fit(RagdollPreset::anatomical);
    const RagdollProfile loose = fit(RagdollPreset::loose);
    const RagdollProfile stiff = fit(RagdollPreset::stiff);
    const int hip = bodyOf(plain, Role::leftUpperLeg) - 1;
    CHECK(loose.constraints[hip].cone.swingZ == Approx(plain.constraints[hip].cone.swingZ * 1.3F));
    CHECK(loose.constraints[hip].frictionNm == Approx(plain.constraints[hip].frictionNm * 0.25F));
    CHECK(stiff.constraints[hip].cone.swingZ == Approx(plain.constraints[hip].cone.swingZ * 0.8F));
    CHECK(stiff.constraints[hip].frictionNm == Approx(plain.constraints[hip].frictionNm * 8.0F));
    CHECK(stiff.bodies[1].massKg == Approx(plain.bodies[1].massKg));
}

TEST_CASE("a toy has its mass by volume unless another split was asked for") {
    const RagdollProfile plain = fit(RagdollPreset::anatomical);
    const RagdollProfile toy = fit(RagdollPreset::toy);
    const int head = bodyOf(plain, Role::head);
    CHECK(toy.bodies[head].massKg != Approx(plain.bodies[head].massKg).epsilon(0.01));
    const animation::Character biped = test::makeBiped();
    FitOptions options;
    options.preset = RagdollPreset::toy;
    options.massPreset = MassPreset::uniform;
    const RagdollProfile uniform = fitRagdoll(biped, animation::mapHumanoid(biped), options).value();
    CHECK(uniform.bodies[0].massKg == Approx(uniform.bodies[head].massKg));
}
