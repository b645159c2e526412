#pragma once

#include <span>
#include <string>
#include <string_view>

struct ImVec2;

namespace lutka::editor {

struct PanelContext;

/// Where a tab can stand.
enum class PanelSide { left, right, bottom };
[[nodiscard]] const char* panelSideName(PanelSide side);

/// A tab of the panels: its content, and where it stands unless the user has moved it.
struct PanelTab {
    const char* name;
    void (*draw)(const PanelContext&);
    PanelSide side;
    bool scrolls;  ///< As a whole; others have lists of their own that do.
};
[[nodiscard]] std::span<const PanelTab> panelTabs();

/// Of the bar at the window's lower edge.
[[nodiscard]] float statusHeight();

}  // namespace lutka::editor
