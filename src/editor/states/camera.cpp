#include <algorithm>

#include "editor/states/states.hpp"

namespace lutka::editor {
namespace {

constexpr float kRadiansPerPixel = 0.0075F;

/// CameraMove and CameraRotate: from a button's press to its release.
class CameraHandler final : public StateHandler {
  public:
    CameraHandler(Workspace& workspace, bool pans) : workspace_(workspace), pans_(pans) {}

    void enter() override { workspace_.hint = pans_ ? "Panning" : "Orbiting   W A S D Q E fly, with Shift faster"; }
    void exit() override {
        flying_ = {};
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
        workspace_.zoom(notches);
        return std::nullopt;
    }

    // Flying: target and eye move together, at a pace that suits the distance.
    void update() override {
        render::Camera& camera = workspace_.camera;
        vec3 direction(0);
        const vec3 ways[] = {render::forwardOf(camera), -render::rightOf(camera), -render::forwardOf(camera),
                             render::rightOf(camera),   vec3(0, -1, 0),           vec3(0, 1, 0)};
        for (std::size_t i = 0; i < kFlyKeys.size(); ++i) {
            if (flying_[i]) direction += ways[i];
        }
        constexpr float slowest = 1.0F;  // m/s
        constexpr float faster = 4.0F;
        const float pace = std::max(slowest, camera.distance * 0.5F) * (fast_ ? faster : 1.0F);
        camera.target += direction * pace * workspace_.frameSeconds;
    }

    std::optional<Trigger> key(const InputEvent& event) override {
        fast_ = event.modifiers.shift;
        const auto* const fly = std::find(kFlyKeys.begin(), kFlyKeys.end(), event.key);
        if (fly != kFlyKeys.end()) flying_[static_cast<std::size_t>(fly - kFlyKeys.begin())] = event.pressed;
        if (!event.pressed || event.key != Key::escape) return std::nullopt;
        return workspace_.ended();
    }

  private:
    static constexpr std::array kFlyKeys = {Key::w, Key::a, Key::s, Key::d, Key::q, Key::e};

    Workspace& workspace_;
    bool pans_;
    bool fast_ = false;
    std::array<bool, kFlyKeys.size()> flying_{};
};

}  // namespace

std::unique_ptr<StateHandler> makeCameraMoveHandler(Workspace& workspace) {
    return std::make_unique<CameraHandler>(workspace, true);
}

std::unique_ptr<StateHandler> makeCameraRotateHandler(Workspace& workspace) {
    return std::make_unique<CameraHandler>(workspace, false);
}

}  // namespace lutka::editor
