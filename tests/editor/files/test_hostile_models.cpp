/// The editor and its unsaved work live on, whatever happens to the process that reads a model.

#include <algorithm>

#include "editor/sessions.hpp"
#include "physics/profile/profile_io.hpp"
#include "support/command.hpp"

using namespace lutka;
using namespace lutka::editor;
using namespace lutka::test;

namespace {

EditorOptions withWorker(int seconds) {
    EditorOptions options;
    animation::ImportWorker& worker = options.load.import.worker;
    worker.program = LUTKA_READING_WORKER;
    worker.memoryBytes = std::size_t{512} << 20U;
    worker.seconds = seconds;
    return options;
}

}  // namespace

TEST_CASE("what a reader prints is in the editor's log, and goes on to who listened before") {
    const ScratchFolder folder;
    std::string heard;
    EditorOptions options = withWorker(120);
    options.load.import.worker.printed = [&](const std::string& line) { heard += line + '\n'; };
    const auto editor = makeEditor(options);
    std::ofstream(folder / "model.glb") << "print and crash";
    editor->open(folder / "model.glb");
    const std::vector<LogLine>& log = editor->workspace().log;
    CHECK(std::any_of(log.begin(), log.end(), [](const LogLine& line) {
        return line.text == "a third party's chatter" && line.kind == Toast::Kind::info;
    }));
    CHECK_THAT(heard, Catch::Contains("a third party's chatter\n"));
}

TEST_CASE("a model that kills, stalls or starves its reader leaves the editor with its unsaved work") {
    const ScratchFolder folder;
    struct Case {
        const char* does;
        const char* told;
    };
    for (const Case& each : {Case{"crash", "signal 11"}, Case{"hang", "more than 2 seconds"},
                             Case{"throw", "can't be imported"}, Case{"wrong", "no sound scene"}}) {
        INFO(each.does);
        // Time enough on a busy machine for all but the one that never ends.
        const auto editor = makeEditor(withWorker(std::string(each.does) == "hang" ? 2 : 120));
        REQUIRE(editor->edit([](EditorDocument& document) { return document.setMass(0, 9.0F); }));
        const std::string mine = physics::profileToJson(editor->document().profile());
        const std::string character = editor->document().character().name;
        std::ofstream(folder / "model.glb") << each.does;
        editor->open(folder / "model.glb");
        REQUIRE(editor->files().askingUnsaved());  // the work that would be lost is asked about before
        editor->files().answer(FileFlow::Answer::discard);
        pass(*editor, 3);
        REQUIRE_FALSE(editor->workspace().toasts.empty());
        CHECK_THAT(editor->workspace().toasts.back().text, Catch::Contains(each.told));
        CHECK(editor->document().character().name == character);
        CHECK(editor->document().unsaved());
        CHECK(physics::profileToJson(editor->document().profile()) == mine);
        CHECK(editor->document().canUndo());
        const std::string saved = std::string(each.does) + ".ragdoll.json";
        CHECK(editor->files().requestSave(folder / saved));
        CHECK(fileText(folder / saved) == mine);
    }
}
