#include "physics/fit/fit_ragdoll.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "animation/humanoid/map_humanoid.hpp"
#include "support/catch.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using namespace lutka::physics;

namespace {

RagdollProfile fitBiped(const FitOptions& options = {}) {
    const auto biped = test::makeBiped();
    Result<RagdollProfile> fitted = fitRagdoll(biped, test::mapOfBiped(biped), options);
    REQUIRE(fitted);
    CHECK(validate(fitted.value()).empty());
    return std::move(fitted).value();
}

RigidTransform modelFromBody(const animation::Character& character, const BodyProfile& body) {
    return character.skeleton.bindModelFromJoint[findJoint(character.skeleton, body.joint)] * body.jointFromBody;
}

}  // namespace

TEST_CASE("the biped gets sixteen bodies with the hips first") {
    const RagdollProfile profile = fitBiped();
    CHECK(profile.bodies.size() == 16);
    CHECK(profile.bodies[0].role == Role::hips);
    CHECK(profile.heightM == Approx(1.75).margin(0.05));
    CHECK(profile.notes.empty());
    CHECK(profile.filteredPairs.empty());
}

TEST_CASE("capsules lie in the tubes that the biped's skin is made of") {
    const auto biped = test::makeBiped();
    const RagdollProfile profile = fitBiped();
    struct Tube {
        Role role;
        float radius;
        vec3 axis;
    };
    for (const Tube& tube : {Tube{Role::leftUpperArm, 0.05F, {1, 0, 0}}, Tube{Role::leftLowerArm, 0.04F, {1, 0, 0}},
                             Tube{Role::rightHand, 0.03F, {1, 0, 0}}, Tube{Role::leftUpperLeg, 0.08F, {0, 1, 0}},
                             Tube{Role::rightLowerLeg, 0.055F, {0, 1, 0}}, Tube{Role::leftFoot, 0.04F, {0, 0, 1}},
                             Tube{Role::head, 0.09F, {0, 1, 0}}, Tube{Role::chest, 0.15F, {0, 1, 0}}}) {
        const BodyProfile& body = profile.bodies[bodyOf(profile, tube.role)];
        INFO(roleName(tube.role));
        CHECK(body.shape.kind == BodyShape::Kind::capsule);
        // A cap leaves the corners of a tube's flat ends bare: the shorter the tube, the wider its capsule.
        CHECK(body.shape.radius == Approx(tube.radius).epsilon(0.12));
        const vec3 axis = modelFromBody(biped, body).rotation * vec3(0, 1, 0);
        CHECK(std::abs(glm::dot(axis, tube.axis)) > 0.99F);
    }
}

TEST_CASE("both sides of a symmetric figure are mirror images") {
    const auto biped = test::makeBiped();
    const RagdollProfile profile = fitBiped();
    for (const BodyProfile& body : profile.bodies) {
        const BodyProfile& other = profile.bodies[bodyOf(profile, mirrored(body.role.value()))];
        CHECK(body.shape.radius == other.shape.radius);
        CHECK(body.shape.halfLength == Approx(other.shape.halfLength).epsilon(1e-6));
        const vec3 here = modelFromBody(biped, body).translation;
        const vec3 there = modelFromBody(biped, other).translation;
        CHECK(glm::distance(here * vec3(-1, 1, 1), there) < 1e-5F);
    }
}

TEST_CASE("options add bodies for clavicles, neck and the whole trunk") {
    FitOptions options;
    options.shoulderBodies = options.neckBody = options.allTrunkBodies = options.toeBodies = true;
    const RagdollProfile profile = fitBiped(options);
    CHECK(profile.bodies.size() == 19);  // the biped has no toes and no upper chest
    CHECK(bodyOf(profile, Role::neck) >= 0);
    const int arm = bodyOf(profile, Role::rightUpperArm);
    CHECK(profile.bodies[profile.constraints[arm - 1].parent].role == Role::rightShoulder);
}

TEST_CASE("the head's shape is that of the skull, with or without tails of hair") {
    animation::Character biped = test::makeBiped();
    const auto radiusOfHead = [&] {
        const auto fitted = fitRagdoll(biped, test::mapOfBiped(biped), {});
        REQUIRE(fitted);
        const BodyShape& shape = fitted.value().bodies[bodyOf(fitted.value(), Role::head)].shape;
        return vec2(shape.radius, shape.halfLength);
    };
    const vec2 bare = radiusOfHead();
    animation::Skeleton& skeleton = biped.skeleton;
    const int head = findJoint(skeleton, biped.skeleton.names[test::mapOfBiped(biped).jointOf(Role::head)]);
    animation::SkinnedMesh& mesh = biped.meshes[0];
    for (const float side : {1.0F, -1.0F}) {
        const vec3 root = skeleton.bindModelFromJoint[head].translation + vec3(0.12F * side, 0.1F, 0);
        skeleton.names.emplace_back(side > 0 ? "hair.L" : "hair.R");
        skeleton.parents.push_back(head);
        skeleton.bindModelFromJoint.push_back({quat(1, 0, 0, 0), root});
        skeleton.nodeParentFromJoint.emplace_back();
        skeleton.skinWeight.push_back(400.0F);
        for (int ring = 0; ring < 40; ++ring) {
            const auto first = static_cast<std::uint32_t>(mesh.positions.size());
            for (int corner = 0; corner < 8; ++corner) {
                const float angle = 0.25F * kPi * static_cast<float>(corner);
                mesh.positions.push_back(root + vec3(0.2F * side + 0.04F * std::cos(angle),
                                                     -0.02F * static_cast<float>(ring), 0.04F * std::sin(angle)));
                mesh.normals.emplace_back(std::cos(angle), 0, std::sin(angle));
                mesh.joints.push_back({static_cast<std::uint16_t>(skeleton.jointCount() - 1)});
                mesh.weights.push_back({1.0F});
            }
            for (std::uint32_t corner = 0; corner < 8 && ring > 0; ++corner) {
                const std::uint32_t next = (corner + 1) % 8;
                for (const std::uint32_t index : {corner, next, next - 8U, corner, next - 8U, corner - 8U})
                    mesh.indices.push_back(first + index);
            }
        }
    }
    if (!mesh.uvs.empty()) mesh.uvs.resize(mesh.positions.size());
    mesh.fileOrder.clear();
    const vec2 tailed = radiusOfHead();
    CHECK(tailed.x == Approx(bare.x).epsilon(0.02));
    CHECK(tailed.y == Approx(bare.y).margin(0.01));
}

TEST_CASE("the head's shape is that of the skull, whatever is modelled as a piece of its own on the same joint") {
    const auto shapeOfHead = [](const animation::Character& biped) {
        const auto fitted = fitRagdoll(biped, test::mapOfBiped(biped), {});
        REQUIRE(fitted);
        const BodyShape& shape = fitted.value().bodies[bodyOf(fitted.value(), Role::head)].shape;
        return vec2(shape.radius, shape.halfLength);
    };
    const vec2 bare = shapeOfHead(test::makeBiped());
    // Ways of tubes from the head's joint on: horns, a top hat, a plait down the back.
    const std::vector<std::vector<std::pair<vec3, vec3>>> things = {
        {{vec3(0.07F, 0.2F, 0), vec3(0.35F, 0.7F, 0)}, {vec3(-0.07F, 0.2F, 0), vec3(-0.35F, 0.7F, 0)}},
        {{vec3(0, 0.2F, 0), vec3(0, 0.8F, 0)}},
        {{vec3(0, 0.15F, -0.1F), vec3(0, -0.7F, -0.3F)}}};
    for (const auto& ways : things) {
        animation::Character biped = test::makeBiped();
        const int head = test::mapOfBiped(biped).jointOf(Role::head);
        const vec3 place = biped.skeleton.bindModelFromJoint[head].translation;
        animation::SkinnedMesh& mesh = biped.meshes[0];
        for (const auto& [from, to] : ways) {
            constexpr std::uint32_t kRings = 12;
            const auto first = static_cast<std::uint32_t>(mesh.positions.size());
            for (std::uint32_t i = 0; i < 8 * kRings; ++i) {
                const float angle = 0.25F * kPi * static_cast<float>(i % 8);
                const vec3 out(std::cos(angle), 0, std::sin(angle));
                const float along = static_cast<float>(i / 8) / static_cast<float>(kRings - 1);
                mesh.positions.push_back(place + glm::mix(from, to, along) + 0.06F * out);
                mesh.normals.push_back(out);
                mesh.joints.push_back({static_cast<std::uint16_t>(head)});
                mesh.weights.push_back({1.0F});
                if (i < 8) continue;
                const std::uint32_t next = i - i % 8 + (i + 1) % 8;
                for (const std::uint32_t index : {i, next, next - 8U, i, next - 8U, i - 8U})
                    mesh.indices.push_back(first + index);
            }
        }
        mesh.uvs.clear();
        mesh.tangents.clear();
        mesh.fileOrder.clear();
        const vec2 shape = shapeOfHead(biped);
        CHECK(shape.x == Approx(bare.x).epsilon(0.15));
        CHECK(shape.y == Approx(bare.y).margin(0.03));
    }
}

TEST_CASE("a head whose skin hangs on the neck's joint is as large as that skin") {
    animation::Character biped = test::makeBiped();
    const animation::HumanoidMap map = test::mapOfBiped(biped);
    const auto radiusOfHead = [&] {
        const auto fitted = fitRagdoll(biped, map, {});
        REQUIRE(fitted);
        return fitted.value().bodies[bodyOf(fitted.value(), Role::head)].shape.radius;
    };
    const float bare = radiusOfHead();
    const auto head = static_cast<std::uint16_t>(map.jointOf(Role::head));
    const auto neck = static_cast<std::uint16_t>(map.jointOf(Role::neck));
    animation::SkinnedMesh& mesh = biped.meshes[0];
    for (std::size_t vertex = 0; vertex < mesh.joints.size(); ++vertex) {
        if (vertex % 6 != 0 && mesh.joints[vertex][0] == head) mesh.joints[vertex][0] = neck;
    }
    CHECK(radiusOfHead() == Approx(bare).epsilon(0.05));
}

TEST_CASE("missing roles give fewer bodies, hung on the nearest body above") {
    const auto biped = test::makeBiped();
    auto map = test::mapOfBiped(biped);
    for (const Role role : {Role::leftHand, Role::rightHand, Role::chest, Role::neck, Role::leftFoot, Role::rightFoot})
        map.roles[animation::indexOf(role)].reset();
    const auto fitted = fitRagdoll(biped, map);
    REQUIRE(fitted);
    const RagdollProfile& profile = fitted.value();
    CHECK(profile.bodies.size() == 11);
    CHECK(profile.bodies[profile.constraints[bodyOf(profile, Role::leftUpperArm) - 1].parent].role == Role::spine);
    // The forearm takes over the hand's skin and mass.
    const BodyProfile& forearm = profile.bodies[bodyOf(profile, Role::leftLowerArm)];
    CHECK(forearm.massKg == Approx(75.0F * (0.0162F + 0.0061F)).epsilon(1e-3));
    CHECK(2.0F * (forearm.shape.halfLength + forearm.shape.radius) > 0.4F);
}

TEST_CASE("a figure without a skin gets a man's proportions") {
    auto biped = test::makeBiped();
    const auto map = test::mapOfBiped(biped);
    biped.meshes.clear();
    const auto fitted = fitRagdoll(biped, map);
    REQUIRE(fitted);
    const RagdollProfile& profile = fitted.value();
    CHECK(profile.bodies.size() == 16);
    CHECK(profile.heightM == Approx(1.75).epsilon(0.05));
    for (const BodyProfile& body : profile.bodies) {
        INFO(body.name);
        CHECK(body.shape.radius > 0.01F * profile.heightM);
        CHECK(body.shape.radius < 0.1F * profile.heightM);
    }
}

namespace {

void addJoint(animation::Skeleton& skeleton, int parent, const vec3& beside) {
    const RigidTransform frame{quat(1, 0, 0, 0), beside};
    skeleton.names.push_back("end of " + skeleton.names[parent]);
    skeleton.parents.push_back(parent);
    skeleton.bindModelFromJoint.push_back(skeleton.bindModelFromJoint[parent] * frame);
    skeleton.nodeParentFromJoint.push_back(frame);
    skeleton.skinWeight.push_back(0.0F);
}

float lengthOf(const RagdollProfile& profile, Role role) {
    const BodyShape& shape = profile.bodies[bodyOf(profile, role)].shape;
    return 2.0F * (shape.halfLength + shape.radius);
}

}  // namespace

TEST_CASE("a head and hands without a skin are as large as a man's, however short or long the file's last joints are") {
    auto biped = test::makeBiped();
    const auto map = test::mapOfBiped(biped);
    biped.meshes.clear();
    for (const Role role : {Role::leftHand, Role::rightHand})  // stubs of fingers
        addJoint(biped.skeleton, map.jointOf(role), {0.01F, 0.02F, 0.03F});
    SECTION("an eye") {
        addJoint(biped.skeleton, map.jointOf(Role::head), {0.03F, 0.05F, 0.06F});
    }
    SECTION("a leaf far above") {
        addJoint(biped.skeleton, map.jointOf(Role::head), {0, 0.9F, 0});
    }
    const RagdollProfile profile = fitRagdoll(biped, map).value();
    CHECK(lengthOf(profile, Role::head) > 0.12F * profile.heightM);
    CHECK(lengthOf(profile, Role::head) < 0.2F * profile.heightM);
    CHECK(profile.bodies[bodyOf(profile, Role::head)].shape.radius > 0.035F * profile.heightM);
    CHECK(lengthOf(profile, Role::leftHand) > 0.08F * profile.heightM);
}

TEST_CASE("a trunk without a head reaches to the crown, and is as wide as its skin") {
    auto biped = test::makeBiped();
    auto map = test::mapOfBiped(biped);
    std::vector<int> trunk{map.jointOf(Role::hips)};
    for (const Role role : {Role::spine, Role::chest, Role::neck, Role::head}) {
        trunk.push_back(map.jointOf(role));
        map.roles[animation::indexOf(role)].reset();
    }
    const bool isEgg = GENERATE(false, true);
    float widest = 0.0F;
    animation::SkinnedMesh& mesh = biped.meshes[0];
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        if (std::find(trunk.begin(), trunk.end(), mesh.joints[i][0]) == trunk.end()) continue;
        if (isEgg) mesh.positions[i] = {4.0F * mesh.positions[i].x, mesh.positions[i].y, 4.0F * mesh.positions[i].z};
        widest = std::max(widest, mesh.positions[i].x);
    }
    const RagdollProfile profile = fitRagdoll(biped, map).value();
    const BodyProfile& hips = profile.bodies[bodyOf(profile, Role::hips)];
    const vec3 middle = biped.skeleton.bindModelFromJoint[map.jointOf(Role::hips)] * hips.jointFromBody.translation;
    CHECK(middle.y + 0.5F * lengthOf(profile, Role::hips) > 0.92F * profile.heightM);
    CHECK(hips.shape.radius > 0.75F * widest);
}

TEST_CASE("hips that are a wide cup below a trunk are as wide as their skin") {
    auto biped = test::makeBiped();
    const auto map = test::mapOfBiped(biped);
    float widest = 0.0F;
    animation::SkinnedMesh& mesh = biped.meshes[0];
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const int joint = mesh.joints[i][0];
        if (joint != map.jointOf(Role::hips) && joint != map.jointOf(Role::spine)) continue;
        mesh.positions[i] = {4.0F * mesh.positions[i].x, mesh.positions[i].y, 4.0F * mesh.positions[i].z};
        if (joint == map.jointOf(Role::hips)) widest = std::max(widest, mesh.positions[i].x);
    }
    const RagdollProfile profile = fitRagdoll(biped, map).value();
    CHECK(0.5F * lengthOf(profile, Role::hips) > 0.8F * widest);
}

namespace {

// The biped turned and scaled as a whole, with the map that says so.
std::pair<animation::Character, animation::HumanoidMap> movedBiped(const quat& turn, float scale) {
    animation::Character biped = test::makeBiped();
    animation::HumanoidMap map = test::mapOfBiped(biped);
    map.standardFromModel = glm::conjugate(turn);
    for (RigidTransform& frame : biped.skeleton.bindModelFromJoint)
        frame = {turn * frame.rotation, turn * (scale * frame.translation)};
    for (vec3& position : biped.meshes[0].positions)
        position = turn * (scale * position);
    return {std::move(biped), std::move(map)};
}

}  // namespace

TEST_CASE("a turned or scaled figure gets the same ragdoll, turned or scaled") {
    const RagdollProfile expected = fitBiped();
    const quat lying = glm::angleAxis(kPi / 2, vec3(1, 0, 0));
    const quat oblique = glm::angleAxis(radians(37), vec3(0, 1, 0));
    for (const auto& [turn, scale] : {std::pair(lying, 1.0F), std::pair(oblique, 1.0F), std::pair(oblique, 3.0F),
                                      std::pair(quat(1, 0, 0, 0), 0.02F)}) {
        const auto [biped, map] = movedBiped(turn, scale);
        const RagdollProfile profile = fitRagdoll(biped, map).value();
        CHECK(profile.heightM == Approx(scale * expected.heightM).epsilon(1e-3));
        REQUIRE(profile.bodies.size() == expected.bodies.size());
        for (std::size_t i = 0; i < profile.bodies.size(); ++i) {
            INFO(profile.bodies[i].name << " at scale " << scale);
            const BodyProfile& body = profile.bodies[i];
            const BodyProfile& same = expected.bodies[i];
            CHECK(body.shape.radius == Approx(scale * same.shape.radius).epsilon(0.02));
            CHECK(body.shape.halfLength ==
                  Approx(scale * same.shape.halfLength).margin(0.1 * scale * same.shape.radius));
            CHECK(body.massKg == Approx(same.massKg));
            CHECK(glm::distance(body.jointFromBody.translation, scale * same.jointFromBody.translation) <
                  0.004F * profile.heightM);
        }
    }
}

TEST_CASE("joint friction grows with what hangs on the joint and with mass") {
    const RagdollProfile profile = fitBiped();
    FitOptions heavy;
    heavy.totalMassKg = 150.0F;
    const RagdollProfile heavier = fitBiped(heavy);
    const auto friction = [](const RagdollProfile& p, Role role) {
        return p.constraints[bodyOf(p, role) - 1].frictionNm;
    };
    // A hand of 0.4575 kg whose centre of mass lies 9 cm from the wrist.
    CHECK(friction(profile, Role::leftHand) == Approx(9.81 * 0.4575 * 0.09 / 40.0).epsilon(0.05));
    CHECK(friction(profile, Role::leftLowerArm) > friction(profile, Role::leftHand));
    CHECK(friction(profile, Role::leftUpperArm) > friction(profile, Role::leftLowerArm));
    CHECK(friction(profile, Role::leftUpperLeg) > 0.5F);
    CHECK(friction(profile, Role::leftUpperLeg) < 3.0F);
    for (const Role role : {Role::leftHand, Role::rightUpperLeg, Role::spine})
        CHECK(friction(heavier, role) == Approx(2.0F * friction(profile, role)).epsilon(1e-3));
}

TEST_CASE("bodies that cannot be told apart in the bind pose are filtered and slight overlaps are shrunk away") {
    // Thighs of 8 cm radius whose joints are 13 cm apart part when shrunk by a fifth; 6 cm apart they cannot.
    for (const auto& [apart, filtered] : {std::pair(0.13F, false), std::pair(0.06F, true)}) {
        animation::Character biped = test::makeBiped();
        const auto map = test::mapOfBiped(biped);
        for (const char* name : {"UpperLeg", "LowerLeg", "Foot"}) {
            for (const float side : {1.0F, -1.0F}) {
                const int joint = findJoint(biped.skeleton, (side > 0 ? "left" : "right") + std::string(name));
                const float shift = side * (0.5F * apart - 0.1F);
                biped.skeleton.bindModelFromJoint[joint].translation.x += shift;
                animation::SkinnedMesh& mesh = biped.meshes[0];
                for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
                    if (mesh.joints[v][0] == joint) mesh.positions[v].x += shift;
                }
            }
        }
        const RagdollProfile profile = fitRagdoll(biped, map).value();
        const std::pair thighs(bodyOf(profile, Role::leftUpperLeg), bodyOf(profile, Role::rightUpperLeg));
        const auto& pairs = profile.filteredPairs;
        CHECK((std::find(pairs.begin(), pairs.end(), thighs) != pairs.end()) == filtered);
        if (!filtered) CHECK(profile.bodies[thighs.first].shape.radius < 0.5F * apart);
    }
}

TEST_CASE("joints that all lie in one point give a valid ragdoll or an error, never a number that is none") {
    animation::Character biped = test::makeBiped();
    const auto map = test::mapOfBiped(biped);
    for (const bool skin : {true, false}) {
        for (RigidTransform& frame : biped.skeleton.bindModelFromJoint)
            frame.translation = vec3(0, 1, 0);
        if (!skin) biped.meshes.clear();
        const auto fitted = fitRagdoll(biped, map);
        if (fitted) CHECK(validate(fitted.value()).empty());
    }
}

TEST_CASE("a map without hips and a total mass of nothing are refused") {
    const auto biped = test::makeBiped();
    const auto refused = fitRagdoll(biped, {});
    REQUIRE_FALSE(refused);
    CHECK(refused.error().code == ErrorCode::input);
    FitOptions options;
    options.totalMassKg = 0.0F;
    CHECK_FALSE(fitRagdoll(biped, test::mapOfBiped(biped), options));
}

TEST_CASE("a block that hangs behind its joint is lain along, not aslant from the joint") {
    constexpr float kBehind = -0.15F;
    const std::vector<test::JointSpec> joints{{"Body", -1, {0, 0.75F, 0}},        {"Head", 0, {0, 1.5F, 0}},
                                              {"Arm_Left", 0, {0.33F, 1.4F, 0}},  {"Arm_Right", 0, {-0.33F, 1.4F, 0}},
                                              {"Leg_Left", 0, {0.12F, 0.75F, 0}}, {"Leg_Right", 0, {-0.12F, 0.75F, 0}}};
    std::vector<test::TubeSpec> skin{{0, {0, 1.5F, 0}, 0.2F}, {1, {0, 1.9F, 0}, 0.2F}};
    for (const int joint : {2, 3, 4, 5})
        skin.push_back({joint, joints[static_cast<std::size_t>(joint)].position - vec3(0, 0.72F, 0), 0.1F});
    animation::Character figure = test::makeFigure("blocks", joints, skin);
    for (animation::SkinnedMesh& mesh : figure.meshes) {
        for (std::size_t vertex = 0; vertex < mesh.positions.size(); ++vertex) {
            if (mesh.joints[vertex][0] >= 4) mesh.positions[vertex].z += kBehind;
        }
    }
    const animation::HumanoidMap map = animation::mapHumanoid(figure);
    REQUIRE(map.humanoid);
    const RagdollProfile profile = fitRagdoll(figure, map, {}).value();
    for (const BodyProfile& body : profile.bodies) {
        if (body.role != Role::leftUpperLeg && body.role != Role::rightUpperLeg) continue;
        const RigidTransform placed = modelFromBody(figure, body);
        CHECK(std::abs((placed.rotation * vec3(0, 1, 0)).y) > 0.995F);
        CHECK(placed.translation.z == Approx(kBehind).margin(0.03));
        CHECK(placed.translation.y - body.shape.halfLength - body.shape.radius < 0.12F);
    }
}

TEST_CASE("a limb of one joint is as long as its skin, however long that is") {
    const std::vector<test::JointSpec> joints{{"Body", -1, {0, 0.9F, 0}},        {"Head", 0, {0, 1.5F, 0}},
                                              {"Arm_Left", 0, {0.3F, 1.42F, 0}}, {"Arm_Right", 0, {-0.3F, 1.42F, 0}},
                                              {"Leg_Left", 0, {0.1F, 0.9F, 0}},  {"Leg_Right", 0, {-0.1F, 0.9F, 0}}};
    std::vector<test::TubeSpec> skin{{0, {0, 1.5F, 0}, 0.2F}, {1, {0, 1.75F, 0}, 0.15F}};
    for (const int joint : {2, 3, 4, 5}) {
        const vec3& place = joints[static_cast<std::size_t>(joint)].position;
        skin.push_back({joint, {place.x, joint < 4 ? 0.5F : 0.0F, 0}, 0.08F});
    }
    const animation::Character figure = test::makeFigure("long", joints, skin);
    const animation::HumanoidMap map = animation::mapHumanoid(figure);
    REQUIRE(map.humanoid);
    const RagdollProfile profile = fitRagdoll(figure, map, {}).value();
    int limbs = 0;
    for (const BodyProfile& body : profile.bodies) {
        const bool arm = body.role == Role::leftUpperArm || body.role == Role::rightUpperArm;
        if (!arm && body.role != Role::leftUpperLeg && body.role != Role::rightUpperLeg) continue;
        const RigidTransform placed = modelFromBody(figure, body);
        CHECK(placed.translation.y - body.shape.halfLength - body.shape.radius < (arm ? 0.6F : 0.12F));
        ++limbs;
    }
    CHECK(limbs == 4);
}

TEST_CASE("a weapon that an arm holds makes no arm thicker") {
    const auto armOf = [](bool armed) {
        std::vector<test::JointSpec> joints{{"Body", -1, {0, 0.75F, 0}},        {"Head", 0, {0, 1.5F, 0}},
                                            {"Arm_Left", 0, {0.33F, 1.4F, 0}},  {"Arm_Right", 0, {-0.33F, 1.4F, 0}},
                                            {"Leg_Left", 0, {0.12F, 0.75F, 0}}, {"Leg_Right", 0, {-0.12F, 0.75F, 0}},
                                            {"bow", 3, {-0.33F, 0.75F, 0.1F}}};
        std::vector<test::TubeSpec> skin{{0, {0, 1.5F, 0}, 0.2F}, {1, {0, 1.9F, 0}, 0.2F}};
        for (const int joint : {2, 3, 4, 5})
            skin.push_back({joint, joints[static_cast<std::size_t>(joint)].position - vec3(0, 0.7F, 0), 0.07F});
        if (armed) skin.push_back({6, {-0.33F, 0.9F, 0.7F}, 0.25F});
        const animation::Character figure = test::makeFigure("archer", joints, skin);
        const animation::HumanoidMap map = animation::mapHumanoid(figure);
        REQUIRE(map.humanoid);
        const RagdollProfile profile = fitRagdoll(figure, map, {}).value();
        for (const BodyProfile& body : profile.bodies) {
            if (body.role == Role::rightUpperArm) return body.shape;
        }
        FAIL("no right arm");
        return BodyShape{};
    };
    const BodyShape armed = armOf(true);
    const BodyShape unarmed = armOf(false);
    CHECK(armed.radius == Approx(unarmed.radius).margin(0.005));
    CHECK(armed.halfLength == Approx(unarmed.halfLength).margin(0.01));
}

TEST_CASE("a head whose joint moves less of every vertex than the body does counts to the height") {
    const std::vector<test::JointSpec> joints{{"Body", -1, {0, 0.75F, 0}},        {"Head", 0, {0, 1.5F, 0}},
                                              {"Arm_Left", 0, {0.33F, 1.4F, 0}},  {"Arm_Right", 0, {-0.33F, 1.4F, 0}},
                                              {"Leg_Left", 0, {0.12F, 0.75F, 0}}, {"Leg_Right", 0, {-0.12F, 0.75F, 0}}};
    std::vector<test::TubeSpec> skin{{0, {0, 1.5F, 0}, 0.2F}, {1, {0, 2.1F, 0}, 0.2F}};
    for (const int joint : {2, 3, 4, 5})
        skin.push_back({joint, joints[static_cast<std::size_t>(joint)].position - vec3(0, 0.75F, 0), 0.1F});
    animation::Character figure = test::makeFigure("blocks", joints, skin);
    for (animation::SkinnedMesh& mesh : figure.meshes) {
        for (std::size_t vertex = 0; vertex < mesh.positions.size(); ++vertex) {
            if (mesh.joints[vertex][0] != 1) continue;
            mesh.joints[vertex] = {0, 1, 0, 0};
            mesh.weights[vertex] = {0.6F, 0.4F, 0, 0};
        }
    }
    const animation::HumanoidMap map = animation::mapHumanoid(figure);
    REQUIRE(map.humanoid);
    CHECK(fitRagdoll(figure, map, {}).value().heightM == Approx(2.1).margin(0.1));
}
