#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "editor/document/editor_document.hpp"

namespace lutka::editor {

/// Where copies of unsaved work are kept: $XDG_STATE_HOME/lutka/recovery, else ~/.local/state/lutka/recovery; empty
/// when there is no home.
[[nodiscard]] std::filesystem::path recoveryFolder();

/// Unsaved work of a session that ended without saving or discarding it.
struct RecoveryCopy {
    std::filesystem::path folder;   ///< Its own, below the recovery folder.
    std::filesystem::path model;    ///< The character that was edited.
    std::filesystem::path profile;  ///< The file that its ragdoll was opened from or saved to; empty: none.
    std::filesystem::path scene;    ///< Likewise the scene's.
    bool holdsRagdoll = false;
    bool holdsScene = false;
    std::string when;  ///< Local time of its last change: "2026-11-28 14:32".
    std::array<std::optional<int>, animation::kRoleCount> fixed{};  ///< Roles that the user gave to joints.
    std::string scenario;                                           ///< Of SceneSettings …
    int count = 1;
    std::uint64_t seed = 0;
    std::vector<scene::EntityId> made;

    /// "the ragdoll of knight.fbx and the scene stairs"
    [[nodiscard]] std::string contents() const;
};

/// The copies below `folder` whose sessions are gone, the newest first. Folders of such sessions that hold nothing are
/// removed; what can't be read is left alone.
[[nodiscard]] std::vector<RecoveryCopy> findRecoveries(const std::filesystem::path& folder);
void removeRecovery(const RecoveryCopy& copy);

/// Puts what a copy holds on a document that was opened from its model (and profile), as entries of undo: it is unsaved
/// then. Fails as reading the copy and EditorDocument's calls do.
[[nodiscard]] Result<void> recoverInto(EditorDocument& document, const RecoveryCopy& copy);

/// Keeps a copy of one session's unsaved work in a folder of its own below `folder`, which it holds locked while it
/// lives: other sessions neither touch it nor offer it, and an end by force leaves it to the next one.
class RecoveryKeeper {
  public:
    /// Seconds between a change and its copy, when one change follows another.
    static constexpr double kInterval = 3.0;

    /// Fails with ErrorCode::output when the folder can't be made.
    [[nodiscard]] static Result<std::unique_ptr<RecoveryKeeper>> create(const std::filesystem::path& folder);
    /// Leaves what is kept; without a copy nothing is left behind.
    ~RecoveryKeeper();
    RecoveryKeeper(const RecoveryKeeper&) = delete;
    RecoveryKeeper& operator=(const RecoveryKeeper&) = delete;

    /// Every frame: `seconds` of wall time since the last. Copies what has changed, and removes the copy when nothing
    /// is unsaved any more. Fails as keep() does, once.
    [[nodiscard]] Result<void> update(const EditorDocument& document, double seconds);
    /// Copies now. Fails with ErrorCode::output.
    [[nodiscard]] Result<void> keep(const EditorDocument& document);
    /// The session ends by the user's will: nothing is to be recovered.
    void end();

  private:
    RecoveryKeeper(std::filesystem::path folder, int lock) : folder_(std::move(folder)), lock_(lock) {}
    void drop();

    std::filesystem::path folder_;
    int lock_;  // of the folder's file, held by this process
    double since_ = kInterval;
    std::uint64_t kept_ = 0;  // the document's revision in the copy
    bool holds_ = false;
    bool failed_ = false;
};

}  // namespace lutka::editor
