#include "physics/profile/profile.hpp"

#include <algorithm>
#include <limits>

#include "physics/fit/fit_ragdoll.hpp"
#include "support/catch.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using namespace lutka::physics;

namespace {

RagdollProfile soundProfile() {
    const auto biped = test::makeBiped();
    return fitRagdoll(biped, test::mapOfBiped(biped)).value();
}

}  // namespace

TEST_CASE("a fitted profile is valid") {
    CHECK(validate(soundProfile()).empty());
}

TEST_CASE("validate names every fault at once") {
    struct Fault {
        const char* place;
        void (*plant)(RagdollProfile&);
    };
    const std::vector<Fault> faults = {
        {"/heightM", [](RagdollProfile& p) { p.heightM = 0; }},
        {"/standardFromModel", [](RagdollProfile& p) { p.standardFromModel = quat(2, 0, 0, 0); }},
        {"/bodies/0/role", [](RagdollProfile& p) { std::swap(p.bodies[0].role, p.bodies[1].role); }},
        {"/bodies/3/role", [](RagdollProfile& p) { p.bodies[3].role = p.bodies[2].role; }},
        {"/bodies/2/name", [](RagdollProfile& p) { p.bodies[2].name = p.bodies[1].name; }},
        {"/bodies/1/name", [](RagdollProfile& p) { p.bodies[1].name.clear(); }},
        {"/bodies/4/jointPath", [](RagdollProfile& p) { p.bodies[4].jointPath = p.bodies[3].jointPath; }},
        {"/bodies/5/shape/radius", [](RagdollProfile& p) { p.bodies[5].shape.radius = -0.1F; }},
        {"/bodies/6/shape/halfLength", [](RagdollProfile& p) { p.bodies[6].shape.halfLength = -1; }},
        {"/bodies/7/massKg", [](RagdollProfile& p) { p.bodies[7].massKg = std::numeric_limits<float>::quiet_NaN(); }},
        {"/bodies/8/inertia", [](RagdollProfile& p) { p.bodies[8].inertia.y = 0; }},
        {"/bodies/9/jointFromBody/translation",
         [](RagdollProfile& p) { p.bodies[9].jointFromBody.translation.x = std::numeric_limits<float>::infinity(); }},
        {"/constraints/1/parent", [](RagdollProfile& p) { p.constraints[1].parent = 7; }},
        {"/constraints/2/child", [](RagdollProfile& p) { p.constraints[2].child = 2; }},
        {"/constraints/3/cone/swingY", [](RagdollProfile& p) { p.constraints[3].cone.swingY = 0; }},
        {"/constraints/4/hinge/lower", [](RagdollProfile& p) { p.constraints[4].hinge.lower = 0.1F; }},
        {"/constraints/5/frictionNm", [](RagdollProfile& p) { p.constraints[5].frictionNm = -1; }},
        {"/constraints/6/spring/stiffness", [](RagdollProfile& p) { p.constraints[6].spring.stiffness = -1; }},
        {"/constraints/7/spring/damping",
         [](RagdollProfile& p) { p.constraints[7].spring.damping = std::numeric_limits<float>::infinity(); }},
        {"/constraints/8/spring/rest", [](RagdollProfile& p) { p.constraints[8].spring.rest = quat(2, 0, 0, 0); }},
        {"/filteredPairs/0", [](RagdollProfile& p) { p.filteredPairs.emplace_back(3, 3); }},
    };
    RagdollProfile all = soundProfile();
    for (const Fault& fault : faults) {
        INFO(fault.place);
        RagdollProfile one = soundProfile();
        fault.plant(one);
        fault.plant(all);
        const auto problems = validate(one);
        CHECK(std::any_of(problems.begin(), problems.end(), [&](const std::string& problem) {
            return problem.find(std::string(fault.place) + ": expected") == 0;
        }));
    }
    CHECK(validate(all).size() >= faults.size());
}

TEST_CASE("a missing constraint and an empty profile are invalid") {
    RagdollProfile profile = soundProfile();
    profile.constraints.pop_back();
    CHECK_FALSE(validate(profile).empty());
    CHECK_FALSE(validate(RagdollProfile{}).empty());
}
