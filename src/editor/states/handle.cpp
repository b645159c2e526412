#include <fmt/format.h>

#include "editor/states/states.hpp"

namespace lutka::editor {
namespace {

constexpr const char* kGroup = "handle";

/// Handle: drags an end of the active body's limits or shape, as one entry of undo.
class HandleHandler final : public StateHandler {
  public:
    explicit HandleHandler(Workspace& workspace) : workspace_(workspace) {}

    void enter() override {
        workspace_.document->endGroup();
        confirmed_ = false;
        shift_ = false;
        moved_ = false;
        drag_.reset();
        const auto handle = workspace_.handleUnderMouse();
        const auto scene = workspace_.handleScene();
        if (!handle || !scene) return;
        body_ = scene->body;
        drag_.emplace(*scene, handle->kind, workspace_.camera, workspace_.mouse, workspace_.window);
        workspace_.hotHandle = handle->kind;
    }

    void exit() override {
        if (moved_ && !confirmed_) {
            workspace_.document->cancelGroup();
            workspace_.follow();
        }
        workspace_.document->endGroup();
        workspace_.hotHandle.reset();
        workspace_.press.reset();
        workspace_.hint.clear();
        drag_.reset();
    }

    void update() override {
        if (!drag_) return;
        workspace_.hotHandle = drag_->kind();
        const std::optional<physics::Role> role = workspace_.document->profile().bodies[body_].role;
        const char* ends = drag_->kind() <= Handle::Kind::twistHigh ? "   Shift: this end alone or both" : "";
        workspace_.hint =
            fmt::format("{} {}{}   release: done  Esc: cancel", handleName(drag_->kind(), role), drag_->text(), ends);
    }

    std::optional<Trigger> mouseMove(const vec2& /*position*/, const vec2& /*movement*/) override {
        change();
        return std::nullopt;
    }

    std::optional<Trigger> mouseButton(const InputEvent& event) override {
        if (event.button == MouseButton::left && !event.pressed) return end(true);
        if (event.button == MouseButton::right && event.pressed) return end(false);
        return std::nullopt;
    }

    std::optional<Trigger> key(const InputEvent& event) override {
        if (event.key == Key::leftShift || event.key == Key::rightShift) {
            shift_ = event.pressed;
            if (moved_) change();
        }
        if (event.pressed && event.key == Key::escape) return end(false);
        if (event.pressed && event.key == Key::enter) return end(true);
        return std::nullopt;
    }

  private:
    std::optional<Trigger> end(bool confirmed) {
        confirmed_ = confirmed;
        return workspace_.ended();
    }

    void change() {
        const auto scene = workspace_.handleScene();
        if (!drag_ || !scene || scene->body != body_) return;
        // The ends of a cone's half axes go together unless the user wants one alone; those of a hinge the other way.
        const physics::ConstraintProfile* constraint = scene->constraint();
        const bool hinge = constraint != nullptr && constraint->kind == physics::ConstraintProfile::Kind::hinge;
        drag_->follow(*scene, workspace_.camera, workspace_.mouse, workspace_.window, hinge == shift_);
        const std::optional<physics::Role> role = workspace_.document->profile().bodies[body_].role;
        moved_ = workspace_.edit([&](EditorDocument& document) {
            return document.changeParts(std::span(&body_, 1), handleName(drag_->kind(), role), kGroup,
                                        [&](EditorDocument::Part& part) -> Result<void> {
                                            apply(part);
                                            return {};
                                        });
        }) || moved_;
    }

    void apply(EditorDocument::Part& part) const {
        if (drag_->kind() <= Handle::Kind::twistHigh) {
            physics::setJointRange(*part.constraint, drag_->range(), part.bind);
            return;
        }
        part.body.shape = drag_->shape();
        part.body.jointFromBody = drag_->jointFromBody();
    }

    Workspace& workspace_;
    std::optional<HandleDrag> drag_;
    int body_ = 0;
    bool shift_ = false;
    bool moved_ = false;
    bool confirmed_ = false;
};

}  // namespace

std::unique_ptr<StateHandler> makeHandleHandler(Workspace& workspace) {
    return std::make_unique<HandleHandler>(workspace);
}

}  // namespace lutka::editor
