#include <fmt/format.h>

#include "editor/states/states.hpp"

namespace lutka::editor {
namespace {

constexpr render::Color kGhost{120, 200, 255, 255};
constexpr float kLightHeight = 1.8F;  // metres above what the mouse points at

/// Add: a preview follows the mouse until a click places it.
class AddHandler final : public StateHandler {
  public:
    explicit AddHandler(Workspace& workspace) : workspace_(workspace) {}

    void enter() override { follow(); }
    void exit() override {
        workspace_.ghost.reset();
        workspace_.hint.clear();
        workspace_.press.reset();
    }

    void update() override {
        follow();
        workspace_.hint = fmt::format("Add {}: click places it, 1 box, 2 ball, 3 light, Esc cancels",
                                      objectKindName(workspace_.addKind));
        if (workspace_.ghost) {
            render::addBox(workspace_.overlay, workspace_.ghost->worldFromObject, halfSizeOf(*workspace_.ghost),
                           kGhost);
        }
    }

    std::optional<Trigger> mouseMove(const vec2& /*position*/, const vec2& /*movement*/) override {
        follow();
        return std::nullopt;
    }

    std::optional<Trigger> mouseButton(const InputEvent& event) override {
        if (!event.pressed) return std::nullopt;
        if (event.button == MouseButton::left) return place();
        return workspace_.ended();
    }

    std::optional<Trigger> key(const InputEvent& event) override {
        if (!event.pressed) return std::nullopt;
        if (event.key == Key::escape) return workspace_.ended();
        if (event.key == Key::enter) return place();
        if (event.key == Key::digit1) workspace_.addKind = SceneObject::Kind::box;
        if (event.key == Key::digit2) workspace_.addKind = SceneObject::Kind::ball;
        if (event.key == Key::digit3) workspace_.addKind = SceneObject::Kind::light;
        return std::nullopt;
    }

  private:
    void follow() {
        const auto at = surfaceUnder(workspace_.mouseRay(), workspace_.player->simulation().world(), 0.0F);
        if (!at) {
            workspace_.ghost.reset();
            return;
        }
        SceneObject object;
        object.kind = workspace_.addKind;
        const float lift = object.kind == SceneObject::Kind::light ? kLightHeight : halfSizeOf(object).y;
        object.worldFromObject.translation = *at + vec3(0, lift, 0);
        workspace_.ghost = object;
    }

    std::optional<Trigger> place() {
        follow();
        if (!workspace_.ghost) {
            workspace_.say(Toast::Kind::info, "There is no ground under the mouse here");
            return std::nullopt;
        }
        SceneSettings scene = workspace_.document->state().scene;
        scene.objects.push_back(*workspace_.ghost);
        const std::string label = fmt::format("Add {}", objectKindName(workspace_.ghost->kind));
        const int index = static_cast<int>(scene.objects.size()) - 1;
        if (workspace_.report(workspace_.document->setScene(scene, label))) return workspace_.ended();
        workspace_.follow();
        workspace_.selection.set({Item::Kind::object, 0, index});
        return Trigger::endedWithSelection;
    }

    Workspace& workspace_;
};

/// Delete: asks once more.
class DeleteHandler final : public StateHandler {
  public:
    explicit DeleteHandler(Workspace& workspace) : workspace_(workspace) {}

    void exit() override { workspace_.hint.clear(); }
    void update() override {
        if (const auto active = workspace_.selection.active()) {
            workspace_.hint =
                fmt::format("Delete {}? Enter or X deletes, Esc or a click keeps", workspace_.nameOf(*active));
        }
    }

    std::optional<Trigger> mouseButton(const InputEvent& event) override {
        if (!event.pressed) return std::nullopt;
        return workspace_.ended();
    }

    std::optional<Trigger> key(const InputEvent& event) override {
        if (!event.pressed) return std::nullopt;
        if (event.key == Key::escape) return workspace_.ended();
        if (event.key != Key::enter && event.key != Key::x && event.key != Key::del) return std::nullopt;
        SceneSettings scene = workspace_.document->state().scene;
        std::vector<SceneObject> kept;
        for (int i = 0; i < static_cast<int>(scene.objects.size()); ++i) {
            if (!workspace_.selection.contains({Item::Kind::object, 0, i})) kept.push_back(scene.objects[i]);
        }
        scene.objects = std::move(kept);
        workspace_.selection.clear();
        workspace_.report(workspace_.document->setScene(scene, "Delete"));
        workspace_.follow();
        return Trigger::endedWithNothing;
    }

  private:
    Workspace& workspace_;
};

}  // namespace

std::unique_ptr<StateHandler> makeAddHandler(Workspace& workspace) {
    return std::make_unique<AddHandler>(workspace);
}

std::unique_ptr<StateHandler> makeDeleteHandler(Workspace& workspace) {
    return std::make_unique<DeleteHandler>(workspace);
}

}  // namespace lutka::editor
