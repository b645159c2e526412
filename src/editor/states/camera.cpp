#include "editor/states/states.hpp"

namespace lutka::editor {
namespace {

constexpr float kRadiansPerPixel = 0.0075F;
constexpr float kDollyPerNotch = 0.89F;

/// CameraMove and CameraRotate: from a button's press to its release.
class CameraHandler final : public StateHandler {
  public:
    CameraHandler(Workspace& workspace, bool pans) : workspace_(workspace), pans_(pans) {}

    void enter() override { workspace_.hint = pans_ ? "Panning" : "Orbiting"; }
    void exit() override {
        workspace_.hint.clear();
        workspace_.press.reset();
    }

    std::optional<Trigger> mouseMove(const vec2& /*position*/, const vec2& movement) override {
        if (pans_) {
            render::pan(workspace_.camera, movement, workspace_.window);
        } else {
            render::orbit(workspace_.camera, -movement.x * kRadiansPerPixel, movement.y * kRadiansPerPixel);
        }
        return std::nullopt;
    }

    std::optional<Trigger> mouseButton(const InputEvent& event) override {
        if (event.pressed || event.button != workspace_.cameraButton) return std::nullopt;
        return workspace_.ended();
    }

    std::optional<Trigger> wheel(float notches) override {
        render::dolly(workspace_.camera, std::pow(kDollyPerNotch, notches));
        return std::nullopt;
    }

    std::optional<Trigger> key(const InputEvent& event) override {
        if (!event.pressed || event.key != Key::escape) return std::nullopt;
        return workspace_.ended();
    }

  private:
    Workspace& workspace_;
    bool pans_;
};

}  // namespace

std::unique_ptr<StateHandler> makeCameraMoveHandler(Workspace& workspace) {
    return std::make_unique<CameraHandler>(workspace, true);
}

std::unique_ptr<StateHandler> makeCameraRotateHandler(Workspace& workspace) {
    return std::make_unique<CameraHandler>(workspace, false);
}

}  // namespace lutka::editor
