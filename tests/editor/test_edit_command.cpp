/// Runs the shipped program: scripts on the EGL context, and the real window on a virtual screen.

#include <filesystem>
#include <fstream>

#include "editor/scripts.hpp"
#include "physics/profile/profile_io.hpp"

using namespace lutka;
using namespace lutka::editor;
using namespace lutka::test;

namespace {

/// A script in a small window, done at the same time to an editor without one, which tells where things are seen then.
struct Rehearsal {
    explicit Rehearsal(const fs::path& model) {
        script.setSize({640, 480});
        EditorOptions options;
        options.model = model;
        options.playing = false;
        options.window = {640, 480};
        auto made = Editor::create(options);
        REQUIRE(made.ok());
        editor = std::move(made).value();
    }
    Rehearsal& add(const InputEvent& event) {
        script.add(event);
        test::send(*editor, event);
        return *this;
    }
    Rehearsal& move(const vec2& to) { return add(mouseMoved(to)); }
    Rehearsal& press() { return add(mouseButton(MouseButton::left, true)); }
    Rehearsal& release() { return add(mouseButton(MouseButton::left, false)); }
    Rehearsal& key(Key key, Modifiers modifiers = {}) {
        // Saving is the program's part: both would write the same file.
        if (key == Key::s && modifiers.control) {
            script.key(key, modifiers);
            return wait(2);
        }
        return add(keyPressed(key, modifiers)).add(keyReleased(key));
    }
    Rehearsal& wait(int frames) {
        script.wait(frames);
        test::pass(*editor, frames);
        return *this;
    }
    [[nodiscard]] vec2 handle(Handle::Kind kind) const {
        const auto scene = editor->workspace().handleScene();
        REQUIRE(scene.has_value());
        for (const Handle& one : handlesOf(*scene, editor->workspace().camera)) {
            if (one.kind != kind) continue;
            return vec2(*render::project(editor->workspace().camera, one.position, editor->workspace().window));
        }
        FAIL("there is no such handle");
        return {};
    }

    Script script;
    std::unique_ptr<Editor> editor;
};

// The joint that a role has in the ragdoll that the program saved.
std::string savedJointOf(const Scratch& scratch, animation::Role role) {
    const auto saved = physics::loadProfile(scratch / "mannequin.ragdoll.json");
    REQUIRE(saved.ok());
    const int body = physics::bodyOf(saved.value(), role);
    REQUIRE(body >= 0);
    return saved.value().bodies[body].joint;
}

}  // namespace

TEST_CASE("a script sets a limit by its slider, changes another value, undoes that, and saves") {
    if (!layoutIsKnown()) SKIP_TEST("the package fonts-dejavu-core is not there");
    const Scratch scratch;
    Script script;
    script.key(Key::space).click(612, 370);       // the left lower leg
    script.drag(1184, 430, 1160, 430).release();  // its flexion
    script.drag(1062, 379, 1160, 379).release();  // its friction
    script.key(Key::z, kControl).key(Key::s, kControl).wait(2);
    const Outcome outcome = play(scratch, script);
    NEEDS_DISPLAY_OF(outcome);
    INFO(outcome.output);
    REQUIRE(outcome.code == 0);
    const auto saved = physics::loadProfile(scratch / "mannequin.ragdoll.json");
    REQUIRE(saved.ok());
    const Outcome built = run(scratch, std::string(LUTKA_BINARY) + " build " + scratch.model().string() + " -o " +
                                           (scratch / "fitted.json").string());
    REQUIRE(built.code == 0);
    const auto fitted = physics::loadProfile(scratch / "fitted.json");
    REQUIRE(fitted.ok());
    const int knee = physics::bodyOf(saved.value(), animation::Role::leftLowerLeg) - 1;
    const auto& now = saved.value().constraints[knee];
    const auto& was = fitted.value().constraints[knee];
    CHECK(now.hinge.upper < was.hinge.upper - radians(15.0F));
    CHECK(now.hinge.lower == Approx(was.hinge.lower));
    CHECK(now.frictionNm == Approx(was.frictionNm));
    const int other = physics::bodyOf(saved.value(), animation::Role::rightLowerLeg) - 1;
    CHECK(saved.value().constraints[other].hinge.upper == Approx(fitted.value().constraints[other].hinge.upper));
}

TEST_CASE("a script drags a limit's handle in the view, pulls a hand, undoes a change and saves") {
    const Scratch scratch;
    Rehearsal rehearsal(scratch.model());
    Editor& editor = *rehearsal.editor;
    rehearsal.key(Key::tab);  // all of the small window is view
    rehearsal.move(test::seenAt(editor, animation::Role::leftLowerLeg)).press().release();
    rehearsal.key(Key::f).key(Key::digit3);
    const vec2 end = rehearsal.handle(Handle::Kind::flexionHigh);
    const vec2 other = rehearsal.handle(Handle::Kind::flexionLow);
    rehearsal.move(end).press();
    for (int i = 1; i <= 4; ++i)
        rehearsal.move(end + (other - end) * (static_cast<float>(i) * 0.07F));
    rehearsal.release();
    rehearsal.key(Key::s).key(Key::digit2).key(Key::enter).key(Key::z, kControl);  // a larger shape, and not
    rehearsal.move({600, 440}).key(Key::digit1).key(Key::escape).key(Key::f);
    rehearsal.script.wait(1);
    const int before = rehearsal.script.frame();
    const vec2 hand = test::seenAt(editor, animation::Role::leftHand);
    rehearsal.move(hand).press();
    for (int i = 1; i <= 6; ++i)
        rehearsal.move(hand + vec2(-4, -8) * static_cast<float>(i));
    rehearsal.wait(8).release().move({600, 440}).key(Key::s, kControl);
    const int after = rehearsal.script.frame() + 1;
    const Outcome outcome =
        play(scratch, rehearsal.script,
             " --paused --screenshot-at " + std::to_string(before) + ":" + (scratch / "before.png").string() +
                 " --screenshot-at " + std::to_string(after) + ":" + (scratch / "after.png").string());
    NEEDS_DISPLAY_OF(outcome);
    INFO(outcome.output);
    REQUIRE(outcome.code == 0);
    const auto saved = physics::loadProfile(scratch / "mannequin.ragdoll.json");
    REQUIRE(saved.ok());
    const bool same = physics::profileToJson(saved.value()) == physics::profileToJson(editor.document().profile());
    CHECK(same);
    const auto fitted = scene::loadRagdoll(scratch.model()).value()->profile;
    const int knee = physics::bodyOf(fitted, animation::Role::leftLowerLeg);
    const auto& now = saved.value().constraints[knee - 1].hinge;
    const auto& was = fitted.constraints[knee - 1].hinge;
    CHECK(now.upper - now.lower < was.upper - was.lower - radians(10.0F));
    CHECK(saved.value().bodies[knee].shape.radius == fitted.bodies[knee].shape.radius);
    const auto first = render::loadPng(scratch / "before.png");
    const auto last = render::loadPng(scratch / "after.png");
    REQUIRE((first.ok() && last.ok()));
    const int x = static_cast<int>(hand.x) - 40;
    const int y = static_cast<int>(hand.y) - 70;
    const auto part = [&](const render::Image& image) { return cropped(image, x, y, 80, 100); };
    CHECK(render::compareImages(part(first.value()), part(last.value()), 16).differingShare > 0.02);
}

TEST_CASE("a script gives a role to another joint by the mapping's list and saves it") {
    if (!layoutIsKnown()) SKIP_TEST("the package fonts-dejavu-core is not there");
    const Scratch scratch;
    Script script;
    script.key(Key::space).click(122, 43);  // the tab Mapping
    script.click(190, 155);                 // the spine's joint
    for (const char letter : std::string("chest"))
        script.add(textTyped(static_cast<std::uint32_t>(letter)));
    script.wait(2);
    const int list = script.frame();
    script.click(190, 207).wait(2);  // "chest", the first line of what is left
    script.key(Key::s, kControl).wait(2);
    const Outcome outcome =
        play(scratch, script, " --screenshot-at " + std::to_string(list) + ":" + (scratch / "list.png").string());
    NEEDS_DISPLAY_OF(outcome);
    INFO(outcome.output);
    REQUIRE(outcome.code == 0);
    CHECK(savedJointOf(scratch, animation::Role::spine) == "chest");
}

TEST_CASE("a role that a script drags from its panel onto a joint in the view takes that joint") {
    if (!layoutIsKnown()) SKIP_TEST("the package fonts-dejavu-core is not there");
    const Scratch scratch;
    Script script;
    script.key(Key::space).click(122, 43).wait(2);     // the tab Mapping
    script.drag(40, 331, 660, 204).wait(2).release();  // leftHand to the left elbow
    script.move(640, 600).key(Key::s, kControl).wait(2);
    const Outcome outcome = play(scratch, script);
    NEEDS_DISPLAY_OF(outcome);
    INFO(outcome.output);
    REQUIRE(outcome.code == 0);
    CHECK(savedJointOf(scratch, animation::Role::leftHand) == "leftLowerArm");
}

TEST_CASE("the panels look as they did when they were looked at") {
    if (!layoutIsKnown()) SKIP_TEST("the package fonts-dejavu-core is not there");
    const Scratch scratch;
    Script script;
    std::string screenshots;
    const auto picture = [&](const char* name) {
        script.wait(3);
        screenshots += " --screenshot-at " + std::to_string(script.frame()) + ":" + (scratch / name).string();
        script.wait(1);
    };
    script.key(Key::space).click(612, 370);
    script.move(640, 620);  // away from everything that lights up
    picture("body.png");
    script.click(122, 43).click(1024, 43).move(640, 620);
    picture("mapping.png");
    script.add(textTyped('?'));
    picture("help.png");
    script.key(Key::escape).click(190, 43).click(60, 132).move(640, 620);  // the tab Scene, the floor
    picture("scene.png");
    script.click(967, 43).click(44, 43);
    // Both thighs by the tree; the flexion of both by its slider; where that leaves the bind pose the doctor tells.
    script.click(112, 572).move(120, 644).add(keyPressed(Key::leftShift, {}));
    script.add(mouseButton(MouseButton::left, true, {true, false, false}));
    script.add(mouseButton(MouseButton::left, false, {true, false, false})).add(keyReleased(Key::leftShift));
    script.drag(1170, 430, 1122, 430).release().move(640, 620);
    picture("thighs.png");
    script.click(1134, 43).move(640, 620);
    picture("doctor.png");
    script.click(1078, 43).move(640, 620);
    picture("view.png");
    script.key(Key::escape).click(967, 43).click(990, 91).move(640, 660);
    picture("collisions.png");
    script.save(scratch / "script.jsonl");
    const Outcome outcome = edit(scratch, "--headless --input " + (scratch / "script.jsonl").string() + screenshots);
    NEEDS_DISPLAY_OF(outcome);
    INFO(outcome.output);
    REQUIRE(outcome.code == 0);
    // The panels alone: what the view shows has pictures of its own, and the status bar tells the machine's frame rate.
    constexpr int top = 24;
    constexpr int height = 660;
    const auto body = render::loadPng(scratch / "body.png");
    const auto mapping = render::loadPng(scratch / "mapping.png");
    const auto help = render::loadPng(scratch / "help.png");
    const auto scene = render::loadPng(scratch / "scene.png");
    REQUIRE((body.ok() && mapping.ok() && help.ok() && scene.ok()));
    test::checkGolden(cropped(body.value(), 0, top, 310, height), "editor_skeleton", kPanel);
    test::checkGolden(cropped(body.value(), 937, top, 343, height), "editor_body", kPanel);
    test::checkGolden(cropped(mapping.value(), 0, top, 310, height), "editor_mapping", kPanel);
    test::checkGolden(cropped(mapping.value(), 937, top, 343, height), "editor_physics", kPanel);
    test::checkGolden(cropped(scene.value(), 0, top, 310, height), "editor_scene", kPanel);
    test::checkGolden(cropped(help.value(), 200, 100, 880, 440), "editor_help", kPanel);
    for (const char* name : {"thighs", "doctor", "view"}) {
        const auto panel = render::loadPng(scratch / (std::string(name) + ".png").c_str());
        REQUIRE(panel.ok());
        test::checkGolden(cropped(panel.value(), 937, top, 343, height), std::string("editor_") + name, kPanel);
    }
    const auto collisions = render::loadPng(scratch / "collisions.png");
    REQUIRE(collisions.ok());
    test::checkGolden(cropped(collisions.value(), 332, 125, 582, 470), "editor_collisions", kPanel);
}

TEST_CASE("the log and the file dialog look as they did when they were looked at") {
    if (!layoutIsKnown()) SKIP_TEST("the package fonts-dejavu-core is not there");
    const Scratch scratch;
    for (const char* folder : {"clips", "Older"})
        fs::create_directory(scratch / folder);
    for (const char* file : {"alpha.glb", "beta.fbx", "gamma.ragdoll.json", "notes.txt", ".hidden.glb"})
        std::ofstream(scratch / file) << ' ';
    Script script;
    script.key(Key::space)
        .click(612, 370)
        .key(Key::x)
        .key(Key::escape)
        .add(filesDropped({"absent.glb"}))
        .click(1247, 43);
    script.move(640, 640).wait(3);
    const int log = script.frame();
    // The caret of the path blinks: the picture of the list leaves it out.
    script.wait(1).key(Key::o, kControl).move(20, 700).wait(12);
    const int dialog = script.frame();
    script.wait(1).save(scratch / "script.jsonl");
    const Outcome outcome =
        edit(scratch, "--headless --input " + (scratch / "script.jsonl").string() + " --screenshot-at " +
                          std::to_string(log) + ":" + (scratch / "log.png").string() + " --screenshot-at " +
                          std::to_string(dialog) + ":" + (scratch / "dialog.png").string());
    NEEDS_DISPLAY_OF(outcome);
    INFO(outcome.output);
    REQUIRE(outcome.code == 0);
    const auto logPicture = render::loadPng(scratch / "log.png");
    const auto dialogPicture = render::loadPng(scratch / "dialog.png");
    REQUIRE((logPicture.ok() && dialogPicture.ok()));
    test::checkGolden(cropped(logPicture.value(), 937, 24, 343, 660), "editor_log", kPanel);
    test::checkGolden(cropped(dialogPicture.value(), 371, 206, 538, 312), "editor_open", kPanel);
}

TEST_CASE("the same script gives the same picture twice and a drag shows in it") {
    if (!layoutIsKnown()) SKIP_TEST("the package fonts-dejavu-core is not there");
    const Scratch scratch;
    Script script;
    script.wait(12).drag(595, 250, 595, 120).wait(20);
    script.save(scratch / "drag.jsonl");
    const std::string last = std::to_string(script.frame());
    const auto picture = [&](const char* file, const std::string& input) {
        return edit(scratch, "--headless --size 1280x720 " + input + " --screenshot-at " + last + ":" +
                                 (scratch / file).string());
    };
    const std::string input = "--input " + (scratch / "drag.jsonl").string();
    const Outcome first = picture("a.png", input);
    if (first.code == 6) SKIP_TEST("there is no GL");
    INFO(first.output);
    REQUIRE(first.code == 0);
    REQUIRE(picture("b.png", input).code == 0);
    REQUIRE(picture("free.png", "").code == 0);
    const auto a = render::loadPng(scratch / "a.png");
    const auto b = render::loadPng(scratch / "b.png");
    const auto free = render::loadPng(scratch / "free.png");
    REQUIRE(a.ok());
    REQUIRE(b.ok());
    REQUIRE(free.ok());
    CHECK(a.value().width == 1280);
    // The frame rate in the status bar is the machine's own.
    CHECK(render::compareImages(a.value(), b.value(), 2).differingShare < 0.001);
    CHECK(render::compareImages(a.value(), free.value(), 16).differingShare > 0.01);
}

TEST_CASE("a broken model at the start and a broken script end with code 3, bad words with 2, no display with 6") {
    const Scratch scratch;
    std::ofstream(scratch / "broken.jsonl") << "nothing\n";
    const Outcome broken = edit(scratch, "--headless --input " + (scratch / "broken.jsonl").string());
    CHECK(broken.code == 3);
    CHECK_THAT(broken.output, Catch::Contains("broken.jsonl:1"));
    CHECK(edit(scratch, "--headless").code == 2);
    CHECK(edit(scratch, "--headless --screenshot-at soon:x.png").code == 2);
    CHECK(edit(scratch, "--headless --size 12").code == 2);
    std::ofstream(scratch / "no_model.glb") << "nothing";
    const Outcome model = run(
        scratch, std::string(LUTKA_BINARY) + " edit " + (scratch / "no_model.glb").string() + " --headless --frames 1");
    CHECK((model.code == 3 || model.code == 6));
    const Outcome noDisplay = run(scratch, "env -u DISPLAY -u WAYLAND_DISPLAY " + std::string(LUTKA_BINARY) + " edit");
    CHECK(noDisplay.code == 6);
}

TEST_CASE("a polite kill ends the editor within a frame, and the shell is told the signal") {
    const Scratch scratch;
    const std::string editor = std::string(LUTKA_BINARY) + " edit " + scratch.model().string();
    const fs::path seen = scratch / "seen.png";
    for (const auto& [signal, code] : {std::pair("TERM", 143), std::pair("INT", 130)}) {
        fs::remove(seen);
        // Once there is a picture it runs; only the signal ends it then.
        const Outcome outcome =
            run(scratch, "{ " + editor + " --headless --frames 10000000 --screenshot-at 1:" + seen.string() +
                             " & child=$!; while ! test -e " + seen.string() +
                             " && kill -0 $child; do sleep 0.05; done; kill -" + signal + " $child; wait $child; }");
        if (outcome.code == 6) SKIP_TEST("there is no GL");
        INFO(outcome.output);
        CHECK(outcome.code == code);
    }
}

TEST_CASE("what was not saved survives a kill by force and a polite one, and the next session is offered it") {
    for (const char* signal : {"KILL", "TERM"}) {
        INFO(signal);
        const Scratch scratch;
        const std::string kept = (scratch / "kept").string();
        // A larger shape of the hips, by keys alone.
        Rehearsal rehearsal(scratch.model());
        rehearsal.key(Key::tab);
        rehearsal.move(test::seenAt(*rehearsal.editor, animation::Role::hips)).press().release();
        rehearsal.key(Key::s).key(Key::digit2).key(Key::enter);
        rehearsal.script.save(scratch / "change.jsonl");
        const std::string editor =
            std::string(LUTKA_BINARY) + " edit " + scratch.model().string() + " --paused --headless --recovery " + kept;
        const std::string copy = kept + "/session-*/copy.json";
        const Outcome killed = run(scratch, "{ " + editor + " --frames 10000000 --input " +
                                                (scratch / "change.jsonl").string() + " & child=$!; while ! ls " +
                                                copy + " 2>/dev/null && kill -0 $child; do sleep 0.05; done; " +
                                                "kill -" + signal + " $child; wait $child; }");
        if (killed.code == 6) SKIP_TEST("there is no GL");
        INFO(killed.output);
        CHECK(killed.code == (std::string(signal) == "KILL" ? 137 : 143));
        const auto found = findRecoveries(kept);
        REQUIRE(found.size() == 1);
        CHECK(found.front().contents() == "the ragdoll of mannequin.glb");
        auto document = EditorDocument::open(found.front().model);
        REQUIRE(document.ok());
        REQUIRE(recoverInto(*document.value(), found.front()));
        const auto shape = [](const EditorDocument& of) {
            return of.profile().bodies[physics::bodyOf(of.profile(), animation::Role::hips)].shape;
        };
        CHECK(shape(*document.value()).radius == shape(rehearsal.editor->document()).radius);
        // A session that ends by its user's will leaves nothing.
        Script nothing;
        nothing.wait(2).add(windowClosed()).wait(2);
        nothing.save(scratch / "nothing.jsonl");
        const std::string second = (scratch / "second").string();
        const Outcome clean =
            run(scratch, std::string(LUTKA_BINARY) + " edit " + scratch.model().string() + " --headless --recovery " +
                             second + " --input " + (scratch / "nothing.jsonl").string());
        CHECK(clean.code == 0);
        CHECK(findRecoveries(second).empty());
    }
}

TEST_CASE("a real window takes a real pointer and keyboard, records them, and closes") {
    const Scratch scratch;
    const Outcome outcome = run(scratch, std::string("bash ") + LUTKA_TESTS_DIR "/editor/window_smoke.sh " +
                                             LUTKA_BINARY + " " + (scratch / "replay.png").string());
    INFO(outcome.output);
    REQUIRE(outcome.code == 0);
    if (outcome.output.find("skipped:") != std::string::npos) SKIP_TEST("%s", outcome.output.c_str());
    CHECK_THAT(outcome.output, Catch::Contains("done"));
}
