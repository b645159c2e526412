#pragma once

#include "editor/states/workspace.hpp"

namespace lutka::editor {

/// What the user does with the selected bodies. What fails is told; the simulation follows.
class BodyCommands {
  public:
    explicit BodyCommands(Workspace& workspace) : workspace_(workspace) {}

    void copy();
    void paste();
    void mirror();
    /// A body on a joint, selected.
    void add(int joint);
    void remove();
    /// Each goes into the body above it.
    void merge();
    void split();
    /// The root alone, to begin a ragdoll by hand.
    void beginByHand();
    /// From now on edits go to both sides, or no longer.
    void toggleSymmetric();

  private:
    using Change = std::function<Result<physics::RagdollProfile>(const physics::RagdollProfile&, int body)>;
    /// The change of each selected body, one after the other, as one entry of undo.
    bool changeEach(const char* what, const Change& change);
    [[nodiscard]] std::vector<std::string> selectedNames() const;

    Workspace& workspace_;
};

}  // namespace lutka::editor
