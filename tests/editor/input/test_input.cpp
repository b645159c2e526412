#include <cctype>
#include <fstream>
#include <iterator>
#include <set>

#include "editor/input/actions.hpp"
#include "editor/input/input_script.hpp"
#include "support/catch.hpp"

using namespace lutka;
using namespace lutka::editor;

namespace {

InputScript everyKind() {
    InputScript script;
    script.size = {800, 600};
    InputEvent held = keyPressed(Key::z, {true, true, false});
    held.repeated = true;
    const InputEvent events[] = {
        mouseMoved({12.5F, 700}),
        mouseButton(MouseButton::middle, true, {false, false, true}),
        wheelTurned(-2.0F),
        held,
        keyReleased(Key::f3),
        textTyped(0x3042),
        filesDropped({"a b.glb", "日本.fbx"}),
        windowResized({640, 480}),
        focusChanged(false),
        windowClosed(),
    };
    int frame = 0;
    for (const InputEvent& event : events)
        script.entries.push_back({frame++ / 2, event});
    return script;
}

}  // namespace

TEST_CASE("every key has a name of its own and is found by it") {
    std::set<std::string_view> names;
    for (int i = 0; i < kKeyCount; ++i) {
        const Key key = static_cast<Key>(i);
        INFO(i);
        CHECK_FALSE(keyName(key).empty());
        CHECK(names.insert(keyName(key)).second);
        CHECK(keyFromName(keyName(key)) == key);
    }
    CHECK(keyName(Key::pageDown) == "PageDown");
    CHECK(keyName(Key::rightAlt) == "RightAlt");
    CHECK(keyName(Key::f12) == "F12");
    CHECK_FALSE(keyFromName("Hyper").has_value());
}

TEST_CASE("an input script survives the way through its text") {
    const InputScript script = everyKind();
    const auto back = scriptFromText(scriptToText(script), "test");
    REQUIRE(back.ok());
    CHECK(back.value().size == script.size);
    CHECK(back.value().entries == script.entries);
}

TEST_CASE("a broken input script is refused with its line and the reason") {
    const std::string header = "{\"format\":\"lutka.input\",\"version\":1}\n";
    const std::pair<std::string, std::string> cases[] = {
        {"", "is empty"},
        {"{\"format\":\"else\"}\n", "test:1"},
        {"{\"format\":\"lutka.input\",\"version\":9}\n", "got 9"},
        {header + "not json\n", "test:2"},
        {header + "{\"frame\":0,\"event\":\"jump\"}\n", "/event: expected one of"},
        {header + "{\"frame\":0,\"event\":\"key\",\"key\":\"Hyper\",\"pressed\":true}\n",
         "/key: expected the name of a key"},
        {header + "{\"frame\":0,\"event\":\"mouseButton\",\"button\":\"fourth\",\"pressed\":true}\n",
         "/button: expected one of"},
        {header + "{\"frame\":0,\"event\":\"mouseMove\",\"x\":1}\n", "expected a member \"y\""},
        {header + "{\"frame\":3,\"event\":\"close\"}\n\n{\"frame\":2,\"event\":\"close\"}\n", "test:4"},
        {header + "{\"frame\":99999999,\"event\":\"close\"}\n", "/frame: expected a whole number"},
        {header + "{\"frame\":0,\"event\":\"resize\",\"size\":[0,5]}\n", "/size/0: expected a whole number"},
        {header + "{\"frame\":0.5,\"event\":\"close\"}\n", "/frame: expected a whole number, got 0.5"},
        {header + "{\"frame\":0,\"frame\":1,\"event\":\"close\"}\n", "/frame: the key"},
        {header + "{\"frame\":0,\"event\":\"wheel\",\"notches\":1e999}\n", "/notches"},
        {header + "{\"frame\":0,\"event\":\"wheel\",\"notches\":3.5e38}\n", "/notches"},
        {header + "[0]\n", "expected an object"},
    };
    for (const auto& [text, expected] : cases) {
        INFO(text);
        const auto script = scriptFromText(text, "test");
        REQUIRE_FALSE(script.ok());
        CHECK(script.error().code == ErrorCode::input);
        CHECK_THAT(script.error().text(), Catch::Contains(expected));
    }
}

TEST_CASE("a script player hands each event out once, at its frame or as soon after as asked") {
    ScriptPlayer player(everyKind());
    CHECK(player.take(0).size() == 2);
    CHECK(player.take(0).empty());
    CHECK(player.take(2).size() == 4);
    CHECK_FALSE(player.finished());
    CHECK(player.take(100).size() == 4);
    CHECK(player.finished());
}

TEST_CASE("no key does two things and every action has a name") {
    std::set<std::string> shortcuts;
    for (const Binding& binding : keyBindings()) {
        INFO(shortcutText(binding));
        CHECK(shortcuts.insert(shortcutText(binding)).second);
        CHECK_FALSE(actionName(binding.action).empty());
        CHECK(actionFor(keyPressed(binding.key, binding.modifiers)) == binding.action);
        CHECK_FALSE(actionFor(keyReleased(binding.key, binding.modifiers)).has_value());
    }
    CHECK(shortcutText(Action::redo) == "Ctrl+Shift+Z");
    CHECK_FALSE(actionFor(keyPressed(Key::z)).has_value());
}

TEST_CASE("a frame's events are taken a press, a release or a key at a time, in order and without losing one") {
    const std::vector<InputEvent> events{mouseMoved({1, 1}),
                                         mouseMoved({2, 2}),
                                         mouseButton(MouseButton::left, true),
                                         mouseMoved({3, 3}),
                                         mouseButton(MouseButton::left, false),
                                         keyPressed(Key::a),
                                         textTyped('a'),
                                         keyReleased(Key::a),
                                         keyPressed(Key::b),
                                         textTyped('b'),
                                         wheelTurned(1)};
    const auto steps = inputSteps(events);
    REQUIRE(steps.size() == 6);
    CHECK(steps[0].size() == 2);  // the way there
    CHECK(steps[1].size() == 1);  // the press
    CHECK(steps[2].size() == 2);  // the drag and the release
    CHECK(steps[3].size() == 2);  // a key with its text
    CHECK(steps[4].size() == 3);
    CHECK(steps[5].size() == 1);
    std::size_t count = 0;
    for (const auto& step : steps) {
        CHECK(step.data() == events.data() + count);
        count += step.size();
    }
    CHECK(count == events.size());
    CHECK(inputSteps({}).size() == 1);
}

TEST_CASE("the page of the editor names every shortcut") {
    std::ifstream file(LUTKA_TESTS_DIR "/../docs/editor.md");
    const std::string page(std::istreambuf_iterator<char>(file), {});
    REQUIRE_FALSE(page.empty());
    const auto isPartOfName = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '+'; };
    for (const Binding& binding : keyBindings()) {
        const std::string keys = shortcutText(binding);
        bool isNamed = false;
        for (std::size_t at = page.find(keys); at != std::string::npos && !isNamed; at = page.find(keys, at + 1)) {
            const std::size_t end = at + keys.size();
            isNamed = !isPartOfName(page[at - 1]) && (end == page.size() || !isPartOfName(page[end]));
        }
        CAPTURE(keys, actionName(binding.action));
        CHECK(isNamed);
    }
}
