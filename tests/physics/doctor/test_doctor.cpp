#include "physics/doctor/doctor.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "animation/humanoid/map_humanoid.hpp"
#include "physics/collision/shape.hpp"
#include "physics/fit/fit_ragdoll.hpp"
#include "physics/fit/rebind.hpp"
#include "physics/profile/joint_range.hpp"
#include "support/catch.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using namespace lutka::physics;

namespace {

struct Patient {
    animation::Character character = test::makeBiped();
    animation::HumanoidMap map = test::mapOfBiped(character);
    RagdollProfile profile = fitRagdoll(character, map).value();

    [[nodiscard]] Diagnosis look() const { return diagnose(profile, character, map); }
    BodyProfile& body(Role role) { return profile.bodies[bodyOf(profile, role)]; }
    ConstraintProfile& constraint(Role child) { return profile.constraints[bodyOf(profile, child) - 1]; }
};

const Finding* find(const Diagnosis& diagnosis, const std::string& code) {
    for (const Finding& finding : diagnosis.findings) {
        if (finding.code == code) return &finding;
    }
    return nullptr;
}

// Turns the hinge's frames half about x, so that flexion becomes its opposite.
void reverse(ConstraintProfile& c) {
    const quat half = glm::angleAxis(kPi, vec3(1, 0, 0));
    c.parentFromFrame.rotation = c.parentFromFrame.rotation * half;
    c.childFromFrame.rotation = c.childFromFrame.rotation * half;
    c.hinge = {-c.hinge.upper, -c.hinge.lower};
}

struct Illness {
    const char* code;
    Severity severity;
    const char* place;
    void (*infect)(Patient&);
};

const std::vector<Illness>& mendableIllnesses() {
    static const std::vector<Illness> illnesses = {
        {"limit-impossible", Severity::error, "leftLowerLeg on leftUpperLeg",
         [](Patient& p) {
             ConstraintProfile& knee = p.constraint(Role::leftLowerLeg);
             const auto shapes = shapesInBindPose(p.profile, p.character.skeleton);
             const BindFrames bind{shapes[knee.parent].standardFromBody, shapes[knee.child].standardFromBody};
             JointRange range = jointRange(knee, bind);
             range.flexion.low = radians(-271.0F);
             setJointRange(knee, range, bind);
         }},
        {"mass-ratio", Severity::error, "leftHand on leftLowerArm",
         [](Patient& p) {
             p.body(Role::hips).massKg += p.body(Role::leftHand).massKg - 0.01F;
             p.body(Role::leftHand).massKg = 0.01F;
         }},
        {"bind-outside-limits", Severity::error, "rightUpperArm on chest",
         [](Patient& p) { p.constraint(Role::rightUpperArm).cone.swingY = radians(10); }},
        {"bind-outside-limits", Severity::error, "leftLowerLeg on leftUpperLeg",
         [](Patient& p) { p.constraint(Role::leftLowerLeg).hinge.lower = radians(-20); }},
        {"hinge-reversed", Severity::error, "leftLowerLeg on leftUpperLeg",
         [](Patient& p) { reverse(p.constraint(Role::leftLowerLeg)); }},
        {"overlap", Severity::error, "leftUpperLeg and rightUpperLeg",
         [](Patient& p) {
             for (const Role role : {Role::leftUpperLeg, Role::rightUpperLeg})
                 p.body(role).shape.radius = 0.13F;
         }},
        {"capsule-outside-skin", Severity::warning, "leftLowerArm",
         [](Patient& p) { p.body(Role::leftLowerArm).shape.radius = 0.1F; }},
        {"skin-not-covered", Severity::warning, "chest", [](Patient& p) { p.body(Role::chest).shape.radius = 0.05F; }},
        {"sides-differ", Severity::warning, "leftLowerLeg and rightLowerLeg",
         [](Patient& p) { p.body(Role::leftLowerLeg).shape.radius *= 1.15F; }},
        {"body-tiny", Severity::warning, "leftHand", [](Patient& p) { p.body(Role::leftHand).shape.radius = 0.005F; }},
        {"body-huge", Severity::warning, "head", [](Patient& p) { p.body(Role::head).shape.radius = 0.7F; }},
    };
    return illnesses;
}

}  // namespace

TEST_CASE("the doctor finds nothing on a fitted biped") {
    const Diagnosis diagnosis = Patient{}.look();
    for (const Finding& finding : diagnosis.findings)
        FAIL_CHECK(finding.code + " at " + finding.place + ": " + finding.measure);
    CHECK_FALSE(diagnosis.hasErrors());
    CHECK(diagnosis.score > 90.0F);
    CHECK(diagnosis.fit.vertices > 1000);
    CHECK(diagnosis.fit.skinNear > 0.85F);
    REQUIRE(diagnosis.fit.volumeCovered);
    CHECK(*diagnosis.fit.volumeCovered > 0.85F);
    CHECK(*diagnosis.fit.volumeCovered <= 1.0F);
    CHECK(diagnosis.fit.overlapM == 0.0F);
}

TEST_CASE("the doctor names each illness and its mend cures it") {
    for (const Illness& illness : mendableIllnesses()) {
        INFO(illness.code << " at " << illness.place);
        Patient patient;
        const float healthy = patient.look().score;
        illness.infect(patient);
        const Diagnosis ill = patient.look();
        const Finding* finding = find(ill, illness.code);
        REQUIRE(finding != nullptr);
        CHECK(finding->place == illness.place);
        CHECK(finding->severity == illness.severity);
        CHECK(finding->mendable);
        CHECK(ill.score < healthy + 1e-3F);
        if (illness.severity == Severity::error) CHECK(ill.hasErrors());
        const auto mended = applyMends(patient.profile, patient.character, patient.map, ill.findings);
        REQUIRE(mended);
        CHECK(validate(mended.value()).empty());
        CHECK(mended.value().notes.size() > patient.profile.notes.size());
        const Diagnosis after = diagnose(mended.value(), patient.character, patient.map);
        CHECK(find(after, illness.code) == nullptr);
        CHECK_FALSE(after.hasErrors());
    }
}

TEST_CASE("the doctor tells of roles without joints, narrow limits and degenerate chains") {
    Patient patient;
    patient.map.missing = {Role::leftHand};
    patient.constraint(Role::head).cone.twist = radians(2);
    const Diagnosis diagnosis = patient.look();
    REQUIRE(find(diagnosis, "role-unmapped") != nullptr);
    CHECK(find(diagnosis, "role-unmapped")->place == "leftHand");
    REQUIRE(find(diagnosis, "limit-span-small") != nullptr);
    CHECK(find(diagnosis, "limit-span-small")->measure.find("2.0 degrees") == 0);

    Patient folded;
    const int hand = findJoint(folded.character.skeleton, "leftHand");
    const int forearm = findJoint(folded.character.skeleton, "leftLowerArm");
    folded.character.skeleton.bindModelFromJoint[hand] = folded.character.skeleton.bindModelFromJoint[forearm];
    const Diagnosis chain = folded.look();
    REQUIRE(find(chain, "chain-degenerate") != nullptr);
    CHECK(find(chain, "chain-degenerate")->place == "leftHand on leftLowerArm");
}

TEST_CASE("the doctor tells of a role whose joint is not below its parent's") {
    Patient p;
    REQUIRE(find(p.look(), "joint-not-below") == nullptr);
    const int left = p.map.jointOf(Role::leftHand);
    p.map.roles[animation::indexOf(Role::leftHand)]->joint = p.map.jointOf(Role::rightHand);
    p.map.roles[animation::indexOf(Role::rightHand)]->joint = left;
    const Diagnosis diagnosis = p.look();
    const Finding* finding = find(diagnosis, "joint-not-below");
    REQUIRE(finding != nullptr);
    CHECK(finding->place == "leftHand on leftLowerArm");
    CHECK(finding->bodies == std::vector<std::string>{"leftHand"});
    CHECK_THAT(finding->measure, Catch::Contains("leftLowerArm"));
    CHECK(finding->severity == Severity::error);
    CHECK(diagnosis.score < 50.0F);
}

// No figure that is broken as a whole passes, however sound its limits and masses are.
void checkBroken(const Diagnosis& diagnosis, const std::string& code, const std::string& place) {
    const Finding* finding = find(diagnosis, code);
    REQUIRE(finding != nullptr);
    CHECK(finding->severity == Severity::error);
    CHECK(finding->place == place);
    CHECK(diagnosis.hasErrors());
    CHECK(diagnosis.score < 50.0F);
}

TEST_CASE("a limb that hangs beside its body on one side is an error, on both the rig's way of driving it") {
    const auto hang = [](Patient& p, const char* name) {
        p.character.skeleton.parents[findJoint(p.character.skeleton, name)] = findJoint(p.character.skeleton, "hips");
    };
    Patient p;
    hang(p, "leftFoot");
    checkBroken(p.look(), "joint-not-below", "leftFoot on leftLowerLeg");
    hang(p, "rightFoot");
    const Diagnosis both = p.look();
    REQUIRE(find(both, "joint-not-below") != nullptr);
    CHECK(find(both, "joint-not-below")->severity == Severity::warning);
    CHECK_FALSE(both.hasErrors());
}

TEST_CASE("a leg without the other may hang beside its body as those of such rigs do") {
    Patient p;
    p.character.skeleton.parents[findJoint(p.character.skeleton, "leftFoot")] = findJoint(p.character.skeleton, "hips");
    for (const Role role : {Role::rightUpperLeg, Role::rightLowerLeg, Role::rightFoot, Role::rightToes})
        p.map.roles[animation::indexOf(role)].reset();
    p.profile = fitRagdoll(p.character, p.map).value();
    const Diagnosis diagnosis = p.look();
    const Finding* finding = find(diagnosis, "joint-not-below");
    REQUIRE(finding != nullptr);
    CHECK(finding->place == "leftFoot on leftLowerLeg");
    CHECK(finding->severity == Severity::warning);
}

TEST_CASE("a trunk that carries its hips is the rig's way, hips that carry an arm are an error") {
    Patient p;
    animation::Skeleton& skeleton = p.character.skeleton;
    const int trunk = p.map.jointOf(Role::hips);
    const int hips = p.map.jointOf(Role::spine);
    skeleton.bindModelFromJoint[hips] = skeleton.bindModelFromJoint[trunk];
    for (const Role role : {Role::leftUpperLeg, Role::rightUpperLeg})
        skeleton.parents[p.map.jointOf(role)] = hips;
    skeleton.parents[p.map.jointOf(Role::chest)] = trunk;
    std::swap(p.map.roles[animation::indexOf(Role::hips)], p.map.roles[animation::indexOf(Role::spine)]);
    p.profile = fitRagdoll(p.character, p.map).value();
    const Diagnosis sound = p.look();
    REQUIRE(find(sound, "joint-not-below") != nullptr);
    CHECK(find(sound, "joint-not-below")->severity == Severity::warning);
    skeleton.parents[p.map.jointOf(Role::leftUpperArm)] = hips;
    const Diagnosis broken = p.look();
    REQUIRE(find(broken, "joint-not-below") != nullptr);
    CHECK(find(broken, "joint-not-below")->severity == Severity::error);
}

TEST_CASE("a head that the whole trunk hangs on is the rig's way") {
    std::vector<test::JointSpec> joints{
        {"head", -1, {0, 1.56F, 0}}, {"chest", 0, {0, 0.9F, 0}}, {"hips", 1, {0, 0.43F, 0}}};
    std::vector<test::TubeSpec> skin{{0, {0, 1.15F, 0}, 0.4F}, {1, {0, 0.5F, 0}, 0.12F}, {2, {0, 0.38F, 0}, 0.12F}};
    const auto add = [&](const std::string& name, int parent, const vec3& place, const vec3& end) {
        joints.push_back({name, parent, place});
        skin.push_back({static_cast<int>(joints.size()) - 1, end, 0.05F});
        return static_cast<int>(joints.size()) - 1;
    };
    for (const float side : {1.0F, -1.0F}) {
        const std::string end = side > 0.0F ? ".L" : ".R";
        const auto at = [&](float x, float y, float z = 0.0F) { return vec3(side * x, y, z); };
        const int arm = add("upperarm" + end, 1, at(0.12F, 0.85F), at(0.28F, 0.8F));
        add("hand" + end, add("forearm" + end, arm, at(0.29F, 0.8F), at(0.44F, 0.76F)), at(0.45F, 0.75F),
            at(0.55F, 0.7F));
        const int thigh = add("thigh" + end, 2, at(0.12F, 0.43F), at(0.15F, 0.26F));
        add("foot" + end, add("shin" + end, thigh, at(0.16F, 0.25F), at(0.19F, 0.06F)), at(0.2F, 0.05F),
            at(0.2F, 0.02F, 0.2F));
    }
    const animation::Character figure = test::makeFigure("figure", joints, skin);
    const animation::HumanoidMap map = animation::mapHumanoid(figure);
    REQUIRE(map.jointOf(Role::head) == 0);
    const Diagnosis diagnosis = diagnose(fitRagdoll(figure, map).value(), figure, map);
    REQUIRE(find(diagnosis, "joint-not-below") != nullptr);
    for (const Finding& finding : diagnosis.findings) {
        if (finding.code == "joint-not-below") CHECK(finding.severity == Severity::warning);
    }
}

TEST_CASE("a part that hangs below its own body, but through another limb, is an error") {
    Patient p;
    p.character.skeleton.parents[p.map.jointOf(Role::rightUpperArm)] = p.map.jointOf(Role::leftHand);
    checkBroken(p.look(), "joint-not-below", "rightUpperArm on chest");
}

TEST_CASE("the doctor certifies no figure with fewer than half of its parts") {
    Patient patient;
    const auto without = [&](Role role) {
        patient.map.roles[animation::indexOf(role)].reset();
        patient.map.missing.push_back(role);
    };
    for (const Role role : {Role::leftLowerArm, Role::rightLowerArm, Role::leftHand, Role::rightHand,
                            Role::leftLowerLeg, Role::rightLowerLeg, Role::leftFoot, Role::rightFoot})
        without(role);
    patient.profile = fitRagdoll(patient.character, patient.map).value();
    // A figure of blocks is whole; one without a head or an arm besides is not.
    CHECK(find(patient.look(), "roles-few") == nullptr);
    without(Role::head);
    patient.profile = fitRagdoll(patient.character, patient.map).value();
    const Diagnosis half = patient.look();
    REQUIRE(find(half, "roles-few") != nullptr);
    CHECK(find(half, "roles-few")->severity == Severity::error);
    CHECK(half.hasErrors());
    CHECK(half.score < 50.0F);
}

TEST_CASE("the doctor certifies no figure whose skin is elsewhere") {
    Patient patient;
    for (vec3& position : patient.character.meshes[0].positions)
        position += vec3(0, 0, 0.9F);
    checkBroken(patient.look(), "skin-outside-bodies", "/bodies");
    const auto fitted = fitRagdoll(patient.character, patient.map);
    if (fitted) CHECK(diagnose(fitted.value(), patient.character, patient.map).hasErrors());
}

TEST_CASE("the doctor certifies no figure whose skin is in another unit than its joints") {
    int looked = 0;
    for (const float unit : {0.001F, 0.01F, 0.3F, 10.0F}) {
        INFO(unit);
        Patient patient;
        for (vec3& position : patient.character.meshes[0].positions)
            position *= unit;
        const auto fitted = fitRagdoll(patient.character, patient.map);
        if (!fitted) continue;  // refused is right as well
        ++looked;
        patient.profile = fitted.value();
        const Diagnosis diagnosis = patient.look();
        CHECK(diagnosis.hasErrors());
        CHECK(diagnosis.score < 50.0F);
        if (unit < 1.0F) checkBroken(diagnosis, "skin-small", "/bodies");
    }
    CHECK(looked >= 2);
}

TEST_CASE("a boat that a figure stands in, however large, is no skin of a broken figure") {
    Patient patient;
    animation::SkinnedMesh& mesh = patient.character.meshes[0];
    const auto hips = static_cast<std::uint16_t>(findJoint(patient.character.skeleton, "hips"));
    for (int ring = 0; ring < 30; ++ring) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (int step = 0; step < 24; ++step) {
            const float angle = 2.0F * kPi * static_cast<float>(step) / 24.0F;
            mesh.positions.emplace_back(0.8F * std::cos(angle), 0.03F * static_cast<float>(ring),
                                        0.8F * std::sin(angle));
            mesh.normals.emplace_back(std::cos(angle), 0, std::sin(angle));
            mesh.uvs.emplace_back(0, 0);
            mesh.joints.push_back({hips, 0, 0, 0});
            mesh.weights.push_back({1, 0, 0, 0});
            const auto at = [&](int of, int row) {
                return first + static_cast<std::uint32_t>(of % 24) - static_cast<std::uint32_t>(24 * row);
            };
            if (ring == 0) continue;
            for (const std::uint32_t index :
                 {at(step, 1), at(step + 1, 1), at(step, 0), at(step + 1, 1), at(step + 1, 0), at(step, 0)})
                mesh.indices.push_back(index);
        }
    }
    patient.character.skeleton.skinWeight[hips] += 720.0F;
    patient.profile = fitRagdoll(test::makeBiped(), patient.map).value();
    CHECK(find(patient.look(), "skin-outside-bodies") == nullptr);
}

TEST_CASE("the doctor certifies no figure whose skin hangs on one joint") {
    Patient patient;
    const int hips = findJoint(patient.character.skeleton, "hips");
    for (auto& joints : patient.character.meshes[0].joints)
        joints = {static_cast<std::uint16_t>(hips), 0, 0, 0};
    for (auto& weights : patient.character.meshes[0].weights)
        weights = {1, 0, 0, 0};
    checkBroken(patient.look(), "skin-on-one-joint", "hips");
    patient.profile = fitRagdoll(patient.character, patient.map).value();
    checkBroken(patient.look(), "skin-on-one-joint", "hips");
}

TEST_CASE("the doctor certifies no figure whose arms or legs follow the trunk") {
    const bool arms = GENERATE(true, false);
    Patient patient;
    const animation::Skeleton& skeleton = patient.character.skeleton;
    const auto trunk = static_cast<std::uint16_t>(findJoint(skeleton, arms ? "chest" : "hips"));
    const std::array<Role, 2> limbs{arms ? Role::leftUpperArm : Role::leftUpperLeg,
                                    arms ? Role::rightUpperArm : Role::rightUpperLeg};
    for (auto& joints : patient.character.meshes[0].joints) {
        for (std::uint16_t& joint : joints) {
            for (const Role limb : limbs)
                if (isAncestorOrSelf(skeleton, patient.map.jointOf(limb), joint)) joint = trunk;
        }
    }
    patient.profile = fitRagdoll(patient.character, patient.map).value();
    checkBroken(patient.look(), "skin-of-others", "/bodies");
}

namespace {

// A rigid sword of 40 times the figure's vertices, so far from the right hand.
animation::SkinnedMesh denseSword(const animation::Character& character, const vec3& away) {
    animation::SkinnedMesh sword = character.meshes[0];
    sword.rigid = true;
    const auto hand = static_cast<std::uint16_t>(findJoint(character.skeleton, "rightHand"));
    const vec3 grip = character.skeleton.bindModelFromJoint[hand].translation;
    sword.positions.assign(40 * sword.positions.size(), grip + away);
    sword.normals.assign(sword.positions.size(), vec3(0, 1, 0));
    sword.uvs.assign(sword.positions.size(), vec2(0));
    sword.joints.assign(sword.positions.size(), {hand, 0, 0, 0});
    sword.weights.assign(sword.positions.size(), {1, 0, 0, 0});
    return sword;
}

}  // namespace

TEST_CASE("a dense sword in a hand is no skin on one joint") {
    Patient patient;
    patient.character.meshes.push_back(denseSword(patient.character, vec3(0)));
    CHECK(find(patient.look(), "skin-on-one-joint") == nullptr);
}

TEST_CASE("a dense sword in a hand is a fifth of the skin at most that is near its body or not") {
    Patient patient;
    const float without = patient.look().fit.skinNear;
    patient.character.meshes.push_back(denseSword(patient.character, vec3(0, 0.3F, 0.4F)));
    CHECK(patient.look().fit.skinNear == Approx(0.8F * without).epsilon(0.01F));
}

TEST_CASE("the doctor certifies no figure whose skin hangs on joints of other limbs") {
    Patient patient;
    const int count = patient.character.skeleton.jointCount();
    for (auto& joints : patient.character.meshes[0].joints) {
        for (std::uint16_t& joint : joints)
            joint = static_cast<std::uint16_t>((7 * joint + 5) % count);
    }
    checkBroken(patient.look(), "skin-outside-bodies", "/bodies");
    patient.profile = fitRagdoll(patient.character, patient.map).value();
    const Diagnosis fitted = patient.look();
    CHECK(fitted.hasErrors());
    CHECK(fitted.score < 50.0F);
}

TEST_CASE("the doctor certifies no head above its skull and no forearm in the air") {
    for (const Role role : {Role::head, Role::leftLowerArm}) {
        Patient patient;
        const vec3 away = role == Role::head ? vec3(0, 0.25F, 0) : vec3(0, 0, 0.4F);
        for (ConstraintProfile& c : patient.profile.constraints) {
            if (patient.profile.bodies[c.child].role == role) c.childFromFrame.translation -= away;
        }
        BodyProfile& body = patient.body(role);
        const int joint = findJoint(patient.character.skeleton, body.joint);
        const quat modelFromJoint = patient.character.skeleton.bindModelFromJoint[joint].rotation;
        body.jointFromBody.translation += glm::conjugate(modelFromJoint) * away;
        checkBroken(patient.look(), "body-beside-skin", std::string(roleName(role)));
    }
}

TEST_CASE("an invalid profile and one of another rig are told apart from a sick one") {
    Patient invalid;
    invalid.profile.bodies[3].massKg = -1;
    const Diagnosis first = invalid.look();
    CHECK(first.hasErrors());
    CHECK(find(first, "profile-invalid") != nullptr);
    CHECK_FALSE(applyMends(invalid.profile, invalid.character, invalid.map, first.findings));

    Patient stranger;
    stranger.profile.bodies[4].joint = stranger.profile.bodies[4].jointPath = "mixamorig:LeftArm";
    const Diagnosis second = stranger.look();
    REQUIRE(find(second, "joint-missing") != nullptr);
    CHECK(find(second, "joint-missing")->measure.find("mixamorig:LeftArm") != std::string::npos);
}

TEST_CASE("volume covered is the share that a shape of known size takes") {
    Patient patient;
    // Only the head is left of the skin, and a sphere of half its radius stands for all bodies.
    animation::SkinnedMesh& mesh = patient.character.meshes[0];
    const int head = findJoint(patient.character.skeleton, "head");
    std::vector<std::uint32_t> kept;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        if (mesh.joints[mesh.indices[i]][0] == head)
            kept.insert(kept.end(), mesh.indices.begin() + i, mesh.indices.begin() + i + 3);
    }
    // Close the tube's two ends, rings of twelve.
    const std::uint32_t first = *std::min_element(kept.begin(), kept.end());
    for (std::uint32_t k = 1; k + 1 < 12; ++k) {
        kept.insert(kept.end(), {first, first + k + 1, first + k});
        kept.insert(kept.end(), {first + 96, first + 96 + k, first + 96 + k + 1});
    }
    mesh.indices = kept;
    for (BodyProfile& body : patient.profile.bodies) {
        body.shape.kind = BodyShape::Kind::sphere;
        body.shape.radius = body.role == Role::head ? 0.045F : 0.001F;
        body.inertia = shapeInertia(body.shape, body.massKg);
    }
    const Diagnosis diagnosis = patient.look();
    REQUIRE(diagnosis.fit.volumeCovered);
    // The tube: seven rings of full radius and two frusta to half of it, each an eighth of the length; its section is a
    // regular twelve-sided polygon.
    const float length = 0.19F;
    const float section = 3.0F * 0.09F * 0.09F;
    const float tube = section * (0.75F * length + 0.25F * length * (1.0F + 0.5F + 0.25F) / 3.0F);
    const float ball = 4.0F / 3.0F * kPi * 0.045F * 0.045F * 0.045F;
    CHECK(*diagnosis.fit.volumeCovered == Approx(ball / tube).epsilon(0.1));
}

TEST_CASE("triangles far larger than the figure are measured as far as it reaches, or not at all") {
    const float sound = Patient().look().fit.volumeCovered.value();
    // A closed tetrahedron, of which one corner is so far away that a cell of the grid is less than a float can tell.
    const auto addTetrahedron = [](animation::SkinnedMesh& mesh, const std::array<vec3, 4>& corners) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(), corners.begin(), corners.end());
        mesh.normals.insert(mesh.normals.end(), 4, vec3(0, 1, 0));
        mesh.joints.insert(mesh.joints.end(), 4, mesh.joints[0]);
        mesh.weights.insert(mesh.weights.end(), 4, mesh.weights[0]);
        for (const std::uint32_t corner : {0U, 2U, 1U, 0U, 1U, 3U, 1U, 2U, 3U, 2U, 0U, 3U})
            mesh.indices.push_back(first + corner);
    };
    Patient spiked;
    addTetrahedron(spiked.character.meshes[0],
                   {vec3(3.0F, 0, 0), vec3(3.05F, 0, 0), vec3(3.0F, 0.05F, 0), vec3(3.0F, 0, 1e7F)});
    const auto covered = spiked.look().fit.volumeCovered;
    REQUIRE(covered);
    CHECK(*covered > 0.5F * sound);
    CHECK(*covered <= sound);

    Patient buried;
    for (int i = 0; i < 3000; ++i)
        addTetrahedron(buried.character.meshes[0],
                       {vec3(-90, -90, -90), vec3(90, -90, -90), vec3(0, 90, -90), vec3(0, 0, 90)});
    CHECK_FALSE(buried.look().fit.volumeCovered);
}
