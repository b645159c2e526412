/// Opening, saving and what the editor asks on the way.

#include <array>
#include <filesystem>
#include <fstream>
#include <optional>

#include "editor/files/file_list.hpp"
#include "editor/input/input_script.hpp"
#include "editor/sessions.hpp"
#include "physics/profile/profile_io.hpp"
#include "scene/description/scene_file.hpp"
#include "support/command.hpp"
#include "support/zoo.hpp"

using namespace lutka;
using namespace lutka::editor;
using animation::Role;
using test::makeEditor;
using test::send;

namespace {

namespace fs = std::filesystem;

// A model with a profile beside it, in which the left knee bends to 0.6 rad only.
struct Neighbours {
    test::ScratchFolder folder;
    fs::path model = folder / "mannequin.glb";
    fs::path profile = folder / "mannequin.ragdoll.json";

    Neighbours() {
        fs::copy_file(LUTKA_ASSETS_DIR "/models/mannequin.glb", model);
        auto document = EditorDocument::open(model);
        REQUIRE(document.ok());
        const int knee = physics::bodyOf(document.value()->profile(), Role::leftLowerLeg) - 1;
        REQUIRE(document.value()->setHinge(knee, {-0.5F, 0.6F}).ok());
        REQUIRE(document.value()->save(profile).ok());
    }

    // An editor that opened the model, and the profile where one is given.
    [[nodiscard]] std::unique_ptr<Editor> open(const std::optional<fs::path>& given = std::nullopt) const {
        EditorOptions options;
        options.model = model;
        options.load.profile = given;
        options.playing = false;
        auto made = Editor::create(options);
        if (!made.ok()) FAIL(made.error().text());
        return std::move(made).value();
    }
};

float kneeOf(const Editor& editor) {
    const physics::RagdollProfile& profile = editor.document().profile();
    return profile.constraints[physics::bodyOf(profile, Role::leftLowerLeg) - 1].hinge.upper;
}

void editKnee(Editor& editor) {
    const int knee = physics::bodyOf(editor.document().profile(), Role::leftLowerLeg) - 1;
    REQUIRE(editor.edit([&](EditorDocument& document) { return document.setHinge(knee, {-0.1F, 0.3F}); }));
}

}  // namespace

TEST_CASE("a profile beside the model is offered when the model is opened and taken when the user agrees") {
    const Neighbours files;
    const auto editor = makeEditor();
    CHECK(editor->files().offeredProfile().empty());
    send(*editor, filesDropped({files.model.string()}));
    REQUIRE(editor->files().offeredProfile() == files.profile);
    CHECK(kneeOf(*editor) != 0.6F);
    editor->answerOffer(true);
    CHECK(editor->files().offeredProfile().empty());
    CHECK(kneeOf(*editor) == 0.6F);
    CHECK_FALSE(editor->document().unsaved());
}

TEST_CASE("a profile that was asked for is not offered again") {
    const Neighbours files;
    const auto offered = files.open();
    CHECK(offered->files().offeredProfile() == files.profile);
    offered->answerOffer(false);
    CHECK(offered->files().offeredProfile().empty());
    CHECK(files.open(files.profile)->files().offeredProfile().empty());
}

TEST_CASE("a first save over a file that is there asks and replaces only when told to") {
    const Neighbours files;
    const auto editor = files.open();
    Editor& one = *editor;
    editKnee(one);
    send(one, keyPressed(Key::s, {false, true, false}));
    REQUIRE(one.files().asking());
    CHECK(one.files().replacedFile() == files.profile);
    one.files().answerReplace(false);
    CHECK_FALSE(one.files().asking());
    CHECK(one.document().unsaved());
    CHECK(physics::loadProfile(files.profile).value().constraints.size() > 1);
    const std::string theirs = test::fileText(files.profile);
    send(one, keyPressed(Key::s, {false, true, false}));
    CHECK(test::fileText(files.profile) == theirs);
    one.files().answerReplace(true);
    CHECK_FALSE(one.document().unsaved());
    CHECK(test::fileText(files.profile) != theirs);
    editKnee(one);
    send(one, keyPressed(Key::s, {false, true, false}));  // it is this session's file now
    CHECK_FALSE(one.files().asking());
}

TEST_CASE("the profile of another rig that the model was opened with is not written over without a question") {
    const Neighbours files;
    physics::RagdollProfile other = physics::loadProfile(files.profile).value();
    for (physics::BodyProfile& body : other.bodies)
        body.joint = body.jointPath = "other " + body.joint;
    REQUIRE(physics::saveProfile(files.profile, other).ok());
    const std::string was = test::fileText(files.profile);
    const auto made = files.open(files.profile);
    Editor& editor = *made;
    editKnee(editor);
    editor.perform(Action::saveProfile);
    CHECK(editor.files().replacedFile() == files.profile);
    CHECK(test::fileText(files.profile) == was);
    editor.files().answerReplace(true);
    CHECK(test::fileText(files.profile) != was);
    editKnee(editor);
    editor.perform(Action::saveProfile);
    CHECK(editor.files().replacedFile().empty());  // by now it is this one's
}

TEST_CASE("a profile and a scene are known by their endings in capitals too") {
    const Neighbours files;
    const fs::path profile = files.folder / "OLD.RAGDOLL.JSON";
    fs::copy_file(files.profile, profile);
    const auto editor = files.open();
    editor->open(profile);
    CHECK(kneeOf(*editor) == Approx(0.6F));
    const fs::path drop = files.folder / "OLD.SCENE.JSON";
    std::ofstream(drop) << scene::sceneToJson(editor->document().scene(), files.folder.path);
    editor->open(drop);
    CHECK(editor->document().sceneDocument().file() == drop);
}

TEST_CASE("closing with unsaved changes asks about a file that is there before it quits") {
    const Neighbours files;
    const auto editor = files.open();
    Editor& one = *editor;
    editKnee(one);
    send(one, windowClosed());
    one.files().answer(FileFlow::Answer::save);
    CHECK_FALSE(one.quitting());
    REQUIRE_FALSE(one.files().replacedFile().empty());
    one.files().answerReplace(true);
    CHECK(one.quitting());
}

TEST_CASE("a recording is on disk event by event") {
    const test::ScratchFolder folder;
    const fs::path file = folder / "recorded.jsonl";
    auto writer = ScriptWriter::create(file, {640, 480});
    REQUIRE(writer.ok());
    CHECK(loadScript(file).value().entries.empty());
    const InputScript::Entry entry{3, keyPressed(Key::g)};
    REQUIRE(writer.value().add(std::span(&entry, 1)).ok());
    const auto read = loadScript(file);
    REQUIRE(read.ok());
    CHECK(read.value().size.width == 640);
    REQUIRE(read.value().entries.size() == 1);
    CHECK(read.value().entries.front() == entry);
    const auto refused = ScriptWriter::create(folder / "no/such/folder.jsonl", {640, 480});
    REQUIRE_FALSE(refused.ok());
    CHECK(refused.error().code == ErrorCode::output);
}

TEST_CASE("a folder lists its folders first, then what the filter lets through, by name in any case") {
    const test::ScratchFolder folder;
    fs::create_directories(folder / "zebra");
    fs::create_directories(folder / "Apes");
    for (const char* name : {"knight.FBX", "b.glb", "A.ragdoll.json", "notes.txt", ".hidden.glb"})
        std::ofstream(folder / name) << "x";
    const auto names = [&](FileFilter filter) {
        std::string all;
        for (const FileEntry& entry : listFolder(folder.path, filter))
            all += entry.name + (entry.folder ? "/ " : " ");
        return all;
    };
    CHECK(names(FileFilter::models) == "Apes/ zebra/ A.ragdoll.json b.glb knight.FBX ");
    CHECK(names(FileFilter::profiles) == "Apes/ zebra/ A.ragdoll.json ");
    CHECK(names(FileFilter::baked) == "Apes/ zebra/ b.glb ");
    CHECK(names(FileFilter::all) == "Apes/ zebra/ A.ragdoll.json b.glb knight.FBX notes.txt ");
    CHECK(listFolder(folder / "no such folder", FileFilter::all).empty());
}

TEST_CASE("an export over a file that is there asks, and the next one over its own does not") {
    const auto editor = makeEditor();
    const test::ScratchFolder folder;
    const fs::path file = folder / "baked.glb";
    std::ofstream(file) << "theirs";
    editor->files().requestExport(file, 0.2F);
    REQUIRE(editor->files().replacedFile() == file);
    editor->files().answerReplace(false);
    CHECK(test::fileText(file) == "theirs");
    editor->files().requestExport(file, 0.2F);
    editor->files().answerReplace(true);
    CHECK(test::fileText(file) != "theirs");
    editor->files().requestExport(file, 0.2F);
    CHECK_FALSE(editor->files().asking());
}

TEST_CASE("an edited ragdoll is exported in every format, and what one can't hold is told in the log") {
    const auto editor = makeEditor();
    const test::ScratchFolder folder;
    const int hips = 0;
    REQUIRE(editor->edit([&](EditorDocument& document) { return document.setMass(hips, 3.25F); }));
    for (const exporting::ExportFormatInfo& info : exporting::exportFormats()) {
        CAPTURE(info.name);
        const fs::path file = folder / (std::string(info.name) + std::string(info.ending));
        const std::size_t before = editor->workspace().log.size();
        editor->files().requestExport(file, info.format);
        const scene::RagdollAsset& asset = editor->document().asset();
        const auto expected = exporting::exportRagdoll(info.format, {asset.character, asset.profile, asset.rig});
        REQUIRE(expected.ok());
        CHECK(test::fileText(file) == expected.value().bytes);
        // One line for each note, and one that tells of the file.
        CHECK(editor->workspace().log.size() == before + expected.value().warnings.size() + 1);
    }
    const fs::path mjcf = folder / "mjcf.xml";
    CHECK(test::fileText(mjcf).find("mass=\"3.25\"") != std::string::npos);
    std::ofstream(folder / "theirs.xml") << "theirs";
    editor->files().requestExport(folder / "theirs.xml", exporting::ExportFormat::mjcf);
    CHECK(editor->files().replacedFile() == folder / "theirs.xml");
}

TEST_CASE("a ragdoll that is begun by hand has nothing unsaved until something is done") {
    NEEDS_ZOO();
    const auto editor = makeEditor();
    send(*editor, filesDropped({test::zooFile("fox/Fox.glb").string()}));
    editor->answerAnyRig(Editor::AnyRig::byHand);
    REQUIRE(editor->document().profile().bodies.size() == 1);
    CHECK_FALSE(editor->document().unsaved());
    REQUIRE(editor->edit([](EditorDocument& document) { return document.setMass(0, 3.0F); }));
    CHECK(editor->document().unsaved());
}

TEST_CASE("a model that is no humanoid is offered as a ragdoll of any skeleton, and edited as one") {
    NEEDS_ZOO();
    const auto editor = makeEditor();
    const std::string fox = test::zooFile("fox/Fox.glb").string();
    send(*editor, filesDropped({fox}));
    REQUIRE(editor->files().offeredAnyRig().model == fox);
    CHECK(editor->document().character().name == "biped");  // the old one stays until then
    editor->answerAnyRig(Editor::AnyRig::leave);
    CHECK(editor->files().offeredAnyRig().model.empty());
    CHECK(editor->document().character().name == "biped");
    send(*editor, filesDropped({fox}));
    editor->answerAnyRig(Editor::AnyRig::whole);
    CHECK(editor->files().offeredAnyRig().model.empty());
    const physics::RagdollProfile& profile = editor->document().profile();
    CHECK(editor->document().character().file == fox);
    CHECK_FALSE(physics::hasRoles(profile));
    // Bodies without a role are edited, mirrored and reset by their names.
    int left = -1;
    for (int body = 1; body < static_cast<int>(profile.bodies.size()) && left < 0; ++body) {
        if (physics::sideOf(profile, body) == animation::Side::left) left = body;
    }
    REQUIRE(left > 0);
    const float before = profile.bodies[left].massKg;
    REQUIRE(editor->edit([&](EditorDocument& document) { return document.setMass(left, 2.0F * before); }));
    REQUIRE(editor->edit([&](EditorDocument& document) { return document.mirrorParts(std::array{left}); }));
    const int right = physics::counterpartOf(profile, left);
    REQUIRE(right >= 0);
    CHECK(editor->document().profile().bodies[right].massKg == 2.0F * before);
    REQUIRE(editor->edit([&](EditorDocument& document) { return document.resetParts(std::array{left, right}); }));
    CHECK(editor->document().profile().bodies[left].massKg == before);
    physics::FitOptions fit = editor->document().state().fit;
    fit.mostBodies = 10;
    REQUIRE(editor->edit([&](EditorDocument& document) { return document.setFit(fit); }));
    CHECK(editor->document().profile().bodies.size() <= 10);
}

TEST_CASE("a model that is offered as a ragdoll of any skeleton keeps the mass that was asked for") {
    NEEDS_ZOO();
    EditorOptions options;
    options.model = test::zooFile("fox/Fox.glb");
    options.standIn = LUTKA_ASSETS_DIR "/models/mannequin.glb";
    // A person's weight is a weight like any other.
    for (const float mass : {40.0F, 75.0F}) {
        options.load.fit.totalMassKg = mass;
        options.load.fit.weighByVolume = false;
        auto made = Editor::create(options);
        REQUIRE(made.ok());
        made.value()->answerAnyRig(Editor::AnyRig::whole);
        CHECK(made.value()->document().character().file == options.model);
        CHECK(made.value()->document().profile().totalMassKg == mass);
    }
    options.load = EditorOptions().load;
    auto made = Editor::create(options);
    REQUIRE(made.ok());
    made.value()->answerAnyRig(Editor::AnyRig::whole);
    CHECK(made.value()->document().profile().totalMassKg != 75.0F);
}

TEST_CASE("a human figure's profile that is of no use to an animal is told in the offer") {
    NEEDS_ZOO();
    const Neighbours here;
    EditorOptions options;
    options.model = test::zooFile("fox/Fox.glb");
    options.standIn = here.model;
    options.load.profile = here.profile;
    auto made = Editor::create(options);
    REQUIRE(made.ok());
    CHECK(made.value()->files().offeredAnyRig().profile == here.profile);
    made.value()->answerAnyRig(Editor::AnyRig::whole);
    CHECK(made.value()->document().character().file == options.model);
}

TEST_CASE("a model that is no humanoid begins a session with the offer over another one, where that may stand in") {
    NEEDS_ZOO();
    EditorOptions options;
    options.model = test::zooFile("fox/Fox.glb");
    CHECK_FALSE(Editor::create(options).ok());
    options.standIn = LUTKA_ASSETS_DIR "/models/mannequin.glb";
    options.load.import.metresPerFileUnit = 0.5F;  // of the fox alone
    auto made = Editor::create(options);
    REQUIRE(made.ok());
    Editor& editor = *made.value();
    CHECK(editor.document().character().name == "mannequin");
    CHECK(editor.document().profile().heightM > 1.5F);
    CHECK(editor.files().offeredAnyRig().model == options.model);
    CHECK_THAT(editor.files().offeredAnyRig().reason, Catch::Contains("not a humanoid"));
    // The offer says why: no message lies over it.
    CHECK(editor.workspace().toasts.empty());
    CHECK_THAT(editor.workspace().log.back().text, Catch::Contains("not a humanoid"));
    send(editor, keyPressed(Key::enter));
    CHECK(editor.document().character().file == options.model);
    CHECK_FALSE(physics::hasRoles(editor.document().profile()));
    // What is no model at all ends it as ever.
    options.model = "nowhere.glb";
    CHECK_FALSE(Editor::create(options).ok());
}

TEST_CASE("Enter and Esc answer the offer of any skeleton or what is under way in the view, and never both") {
    const auto editor = makeEditor();
    const fs::path refused = "nowhere/animal.glb";
    const Item chest{Item::Kind::body, 0, physics::bodyOf(editor->document().profile(), Role::chest)};
    editor->select(chest);
    editor->files().offerAnyRig({refused, "it has no arms", {}});
    for (const Key key : {Key::enter, Key::escape}) {
        send(*editor, keyPressed(Key::g));
        REQUIRE(editor->state() == State::grab);
        send(*editor, keyPressed(key));
        CHECK(editor->state() == State::selected);
        CHECK(editor->files().offeredAnyRig().model == refused);
    }
    // The help stands over the offer.
    editor->view.help = true;
    send(*editor, keyPressed(Key::escape));
    CHECK_FALSE(editor->view.help);
    CHECK(editor->files().offeredAnyRig().model == refused);
    send(*editor, keyPressed(Key::escape));
    CHECK(editor->files().offeredAnyRig().model.empty());
    CHECK(editor->workspace().selection.contains(chest));
    // A field or a list of the panels has its own Enter.
    editor->files().offerAnyRig({refused, "it has no arms", {}});
    send(*editor, keyPressed(Key::enter), {false, true});
    CHECK(editor->files().offeredAnyRig().model == refused);
    const std::size_t told = editor->workspace().log.size();
    send(*editor, keyPressed(Key::enter));
    CHECK(editor->files().offeredAnyRig().model.empty());
    CHECK(editor->workspace().log.size() == told + 1);  // there is no such file
}

TEST_CASE("whoever saves the scene is offered the ragdoll, and the scene names the profile that was saved after it") {
    const Neighbours files;
    fs::remove(files.profile);
    const auto made = files.open();
    Editor& editor = *made;
    const fs::path scene = files.folder / "own.scene.json";
    editKnee(editor);
    REQUIRE(editor.files().requestSaveScene(scene));
    CHECK(editor.files().offeredSave() == FileFlow::OfferedSave::profile);
    CHECK(test::fileText(scene).find("mannequin.ragdoll.json") == std::string::npos);
    editor.files().answerOfferedSave(true);
    CHECK_FALSE(editor.document().unsaved());
    // The ragdoll has a file now, which the scene's does not name.
    CHECK(editor.document().sceneDocument().unsaved());
    REQUIRE(editor.files().offeredSave() == FileFlow::OfferedSave::scene);
    editor.files().answerOfferedSave(true);
    CHECK_FALSE(editor.document().sceneDocument().unsaved());
    CHECK(test::fileText(scene).find("mannequin.ragdoll.json") != std::string::npos);
    CHECK(editor.files().offeredSave() == FileFlow::OfferedSave::none);
}

TEST_CASE("Ctrl+S saves the ragdoll before the scene, so that the scene names it") {
    const Neighbours files;
    fs::remove(files.profile);
    const auto made = files.open();
    Editor& editor = *made;
    const fs::path scene = files.folder / "own.scene.json";
    REQUIRE(editor.files().requestSaveScene(scene));
    editKnee(editor);
    send(editor, keyPressed(Key::s, {false, true, false}));
    CHECK_FALSE(editor.document().unsaved());
    CHECK_FALSE(editor.document().sceneDocument().unsaved());
    CHECK(test::fileText(scene).find("mannequin.ragdoll.json") != std::string::npos);
    CHECK(editor.files().offeredSave() == FileFlow::OfferedSave::none);
}

TEST_CASE("the list for opening shows models, profiles and scenes, and no other JSON") {
    CHECK(passes(FileFilter::models, "a/knight.FBX"));
    CHECK(passes(FileFilter::models, "knight.ragdoll.json"));
    CHECK(passes(FileFilter::models, "hall.Scene.json"));
    CHECK_FALSE(passes(FileFilter::models, "package.json"));
    CHECK_FALSE(passes(FileFilter::models, "notes.txt"));
}
