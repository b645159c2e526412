#include "animation/segments/appendages.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "support/catch.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using namespace lutka::animation;

namespace {

std::vector<std::string> namesOf(const std::vector<Segment>& segments) {
    std::vector<std::string> names;
    for (const Segment& segment : segments)
        names.push_back(segment.name);
    std::sort(names.begin(), names.end());
    return names;
}

// Adds the other one's joints and meshes behind those that are there.
void append(Character& scene, const Character& other) {
    Skeleton& all = scene.skeleton;
    const int first = all.jointCount();
    const auto join = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    join(all.names, other.skeleton.names);
    join(all.bindModelFromJoint, other.skeleton.bindModelFromJoint);
    join(all.nodeParentFromJoint, other.skeleton.nodeParentFromJoint);
    join(all.skinWeight, other.skeleton.skinWeight);
    for (const int parent : other.skeleton.parents)
        all.parents.push_back(parent == kNoJoint ? kNoJoint : parent + first);
    for (SkinnedMesh mesh : other.meshes) {
        for (auto& joints : mesh.joints) {
            for (std::uint16_t& joint : joints)
                joint = static_cast<std::uint16_t>(joint + first);
        }
        scene.meshes.push_back(std::move(mesh));
    }
}

}  // namespace

TEST_CASE("tail, ears, hair and a sword are found on a humanoid, fingers are none of them") {
    const Character figure = test::makeBipedWithAppendages();
    const auto found = findAppendages(figure, test::mapOfBiped(figure));
    const auto has = [&](AppendageKind kind, const char* joint, int joints, Role on) {
        return std::any_of(found.begin(), found.end(), [&](const Appendage& one) {
            return one.kind == kind && figure.skeleton.names[one.joint] == joint && one.joints == joints &&
                   one.role == on;
        });
    };
    CHECK(has(AppendageKind::tail, "tail_01", 3, Role::hips));
    CHECK(has(AppendageKind::ears, "ear_L", 1, Role::head));
    CHECK(has(AppendageKind::ears, "ear_R", 1, Role::head));
    CHECK(has(AppendageKind::hair, "ponytail1", 2, Role::head));
    CHECK(has(AppendageKind::weapon, "sword", 1, Role::rightHand));
    CHECK(found.size() == 5);
}

TEST_CASE("ears and hair that hang on the root of the file are the head's") {
    Character figure = test::makeBipedWithAppendages();
    HumanoidMap map = test::mapOfBiped(figure);
    test::addRoot(figure, map);
    Skeleton& skeleton = figure.skeleton;
    for (int joint = 1; joint < skeleton.jointCount(); ++joint) {
        const std::string& name = skeleton.names[joint];
        if (name == "ear_L" || name == "ear_R" || name == "ponytail1") skeleton.parents[joint] = 0;
    }
    const auto found = findAppendages(figure, map);
    const auto onHead =
        std::count_if(found.begin(), found.end(), [](const Appendage& one) { return one.role == Role::head; });
    CHECK(found.size() == 5);
    CHECK(onHead == 3);
}

TEST_CASE("what hangs on an armature of its own is the part's that its skin lies at, wherever that armature stands") {
    Character figure = test::makeBipedWithAppendages();
    HumanoidMap map = test::mapOfBiped(figure);
    test::addRoot(figure, map);
    const int ponytail = findJoint(figure.skeleton, "ponytail1");
    // Joints that move no skin and stand on the floor, between the feet.
    const int armature = findJoint(figure.skeleton, "ponytail2");
    REQUIRE(ponytail != kNoJoint);
    REQUIRE(armature == ponytail + 1);
    std::swap(figure.skeleton.names[ponytail], figure.skeleton.names[armature]);
    figure.skeleton.names[ponytail] = "armature";
    figure.skeleton.parents[ponytail] = 0;
    figure.skeleton.bindModelFromJoint[ponytail].translation = vec3(0);
    for (SkinnedMesh& mesh : figure.meshes) {
        for (auto& joints : mesh.joints)
            std::replace(joints.begin(), joints.end(), static_cast<std::uint16_t>(ponytail),
                         static_cast<std::uint16_t>(armature));
    }
    const std::vector<Appendage> appendages = findAppendages(figure, map);
    CHECK(appendages.size() == 5);
    const auto isThere = [&](const Appendage& one) { return one.joint == ponytail; };
    const auto found = std::find_if(appendages.begin(), appendages.end(), isThere);
    REQUIRE(found != appendages.end());
    CHECK(found->role == Role::head);
}

TEST_CASE("without telling names appendages are told by where they hang and how they point") {
    Character figure = test::makeBipedWithAppendages();
    for (std::string& name : figure.skeleton.names)
        if (!roleFromName(name)) name = "bone";
    const auto found = findAppendages(figure, test::mapOfBiped(figure));
    const auto number = [&](AppendageKind kind) {
        return std::count_if(found.begin(), found.end(), [&](const Appendage& one) { return one.kind == kind; });
    };
    CHECK(number(AppendageKind::tail) == 1);
    CHECK(number(AppendageKind::hair) == 3);  // ears look like hair
    CHECK(number(AppendageKind::weapon) == 1);
}

TEST_CASE("only what is asked for becomes segments, pairs left first") {
    const Character figure = test::makeBipedWithAppendages();
    const HumanoidMap map = test::mapOfBiped(figure);
    const std::vector<AppendageKind> tail{AppendageKind::tail};
    CHECK(namesOf(appendageSegments(figure, map, tail, 40)) ==
          std::vector<std::string>{"tail_01", "tail_02", "tail_03"});
    const std::vector<AppendageKind> ears{AppendageKind::ears};
    const auto segments = appendageSegments(figure, map, ears, 40);
    REQUIRE(segments.size() == 2);
    CHECK(segments[0].name == "ear_L");
    CHECK(segments[0].mirror == 1);
    CHECK(segments[1].mirror == 0);
    CHECK(segments[0].parent == -1);
    CHECK(appendageSegments(figure, map, {}, 40).empty());
    CHECK(appendageSegments(figure, map, kAppendageKinds, 3).size() <= 3);
}

TEST_CASE("a plain figure has no appendages, and what is no humanoid is not asked") {
    const Character biped = test::makeBiped();
    CHECK(findAppendages(biped, test::mapOfBiped(biped)).empty());
    CHECK(findAppendages(test::makeQuadruped(), HumanoidMap{}).empty());
    for (const AppendageKind kind : kAppendageKinds)
        CHECK(appendageNamed(appendageName(kind)) == kind);
    CHECK_FALSE(appendageNamed("moustache").has_value());
}

TEST_CASE("hundreds of parts on the root that a figure hangs on are no appendages of it", "[crowds]") {
    Character alone = test::makeBipedWithAppendages();
    HumanoidMap map = test::mapOfBiped(alone);
    test::addRoot(alone, map);
    Character scene = alone;
    test::addParts(scene, 600, "part_");
    const int room = alone.skeleton.jointCount();
    for (int joint = room; joint < scene.skeleton.jointCount(); ++joint)
        scene.skeleton.parents[joint] = 0;
    const auto expected = findAppendages(alone, map);
    const auto found = findAppendages(scene, map);
    REQUIRE(found.size() == expected.size());
    for (std::size_t i = 0; i < found.size(); ++i)
        CHECK(found[i].joint == expected[i].joint);
    const std::array<AppendageKind, 2> kinds{AppendageKind::weapon, AppendageKind::other};
    CHECK(namesOf(appendageSegments(scene, map, kinds, 40)) == namesOf(appendageSegments(alone, map, kinds, 40)));
}

TEST_CASE("appendages keep their joints where a crowd that comes before the figure is left out", "[crowds]") {
    Character scene;
    test::addParts(scene, 600, "part_");
    const int first = scene.skeleton.jointCount();
    const Character figure = test::makeBipedWithAppendages();
    HumanoidMap map = test::mapOfBiped(figure);
    const auto expected = findAppendages(figure, map);
    append(scene, figure);
    for (auto& binding : map.roles)
        if (binding) binding->joint += first;
    const auto found = findAppendages(scene, map);
    REQUIRE(found.size() == expected.size());
    for (std::size_t i = 0; i < found.size(); ++i)
        CHECK(found[i].joint == first + expected[i].joint);
    const std::array<AppendageKind, 1> kinds{AppendageKind::tail};
    const auto segments = appendageSegments(scene, map, kinds, 40);
    REQUIRE_FALSE(segments.empty());
    CHECK(scene.skeleton.names[segments.front().joint] == "tail_01");
}
