#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "editor/states/states.hpp"
#include "editor/view/pick_targets.hpp"

namespace lutka::editor {
namespace {

constexpr float kClickPixels = 4.0F;

/// Box: a rectangle drawn with Ctrl selects what has its middle in it, with Shift beside what was selected. A click
/// without a drag adds what is under the mouse or takes it away.
class BoxHandler final : public StateHandler {
  public:
    explicit BoxHandler(Workspace& workspace) : workspace_(workspace) {}

    void enter() override {
        start_ = workspace_.mouse;
        workspace_.box = Workspace::Box{start_, start_};
        workspace_.hint = "Select by a box   Shift: add   Esc: cancel";
    }
    void exit() override {
        workspace_.box.reset();
        workspace_.press.reset();
        workspace_.hint.clear();
    }

    std::optional<Trigger> mouseMove(const vec2& position, const vec2& /*movement*/) override {
        workspace_.box = Workspace::Box{glm::min(start_, position), glm::max(start_, position)};
        return std::nullopt;
    }

    std::optional<Trigger> mouseButton(const InputEvent& event) override {
        if (event.button == MouseButton::right && event.pressed) return workspace_.ended();
        if (event.button != MouseButton::left || event.pressed) return std::nullopt;
        if (glm::distance(start_, workspace_.mouse) < kClickPixels) {
            if (const auto pick = workspace_.pickUnderMouse()) workspace_.selection.toggle(pick->item);
        } else {
            take(event.modifiers.shift);
        }
        return workspace_.ended();
    }

    std::optional<Trigger> key(const InputEvent& event) override {
        return event.pressed && event.key == Key::escape ? std::optional(workspace_.ended()) : std::nullopt;
    }

  private:
    void take(bool add) {
        if (!add) workspace_.selection.clear();
        const auto takeItem = [&](const Item& item) {
            if (isInside(workspace_.positionOf(item)) && !workspace_.selection.contains(item))
                workspace_.selection.toggle(item);
        };
        const Player& player = *workspace_.player;
        for (int doll = 0; doll < player.simulation().dollCount(); ++doll) {
            if (!player.isEditedDoll(doll)) {
                takeItem({Item::Kind::object, 0, static_cast<int>(player.entityOfDoll(doll))});
                continue;
            }
            for (int body = 0; body < static_cast<int>(workspace_.document->profile().bodies.size()); ++body)
                takeItem({Item::Kind::body, doll, body});
        }
        for (const PickTarget& target : pickTargets(*workspace_.document, player))
            takeItem({Item::Kind::object, 0, target.entity});
    }

    [[nodiscard]] bool isInside(const vec3& world) const {
        const auto seen = render::project(workspace_.camera, world, workspace_.window);
        if (!seen) return false;
        const Workspace::Box& box = *workspace_.box;
        return seen->x >= box.low.x && seen->x <= box.high.x && seen->y >= box.low.y && seen->y <= box.high.y;
    }

    Workspace& workspace_;
    vec2 start_{0, 0};
};

}  // namespace

std::unique_ptr<StateHandler> makeBoxHandler(Workspace& workspace) {
    return std::make_unique<BoxHandler>(workspace);
}

}  // namespace lutka::editor
