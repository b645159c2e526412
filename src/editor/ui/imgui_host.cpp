#include "editor/ui/imgui_host.hpp"

#include <imgui.h>
#include <imgui_impl_opengl3.h>

#include <utility>

#include "editor/ui/fonts.hpp"
#include "editor/ui/style.hpp"

namespace lutka::editor {
namespace {

void mapKeys(ImGuiIO& io) {
    const std::pair<ImGuiKey, Key> keys[] = {
        {ImGuiKey_Tab, Key::tab},
        {ImGuiKey_LeftArrow, Key::left},
        {ImGuiKey_RightArrow, Key::right},
        {ImGuiKey_UpArrow, Key::up},
        {ImGuiKey_DownArrow, Key::down},
        {ImGuiKey_PageUp, Key::pageUp},
        {ImGuiKey_PageDown, Key::pageDown},
        {ImGuiKey_Home, Key::home},
        {ImGuiKey_End, Key::end},
        {ImGuiKey_Insert, Key::insert},
        {ImGuiKey_Delete, Key::del},
        {ImGuiKey_Backspace, Key::backspace},
        {ImGuiKey_Space, Key::space},
        {ImGuiKey_Enter, Key::enter},
        {ImGuiKey_Escape, Key::escape},
        {ImGuiKey_A, Key::a},
        {ImGuiKey_C, Key::c},
        {ImGuiKey_V, Key::v},
        {ImGuiKey_X, Key::x},
        {ImGuiKey_Y, Key::y},
        {ImGuiKey_Z, Key::z},
    };
    for (const auto& [theirs, ours] : keys)
        io.KeyMap[theirs] = static_cast<int>(ours);
}

}  // namespace

ImguiHost::ImguiHost(float scale) : scale_(scale) {
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;  // the layout is our own
    io.UserData = &widgets_;
    io.BackendPlatformName = "lutka";
    mapKeys(io);
    applyStyle(scale);
    fonts_ = loadFonts(scale);
    ImGui_ImplOpenGL3_Init("#version 330 core");
}

ImguiHost::~ImguiHost() {
    if (begun_) ImGui::EndFrame();
    ImGui_ImplOpenGL3_Shutdown();
    ImGui::DestroyContext();
}

void ImguiHost::useClipboard(std::function<const char*()> read, std::function<void(const char*)> write) {
    readClipboard_ = std::move(read);
    writeClipboard_ = std::move(write);
    ImGuiIO& io = ImGui::GetIO();
    io.ClipboardUserData = this;
    io.GetClipboardTextFn = [](void* self) { return static_cast<ImguiHost*>(self)->readClipboard_(); };
    io.SetClipboardTextFn = [](void* self, const char* text) { static_cast<ImguiHost*>(self)->writeClipboard_(text); };
}

void ImguiHost::setModifiers(const InputEvent& event) {
    ImGuiIO& io = ImGui::GetIO();
    // On a modifier's own key the event tells of the moment before it.
    io.KeyShift = event.modifiers.shift;
    io.KeyCtrl = event.modifiers.control;
    io.KeyAlt = event.modifiers.alt;
    if (event.kind != InputEvent::Kind::key) return;
    if (event.key == Key::leftShift || event.key == Key::rightShift) io.KeyShift = event.pressed;
    if (event.key == Key::leftControl || event.key == Key::rightControl) io.KeyCtrl = event.pressed;
    if (event.key == Key::leftAlt || event.key == Key::rightAlt) io.KeyAlt = event.pressed;
}

void ImguiHost::feed(const InputEvent& event) {
    ImGuiIO& io = ImGui::GetIO();
    const auto button = static_cast<std::size_t>(event.button);
    switch (event.kind) {
        case InputEvent::Kind::mouseMove:
            io.MousePos = {event.position.x, event.position.y};
            break;
        case InputEvent::Kind::mouseButton:
            setModifiers(event);
            down_[button] = event.pressed;
            clicked_[button] = clicked_[button] || event.pressed;
            break;
        case InputEvent::Kind::wheel:
            io.MouseWheel += event.wheel;
            break;
        case InputEvent::Kind::key:
            setModifiers(event);
            io.KeysDown[static_cast<int>(event.key)] = event.pressed;
            break;
        case InputEvent::Kind::text:
            io.AddInputCharacter(event.codepoint);
            break;
        case InputEvent::Kind::focus:
            if (event.pressed) break;
            down_ = {};
            std::fill(std::begin(io.KeysDown), std::end(io.KeysDown), false);
            io.KeyShift = io.KeyCtrl = io.KeyAlt = false;
            break;
        case InputEvent::Kind::drop:
        case InputEvent::Kind::resize:
        case InputEvent::Kind::close:
            break;
    }
}

void ImguiHost::beginFrame(render::Extent window, render::Extent framebuffer, double seconds) {
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {static_cast<float>(window.width), static_cast<float>(window.height)};
    io.DisplayFramebufferScale = {static_cast<float>(framebuffer.width) / io.DisplaySize.x,
                                  static_cast<float>(framebuffer.height) / io.DisplaySize.y};
    io.DeltaTime = std::max(static_cast<float>(seconds), 1e-4F);
    // A click shorter than a frame still is one.
    for (std::size_t button = 0; button < down_.size(); ++button)
        io.MouseDown[button] = down_[button] || clicked_[button];
    clicked_ = {};
    if (std::exchange(fontsStale_, false)) {
        io.Fonts->Clear();
        fonts_ = loadFonts(scale_);
        ImGui_ImplOpenGL3_DestroyFontsTexture();
        ImGui_ImplOpenGL3_CreateFontsTexture();
    }
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::NewFrame();
    begun_ = true;
}

UiCapture ImguiHost::capture() const {
    const ImGuiIO& io = ImGui::GetIO();
    return {io.WantCaptureMouse, io.WantCaptureKeyboard || popup_};
}

bool ImguiHost::writing() const {
    return ImGui::GetIO().WantTextInput;
}

void ImguiHost::setScale(float scale, bool light) {
    scale_ = scale;
    applyStyle(scale, light);
    fontsStale_ = true;
}

void ImguiHost::skipDrawing() {
    notePopup();
    ImGui::EndFrame();
    begun_ = false;
}

// A menu or a list that is open has the keyboard, though Dear ImGui claims it for text fields only.
void ImguiHost::notePopup() {
    popup_ = ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
}

void ImguiHost::draw() {
    notePopup();
    ImGui::Render();
    begun_ = false;
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace lutka::editor
