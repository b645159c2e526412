#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace lutka::editor {

/// Undo by snapshots: every entry holds the whole editable state as it was before a change. Changes that share a group
/// (one drag of a slider) become one entry.
template <class Snapshot>
class UndoStack {
  public:
    static constexpr std::size_t kMaxEntries = 200;  ///< The oldest are forgotten beyond this.

    /// Tells of a change that turned `before` into something else. A `group` other than "" that equals the last
    /// change's joins it, until endGroup(). `moves`: see undoMoves().
    void changed(const Snapshot& before, std::string label, const std::string& group, bool moves = false) {
        if (join(group, moves)) return;
        openGroup_ = group;
        redoBeforeGroup_ = std::exchange(redo_, {});
        undo_.push_back({before, std::move(label), moves});
        if (undo_.size() > kMaxEntries) undo_.erase(undo_.begin());
    }

    /// The same for a change whose state before nobody has taken yet: whether it joined the open group, so that nobody
    /// needs to.
    bool join(const std::string& group, bool moves = false) {
        if (group.empty() || group != openGroup_ || undo_.empty()) return false;
        undo_.back().moves = undo_.back().moves || moves;
        return true;
    }

    void endGroup() {
        openGroup_.clear();
        redoBeforeGroup_.clear();
    }
    [[nodiscard]] bool groupIsOpen() const { return !openGroup_.empty() && !undo_.empty(); }

    /// The state before the open group. groupIsOpen() must hold.
    [[nodiscard]] const Snapshot& beforeGroup() const { return undo_.back().snapshot; }
    /// Takes the open group back as if it had never been, what could be redone before it included: the state before
    /// it. groupIsOpen() must hold.
    [[nodiscard]] Snapshot cancelGroup() {
        Snapshot before = std::move(undo_.back().snapshot);
        undo_.pop_back();
        redo_ = std::move(redoBeforeGroup_);
        endGroup();
        return before;
    }

    [[nodiscard]] bool canUndo() const { return !undo_.empty(); }
    [[nodiscard]] bool canRedo() const { return !redo_.empty(); }
    [[nodiscard]] std::string undoLabel() const { return undo_.empty() ? "" : undo_.back().label; }
    [[nodiscard]] std::string redoLabel() const { return redo_.empty() ? "" : redo_.back().label; }
    /// Whether the last change moved what the scene simulates, beside what it did to the documents; and the next to
    /// redo.
    [[nodiscard]] bool undoMoves() const { return !undo_.empty() && undo_.back().moves; }
    [[nodiscard]] bool redoMoves() const { return !redo_.empty() && redo_.back().moves; }

    /// Labels of all that can be undone, the latest first, and of all that can be redone, the next first.
    [[nodiscard]] std::vector<std::string> undoLabels() const { return labels(undo_); }
    [[nodiscard]] std::vector<std::string> redoLabels() const { return labels(redo_); }

    /// The state before the last change, in exchange for the present one. canUndo() must hold.
    [[nodiscard]] Snapshot undo(Snapshot present) { return swap(undo_, redo_, std::move(present)); }
    /// The state that the last undo left. canRedo() must hold.
    [[nodiscard]] Snapshot redo(Snapshot present) { return swap(redo_, undo_, std::move(present)); }

    void clear() {
        undo_.clear();
        redo_.clear();
        endGroup();
    }

  private:
    struct Entry {
        Snapshot snapshot;
        std::string label;
        bool moves = false;
    };

    static std::vector<std::string> labels(const std::vector<Entry>& entries) {
        std::vector<std::string> all;
        for (auto entry = entries.rbegin(); entry != entries.rend(); ++entry)
            all.push_back(entry->label);
        return all;
    }

    Snapshot swap(std::vector<Entry>& from, std::vector<Entry>& to, Snapshot present) {
        endGroup();
        Entry entry = std::move(from.back());
        from.pop_back();
        to.push_back({std::move(present), entry.label, entry.moves});
        return std::move(entry.snapshot);
    }

    std::vector<Entry> undo_;
    std::vector<Entry> redo_;
    std::string openGroup_;
    std::vector<Entry> redoBeforeGroup_;  ///< What the open group took from `redo_`.
};

}  // namespace lutka::editor
