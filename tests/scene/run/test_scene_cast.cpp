#include "scene/run/scene_cast.hpp"

#include <glm/geometric.hpp>

#include "animation/import/figure_file.hpp"
#include "physics/profile/profile_io.hpp"
#include "scene/draw/draw_simulation.hpp"
#include "scene/measure/report.hpp"
#include "scene/run/bake.hpp"
#include "scene/run/recording.hpp"
#include "support/catch.hpp"
#include "support/command.hpp"
#include "support/ragdolls.hpp"

using namespace lutka;
using namespace lutka::scene;

namespace {

const std::filesystem::path kMannequin = LUTKA_ASSETS_DIR "/models/mannequin.glb";

EntityId addCharacter(EntityScene& scene, float x, const std::filesystem::path& model) {
    const EntityId id = addEntity(scene, EntityKind::character, {{1, 0, 0, 0}, {x, 0.5F, 0}}).id;
    scene.find<Ragdoll>(id)->model = model;
    return id;
}

std::unique_ptr<scene::RagdollAsset> bipedWithShoulders() {
    LoadOptions options;
    options.fit.shoulderBodies = true;
    auto asset = makeRagdoll(test::makeBiped(), options);
    REQUIRE(asset);
    return std::move(asset).value();
}

// Two dolls of one figure and one of another between them.
struct MixedCrowd {
    std::unique_ptr<RagdollAsset> plain = test::bipedRagdoll();
    std::unique_ptr<RagdollAsset> shouldered = bipedWithShoulders();
    std::vector<const RagdollAsset*> assets{plain.get(), shouldered.get()};
    EntityScene scene;
    std::vector<int> assetOfRagdoll{0, 1, 0};

    MixedCrowd() {
        addEntity(scene, EntityKind::floor, {});
        for (int i = 0; i < 3; ++i)
            addCharacter(scene, static_cast<float>(i) * 2.0F, "");
    }
    [[nodiscard]] std::unique_ptr<Simulation> simulate(physics::SolverKind solver) const {
        const Figure figures[] = {figureOf(*plain), figureOf(*shouldered)};
        auto scenario = compileScene(scene, figures, assetOfRagdoll);
        REQUIRE(scenario);
        SimulationOptions options;
        options.world.solver = solver;
        auto simulation = Simulation::create(assets, std::move(scenario).value(), options);
        REQUIRE(simulation);
        return std::move(simulation).value();
    }
};

}  // namespace

TEST_CASE("characters of one model and profile are loaded once, and others apart") {
    const test::ScratchFolder folder;
    const auto mannequin = loadRagdoll(kMannequin);
    REQUIRE(mannequin);
    physics::RagdollProfile heavy = mannequin.value()->profile;
    for (physics::BodyProfile& body : heavy.bodies) {
        body.massKg *= 2.0F;
        body.inertia *= 2.0F;
    }
    heavy.totalMassKg *= 2.0F;
    REQUIRE(physics::saveProfile(folder / "heavy.ragdoll.json", heavy));
    EntityScene scene;
    addCharacter(scene, 0, kMannequin);
    const EntityId second = addCharacter(scene, 2, kMannequin);
    addCharacter(scene, 4, kMannequin);
    scene.find<Ragdoll>(second)->profile = folder / "heavy.ragdoll.json";
    const auto cast = loadCast(scene, {}, {});
    REQUIRE(cast);
    CHECK(cast.value().assets.size() == 2);
    CHECK(cast.value().assetOfRagdoll == std::vector<int>{0, 1, 0});
    CHECK(cast.value().assets[1]->profile.totalMassKg == Approx(2 * mannequin.value()->profile.totalMassKg));
}

TEST_CASE("two figures of one file stand side by side in a scene") {
    const test::ScratchFolder folder;
    test::makePair().saveBinary(folder / "pair.glb");
    EntityScene scene;
    for (const int figure : {1, 2, 1}) {
        const EntityId id = addCharacter(scene, 2.0F * static_cast<float>(scene.entities.size()), folder / "pair.glb");
        scene.find<Ragdoll>(id)->figure = figure;
    }
    const auto cast = loadCast(scene, {}, {});
    REQUIRE(cast);
    CHECK(cast.value().assetOfRagdoll == std::vector<int>{0, 1, 0});
    CHECK(cast.value().assets[0]->profile.heightM == Approx(cast.value().assets[1]->profile.heightM / 0.8F));
    // A file with one figure has no second.
    scene.all<Ragdoll>().front().model = kMannequin;
    scene.all<Ragdoll>().front().figure = 2;
    const auto refused = loadCast(scene, {}, {});
    REQUIRE_FALSE(refused);
    CHECK(refused.error().code == ErrorCode::usage);
}

TEST_CASE("a character is taken as any rig where the scene says so, and held by bodies of its own names") {
    EntityScene scene;
    const EntityId human = addCharacter(scene, 0, kMannequin);
    const EntityId any = addCharacter(scene, 3, kMannequin);
    scene.find<Ragdoll>(any)->rig = physics::RigKind::any;
    scene.find<Ragdoll>(human)->pins = {"leftHand", "jaw"};
    const auto wrong = loadCast(scene, {}, {});
    REQUIRE_FALSE(wrong);
    CHECK(wrong.error().code == ErrorCode::usage);
    CHECK(wrong.error().message.find("\"jaw\"") != std::string::npos);
    scene.find<Ragdoll>(human)->pins = {"leftHand"};
    const auto loaded = loadCast(scene, {}, {});
    REQUIRE(loaded);
    REQUIRE(loaded.value().assets.size() == 2);
    const physics::RagdollProfile& profile = loaded.value().assets[1]->profile;
    CHECK_FALSE(physics::hasRoles(profile));
    const std::string last = profile.bodies.back().name;
    scene.find<Ragdoll>(any)->pins = {last};
    const auto scenario = compileScene(scene, loaded.value().figures(), loaded.value().assetOfRagdoll);
    REQUIRE(scenario);
    REQUIRE(scenario.value().pins.size() == 2);
    CHECK(scenario.value().pins[1].doll == 1);
    CHECK(scenario.value().pins[1].body == last);
}

TEST_CASE("a missing model, one too many and a scene without characters are usage errors") {
    EntityScene scene;
    const auto refusal = [&](const std::filesystem::path& model) {
        const auto cast = loadCast(scene, model, {});
        REQUIRE_FALSE(cast);
        CHECK(cast.error().code == ErrorCode::usage);
        return cast.error().message;
    };
    CHECK(refusal({}).find("no character") != std::string::npos);
    const EntityId id = addCharacter(scene, 0, "");
    CHECK(refusal({}).find("\"Character\" has no model") != std::string::npos);
    CHECK(loadCast(scene, kMannequin, {}));
    scene.find<Ragdoll>(id)->model = kMannequin;
    CHECK(refusal(kMannequin).find("a model of its own") != std::string::npos);
    scene.find<Ragdoll>(id)->model = "nowhere.glb";
    const auto missing = loadCast(scene, {}, {});
    REQUIRE_FALSE(missing);
    CHECK(missing.error().code == ErrorCode::input);
}

TEST_CASE("a mixed crowd falls sound in both worlds, is drawn, reported, recorded and baked doll by doll") {
    const MixedCrowd crowd;
    for (const auto solver : {physics::SolverKind::bullet, physics::SolverKind::crowd}) {
        INFO(physics::solverName(solver));
        const auto simulation = crowd.simulate(solver);
        REQUIRE(simulation->dollCount() == 3);
        CHECK(&simulation->assetOf(1) == crowd.shouldered.get());
        CHECK(simulation->bodyCount() ==
              2 * crowd.plain->profile.bodies.size() + crowd.shouldered->profile.bodies.size());
        Recording recording = beginRecording(*simulation);
        CHECK(recording.bodiesOfDoll.size() == 3);
        ClipBaker baker(1, 60.0F, "fall");
        for (int step = 0; step < 120; ++step) {
            simulation->step();
            record(*simulation, recording);
            baker.sample(*simulation);
        }
        const physics::Quality quality = simulation->quality();
        CHECK(quality.nonFinite == 0);
        CHECK(quality.jointSeparationM.max < 0.05F);
        CHECK(quality.floorPenetrationM < 0.03F);
        CHECK(reportJson(*simulation).find("\"characters\"") != std::string::npos);
        CHECK(baker.clip().parentFromJoint.size() ==
              120 * static_cast<std::size_t>(crowd.shouldered->character.skeleton.jointCount()));
        // The recording gives back each doll's bodies at their places.
        const test::ScratchFolder folder;
        REQUIRE(saveRecording(folder / "r", recording));
        const auto read = loadRecording(folder / "r");
        REQUIRE(read);
        CHECK(read.value().bodiesOfDoll == recording.bodiesOfDoll);
        const auto again = crowd.simulate(solver);
        again->show(read.value().frame(119));
        for (int doll = 0; doll < 3; ++doll)
            CHECK(again->worldFromBody(doll)[3].translation == simulation->worldFromBody(doll)[3].translation);
        const render::CharacterHandle handles[] = {{7}, {8}};
        SimulationDrawer drawer;
        render::FrameDescription frame;
        drawer.draw(*again, handles, {}, 1.0F, 1.0F, frame);
        REQUIRE(frame.characters.size() == 3);
        CHECK(frame.characters[0].character.index == 7);
        CHECK(frame.characters[1].character.index == 8);
    }
}

TEST_CASE("each character starts in its own pose and with its own velocity") {
    EntityScene scene;
    addEntity(scene, EntityKind::floor, {});
    const EntityId still = addCharacter(scene, 0, kMannequin);
    const EntityId thrown = addCharacter(scene, 3, kMannequin);
    const EntityId walking = addCharacter(scene, 6, kMannequin);
    scene.find<Ragdoll>(thrown)->linearVelocity = {0, 2, 1};
    scene.find<Ragdoll>(walking)->clip = ClipStart{"walk", 0.4F};
    REQUIRE(still != kNoEntity);
    const auto cast = loadCast(scene, {}, {});
    REQUIRE(cast);
    auto scenario = compileScene(scene, cast.value().figures(), cast.value().assetOfRagdoll);
    REQUIRE(scenario);
    const auto made = Simulation::create(cast.value().pointers(), std::move(scenario).value(), {});
    REQUIRE(made);
    Simulation& simulation = *made.value();
    std::vector<physics::BodyState> bodies(simulation.asset().profile.bodies.size());
    simulation.world().getBodies(simulation.world().dolls()[0], bodies);
    CHECK(bodies[0].linearVelocity == vec3(0));
    simulation.world().getBodies(simulation.world().dolls()[1], bodies);
    CHECK(bodies[0].linearVelocity == vec3(0, 2, 1));
    simulation.world().getBodies(simulation.world().dolls()[2], bodies);
    const float fastest = std::max_element(bodies.begin(), bodies.end(), [](const auto& a, const auto& b) {
                              return glm::length(a.linearVelocity) < glm::length(b.linearVelocity);
                          })->linearVelocity.z;
    CHECK(std::abs(fastest) > 0.1F);
    scene.find<Ragdoll>(walking)->clip->clip = "moonwalk";
    auto wrong = compileScene(scene, cast.value().figures(), cast.value().assetOfRagdoll);
    REQUIRE(wrong);
    CHECK_FALSE(Simulation::create(cast.value().pointers(), std::move(wrong).value(), {}));
}

TEST_CASE("a scene's camera looks along its frame's -Z, and its lights shine there") {
    EntityScene scene;
    const quat down = glm::angleAxis(radians(-30), vec3(1, 0, 0));
    const quat turned = glm::angleAxis(radians(40), vec3(0, 1, 0)) * down;
    const RigidTransform stand{turned, {1, 2, 3}};
    addEntity(scene, EntityKind::camera, stand);
    addEntity(scene, EntityKind::sun, stand);
    addEntity(scene, EntityKind::spot, stand);
    const auto scenario = compileScene(scene, {}, {});
    REQUIRE(scenario);
    REQUIRE(scenario.value().camera);
    const render::Camera camera = cameraFor(scenario.value(), 1.6F);
    const vec3 forward = turned * vec3(0, 0, -1);
    CHECK(glm::distance(render::eyeOf(camera), vec3(1, 2, 3)) < 1e-4F);
    CHECK(glm::distance(render::forwardOf(camera), forward) < 1e-4F);
    REQUIRE(scenario.value().sun);
    CHECK(glm::distance(scenario.value().sun->directionToLight, -forward) < 1e-5F);
    REQUIRE(scenario.value().lights.size() == 1);
    CHECK(glm::distance(scenario.value().lights[0].direction, forward) < 1e-5F);
    CHECK(scenario.value().lights[0].outerAngle < kPi);
}

TEST_CASE("a ball, box or capsule without a rigid body is fixed geometry of its own shape") {
    EntityScene scene;
    const RigidTransform place{{1, 0, 0, 0}, {1, 2, 3}};
    for (const EntityKind kind : {EntityKind::box, EntityKind::sphere, EntityKind::capsule})
        scene.remove<RigidBody>(addEntity(scene, kind, place).id);
    CHECK(validate(scene).empty());
    const auto scenario = compileScene(scene, {}, {});
    REQUIRE(scenario);
    CHECK(scenario.value().props.empty());
    using Kind = physics::StaticShape::Kind;
    const Kind expected[] = {Kind::box, Kind::sphere, Kind::capsule};
    REQUIRE(scenario.value().statics.size() == 3);
    for (std::size_t i = 0; i < 3; ++i) {
        const physics::StaticShape& shape = scenario.value().statics[i];
        const Collider& collider = scene.all<Collider>()[i];
        CHECK(shape.kind == expected[i]);
        CHECK(shape.worldFromShape.translation == place.translation);
        if (shape.kind != Kind::box) CHECK(shape.radius == collider.radius);
        if (shape.kind == Kind::capsule) CHECK(shape.halfLength == collider.halfLength);
    }
}
