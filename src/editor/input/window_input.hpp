#pragma once

#include <vector>

#include "editor/input/input_event.hpp"

struct GLFWwindow;

namespace lutka::editor {

/// Turns a GLFW window's callbacks into InputEvents. Takes the window's user pointer; must outlive its events.
class WindowInput {
  public:
    explicit WindowInput(GLFWwindow* window);
    ~WindowInput();
    WindowInput(const WindowInput&) = delete;
    WindowInput& operator=(const WindowInput&) = delete;

    /// Polls the window system and moves what has happened since the last call into `events`.
    void poll(std::vector<InputEvent>& events);

    void add(InputEvent event) { events_.push_back(std::move(event)); }

  private:
    GLFWwindow* window_;
    std::vector<InputEvent> events_;
};

}  // namespace lutka::editor
