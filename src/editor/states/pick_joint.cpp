#include <fmt/format.h>

#include "editor/states/body_commands.hpp"
#include "editor/states/states.hpp"
#include "editor/view/joint_pick.hpp"

namespace lutka::editor {
namespace {

constexpr render::Color kJoint{120, 200, 255, 255};
constexpr render::Color kHotJoint{255, 90, 30, 255};

/// PickJoint: every joint is shown, and a click gives the one under the mouse to the role that asked, or a body of its
/// own.
class PickJointHandler final : public StateHandler {
  public:
    explicit PickJointHandler(Workspace& workspace) : workspace_(workspace) {}

    void exit() override {
        workspace_.pickRole.reset();
        workspace_.hotJoint = animation::kNoJoint;
        workspace_.hint.clear();
        workspace_.press.reset();
    }

    void update() override {
        const std::vector<vec3> places = workspace_.worldOfJoints(0);
        const animation::Skeleton& skeleton = workspace_.document->character().skeleton;
        workspace_.hotJoint = underMouse(places);
        render::addSkeleton(workspace_.overlay, places, skeleton.parents, kJoint);
        const float size = workspace_.camera.distance * 0.008F;
        for (int joint = 0; joint < skeleton.jointCount(); ++joint)
            render::addCross(workspace_.overlay, places[joint], joint == workspace_.hotJoint ? size * 2 : size, kJoint);
        const auto wanted = workspace_.pickRole;
        const std::string_view what = wanted ? animation::roleName(*wanted) : "a new body";
        if (workspace_.hotJoint == animation::kNoJoint) {
            workspace_.hint = fmt::format("Click the joint of {}   Esc: cancel", what);
            return;
        }
        render::addSphere(workspace_.overlay, places[workspace_.hotJoint], size, kHotJoint);
        workspace_.hint =
            fmt::format("{}: click takes \"{}\"   Esc: cancel", what, skeleton.names[workspace_.hotJoint]);
    }

    std::optional<Trigger> mouseButton(const InputEvent& event) override {
        if (event.button == MouseButton::right && event.pressed) return workspace_.ended();
        if (event.button != MouseButton::left || event.pressed) return std::nullopt;
        const std::vector<vec3> places = workspace_.worldOfJoints(0);
        const int joint = underMouse(places);
        if (joint == animation::kNoJoint) return std::nullopt;  // beside: the user may try again
        if (const auto role = workspace_.pickRole) {
            workspace_.edit([&](EditorDocument& document) { return document.assignRole(*role, joint); });
        } else {
            BodyCommands(workspace_).add(joint);
        }
        return workspace_.ended();
    }

    std::optional<Trigger> wheel(float notches) override {
        workspace_.zoom(notches);
        return std::nullopt;
    }

    std::optional<Trigger> key(const InputEvent& event) override {
        return event.pressed && event.key == Key::escape ? std::optional(workspace_.ended()) : std::nullopt;
    }

  private:
    [[nodiscard]] int underMouse(std::span<const vec3> places) const {
        constexpr float reach = 28.0F;  // pixels
        return jointUnder(workspace_.document->character().skeleton, places, workspace_.camera, workspace_.mouse,
                          workspace_.window, reach * workspace_.uiScale);
    }

    Workspace& workspace_;
};

}  // namespace

std::unique_ptr<StateHandler> makePickJointHandler(Workspace& workspace) {
    return std::make_unique<PickJointHandler>(workspace);
}

}  // namespace lutka::editor
