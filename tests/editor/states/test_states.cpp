/// Every state of the real handlers against every kind of event: where it leads, and that nothing is left behind.

#include <array>
#include <glm/geometric.hpp>
#include <sstream>

#include "editor/sessions.hpp"

using namespace lutka;
using namespace lutka::editor;
using animation::Role;
using test::makeEditor;
using test::pass;
using test::send;

namespace {

constexpr vec2 kEmpty{20, 60};
constexpr vec2 kFloor{300, 650};

struct NamedEvent {
    const char* name;
    InputEvent event;
};

// In the order of the columns of the table below.
std::vector<NamedEvent> events() {
    return {{"move", mouseMoved({24, 66})},
            {"left down", mouseButton(MouseButton::left, true)},
            {"left up", mouseButton(MouseButton::left, false)},
            {"right down", mouseButton(MouseButton::right, true)},
            {"right up", mouseButton(MouseButton::right, false)},
            {"middle down", mouseButton(MouseButton::middle, true)},
            {"middle up", mouseButton(MouseButton::middle, false)},
            {"wheel", wheelTurned(1)},
            {"G", keyPressed(Key::g)},
            {"R", keyPressed(Key::r)},
            {"S", keyPressed(Key::s)},
            {"X", keyPressed(Key::x)},
            {"Escape", keyPressed(Key::escape)},
            {"Enter", keyPressed(Key::enter)},
            {"Delete", keyPressed(Key::del)},
            {"Shift+A", keyPressed(Key::a, {true, false, false})},
            {"3", keyPressed(Key::digit3)},
            {"focus lost", focusChanged(false)}};
}

// Columns as in events(). Left button: at an empty place, in Add on the floor.
constexpr std::array<const char*, kStateCount> kExpected = {
    //           move Ld   Lu   Rd   Ru   Md   Mu   W    G    R    S    X    Esc  Ent  Del  A    3    focus
    /*idle*/ "   idle idle idle orb  idle orb  idle idle idle idle idle idle idle idle idle add  idle idle",
    /*sel */ "   sel  idle sel  orb  sel  orb  sel  sel  grab rot  scal del  idle sel  del  add  sel  sel",
    /*grab*/ "   grab sel  grab sel  grab grab grab grab grab rot  scal grab sel  sel  grab grab grab sel",
    /*rot */ "   rot  sel  rot  sel  rot  rot  rot  rot  grab rot  scal rot  sel  sel  rot  rot  rot  sel",
    /*scal*/ "   scal sel  scal sel  scal scal scal scal grab rot  scal scal sel  sel  scal scal scal sel",
    /*move*/ "   move move move move move move idle move move move move move idle move move move move idle",
    /*orb */ "   orb  orb  orb  orb  orb  orb  idle orb  orb  orb  orb  orb  idle orb  orb  orb  orb  idle",
    /*add */ "   add  sel  add  idle add  idle add  add  add  add  add  add  idle sel  add  add  add  idle",
    /*del */ "   del  sel  del  sel  del  sel  del  del  del  del  del  idle sel  idle idle del  del  sel",
    /*hand*/ "   hand hand sel  sel  hand hand hand hand hand hand hand hand sel  sel  hand hand hand sel",
    /*pick*/ "   pick pick pick idle pick pick pick pick pick pick pick pick idle pick pick pick pick idle",
    /*box */ "   box  box  idle idle box  box  box  box  box  box  box  box  idle box  box  box  box  idle",
};

State stateFromWord(const std::string& word) {
    constexpr std::array<const char*, kStateCount> words = {"idle", "sel", "grab", "rot",  "scal", "move",
                                                            "orb",  "add", "del",  "hand", "pick", "box"};
    for (int i = 0; i < kStateCount; ++i) {
        if (word == words[static_cast<std::size_t>(i)]) return stateAt(i);
    }
    FAIL("no state is called " + word);
    return State::idle;
}

std::vector<State> expectedRow(State state) {
    std::istringstream text(kExpected[static_cast<std::size_t>(state)]);
    std::vector<State> row;
    for (std::string word; text >> word;)
        row.push_back(stateFromWord(word));
    return row;
}

void selectBody(Editor& editor) {
    editor.select(Item{Item::Kind::body, 0, physics::bodyOf(editor.document().profile(), Role::leftUpperLeg)});
}

void pressHandle(Editor& editor) {
    editor.perform(Action::focus);
    const auto scene = editor.workspace().handleScene();
    const auto handles = handlesOf(*scene, editor.workspace().camera);
    const auto seen = render::project(editor.workspace().camera, handles.front().position, editor.workspace().window);
    send(editor, mouseMoved(vec2(*seen)));
    send(editor, mouseButton(MouseButton::left, true));
}

// Brings a new editor into a state, as a user would.
std::unique_ptr<Editor> editorIn(State state) {
    EditorOptions options;
    options.playing = false;
    auto editor = makeEditor(options);
    send(*editor, mouseMoved(kEmpty));
    const bool needsBody = state == State::selected || state == State::grab || state == State::rotate ||
                           state == State::scale || state == State::handle;
    if (needsBody) selectBody(*editor);
    if (state == State::grab) send(*editor, keyPressed(Key::g));
    if (state == State::rotate) send(*editor, keyPressed(Key::r));
    if (state == State::scale) send(*editor, keyPressed(Key::s));
    if (state == State::cameraMove) send(*editor, mouseButton(MouseButton::middle, true, {true, false, false}));
    if (state == State::cameraRotate) send(*editor, mouseButton(MouseButton::middle, true));
    if (state == State::handle) pressHandle(*editor);
    if (state == State::pickJoint) editor->beginPickJoint(Role::spine);
    if (state == State::box) send(*editor, mouseButton(MouseButton::left, true, {false, true, false}));
    if (state == State::add) {
        send(*editor, mouseMoved(kFloor));
        send(*editor, keyPressed(Key::a, {true, false, false}));
    }
    if (state == State::remove) {
        scene::EntityId id = scene::kNoEntity;
        REQUIRE(editor->editScene("Add", "", [&](scene::EntityScene& scene) {
            id = scene::addEntity(scene, scene::EntityKind::box, {{1, 0, 0, 0}, {2, 0.25F, 0}}).id;
        }));
        editor->select(Item{Item::Kind::object, 0, static_cast<int>(id)});
        send(*editor, keyPressed(Key::del));
    }
    REQUIRE(editor->state() == state);
    return editor;
}

// What may be there only while its state is.
void checkNothingDangles(Editor& editor) {
    const Workspace& workspace = editor.workspace();
    const State state = editor.state();
    if (state != State::grab) CHECK_FALSE(workspace.pulls.mouse.has_value());
    if (state != State::add) CHECK_FALSE(workspace.ghost.has_value());
    if (state != State::pickJoint) CHECK_FALSE(workspace.pickRole.has_value());
    if (state == State::idle) CHECK(workspace.selection.empty());
    if (state == State::selected) CHECK_FALSE(workspace.selection.empty());
}

}  // namespace

TEST_CASE("every state answers every event as the table says and leaves nothing behind") {
    const std::vector<NamedEvent> all = events();
    for (int s = 0; s < kStateCount; ++s) {
        const std::vector<State> row = expectedRow(stateAt(s));
        REQUIRE(row.size() == all.size());
        for (std::size_t e = 0; e < all.size(); ++e) {
            INFO(stateName(stateAt(s)) << " × " << all[e].name);
            const auto editor = editorIn(stateAt(s));
            send(*editor, all[e].event);
            CHECK(stateName(editor->state()) == stateName(row[e]));
            checkNothingDangles(*editor);
            // However it goes on, a lost focus ends it, and physics runs free.
            send(*editor, focusChanged(false));
            CHECK((editor->state() == State::idle || editor->state() == State::selected));
            checkNothingDangles(*editor);
            CHECK_FALSE(editor->workspace().press.has_value());
            CHECK_FALSE(editor->workspace().hotHandle.has_value());
            CHECK(editor->player().simulation().options().world.gravity.y < -9.0F);
        }
    }
}

TEST_CASE("the camera goes along with a doll that it follows and keeps its place relative to it") {
    const auto editor = makeEditor();
    selectBody(*editor);
    send(*editor, keyPressed(Key::f, {true, false, false}));
    REQUIRE(editor->workspace().followed == 0);
    const auto offset = [&] {
        return editor->workspace().camera.target -
               editor->player().simulation().worldFromBody(0, editor->player().alpha())[0].translation;
    };
    const vec3 before = offset();
    const vec3 target = editor->workspace().camera.target;
    pass(*editor, 60);
    CHECK(glm::distance(editor->workspace().camera.target, target) > 0.3F);
    CHECK(glm::distance(offset(), before) < 1e-4F);
    send(*editor, keyPressed(Key::f, {true, false, false}));
    CHECK_FALSE(editor->workspace().followed.has_value());
    const vec3 free = editor->workspace().camera.target;
    pass(*editor, 10);
    CHECK(editor->workspace().camera.target == free);
}
