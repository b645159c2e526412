#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "animation/segments/segment_rig.hpp"
#include "physics/collision/shape.hpp"
#include "physics/doctor/doctor.hpp"
#include "physics/fit/fit_ragdoll.hpp"
#include "physics/fit/limits_from_clips.hpp"
#include "physics/fit/profile_plan.hpp"
#include "physics/fit/rebind.hpp"
#include "physics/profile/constraint_state.hpp"
#include "physics/profile/profile_io.hpp"
#include "physics/rig/lod_profile.hpp"
#include "physics/rig/rig.hpp"
#include "support/catch.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using namespace lutka::physics;

namespace {

struct Creature {
    animation::Character character = test::makeQuadruped();
    animation::HumanoidMap map;
    RagdollProfile profile;
    Rig rig;

    explicit Creature(FitOptions options = anyRig()) {
        map.standardFromModel = animation::segmentRig(character).standardFromModel;
        profile = fitRagdoll(character, map, options).value();
        rig = bindRig(profile, character.skeleton).value();
    }

    static FitOptions anyRig() {
        FitOptions options;
        options.rig = RigKind::any;
        options.weighByVolume = true;
        return options;
    }
};

float massOf(const RagdollProfile& profile, const char* name) {
    const int body = bodyNamed(profile, name);
    REQUIRE(body >= 0);
    return profile.bodies[body].massKg;
}

}  // namespace

TEST_CASE("any rig becomes a valid ragdoll without roles that comes back from its file") {
    const Creature creature;
    CHECK(validate(creature.profile).empty());
    CHECK_FALSE(hasRoles(creature.profile));
    const auto read = profileFromJson(profileToJson(creature.profile), "memory");
    REQUIRE(read);
    CHECK(profileToJson(read.value()) == profileToJson(creature.profile));
    CHECK(creature.profile.bodies[counterpartOf(creature.profile, bodyNamed(creature.profile, "paw_fore_l"))].name ==
          "paw_fore_r");
}

TEST_CASE("a trunk thicker than its joints are apart keeps its thickness") {
    std::vector<test::JointSpec> joints;
    std::vector<test::TubeSpec> tubes;
    constexpr int kLinks = 6;
    for (int i = 0; i < kLinks; ++i) {
        const float z = 0.3F * static_cast<float>(i);
        joints.push_back({i == kLinks - 1 ? "head" : "spine" + std::to_string(i), i - 1, {0, 1, z}});
        tubes.push_back({i, {0, 1, z + 0.3F}, 0.45F});
    }
    for (const float side : {1.0F, -1.0F}) {
        for (const int above : {0, kLinks - 2}) {
            const float z = joints[above].position.z;
            const std::string end = (above == 0 ? "_hind" : "_fore") + std::string(side > 0.0F ? "_l" : "_r");
            joints.push_back({"thigh" + end, above, {side * 0.3F, 0.8F, z}});
            joints.push_back({"shin" + end, static_cast<int>(joints.size()) - 1, {side * 0.3F, 0.4F, z}});
            tubes.push_back({static_cast<int>(joints.size()) - 2, {side * 0.3F, 0.4F, z}, 0.12F});
            tubes.push_back({static_cast<int>(joints.size()) - 1, {side * 0.3F, 0, z}, 0.1F});
        }
    }
    const animation::Character bear = test::makeFigure("bear", joints, tubes);
    animation::HumanoidMap map;
    map.standardFromModel = animation::segmentRig(bear).standardFromModel;
    const RagdollProfile profile = fitRagdoll(bear, map, Creature::anyRig()).value();
    for (int link = 1; link < kLinks - 1; ++link) {
        const int body = bodyNamed(profile, "spine" + std::to_string(link));
        REQUIRE(body >= 0);
        INFO(profile.bodies[body].name);
        CHECK(profile.bodies[body].shape.radius > 0.36F);
    }
    CHECK_FALSE(diagnose(profile, bear, map).hasErrors());
}

TEST_CASE(
    "limbs whose first joints cross in the middle of the trunk have shapes, wherever their left ones are listed") {
    std::vector<test::JointSpec> joints{
        {"abdomen", -1, {0, 1, -0.5F}}, {"thorax", 0, {0, 1, 0}}, {"head", 1, {0, 1, 0.5F}}};
    std::vector<test::TubeSpec> tubes{{0, {0, 1, 0}, 0.2F}, {1, {0, 1, 0.5F}, 0.2F}, {2, {0, 1, 1}, 0.25F}};
    for (const float side : {-1.0F, 1.0F}) {
        int above = 1;
        for (int place = 0; place < 3; ++place) {
            // The first joint lies a little on the other side, so that what hangs on the right one is the left limb. No
            // name tells sides.
            const float x = side * (place == 0 ? -0.005F : 0.4F * static_cast<float>(place));
            const std::string name = (side > 0.0F ? "beta" : "alpha") + std::to_string(place);
            joints.push_back({name, above, {x, 1, 0.1F}});
            above = static_cast<int>(joints.size()) - 1;
            tubes.push_back({above, {side * 0.4F * static_cast<float>(place + 1), 1, 0.1F}, 0.06F});
        }
    }
    const animation::Character spider = test::makeFigure("spider", joints, tubes);
    animation::HumanoidMap map;
    map.standardFromModel = animation::segmentRig(spider).standardFromModel;
    for (const bool hulls : {false, true}) {
        FitOptions options = Creature::anyRig();
        options.hulls = hulls;
        const auto profile = fitRagdoll(spider, map, options);
        REQUIRE(profile);
        const int left = bodyNamed(profile.value(), "beta1");
        const int right = bodyNamed(profile.value(), "alpha1");
        REQUIRE(left > right);
        REQUIRE(right >= 0);
        const BodyShape& shape = profile.value().bodies[right].shape;
        CHECK(thicknessOf(shape) > 0.03F);
        CHECK(thicknessOf(shape) == Approx(thicknessOf(profile.value().bodies[left].shape)));
    }
}

TEST_CASE("parts whose joints all stand at the origin keep their places, for such joints tell nothing of a middle") {
    const std::vector<test::JointSpec> joints{{"Root", -1, {}},
                                              {"Chassis", 0, {0.4F, 0.8F, 0.3F}},
                                              {"LauncherLeft", 0, {0.7F, 1.3F, 0.3F}},
                                              {"LauncherRight", 0, {0.1F, 1.3F, 0.3F}},
                                              {"Gun", 0, {0.6F, 1, 0.5F}}};
    const std::vector<test::TubeSpec> tubes{{1, {0.4F, 1.2F, 0.3F}, 0.2F},
                                            {2, {0.7F, 1.3F, 0.7F}, 0.1F},
                                            {3, {0.1F, 1.3F, 0.7F}, 0.1F},
                                            {4, {0.6F, 1, 0.9F}, 0.05F}};
    animation::Character mech = test::makeFigure("mech", joints, tubes);
    for (std::size_t joint = 0; joint < joints.size(); ++joint) {
        // As files have it, to the bits of a float: the signs tell no sides.
        const float rounding = joints[joint].name == "LauncherLeft" ? 1e-8F : -1e-8F;
        mech.skeleton.bindModelFromJoint[joint] = {quat(1, 0, 0, 0), vec3(rounding, 0, 0)};
        mech.skeleton.nodeParentFromJoint[joint] = {};
    }
    animation::HumanoidMap map;
    map.standardFromModel = animation::segmentRig(mech).standardFromModel;
    const RagdollProfile profile = fitRagdoll(mech, map, Creature::anyRig()).value();
    for (const test::TubeSpec& tube : tubes) {
        const test::JointSpec& part = joints[tube.joint];
        INFO(part.name);
        const int body = bodyNamed(profile, part.name);
        REQUIRE(body >= 0);
        const vec3 middle = 0.5F * (part.position + tube.end);
        CHECK(glm::distance(profile.bodies[body].jointFromBody.translation, middle) < 0.05F);
    }
}

TEST_CASE("a body of few points lies along them, wherever its joint is") {
    // One side of a crate, whose joint lies in the crate's middle as all its others do.
    animation::Character crate = test::makeFigure(
        "crate", {{"floor", -1, {0, 0.2F, -0.5F}}, {"plate", 0, {0, 0.2F, 0}}}, {{0, {0, 0.2F, 0.5F}, 0.3F}});
    animation::SkinnedMesh& skin = crate.meshes.front();
    const auto first = static_cast<std::uint32_t>(skin.positions.size());
    const std::vector<vec3> corners{{-0.3F, 1.2F, -0.5F}, {0.3F, 1.2F, -0.5F}, {0, 1.2F, 0.5F}};
    for (const vec3& corner : corners) {
        skin.positions.push_back(corner);
        skin.normals.emplace_back(0, 1, 0);
        skin.joints.push_back({1, 0, 0, 0});
        skin.weights.push_back({1, 0, 0, 0});
    }
    skin.indices.insert(skin.indices.end(), {first, first + 1, first + 2});
    skin.uvs.clear();
    skin.tangents.clear();
    skin.fileOrder.clear();
    crate.skeleton.skinWeight[1] = 3;
    animation::HumanoidMap map;
    map.standardFromModel = animation::segmentRig(crate).standardFromModel;
    const RagdollProfile profile = fitRagdoll(crate, map, Creature::anyRig()).value();
    REQUIRE(bodyNamed(profile, "plate") >= 0);
    const Diagnosis diagnosis = diagnose(profile, crate, map);
    for (const Finding& finding : diagnosis.findings)
        CHECK(finding.code != "body-beside-skin");
}

namespace {

// A square bar between two points, which moves with a joint.
void addBar(animation::Character& figure, int joint, const vec3& from, const vec3& to, float half) {
    if (figure.meshes.empty()) figure.meshes.emplace_back().name = "bars";
    animation::SkinnedMesh& mesh = figure.meshes[0];
    const vec3 along = glm::normalize(to - from);
    const vec3 across = glm::normalize(glm::cross(along, std::abs(along.z) < 0.9F ? vec3(0, 0, 1) : vec3(0, 1, 0)));
    const vec3 other = glm::cross(along, across);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int corner = 0; corner < 8; ++corner) {
        const vec3 end = (corner & 4) != 0 ? to : from;
        const float u = (corner & 1) != 0 ? half : -half;
        const float v = (corner & 2) != 0 ? half : -half;
        mesh.positions.push_back(end + u * across + v * other);
        mesh.normals.push_back(glm::normalize(u * across + v * other));
        mesh.joints.push_back({static_cast<std::uint16_t>(joint), 0, 0, 0});
        mesh.weights.push_back({1, 0, 0, 0});
    }
    constexpr std::array<std::uint32_t, 36> kFaces{0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                                   2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
    for (const std::uint32_t index : kFaces)
        mesh.indices.push_back(first + index);
    figure.skeleton.skinWeight[static_cast<std::size_t>(joint)] = 8;
}

}  // namespace

TEST_CASE("slanting blocks become boxes along them, and legs that stand stay round") {
    // A spider of blocks: four thin legs aslant, and below it, as a table's, four that stand.
    std::vector<test::JointSpec> joints{{"body", -1, {0, 1, 0}}};
    for (const float side : {1.0F, -1.0F}) {
        const std::string end = side > 0.0F ? ".L" : ".R";
        joints.push_back({"feeler" + end, 0, {side * 0.3F, 1.1F, 0.3F}});
        joints.push_back({"leg" + end, 0, {side * 0.25F, 0.8F, -0.3F}});
    }
    animation::Character block = test::makeFigure("block", joints, {});
    block.meshes.clear();
    addBar(block, 0, {0, 1, -0.5F}, {0, 1, 0.5F}, 0.3F);
    for (int joint = 1; joint < 5; ++joint) {
        const vec3 at = joints[static_cast<std::size_t>(joint)].position;
        const float side = at.x > 0.0F ? 1.0F : -1.0F;
        // A feeler's joint lies off its axis, so that the way from the joint to its middle is not along it.
        if (joint % 2 == 1)
            addBar(block, joint, at + vec3(0, 0.06F, 0.05F), at + vec3(side * 0.8F, -0.5F, 0.4F), 0.06F);
        if (joint % 2 == 0) addBar(block, joint, at, at + vec3(0, -0.8F, 0), 0.1F);
    }
    animation::HumanoidMap map;
    map.standardFromModel = animation::segmentRig(block).standardFromModel;
    const RagdollProfile profile = fitRagdoll(block, map, Creature::anyRig()).value();
    for (const std::string end : {".L", ".R"}) {
        REQUIRE(bodyNamed(profile, "feeler" + end) >= 0);
        REQUIRE(bodyNamed(profile, "leg" + end) >= 0);
        CHECK(profile.bodies[bodyNamed(profile, "feeler" + end)].shape.kind == BodyShape::Kind::box);
        CHECK(profile.bodies[bodyNamed(profile, "leg" + end)].shape.kind == BodyShape::Kind::capsule);
    }
}

TEST_CASE("a crate is a box wherever its joint stands") {
    for (const vec3& corner : {vec3(0), vec3(-0.4F, 0, -0.4F), vec3(3, 0, 2)}) {
        INFO(corner.x);
        animation::Character crate = test::makeFigure("crate", {{"crate", -1, {0, 0, 0}}}, {});
        crate.meshes.clear();
        addBar(crate, 0, corner + vec3(0.4F, 0, 0.4F), corner + vec3(0.4F, 0.7F, 0.4F), 0.4F);
        animation::HumanoidMap map;
        map.standardFromModel = animation::segmentRig(crate).standardFromModel;
        const RagdollProfile profile = fitRagdoll(crate, map, Creature::anyRig()).value();
        REQUIRE(profile.bodies.size() == 1);
        CHECK(profile.bodies[0].shape.kind == BodyShape::Kind::box);
        CHECK(profile.bodies[0].massKg == Approx(0.8F * 0.8F * 0.7F * 1000.0F).epsilon(0.02));
    }
}

TEST_CASE("a creature's shapes lie in its skin and are alike on both sides") {
    const Creature creature;
    for (std::size_t i = 0; i < creature.profile.bodies.size(); ++i) {
        const BodyProfile& body = creature.profile.bodies[i];
        INFO(body.name);
        // The tubes are round: no capsule is much thicker than its own, and its middle is in it.
        CHECK(body.shape.radius < 0.16F);
        const int other = counterpartOf(creature.profile, static_cast<int>(i));
        if (other < 0) continue;
        CHECK(body.shape.radius == Approx(creature.profile.bodies[other].shape.radius));
        CHECK(body.shape.halfLength == Approx(creature.profile.bodies[other].shape.halfLength));
        CHECK(body.massKg == Approx(creature.profile.bodies[other].massKg));
    }
    const Diagnosis diagnosis = diagnose(creature.profile, creature.character, creature.map);
    CHECK(diagnosis.fit.skinNear > 0.8F);
    CHECK(diagnosis.fit.overlapM < 0.005F);
}

TEST_CASE("the bind pose is the middle of a creature's limits, and frames of two sides are mirror images") {
    const Creature creature;
    for (const ConstraintProfile& c : creature.profile.constraints) {
        INFO(creature.profile.bodies[c.child].name);
        const ConstraintState state =
            measureConstraint(c, creature.rig.bindModelFromBody[c.parent], creature.rig.bindModelFromBody[c.child]);
        CHECK(state.violation == 0.0F);
        CHECK(state.separationM < 1e-5F);
        CHECK(glm::length(state.swing) < 1e-3F);
        const int other = counterpartOf(creature.profile, c.child);
        if (other <= c.child) continue;
        const ConstraintProfile& mirrored = creature.profile.constraints[other - 1];
        const auto axis = [&](const ConstraintProfile& one, const vec3& v) {
            return creature.rig.bindModelFromBody[one.child].rotation * (one.childFromFrame.rotation * v);
        };
        const vec3 x = axis(c, {1, 0, 0});
        const vec3 z = axis(c, {0, 0, 1});
        CHECK(glm::distance(vec3(-x.x, x.y, x.z), axis(mirrored, {1, 0, 0})) < 1e-3F);
        CHECK(glm::distance(vec3(z.x, -z.y, -z.z), axis(mirrored, {0, 0, 1})) < 1e-3F);
    }
}

TEST_CASE("a creature weighs its volume in water, or what is asked for, and nothing hangs on a thread") {
    const Creature creature;
    float volume = 0.0F;
    for (const BodyProfile& body : creature.profile.bodies)
        volume += shapeVolume(body.shape);
    CHECK(creature.profile.totalMassKg == Approx(1000.0F * volume));
    for (const ConstraintProfile& c : creature.profile.constraints)
        CHECK(creature.profile.bodies[c.child].massKg > 0.09F * creature.profile.bodies[c.parent].massKg);
    FitOptions heavy = Creature::anyRig();
    heavy.weighByVolume = false;
    heavy.totalMassKg = 40.0F;
    const Creature other(heavy);
    CHECK(other.profile.totalMassKg == 40.0F);
    CHECK(massOf(other.profile, "ribs") / massOf(creature.profile, "ribs") ==
          Approx(40.0F / creature.profile.totalMassKg));
    FitOptions uniform = Creature::anyRig();
    uniform.massPreset = MassPreset::uniform;
    const Creature equal(uniform);
    CHECK(massOf(equal.profile, "tail4") == Approx(massOf(equal.profile, "ribs")));
}

TEST_CASE("the doctor says which checks are for humanoids only, and gives a creature no points for a map") {
    const Creature creature;
    const Diagnosis diagnosis = diagnose(creature.profile, creature.character, creature.map);
    CHECK_FALSE(diagnosis.hasErrors());
    CHECK(std::any_of(diagnosis.findings.begin(), diagnosis.findings.end(),
                      [](const Finding& finding) { return finding.code == "not-humanoid"; }));
    CHECK(std::none_of(diagnosis.findings.begin(), diagnosis.findings.end(),
                       [](const Finding& finding) { return finding.code == "role-unmapped"; }));
    CHECK(std::none_of(diagnosis.parts.begin(), diagnosis.parts.end(),
                       [](const ScorePart& part) { return part.name == "map"; }));
    CHECK(diagnosis.score > 80.0F);
}

TEST_CASE("the doctor finds and mends a creature's faults by the names of its bodies") {
    Creature creature;
    const int shin = bodyNamed(creature.profile, "shin_fore_l");
    const int paw = bodyNamed(creature.profile, "paw_hind_r");
    ConstraintProfile& knee = creature.profile.constraints[shin - 1];
    knee.parentFromFrame.rotation = knee.parentFromFrame.rotation * glm::angleAxis(1.5F, vec3(0, 0, 1));
    creature.profile.bodies[paw].shape.radius = 0.001F;
    const Diagnosis sick = diagnose(creature.profile, creature.character, creature.map);
    const auto has = [](const Diagnosis& diagnosis, const char* code, const char* body) {
        return std::any_of(diagnosis.findings.begin(), diagnosis.findings.end(), [&](const Finding& finding) {
            return finding.code == code && !finding.bodies.empty() && finding.bodies[0] == body;
        });
    };
    CHECK(has(sick, "bind-outside-limits", "shin_fore_l"));
    CHECK(has(sick, "body-tiny", "paw_hind_r"));
    const auto mended = applyMends(creature.profile, creature.character, creature.map, sick.findings);
    REQUIRE(mended);
    const Diagnosis well = diagnose(mended.value(), creature.character, creature.map);
    CHECK_FALSE(well.hasErrors());
    CHECK_FALSE(has(well, "body-tiny", "paw_hind_r"));
}

TEST_CASE("a creature's profile is bound by its joints to the same rig in another size") {
    const Creature creature;
    animation::Character twice = test::makeQuadruped();
    for (RigidTransform& joint : twice.skeleton.bindModelFromJoint)
        joint.translation *= 2.0F;
    for (vec3& position : twice.meshes[0].positions)
        position *= 2.0F;
    const auto bound = bindOrRebind(creature.profile, twice, creature.map);
    REQUIRE(bound);
    CHECK(bound.value().rebound);
    const RagdollProfile& large = bound.value().profile;
    REQUIRE(large.bodies.size() == creature.profile.bodies.size());
    for (const BodyProfile& body : large.bodies) {
        const int before = bodyNamed(creature.profile, body.name);
        REQUIRE(before >= 0);
        INFO(body.name);
        CHECK(body.shape.radius / creature.profile.bodies[before].shape.radius == Approx(2.0F).epsilon(0.1));
    }
    animation::Character other = test::makeFigure("other", {{"a", -1, {0, 0, 0}}}, {{0, {0, 1, 0}, 0.1F}});
    const auto refused = bindOrRebind(creature.profile, other, creature.map);
    REQUIRE_FALSE(refused);
    CHECK(refused.error().message.find("paw_fore_l") != std::string::npos);
}

TEST_CASE("bodies without a role merge by the tree alone") {
    const Creature creature;
    const LodProfile limbs = makeLodProfile(creature.profile, creature.rig, LodLevel::limbs);
    const LodProfile block = makeLodProfile(creature.profile, creature.rig, LodLevel::block);
    CHECK(validate(limbs.profile).empty());
    CHECK(validate(block.profile).empty());
    CHECK(limbs.profile.bodies.size() < creature.profile.bodies.size());
    CHECK(block.profile.bodies.size() < limbs.profile.bodies.size());
    const auto together = [&](const LodProfile& lod, const char* a, const char* b) {
        return lod.bodyOf[bodyNamed(creature.profile, a)] == lod.bodyOf[bodyNamed(creature.profile, b)];
    };
    CHECK(together(limbs, "paw_fore_l", "shin_fore_l"));
    CHECK_FALSE(together(limbs, "shin_fore_l", "thigh_fore_l"));
    CHECK(together(block, "paw_fore_l", "thigh_fore_l"));
    CHECK_FALSE(together(block, "thigh_fore_l", "ribs"));
    float mass = 0.0F;
    for (const BodyProfile& body : block.profile.bodies)
        mass += body.massKg;
    CHECK(mass == Approx(creature.profile.totalMassKg));
}

TEST_CASE("appendages become bodies on the part that they hang on, and the humanoid stays what it is") {
    const animation::Character figure = test::makeBipedWithAppendages();
    const animation::HumanoidMap map = test::mapOfBiped(figure);
    FitOptions options;
    options.appendages = {animation::AppendageKind::tail, animation::AppendageKind::weapon};
    const auto fitted = fitRagdoll(figure, map, options);
    REQUIRE(fitted);
    const RagdollProfile& profile = fitted.value();
    CHECK(validate(profile).empty());
    const auto parentOf = [&](const char* name) {
        const int body = bodyNamed(profile, name);
        REQUIRE(body > 0);
        return profile.bodies[profile.constraints[body - 1].parent].name;
    };
    CHECK(parentOf("tail_01") == "hips");
    CHECK(parentOf("tail_02") == "tail_01");
    CHECK(parentOf("sword") == "rightHand");
    CHECK(bodyNamed(profile, "ponytail1") < 0);
    CHECK(profile.totalMassKg == 75.0F);
    CHECK_FALSE(diagnose(profile, figure, map).hasErrors());
    REQUIRE(bindRig(profile, figure.skeleton));
    // A blade hardly moves in the hand.
    CHECK(profile.constraints[bodyNamed(profile, "sword") - 1].cone.swingZ == Approx(radians(10.0F)));
    const auto plain = fitRagdoll(figure, map);
    REQUIRE(plain);
    REQUIRE(plain.value().bodies.size() == 16);
    for (std::size_t i = 0; i < 16; ++i) {
        INFO(plain.value().bodies[i].name);
        CHECK(profile.bodies[i].name == plain.value().bodies[i].name);
        // Both hands are fitted as one, and the sword's skin was the right one's.
        if (profile.bodies[i].role == Role::hips || isEitherSide(profile.bodies[i].role, Role::leftHand)) continue;
        CHECK(profile.bodies[i].shape.radius == plain.value().bodies[i].shape.radius);
    }
}

TEST_CASE("an appendage that hangs on the root of the file is a body on the part that it lies at") {
    animation::Character figure = test::makeBipedWithAppendages();
    animation::HumanoidMap map = test::mapOfBiped(figure);
    test::addRoot(figure, map);
    animation::Skeleton& skeleton = figure.skeleton;
    skeleton.parents[static_cast<std::size_t>(animation::findJoint(skeleton, "ponytail1"))] = 0;
    FitOptions options;
    options.appendages = {animation::AppendageKind::hair};
    const RagdollProfile profile = fitRagdoll(figure, map, options).value();
    const int hair = bodyNamed(profile, "ponytail1");
    REQUIRE(hair > 0);
    CHECK(
        profile.bodies[static_cast<std::size_t>(profile.constraints[static_cast<std::size_t>(hair - 1)].parent)].name ==
        "head");
}

TEST_CASE("a rig without a joint and a map without roles are refused in words") {
    const auto nothing = fitRagdoll(animation::Character{}, {}, Creature::anyRig());
    REQUIRE_FALSE(nothing);
    CHECK(nothing.error().code == ErrorCode::input);
    const auto refused = fitRagdoll(test::makeQuadruped(), {});
    REQUIRE_FALSE(refused);
    CHECK(refused.error().mend.find("--rig any") != std::string::npos);
}
