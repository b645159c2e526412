#pragma once

#include <functional>
#include <string>
#include <vector>

#include "editor/states/workspace.hpp"

namespace lutka::editor {

/// What the user does with pins; each is an entry of undo that leaves the fall alone.
class PinCommands {
  public:
    explicit PinCommands(Workspace& workspace) : workspace_(workspace) {}

    /// Pins the active body where it is, or lets it go. Of a character of another model all pins are let go: it is
    /// pinned while it is dragged.
    void toggle();
    void letAllGo();

  private:
    void change(const std::string& label, const std::function<void(std::vector<Pull>&)>& change);

    Workspace& workspace_;
};

}  // namespace lutka::editor
