#include "editor/input/window_input.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <utility>

namespace lutka::editor {
namespace {

WindowInput& inputOf(GLFWwindow* window) {
    return *static_cast<WindowInput*>(glfwGetWindowUserPointer(window));
}

Modifiers modifiersOf(int mods) {
    return {(mods & GLFW_MOD_SHIFT) != 0, (mods & GLFW_MOD_CONTROL) != 0, (mods & GLFW_MOD_ALT) != 0};
}

Key keyAfter(Key first, int steps) {
    return static_cast<Key>(static_cast<int>(first) + steps);
}

constexpr std::pair<int, Key> kOtherKeys[] = {
    {GLFW_KEY_SPACE, Key::space},
    {GLFW_KEY_ENTER, Key::enter},
    {GLFW_KEY_KP_ENTER, Key::enter},
    {GLFW_KEY_ESCAPE, Key::escape},
    {GLFW_KEY_TAB, Key::tab},
    {GLFW_KEY_BACKSPACE, Key::backspace},
    {GLFW_KEY_INSERT, Key::insert},
    {GLFW_KEY_DELETE, Key::del},
    {GLFW_KEY_LEFT, Key::left},
    {GLFW_KEY_RIGHT, Key::right},
    {GLFW_KEY_UP, Key::up},
    {GLFW_KEY_DOWN, Key::down},
    {GLFW_KEY_HOME, Key::home},
    {GLFW_KEY_END, Key::end},
    {GLFW_KEY_PAGE_UP, Key::pageUp},
    {GLFW_KEY_PAGE_DOWN, Key::pageDown},
    {GLFW_KEY_MINUS, Key::minus},
    {GLFW_KEY_KP_SUBTRACT, Key::minus},
    {GLFW_KEY_EQUAL, Key::equal},
    {GLFW_KEY_PERIOD, Key::period},
    {GLFW_KEY_KP_DECIMAL, Key::period},
    {GLFW_KEY_COMMA, Key::comma},
    {GLFW_KEY_SLASH, Key::slash},
    {GLFW_KEY_LEFT_SHIFT, Key::leftShift},
    {GLFW_KEY_RIGHT_SHIFT, Key::rightShift},
    {GLFW_KEY_LEFT_CONTROL, Key::leftControl},
    {GLFW_KEY_RIGHT_CONTROL, Key::rightControl},
    {GLFW_KEY_LEFT_ALT, Key::leftAlt},
    {GLFW_KEY_RIGHT_ALT, Key::rightAlt},
};

// Letters by what is written on the key, so that Ctrl+Z is where the user's keyboard has it.
Key keyOf(int key, int scancode) {
    const char* name = key >= GLFW_KEY_A && key <= GLFW_KEY_Z ? glfwGetKeyName(key, scancode) : nullptr;
    if (name != nullptr && name[0] >= 'a' && name[0] <= 'z' && name[1] == '\0') return keyAfter(Key::a, name[0] - 'a');
    if (key >= GLFW_KEY_A && key <= GLFW_KEY_Z) return keyAfter(Key::a, key - GLFW_KEY_A);
    if (key >= GLFW_KEY_0 && key <= GLFW_KEY_9) return keyAfter(Key::digit0, key - GLFW_KEY_0);
    if (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_9) return keyAfter(Key::digit0, key - GLFW_KEY_KP_0);
    if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F12) return keyAfter(Key::f1, key - GLFW_KEY_F1);
    for (const auto& [theirs, ours] : kOtherKeys) {
        if (theirs == key) return ours;
    }
    return Key::unknown;
}

void onMouseMove(GLFWwindow* window, double x, double y) {
    inputOf(window).add(mouseMoved({x, y}));
}

void onMouseButton(GLFWwindow* window, int button, int action, int mods) {
    if (button < GLFW_MOUSE_BUTTON_LEFT || button > GLFW_MOUSE_BUTTON_MIDDLE) return;
    inputOf(window).add(mouseButton(static_cast<MouseButton>(button), action == GLFW_PRESS, modifiersOf(mods)));
}
static_assert(GLFW_MOUSE_BUTTON_LEFT == static_cast<int>(MouseButton::left));
static_assert(GLFW_MOUSE_BUTTON_RIGHT == static_cast<int>(MouseButton::right));
static_assert(GLFW_MOUSE_BUTTON_MIDDLE == static_cast<int>(MouseButton::middle));

void onScroll(GLFWwindow* window, double /*x*/, double y) {
    inputOf(window).add(wheelTurned(static_cast<float>(y)));
}

void onKey(GLFWwindow* window, int key, int scancode, int action, int mods) {
    InputEvent event = keyPressed(keyOf(key, scancode), modifiersOf(mods));
    event.pressed = action != GLFW_RELEASE;
    event.repeated = action == GLFW_REPEAT;
    inputOf(window).add(event);
}

void onText(GLFWwindow* window, unsigned int codepoint) {
    inputOf(window).add(textTyped(codepoint));
}

void onDrop(GLFWwindow* window, int count, const char** paths) {
    inputOf(window).add(filesDropped({paths, paths + count}));
}

void onResize(GLFWwindow* window, int width, int height) {
    if (width > 0 && height > 0) inputOf(window).add(windowResized({width, height}));
}

void onFocus(GLFWwindow* window, int focused) {
    inputOf(window).add(focusChanged(focused == GLFW_TRUE));
}

void onClose(GLFWwindow* window) {
    glfwSetWindowShouldClose(window, GLFW_FALSE);  // the editor decides: there may be something to save
    inputOf(window).add(windowClosed());
}

}  // namespace

WindowInput::WindowInput(GLFWwindow* window) : window_(window) {
    glfwSetWindowUserPointer(window, this);
    glfwSetCursorPosCallback(window, onMouseMove);
    glfwSetMouseButtonCallback(window, onMouseButton);
    glfwSetScrollCallback(window, onScroll);
    glfwSetKeyCallback(window, onKey);
    glfwSetCharCallback(window, onText);
    glfwSetDropCallback(window, onDrop);
    glfwSetWindowSizeCallback(window, onResize);
    glfwSetWindowFocusCallback(window, onFocus);
    glfwSetWindowCloseCallback(window, onClose);
}

WindowInput::~WindowInput() {
    glfwSetCursorPosCallback(window_, nullptr);
    glfwSetMouseButtonCallback(window_, nullptr);
    glfwSetScrollCallback(window_, nullptr);
    glfwSetKeyCallback(window_, nullptr);
    glfwSetCharCallback(window_, nullptr);
    glfwSetDropCallback(window_, nullptr);
    glfwSetWindowSizeCallback(window_, nullptr);
    glfwSetWindowFocusCallback(window_, nullptr);
    glfwSetWindowCloseCallback(window_, nullptr);
    glfwSetWindowUserPointer(window_, nullptr);
}

void WindowInput::poll(std::vector<InputEvent>& events) {
    glfwPollEvents();
    events.insert(events.end(), events_.begin(), events_.end());
    events_.clear();
}

}  // namespace lutka::editor
