#include <fstream>
#include <iterator>
#include <sstream>

#include "editor/states/state_machine.hpp"
#include "support/catch.hpp"

using namespace lutka;
using namespace lutka::editor;

namespace {

// Counts what a handler was told, and answers with a trigger when asked to.
struct Witness {
    int entered = 0;
    int left = 0;
    int events = 0;
    std::optional<Trigger> answer;
};

class Recorder final : public StateHandler {
  public:
    explicit Recorder(Witness& witness) : witness_(witness) {}
    void enter() override { ++witness_.entered; }
    void exit() override { ++witness_.left; }
    std::optional<Trigger> mouseMove(const vec2& /*position*/, const vec2& /*movement*/) override { return told(); }
    std::optional<Trigger> mouseButton(const InputEvent& /*event*/) override { return told(); }
    std::optional<Trigger> wheel(float /*notches*/) override { return told(); }
    std::optional<Trigger> key(const InputEvent& /*event*/) override { return told(); }

  private:
    std::optional<Trigger> told() {
        ++witness_.events;
        return witness_.answer;
    }
    Witness& witness_;
};

struct Machine {
    std::array<Witness, kStateCount> witnesses;
    StateMachine machine{handlers()};

    StateMachine::Handlers handlers() {
        StateMachine::Handlers made;
        for (int i = 0; i < kStateCount; ++i)
            made[i] = std::make_unique<Recorder>(witnesses[i]);
        return made;
    }
    void go(State state) {
        const std::pair<State, std::vector<Trigger>> ways[] = {
            {State::idle, {}},
            {State::selected, {Trigger::picked}},
            {State::grab, {Trigger::picked, Trigger::grabKey}},
            {State::rotate, {Trigger::picked, Trigger::rotateKey}},
            {State::scale, {Trigger::picked, Trigger::scaleKey}},
            {State::cameraMove, {Trigger::panPressed}},
            {State::cameraRotate, {Trigger::orbitPressed}},
            {State::add, {Trigger::addKey}},
            {State::remove, {Trigger::picked, Trigger::deleteKey}},
            {State::handle, {Trigger::picked, Trigger::handlePressed}},
            {State::pickJoint, {Trigger::pickJointAsked}},
            {State::box, {Trigger::boxPressed}},
        };
        for (const Trigger trigger : ways[static_cast<int>(state)].second)
            machine.fire(trigger);
        REQUIRE(machine.state() == state);
    }
};

// The table in words: what is not told here changes nothing.
State expected(State from, Trigger trigger) {
    using enum State;
    using enum Trigger;
    if (trigger == Trigger::picked || trigger == endedWithSelection) return selected;
    if (trigger == pickedNothing || trigger == endedWithNothing) return idle;
    const bool resting = from == idle || from == selected;
    const bool transforming = from == grab || from == rotate || from == scale;
    if (resting && (trigger == orbitPressed || trigger == dragBackground)) return cameraRotate;
    if (resting && trigger == panPressed) return cameraMove;
    if (resting && trigger == addKey) return add;
    if (from == selected && trigger == dragSelection) return grab;
    if (from == selected && trigger == deleteKey) return remove;
    if (from == selected && trigger == handlePressed) return handle;
    if (resting && trigger == pickJointAsked) return pickJoint;
    if (resting && trigger == boxPressed) return box;
    if (from == selected || transforming) {
        if (trigger == grabKey) return grab;
        if (trigger == rotateKey) return rotate;
        if (trigger == scaleKey) return scale;
    }
    return from;
}

}  // namespace

TEST_CASE("the transition table gives the expected state for every pair") {
    for (int s = 0; s < kStateCount; ++s) {
        for (int t = 0; t < kTriggerCount; ++t) {
            INFO(stateName(stateAt(s)) << " × " << triggerName(triggerAt(t)));
            CHECK(transition(stateAt(s), triggerAt(t)) == expected(stateAt(s), triggerAt(t)));
        }
    }
}

TEST_CASE("the machine follows the table and enters and leaves each state in pairs") {
    for (int s = 0; s < kStateCount; ++s) {
        for (int t = 0; t < kTriggerCount; ++t) {
            INFO(stateName(stateAt(s)) << " × " << triggerName(triggerAt(t)));
            Machine machine;
            machine.go(stateAt(s));
            const auto before = machine.witnesses;
            machine.machine.fire(triggerAt(t));
            const State now = machine.machine.state();
            CHECK(now == expected(stateAt(s), triggerAt(t)));
            const int changed = now == stateAt(s) ? 0 : 1;
            CHECK(machine.witnesses[s].left - before[s].left == changed);
            CHECK(machine.witnesses[static_cast<int>(now)].entered - before[static_cast<int>(now)].entered == changed);
            for (int i = 0; i < kStateCount; ++i) {
                const Witness& witness = machine.witnesses[i];
                CHECK(witness.entered - witness.left == (stateAt(i) == now ? 1 : 0));
            }
        }
    }
}

TEST_CASE("only the present state hears events and its answer is the transition") {
    Machine machine;
    machine.go(State::cameraRotate);
    machine.machine.mouseMove({1, 1}, {1, 1});
    machine.machine.mouseButton(mouseButton(MouseButton::left, true));
    machine.machine.wheel(1.0F);
    CHECK(machine.machine.state() == State::cameraRotate);
    machine.witnesses[static_cast<int>(State::cameraRotate)].answer = Trigger::endedWithSelection;
    machine.machine.key(keyPressed(Key::escape));
    CHECK(machine.machine.state() == State::selected);
    for (int i = 0; i < kStateCount; ++i)
        CHECK(machine.witnesses[i].events == (stateAt(i) == State::cameraRotate ? 4 : 0));
}

TEST_CASE("the drawing in docs shows the table as it is") {
    std::ifstream file(LUTKA_TESTS_DIR "/../docs/editor-states.md");
    REQUIRE(file.good());
    std::stringstream text;
    text << file.rdbuf();
    CHECK_THAT(text.str(), Catch::Contains(stateDiagram()));
}
