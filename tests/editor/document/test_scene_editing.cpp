#include <glm/geometric.hpp>

#include "editor/editor.hpp"
#include "editor/sessions.hpp"
#include "scene/description/scene_file.hpp"
#include "support/command.hpp"

using namespace lutka;
using namespace lutka::editor;
using scene::EntityId;
using scene::EntityKind;
using scene::EntityScene;

namespace {

const std::filesystem::path kPlayground = LUTKA_ASSETS_DIR "/scenes/playground.scene.json";

EntityId add(Editor& editor, EntityKind kind, const vec3& at) {
    EntityId id = scene::kNoEntity;
    REQUIRE(editor.editScene("Add", "", [&](EntityScene& scene) {
        id = scene::addEntity(scene, kind, {{1, 0, 0, 0}, at}).id;
    }));
    return id;
}

std::unique_ptr<Editor> playground() {
    EditorOptions options;
    options.sceneFile = kPlayground;
    auto editor = Editor::create(options);
    REQUIRE(editor);
    return std::move(editor).value();
}

EntityId named(const Editor& editor, const std::string& name) {
    for (const scene::Entity& entity : editor.document().scene().entities) {
        if (entity.name == name) return entity.id;
    }
    FAIL(name + " is not there");
    return scene::kNoEntity;
}

}  // namespace

TEST_CASE("another named scene takes the place of its entities and leaves those that the user added") {
    const auto editor = test::makeEditor();
    const EntityId own = add(*editor, EntityKind::box, {2, 0.25F, 0});
    SceneSettings settings = editor->document().sceneDocument().settings();
    settings.scenario = "stairs";
    settings.count = 3;
    REQUIRE(editor->edit([&](EditorDocument& document) { return document.setScene(settings, "Scene"); }));
    const EntityScene& scene = editor->document().scene();
    CHECK(scene.all<scene::Ragdoll>().size() == 3);
    CHECK(named(*editor, "Stairs") != scene::kNoEntity);
    CHECK(scene::worldFromEntity(scene, own).translation == vec3(2, 0.25F, 0));
    CHECK(editor->player().simulation().dollCount() == 3);
    CHECK(scene::validate(scene).empty());
    editor->perform(Action::undo);
    CHECK(editor->document().scene().all<scene::Ragdoll>().size() == 1);
}

TEST_CASE("dolls and balls go on where they are while the scene around them is edited, what is moved starts there") {
    const auto editor = test::makeEditor();
    const EntityId ball = add(*editor, EntityKind::sphere, {1.5F, 2, 0});
    for (int frame = 0; frame < 20; ++frame)
        editor->update(1.0 / 60.0);
    const vec3 hips = test::placeOf(*editor, animation::Role::hips);
    const auto placeOfBall = [&] {
        return editor->player()
            .simulation()
            .world()
            .propState(editor->player().simulation().world().props()[0])
            .worldFromBody.translation;
    };
    const vec3 fallen = placeOfBall();
    CHECK(fallen.y < 1.9F);
    const EntityId second = add(*editor, EntityKind::character, {-3, 1, 0});
    CHECK(glm::distance(test::placeOf(*editor, animation::Role::hips), hips) < 1e-4F);
    CHECK(glm::distance(placeOfBall(), fallen) < 1e-4F);
    REQUIRE(editor->editScene("Move", "", [&](EntityScene& scene) {
        scene::placeEntity(scene, ball, {{1, 0, 0, 0}, {1.5F, 3, 0}});
        scene::placeEntity(scene, second, {{1, 0, 0, 0}, {-5, 1, 0}});
    }));
    CHECK(editor->player().worldFromEntity(ball).translation.y == Approx(3.0F));
    CHECK(editor->player().bodiesOf(1).front().worldFromBody.translation.x == Approx(-5.0F).margin(0.1));
    CHECK(glm::distance(test::placeOf(*editor, animation::Role::hips), hips) < 1e-4F);
}

TEST_CASE("what no scene can have is refused and nothing is changed") {
    const auto editor = test::makeEditor();
    const EntityId box = add(*editor, EntityKind::box, {2, 0.25F, 0});
    const EntityScene before = editor->document().scene();
    CHECK_FALSE(editor->editScene("Edit", "",
                                  [&](EntityScene& scene) { scene.find<scene::Collider>(box)->halfExtents.x = -1; }));
    CHECK_FALSE(editor->editScene("Edit", "", [&](EntityScene& scene) { scene.add(box, scene::Ragdoll{}); }));
    CHECK_FALSE(editor->editScene(
        "Edit", "", [&](EntityScene& scene) { scene.all<scene::Ragdoll>().front().model = "nowhere.glb"; }));
    CHECK_FALSE(editor->editScene("Edit", "", [&](EntityScene& scene) {
        scene.all<scene::Ragdoll>().front().clip = scene::ClipStart{"moonwalk", 0};
    }));
    CHECK(editor->document().scene() == before);
    CHECK(editor->workspace().toasts.size() >= 3);
}

TEST_CASE("a drag of a slider is one entry of undo") {
    const auto editor = test::makeEditor();
    const EntityId light = add(*editor, EntityKind::spot, {0, 3, 0});
    for (int i = 1; i < 6; ++i) {
        editor->editScene("Light", "intensity", [&](EntityScene& scene) {
            scene.find<scene::Light>(light)->intensity = static_cast<float>(i);
        });
    }
    editor->document().endGroup();
    CHECK(editor->document().scene().find<scene::Light>(light)->intensity == 5.0F);
    editor->perform(Action::undo);
    CHECK(editor->document().scene().find<scene::Light>(light)->intensity == 4.0F);
    editor->perform(Action::undo);
    CHECK(editor->document().scene().all<scene::Light>().empty());
}

TEST_CASE("a scene file opens with its characters, camera and lights, and is saved as it was") {
    const auto editor = playground();
    CHECK(editor->document().sceneDocument().assets().size() == 2);
    CHECK(editor->player().simulation().dollCount() == 3);
    CHECK_FALSE(editor->document().sceneDocument().unsaved());
    CHECK(editor->document().sceneDocument().file() == kPlayground);
    const test::ScratchFolder folder;
    const std::filesystem::path copy = folder / "copy.scene.json";
    REQUIRE(editor->document().sceneDocument().save(copy));
    const auto read = scene::loadScene(copy);
    REQUIRE(read);
    CHECK(read.value().entities == editor->document().scene().entities);
    CHECK(std::filesystem::equivalent(read.value().all<scene::Ragdoll>().front().model,
                                      LUTKA_ASSETS_DIR "/models/mannequin.glb"));
    for (int frame = 0; frame < 60; ++frame)
        editor->update(1.0 / 60.0);
    CHECK(editor->player().simulation().quality().nonFinite == 0);
}

TEST_CASE("the character that is edited can be changed for another of the scene") {
    const auto editor = playground();
    const EntityId heavy = named(*editor, "Heavy on the ramp");
    const auto ragdoll = [&] { return *editor->document().scene().find<scene::Ragdoll>(heavy); };
    CHECK_FALSE(editor->document().sceneDocument().isEdited(ragdoll()));
    const float light = editor->document().profile().totalMassKg;
    editor->editCharacter(heavy);
    CHECK(editor->document().sceneDocument().isEdited(ragdoll()));
    CHECK(editor->document().profile().totalMassKg > light + 50.0F);
    CHECK(editor->document().sceneDocument().assets().size() == 2);
    CHECK(editor->player().simulation().dollCount() == 3);
    CHECK_FALSE(editor->files().asking());
}

TEST_CASE("a character of another profile is pulled and pinned by its bodies, and stays where the scene has it") {
    const auto editor = playground();
    const EntityId heavy = named(*editor, "Heavy on the ramp");
    const int doll = editor->player().dollOf(heavy);
    REQUIRE(doll > 0);
    REQUIRE_FALSE(editor->player().isEditedDoll(doll));
    const EntityScene before = editor->document().scene();
    test::pass(*editor, 5);
    editor->player().setPlaying(false);  // posed without gravity: it is too heavy to be lifted by a hand
    const auto place = [&] { return editor->player().bodiesOf(doll).front().worldFromBody.translation; };
    render::Camera& camera = editor->workspace().camera;
    // From where nothing is in between.
    const auto seen = [&] {
        const auto pick = editor->workspace().pickUnderMouse();
        return pick && pick->body && pick->body->doll == doll;
    };
    for (int turn = 0; turn < 12 && !seen(); ++turn) {
        camera.yaw = radians(30.0F * static_cast<float>(turn));
        render::frameSphere(camera, place(), 1.0F, editor->workspace().window.aspect());
        editor->handle(mouseMoved(vec2(*render::project(camera, place(), editor->workspace().window))), {});
    }
    REQUIRE(seen());
    test::send(*editor, mouseButton(MouseButton::left, true));
    REQUIRE(editor->workspace().press->pick);
    REQUIRE(editor->workspace().press->pick->body);
    CHECK(editor->workspace().press->pick->body->doll == doll);
    CHECK(editor->workspace().selection.active() == Item{Item::Kind::object, 0, static_cast<int>(heavy)});
    test::send(*editor, mouseMoved(editor->workspace().mouse + vec2(0, -8)));
    REQUIRE(editor->state() == State::grab);
    REQUIRE(editor->workspace().pulls.mouse);
    const Pull held = *editor->workspace().pulls.mouse;
    CHECK(held.doll == doll);
    test::send(*editor, mouseMoved(editor->workspace().mouse + vec2(0, -150)));
    const vec3 target = editor->workspace().pulls.mouse->target;
    CHECK(target.y > held.target.y + 0.2F);
    const auto miss = [&] {
        const auto& profile = editor->player().simulation().assetOf(doll).profile;
        const auto body = static_cast<std::size_t>(physics::bodyNamed(profile, held.body));
        return glm::distance(editor->player().bodiesOf(doll)[body].worldFromBody * held.bodyPoint, target);
    };
    const float far = miss();
    test::pass(*editor, 60);
    CHECK(miss() < 0.5F * far);

    test::send(*editor, keyPressed(Key::p));
    CHECK(editor->state() != State::grab);
    CHECK(editor->workspace().pulls.pins.size() == 1);
    test::send(*editor, keyPressed(Key::p));
    CHECK(editor->workspace().pulls.pins.empty());
    CHECK(editor->document().scene() == before);
    CHECK_FALSE(editor->document().sceneDocument().unsaved());
}

TEST_CASE("unsaved changes of a scene are marked and asked about, and Ctrl+S saves a scene that has a file") {
    const test::ScratchFolder folder;
    const auto editor = playground();
    REQUIRE(editor->document().sceneDocument().save(folder / "own.scene.json"));
    add(*editor, EntityKind::capsule, {0, 3, 2});
    CHECK(editor->document().sceneDocument().unsaved());
    CHECK_FALSE(editor->document().unsaved());
    editor->perform(Action::quit);
    REQUIRE(editor->files().askingUnsaved());
    editor->files().answer(FileFlow::Answer::cancel);
    CHECK_FALSE(editor->quitting());
    editor->perform(Action::saveProfile);
    CHECK_FALSE(editor->document().sceneDocument().unsaved());
    const auto read = scene::loadScene(folder / "own.scene.json");
    REQUIRE(read);
    CHECK(read.value().entities.back().name == "Capsule");
    editor->perform(Action::undo);
    CHECK(editor->document().sceneDocument().unsaved());
    editor->perform(Action::quit);
    editor->files().answer(FileFlow::Answer::discard);
    CHECK(editor->quitting());
}

TEST_CASE("a scene that is dropped on the window opens, and a faulty one leaves everything as it was") {
    const auto editor = test::makeEditor();
    InputEvent drop;
    drop.kind = InputEvent::Kind::drop;
    drop.files = {kPlayground};
    editor->handle(drop, {});
    CHECK(editor->document().scene().name == "playground");
    CHECK(editor->document().sceneDocument().file() == kPlayground);
    const test::ScratchFolder folder;
    std::ofstream(folder / "bad.scene.json") << R"({"format": "lutka.scene", "version": 1})";
    const EntityScene before = editor->document().scene();
    editor->open(folder / "bad.scene.json");
    CHECK(editor->document().scene() == before);
    CHECK(editor->workspace().toasts.back().kind == Toast::Kind::error);
}

TEST_CASE("a camera takes the view and gives it back") {
    const auto editor = test::makeEditor();
    const EntityId camera = add(*editor, EntityKind::camera, {0, 1, 5});
    const render::Camera view = editor->workspace().camera;
    editor->placeCamera(camera);
    editor->workspace().camera.yaw += 1.0F;
    editor->workspace().camera.distance *= 2.0F;
    editor->lookThrough(camera);
    CHECK(glm::distance(render::eyeOf(editor->workspace().camera), render::eyeOf(view)) < 1e-3F);
    CHECK(glm::distance(render::forwardOf(editor->workspace().camera), render::forwardOf(view)) < 1e-4F);
}

TEST_CASE("copies are dropped as characters of the scene, and one undo takes them away") {
    const auto editor = test::makeEditor();
    editor->dropCopies(20);
    CHECK(editor->player().simulation().dollCount() == 21);
    for (int frame = 0; frame < 30; ++frame)
        editor->update(1.0 / 60.0);
    CHECK(editor->player().simulation().quality().nonFinite == 0);
    editor->perform(Action::undo);
    CHECK(editor->player().simulation().dollCount() == 1);
}

TEST_CASE("a recording replays what was simulated, can be scrubbed, saved and opened, and the fall goes on after it") {
    const test::ScratchFolder folder;
    const auto editor = test::makeEditor();
    Player& player = editor->player();
    player.startRecording();
    std::vector<vec3> heights;
    for (int frame = 0; frame < 40; ++frame) {
        heights.push_back(player.simulation().worldFromBody(0)[0].translation);
        editor->update(1.0 / 60.0);
    }
    player.stopRecording();
    CHECK(player.deck().steps() == 41);
    const vec3 end = player.simulation().worldFromBody(0)[0].translation;
    REQUIRE(player.replay());
    player.setPlaying(false);
    player.scrubTo(10.0 / 60.0);
    CHECK(glm::distance(player.simulation().worldFromBody(0)[0].translation, heights[10]) < 1e-4F);
    player.scrubTo(1e9);
    CHECK(glm::distance(player.simulation().worldFromBody(0)[0].translation, end) < 1e-5F);
    REQUIRE(player.deck().save(folder / "fall"));
    player.endReplay();
    CHECK(glm::distance(player.simulation().worldFromBody(0)[0].translation, end) < 1e-5F);
    editor->perform(Action::reset);
    REQUIRE(player.openRecording(folder / "fall"));
    CHECK(player.deck().replaying());
    player.setPlaying(true);
    for (int frame = 0; frame < 20; ++frame)
        editor->update(1.0 / 60.0);
    CHECK(player.deck().position() == Approx(20.0 / 60.0).margin(1e-3));
    editor->perform(Action::reset);
    CHECK_FALSE(player.deck().replaying());
    CHECK_FALSE(player.openRecording(folder / "nowhere"));
}

TEST_CASE("a take goes on when copies and balls come in, shows them from then on, and is replayed after a reset") {
    const auto editor = test::makeEditor();
    Player& player = editor->player();
    player.startRecording();
    test::pass(*editor, 10);
    editor->dropCopies(1);
    test::pass(*editor, 10);
    editor->perform(Action::throwBall);
    test::pass(*editor, 10);
    REQUIRE(player.deck().recording());
    const vec3 ball = player.simulation().worldFromProp(0).translation;
    player.stopRecording();
    editor->perform(Action::reset);  // the ball is gone
    REQUIRE(player.deck().takes().size() == 1);
    CHECK(player.deck().takes()[0].name == "Take 1");
    CHECK(player.deck().seconds() == Approx(0.5).margin(0.001));
    REQUIRE(player.replay());
    CHECK(player.deck().missing() == 0);
    player.setPlaying(false);
    player.scrubTo(5.0 / 60.0);
    CHECK_FALSE(player.simulation().showsDoll(1));
    CHECK_FALSE(player.simulation().showsProp(0));
    player.scrubTo(15.0 / 60.0);
    CHECK(player.simulation().showsDoll(1));
    CHECK_FALSE(player.simulation().showsProp(0));
    player.scrubTo(1.0);
    CHECK(player.simulation().showsProp(0));
    CHECK(glm::distance(player.simulation().worldFromProp(0).translation, ball) < 1e-4F);
    player.endReplay();
    CHECK(player.simulation().showsDoll(1));
    CHECK(player.simulation().world().props().size() == 0);
}

TEST_CASE("no take is lost: a second Record begins another, and what ends one by itself is told") {
    const auto editor = test::makeEditor();
    Player& player = editor->player();
    player.startRecording();
    test::pass(*editor, 20);
    editor->perform(Action::reset);
    test::pass(*editor, 1);
    CHECK_FALSE(player.deck().recording());
    REQUIRE_FALSE(editor->workspace().toasts.empty());
    CHECK(editor->workspace().toasts.back().text.find("Take 1 (0.3 s) ended") != std::string::npos);
    player.startRecording();
    test::pass(*editor, 30);
    player.stopRecording();
    REQUIRE(player.deck().takes().size() == 2);
    CHECK(player.deck().current() == 1);
    player.deck().choose(0);
    CHECK(player.deck().seconds() == Approx(20.0 / 60.0).margin(0.001));
    // Another model has takes of its own beside these.
    test::send(*editor, filesDropped({LUTKA_ASSETS_DIR "/models/mannequin.glb"}));
    CHECK(editor->document().character().name == "mannequin");
    CHECK(editor->player().deck().takes().size() == 2);
    CHECK_FALSE(editor->player().replay());
}

TEST_CASE("takes that are in no file are part of the question at the end, and Save writes each") {
    const test::ScratchFolder folder;
    std::filesystem::copy_file(LUTKA_ASSETS_DIR "/models/mannequin.glb", folder / "doll.glb");
    const auto editor = test::makeEditor();
    test::send(*editor, filesDropped({std::filesystem::path(folder / "doll.glb").string()}));
    Player& player = editor->player();
    for (int take = 0; take < 2; ++take) {
        player.startRecording();
        test::pass(*editor, 10);
        player.stopRecording();
    }
    test::send(*editor, windowClosed());
    REQUIRE(editor->files().askingUnsaved());
    CHECK(editor->files().askingTakes());
    editor->files().answer(FileFlow::Answer::save);
    CHECK(editor->quitting());
    CHECK(std::filesystem::exists(folder / "doll.Take_1.recording"));
    CHECK(std::filesystem::exists(folder / "doll.Take_2.recording"));
    CHECK_FALSE(player.deck().anyUnsaved());
}
