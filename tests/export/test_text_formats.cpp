// URDF, Godot, Blender, Bullet and USD: structure and numbers. Whether their programs agree is asked in tests/witness.
#include <glm/geometric.hpp>
#include <regex>

#include "export/doll_layout.hpp"
#include "export/doll_source.hpp"
#include "export/xml_tags.hpp"
#include "support/catch.hpp"
#include "support/dolls.hpp"

using namespace lutka;
using namespace lutka::exporting;
using namespace lutka::test;

namespace {

// The number after a key, in the part of the text that begins with `from`.
float numberAfter(const std::string& text, const std::string& from, const std::string& key) {
    const std::size_t start = text.find(from);
    REQUIRE(start != std::string::npos);
    const std::size_t at = text.find(key, start);
    REQUIRE(at != std::string::npos);
    return std::strtof(text.c_str() + at + key.size(), nullptr);
}

RigidTransform originOf(const XmlTag& tag) {
    const auto t = tag.numbers("xyz");
    const auto r = tag.numbers("rpy");
    const quat turn =
        glm::angleAxis(r[2], vec3(0, 0, 1)) * glm::angleAxis(r[1], vec3(0, 1, 0)) * glm::angleAxis(r[0], vec3(1, 0, 0));
    return {turn, vec3(t[0], t[1], t[2])};
}

// What the tests of URDF need: where a body is in its link, and where a link hangs in another.
struct Robot {
    std::map<std::string, RigidTransform> linkFromBody;
    std::map<std::string, std::pair<std::string, RigidTransform>> parentOf;
    std::map<std::string, float> massOf;
};

Robot robotOf(const std::string& text) {
    const auto tags = xmlTags(text);
    Robot robot;
    std::map<int, std::string> child;
    std::map<int, std::string> parent;
    std::map<int, RigidTransform> origin;
    for (std::size_t i = 0; i < tags.size(); ++i) {
        const XmlTag& tag = tags[i];
        if (tag.parent < 0) continue;
        const XmlTag& around = tags[tag.parent];
        if (tag.name == "origin" && around.name == "inertial")
            robot.linkFromBody[tags[around.parent]["name"]] = originOf(tag);
        if (tag.name == "mass") robot.massOf[tags[around.parent]["name"]] = tag.numbers("value")[0];
        if (around.name != "joint") continue;
        if (tag.name == "origin") origin[tag.parent] = originOf(tag);
        if (tag.name == "parent") parent[tag.parent] = tag["link"];
        if (tag.name == "child") child[tag.parent] = tag["link"];
    }
    for (const auto& [joint, name] : child)
        robot.parentOf[name] = {parent[joint], origin[joint]};
    return robot;
}

}  // namespace

TEST_CASE("URDF: at zero the bodies stand in the neutral pose, and masses are the profile's") {
    const DollSource doll;
    const Robot robot = robotOf(exportedAs(ExportFormat::urdf, doll).bytes);
    for (const physics::ConstraintProfile& c : doll.profile.constraints) {
        const std::string child = bodyName(doll.profile, c.child);
        const std::string parent = bodyName(doll.profile, c.parent);
        INFO(child);
        RigidTransform linkFromChild = robot.linkFromBody.at(child);
        std::string link = child;
        while (link != parent) {
            const auto& [above, origin] = robot.parentOf.at(link);
            linkFromChild = origin * linkFromChild;
            link = above;
        }
        const RigidTransform parentFromChild = inverse(robot.linkFromBody.at(parent)) * linkFromChild;
        CHECK(poseDifference(parentFromChild, neutralParentFromChild(c)) < 2e-5F);
        CHECK(robot.massOf.at(child) == doll.profile.bodies[c.child].massKg);
    }
}

TEST_CASE("Godot: joints have clockwise limits in degrees, and every pair that must not collide is an exception") {
    const DollSource doll;
    const auto hinge = std::find_if(doll.profile.constraints.begin(), doll.profile.constraints.end(),
                                    [](const auto& c) { return c.kind == physics::ConstraintProfile::Kind::hinge; });
    REQUIRE(hinge != doll.profile.constraints.end());
    const float bind = bindHingeAngle(doll.source(), *hinge);
    const std::string node = "[node name=\"" + bodyName(doll.profile, hinge->child) + "\"";
    for (const ExportFormat format : {ExportFormat::godot4, ExportFormat::godot3}) {
        const std::string text = exportedAs(format, doll).bytes;
        const bool four = format == ExportFormat::godot4;
        CHECK(occurrences(text, four ? "type=\"PhysicalBone3D\"" : "type=\"PhysicalBone\"") == 16);
        CHECK(numberAfter(text, node, "angular_limit_upper = ") ==
              Approx(degrees(bind - hinge->hinge.lower)).margin(1e-3));
        CHECK(numberAfter(text, node, "angular_limit_lower = ") ==
              Approx(degrees(bind - hinge->hinge.upper)).margin(1e-3));
        // The type comes before what it gives meaning to.
        CHECK(text.find("joint_type = 3", text.find(node)) < text.find("joint_constraints/", text.find(node)));
        const physics::BodyShape& shape = doll.profile.bodies[0].shape;
        CHECK(numberAfter(text, "CapsuleShape", "height = ") ==
              Approx(2.0F * (shape.halfLength + (four ? shape.radius : 0.0F))));
        const std::string list = text.substr(text.find("exceptions = "),
                                             text.find('\n', text.find("exceptions = ")) - text.find("exceptions = "));
        const auto pairs = doll.profile.constraints.size() + doll.profile.filteredPairs.size();
        CHECK(occurrences(list, "\"") == static_cast<int>(4 * pairs));
    }
}

TEST_CASE("Godot: a foot on an IK root hangs on its lower leg, and names become nodes") {
    DollSource doll;
    doll.character.skeleton.names[1] = "a/b:c\"d";
    const std::string text = exportedAs(ExportFormat::godot4, doll).bytes;
    CHECK_THAT(text, Catch::Contains("bones/1/name = \"a_b_c_d\""));
}

TEST_CASE("Blender: a table of bodies and one of joints, ranges from the bind pose, z up") {
    const DollSource doll;
    const std::string text = exportedAs(ExportFormat::blender, doll).bytes;
    CHECK(occurrences(text, "'CAPSULE', (") == 16);
    CHECK(occurrences(text, ", True, (") + occurrences(text, ", False, (") == 15);
    // The hips' height is the third number of their place.
    const float height = (standingFromModel(doll.source()) * doll.rig.bindModelFromBody[0]).translation.y;
    std::smatch place;
    REQUIRE(std::regex_search(text, place, std::regex("\\(\"hips\", 'CAPSULE', \\([^)]*\\), \\(\\(([^)]*)\\)")));
    const std::string numbers = place[1];
    CHECK(std::strtof(numbers.c_str() + numbers.rfind(',') + 1, nullptr) == Approx(height).margin(1e-5));
}

TEST_CASE("URDF and USD: bodies have the friction of contacts that engines combine to ours") {
    const DollSource doll;
    const std::string urdf = exportedAs(ExportFormat::urdf, doll).bytes;
    CHECK(occurrences(urdf, "<lateral_friction value=\"0.5\"/>") == 16);
    CHECK(occurrences(urdf, "<mu1>0.4</mu1><mu2>0.4</mu2>") == 16);
    const std::string usd = exportedAs(ExportFormat::usd, doll).bytes;
    CHECK_THAT(usd, Catch::Contains("rel material:binding:physics = </Ragdoll/contact_material>"));
    CHECK(numberAfter(usd, "def Material \"contact_material\"", "physics:dynamicFriction = ") == Approx(0.5F));
    CHECK_THAT(usd, Catch::Contains("frictionCombineMode = \"multiply\""));
}

TEST_CASE("Bullet and USD: every body, joint and pair is there, in their units") {
    physics::RagdollProfile profile = makeDoll();
    profile.filteredPairs = {{0, 2}, {1, 4}};
    const DollSource doll(profile);
    const std::string bullet = exportedAs(ExportFormat::bullet, doll).bytes;
    CHECK(occurrences(bullet, "addBody(*doll") == 16);
    CHECK(occurrences(bullet, "addHinge(*doll") + occurrences(bullet, "addCone(*doll") == 15);
    CHECK(occurrences(bullet, "setIgnoreCollisionCheck") == 2);
    const std::string usd = exportedAs(ExportFormat::usd, doll).bytes;
    CHECK(occurrences(usd, "def Capsule") == 16);
    CHECK(occurrences(usd, "def PhysicsRevoluteJoint") + occurrences(usd, "def PhysicsJoint") == 15);
    CHECK(occurrences(usd, "{\n") == occurrences(usd, "}\n"));
    CHECK_THAT(usd, Catch::Contains("rel physics:filteredPairs = [</Ragdoll/" + bodyName(profile, 2) + ">]"));
    const auto& c = profile.constraints[0];
    REQUIRE(c.kind == physics::ConstraintProfile::Kind::coneTwist);
    CHECK(numberAfter(usd, bodyName(profile, c.child) + "_joint", "limit:rotX:physics:high = ") ==
          Approx(degrees(c.cone.twist)));
}
