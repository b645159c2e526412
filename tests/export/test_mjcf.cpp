#include <algorithm>
#include <glm/geometric.hpp>

#include "export/doll_source.hpp"
#include "export/xml_tags.hpp"
#include "support/catch.hpp"

using namespace lutka;
using namespace lutka::test;

namespace {

vec3 vectorOf(const std::vector<float>& v, std::size_t at = 0) {
    return {v.at(at), v.at(at + 1), v.at(at + 2)};
}
quat quaternionOf(const std::vector<float>& v, std::size_t at = 0) {
    return {v.at(at), v.at(at + 1), v.at(at + 2), v.at(at + 3)};
}

std::string mjcfOf(const DollSource& doll) {
    return exportedAs(exporting::ExportFormat::mjcf, doll).bytes;
}

// World frames of all bodies in a keyframe, by MuJoCo's rules: joints turn the body about their axis through their
// anchor, one after the other (mujoco.readthedocs.io, Computation, "Kinematics").
std::map<std::string, RigidTransform> posed(const std::vector<XmlTag>& tags) {
    const auto key = std::find_if(tags.begin(), tags.end(), [](const XmlTag& t) { return t.name == "key"; });
    REQUIRE(key != tags.end());
    const std::vector<float> qpos = key->numbers("qpos");
    std::size_t at = 7;
    std::map<int, RigidTransform> frames;  // by tag
    for (std::size_t i = 0; i < tags.size(); ++i) {
        const XmlTag& tag = tags[i];
        if (tag.name == "body") {
            const RigidTransform local{quaternionOf(tag.numbers("quat")), vectorOf(tag.numbers("pos"))};
            const bool root = tags[tag.parent].name == "worldbody";
            frames[static_cast<int>(i)] =
                root ? RigidTransform{quaternionOf(qpos, 3), vectorOf(qpos)} : frames.at(tag.parent) * local;
        } else if (tag.name == "joint" && tag.attributes.count("axis") == 1) {
            const vec3 anchor = vectorOf(tag.numbers("pos"));
            const quat turn = glm::angleAxis(qpos.at(at++), glm::normalize(vectorOf(tag.numbers("axis"))));
            RigidTransform& body = frames.at(tag.parent);
            body = body * RigidTransform{turn, anchor - turn * anchor};
        }
    }
    CHECK(at == qpos.size());
    std::map<std::string, RigidTransform> named;
    for (const auto& [tag, frame] : frames)
        named[tags[tag]["name"]] = frame;
    return named;
}

}  // namespace

TEST_CASE("MJCF: bodies carry the profile's masses, moments and shapes") {
    const DollSource doll;
    const auto tags = xmlTags(mjcfOf(doll));
    std::size_t bodies = 0;
    for (const XmlTag& tag : tags) {
        if (tag.name != "inertial") continue;
        const auto role = animation::roleFromName(tags[tag.parent]["name"]);
        REQUIRE(role);
        const physics::BodyProfile& body = doll.profile.bodies.at(physics::bodyOf(doll.profile, *role));
        CHECK(tag.numbers("mass") == std::vector<float>{body.massKg});
        CHECK(vectorOf(tag.numbers("diaginertia")) == body.inertia);
        ++bodies;
    }
    CHECK(bodies == doll.profile.bodies.size());
}

TEST_CASE("MJCF: a capsule without a length is a sphere, which MuJoCo takes") {
    physics::RagdollProfile profile = DollSource().profile;
    profile.bodies[0].shape.kind = physics::BodyShape::Kind::capsule;
    profile.bodies[0].shape.halfLength = 0.0F;
    const DollSource doll(profile);
    std::size_t spheres = 0;
    for (const XmlTag& tag : xmlTags(mjcfOf(doll))) {
        if (tag.name != "geom" || tag.attributes.count("type") == 0) continue;
        if (tag["type"] == "capsule") CHECK(tag.numbers("size").at(1) > 0.0F);
        if (tag["type"] != "sphere") continue;
        ++spheres;
        CHECK(tag.numbers("size") == std::vector<float>{profile.bodies[0].shape.radius});
    }
    CHECK(spheres == 1);
}

TEST_CASE("MJCF: the keyframe is the bind pose, standing on the floor of a z-up world") {
    const DollSource doll;
    const auto frames = posed(xmlTags(mjcfOf(doll)));
    REQUIRE(frames.size() == doll.profile.bodies.size());
    const quat turn = quat(0.5F, 0.5F, 0.5F, 0.5F) * doll.profile.standardFromModel;
    const vec3 offset = frames.at("hips").translation - turn * doll.rig.bindModelFromBody[0].translation;
    for (std::size_t i = 0; i < doll.profile.bodies.size(); ++i) {
        const std::string name(doll.profile.bodies[i].name);
        INFO(name);
        const RigidTransform wanted = RigidTransform{turn, offset} * doll.rig.bindModelFromBody[i];
        CHECK(poseDifference(frames.at(name), wanted) < 2e-5F);
    }
    CHECK(frames.at("head").translation.z > frames.at("hips").translation.z);
    CHECK(frames.at("leftHand").translation.y > frames.at("hips").translation.y);
}

TEST_CASE("MJCF: hinges have the profile's limits, cones three hinges and two sums") {
    const DollSource doll;
    const auto tags = xmlTags(mjcfOf(doll));
    const auto count = [&](const std::string& name) {
        return std::count_if(tags.begin(), tags.end(), [&](const XmlTag& t) { return t.name == name; });
    };
    const auto named = [&](const std::string& name) {
        return std::find_if(tags.begin(), tags.end(), [&](const XmlTag& t) {
            return t.name == "joint" && t.attributes.count("name") == 1 && t["name"] == name;
        });
    };
    int cones = 0;
    for (const physics::ConstraintProfile& c : doll.profile.constraints) {
        const std::string name(doll.profile.bodies[c.child].name);
        INFO(name);
        if (c.kind == physics::ConstraintProfile::Kind::hinge) {
            REQUIRE(named(name) != tags.end());
            CHECK(named(name)->numbers("range") == std::vector<float>{c.hinge.lower, c.hinge.upper});
        } else {
            ++cones;
            REQUIRE(named(name + "_x") != tags.end());
            CHECK(named(name + "_x")->numbers("range") == std::vector<float>{-c.cone.twist, c.cone.twist});
            CHECK(named(name + "_x")->numbers("frictionloss") == std::vector<float>{c.frictionNm});
        }
    }
    CHECK(count("fixed") == 2 * cones);
    CHECK(count("exclude") == static_cast<int>(doll.profile.constraints.size() + doll.profile.filteredPairs.size()));
}
