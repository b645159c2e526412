#include "editor/document/scene_document.hpp"

#include "editor/sessions.hpp"
#include "scene/description/scene_file.hpp"
#include "support/command.hpp"
#include "support/zoo.hpp"

using namespace lutka;
using namespace lutka::editor;

namespace {

// A scene around the hand-made figure, as the editor begins with it.
struct Session {
    std::unique_ptr<scene::RagdollAsset> asset = std::move(scene::makeRagdoll(test::makeBiped())).value();
    SceneDocument document{*asset};

    Session() { REQUIRE(document.start({}).ok()); }
    // Prepares and adopts; whether it was let in.
    bool change(const std::function<void(SceneSettings&)>& change) {
        SceneSettings next = document.settings();
        change(next);
        auto prepared = document.prepare(std::move(next));
        if (prepared) document.adopt(std::move(prepared).value());
        return prepared.ok();
    }
};

}  // namespace

TEST_CASE("a scene that begins is made, saved, and has the edited character alone") {
    const Session session;
    CHECK_FALSE(session.document.scene().entities.empty());
    CHECK_FALSE(session.document.unsaved());
    CHECK_FALSE(session.document.hasFile());
    CHECK(session.document.assets() == std::vector<const scene::RagdollAsset*>{session.asset.get()});
}

TEST_CASE("what no scene can have is refused by prepare() and changes nothing") {
    Session session;
    const scene::EntityScene before = session.document.scene();
    CHECK_FALSE(session.change([](SceneSettings& next) { next.entities.simulation.dt = -1.0F; }));
    CHECK_FALSE(session.change([](SceneSettings& next) {
        next.entities.all<scene::Ragdoll>().front().clip = scene::ClipStart{"no such clip", 0.0F};
    }));
    CHECK_FALSE(session.change(
        [](SceneSettings& next) { next.entities.all<scene::Ragdoll>().front().model = "no such file.glb"; }));
    CHECK(session.document.scene() == before);
    CHECK_FALSE(session.document.unsaved());
}

TEST_CASE("another number of dolls makes the named scene anew and earlier settings come back by adopt()") {
    Session session;
    const SceneSettings before = session.document.settings();
    REQUIRE(session.change([](SceneSettings& next) { next.count = 3; }));
    CHECK(session.document.scene().all<scene::Ragdoll>().size() == 3);
    CHECK(session.document.assetOfRagdoll() == std::vector<int>{0, 0, 0});
    session.document.adopt(before);
    CHECK(session.document.scene() == before.entities);
}

TEST_CASE("a scene is unsaved from a change of its entities until it is saved or the change is taken back") {
    const test::ScratchFolder folder;
    Session session;
    const auto addBox = [](SceneSettings& next) {
        scene::addEntity(next.entities, scene::EntityKind::box, RigidTransform{});
    };
    const SceneSettings before = session.document.settings();
    REQUIRE(session.change(addBox));
    CHECK(session.document.unsaved());
    session.document.adopt(before);
    CHECK_FALSE(session.document.unsaved());
    REQUIRE(session.change(addBox));
    REQUIRE(session.document.save(folder / "own.scene.json").ok());
    CHECK_FALSE(session.document.unsaved());
    CHECK(session.document.file() == folder / "own.scene.json");
    session.document.adopt(before);  // the file has the box
    CHECK(session.document.unsaved());
}

TEST_CASE("a character that its scene takes as any skeleton is so in the editor: the first, another one, and saved") {
    NEEDS_ZOO();
    const test::ScratchFolder folder;
    const std::filesystem::path fox = std::filesystem::canonical(test::zooFile("fox/Fox.glb"));
    const auto asset = scene::makeRagdoll(test::makeBiped());
    auto made = scene::makeScene("drop", 1, 0, scene::figureOf(*asset.value()).bounds);
    REQUIRE(made.ok());
    scene::EntityScene foxes = std::move(made).value();
    foxes.all<scene::Ragdoll>().front().model = fox;
    foxes.all<scene::Ragdoll>().front().rig = physics::RigKind::any;
    const std::filesystem::path file = folder / "foxes.scene.json";
    REQUIRE(scene::saveScene(file, foxes).ok());

    EditorOptions options;
    options.sceneFile = file;
    const auto first = Editor::create(options);
    REQUIRE(first.ok());
    CHECK(first.value()->document().character().file == fox);
    CHECK_FALSE(physics::hasRoles(first.value()->document().profile()));
    CHECK(first.value()->document().sceneDocument().assets().size() == 1);

    const auto editor = test::makeEditor();
    test::send(*editor, filesDropped({file.string()}));
    CHECK(editor->document().character().file == fox);
    const std::filesystem::path again = folder / "again.scene.json";
    REQUIRE(editor->document().sceneDocument().save(again).ok());
    const auto read = scene::loadScene(again);
    REQUIRE(read.ok());
    CHECK(read.value().all<scene::Ragdoll>().front().rig == physics::RigKind::any);

    // Beside a humanoid, which is the one that is edited.
    const auto other = test::makeEditor();
    CHECK_FALSE(other->editScene("Model", "",
                                 [&](scene::EntityScene& scene) { scene.all<scene::Ragdoll>().front().model = fox; }));
    CHECK(other->editScene("Model", "", [&](scene::EntityScene& scene) {
        scene.all<scene::Ragdoll>().front().model = fox;
        scene.all<scene::Ragdoll>().front().rig = physics::RigKind::any;
    }));
    CHECK(other->document().sceneDocument().assets().size() == 2);
}

TEST_CASE("where a session takes every skeleton, so are all characters of a scene that does not say how") {
    NEEDS_ZOO();
    const test::ScratchFolder folder;
    const auto asset = scene::makeRagdoll(test::makeBiped());
    auto made = scene::makeScene("drop", 2, 0, scene::figureOf(*asset.value()).bounds);
    REQUIRE(made.ok());
    scene::EntityScene animals = std::move(made).value();
    animals.all<scene::Ragdoll>()[0].model = std::filesystem::canonical(test::zooFile("fox/Fox.glb"));
    animals.all<scene::Ragdoll>()[1].model =
        std::filesystem::canonical(test::zooFile("quat_trex/dinosaurs_pack_Trex.glb"));
    const std::filesystem::path file = folder / "animals.scene.json";
    REQUIRE(scene::saveScene(file, animals).ok());

    EditorOptions options;
    options.sceneFile = file;
    options.load.fit.rig = physics::RigKind::any;
    const auto editor = Editor::create(options);
    REQUIRE(editor.ok());
    SceneDocument& document = editor.value()->document().sceneDocument();
    REQUIRE(document.assets().size() == 2);
    CHECK_FALSE(physics::hasRoles(document.assets()[1]->profile));
    // Who reads the scene next needs not be told.
    REQUIRE(document.save(file).ok());
    const auto read = scene::loadScene(file);
    REQUIRE(read.ok());
    for (const scene::Ragdoll& ragdoll : read.value().all<scene::Ragdoll>())
        CHECK(ragdoll.rig == physics::RigKind::any);
}
