#include <string>

#include "animation/humanoid/crowds.hpp"
#include "animation/humanoid/map_humanoid.hpp"
#include "support/catch.hpp"
#include "support/rigs.hpp"

// Scenes of many parts: what the mapper looks at grows with the figure, not with what stands beside it.
namespace lutka::test {
namespace {

using animation::Role;

// Adds so many boxes, each a mesh without a skin on a node of its own; on a root beside the figure.
// Groups of `group` of them hang on nodes of their own, where that is not 0.
void addParts(animation::Character& character, int count, const std::string& name, int group = 0) {
    animation::Skeleton& skeleton = character.skeleton;
    const auto add = [&](const std::string& joint, int parent, const vec3& place, float weight) {
        skeleton.names.push_back(joint);
        skeleton.parents.push_back(parent);
        RigidTransform frame;
        frame.translation = place;
        skeleton.bindModelFromJoint.push_back(frame);
        skeleton.nodeParentFromJoint.emplace_back();
        skeleton.skinWeight.push_back(weight);
        return skeleton.jointCount() - 1;
    };
    const int room = add("room", -1, {0, 0, 0}, 0.0F);
    int holder = room;
    for (int part = 0; part < count; ++part) {
        const vec3 place(static_cast<float>(part % 40) * 0.3F - 6.0F, 0.1F * static_cast<float>(part / 1600),
                         static_cast<float>(part / 40 % 40) * 0.3F + 1.0F);
        if (group > 0 && part % group == 0) holder = add("group", room, {0, 0, 0}, 0.0F);
        const int node = add(name + std::to_string(part), holder, place, 3.0F);
        animation::SkinnedMesh mesh;
        mesh.rigid = true;
        mesh.positions = {place, place + vec3(0.1F, 0, 0), place + vec3(0, 0.1F, 0)};
        mesh.joints.assign(3, {static_cast<std::uint16_t>(node), 0, 0, 0});
        mesh.weights.assign(3, {1, 0, 0, 0});
        mesh.indices = {0, 1, 2};
        character.meshes.push_back(mesh);
    }
}

}  // namespace

TEST_CASE("a figure in a scene of sixty thousand parts is read without them", "[crowds]") {
    const animation::Character alone = makeBiped();
    for (const char* name : {"part_", "head_of_a_bolt_"}) {
        animation::Character scene = alone;
        addParts(scene, 60000, name);
        const auto few = animation::leaveOutCrowds(scene, {});
        REQUIRE(few);
        CHECK(few->character.skeleton.jointCount() == alone.skeleton.jointCount() + 1);
        CHECK(few->character.meshes.size() == alone.meshes.size());
        const animation::HumanoidMap map = animation::mapHumanoid(scene);
        REQUIRE(map.humanoid);
        const animation::HumanoidMap expected = animation::mapHumanoid(alone);
        for (const Role role : {Role::hips, Role::head, Role::leftHand, Role::rightFoot})
            CHECK(map.jointOf(role) == expected.jointOf(role));
    }
}

TEST_CASE("of parts in groups the groups are left", "[crowds]") {
    animation::Character scene = makeBiped();
    const int figure = scene.skeleton.jointCount();
    addParts(scene, 60000, "part_", 120);
    const auto few = animation::leaveOutCrowds(scene, {});
    REQUIRE(few);
    CHECK(few->character.skeleton.jointCount() == figure + 501);
    CHECK(animation::mapHumanoid(scene).humanoid);
}

TEST_CASE("of hundreds of parts those stay that are named as the body's, or that the user fixed", "[crowds]") {
    animation::Character scene = makeBiped();
    const int figure = scene.skeleton.jointCount();
    addParts(scene, 900, "part_");
    scene.skeleton.names[static_cast<std::size_t>(figure) + 5] = "left_hand_shell";
    const int fixed = figure + 700;
    const auto few = animation::leaveOutCrowds(scene, {fixed});
    REQUIRE(few);
    CHECK(few->character.skeleton.jointCount() == figure + 3);
    CHECK(few->original.back() == fixed);
    animation::MapOptions options;
    options.fixed[animation::indexOf(Role::leftToes)] = fixed;
    const animation::HumanoidMap map = animation::mapHumanoid(scene, options);
    REQUIRE(map.humanoid);
    CHECK(map.jointOf(Role::leftToes) == fixed);
}

TEST_CASE("a figure of rigid parts, with many beside it, keeps all of its own", "[crowds]") {
    animation::Character scene = makeBiped();
    addParts(scene, 200, "part_");
    CHECK_FALSE(animation::leaveOutCrowds(scene, {}));
}

}  // namespace lutka::test
