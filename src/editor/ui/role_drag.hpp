#pragma once

#include <optional>

#include "editor/ui/panels.hpp"

/// Dragging a role onto a joint: from the mapping's rows and the tree's tags, to a joint of the tree or of the view.
namespace lutka::editor {

/// Makes the last item one that can be dragged to give the role to a joint.
void dragRole(animation::Role role);
/// The role that was just dropped on the last item.
[[nodiscard]] std::optional<animation::Role> droppedRole();
/// Once a frame: a role that is dragged over the view picks its joint there.
void dragRoleOverView(const PanelContext& context);

}  // namespace lutka::editor
