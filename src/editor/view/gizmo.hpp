#pragma once

#include <optional>

#include "editor/view/axis_lock.hpp"
#include "render/line_batch.hpp"

namespace lutka::editor {

/// What a drag on the selection's gizmo does.
enum class Tool {
    select,  ///< Nothing of its own: bodies have none, objects that of `move`.
    move,
    rotate,
    scale,
    hit,  ///< No gizmo: a click hits what it points at.
};
inline constexpr int kToolCount = 5;
[[nodiscard]] const char* toolName(Tool tool);

/// The arrows, rings or arms around what is selected.
struct Gizmo {
    Tool tool = Tool::move;
    RigidTransform worldFromGizmo;  ///< Its axes.
    float size = 1.0F;              ///< Length of an arm, metres.
    bool local = false;             ///< Whether the axes are the item's own.
};

/// One whose arms are seen `pixels` long at `origin`.
[[nodiscard]] Gizmo gizmoAt(Tool tool, const RigidTransform& worldFromGizmo, bool local, const render::Camera& camera,
                            render::Extent window, float pixels);

/// What a drag that begins at the mouse is locked to: an axis, or of `move` a plane; nothing further than `pixels` from
/// all of them.
[[nodiscard]] std::optional<AxisLock> gizmoPartUnder(const Gizmo& gizmo, const render::Camera& camera,
                                                     const vec2& mouse, render::Extent window, float pixels);

/// `hot` stands out.
void drawGizmo(const Gizmo& gizmo, const std::optional<AxisLock>& hot, const render::Camera& camera,
               render::LineBatch& lines);

/// X red, Y green, Z blue.
[[nodiscard]] render::Color axisColor(int axis);

}  // namespace lutka::editor
