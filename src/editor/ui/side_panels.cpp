/// The panels at the left, at the right and below the view: their tabs, which can be moved from one to another by a
/// right click, and their edges, which widen them.

#include "editor/ui/side_panels.hpp"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "editor/ui/panels.hpp"
#include "editor/ui/style.hpp"
#include "editor/ui/widgets.hpp"

namespace lutka::editor {
namespace {

constexpr ImGuiWindowFlags kPanel = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                                    ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                                    ImGuiWindowFlags_NoBringToFrontOnFocus;
constexpr float kRightWidth = 344.0F;
constexpr float kBottomHeight = 230.0F;

constexpr std::array kTabs = {PanelTab{"Skeleton", drawSkeletonTab, PanelSide::left, false},
                              PanelTab{"Mapping", drawMappingTab, PanelSide::left, false},
                              PanelTab{"Scene", drawEntityTab, PanelSide::left, false},
                              PanelTab{"Body", drawRagdollTab, PanelSide::right, true},
                              PanelTab{"Physics", drawSimulationTab, PanelSide::right, true},
                              PanelTab{"View", drawViewTab, PanelSide::right, true},
                              PanelTab{"Doctor", drawDoctorTab, PanelSide::right, true},
                              PanelTab{"Stats", drawStatsTab, PanelSide::right, true},
                              PanelTab{"Log", drawLogTab, PanelSide::right, true}};

PanelSide sideOf(const PanelContext& context, const PanelTab& tab) {
    const auto moved = context.state.tabSides.find(tab.name);
    return moved == context.state.tabSides.end() ? tab.side : moved->second;
}

bool anyTab(const PanelContext& context, PanelSide side) {
    return std::any_of(kTabs.begin(), kTabs.end(), [&](const PanelTab& tab) { return sideOf(context, tab) == side; });
}

// What a panel needs for the names of its joints; 0: it has none.
float nameWidth(const PanelContext& context, PanelSide side) {
    const auto has = [&](auto* draw) {
        return std::any_of(kTabs.begin(), kTabs.end(),
                           [&](const PanelTab& tab) { return tab.draw == draw && sideOf(context, tab) == side; });
    };
    return has(drawSkeletonTab) || has(drawMappingTab) ? widthForNames(context) : 0.0F;
}

// Its own width at most that share of the window, and a little more where names need it; one that the user dragged at
// most what leaves the view some room.
float panelWidth(const PanelContext& context, PanelSide side, float chosen, float own, float share) {
    const float window = ImGui::GetIO().DisplaySize.x;
    if (chosen <= 0.0F) {
        constexpr float mostForNames = 0.33F;
        const float names = nameWidth(context, side);
        const float usual = std::min(context.px(own), window * share);
        return names <= context.px(own) ? usual : std::max(usual, std::min(names, window * mostForNames));
    }
    constexpr float most = 0.45F;
    return std::clamp(context.px(chosen), std::min(context.px(180), window * share), window * most);
}

float bottomHeight(const PanelContext& context) {
    if (!anyTab(context, PanelSide::bottom)) return 0.0F;
    const float wanted = context.state.bottomHeight > 0.0F ? context.state.bottomHeight : kBottomHeight;
    constexpr float most = 0.6F;
    const float window = ImGui::GetIO().DisplaySize.y;
    return std::clamp(context.px(wanted), std::min(context.px(90), window * most), window * most);
}

/// A panel's inner edge.
struct Edge {
    const char* id;
    ImVec2 from;
    ImVec2 to;
    float* size;  ///< Of the panel, 96 dpi pixels; 0: its own.
    float now;    ///< The size that it has, window units.
    float sign;   ///< Of the mouse's movement that makes it larger.
};

// Dragged it widens the panel; a double click gives the panel its own size back.
void drawEdge(const PanelContext& context, const Edge& edge) {
    const bool upright = edge.from.x == edge.to.x;
    const float half = context.px(5) * 0.5F;
    const ImVec2 low(edge.from.x - (upright ? half : 0.0F), edge.from.y - (upright ? 0.0F : half));
    const ImVec2 high(edge.to.x + (upright ? half : 0.0F), edge.to.y + (upright ? 0.0F : half));
    ImGui::SetNextWindowPos(low);
    ImGui::SetNextWindowSize({high.x - low.x, high.y - low.y});
    ImGui::SetNextWindowBgAlpha(0.0F);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0.0F);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
    constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                       ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing |
                                       ImGuiWindowFlags_NoNav;
    ImGui::Begin(edge.id, nullptr, flags);
    ImGui::InvisibleButton("##edge", ImGui::GetContentRegionAvail());
    if (ImGui::IsItemHovered() || ImGui::IsItemActive()) {
        ImGui::SetMouseCursor(upright ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
        ImGui::GetWindowDrawList()->AddLine(edge.from, edge.to, ImGui::GetColorU32(accentColor()), context.px(2));
    }
    const float moved = upright ? ImGui::GetIO().MouseDelta.x : ImGui::GetIO().MouseDelta.y;
    constexpr float least = 90.0F;
    if (ImGui::IsItemActive() && moved != 0.0F)
        *edge.size = std::max((edge.now + edge.sign * moved) / context.scale, least);
    if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) *edge.size = 0.0F;
    ImGui::End();
    ImGui::PopStyleVar(3);
}

int doctorErrors(const PanelContext& context) {
    const auto& findings = context.editor.document().diagnosis().findings;
    return static_cast<int>(std::count_if(findings.begin(), findings.end(), [](const physics::Finding& finding) {
        return finding.severity == physics::Severity::error;
    }));
}

// The tab with the number of the doctor's errors behind its name.
std::string doctorTitle(const PanelContext& context) {
    // A drag changes the ragdoll every frame: the doctor is asked at its end.
    if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) context.state.doctorErrors = doctorErrors(context);
    const int errors = context.state.doctorErrors;
    return errors == 0 ? "Doctor###Doctor" : fmt::format("Doctor {}###Doctor", errors);
}

// A right click on a tab moves it to another panel.
void moveMenu(const PanelContext& context, const PanelTab& tab) {
    if (!ImGui::BeginPopupContextItem()) return;
    for (const PanelSide side : {PanelSide::left, PanelSide::right, PanelSide::bottom}) {
        const std::string label = fmt::format("Move {} to the {}", tab.name, panelSideName(side));
        if (!ImGui::MenuItem(label.c_str(), nullptr, false, sideOf(context, tab) != side)) continue;
        if (side == tab.side) {
            context.state.tabSides.erase(tab.name);
        } else {
            context.state.tabSides[tab.name] = side;
        }
    }
    ImGui::EndPopup();
}

// `padding`: of what is in the tabs.
void drawTabs(const PanelContext& context, PanelSide side, const char* id, const ImVec2& padding) {
    if (!ImGui::BeginTabBar(id, ImGuiTabBarFlags_FittingPolicyScroll)) return;
    for (const PanelTab& tab : kTabs) {
        if (sideOf(context, tab) != side) continue;
        const bool doctor = tab.draw == drawDoctorTab;
        const bool open = ImGui::BeginTabItem(doctor ? doctorTitle(context).c_str() : tab.name);
        moveMenu(context, tab);
        if (!open) continue;
        // What is in the tab keeps its place whatever its title tells.
        ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, padding);
        if (tab.scrolls) {
            ImGui::PushStyleColor(ImGuiCol_ChildBg, 0U);
            ImGui::BeginChild("##tab");
            ImGui::PopStyleColor();
        }
        tab.draw(context);
        if (tab.scrolls) ImGui::EndChild();
        ImGui::PopStyleVar();
        ImGui::EndTabItem();
    }
    ImGui::EndTabBar();
}

// Names of tabs closer together where there is little room.
float tabPadding(const PanelContext& context, float width, int errors) {
    if (width < context.px(kRightWidth - 1.0F)) return 2.0F;
    return errors > 0 ? 3.0F : 6.0F;
}

void drawPanel(const PanelContext& context, PanelSide side, const char* id, const ImVec2& place, const ImVec2& size) {
    ImGui::SetNextWindowPos(place);
    ImGui::SetNextWindowSize(size);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0F);
    ImGui::Begin(id, nullptr, kPanel);
    const bool right = side == PanelSide::right;
    ImVec2 titles = ImGui::GetStyle().FramePadding;
    ImVec2 content = titles;
    if (right) {
        titles = {context.px(tabPadding(context, size.x, context.state.doctorErrors)), context.px(4)};
        content = {context.px(tabPadding(context, size.x, 0)), context.px(4)};
    }
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, titles);
    drawTabs(context, side, (std::string(id) + "Tabs").c_str(), content);
    ImGui::PopStyleVar();
    ImGui::End();
    ImGui::PopStyleVar();
}

}  // namespace

const char* panelSideName(PanelSide side) {
    constexpr std::array names = {"left", "right", "bottom"};
    return names[static_cast<std::size_t>(side)];
}

std::span<const PanelTab> panelTabs() {
    return kTabs;
}

float statusHeight() {
    return ImGui::GetFrameHeight() + 4.0F;
}

float leftPanelWidth(const PanelContext& context) {
    if (!anyTab(context, PanelSide::left)) return 0.0F;
    return panelWidth(context, PanelSide::left, context.state.leftWidth, kLeftWidth, 0.29F);
}

float rightPanelWidth(const PanelContext& context) {
    if (!anyTab(context, PanelSide::right)) return 0.0F;
    return panelWidth(context, PanelSide::right, context.state.rightWidth, kRightWidth, 0.33F);
}

ViewSpan viewSpan(const PanelContext& context) {
    const float width = ImGui::GetIO().DisplaySize.x;
    if (!context.editor.view.panels) return {0.0F, width};
    return {leftPanelWidth(context), width - rightPanelWidth(context)};
}

float panelBelowHeight(const PanelContext& context) {
    return context.editor.view.panels ? bottomHeight(context) : 0.0F;
}

render::PictureInsets coveredBy(const PanelContext& context) {
    if (!context.editor.view.panels) return {};  // then the picture is the whole window, with bars over its margin
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const auto [begin, right] = viewSpan(context);
    const float left = std::max(begin, context.state.toolsRight);
    const float top = context.state.transportBottom + context.px(4);
    constexpr float most = 0.9F;  // a tiny window still shows something
    const auto clamped = [](float low, float high) {
        const float scale = std::min(1.0F, most / std::max(low + high, 1e-3F));
        return std::pair(low * scale, high * scale);
    };
    const auto [l, r] = clamped(left / size.x, 1.0F - right / size.x);
    const auto [t, b] = clamped(top / size.y, (statusHeight() + bottomHeight(context)) / size.y);
    return {l, r, t, b};
}

void drawSidePanels(const PanelContext& context) {
    const float top = ImGui::GetFrameHeight();
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const float bottom = size.y - statusHeight();
    const float left = leftPanelWidth(context);
    const float right = rightPanelWidth(context);
    const float below = bottomHeight(context);
    UiState& state = context.state;
    if (left > 0.0F) {
        drawPanel(context, PanelSide::left, "##left", {0, top}, {left, bottom - top});
        drawEdge(context, {"##leftEdge", {left, top}, {left, bottom}, &state.leftWidth, left, 1.0F});
    }
    if (right > 0.0F) {
        drawPanel(context, PanelSide::right, "##right", {size.x - right, top}, {right, bottom - top});
        const float edge = size.x - right;
        drawEdge(context, {"##rightEdge", {edge, top}, {edge, bottom}, &state.rightWidth, right, -1.0F});
    }
    if (below > 0.0F) {
        const ImVec2 place(left, bottom - below);
        drawPanel(context, PanelSide::bottom, "##bottom", place, {size.x - left - right, below});
        drawEdge(context, {"##bottomEdge", place, {size.x - right, place.y}, &state.bottomHeight, below, -1.0F});
    }
}

}  // namespace lutka::editor
