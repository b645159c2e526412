#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "editor/editor.hpp"
#include "editor/files/file_list.hpp"
#include "editor/ui/frame_history.hpp"
#include "editor/ui/gallery.hpp"
#include "editor/ui/imgui_host.hpp"
#include "editor/ui/side_panels.hpp"
#include "editor/ui/stats_readings.hpp"

namespace lutka::editor {

/// What only the UI knows and nothing else depends on.
struct UiState {
    std::string jointFilter;
    int scrollToJoint = -1;  ///< Joint that the tree shall bring into view.
    std::string helpFilter;
    std::string logFilter;
    bool logWarningsOnly = false;
    // Of the open file dialog.
    Editor::Dialog fileDialog = Editor::Dialog::none;
    std::string path;  ///< Its text.
    FileFilter fileFilter = FileFilter::models;
    int fileIndex = -1;            ///< The line that the arrows chose.
    std::filesystem::path chosen;  ///< What it stands for; taken by Enter.
    bool scrollToFile = false;
    std::string newFolder;
    float exportSeconds = 4.0F;
    int exportFormat = 0;  ///< Of exporting::exportFormats().
    bool lightTheme = false;
    float uiScale = 0.0F;  ///< As UserSettings has it, and these two.
    float leftWidth = 0.0F;
    float rightWidth = 0.0F;
    float bottomHeight = 0.0F;
    /// What joints' names need, measured once for each model, so that no edit moves the panels. Window units.
    struct NameRoom {
        int characterRevision = -1;
        float scale = 0.0F;
        float indent = 0.0F;  ///< Of each level of the tree.
        float width = 0.0F;   ///< Of the panel.
    };
    NameRoom nameRoom;
    std::map<std::string, PanelSide> tabSides;  ///< Of tabs that the user has moved.
    int doctorErrors = 0;                       ///< That the doctor's tab tells.
    bool shapeAdded = false;                    ///< To a body, and its fields are not shown yet.
    bool showCollisions = false;
    bool draggingOverView = false;  ///< A role is dragged, and not over a panel.
    std::vector<std::filesystem::path> recent;
    std::filesystem::path pictureFolder;  ///< Where the pictures of these are; empty: nowhere.
    PictureShelf pictures;
    // Of the Scene tab.
    std::set<scene::EntityId> closedEntities;     ///< Whose children are folded away.
    scene::EntityId browsing = scene::kNoEntity;  ///< Whose file is chosen in the dialog.
    scene::EntityId renaming = scene::kNoEntity;
    std::string newName;
    /// The angles that a rotation is shown as: several mean the same.
    struct ShownAngles {
        scene::EntityId entity = scene::kNoEntity;
        quat rotation{1, 0, 0, 0};
        vec3 degrees{0, 0, 0};
    };
    ShownAngles angles;
    double groupEnds = 0.0;         ///< When what one drag changes is over, Dear ImGui's seconds; 0: it is.
    float toolsRight = 0.0F;        ///< Where the view begins beside the tools, in a narrow one; else 0.
    float transportBottom = 0.0F;   ///< Window units: where the view begins below it …
    float timelineTop = 0.0F;       ///< Where it ends above the timeline; 0: that is not shown.
    float offerBottom = 0.0F;       ///< … and where what an offer over the view covers ends; 0: there is none.
    AmendStats amendStats;          ///< May be empty.
    bool escapeTaken = false;       ///< In this frame, by a list or menu that it closed: no dialog below it ends.
    int copies = 8;                 ///< Of "Drop copies".
    std::optional<Item> shownItem;  ///< What panels showed last, to notice a new selection.
};

/// All panels, over the picture. Works on the editor through its public calls only.
class EditorUi {
  public:
    explicit EditorUi(const ImguiHost& host) : host_(host) {}

    /// Between the host's beginFrame() and draw().
    void build(Editor& editor, const FrameHistory& history);

    UiState state;

  private:
    const ImguiHost& host_;
};

}  // namespace lutka::editor
