#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "editor/states/states.hpp"

namespace lutka::editor {
namespace {

constexpr float kDragPixels = 4.0F;  // a click may tremble this much
constexpr float kLeastHitNs = 1.0F;
constexpr float kMostHitNs = 1000.0F;
constexpr float kPerNotch = 1.15F;  // of the hit's impulse
constexpr render::Color kHitColor{255, 90, 60, 255};

/// Default and Selected: what waits for the user. Clicks select; drags and keys lead on.
class SelectHandler final : public StateHandler {
  public:
    explicit SelectHandler(Workspace& workspace) : workspace_(workspace) {}

    void exit() override {
        workspace_.hint.clear();
        workspace_.hotHandle.reset();
        workspace_.hotGizmo.reset();
    }

    void update() override {
        if (const auto gizmo = workspace_.gizmo())
            drawGizmo(*gizmo, workspace_.hotGizmo, workspace_.camera, workspace_.overlay);
        if (workspace_.tool == Tool::hit && showHit()) return;
        if (workspace_.tool == Tool::hit) {
            workspace_.hint = "Point at a body: a click hits it   wheel over it: harder or softer   T: the next tool";
            return;
        }
        const auto active = workspace_.selection.active();
        const char* last = active && active->kind == Item::Kind::body ? "P pin  X remove" : "X delete";
        if (workspace_.hotHandle && active && active->kind == Item::Kind::body) {
            const std::optional<physics::Role> role = workspace_.document->profile().bodies[active->index].role;
            workspace_.hint = "Drag: " + handleName(*workspace_.hotHandle, role);
            return;
        }
        workspace_.hint = active ? workspace_.nameOf(*active) + "   G grab  R rotate  S scale  F focus  " + last
                                 : "Click selects, drag pulls, right drag orbits, wheel zooms, ? shows all keys";
    }

    std::optional<Trigger> mouseMove(const vec2& position, const vec2& /*movement*/) override {
        hover();
        if (!workspace_.press || glm::distance(position, workspace_.press->position) < kDragPixels) return std::nullopt;
        if (workspace_.press->pick && movable(*workspace_.press)) return Trigger::dragSelection;
        workspace_.cameraButton = MouseButton::left;
        return Trigger::dragBackground;
    }

    std::optional<Trigger> mouseButton(const InputEvent& event) override {
        if (event.button != MouseButton::left) {
            if (!event.pressed) return std::nullopt;
            workspace_.cameraButton = event.button;
            return event.modifiers.shift ? Trigger::panPressed : Trigger::orbitPressed;
        }
        if (!event.pressed) {
            workspace_.press.reset();
            return std::nullopt;
        }
        if (event.modifiers.control) return Trigger::boxPressed;
        if (workspace_.tool == Tool::hit && !event.modifiers.shift) {
            workspace_.hit = workspace_.pickUnderMouse();
            if (workspace_.hit && workspace_.hit->body) return std::nullopt;
            workspace_.hit.reset();
        }
        if (!event.modifiers.shift && workspace_.handleUnderMouse()) return Trigger::handlePressed;
        if (const auto part = workspace_.gizmoUnderMouse(); part && !event.modifiers.shift) return dragGizmo(*part);
        workspace_.press = Workspace::Press{workspace_.mouse, workspace_.pickUnderMouse(), false, vec3(0)};
        if (const auto& pick = workspace_.press->pick) {
            workspace_.press->wasSelected = workspace_.selection.contains(pick->item);
        }
        if (const auto& pick = workspace_.press->pick; pick && pick->body) {
            const auto bodies = workspace_.player->bodiesOf(pick->body->doll);
            workspace_.press->bodyPoint = inverse(bodies[pick->body->index].worldFromBody) * pick->position;
        }
        return select(workspace_.press->pick, event.modifiers.shift);
    }

    std::optional<Trigger> wheel(float notches) override {
        if (workspace_.tool == Tool::hit && bodyUnderMouse()) {
            workspace_.hitNs = std::clamp(workspace_.hitNs * std::pow(kPerNotch, notches), kLeastHitNs, kMostHitNs);
            return std::nullopt;
        }
        workspace_.zoom(notches);
        return std::nullopt;
    }

    std::optional<Trigger> key(const InputEvent& event) override {
        if (!event.pressed || event.modifiers.control || event.modifiers.alt) return std::nullopt;
        switch (event.key) {
            case Key::g:
                return Trigger::grabKey;
            case Key::r:
                return Trigger::rotateKey;
            case Key::s:
                return Trigger::scaleKey;
            case Key::a:
                if (event.modifiers.shift) return Trigger::addKey;
                return std::nullopt;
            case Key::x:
            case Key::del:
                return deleteAsked();
            case Key::escape:
                workspace_.selection.clear();
                return Trigger::pickedNothing;
            default:
                return std::nullopt;
        }
    }

  private:
    [[nodiscard]] std::optional<Pick> bodyUnderMouse() const {
        auto pick = workspace_.shapeUnderMouse();
        return pick && pick->body ? pick : std::nullopt;
    }

    // A ball where a click would hit; whether there is something to hit.
    bool showHit() {
        const auto pick = bodyUnderMouse();
        if (!pick) return false;
        // Seen along its own direction an arrow is a point: the harder, the larger the ball.
        const float radius = 0.012F * std::cbrt(workspace_.hitNs);
        render::addSphere(workspace_.overlay, pick->position, radius, kHitColor);
        render::addCross(workspace_.overlay, pick->position, 2.0F * radius, kHitColor);
        workspace_.hint = fmt::format("A click hits {} with {:.0f} N s   wheel: more or less   T: the next tool",
                                      workspace_.nameOf(*pick->body), workspace_.hitNs);
        return true;
    }

    // The stairs and walls of a named scene fill the picture: a drag on them orbits, unless they were chosen before.
    [[nodiscard]] bool movable(const Workspace::Press& press) const {
        if (press.pick->body || press.wasSelected) return true;
        const std::vector<scene::EntityId>& made = workspace_.document->sceneDocument().settings().made;
        const auto id = static_cast<scene::EntityId>(press.pick->item.index);
        const bool moves = workspace_.document->scene().find<scene::RigidBody>(id) != nullptr;
        return moves || !std::binary_search(made.begin(), made.end(), id);
    }

    void hover() {
        const auto handle = workspace_.press ? std::nullopt : workspace_.handleUnderMouse();
        workspace_.hotHandle = handle ? std::optional(handle->kind) : std::nullopt;
        workspace_.hotGizmo = workspace_.press || handle ? std::nullopt : workspace_.gizmoUnderMouse();
    }

    Trigger dragGizmo(const AxisLock& part) {
        workspace_.press = Workspace::Press{workspace_.mouse, std::nullopt, true, vec3(0)};
        workspace_.gizmoLock = part;
        const Tool tool = workspace_.gizmo()->tool;
        return tool == Tool::rotate ? Trigger::rotateKey : tool == Tool::scale ? Trigger::scaleKey : Trigger::grabKey;
    }

    std::optional<Trigger> select(const std::optional<Pick>& pick, bool add) {
        if (pick && add) {
            workspace_.selection.toggle(pick->item);
        } else if (pick) {
            workspace_.selection.set(pick->item);
        } else if (!add) {
            workspace_.selection.clear();
        }
        return workspace_.selection.empty() ? Trigger::pickedNothing : Trigger::picked;
    }

    std::optional<Trigger> deleteAsked() {
        const auto active = workspace_.selection.active();
        if (!active) return std::nullopt;
        if (active->kind == Item::Kind::object || active->index > 0) return Trigger::deleteKey;
        workspace_.say(Toast::Kind::info, workspace_.nameOf(*active) + " is the root: all other bodies hang on it");
        return std::nullopt;
    }

    Workspace& workspace_;
};

}  // namespace

std::unique_ptr<StateHandler> makeSelectHandler(Workspace& workspace) {
    return std::make_unique<SelectHandler>(workspace);
}

}  // namespace lutka::editor
