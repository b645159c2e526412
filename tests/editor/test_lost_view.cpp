/// The shipped program without a view: a driver that gives up, a window without pixels.

#include "editor/files/recovery.hpp"
#include "editor/input/input_script.hpp"
#include "editor/sessions.hpp"
#include "support/catch.hpp"
#include "support/command.hpp"

using namespace lutka;
using namespace lutka::editor;

namespace {

constexpr int kFramesThatNeverEnd = 10'000'000;

/// A script with a change of the hips' shape, found by the same events in an editor without a view.
struct ScriptedChange {
    explicit ScriptedChange(const std::filesystem::path& model) {
        script.size = {640, 480};
        EditorOptions options;
        options.model = model;
        options.playing = false;
        options.window = {640, 480};
        auto made = Editor::create(options);
        REQUIRE(made.ok());
        const std::unique_ptr<Editor> editor = std::move(made).value();
        const auto add = [&](const InputEvent& event) {
            script.entries.push_back({frame++, event});
            test::send(*editor, event);
        };
        const auto key = [&](Key pressed) {
            add(keyPressed(pressed));
            add(keyReleased(pressed));
        };
        key(Key::tab);
        add(mouseMoved(test::seenAt(*editor, animation::Role::hips)));
        add(mouseButton(MouseButton::left, true));
        add(mouseButton(MouseButton::left, false));
        key(Key::s);
        key(Key::digit2);
        key(Key::enter);
        REQUIRE(editor->document().unsaved());
    }
    InputScript script;
    int frame = 1;
};

std::string editorOf(const std::string& model) {
    return "'" LUTKA_BINARY "' edit " + model + " --paused --headless ";
}

}  // namespace

TEST_CASE("when the driver gives up the editor ends with its reason, and unsaved work is kept") {
    const test::ScratchFolder scratch;
    const std::string model = scratch / "mannequin.glb";
    std::filesystem::copy_file(LUTKA_ASSETS_DIR "/models/mannequin.glb", model);
    const ScriptedChange change(model);
    REQUIRE(saveScript(scratch / "change.jsonl", change.script).ok());
    const std::string after = std::to_string(change.frame + 2);
    const auto ended =
        test::runCommand("LUTKA_GL_LOSE=1 " + editorOf(model) + "--recovery " + (scratch / "kept") + " --input " +
                         (scratch / "change.jsonl") + " --screenshot-at " + after + ":" + (scratch / "never.png"));
    INFO(ended.err);
    CHECK(ended.code == test::kNoDisplay);
    if (ended.err.find("gave up") == std::string::npos) SKIP_TEST("no headless OpenGL context");
    CHECK_FALSE(std::filesystem::exists(scratch / "never.png"));
    const auto found = findRecoveries(scratch / "kept");
    REQUIRE(found.size() == 1);
    CHECK(found.front().contents() == "the ragdoll of mannequin.glb");
}

TEST_CASE("a window without pixels draws nothing, comes back, and can be closed as it is") {
    const test::ScratchFolder scratch;
    InputScript script;
    script.entries = {{2, windowResized({0, 0})}, {5, windowResized({640, 480})}};
    REQUIRE(saveScript(scratch / "back.jsonl", script).ok());
    const auto back = test::runCommand(editorOf(test::kMannequinArgument) + "--input " + (scratch / "back.jsonl") +
                                       " --screenshot-at 7:" + (scratch / "back.png"));
    NEEDS_DISPLAY_OF(back);
    CHECK(back.code == 0);
    CHECK(std::filesystem::exists(scratch / "back.png"));

    script.entries = {{2, windowResized({0, 0})}, {4, windowClosed()}};
    REQUIRE(saveScript(scratch / "closed.jsonl", script).ok());
    const auto closed =
        test::runCommand("timeout 60 " + editorOf(test::kMannequinArgument) + "--input " + (scratch / "closed.jsonl") +
                         " --frames " + std::to_string(kFramesThatNeverEnd));
    CHECK(closed.code == 0);
}
