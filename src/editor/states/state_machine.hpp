#pragma once

/// The editor's finite state machine. What leads where is the table in state_machine.cpp and nothing else; what happens
/// in a state is its StateHandler's affair. docs/editor-states.md has the drawing, made by `lutka edit --states`.

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "editor/input/input_event.hpp"

namespace lutka::editor {

enum class State {
    idle,          ///< "Default": nothing is selected, nothing is under way.
    selected,      ///< Something is selected.
    grab,          ///< Pulls a body, or moves an object.
    rotate,        ///< Turns a doll or an object.
    scale,         ///< Resizes a body's shape or an object.
    cameraMove,    ///< Pans.
    cameraRotate,  ///< Orbits.
    add,           ///< Places a new object where the mouse points.
    remove,        ///< "Delete": asks whether to delete the selected object.
    handle,        ///< Drags an end of the active body's limits or shape.
    pickJoint,     ///< Asks for the joint of a role or of a new body, by a click.
    box,           ///< Selects by a rectangle.
};
inline constexpr int kStateCount = 12;

/// What can make a state give way to another. Handlers turn raw input into these.
enum class Trigger {
    picked,              ///< Something was selected, in the view or in a panel.
    pickedNothing,       ///< The selection was emptied.
    dragSelection,       ///< The left button went down on the selection and moved.
    dragBackground,      ///< The left button went down beside everything and moved.
    grabKey,             ///< G
    rotateKey,           ///< R
    scaleKey,            ///< S
    orbitPressed,        ///< Right or middle button.
    panPressed,          ///< The same with shift.
    addKey,              ///< Shift+A
    deleteKey,           ///< X or Delete, on what can be deleted.
    handlePressed,       ///< The left button went down on a handle of the active body.
    pickJointAsked,      ///< A panel asks for a joint.
    boxPressed,          ///< The left button went down with Ctrl.
    endedWithSelection,  ///< The state's work is done or cancelled, and something is selected …
    endedWithNothing,    ///< … or nothing is.
};
inline constexpr int kTriggerCount = 16;

[[nodiscard]] constexpr State stateAt(int index) {
    return static_cast<State>(index);
}
[[nodiscard]] constexpr Trigger triggerAt(int index) {
    return static_cast<Trigger>(index);
}
[[nodiscard]] std::string_view stateName(State state);
/// What the user is doing in it: "orbiting".
[[nodiscard]] std::string_view stateWords(State state);
[[nodiscard]] std::string_view triggerName(Trigger trigger);

/// The transition table: where `trigger` leads from `state`; `state` itself where it changes nothing.
[[nodiscard]] State transition(State state, Trigger trigger);

/// The table as a Mermaid state diagram.
[[nodiscard]] std::string stateDiagram();

/// What a state does. Every answer is the trigger to fire, if any; a handler never changes the state by itself.
class StateHandler {
  public:
    virtual ~StateHandler() = default;
    StateHandler(const StateHandler&) = delete;
    StateHandler& operator=(const StateHandler&) = delete;

    virtual void enter() {}
    /// Undoes whatever must not outlive the state: drags, captures, previews.
    virtual void exit() {}
    /// Once a frame, before the simulation steps.
    virtual void update() {}
    virtual std::optional<Trigger> mouseMove(const vec2& /*position*/, const vec2& /*movement*/) {
        return std::nullopt;
    }
    virtual std::optional<Trigger> mouseButton(const InputEvent& /*event*/) { return std::nullopt; }
    virtual std::optional<Trigger> wheel(float /*notches*/) { return std::nullopt; }
    virtual std::optional<Trigger> key(const InputEvent& /*event*/) { return std::nullopt; }

  protected:
    StateHandler() = default;
};

/// Runs the handlers along the table. Deterministic: the same triggers and events give the same states.
class StateMachine {
  public:
    using Handlers = std::array<std::unique_ptr<StateHandler>, kStateCount>;

    /// One handler a state, in the order of State; starts in State::idle and enters it.
    explicit StateMachine(Handlers handlers);

    [[nodiscard]] State state() const { return state_; }
    /// Takes the transition: exit() of the old state and enter() of the new one, when they differ.
    void fire(Trigger trigger);

    void mouseMove(const vec2& position, const vec2& movement);
    void mouseButton(const InputEvent& event);
    void wheel(float notches);
    void key(const InputEvent& event);
    void update();

  private:
    [[nodiscard]] StateHandler& handler() { return *handlers_[static_cast<std::size_t>(state_)]; }
    void fire(std::optional<Trigger> trigger);

    Handlers handlers_;
    State state_ = State::idle;
};

}  // namespace lutka::editor
