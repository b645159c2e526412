#pragma once

#include <memory>
#include <vector>

#include "editor/files/recovery.hpp"

namespace lutka::editor {

/// A session's dealings with recovery copies: keeps its own, and offers those of sessions that ended by force, one
/// after the other. Without begin() it does nothing.
class RecoveryDesk {
  public:
    /// Looks for copies below `folder` and begins to keep one there; an empty folder: neither. Fails as
    /// RecoveryKeeper::create() does; what was found is offered all the same.
    [[nodiscard]] Result<void> begin(const std::filesystem::path& folder);
    /// The copy that waits for an answer; null: none.
    [[nodiscard]] const RecoveryCopy* offered() const { return offers_.empty() ? nullptr : &offers_.front(); }

    enum class Answer { restore, later, remove };
    /// Later leaves the offered one for the next start, remove deletes it.
    void set(Answer answer);
    /// The document that the offered copy is of, with its changes unsaved. Fails as EditorDocument::open() and
    /// recoverInto() do.
    [[nodiscard]] Result<std::unique_ptr<EditorDocument>> restore(scene::LoadOptions load) const;
    /// restore()'s document is the session's now: its copy takes the place of the old one, which was the offered.
    /// Fails as keep() does, with the old one left.
    [[nodiscard]] Result<void> restored(const EditorDocument& document);

    // As RecoveryKeeper's.
    [[nodiscard]] Result<void> update(const EditorDocument& document, double seconds);
    [[nodiscard]] Result<void> keep(const EditorDocument& document);
    void end();

  private:
    std::unique_ptr<RecoveryKeeper> keeper_;
    std::vector<RecoveryCopy> offers_;
};

}  // namespace lutka::editor
