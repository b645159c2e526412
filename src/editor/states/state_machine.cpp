#include "editor/states/state_machine.hpp"

#include <fmt/format.h>

#include "core/assert.hpp"

namespace lutka::editor {
namespace {

using Transitions = std::array<State, kTriggerCount>;

/// Rows: the present state, in the order of State. Columns: the trigger, in the order of Trigger.
constexpr std::array<Transitions, kStateCount> makeTable() {
    constexpr State idle = State::idle;
    constexpr State sel = State::selected;
    constexpr State grab = State::grab;
    constexpr State rot = State::rotate;
    constexpr State scal = State::scale;
    constexpr State move = State::cameraMove;
    constexpr State orb = State::cameraRotate;
    constexpr State add = State::add;
    constexpr State del = State::remove;
    constexpr State hand = State::handle;
    constexpr State pick = State::pickJoint;
    constexpr State box = State::box;
    // clang-format off
    return {{
        //        picked nothing dragSel dragBg  G     R     S     orbit pan   add   delete handle pickJoint box   ended… …nothing
        /*idle*/ {sel,   idle,   idle,   orb,    idle, idle, idle, orb,  move, add,  idle,  idle,  pick,     box,  sel,   idle},
        /*sel */ {sel,   idle,   grab,   orb,    grab, rot,  scal, orb,  move, add,  del,   hand,  pick,     box,  sel,   idle},
        /*grab*/ {sel,   idle,   grab,   grab,   grab, rot,  scal, grab, grab, grab, grab,  grab,  grab,     grab, sel,   idle},
        /*rot */ {sel,   idle,   rot,    rot,    grab, rot,  scal, rot,  rot,  rot,  rot,   rot,   rot,      rot,  sel,   idle},
        /*scal*/ {sel,   idle,   scal,   scal,   grab, rot,  scal, scal, scal, scal, scal,  scal,  scal,     scal, sel,   idle},
        /*move*/ {sel,   idle,   move,   move,   move, move, move, move, move, move, move,  move,  move,     move, sel,   idle},
        /*orb */ {sel,   idle,   orb,    orb,    orb,  orb,  orb,  orb,  orb,  orb,  orb,   orb,   orb,      orb,  sel,   idle},
        /*add */ {sel,   idle,   add,    add,    add,  add,  add,  add,  add,  add,  add,   add,   add,      add,  sel,   idle},
        /*del */ {sel,   idle,   del,    del,    del,  del,  del,  del,  del,  del,  del,   del,   del,      del,  sel,   idle},
        /*hand*/ {sel,   idle,   hand,   hand,   hand, hand, hand, hand, hand, hand, hand,  hand,  hand,     hand, sel,   idle},
        /*pick*/ {sel,   idle,   pick,   pick,   pick, pick, pick, pick, pick, pick, pick,  pick,  pick,     pick, sel,   idle},
        /*box */ {sel,   idle,   box,    box,    box,  box,  box,  box,  box,  box,  box,   box,   box,      box,  sel,   idle},
    }};
    // clang-format on
}
constexpr std::array<Transitions, kStateCount> kTable = makeTable();

constexpr std::array<std::string_view, kStateCount> kStateNames = {"Default", "Selected",   "Grab",         "Rotate",
                                                                   "Scale",   "CameraMove", "CameraRotate", "Add",
                                                                   "Delete",  "Handle",     "PickJoint",    "Box"};
constexpr std::array<std::string_view, kTriggerCount> kTriggerNames = {
    "picked",
    "picked nothing",
    "left drag on the selection",
    "left drag beside everything",
    "G",
    "R",
    "S",
    "right or middle press",
    "shift + right or middle press",
    "Shift+A",
    "X or Delete",
    "left press on a handle",
    "a joint is asked for",
    "Ctrl + left press",
    "ended, something selected",
    "ended, nothing selected",
};

}  // namespace

std::string_view stateName(State state) {
    return kStateNames[static_cast<std::size_t>(state)];
}

std::string_view stateWords(State state) {
    constexpr std::array<std::string_view, kStateCount> words = {
        "ready",    "selected", "grabbing",         "turning",           "resizing",        "panning",
        "orbiting", "adding",   "asking to delete", "dragging a handle", "picking a joint", "selecting"};
    return words[static_cast<std::size_t>(state)];
}

std::string_view triggerName(Trigger trigger) {
    return kTriggerNames[static_cast<std::size_t>(trigger)];
}

State transition(State state, Trigger trigger) {
    return kTable[static_cast<std::size_t>(state)][static_cast<std::size_t>(trigger)];
}

std::string stateDiagram() {
    std::string text = "stateDiagram-v2\n    [*] --> Default\n";
    for (int from = 0; from < kStateCount; ++from) {
        for (int to = 0; to < kStateCount; ++to) {
            if (to == from) continue;
            std::string label;
            for (int trigger = 0; trigger < kTriggerCount; ++trigger) {
                if (transition(stateAt(from), triggerAt(trigger)) != stateAt(to)) continue;
                label += fmt::format("{}{}", label.empty() ? "" : "<br/>", triggerName(triggerAt(trigger)));
            }
            if (label.empty()) continue;
            text += fmt::format("    {} --> {}: {}\n", stateName(stateAt(from)), stateName(stateAt(to)), label);
        }
    }
    return text;
}

StateMachine::StateMachine(Handlers handlers) : handlers_(std::move(handlers)) {
    for ([[maybe_unused]] const auto& one : handlers_)
        LUTKA_ASSERT(one != nullptr);
    handler().enter();
}

void StateMachine::fire(Trigger trigger) {
    const State next = transition(state_, trigger);
    if (next == state_) return;
    handler().exit();
    state_ = next;
    handler().enter();
}

void StateMachine::fire(std::optional<Trigger> trigger) {
    if (trigger) fire(*trigger);
}

void StateMachine::mouseMove(const vec2& position, const vec2& movement) {
    fire(handler().mouseMove(position, movement));
}

void StateMachine::mouseButton(const InputEvent& event) {
    fire(handler().mouseButton(event));
}

void StateMachine::wheel(float notches) {
    fire(handler().wheel(notches));
}

void StateMachine::key(const InputEvent& event) {
    fire(handler().key(event));
}

void StateMachine::update() {
    handler().update();
}

}  // namespace lutka::editor
