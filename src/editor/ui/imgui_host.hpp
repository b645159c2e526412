#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "editor/editor.hpp"
#include "editor/input/input_event.hpp"
#include "editor/ui/widgets.hpp"

struct ImFont;

namespace lutka::editor {

/// The fonts of the UI; the small and large ones share the same characters as far as a Debian package has them.
struct UiFonts {
    ImFont* text = nullptr;
    ImFont* heading = nullptr;
    ImFont* mono = nullptr;
    bool japanese = false;  ///< Whether a font with Japanese characters was found.
};

/// Dear ImGui with its GL back end, fed by InputEvents alone, so that a window, a script and a test drive it the same
/// way. Needs the GL context current from the constructor to the destructor; one at a time.
class ImguiHost {
  public:
    /// `scale` multiplies every size: 1 suits 96 dots per inch.
    explicit ImguiHost(float scale);
    ~ImguiHost();
    ImguiHost(const ImguiHost&) = delete;
    ImguiHost& operator=(const ImguiHost&) = delete;

    /// The window system's clipboard; without one Dear ImGui keeps its own.
    void useClipboard(std::function<const char*()> read, std::function<void(const char*)> write);

    void feed(const InputEvent& event);
    /// Begins a frame of `seconds`, with a window of that size in window coordinates and in pixels.
    void beginFrame(render::Extent window, render::Extent framebuffer, double seconds);
    /// What the UI takes of the events fed since the last frame; call after beginFrame().
    [[nodiscard]] UiCapture capture() const;
    /// Ends the frame and draws it into the framebuffer that is bound.
    void draw();
    /// In place of draw(), for a frame that nobody sees.
    void skipDrawing();

    [[nodiscard]] const UiFonts& fonts() const { return fonts_; }
    [[nodiscard]] float scale() const { return scale_; }
    /// Between frames: everything in another size, with the theme that is shown.
    void setScale(float scale, bool light);
    /// Whether a text field has the keyboard.
    [[nodiscard]] bool writing() const;

  private:
    void setModifiers(const InputEvent& event);
    void notePopup();

    UiFonts fonts_;
    WidgetMemory widgets_;
    float scale_;
    std::function<const char*()> readClipboard_;
    std::function<void(const char*)> writeClipboard_;
    std::array<bool, kMouseButtonCount> down_{};
    std::array<bool, kMouseButtonCount> clicked_{};  // pressed since the last frame, perhaps released again
    bool begun_ = false;
    bool fontsStale_ = false;  // made for another scale
    bool popup_ = false;       // one was open when the last frame ended
};

}  // namespace lutka::editor
