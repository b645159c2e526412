#include <fmt/format.h>

#include <array>

#include "editor/states/body_commands.hpp"
#include "editor/states/states.hpp"

namespace lutka::editor {
namespace {

constexpr render::Color kGhost{120, 200, 255, 255};
constexpr float kMarkerHeight = 1.8F;  // metres of a light or camera above what the mouse points at
constexpr float kDropHeight = 0.5F;    // metres that a new character falls

using scene::EntityKind;

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
        workspace_.hint = fmt::format(
            "Add {}: click places it, Esc cancels   1 box 2 sphere 3 light 4 capsule 5 ramp 6 stairs "
            "7 character 8 spot 9 camera",
            scene::entityKindName(workspace_.addKind));
        if (workspace_.ghost) {
            const scene::EntityBox box = ghostBox();
            RigidTransform frame = *workspace_.ghost;
            frame.translation = frame * box.center;
            render::addBox(workspace_.overlay, frame, box.half, kGhost);
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
        constexpr std::array kinds = {EntityKind::box,       EntityKind::sphere, EntityKind::point,
                                      EntityKind::capsule,   EntityKind::ramp,   EntityKind::stairs,
                                      EntityKind::character, EntityKind::spot,   EntityKind::camera};
        const int choice = static_cast<int>(event.key) - static_cast<int>(Key::digit1);
        if (choice >= 0 && choice < static_cast<int>(kinds.size())) workspace_.addKind = kinds[choice];
        return std::nullopt;
    }

  private:
    [[nodiscard]] bool lifted() const {
        const EntityKind kind = workspace_.addKind;
        return kind == EntityKind::point || kind == EntityKind::spot || kind == EntityKind::sun ||
               kind == EntityKind::camera;
    }
    // Boxes, spheres and capsules are told by their middle.
    [[nodiscard]] bool standsOnMiddle() const {
        const EntityKind kind = workspace_.addKind;
        return kind == EntityKind::box || kind == EntityKind::sphere || kind == EntityKind::capsule;
    }
    // What the preview shows: the new entity's own box, or a character's.
    [[nodiscard]] scene::EntityBox ghostBox() const {
        scene::EntityScene alone;
        const scene::EntityId id = scene::addEntity(alone, workspace_.addKind, {}).id;
        if (workspace_.addKind == EntityKind::character) {
            const scene::FigureBounds figure = scene::figureOf(workspace_.document->asset()).bounds;
            const vec3 half = (figure.high - figure.low) * 0.5F;
            return {{0, half.y, 0}, half};
        }
        constexpr float marker = 0.15F;
        return scene::boxOf(alone, id).value_or(scene::EntityBox{vec3(0), vec3(marker)});
    }

    void follow() {
        const auto at = surfaceUnder(workspace_.mouseRay(), workspace_.player->simulation().world(), 0.0F);
        if (!at) {
            workspace_.ghost.reset();
            return;
        }
        RigidTransform place;
        place.translation = *at;
        if (lifted()) place.translation.y += kMarkerHeight;
        if (standsOnMiddle()) place.translation.y += ghostBox().half.y;
        if (workspace_.addKind == EntityKind::character) place.translation.y += kDropHeight;
        if (workspace_.addKind == EntityKind::spot || workspace_.addKind == EntityKind::sun) {
            place.rotation = glm::angleAxis(radians(-90.0F), vec3(1, 0, 0));  // shines down
        }
        workspace_.ghost = place;
    }

    std::optional<Trigger> place() {
        follow();
        if (!workspace_.ghost) {
            workspace_.say(Toast::Kind::info, "There is no ground under the mouse here");
            return std::nullopt;
        }
        SceneSettings settings = workspace_.document->sceneDocument().settings();
        const scene::EntityId id = scene::addEntity(settings.entities, workspace_.addKind, *workspace_.ghost).id;
        const std::string label = fmt::format("Add {}", scene::findEntity(settings.entities, id)->name);
        if (workspace_.report(workspace_.document->setScene(settings, label))) return workspace_.ended();
        workspace_.follow();
        workspace_.selection.set({Item::Kind::object, 0, static_cast<int>(id)});
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
            const std::size_t count = workspace_.selection.items().size();
            const std::string what = count > 1 ? fmt::format("{} things", count) : workspace_.nameOf(*active);
            workspace_.hint = fmt::format("Delete {}? Enter or X deletes, Esc or a click keeps", what);
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
        if (!workspace_.selectedBodies().empty()) BodyCommands(workspace_).remove();
        SceneSettings settings = workspace_.document->sceneDocument().settings();
        bool objects = false;
        for (const Item& item : workspace_.selection.items()) {
            if (item.kind == Item::Kind::object) {
                scene::removeEntity(settings.entities, static_cast<scene::EntityId>(item.index));
                objects = true;
            }
        }
        workspace_.selection.clear();
        if (objects) workspace_.report(workspace_.document->setScene(settings, "Delete"));
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
