#include <cmath>
#include <glm/geometric.hpp>

#include "physics/doctor/doctor.hpp"
#include "physics/fit/fit_ragdoll.hpp"
#include "support/catch.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using namespace lutka::physics;

namespace {

// Further skin on the figure's joints, as a mesh of its own.
void addTubes(animation::Character& figure, const std::vector<test::TubeSpec>& tubes) {
    const animation::Skeleton& skeleton = figure.skeleton;
    std::vector<test::JointSpec> joints;
    for (int joint = 0; joint < skeleton.jointCount(); ++joint)
        joints.push_back(
            {skeleton.names[joint], skeleton.parents[joint], skeleton.bindModelFromJoint[joint].translation});
    figure.meshes.push_back(test::makeFigure("more", joints, tubes).meshes[0]);
}

// The vertices that a role's joint moves, moved.
template <class Move>
void moveSkin(animation::Character& biped, Role role, Move move) {
    const int joint = test::mapOfBiped(biped).jointOf(role);
    animation::SkinnedMesh& mesh = biped.meshes[0];
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
        if (mesh.joints[v][0] == joint)
            mesh.positions[v] = move(mesh.positions[v], biped.skeleton.bindModelFromJoint[joint].translation);
}

RagdollProfile fitOf(const animation::Character& figure, const animation::HumanoidMap& map) {
    const auto fitted = fitRagdoll(figure, map, {});
    REQUIRE(fitted);
    return fitted.value();
}

const BodyProfile& bodyWith(const RagdollProfile& profile, Role role) {
    const int body = bodyOf(profile, role);
    REQUIRE(body >= 0);
    return profile.bodies[body];
}

vec3 axisOf(const animation::Character& figure, const BodyProfile& body) {
    const int joint = animation::findJoint(figure.skeleton, body.joint);
    return figure.skeleton.bindModelFromJoint[joint].rotation * body.jointFromBody.rotation * vec3(0, 1, 0);
}

}  // namespace

TEST_CASE("a thing that is skin of one hand is in the shape of neither") {
    const Role holding = GENERATE(Role::leftHand, Role::rightHand);
    animation::Character biped = test::makeBiped();
    const auto map = test::mapOfBiped(biped);
    const RagdollProfile bare = fitOf(biped, map);
    const int joint = map.jointOf(holding);
    addTubes(biped, {{joint, biped.skeleton.bindModelFromJoint[joint].translation + vec3(0, -0.2F, 0.5F), 0.03F}});
    const RagdollProfile torch = fitOf(biped, map);
    for (const Role hand : {Role::leftHand, Role::rightHand}) {
        CHECK(bodyWith(torch, hand).shape.radius == Approx(bodyWith(bare, hand).shape.radius).epsilon(0.05));
        CHECK(bodyWith(torch, hand).shape.halfLength == Approx(bodyWith(bare, hand).shape.halfLength).margin(0.005));
    }
}

TEST_CASE("arms of one part, one of them raised, have each its own shape where their joints mirror") {
    const Role raised = GENERATE(Role::leftUpperArm, Role::rightUpperArm);
    const Role other = animation::mirrored(raised);
    std::vector<test::JointSpec> joints{{"hips", -1, {0, 0.9F, 0}}, {"head", 0, {0, 1.4F, 0}}};
    std::vector<test::TubeSpec> tubes{{0, {0, 1.4F, 0}, 0.18F}, {1, {0, 1.75F, 0}, 0.15F}};
    animation::HumanoidMap map;
    map.humanoid = true;
    const auto bind = [&](Role role, int joint) { map.roles[animation::indexOf(role)] = {joint, 1.0F, "by hand"}; };
    bind(Role::hips, 0);
    bind(Role::head, 1);
    for (const bool left : {true, false}) {
        const float side = left ? 1.0F : -1.0F;
        const Role arm = left ? Role::leftUpperArm : Role::rightUpperArm;
        const int joint = static_cast<int>(joints.size());
        joints.push_back({"arm", 0, {0.25F * side, 1.35F, 0}});
        tubes.push_back(
            {joint, joints.back().position + (arm == raised ? vec3(0, 0, 0.5F) : vec3(0, -0.5F, 0)), 0.07F});
        joints.push_back({"leg", 0, {0.1F * side, 0.85F, 0}});
        tubes.push_back({joint + 1, {0.1F * side, 0, 0}, 0.08F});
        bind(arm, joint);
        bind(left ? Role::leftUpperLeg : Role::rightUpperLeg, joint + 1);
    }
    for (std::size_t joint = 0; joint < joints.size(); ++joint)
        joints[joint].name += std::to_string(joint);
    const animation::Character figure = test::makeFigure("blocks", joints, tubes);
    const RagdollProfile profile = fitOf(figure, map);
    CHECK(std::abs(axisOf(figure, bodyWith(profile, raised)).z) > 0.98F);
    CHECK(std::abs(axisOf(figure, bodyWith(profile, other)).y) > 0.98F);
    for (const Finding& finding : diagnose(profile, figure, map).findings)
        CHECK(finding.code != std::string("sides-differ"));
}

TEST_CASE("a beast's long foot has a body from heel to claws") {
    animation::Character biped = test::makeBiped();
    for (const Role foot : {Role::leftFoot, Role::rightFoot})
        moveSkin(biped, foot, [](const vec3& at, const vec3&) { return at * vec3(1, 1, 3); });
    const RagdollProfile profile = fitOf(biped, test::mapOfBiped(biped));
    const BodyShape& shape = bodyWith(profile, Role::leftFoot).shape;
    CHECK(2.0F * (shape.radius + shape.halfLength) > 0.5F);
}

TEST_CASE("the capsule of a head with a long snout lies along it") {
    animation::Character biped = test::makeBiped();
    moveSkin(biped, Role::head, [](const vec3& at, const vec3& joint) {
        const vec3 from = at - joint;
        return joint + vec3(from.x, 0.8F * from.y, 0.25F + 4.0F * from.z);
    });
    const RagdollProfile profile = fitOf(biped, test::mapOfBiped(biped));
    CHECK(std::abs(axisOf(biped, bodyWith(profile, Role::head)).z) > 0.98F);
}
