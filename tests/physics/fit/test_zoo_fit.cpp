#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "animation/humanoid/map_humanoid.hpp"
#include "animation/import/import_character.hpp"
#include "core/swing_twist.hpp"
#include "physics/doctor/doctor.hpp"
#include "physics/fit/fit_ragdoll.hpp"
#include "physics/fit/rebind.hpp"
#include "support/catch.hpp"
#include "support/zoo.hpp"

using namespace lutka;
using namespace lutka::physics;

namespace {

struct Subject {
    std::string name;
    animation::Character character;
    animation::HumanoidMap map;
    RagdollProfile profile;
    std::vector<PlacedShape> bind;  // the bodies in the bind pose, in the standard stance's axes
};

Subject fitted(std::string name, animation::Character character) {
    Subject subject{std::move(name), std::move(character), {}, {}, {}};
    subject.map = animation::mapHumanoid(subject.character);
    if (!subject.map.humanoid) return subject;
    auto profile = fitRagdoll(subject.character, subject.map);
    INFO(subject.name);
    REQUIRE(profile);
    subject.profile = std::move(profile).value();
    subject.bind = shapesInBindPose(subject.profile, subject.character.skeleton);
    return subject;
}

// Every humanoid of the zoo that is read and mapped.
const std::vector<Subject>& subjects() {
    static const std::vector<Subject> all = [] {
        std::vector<Subject> result;
        std::vector<std::filesystem::path> folders;
        for (const auto& entry : std::filesystem::directory_iterator(LUTKA_ZOO_DIR))
            folders.push_back(entry.path());
        std::sort(folders.begin(), folders.end());
        for (const std::filesystem::path& folder : folders) {
            std::ifstream file(folder / "truth.json");
            if (!file) continue;
            const nlohmann::json truth = nlohmann::json::parse(file);
            if (truth["humanoid"] == false) continue;
            animation::ImportOptions options;
            options.loadTextures = false;
            auto character = importCharacter(folder / truth["file"].get<std::string>(), options);
            if (!character) continue;
            Subject subject = fitted(folder.filename().string(), std::move(character).value());
            if (subject.map.humanoid) result.push_back(std::move(subject));
        }
        return result;
    }();
    return all;
}

// The standard-space orientation of a constraint's child frame when it is turned from the neutral pose by `rotation`,
// its parent standing as in the bind pose.
quat childFrameAt(const Subject& subject, const ConstraintProfile& c, const quat& rotation) {
    return subject.bind[c.parent].standardFromBody.rotation * c.parentFromFrame.rotation * rotation;
}

vec3 limbAt(const Subject& subject, Role role, const quat& rotation) {
    const ConstraintProfile& c = subject.profile.constraints[bodyOf(subject.profile, role) - 1];
    return childFrameAt(subject, c, rotation) * vec3(1, 0, 0);
}

quat aboutZ(float angle) {
    return rotationOf({{0, 0, angle}, 0.0F});
}

const ConstraintProfile* hingeOf(const Subject& subject, Role role) {
    const int body = bodyOf(subject.profile, role);
    if (body < 1) return nullptr;
    const ConstraintProfile& c = subject.profile.constraints[body - 1];
    return c.kind == ConstraintProfile::Kind::hinge ? &c : nullptr;
}

// How far the segment's end moves when its hinge goes from one limit to the other, in lengths of the segment.
vec3 sweep(const Subject& subject, Role role) {
    const ConstraintProfile& c = *hingeOf(subject, role);
    return limbAt(subject, role, aboutZ(c.hinge.upper)) - limbAt(subject, role, aboutZ(c.hinge.lower));
}

}  // namespace

TEST_CASE("the bind pose of every humanoid of the zoo lies inside all limits of its ragdoll") {
    NEEDS_ZOO();
    REQUIRE(subjects().size() >= 20);
    for (const Subject& subject : subjects()) {
        INFO(subject.name);
        CHECK(validate(subject.profile).empty());
        for (const ConstraintProfile& c : subject.profile.constraints) {
            INFO(subject.profile.bodies[c.child].name);
            const RigidTransform& parent = subject.bind[c.parent].standardFromBody;
            const RigidTransform& child = subject.bind[c.child].standardFromBody;
            CHECK(glm::distance(parent * c.parentFromFrame.translation, child * c.childFromFrame.translation) <
                  1e-4F * subject.profile.heightM);
            const quat relative = glm::conjugate(parent.rotation * c.parentFromFrame.rotation) *
                                  (child.rotation * c.childFromFrame.rotation);
            if (c.kind == ConstraintProfile::Kind::hinge) {
                const SwingTwist off = swingTwist(relative);
                CHECK(std::abs(off.swing.y) + std::abs(off.twist) < 1e-2F);
                CHECK(off.swing.z >= c.hinge.lower);
                CHECK(off.swing.z <= c.hinge.upper);
            } else {
                const SwingTwist pose = swingTwist(relative);
                CHECK(std::hypot(pose.swing.y / c.cone.swingY, pose.swing.z / c.cone.swingZ) <= 1.0F);
                CHECK(std::abs(pose.twist) <= c.cone.twist);
            }
        }
    }
}

TEST_CASE("knees take the heel backwards and elbows the hand forwards or up on every humanoid of the zoo") {
    NEEDS_ZOO();
    for (const Subject& subject : subjects()) {
        INFO(subject.name);
        for (const Role knee : {Role::leftLowerLeg, Role::rightLowerLeg}) {
            if (hingeOf(subject, knee) == nullptr) continue;
            CHECK(sweep(subject, knee).z < -0.5F);
        }
        for (const Role elbow : {Role::leftLowerArm, Role::rightLowerArm}) {
            if (hingeOf(subject, elbow) == nullptr) continue;
            const vec3 moved = sweep(subject, elbow);
            CHECK(moved.z + moved.y > 0.5F);
            CHECK(moved.z > -0.2F);
        }
    }
}

TEST_CASE("a limb at the extension limit of its hinge is nearly straight on every humanoid of the zoo") {
    NEEDS_ZOO();
    for (const Subject& subject : subjects()) {
        INFO(subject.name);
        const BodyPlan plan = planBodies(subject.character, subject.map, FitOptions{});
        for (const Role role : {Role::leftLowerLeg, Role::rightLowerLeg, Role::leftLowerArm, Role::rightLowerArm}) {
            if (hingeOf(subject, role) == nullptr) continue;
            INFO(roleName(role));
            const ConstraintProfile& c = *hingeOf(subject, role);
            const vec3 upper = plan.bodies[c.parent].direction();
            const float bend = glm::dot(upper, limbAt(subject, role, aboutZ(c.hinge.lower)));
            CHECK(degrees(std::acos(std::min(bend, 1.0F))) < 20.0F);
        }
    }
}

TEST_CASE("hips, trunk, head and feet flex the way people do on every humanoid of the zoo") {
    NEEDS_ZOO();
    struct Way {
        Role role;
        vec3 direction;
    };
    for (const Subject& subject : subjects()) {
        for (const Way& way :
             {Way{Role::leftUpperLeg, {0, 0, 1}}, Way{Role::rightUpperLeg, {0, 0, 1}}, Way{Role::spine, {0, 0, 1}},
              Way{Role::head, {0, 0, 1}}, Way{Role::leftFoot, {0, 1, 0}}, Way{Role::rightFoot, {0, 1, 0}}}) {
            const int body = bodyOf(subject.profile, way.role);
            if (body < 1) continue;
            INFO(subject.name << ' ' << roleName(way.role));
            const ConeTwistLimits& cone = subject.profile.constraints[body - 1].cone;
            const vec3 moved =
                limbAt(subject, way.role, aboutZ(cone.swingZ)) - limbAt(subject, way.role, aboutZ(-cone.swingZ));
            CHECK(glm::dot(glm::normalize(moved), way.direction) > 0.7F);
        }
    }
}

TEST_CASE("in the neutral pose all frames agree and the figure crouches with its hands ahead") {
    NEEDS_ZOO();
    for (const Subject& subject : subjects()) {
        INFO(subject.name);
        std::vector<RigidTransform> pose{subject.bind[0].standardFromBody};
        for (const ConstraintProfile& c : subject.profile.constraints) {
            pose.push_back(pose[c.parent] * c.parentFromFrame * inverse(c.childFromFrame));
            const quat a = pose[c.parent].rotation * c.parentFromFrame.rotation;
            const quat b = pose[c.child].rotation * c.childFromFrame.rotation;
            CHECK(std::abs(glm::dot(a, b)) > 0.99999F);
        }
        const auto at = [&](Role role) { return pose[bodyOf(subject.profile, role)].translation; };
        const auto has = [&](Role role) { return bodyOf(subject.profile, role) >= 0; };
        for (const bool left : {true, false}) {
            const auto side = [left](Role role) { return left ? role : mirrored(role); };
            if (has(side(Role::leftLowerArm)) && has(side(Role::leftUpperArm)))
                CHECK(at(side(Role::leftLowerArm)).z > at(side(Role::leftUpperArm)).z);
            if (has(side(Role::leftUpperLeg))) CHECK(at(side(Role::leftUpperLeg)).z > at(Role::hips).z);
            if (has(side(Role::leftFoot))) CHECK(at(side(Role::leftFoot)).y < at(side(Role::leftUpperLeg)).y);
        }
        if (has(Role::head)) CHECK(at(Role::head).y > at(Role::hips).y);
    }
}

TEST_CASE("shapes of the zoo's humanoids lie near their skin and fill it") {
    NEEDS_ZOO();
    const std::vector<std::string> peopleOfUsualBuild = {"cesium_man_glb",    "godot_mannequiny",  "kenney_medium",
                                                         "makehuman_cmu_zup", "makehuman_default", "makehuman_mixamo",
                                                         "mesh2motion_human", "ozz_pab_skeleton",  "quaternius_man_fbx",
                                                         "rocketbox_male",    "sl_male_bento",     "ubiq_robot"};
    std::printf("%-32s %6s %5s %7s %8s %8s %6s %s\n", "model", "height", "near", "volume", "overlap", "filtered",
                "score", "findings");
    for (const Subject& subject : subjects()) {
        INFO(subject.name);
        const Diagnosis diagnosis = diagnose(subject.profile, subject.character, subject.map);
        std::string codes;
        for (const Finding& finding : diagnosis.findings) {
            if (finding.severity != Severity::info) codes += ' ' + finding.code;
        }
        std::printf("%-32s %6.3f %4.0f%% %6.0f%% %6.1fmm %8zu %6.0f%s\n", subject.name.c_str(),
                    static_cast<double>(subject.profile.heightM), 100.0 * static_cast<double>(diagnosis.fit.skinNear),
                    100.0 * static_cast<double>(diagnosis.fit.volumeCovered.value_or(0)),
                    1000.0 * static_cast<double>(diagnosis.fit.overlapM), subject.profile.filteredPairs.size(),
                    static_cast<double>(diagnosis.score), codes.c_str());
        // A body with hands and legs but no head: hardly half a figure, and most of its skin beside the bodies.
        CHECK(diagnosis.hasErrors() == (subject.name == "raylib_greenman"));
        CHECK(diagnosis.fit.overlapM == 0.0F);
        const bool usual =
            std::find(peopleOfUsualBuild.begin(), peopleOfUsualBuild.end(), subject.name) != peopleOfUsualBuild.end();
        if (!usual) continue;
        CHECK(subject.profile.bodies.size() == 16);
        CHECK(diagnosis.fit.skinNear > 0.8F);
        if (diagnosis.fit.volumeCovered) CHECK(*diagnosis.fit.volumeCovered > 0.65F);
    }
}

TEST_CASE("a foot stands from its heel to its toe tip, though a capsule touches the ground between its caps alone") {
    NEEDS_ZOO();
    int feet = 0;
    for (const Subject& subject : subjects()) {
        const auto is = [&](const char* name) { return subject.name == name; };
        if (!is("cesium_man_glb") && !is("makehuman_mixamo") && !is("rocketbox_male") && !is("kaykit_rogue") &&
            !is("mesh2motion_human"))
            continue;
        INFO(subject.name);
        const int body = bodyOf(subject.profile, Role::leftFoot);
        REQUIRE(body >= 0);
        const PlacedShape& foot = subject.bind[body];
        const vec3 along = foot.standardFromBody.rotation * vec3(0, 1, 0);
        const vec3 ahead = along.z < 0.0F ? -along : along;
        const float middle = glm::dot(foot.standardFromBody.translation, ahead);
        // Skin that hangs on the foot or on what follows it, and touches the ground.
        const int joint = subject.map.jointOf(Role::leftFoot);
        std::vector<vec3> skin;
        float sole = 1e9F;
        for (const animation::SkinnedMesh& mesh : subject.character.meshes)
            for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
                if (!isAncestorOrSelf(subject.character.skeleton, joint, mesh.joints[i][0])) continue;
                skin.push_back(subject.map.standardFromModel * mesh.positions[i]);
                sole = std::min(sole, skin.back().y);
            }
        float heel = 1e9F;
        float toe = -1e9F;
        for (const vec3& point : skin) {
            if (point.y > sole + 0.02F * subject.profile.heightM) continue;
            heel = std::min(heel, glm::dot(point, ahead));
            toe = std::max(toe, glm::dot(point, ahead));
        }
        const float height = subject.profile.heightM;
        const float most = std::max(0.6F * foot.shape.radius, foot.shape.radius - 0.012F * height) + 0.01F * height;
        CHECK(middle - foot.shape.halfLength - heel < most);
        CHECK(toe - middle - foot.shape.halfLength < most);
        ++feet;
    }
    CHECK(feet == 5);
}
