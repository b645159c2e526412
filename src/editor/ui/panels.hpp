#pragma once

#include <span>

#include "editor/editor.hpp"
#include "editor/ui/editor_ui.hpp"
#include "editor/ui/frame_history.hpp"

/// The parts of the UI; each draws itself into the present Dear ImGui frame.
namespace lutka::editor {

struct PanelContext {
    Editor& editor;
    UiState& state;
    const FrameHistory& history;
    const UiFonts& fonts;
    float scale;

    /// A length in units of a 96 dpi pixel.
    [[nodiscard]] float px(float length) const { return length * scale; }
};

/// Of the left panel, 96 dpi pixels, unless names need more or the window is narrow.
inline constexpr float kLeftWidth = 310.0F;
/// Widths of the side panels in window units: their full width, less in a narrow window.
[[nodiscard]] float leftPanelWidth(const PanelContext& context);
[[nodiscard]] float rightPanelWidth(const PanelContext& context);
/// Where the view lies between the panels: its left and right edge, window units.
struct ViewSpan {
    float left;
    float right;
};
[[nodiscard]] ViewSpan viewSpan(const PanelContext& context);

/// Height of the panel below the view, window units; 0: there is none.
[[nodiscard]] float panelBelowHeight(const PanelContext& context);
/// What bars and panels lie over, as shares of the window, nothing while the panels are hidden; after drawTransport().
[[nodiscard]] render::PictureInsets coveredBy(const PanelContext& context);

void drawMenuBar(const PanelContext& context);
void drawStatusBar(const PanelContext& context);
void drawTransport(const PanelContext& context);
/// Tools at the view's left edge.
void drawTools(const PanelContext& context);
/// While State::box selects.
void drawSelectionBox(const PanelContext& context);
/// At the left, at the right, and below the view where a tab was moved there.
void drawSidePanels(const PanelContext& context);
void drawToasts(const PanelContext& context);
/// The file's clips, below the view; see ViewSettings::clips.
void drawTimeline(const PanelContext& context);
/// A model that was refused as a humanoid is offered as a ragdoll of any skeleton.
void drawAnyRigOffer(const PanelContext& context);
/// A profile beside the model is offered.
void drawOffer(const PanelContext& context);
/// Open, save as, export; the question about unsaved changes; the confirmation of Delete.
void drawDialogs(const PanelContext& context);
void drawFileDialog(const PanelContext& context);
void drawHelp(const PanelContext& context);
/// Recent models with their pictures.
void drawGallery(const PanelContext& context);
/// The collision filter as a matrix, in a window of its own.
void drawCollisions(const PanelContext& context);

/// Tabs of the left panel.
void drawSkeletonTab(const PanelContext& context);
void drawMappingTab(const PanelContext& context);
/// How wide a panel shows whole the names that are seen in the beginning, window units: in either of these tabs, and in
/// the one of the mapping.
[[nodiscard]] float widthForNames(const PanelContext& context);
[[nodiscard]] float mappingTabWidth(const PanelContext& context);
void drawEntityTab(const PanelContext& context);
/// Its lower half: the components of the selected entity.
void drawInspector(const PanelContext& context);

/// Tabs of the right panel.
void drawRagdollTab(const PanelContext& context);
void drawSimulationTab(const PanelContext& context);
/// Two of its sections.
void drawMuscles(const PanelContext& context);
void drawFit(const PanelContext& context);
void drawViewTab(const PanelContext& context);
void drawStatsTab(const PanelContext& context);
void drawDoctorTab(const PanelContext& context);
void drawLogTab(const PanelContext& context);

}  // namespace lutka::editor
