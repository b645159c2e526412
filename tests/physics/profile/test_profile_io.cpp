#include "physics/profile/profile_io.hpp"

#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "core/random.hpp"
#include "physics/collision/shape.hpp"
#include "physics/fit/fit_ragdoll.hpp"
#include "support/catch.hpp"
#include "support/json_schema.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using namespace lutka::physics;
using nlohmann::json;

namespace {

RagdollProfile profileToWrite() {
    const auto biped = test::makeBiped();
    RagdollProfile profile = fitRagdoll(biped, test::mapOfBiped(biped)).value();
    profile.filteredPairs = {{1, 3}, {2, 9}};
    profile.notes = {"a \"note\" with ümlauts"};
    profile.bodies[2].shape.kind = BodyShape::Kind::box;
    profile.bodies[3].shape.kind = BodyShape::Kind::sphere;
    profile.bodies[4].shape.hull = hullWithin(profile.bodies[4].shape);
    profile.bodies[4].shape.kind = BodyShape::Kind::hull;
    profile.constraints[2].spring = {4.5F, 0.25F, glm::angleAxis(0.5F, vec3(0, 0, 1))};
    return profile;
}

json bipedJson() {
    return json::parse(profileToJson(profileToWrite()));
}

std::string problemsOf(const json& document) {
    const auto read = profileFromJson(document.dump(), "planted.json");
    return read ? std::string() : read.error().message;
}

void checkSame(const RigidTransform& a, const RigidTransform& b) {
    CHECK(a.rotation == b.rotation);
    CHECK(a.translation == b.translation);
}

}  // namespace

TEST_CASE("a profile comes back from its JSON to the last bit") {
    const RagdollProfile profile = profileToWrite();
    const auto read = profileFromJson(profileToJson(profile), "memory");
    REQUIRE(read);
    const RagdollProfile& back = read.value();
    CHECK(back.name == profile.name);
    CHECK(back.heightM == profile.heightM);
    CHECK(back.totalMassKg == profile.totalMassKg);
    CHECK(back.standardFromModel == profile.standardFromModel);
    CHECK(back.filteredPairs == profile.filteredPairs);
    CHECK(back.notes == profile.notes);
    REQUIRE(back.bodies.size() == profile.bodies.size());
    for (std::size_t i = 0; i < back.bodies.size(); ++i) {
        const BodyProfile& a = back.bodies[i];
        const BodyProfile& b = profile.bodies[i];
        CHECK(a.name == b.name);
        CHECK(a.role == b.role);
        CHECK(a.mirror == b.mirror);
        CHECK(a.joint == b.joint);
        CHECK(a.jointPath == b.jointPath);
        CHECK(a.shape.kind == b.shape.kind);
        if (!a.shape.isAngular()) CHECK(a.shape.radius == b.shape.radius);
        CHECK(sameHull(a.shape.hull, b.shape.hull));
        if (a.shape.kind == BodyShape::Kind::capsule) CHECK(a.shape.halfLength == b.shape.halfLength);
        if (a.shape.kind == BodyShape::Kind::box) CHECK(a.shape.halfExtents == b.shape.halfExtents);
        checkSame(a.jointFromBody, b.jointFromBody);
        CHECK(a.massKg == b.massKg);
        CHECK(a.inertia == b.inertia);
    }
    REQUIRE(back.constraints.size() == profile.constraints.size());
    for (std::size_t i = 0; i < back.constraints.size(); ++i) {
        const ConstraintProfile& a = back.constraints[i];
        const ConstraintProfile& b = profile.constraints[i];
        CHECK(a.kind == b.kind);
        CHECK(a.parent == b.parent);
        CHECK(a.child == b.child);
        checkSame(a.parentFromFrame, b.parentFromFrame);
        checkSame(a.childFromFrame, b.childFromFrame);
        CHECK(a.frictionNm == b.frictionNm);
        CHECK(a.spring.stiffness == b.spring.stiffness);
        CHECK(a.spring.damping == b.spring.damping);
        CHECK(a.spring.rest == b.spring.rest);
        if (a.kind == ConstraintProfile::Kind::hinge) {
            CHECK(a.hinge.lower == b.hinge.lower);
            CHECK(a.hinge.upper == b.hinge.upper);
        } else {
            CHECK(a.cone.swingY == b.cone.swingY);
            CHECK(a.cone.swingZ == b.cone.swingZ);
            CHECK(a.cone.twist == b.cone.twist);
        }
    }
    CHECK(profileToJson(back) == profileToJson(profile));
}

TEST_CASE("the further shapes of a body come back from its JSON, and only they are in it") {
    RagdollProfile profile = profileToWrite();
    AddedShape rod;
    rod.radius = 0.03F;
    rod.halfLength = 0.07F;
    rod.bodyFromShape = {glm::angleAxis(0.3F, vec3(0, 0, 1)), {0.01F, 0.02F, 0.03F}};
    AddedShape crate;
    crate.kind = BodyShape::Kind::box;
    crate.halfExtents = {0.01F, 0.02F, 0.03F};
    profile.bodies[3].shape.more = {rod, crate};
    const std::string text = profileToJson(profile);
    const auto read = profileFromJson(text, "memory");
    REQUIRE(read);
    const std::vector<AddedShape>& back = read.value().bodies[3].shape.more;
    REQUIRE(back.size() == 2);
    CHECK(back[0].kind == BodyShape::Kind::capsule);
    CHECK(back[0].radius == rod.radius);
    CHECK(back[0].halfLength == rod.halfLength);
    checkSame(back[0].bodyFromShape, rod.bodyFromShape);
    CHECK(back[1].halfExtents == crate.halfExtents);
    CHECK(profileToJson(read.value()) == text);
    const json document = json::parse(text);
    CHECK_FALSE(document["bodies"][0]["shape"].contains("more"));
    std::ifstream file(std::string(LUTKA_ASSETS_DIR) + "/profiles/ragdoll.schema.json");
    CHECK(test::checkSchema(json::parse(file), document).empty());
}

TEST_CASE("further shapes that no body can have are refused at their place") {
    RagdollProfile profile = profileToWrite();
    AddedShape ball;
    ball.kind = BodyShape::Kind::sphere;
    profile.bodies[3].shape.more = {ball};
    const auto refused = [&](const auto& change) {
        json document = json::parse(profileToJson(profile));
        change(document["bodies"][3]["shape"]["more"]);
        return problemsOf(document);
    };
    CHECK(refused([](json&) {}).empty());
    CHECK(refused([](json& more) { more = json::array(); }).find("/bodies/3/shape/more") != std::string::npos);
    CHECK(refused([](json& more) {
              more = {more[0], more[0], more[0]};
          }).find("/bodies/3/shape/more") != std::string::npos);
    CHECK(refused([](json& more) { more[0]["radius"] = -1; }).find("/bodies/3/shape/more/0/radius") !=
          std::string::npos);
    CHECK(refused([](json& more) { more[0].erase("bodyFromShape"); }).find("bodyFromShape") != std::string::npos);
    CHECK(refused([](json& more) { more[0]["more"] = more; }).find("/bodies/3/shape/more/0") != std::string::npos);
    CHECK(refused([](json& more) {
              more[0]["bodyFromShape"]["translation"] = {500, 0, 0};
          }).find("/bodies/3/shape/more/0/bodyFromShape/translation") != std::string::npos);
    CHECK(refused([](json& more) { more[0]["radius"] = 100; }).find("/bodies/3/shape/more/0") != std::string::npos);
}

TEST_CASE("hulls that no body can have are refused at their place") {
    const json whole = bipedJson();
    const auto problemsWith = [&](const std::function<void(json&)>& spoil) {
        json document = whole;
        spoil(document["bodies"][4]["shape"]["points"]);
        return problemsOf(document);
    };
    CHECK(problemsWith([](json&) {}).empty());
    const std::string place = "/bodies/4/shape/points";
    const auto blames = [&](const std::string& problems, const std::string& where, const std::string& what) {
        INFO(problems);
        CHECK(problems.find(place + where + ":") != std::string::npos);
        CHECK(problems.find(what) != std::string::npos);
    };
    blames(problemsWith([](json& points) { points = 3; }), "", "an array");
    blames(problemsWith([](json& points) { points = {points[0], points[1], points[2]}; }), "", "4 to 32 items");
    blames(problemsWith([](json& points) { points.insert(points.end(), 40, points[0]); }), "", "4 to 32 items");
    blames(problemsWith([](json& points) { points[5][1] = "up"; }), "/5/1", "a number");
    blames(problemsWith([](json& points) { points[5] = {1, 2}; }), "/5", "3");
    blames(problemsWith([](json& points) { points[5][1] = 1e30; }), "/5/1", "number");
    blames(problemsWith([](json& points) { points[5] = {0, 0, 0}; }), "/5", "a corner of the points' convex hull");
    blames(problemsWith([](json& points) { points[5] = points[4]; }), "/5", "a corner of the points' convex hull");
    blames(problemsWith([](json& points) {
               for (json& point : points)
                   point[1] = 0.01;
           }),
           "", "not flat");
    blames(problemsWith([](json& points) {
               for (json& point : points)
                   point[1] = point[1].get<float>() + 0.1F;
           }),
           "", "middle of their hull's volume");
    // Sizes are bounded as those of other shapes.
    json huge = whole;
    for (json& point : huge["bodies"][4]["shape"]["points"])
        for (json& x : point)
            x = 1000.0F * x.get<float>();
    CHECK(problemsOf(huge).find("/bodies/4/shape") != std::string::npos);
    // Version 1 knew none.
    json old = whole;
    old["version"] = 1;
    CHECK(problemsOf(old).find("/bodies/4/shape/kind") != std::string::npos);
}

TEST_CASE("a profile survives the way through a file") {
    const auto file = std::filesystem::temp_directory_path() / "lutka_profile_test" / "biped.ragdoll.json";
    REQUIRE(saveProfile(file, profileToWrite()));
    const auto read = loadProfile(file);
    REQUIRE(read);
    CHECK(profileToJson(read.value()) == profileToJson(profileToWrite()));
    std::filesystem::remove_all(file.parent_path());
    CHECK_FALSE(loadProfile(file));
}

TEST_CASE("vectors stand on one line and numbers in their shortest form") {
    RagdollProfile profile = profileToWrite();
    profile.heightM = 0.1F;
    const std::string text = profileToJson(profile);
    CHECK(text.find("\"heightM\": 0.1,") != std::string::npos);
    CHECK(text.find("\"standardFromModel\": [0.0, 0.0, 0.0, 1.0],") != std::string::npos);
}

TEST_CASE("the committed schema describes what is written") {
    std::ifstream file(std::string(LUTKA_ASSETS_DIR) + "/profiles/ragdoll.schema.json");
    REQUIRE(file);
    const json schema = json::parse(file);
    const auto problems = test::checkSchema(schema, bipedJson());
    for (const std::string& problem : problems)
        FAIL_CHECK(problem);
    // The checker sees what is wrong.
    json wrong = bipedJson();
    wrong["bodies"][0]["massKg"] = -1;
    wrong["constraints"][0].erase("cone");
    wrong["colour"] = "red";
    CHECK(test::checkSchema(schema, wrong).size() == 3);
}

TEST_CASE("every planted fault is listed in one go with its place") {
    json wrong = bipedJson();
    wrong["colour"] = "red";
    wrong.erase("name");
    wrong["heightM"] = "tall";
    wrong["bodies"][1]["shape"]["radius"] = -0.1;
    wrong["bodies"][1]["shape"]["halfLength"] = nullptr;  // what NaN is written as
    wrong["bodies"][4]["jointPath"] = wrong["bodies"][5]["jointPath"];
    wrong["bodies"][6]["role"] = "tail";
    wrong["bodies"][10]["name"] = wrong["bodies"][2]["name"];
    wrong["bodies"][7]["inertia"] = {1, 2};
    wrong["bodies"][8]["jointFromBody"]["rotation"] = {0, 0, 1, 1};
    wrong["bodies"][9]["massKg"] = 0;
    wrong["constraints"][0]["hinge"] = {{"lower", 0}, {"upper", 1}};
    wrong["constraints"][1]["parent"] = "rightFoot";
    wrong["constraints"][2]["cone"]["twist"] = 4.0;
    wrong["constraints"][11]["child"] = wrong["constraints"][10]["child"];
    wrong["filteredPairs"][0] = {"hips", "leftToes"};
    const std::string message = problemsOf(wrong);
    INFO(message);
    for (const char* expected :
         {"/colour: unknown key", "expected a member \"name\"", "/heightM: expected a number, got string",
          "/bodies/1/shape/radius: expected a finite number", "/bodies/1/shape/halfLength: expected a number, got null",
          "/bodies/5/jointPath: expected a joint of its own", "/bodies/6/role: expected a role",
          "/bodies/7/inertia: expected 3 items, got 2", "/bodies/8/jointFromBody/rotation: expected a quaternion",
          "/bodies/9/massKg: expected a finite number", "/constraints/0/hinge: unknown key",
          "/constraints/1/parent: expected a body listed before the child", "/constraints/2/cone/twist: expected",
          "/constraints/11/child: expected one constraint a child", "it has no parent",
          "/bodies/10/name: expected a name of its own",
          "/filteredPairs/0/1: expected the name of one of the bodies"}) {
        CHECK(message.find(expected) != std::string::npos);
    }
}

TEST_CASE("other formats and versions are refused before anything else is read") {
    json other = bipedJson();
    other["version"] = 3;
    CHECK(problemsOf(other).find("the file is from a newer program") != std::string::npos);
    other["version"] = 0;
    CHECK(problemsOf(other).find("there has never been such a version") != std::string::npos);
    other["version"] = 1.5;
    CHECK(problemsOf(other).find("/version: expected a whole number") != std::string::npos);
    other = bipedJson();
    other["format"] = "blend";
    CHECK(problemsOf(other).find("/format: expected one of \"lutka-ragdoll\"") != std::string::npos);
    CHECK(problemsOf(json::object()).find("expected a member \"format\"") != std::string::npos);
    CHECK(problemsOf(json::array()).find("expected an object") != std::string::npos);
    const auto broken = profileFromJson("{\"format\": ", "broken.json");
    REQUIRE_FALSE(broken);
    CHECK(broken.error().code == ErrorCode::input);
    CHECK(broken.error().text().find("broken.json: /format: not JSON") == 0);
}

TEST_CASE("a key that stands twice and masses that do not add up are problems") {
    std::string text = profileToJson(profileToWrite());
    text.insert(1, "\"name\": \"other\",");
    const auto twice = profileFromJson(text, "memory");
    REQUIRE_FALSE(twice);
    CHECK(twice.error().message.find("\"name\" stands twice") != std::string::npos);
    json heavy = bipedJson();
    heavy["totalMassKg"] = 80;
    CHECK(problemsOf(heavy).find("/totalMassKg: expected the sum of the bodies' masses") != std::string::npos);
}

TEST_CASE("a file of version 1 is upgraded: its bodies are named by their roles") {
    const auto read = loadProfile(std::string(LUTKA_TESTS_DIR) + "/golden/profiles/biped_v1.ragdoll.json");
    REQUIRE(read);
    for (const BodyProfile& body : read.value().bodies) {
        REQUIRE(body.role);
        CHECK(body.name == roleName(*body.role));
    }
    const json written = json::parse(profileToJson(read.value()));
    CHECK(written["version"] == 2);
    CHECK(written["bodies"][0]["name"] == "hips");
    CHECK(written["constraints"][0]["child"] == written["bodies"][1]["name"]);
    // A key of version 2 is none of version 1.
    std::ifstream file(std::string(LUTKA_TESTS_DIR) + "/golden/profiles/biped_v1.ragdoll.json");
    json mixed = json::parse(file);
    mixed["bodies"][0]["name"] = "hips";
    CHECK(problemsOf(mixed).find("/bodies/0/name: unknown key") != std::string::npos);
}

TEST_CASE("muscles and pins come back to the last bit, and a file without them stays as it was") {
    RagdollProfile profile = profileToWrite();
    const std::string plain = profileToJson(profile);
    CHECK(plain.find("muscle") == std::string::npos);
    CHECK(plain.find("pinForceN") == std::string::npos);
    CHECK_FALSE(profileFromJson(plain, "memory").value().muscles);
    profile.muscles = MuscleProfile{7.3F, 0.9F, 1.7F, 0.31F, false, true, {}};
    profile.muscles->groups[static_cast<std::size_t>(MuscleGroup::arm)] = {0.1F, 1.3F, 2.7F};
    profile.bodies[4].muscle = {0.7F, 1.0F, 0.3F};
    profile.bodies[0].pinForceN = 1234.5F;
    const std::string text = profileToJson(profile);
    const auto read = profileFromJson(text, "memory");
    REQUIRE(read);
    CHECK(read.value().muscles == profile.muscles);
    CHECK(read.value().bodies[4].muscle == profile.bodies[4].muscle);
    CHECK(read.value().bodies[5].muscle == MuscleFactors{});
    CHECK(read.value().bodies[0].pinForceN == 1234.5F);
    CHECK_FALSE(read.value().bodies[1].pinForceN);
    CHECK(profileToJson(read.value()) == text);
    std::ifstream file(std::string(LUTKA_ASSETS_DIR) + "/profiles/ragdoll.schema.json");
    CHECK(test::checkSchema(json::parse(file), json::parse(text)).empty());
}

TEST_CASE("what is not said of muscles is the preset's, and what is wrong with them is told with its place") {
    json document = bipedJson();
    document["muscles"] = {{"preset", "stiff"}, {"strength", 2}, {"groups", {{"leg", {{"torque", 3}}}}}};
    const auto read = profileFromJson(document.dump(), "memory");
    REQUIRE(read);
    MuscleProfile expected = muscleProfileOf(MusclePreset::stiff);
    expected.strength = 2.0F;
    expected.groups[static_cast<std::size_t>(MuscleGroup::leg)].torque = 3.0F;
    CHECK(read.value().muscles == expected);
    document["muscles"] = {{"preset", "mighty"},      {"frequencyHz", 5000}, {"bounded", 1},
                           {"groups", {{"tail", 1}}}, {"colour", "red"},     {"dampingRatio", -1}};
    document["bodies"][2]["muscle"] = {{"strength", "much"}, {"speed", 1}};
    document["bodies"][3]["pinForceN"] = -4;
    const std::string message = problemsOf(document);
    INFO(message);
    for (const char* place :
         {"/muscles/preset", "/muscles/frequencyHz", "/muscles/bounded", "/muscles/groups/tail", "/muscles/colour",
          "/muscles/dampingRatio", "/bodies/2/muscle/strength", "/bodies/2/muscle/speed", "/bodies/3/pinForceN"})
        CHECK(message.find(place) != std::string::npos);
    // Factors count on whatever powers the doll, also without muscles of its own.
    json lone = bipedJson();
    lone["bodies"][2]["muscle"] = {{"strength", 0.5}};
    const auto factors = profileFromJson(lone.dump(), "lone");
    REQUIRE(factors.ok());
    CHECK_FALSE(factors.value().muscles);
    CHECK(factors.value().bodies[2].muscle.strength == 0.5F);
    // Version 1 knew none.
    std::ifstream file(std::string(LUTKA_TESTS_DIR) + "/golden/profiles/biped_v1.ragdoll.json");
    json old = json::parse(file);
    old["muscles"] = json::object();
    CHECK(problemsOf(old).find("/muscles: unknown key") != std::string::npos);
}

TEST_CASE("a file of version 2 with muscles is read by every later version") {
    const auto read = loadProfile(std::string(LUTKA_TESTS_DIR) + "/golden/profiles/muscles_v2.ragdoll.json");
    REQUIRE(read);
    REQUIRE(read.value().muscles);
    CHECK(read.value().muscles->frequencyHz == 6.0F);
    CHECK(read.value().muscles->bounded);
    CHECK(read.value().muscles->groups[static_cast<std::size_t>(MuscleGroup::arm)].strength == 0.5F);
    CHECK(read.value().bodies[0].pinForceN == 1500.0F);
    CHECK(read.value().bodies[bodyOf(read.value(), Role::leftHand)].muscle.damping == 2.0F);
}

TEST_CASE("bodies without a role come back, with names in any script, and their counterparts") {
    RagdollProfile profile = profileToWrite();
    for (BodyProfile& body : profile.bodies) {
        body.name = "Knochen ä " + body.name;
        body.role.reset();
    }
    profile.bodies[0].mirror = profile.bodies[0].name;
    profile.bodies[4].mirror = profile.bodies[5].name;
    const auto read = profileFromJson(profileToJson(profile), "memory");
    REQUIRE(read);
    CHECK(profileToJson(read.value()) == profileToJson(profile));
    CHECK_FALSE(hasRoles(read.value()));
    CHECK(counterpartOf(read.value(), 4) == 5);
    CHECK(counterpartOf(read.value(), 5) == 4);
    CHECK(sideOf(read.value(), 4) == animation::Side::left);
    CHECK(sideOf(read.value(), 5) == animation::Side::right);
    CHECK(counterpartOf(read.value(), 0) == -1);
    CHECK(sideOf(read.value(), 0) == animation::Side::center);
    json nameless = json::parse(profileToJson(profile));
    nameless["bodies"][3]["name"] = "";
    CHECK_FALSE(problemsOf(nameless).empty());
}

TEST_CASE("a joint that is edited against its path, or the other way, is told") {
    json wrong = bipedJson();
    const std::string path = wrong["bodies"][4]["jointPath"];
    wrong["bodies"][4]["joint"] = wrong["bodies"][8]["joint"];
    wrong["bodies"][6]["jointPath"] = "elsewhere";
    const std::string message = problemsOf(wrong);
    CHECK_THAT(message, Catch::Contains("/bodies/4/joint: expected the last name of jointPath \"" + path + "\""));
    CHECK_THAT(message, Catch::Contains("/bodies/6/joint: expected the last name of jointPath \"elsewhere\""));

    json right = bipedJson();
    const std::string joint = right["bodies"][4]["joint"];
    for (const std::string& same : {joint, joint + "#2", "any/" + joint, "any/" + joint + "#12"}) {
        right["bodies"][4]["jointPath"] = same;
        CHECK(profileFromJson(right.dump(), "memory"));
    }
    right["bodies"][4]["joint"] = "a/b#2";  // names may hold anything
    right["bodies"][4]["jointPath"] = "root/a/b#2";
    CHECK(profileFromJson(right.dump(), "memory"));
    for (const std::string& other : {"any" + joint, joint + "#", joint + "#2x", joint + "/"}) {
        right["bodies"][4]["joint"] = joint;
        right["bodies"][4]["jointPath"] = other;
        CHECK_FALSE(profileFromJson(right.dump(), "memory"));
    }
}

TEST_CASE("256 bodies are read, one more is refused") {
    RagdollProfile chain = profileToWrite();
    const BodyProfile link = chain.bodies[1];
    chain.filteredPairs.clear();
    const ConstraintProfile joint = chain.constraints[0];
    chain.bodies = {chain.bodies[0]};
    chain.constraints.clear();
    chain.totalMassKg = chain.bodies[0].massKg;
    const auto add = [&] {
        const int index = static_cast<int>(chain.bodies.size());
        chain.bodies.push_back(link);
        chain.bodies.back().role.reset();
        chain.bodies.back().name = "link " + std::to_string(index);
        chain.bodies.back().joint = chain.bodies.back().jointPath = chain.bodies.back().name;
        chain.constraints.push_back(joint);
        chain.constraints.back().child = index;
        chain.constraints.back().parent = index - 1;
        chain.totalMassKg += link.massKg;
    };
    while (chain.bodies.size() < 256)
        add();
    CHECK(profileFromJson(profileToJson(chain), "memory"));
    add();
    const auto tooMany = profileFromJson(profileToJson(chain), "memory");
    REQUIRE_FALSE(tooMany);
    CHECK(tooMany.error().message.find("/bodies") != std::string::npos);
}

TEST_CASE("a file of version 1 is read by every later version") {
    const auto read = loadProfile(std::string(LUTKA_TESTS_DIR) + "/golden/profiles/biped_v1.ragdoll.json");
    REQUIRE(read);
    const RagdollProfile& profile = read.value();
    CHECK(profile.bodies.size() == 16);
    CHECK(profile.totalMassKg == 75.0F);
    CHECK(profile.bodies[3].shape.kind == BodyShape::Kind::sphere);
    CHECK(profile.bodies[6].shape.halfExtents == vec3(0.04F, 0.08F, 0.015F));
    CHECK(profile.bodies[1].massKg == 12.2475F);
    CHECK(profile.constraints[bodyOf(profile, Role::rightLowerLeg) - 1].kind == ConstraintProfile::Kind::hinge);
    CHECK(profile.constraints[bodyOf(profile, Role::rightLowerLeg) - 1].hinge.upper == Approx(1.2217305));
    CHECK(profile.filteredPairs == std::vector<std::pair<int, int>>{{1, 3}});
    CHECK(profile.notes == std::vector<std::string>{"written by hand for the tests"});
}

TEST_CASE("damaged documents are refused or read, but never crash the reader") {
    const std::string whole = profileToJson(profileToWrite());
    Random random(11);
    int refused = 0;
    constexpr int kTrials = 1500;
    for (int trial = 0; trial < kTrials; ++trial) {
        std::string damaged = whole;
        for (int change = 0; change < 3; ++change) {
            const std::size_t at = random.next() % damaged.size();
            switch (random.next() % 3) {
                case 0:
                    damaged[at] = static_cast<char>(random.next() % 128);
                    break;
                case 1:
                    damaged.erase(at, 1 + random.next() % 40);
                    break;
                default:
                    damaged.insert(at, whole.substr(random.next() % whole.size(), random.next() % 40));
                    break;
            }
        }
        const auto read = profileFromJson(damaged, "damaged");
        refused += read ? 0 : 1;
        if (read) CHECK(validate(read.value()).empty());
    }
    CHECK(refused > kTrials / 2);
}
