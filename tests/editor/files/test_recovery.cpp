#include "editor/files/recovery.hpp"

#include <filesystem>
#include <fstream>

#include "editor/sessions.hpp"
#include "support/command.hpp"

using namespace lutka;
using namespace lutka::editor;
using animation::Role;
namespace fs = std::filesystem;

namespace {

const fs::path kModel = LUTKA_ASSETS_DIR "/models/mannequin.glb";

std::unique_ptr<Editor> editorOf(const fs::path& recovery, std::string_view scenario = "drop") {
    EditorOptions options;
    options.model = kModel;
    options.recovery = recovery;
    options.playing = false;
    options.scene.scenario = scenario;
    auto made = Editor::create(options);
    if (!made.ok()) FAIL(made.error().text());
    return std::move(made).value();
}

void makeHandHeavy(Editor& editor) {
    const int hand = physics::bodyOf(editor.document().profile(), Role::leftHand);
    REQUIRE(editor.edit([&](EditorDocument& document) { return document.setMass(hand, 3.25F); }));
}

float massOfHand(const Editor& editor) {
    const auto& profile = editor.document().profile();
    return profile.bodies[physics::bodyOf(profile, Role::leftHand)].massKg;
}

std::size_t entriesIn(const fs::path& folder) {
    std::size_t count = 0;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        count += entry.is_directory() ? 1U : 0U;
    return count;
}

}  // namespace

TEST_CASE("unsaved work is copied within ten seconds and offered to the next session, which can restore it") {
    const test::ScratchFolder folder;
    {
        const auto editor = editorOf(folder.path, "stairs");
        CHECK(editor->recovery().offered() == nullptr);
        makeHandHeavy(*editor);
        REQUIRE(editor->edit([](EditorDocument& document) { return document.unmapRole(Role::neck); }));
        REQUIRE(editor->editScene("Add", "", [](scene::EntityScene& scene) {
            scene::addEntity(scene, scene::EntityKind::box, {{1, 0, 0, 0}, {2, 0.25F, 0}});
        }));
        editor->update(10.0);
    }  // it ends without the user's will: its copy stays
    const auto editor = editorOf(folder.path);
    REQUIRE(editor->recovery().offered() != nullptr);
    const RecoveryCopy& copy = *editor->recovery().offered();
    CHECK(copy.contents() == "the ragdoll of mannequin.glb and the scene stairs");
    CHECK(copy.when.size() == std::string("2026-11-28 14:32").size());
    editor->answerRecovery(RecoveryDesk::Answer::restore);
    CHECK(editor->recovery().offered() == nullptr);
    CHECK(massOfHand(*editor) == Approx(3.25F));
    CHECK(physics::bodyOf(editor->document().profile(), Role::neck) < 0);
    CHECK(editor->document().state().map.jointOf(Role::neck) == animation::kNoJoint);
    CHECK(editor->document().scene().name == "stairs");
    CHECK(editor->document().sceneDocument().settings().scenario == "stairs");
    CHECK(editor->document().unsaved());
    CHECK(editor->document().sceneDocument().unsaved());
    CHECK(editor->document().canUndo());
    CHECK(entriesIn(folder.path) == 1);  // the old copy has gone into the new session's
}

TEST_CASE("later leaves a copy for the next start, and thrown away it is gone") {
    const test::ScratchFolder folder;
    {
        const auto editor = editorOf(folder.path);
        makeHandHeavy(*editor);
        editor->keepRecovery();
    }
    {
        const auto editor = editorOf(folder.path);
        REQUIRE(editor->recovery().offered() != nullptr);
        editor->answerRecovery(RecoveryDesk::Answer::later);
        CHECK(editor->recovery().offered() == nullptr);
    }
    const auto editor = editorOf(folder.path);
    REQUIRE(editor->recovery().offered() != nullptr);
    editor->answerRecovery(RecoveryDesk::Answer::remove);
    CHECK(findRecoveries(folder.path).empty());
}

TEST_CASE("two sessions keep two copies, and neither is offered the other's while that lives") {
    const test::ScratchFolder folder;
    const auto first = editorOf(folder.path);
    makeHandHeavy(*first);
    first->update(10.0);
    const auto second = editorOf(folder.path);
    CHECK(second->recovery().offered() == nullptr);
    makeHandHeavy(*second);
    second->update(10.0);
    CHECK(entriesIn(folder.path) == 2);
    CHECK(findRecoveries(folder.path).empty());
}

TEST_CASE("a clean end, a save and an undo of everything leave nothing behind") {
    const test::ScratchFolder folder;
    {
        const auto editor = editorOf(folder / "discarded");
        makeHandHeavy(*editor);
        editor->update(10.0);
        test::send(*editor, windowClosed());
        editor->files().answer(FileFlow::Answer::discard);
        REQUIRE(editor->quitting());
        editor->update(10.0);
    }
    CHECK(entriesIn(folder / "discarded") == 0);
    {
        const auto editor = editorOf(folder / "saved");
        makeHandHeavy(*editor);
        editor->update(10.0);
        REQUIRE(editor->document().save(folder / "saved.ragdoll.json"));
        editor->update(1.0);
    }
    CHECK(entriesIn(folder / "saved") == 0);
    {
        const auto editor = editorOf(folder / "undone");
        makeHandHeavy(*editor);
        editor->update(10.0);
        editor->perform(Action::undo);
        editor->update(1.0);
    }
    CHECK(entriesIn(folder / "undone") == 0);
}

TEST_CASE("a damaged copy is left alone and stops nobody") {
    const test::ScratchFolder folder;
    fs::create_directories(folder / "session-broken");
    std::ofstream(folder / "session-broken/copy.json") << "{\"format\": 3";
    const auto editor = editorOf(folder.path);
    CHECK(editor->recovery().offered() == nullptr);
    CHECK(fs::exists(folder / "session-broken/copy.json"));
    // A copy whose model is gone is told, and the scene goes on.
    fs::create_directories(folder / "session-gone");
    std::ofstream(folder / "session-gone/copy.json")
        << R"({"format": "lutka.recovery", "model": "/nowhere/x.glb", "holdsRagdoll": true, "when": "2026-01-01 10:00"})";
    const auto other = editorOf(folder.path);
    REQUIRE(other->recovery().offered() != nullptr);
    other->answerRecovery(RecoveryDesk::Answer::restore);
    CHECK(other->document().character().name == "mannequin");
    CHECK(other->recovery().offered() != nullptr);
    REQUIRE_FALSE(other->workspace().toasts.empty());
    CHECK(other->workspace().toasts.back().kind == Toast::Kind::error);
}

TEST_CASE("a folder that can't be made is told and the editor runs without copies") {
    const test::ScratchFolder folder;
    std::ofstream(folder / "file") << "no folder";
    const auto editor = editorOf(folder / "file");
    REQUIRE_FALSE(editor->workspace().toasts.empty());
    CHECK(editor->workspace().toasts.back().kind == Toast::Kind::warning);
    makeHandHeavy(*editor);
    editor->update(10.0);
    CHECK(massOfHand(*editor) == Approx(3.25F));
}
