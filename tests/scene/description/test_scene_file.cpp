#include "scene/description/scene_file.hpp"

#include <nlohmann/json.hpp>

#include "core/random.hpp"
#include "scene/description/scenario.hpp"
#include "support/catch.hpp"
#include "support/command.hpp"
#include "support/json_schema.hpp"

using namespace lutka;
using namespace lutka::scene;
using Json = nlohmann::json;
namespace fs = std::filesystem;

namespace {

// One of every kind, nothing at its default.
EntityScene richScene() {
    EntityScene scene;
    scene.name = "all kinds";
    Random random(3);
    const auto some = [&] { return random.uniform(0.1F, 0.9F); };
    for (int kind = 0; kind < kEntityKindCount; ++kind) {
        const quat turn = glm::normalize(quat(some(), some(), some(), some()));
        addEntity(scene, static_cast<EntityKind>(kind), {turn, {some(), some(), some()}});
    }
    REQUIRE(reparentEntity(scene, 3, 2));
    for (Ragdoll& ragdoll : scene.all<Ragdoll>()) {
        ragdoll.model = "models/a.glb";
        ragdoll.figure = 2;
        ragdoll.profile = "profiles/a.ragdoll.json";
        ragdoll.pose = StartPose::node;
        ragdoll.clip = ClipStart{"run", some()};
        ragdoll.rig = physics::RigKind::any;
        ragdoll.pins = {"leftHand", "Tail3"};
        ragdoll.linearVelocity = {some(), some(), some()};
        ragdoll.angularVelocity = {some(), some(), some()};
        ragdoll.strength = some();
        ragdoll.hits = {{animation::Role::head, some(), {some(), some(), some()}},
                        {animation::Role::leftLowerArm, some(), {some(), some(), some()}}};
    }
    for (MeshRenderer& mesh : scene.all<MeshRenderer>()) {
        mesh.color = {1, 200, 33, 255};
        mesh.opacity = some();
        mesh.castsShadow = false;
        mesh.visible = false;
    }
    for (RigidBody& body : scene.all<RigidBody>()) {
        body.massKg = some();
        body.linearVelocity = {some(), some(), some()};
    }
    for (Light& light : scene.all<Light>()) {
        light.color = {some(), some(), some()};
        light.intensity = some();
    }
    for (Camera& camera : scene.all<Camera>()) {
        camera.orthographic = true;
        camera.distance = some();
    }
    scene.simulation.world.solver = physics::SolverKind::crowd;
    scene.simulation.world.gravity = {0.1F, -1.62F, 0};
    scene.simulation.world.substeps = 4;
    scene.simulation.world.iterations = 12;
    scene.simulation.world.linearDamping = 0.3F;
    scene.simulation.world.threads = 2;
    scene.simulation.dt = 1.0F / 120.0F;
    scene.simulation.seed = 42;
    scene.simulation.puppets = ScenePuppets{
        "run", physics::MusclePreset::weak, some(), 1234.0F, {{"leg", 1.0F}, {"leftFoot", 0.25F}}, true, true, some()};
    return scene;
}

std::string problemsOf(const Json& document) {
    const auto read = sceneFromJson(document.dump(), "test");
    REQUIRE_FALSE(read);
    CHECK(read.error().code == ErrorCode::input);
    CHECK(read.error().location == "test");
    CHECK_FALSE(read.error().mend.empty());
    return read.error().message;
}

}  // namespace

TEST_CASE("a scene goes through its file and back exactly, and is written the same again") {
    const fs::path folder = "/somewhere/scenes";
    EntityScene scene = richScene();
    scene.find<Ragdoll>(1)->model = "/somewhere/models/a.glb";
    scene.find<Ragdoll>(1)->profile = "/somewhere/scenes/a.ragdoll.json";
    const std::string text = sceneToJson(scene, folder);
    CHECK(Json::parse(text)["entities"][0]["ragdoll"]["model"] == "../models/a.glb");
    CHECK(Json::parse(text)["entities"][0]["ragdoll"]["profile"] == "a.ragdoll.json");
    const auto read = sceneFromJson(text, "test", folder);
    REQUIRE(read);
    CHECK(read.value() == scene);
    CHECK(sceneToJson(read.value(), folder) == text);
}

TEST_CASE("every named scene goes through its file and back exactly") {
    const FigureBounds figure{{-0.8F, 0, -0.1F}, {0.8F, 1.75F, 0.1F}};
    for (const ScenarioInfo& info : scenarioRegistry()) {
        INFO(info.name);
        const auto scene = makeScene(info.name, 5, 9, figure);
        REQUIRE(scene);
        const auto read = sceneFromJson(sceneToJson(scene.value()), "test");
        REQUIRE(read);
        CHECK(read.value() == scene.value());
    }
}

TEST_CASE("a scene file is written whole and read from disk, and a folder that is none is an output error") {
    const test::ScratchFolder folder;
    const fs::path file = folder / "a.scene.json";
    REQUIRE(saveScene(file, richScene()));
    const auto read = loadScene(file);
    REQUIRE(read);
    CHECK(read.value().entities.size() == static_cast<std::size_t>(kEntityKindCount));
    REQUIRE(saveScene(folder / "plain", EntityScene{}));
    const auto refused = saveScene(fs::path(folder / "plain") / "b.scene.json", richScene());
    REQUIRE_FALSE(refused);
    CHECK(refused.error().code == ErrorCode::output);
    CHECK_FALSE(loadScene(folder / "missing.scene.json"));
    CHECK(isSceneFile("x/a.scene.json"));
    CHECK_FALSE(isSceneFile("x/a.ragdoll.json"));
}

TEST_CASE("what a file leaves out has its default") {
    const auto read = sceneFromJson(R"({"format": "lutka.scene", "version": 1, "entities": [
        {"id": 4, "name": "thing", "collider": {"kind": "sphere"}, "ragdoll": {}, "light": {"kind": "point"}}]})",
                                    "test");
    REQUIRE_FALSE(read);  // a ragdoll beside a collider
    const auto sound = sceneFromJson(R"({"format": "lutka.scene", "version": 1, "entities": [
        {"id": 4, "name": "thing", "collider": {"kind": "sphere"}, "rigidBody": {}, "light": {"kind": "point"}}]})",
                                     "test");
    REQUIRE(sound);
    CHECK(*sound.value().find<Collider>(4) == Collider{.entity = 4, .kind = Collider::Kind::sphere});
    CHECK(sound.value().simulation == SceneSimulation{});
}

TEST_CASE("every planted fault of a scene is listed in one go with its place") {
    Json wrong = Json::parse(sceneToJson(richScene()));
    wrong["colour"] = "red";
    wrong["simulation"]["solver"] = "magic";
    wrong["simulation"]["step"] = "fast";
    wrong["entities"][0].erase("name");
    wrong["entities"][0]["ragdoll"]["pins"][0] = 7;
    wrong["entities"][0]["ragdoll"]["rig"] = "spider";
    wrong["entities"][1]["collider"]["halfExtents"][2] = 0;
    wrong["entities"][1]["collider"]["radius"] = 1;
    wrong["entities"][1]["meshRenderer"]["color"] = "grey";
    wrong["entities"][2]["id"] = 1;
    wrong["entities"][3]["parent"] = 99;
    wrong["entities"][4]["transform"]["rotation"] = {0, 0, 0, 0.5};
    wrong["entities"][5]["collider"]["steps"] = 3.5;
    wrong["entities"][7]["light"]["castsShadow"] = "yes";
    const std::string problems = problemsOf(wrong);
    for (const char* place :
         {"/colour: unknown key", "/simulation/solver: expected one of", "/simulation/step: expected a number",
          "/entities/0: expected a member \"name\"", "/entities/0/ragdoll/pins/0: expected",
          "/entities/0/ragdoll/rig: expected one of", "/entities/1/collider/halfExtents/2: expected a number in",
          "/entities/1/collider/radius: unknown key", "/entities/1/meshRenderer/color: expected a colour",
          "/entities/2/id: expected an id of its own", "/entities/3/parent: expected the id of another entity",
          "/entities/4/transform/rotation: expected a quat", "/entities/5/collider/steps: expected a whole number",
          "/entities/7/light/castsShadow: expected true"}) {
        INFO(problems);
        CHECK(problems.find(place) != std::string::npos);
    }
}

TEST_CASE("faults of clips, strengths and hits are named with their places") {
    Json wrong = Json::parse(sceneToJson(richScene()));
    wrong["simulation"]["puppets"]["muscles"] = "iron";
    wrong["simulation"]["puppets"]["strength"] = -1;
    wrong["simulation"]["puppets"]["colour"] = "red";
    for (Json& entity : wrong["entities"]) {
        if (!entity.contains("ragdoll")) continue;
        entity["ragdoll"]["hits"][0]["body"] = "tail";
        entity["ragdoll"]["hits"][1]["seconds"] = -2;
        entity["ragdoll"]["hits"][1]["impulse"] = {1, 2};
        entity["ragdoll"]["strength"] = -3;
    }
    const std::string problems = problemsOf(wrong);
    for (const char* place :
         {"/simulation/puppets/muscles", "/simulation/puppets/strength", "colour", "/ragdoll/hits/0/body",
          "/ragdoll/hits/1/seconds", "/ragdoll/hits/1/impulse", "/ragdoll/strength"}) {
        INFO(place);
        CHECK(problems.find(place) != std::string::npos);
    }
}

TEST_CASE("another format, another version, no JSON and a key that stands twice are refused") {
    CHECK(problemsOf({{"format", "lutka-ragdoll"}, {"version", 1}}).find("/format") != std::string::npos);
    CHECK(problemsOf({{"format", "lutka.scene"}, {"version", 2}}).find("newer program") != std::string::npos);
    CHECK(problemsOf(Json::array()).find("expected an object") != std::string::npos);
    CHECK_FALSE(sceneFromJson("{", "test"));
    const auto twice = sceneFromJson(R"({"format": "lutka.scene", "version": 1, "entities": [], "name": "a",
                                         "name": "b"})",
                                     "test");
    REQUIRE_FALSE(twice);
    CHECK(twice.error().message.find("\"name\" stands twice") != std::string::npos);
}

TEST_CASE("the committed schema describes what is written of a scene, and the committed scenes") {
    const Json schema = Json::parse(test::fileText(LUTKA_ASSETS_DIR "/scenes/scene.schema.json"));
    const auto check = [&](const Json& document) {
        for (const std::string& problem : test::checkSchema(schema, document))
            FAIL_CHECK(problem);
    };
    check(Json::parse(sceneToJson(richScene())));
    int scenes = 0;
    for (const auto& entry : fs::directory_iterator(LUTKA_ASSETS_DIR "/scenes")) {
        if (!isSceneFile(entry.path())) continue;
        INFO(entry.path().string());
        ++scenes;
        check(Json::parse(test::fileText(entry.path())));
        const auto scene = loadScene(entry.path());
        REQUIRE(scene);
        CHECK(sceneToJson(scene.value(), entry.path().parent_path()) == test::fileText(entry.path()));
        for (const Ragdoll& ragdoll : scene.value().all<Ragdoll>())
            CHECK(fs::exists(ragdoll.model));
    }
    CHECK(scenes >= 1);
    Json wrong = Json::parse(sceneToJson(richScene()));
    wrong["entities"][0]["id"] = 0;
    wrong["colour"] = "red";
    CHECK(test::checkSchema(schema, wrong).size() == 2);
}

TEST_CASE("a scene file of version 1 is read by every later version") {
    const fs::path file = LUTKA_TESTS_DIR "/golden/scenes/all_v1.scene.json";
    if (!fs::exists(file)) {
        REQUIRE(saveScene("all_v1.scene.json", richScene()));
        FAIL("there was no golden file: look at all_v1.scene.json and copy it to tests/golden/scenes");
    }
    const auto read = loadScene(file);
    REQUIRE(read);
    const EntityScene& scene = read.value();
    CHECK(scene.entities.size() == static_cast<std::size_t>(kEntityKindCount));
    CHECK(scene.simulation.world.solver == physics::SolverKind::crowd);
    CHECK(scene.simulation.world.substeps == 4);
    CHECK(scene.find<Collider>(6)->kind == Collider::Kind::stairs);
    CHECK(scene.find<Ragdoll>(1)->pins.size() == 2);
    CHECK(scene.find<Ragdoll>(1)->clip->clip == "run");
    CHECK(scene.find<MeshRenderer>(2)->color == render::Color{1, 200, 33, 255});
    CHECK(findEntity(scene, 3)->parent == 2);
    CHECK(sceneToJson(scene, file.parent_path()) == test::fileText(file));
}

TEST_CASE("damaged scenes are refused or read, but never crash the reader") {
    const std::string whole = sceneToJson(richScene());
    Random random(5);
    int refused = 0;
    constexpr int trials = 1500;
    for (int trial = 0; trial < trials; ++trial) {
        std::string damaged = whole;
        for (int change = 0; change < 3; ++change) {
            const std::size_t at = random.next() % damaged.size();
            const std::uint64_t how = random.next() % 3;
            if (how == 0) {
                damaged[at] = static_cast<char>(random.next() % 128);
            } else if (how == 1) {
                damaged.erase(at, 1 + random.next() % 40);
            } else {
                damaged.insert(at, whole.substr(random.next() % whole.size(), random.next() % 40));
            }
        }
        const auto read = sceneFromJson(damaged, "damaged");
        refused += read ? 0 : 1;
        if (read) CHECK(validate(read.value()).empty());
    }
    CHECK(refused > trials / 2);
}
